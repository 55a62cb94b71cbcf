/// The table of everything that can be done. Private to src/editor.
#ifndef EDITOR_COMMANDS_H
#define EDITOR_COMMANDS_H

#include "editor/core/command.h"

/// Under each heading in the order in which F1 lists them.
extern const struct command commands[];
extern const int command_count;

/// Runs a command. A key runs it whatever it needs; the function then says what is missing.
void command_run(struct editor *editor, const struct command *command);

#endif
