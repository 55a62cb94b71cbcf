/// The one list of what the live app answers to, for the overlay (F1); the README's is made after it.
#ifndef EDITOR_DIALOGS_HELP_ROWS_H
#define EDITOR_DIALOGS_HELP_ROWS_H

enum { HELP_MAX_ROWS = 12, HELP_GROUPS = 10, HELP_HELD = 5 };

/// Keys are separated by ", ", "; " or two spaces; one without a Ctrl+ or Shift+ of its own may have that of the one before it.
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
