/// The table of all commands. Private to src/editor.
#ifndef EDITOR_COMMANDS_H
#define EDITOR_COMMANDS_H

#include "editor/core/command.h"

/// Sorted by heading, in the order of F1.
extern const struct command commands[];
extern const int command_count;

/// Runs a command even if something it needs is missing; the function then says what.
void command_run(struct editor *editor, const struct command *command);

#endif
