/// What stands on the screen.
#ifndef TESTS_SHOWN_H
#define TESTS_SHOWN_H

#include "editor/editor.h"

/// The text that is drawn last of those that read so, hence the dialog's where one is open; NULL if there is none.
const struct draw_command *shown_text(const struct editor *editor, const char *text);

#endif
