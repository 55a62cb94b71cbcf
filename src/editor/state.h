/// State of the editor, and the table of all commands. Private to src/editor.
#ifndef EDITOR_STATE_H
#define EDITOR_STATE_H

#include "editor/core/core.h"
#include "editor/editor.h"
#include "ui/widgets.h"

/// The last key pressed in this frame. Its text event follows.
struct press {
    bool used;     ///< by a dialog, a drag or a field
    bool repeated; ///< it is kept down
    bool opened;   ///< it opened an overlay, which must not get its text
};

struct editor {
    struct core core;
    struct curves *curves;
    struct stage *stage;
    struct inspector *inspector;
    struct dialogs *dialogs;
    struct ui status; ///< the controls in the status line
    struct press press;
    struct tooltip tooltip;
    struct {
        unsigned serial; ///< of the document
        unsigned active; ///< id of the spline
    } seen;              ///< by the panels
};

/// Carries out a request that leaves the document, after asking about unsaved work. Ends a running edit in the inspector first.
void editor_leave(struct editor *editor, const struct request *request);

/// Draws the status line.
void status_show(struct editor *editor);

/// Sorted by heading, in the order of F1.
extern const struct command commands[];
extern const int command_count;

/// Runs a command even if something it needs is missing; the function then says what.
void command_run(struct editor *editor, const struct command *command);

/// The command of a key with exactly these modifiers, or with CHORD_TYPED of a typed character. Punctuation is matched as a character
/// because its key depends on the layout; what some layouts type only with AltGr also has a key. NULL: none.
const struct command *keys_command(int key, unsigned mods);
/// Keys that work whatever has the focus; true if used.
bool keys_first(struct editor *editor, const struct event *event);
/// true if used.
bool keys_event(struct editor *editor, const struct event *event);

#endif
