/// Playing, stepping and scrubbing, and the part of the scene that is played.
#ifndef EDITOR_CORE_PLAYBACK_H
#define EDITOR_CORE_PLAYBACK_H

#include "editor/core/state.h"

/// Plays or pauses.
void playback_toggle(struct core *core);
/// Advances by `dt` seconds of the real clock. Counts the scene frames that a late picture skipped.
void playback_advance(struct core *core, double dt);
/// Stops at a frame.
void playback_seek(struct core *core, double frame);
/// Stops and goes to the next whole frame in a direction.
void playback_step(struct core *core, int direction);
/// Stops and goes to an end of the range.
void playback_end(struct core *core, int direction);
/// The next faster (direction 1) or slower speed, 0.1 … 4 times real time; 0: real time.
void playback_change_speed(struct core *core, int direction);

/// First and last frame that are played: the part that was chosen, as far as the scene has it, else all.
void playback_range(const struct core *core, double range[2]);
/// Whether less than the whole scene is played.
bool playback_is_part(const struct core *core);
/// Sets the part; an empty one, or one that holds everything, is none.
void playback_choose(struct core *core, double first, double last);
/// Says which part is played.
void playback_say_range(struct core *core);
/// Sets the part's beginning (0) or end (1) to the playhead's frame.
void playback_mark(struct core *core, int end);

#endif
