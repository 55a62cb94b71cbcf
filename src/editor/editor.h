/// The editor turns events into edits and view state, and those into a draw list and a stage. It knows no GL, windows or files.
#ifndef EDITOR_EDITOR_H
#define EDITOR_EDITOR_H

#include "editor/core/app.h"
#include "editor/dialogs/dialogs.h"
#include "ui/stage.h"

struct editor;

/// Copies `app`; NULL: there is none.
struct editor *editor_create(const struct editor_app *app);
void editor_destroy(struct editor *editor);

/// Starts on a new document, which is not copied. Resets selection, view and playhead; the first editor_pose() fits the camera. The first
/// spline that moves a tail becomes active.
void editor_open(struct editor *editor, const struct editor_world *world);

/// Call after each edit of the app. If the document was replaced (document.serial changed), starts anew like editor_open(); else finds
/// the active spline and the shown frame again.
void editor_refresh(struct editor *editor);

/// Shows the rig the app added last, in the inspector and on the stage.
void editor_show_last(struct editor *editor);

/// Shows poles and response above the inspector's sections, or the phase curve, until another scene opens.
void editor_show_subject(struct editor *editor, bool poles, bool phase);

/// Ends any drag, before the app edits.
void editor_let_go(struct editor *editor);

/// Logical size of the window, and device pixels per logical pixel.
void editor_resize(struct editor *editor, float width, float height, float scale);

/// Turns an event into edits. Solves nothing.
void editor_event(struct editor *editor, const struct event *event);

/// Call after the frame's events: playback advances by `dt` seconds and running drags are applied.
void editor_advance(struct editor *editor, double dt);

/// Call after the solve: poses the rigs and builds draw list and stage, valid until the next call. Allocates nothing.
void editor_pose(struct editor *editor);
void editor_show(struct editor *editor);
/// For films: poses the rigs at a frame on a stage of width × height logical pixels, without a draw list.
void editor_pose_alone(struct editor *editor, double frame, float width, float height);
const struct stage_view *editor_stage(const struct editor *editor);

/// Answers a request once it is done; every request gets an answer. If not `ok`, `text` says why. The dialog that asked closes, or shows
/// the text so that the user can try again.
void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text);

/// Shows a message in the status line: an error until the next key or click, others for some seconds.
void editor_message(struct editor *editor, bool is_error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// For what the app asks of the user.
struct dialogs *editor_dialogs(struct editor *editor);

/// What the user chose for all scenes.
struct editor_choices {
    double stage_share, inspector_width; ///< of the panels, see struct layout
    bool more;                           ///< the inspector shows all sections
    bool keep;                           ///< an edit leaves what follows as it is
    bool is_welcomed;                    ///< the card for new users was closed
};
struct editor_choices editor_choices(const struct editor *editor);
void editor_choose(struct editor *editor, const struct editor_choices *choices);

/// What the app must know of it.
struct editor_shown {
    const struct drawlist *list; ///< of the last editor_show()
    enum look look;
    bool plays;
};
struct editor_shown editor_shown(const struct editor *editor);

/// In a browser: whether a key is the app's. Tab leaves the page after the inspector's last field, and before its first with Shift.
bool editor_keeps(const struct editor *editor, int key, unsigned mods);
/// Whether something is moving, so that the next frame must not wait for an event.
bool editor_wants_frames(const struct editor *editor);
enum mouse_cursor editor_cursor(const struct editor *editor);

/// Finds a replay's target on the screen, as in "knot(sway,2)", "curve(sway,36,1)", "slider(frequency)", "tail(tail,0.9)". false with an
/// error if there is none.
bool editor_target(struct editor *editor, const char *target, float *x, float *y, struct error *error);

#endif
