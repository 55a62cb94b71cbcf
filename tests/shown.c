/// Finds a text in what the editor has drawn.
#include "shown.h"
#include <string.h>

const struct draw_command *shown_text(const struct editor *editor, const char *text)
{
    const struct drawlist *list = &editor->core.list;
    for (int i = list->count - 1; i >= 0; i--) {
        const struct draw_command *command = &list->commands[i];
        if (command->kind == DRAW_TEXT && strcmp(list->text + command->first, text) == 0) return command;
    }
    return NULL;
}
