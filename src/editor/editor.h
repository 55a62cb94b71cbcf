/// The editor: events → edit operations and view state → draw list and stage. No GL, no windows, no files.
#ifndef EDITOR_EDITOR_H
#define EDITOR_EDITOR_H

#include "editor/core/world.h"

struct editor;

struct editor *editor_create(struct error *error);
void editor_destroy(struct editor *editor);

/// A new document is on the table: selection, view and playhead start anew; the camera is fitted to `document`'s
/// motion at the first editor_pose(). The first spline that moves a tail is active.
void editor_open(struct editor *editor, const struct editor_world *world);

/// Looks whether another document has come in its place (a figure, or its undo: document.serial), and starts anew with it as
/// editor_open() does; else the active spline and the shown frame stay what they were, wherever they are now. Called after each
/// edit, undo and redo, before anything else is done with the document.
void editor_follow(struct editor *editor, const struct editor_world *world);

/// Ends what is being dragged where it is: before the app itself makes an edit.
void editor_let_go(struct editor *editor, const struct editor_world *world);

/// The path of the document's own file, "" where it has none (Ctrl+S then asks for one): after saving.
void editor_set_path(struct editor *editor, const char *path);

/// Asks what to do with it: REQUEST_RECOVER, REQUEST_FORGET, or nothing yet.
void editor_offer_recovery(struct editor *editor, const struct recovery_offer *offer);

/// Shows what to try first, to somebody who is new; and whether that is still to be seen.
void editor_welcome(struct editor *editor);
bool editor_is_welcoming(const struct editor *editor);

/// The panels' sizes, which the user drags: the stage's share of the height, the inspector's width.
void editor_panels(const struct editor *editor, double *stage_share, double *inspector_width);
void editor_set_panels(struct editor *editor, double stage_share, double inspector_width);

/// Logical size of the window, and device pixels a logical pixel.
void editor_resize(struct editor *editor, float width, float height, float scale);

/// One event → edits through the history. Events arrive in order; nothing is solved here.
void editor_event(struct editor *editor, const struct editor_world *world, const struct event *event);

/// After the frame's events: playback advances by `dt` seconds, running drags (and the grab on the stage) are
/// applied.
void editor_advance(struct editor *editor, const struct editor_world *world, double dt);

/// What is looked at of the splines: what a long one shows first.
struct focus editor_focus(const struct editor *editor, const struct document *document);

/// After the solve: poses rigs, builds this frame's draw list and stage, both valid until the next call. Allocates
/// nothing.
void editor_pose(struct editor *editor, const struct editor_world *world);
void editor_show(struct editor *editor, const struct editor_world *world);
const struct drawlist *editor_drawlist(const struct editor *editor);
const struct stage_view *editor_stage(const struct editor *editor);

/// Takes the oldest request; REQUEST_NONE where there is none.
struct request editor_take_request(struct editor *editor);

/// Says how a request went: every one gets an answer, once all that it brings (editor_open(), editor_set_path()) is done.
/// `text` says why where it is not `ok`. The dialog that asked closes, or shows the sentence and lets one try again.
void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text);

/// The text that was copied last; "" where nothing was.
const char *editor_clipboard(const struct editor *editor);

/// Shows a sentence in the status line (an error until the next key or click, else for some seconds of `dt`).
void editor_message(struct editor *editor, bool is_error, const char *text);

/// Frames a second and microseconds of solving, for the status line; shown as told, so tell it seldom.
void editor_set_stats(struct editor *editor, double fps, double solve_us);

/// The stage's pixels a device pixel, a side, in this frame: the status line says where it is below 1.
void editor_set_stage_scale(struct editor *editor, float scale);

/// How the knots are shown (V); the app solves as cubic for LOOK_CUBIC.
enum look editor_look(const struct editor *editor);
bool editor_is_playing(const struct editor *editor);
/// Whether something moves by itself, so that the next frame should not wait for an event.
bool editor_wants_frames(const struct editor *editor);
/// Mouse cursor for where the pointer is.
enum mouse_cursor editor_cursor(const struct editor *editor);

/// Where a replay's target is on the screen now: "knot(sway,2)", "curve(sway,36,1)", "slider(frequency)",
/// "stage(0.5,0.5)", "tail(tail,0.9)", "warning(0)". false where there is no such thing (with a sentence).
bool editor_target(struct editor *editor, const struct editor_world *world, const char *target, float *x, float *y,
                   struct error *error);

#endif
