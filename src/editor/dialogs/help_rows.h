/// What the F1 overlay lists. docs/keys.md is the full table.
#ifndef EDITOR_DIALOGS_HELP_ROWS_H
#define EDITOR_DIALOGS_HELP_ROWS_H

enum { HELP_MAX_ROWS = 12, HELP_GROUPS = 10, HELP_HELD = 5 };

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

#endif
