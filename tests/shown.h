/// Texts on the screen.
#ifndef TESTS_SHOWN_H
#define TESTS_SHOWN_H

#include "editor/state.h"

/// The last drawn text with this content (a dialog's, if one is open), or NULL.
const struct draw_command *shown_text(const struct editor *editor, const char *text);

#endif
