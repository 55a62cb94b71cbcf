/// Where the user's own files of the program are (XDG base directories).
#ifndef APP_FOLDERS_H
#define APP_FOLDERS_H

#include "base/error.h"
#include <stddef.h>

enum folder {
    FOLDER_CONFIG, ///< $XDG_CONFIG_HOME/wiggly, else ~/.config/wiggly: settings
    FOLDER_STATE,  ///< $XDG_STATE_HOME/wiggly, else ~/.local/state/wiggly: unsaved work
};

/// Writes the folder's path and makes it, with those above, where it is missing (for the user alone). false with a
/// sentence where that is not possible.
bool folder_make(enum folder folder, char *path, size_t size, struct error *error);

#endif
