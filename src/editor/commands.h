/// The table of all commands, and their keys. Private to src/editor.
#ifndef EDITOR_COMMANDS_H
#define EDITOR_COMMANDS_H

#include "editor/core/command.h"
#include "editor/editor.h"

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
