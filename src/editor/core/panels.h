/// The panels around the curves and the stage: inspector, status line, help and dialogs. Internal to src/editor.
///
/// Who gets an event, in this order: dialog_event(), help_event(), then, unless a drag of the editor's own runs,
/// inspector_event(), then the editor. Each returns true where it used the event up. That is the focus rule: a field that is
/// typed in takes all keys but Ctrl chords and F keys, a focused slider takes the arrows, Enter and digits, an open dialog all.
#ifndef EDITOR_CORE_PANELS_H
#define EDITOR_CORE_PANELS_H

#include "editor/dialogs/dialog_files.h"
#include "editor/editor.h"
#include "editor/inspector/poles.h"
#include "ui/widgets.h"

enum { INSPECTOR_MAX_SECTIONS = 16 };

/// What the list of the history's steps shows.
struct history_view {
    size_t top;         ///< its first row
    size_t count, done; ///< of the history, when it was last laid out
};

/// The inspector's own view state; zero is a valid start.
struct inspector {
    struct ui ui;
    struct ui_scroll scroll;
    bool flipped[INSPECTOR_MAX_SECTIONS]; ///< sections that are not as they are at first, open or closed
    int tail, channel;                    ///< shown under "Tail"
    const char *dragged_name;             ///< number of the scene that is being dragged
    double dragged;                       ///< what it would be; of several knots, what was last possible
    struct poles_view poles;
    struct history_view history;
};

/// A new document is on the table: forgets focus, running drag (without touching the history), scrolling and channel.
void inspector_reset(struct editor *editor);
/// Opens the section of that name ("section.poles").
void inspector_unfold(struct editor *editor, const char *name);
bool inspector_event(struct editor *editor, const struct editor_world *world, const struct event *event);
void inspector_show(struct editor *editor, const struct editor_world *world);
/// Ends a running drag where it is, and drops focus and typing: something opens over the panel, or the document goes.
void inspector_let_go(struct editor *editor, const struct editor_world *world);
/// Whether a slider is being dragged (a history step is open) or a value is being typed.
bool inspector_is_dragging(const struct editor *editor);
bool inspector_is_typing(const struct editor *editor);
/// F2: the active spline's name can be typed.
void inspector_rename(struct editor *editor, const struct editor_world *world);
/// A sentence on what the pointer is over in the inspector, or NULL.
const char *inspector_hint(const struct editor *editor);
/// Where the widget `name` is: "frequency", "frequency,2.5" (where its bar shows 2.5), "mode.real", "spline.sway",
/// "channel.0", "look.stiff", "section.knot". false where it is not shown or scrolled out of sight.
bool inspector_target(struct editor *editor, const struct editor_world *world, const char *name, float *x, float *y);

/// A card on the stage with what to try first. A press on it takes it away and is used up; so do Esc, an edit and the help.
bool welcome_event(struct editor *editor, const struct event *event);
struct rect welcome_card(const struct editor *editor);
void welcome_show(struct editor *editor, const struct editor_world *world);

/// What the scene is about, in the upper left corner of the stage: up to the first full stop as a title.
void caption_show(struct editor *editor, const struct document *document);

/// The right end of the status line; zero is a valid start.
struct status {
    double age;           ///< seconds since the figures were taken over
    double fps, solve_us; ///< as shown
    long dropped;
};

/// Time passes (editor_advance): the figures change at most twice a second, so that they cost no redraws.
void status_advance(struct editor *editor, double dt);
void status_show(struct editor *editor, const struct editor_world *world);

struct help {
    bool open;
    float offset; ///< pixels that it is scrolled by, where the window is too low for all of it
};

/// F1 opens it; wheel, ↑ ↓ and PgUp PgDn scroll it; any other key or a click closes it. While it is open help_event() is true
/// for keys, text, buttons and the wheel.
bool help_event(struct editor *editor, const struct event *event);
void help_show(struct editor *editor);

enum dialog_kind { DIALOG_NONE, DIALOG_OPEN, DIALOG_SAVE_AS, DIALOG_UNSAVED, DIALOG_RECOVER, DIALOG_ASK };

enum { DIALOG_MAX_NAMES = 256, DIALOG_NAME_SIZE = 256, DIALOG_ERROR_SIZE = 400 };

struct answer {
    const char *name;  ///< of its button
    const char *label; ///< on it
    int key;           ///< letter that answers as well
};

/// The last answer is the one that changes nothing; Esc gives it. The dialog's `choice` is the one Enter gives.
struct question {
    char title[320];
    char note[256]; ///< below it, unless the dialog has an error to show
    const struct answer *answers;
    int count;
};

/// An edit that is asked about (DIALOG_ASK); ASK_REMOVE is about the active spline.
struct ask {
    enum { ASK_FPS, ASK_RANGE, ASK_REMOVE } kind;
    double number;
    int first, last;
};

/// The dialog on the screen; zero is a valid start (none, no access to folders).
struct dialog {
    enum dialog_kind kind;
    struct ui ui; ///< its text is the path
    struct dialog_files files;
    struct recovery_offer offer; ///< of DIALOG_RECOVER
    struct ask ask;              ///< of DIALOG_ASK, and its question
    struct question question;
    struct request after;      ///< what to do once the work is saved or discarded; REQUEST_NONE: nothing
    enum request_kind awaited; ///< what was requested and is not answered yet; REQUEST_NONE: nothing
    bool skip_text;            ///< a letter has answered: the character that comes with it is no part of a path
    char error[DIALOG_ERROR_SIZE];
    char listed[UI_TEXT_SIZE]; ///< folder whose names are in `names`
    char names[DIALOG_MAX_NAMES][DIALOG_NAME_SIZE];
    int name_count; ///< -1: nothing is listed
    struct dialog_recent recent[DIALOG_MAX_RECENT];
    int recent_count;
    /// Names that begin with what is typed after the folder; before them, as DIALOG_MAX_NAMES + n, recent files.
    int match[DIALOG_MAX_NAMES + DIALOG_MAX_RECENT];
    int match_count;
    int choice; ///< highlighted match (-1: none), or answer of a question
};

void dialog_ask_open(struct editor *editor);
void dialog_ask_save_as(struct editor *editor);
/// Asks before an edit.
void dialog_ask(struct editor *editor, const struct editor_world *world, const struct ask *ask);
/// Does `after` (REQUEST_NEW, REQUEST_OPEN with a path, or without: asks for one, REQUEST_QUIT), but asks first where work
/// would be lost: Save, Discard, Cancel. `after` then follows only when the save has succeeded.
void dialog_leave(struct editor *editor, const struct editor_world *world, const struct request *after);
/// The app's answer to what the dialog has asked for: it closes and goes on with `after`, or stays and says why not. false
/// where it waits for no such answer.
bool dialog_answer(struct editor *editor, const struct request *request, bool ok, const char *text);

/// true for every event while a dialog is open, but for EVENT_SIZE and EVENT_EXPOSE.
bool dialog_event(struct editor *editor, const struct editor_world *world, const struct event *event);
void dialog_show(struct editor *editor, const struct editor_world *world);

#endif
