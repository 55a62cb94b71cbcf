/// State of the overlays and functions their files share. Private to this folder and tests.
#ifndef EDITOR_DIALOGS_STATE_H
#define EDITOR_DIALOGS_STATE_H

#include "editor/core/core.h"
#include "editor/dialogs/dialogs.h"
#include <limits.h>

/// What lists the commands: with their keys (F1), or to run them (F3, or for a place by a right-click).
enum lookup_kind { LOOKUP_NONE, LOOKUP_KEYS, LOOKUP_PALETTE, LOOKUP_MENU };

struct lookup {
    enum lookup_kind kind; ///< the open one
    struct ui_filter filter;
    struct ui_list list;          ///< in rows
    unsigned at;                  ///< F1, menu: enum place under the pointer when it opened
    float corner[2];              ///< menu: where it opened
    int choice;                   ///< the row that Enter runs
    const struct command *chosen; ///< command to run, or NULL
    bool held, moved;             ///< a button is pressed, and has scrolled
    float y;                      ///< scrolled up to here
};

enum dialog_kind {
    DIALOG_NONE,
    DIALOG_OPEN,
    DIALOG_ADD, ///< a path, like DIALOG_OPEN
    DIALOG_SAVE_AS,
    DIALOG_UNSAVED,
    DIALOG_RECOVER,
    DIALOG_CHANGED,
    DIALOG_ASK,
    DIALOG_EXPORT
};

enum { DIALOG_MAX_NAMES = 256, DIALOG_NAME_SIZE = 256, DIALOG_ERROR_SIZE = 400 };

/// A file to choose: one of the listed folder, or a recent one.
struct dialog_match {
    const char *name; ///< or NULL
    const struct dialog_recent *recent;
};

/// The open dialog. Zero: none, and no access to folders.
struct dialog {
    enum dialog_kind kind;
    struct ui ui; ///< its text is the path
    const struct editor_app *app;
    struct question question;  ///< its `choice` is the answer that Enter gives
    struct request after;      ///< runs after saving or discarding, or REQUEST_NONE
    enum request_kind awaited; ///< request that waits for an answer, or REQUEST_NONE
    bool saving;               ///< DIALOG_CHANGED: the user asked to save
    bool skip_text;            ///< ignore the text event of an answer's letter
    char error[DIALOG_ERROR_SIZE];
    char listed[UI_TEXT_SIZE]; ///< folder of `names`, as typed
    char folder[PATH_MAX];     ///< and in full; "": there is none
    char names[DIALOG_MAX_NAMES][DIALOG_NAME_SIZE];
    int name_count; ///< -1: not listed
    struct dialog_recent recent[DIALOG_MAX_RECENT];
    int recent_count;
    struct dialog_match match[DIALOG_MAX_NAMES + DIALOG_MAX_RECENT];
    int match_count;
    int choice; ///< highlighted match (-1: none)
};

struct exporting {
    struct export_memory memory; ///< as edited
    unsigned serial;             ///< of its document
    int format;                  ///< index of the format: by the path's extension, else the last one used
    uint32_t typed;              ///< the field that `ui.text` holds; 0: none
    struct ui_list formats;      ///< the list of them
    bool more;                   ///< with all of them
};

struct dialogs {
    struct core *core;
    const struct command *commands; ///< the table of editor/commands.c
    int command_count;
    struct dialog dialog;
    struct exporting exporting;
    struct lookup lookup;
    bool welcome;     ///< the card for new users is shown
    struct rect card; ///< its rectangle
};

/// Typing searches, arrows choose, the wheel and drags scroll, Esc closes; Enter or a click runs a command. true for keys, text, buttons, drags
/// and wheel while it is open.
bool lookup_event(struct dialogs *dialogs, const struct event *event);
void lookup_show(const struct dialogs *dialogs);

/// A press on the card, Esc, an edit or F1 closes it; true if the event is used.
bool welcome_event(struct dialogs *dialogs, const struct event *event);

#endif
