/// The F1 overlay and the card for new users. docs/keys.md is the full table of keys.
#ifndef EDITOR_DIALOGS_HELP_H
#define EDITOR_DIALOGS_HELP_H

#include "editor/dialogs/state.h"

/// F1 opens it; wheel, ↑ ↓ and PgUp PgDn scroll it; any other key or a click closes it. While it is open help_event() is true
/// for keys, text, buttons and the wheel.
bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event, bool busy);
/// Draws it, where it is open.
void help_show(const struct dialogs *dialogs, struct core *core);

enum { HELP_MAX_ROWS = 14, HELP_GROUPS = 10, HELP_HELD = 5 };

/// Keys are separated by ", ", "; " or two spaces; one without Ctrl+ or Shift+ may share that of the key before it.
struct help_row {
    const char *keys, *what;
};

struct help_group {
    const char *title;
    struct help_row rows[HELP_MAX_ROWS]; ///< up to the first without keys
};

extern const struct help_group help_groups[HELP_GROUPS];

/// A row of a group, from 0; without keys beyond the last one. HELP_HELD begins with the letters of the parameters.
struct help_row help_row(const struct help_group *group, int index);

/// A press on the card takes it away and is used up; so do Esc, an edit and the help.
bool welcome_event(struct dialogs *dialogs, const struct event *event);

#endif
