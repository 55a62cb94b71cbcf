/// Playing, stepping and scrubbing, the part that is played, and the controls for it in the status line. Private to
/// src/editor.
#ifndef EDITOR_CORE_PLAYBACK_H
#define EDITOR_CORE_PLAYBACK_H

#include "editor/core/state.h"

void playback_toggle(struct editor *editor, const struct editor_world *world);
/// Time passes: `dt` seconds of the real clock. Scene frames that no picture showed because one came late are counted.
void playback_advance(struct editor *editor, const struct editor_world *world, double dt);
/// Stops and goes to the next whole frame in a direction, or to an end of the range.
void playback_step(struct editor *editor, const struct editor_world *world, int direction);
void playback_end(struct editor *editor, const struct editor_world *world, int direction);
/// Stops and shows a frame.
void playback_seek(struct editor *editor, const struct document *document, double frame);

/// The next faster (direction 1) or slower speed, 0.1 … 4 times real time; 0: real time.
void playback_change_speed(struct editor *editor, const struct editor_world *world, int direction);
/// Loop on, off.
void playback_toggle_loop(struct editor *editor, const struct editor_world *world, int unused);

/// First and last frame that are played: the part that was chosen, as far as the scene has it, else all.
void playback_range(const struct editor *editor, const struct document *document, double range[2]);
/// The part begins (end 0) or ends (1) at the playhead's frame.
void range_mark(struct editor *editor, const struct editor_world *world, int end);
/// Shift+drag on the ruler chooses the part (whole frames), a click with Shift all of it again.
void range_begin(struct editor *editor, const struct event *event);
void range_drag(struct editor *editor, const struct document *document, float x);
void range_end(struct editor *editor, bool keep);
/// Mark the part on the ruler and tint it in the plot; nothing where all is played.
void range_show_ruler(struct editor *editor, const struct document *document);
void range_show_plot(struct editor *editor, const struct document *document);

/// The controls at the left of the status line.
enum transport { TRANSPORT_PLAY, TRANSPORT_LOOP, TRANSPORT_SPEED, TRANSPORT_COUNT };

struct rect transport_rect(const struct editor *editor, enum transport control);
struct hover transport_hover(const struct editor *editor, float x, float y);
/// A press or the wheel on a control; true where there is one.
bool transport_event(struct editor *editor, const struct editor_world *world, const struct event *event);
/// Returns the controls' right end.
float transport_show(struct editor *editor);

#endif
