/// The editor: events → edit operations and view state → draw list and stage. No GL, no windows, no files.
#ifndef EDITOR_EDITOR_H
#define EDITOR_EDITOR_H

#include "editor/core/world.h"

struct editor;

struct editor *editor_create(void);
void editor_destroy(struct editor *editor);

/// A new document is on the table, and what is here is worked on until the next one is: it is not copied. Selection, view and playhead
/// start anew; the camera is fitted to the motion at the first editor_pose(). The first spline that moves a tail is active.
void editor_open(struct editor *editor, const struct editor_world *world);

/// Brings the editor up to date after each edit, undo and redo, before anything else is done with the document. If another
/// document has taken its place (a figure, or its undo: document.serial), starts anew as editor_open() does; if not, finds the
/// active spline and the shown frame again, wherever they are now.
void editor_refresh(struct editor *editor);

/// The last rig was added by the app: it is shown, in the inspector and on the stage.
void editor_show_last(struct editor *editor);

/// Unfolds poles and response in the inspector and scrolls there.
void editor_show_poles(struct editor *editor);

/// Ends any drag where it is: before the app itself makes an edit.
void editor_let_go(struct editor *editor);

/// Sets the path of the document's own file, "" for none (Ctrl+S then asks for one): after saving.
void editor_set_path(struct editor *editor, const char *path);

/// Asks what to do with unsaved work of an earlier run: REQUEST_RECOVER, REQUEST_FORGET, or nothing yet.
void editor_offer_recovery(struct editor *editor, const struct recovery_offer *offer);

/// Shows new users what to try first; and whether that card is still open.
void editor_welcome(struct editor *editor);
bool editor_is_welcoming(const struct editor *editor);

/// The panels' sizes, which the user drags: the stage's share of the height, the inspector's width.
void editor_panels(const struct editor *editor, double *stage_share, double *inspector_width);
void editor_set_panels(struct editor *editor, double stage_share, double inspector_width);

/// Whether it presents (F5): then it wants larger type.
bool editor_is_presenting(const struct editor *editor);
/// What the user has chosen of the scale, for the status line.
void editor_tell_ui_scale(struct editor *editor, double scale);

/// Logical size of the window, and device pixels a logical pixel.
void editor_resize(struct editor *editor, float width, float height, float scale);

/// One event → edits through the history. Events arrive in order; nothing is solved here.
void editor_event(struct editor *editor, const struct event *event);

/// After the frame's events: playback advances by `dt` seconds, running drags (and the grab on the stage) are
/// applied.
void editor_advance(struct editor *editor, double dt);

/// The active spline, or -1.
int editor_active(const struct editor *editor);

/// After the solve: poses rigs, builds this frame's draw list and stage, both valid until the next call. Allocates
/// nothing.
void editor_pose(struct editor *editor);
void editor_show(struct editor *editor);
/// For films: poses the rigs at a frame, on a stage that is all there is, of width × height logical pixels; without the draw list.
void editor_pose_alone(struct editor *editor, double frame, float width, float height);
const struct drawlist *editor_drawlist(const struct editor *editor);
const struct stage_view *editor_stage(const struct editor *editor);

/// Takes what an event has asked for, or an answer; REQUEST_NONE: nothing.
struct request editor_take_request(struct editor *editor);

/// Answers a request, once all that it entails (editor_open(), editor_set_path()) is done; every request gets an answer. If not
/// `ok`, `text` says why. The dialog that asked closes, or shows the sentence so that the user can try again.
void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text);

/// The text that was copied last, or "".
const char *editor_clipboard(const struct editor *editor);

/// Shows a sentence in the status line (an error until the next key or click, else for some seconds of `dt`).
void editor_message(struct editor *editor, bool is_error, const char *text);

/// Whether unsaved work has no recovery file: the status line has a mark for as long as that is so.
void editor_tell_unkept(struct editor *editor, bool unkept);

/// Frames a second and microseconds of solving, for the status line.
void editor_set_stats(struct editor *editor, double fps, double solve_us);

/// The stage's resolution relative to the window's, per side: below 1 the status line says so.
void editor_set_stage_scale(struct editor *editor, float scale);

/// How the knots are shown (V); the app solves as cubic for LOOK_CUBIC.
enum look editor_look(const struct editor *editor);
bool editor_is_playing(const struct editor *editor);
/// Whether something moves by itself, so that the next frame must not wait for an event.
bool editor_wants_frames(const struct editor *editor);
/// Mouse cursor for where the pointer is.
enum mouse_cursor editor_cursor(const struct editor *editor);

/// Finds a replay's target on the screen: "knot(sway,2)", "curve(sway,36,1)", "slider(frequency)",
/// "stage(0.5,0.5)", "tail(tail,0.9)", "warning(0)". false where there is no such thing (with a sentence).
bool editor_target(struct editor *editor, const char *target, float *x, float *y, struct error *error);

#endif
