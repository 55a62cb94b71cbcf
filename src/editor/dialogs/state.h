/// What lies over the panels: dialogs, help, the card for newcomers; their state, and what their files give each other. Private to the room,
/// and to tests.
#ifndef EDITOR_DIALOGS_STATE_H
#define EDITOR_DIALOGS_STATE_H

#include "editor/core/command.h"
#include "editor/dialogs/dialogs.h"

/// The table of editor/commands.c.
struct command_list {
    const struct command *commands;
    int count;
};

enum { COMMANDS_MOST = 256 };

/// The commands that match the typed text, the best ones first.
struct commands_found {
    const struct command *list[COMMANDS_MOST];
    const char *missing[COMMANDS_MOST]; ///< as command_missing() says
    int count;
};

/// All keys (F1).
struct help {
    bool open;
    float offset; ///< pixels that it is scrolled by, where the window is too low for all of it
    unsigned at;  ///< place of the pointer when it opened, of enum place
    struct ui_filter filter;
};

/// All commands (F3).
struct palette {
    bool open;
    struct ui_filter filter;
    int choice, first;            ///< the row that Enter runs, the first in sight
    const struct command *chosen; ///< to be run; NULL: none
};

enum dialog_kind {
    DIALOG_NONE,
    DIALOG_OPEN,
    DIALOG_ADD, ///< a path, as the one before
    DIALOG_SAVE_AS,
    DIALOG_UNSAVED,
    DIALOG_RECOVER,
    DIALOG_CHANGED,
    DIALOG_ASK,
    DIALOG_EXPORT
};

enum { DIALOG_MAX_NAMES = 256, DIALOG_NAME_SIZE = 256, DIALOG_ERROR_SIZE = 400 };

/// The dialog on the screen; zero is a valid start (none, no access to folders).
struct dialog {
    enum dialog_kind kind;
    struct ui ui; ///< its text is the path
    struct dialog_files files;
    struct question question;  ///< its `choice` is the one that Enter gives
    struct request after;      ///< request to carry out once the work is saved or discarded, or REQUEST_NONE
    enum request_kind awaited; ///< request without an answer yet, or REQUEST_NONE
    bool saving;               ///< DIALOG_CHANGED: the user has asked to save
    bool skip_text;            ///< a letter has answered: the character that comes with it is no part of a path
    char error[DIALOG_ERROR_SIZE];
    char listed[UI_TEXT_SIZE]; ///< folder whose names are in `names`
    char names[DIALOG_MAX_NAMES][DIALOG_NAME_SIZE];
    int name_count; ///< -1: nothing is listed
    struct dialog_recent recent[DIALOG_MAX_RECENT];
    int recent_count;
    /// Names that begin with the text after the folder; before them, as DIALOG_MAX_NAMES + n, recent files.
    int match[DIALOG_MAX_NAMES + DIALOG_MAX_RECENT];
    int match_count;
    int choice; ///< highlighted match (-1: none), or answer of a question
};

/// The Export dialog: its choices, and the last export.
struct exporting {
    struct export_memory memory; ///< as it is being edited
    unsigned serial;             ///< of the document that it is about
    int format;                  ///< among the dialog's: that of the path's ending, or the last one
    uint32_t typed;              ///< the field whose text is in `ui.text`; 0: none
    const char *dragged;         ///< the number that the pointer drags, and its value before
    double before;
    struct ui_scroll scroll; ///< of the list of formats
    long done, total;
};

/// The last pressed keys, for an audience.
struct pressed {
    char text[64];
    int times;
    double seconds; ///< that it is still shown for
    bool is_down, is_drag;
    enum event_button button;
    float x, y;       ///< of the press
    float pointer[2]; ///< as a demo shows it: it glides where the recording jumps
    bool is_demo;     ///< nobody's hands: the pointer is shown as well
};

struct dialogs {
    struct command_list commands;
    struct dialog dialog;
    struct exporting exporting;
    struct help help;
    struct palette palette;
    struct pressed pressed;
    char caption[160]; ///< of a demo
    bool welcome;      ///< the card for newcomers is shown
    struct rect card;  ///< where it is
};

/// Shows a dialog with a path, or "".
void dialog_open(struct dialogs *dialogs, enum dialog_kind kind, const char *path);
/// Closes whichever is shown.
void dialog_close(struct dialogs *dialogs);
/// Carries out the request that had to wait; REQUEST_OPEN without a path asks for one.
void dialog_go_on(struct dialogs *dialogs, struct core *core, const struct request *after);
/// Asks something of the app; the dialog takes nothing until dialogs_answer().
void dialog_await(struct dialogs *dialogs, struct core *core, enum request_kind kind, const char *path);

/// The Export dialog's keys: true where it has used one. They also come while the app is at work, as all its events do.
bool export_key(struct dialogs *dialogs, struct core *core, int key);
/// Lays it out.
void export_build(struct dialogs *dialogs, struct core *core);

enum { QUESTION_UNUSED = -2, QUESTION_OPEN = -1 };

/// Lays the dialog's question out; returns the answer that was pressed, or QUESTION_OPEN.
int question_build(struct dialog *dialog);
/// Effect of a key: an answer, QUESTION_OPEN where it moved the choice, or QUESTION_UNUSED.
int question_key(struct dialog *dialog, int key);

/// The commands that fit, those that can be done now before others that fit as well. Without `core`: all rows of F1, in their order.
void commands_find(const struct command_list *commands, const struct core *core, const struct ui_filter *filter,
                   struct commands_found *found);
/// A text field with its text, or a hint.
void commands_show_field(struct drawlist *list, struct rect r, const struct ui_filter *filter, const char *empty);

/// Typing searches; wheel, ↑ ↓ and PgUp PgDn scroll; Esc, Enter or a click closes it. While it is open help_event() is true for keys,
/// text, buttons and the wheel.
bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event);
/// Draws it, where it is open.
void help_show(const struct dialogs *dialogs, struct core *core);

/// Typing searches; ↑ ↓ and the wheel choose; Enter or a click runs a command; Esc closes it. While it is open palette_event() is true for
/// keys, text, buttons and the wheel.
bool palette_event(struct dialogs *dialogs, const struct core *core, const struct event *event);
/// Draws it, where it is open.
void palette_show(const struct dialogs *dialogs, struct core *core);

/// A press on the card takes it away and is used up; so do Esc, an edit and the help.
bool welcome_event(struct dialogs *dialogs, const struct event *event);

/// Whether an event is for a page that one types on. Pointer movements are not, nor releases of keys that were pressed before it opened.
static inline bool typing_concerns(const struct event *event)
{
    const bool release = event->kind == EVENT_KEY && event->action == ACTION_RELEASE;
    return !release && event->kind != EVENT_POINTER && event->kind <= EVENT_WHEEL;
}

#endif
