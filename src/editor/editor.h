/// The editor: events → edit operations and view state → draw list and stage. No GL, no windows, no files.
#ifndef EDITOR_EDITOR_H
#define EDITOR_EDITOR_H

#include "editor/core/core.h"
#include "editor/dialogs/dialogs.h"
#include "ui/tooltip.h"

/// The last key pressed in this frame; its character comes next.
struct press {
    bool used;     ///< a dialog, a drag or a field has used it
    bool repeated; ///< it is kept down
    bool opened;   ///< it opened something over the panels, which does not get the character
};

/// The shared state, and each panel's own.
struct editor {
    struct core core; ///< editor_show() fills `list`
    struct curves *curves;
    struct stage *stage;
    struct inspector *inspector;
    struct dialogs *dialogs;
    struct press press;
    struct tooltip tooltip;
    struct {
        unsigned serial; ///< of the document
        unsigned active; ///< id of the spline
    } seen;              ///< that the panels were last told of
    bool fitted;         ///< camera and curves view, at the first editor_pose() of a document
};

struct editor *editor_create(void);
void editor_destroy(struct editor *editor);

/// A new document is on the table, and what is here is worked on until the next one is: it is not copied. Selection, view and playhead
/// start anew; the camera is fitted to the motion at the first editor_pose(). The first spline that moves a tail is active.
void editor_open(struct editor *editor, const struct editor_world *world);

/// Brings the editor up to date after each edit, undo and redo, before anything else is done with the document. If another
/// document has taken its place (a figure, or its undo: document.serial), starts anew as editor_open() does; if not, finds the
/// active spline and the shown frame again, wherever they are now.
void editor_refresh(struct editor *editor);
/// After each event and edit: the panels follow another document and another active spline.
void editor_settle(struct editor *editor);

/// The last rig was added by the app: it is shown, in the inspector and on the stage.
void editor_show_last(struct editor *editor);

/// Unfolds poles and response in the inspector and scrolls there.
void editor_show_poles(struct editor *editor);

/// Ends any drag where it is: before the app itself makes an edit.
void editor_let_go(struct editor *editor);
/// Carries out a request that leaves the document, but asks first where work would be lost.
void editor_leave(struct editor *editor, const struct request *request);

/// Logical size of the window, and device pixels a logical pixel.
void editor_resize(struct editor *editor, float width, float height, float scale);

/// One event → edits through the history. Events arrive in order; nothing is solved here.
void editor_event(struct editor *editor, const struct event *event);

/// After the frame's events: playback advances by `dt` seconds, running drags (and the grab on the stage) are
/// applied.
void editor_advance(struct editor *editor, double dt);

/// After the solve: poses rigs, builds this frame's draw list and stage, both valid until the next call. Allocates
/// nothing.
void editor_pose(struct editor *editor);
void editor_show(struct editor *editor);
/// For films: poses the rigs at a frame, on a stage that is all there is, of width × height logical pixels; without the draw list.
void editor_pose_alone(struct editor *editor, double frame, float width, float height);
const struct stage_view *editor_stage(const struct editor *editor);

/// Takes the request of an event or an answer; REQUEST_NONE: none.
struct request editor_take_request(struct editor *editor);

/// Answers a request, once all that it entails (editor_open(), core_set_path()) is done; every request gets an answer. If not
/// `ok`, `text` says why. The dialog that asked closes, or shows the sentence so that the user can try again.
void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text);

/// Whether unsaved work has no recovery file: the status line has a mark for as long as that is so.
void editor_tell_unkept(struct editor *editor, bool unkept);

/// Whether something moves by itself, so that the next frame must not wait for an event.
bool editor_wants_frames(const struct editor *editor);
/// Mouse cursor for where the pointer is.
enum mouse_cursor editor_cursor(const struct editor *editor);

/// Finds a replay's target on the screen: "knot(sway,2)", "curve(sway,36,1)", "slider(frequency)",
/// "stage(0.5,0.5)", "tail(tail,0.9)", "warning(0)". false where there is no such thing (with a sentence).
bool editor_target(struct editor *editor, const char *target, float *x, float *y, struct error *error);

#endif
