/// The user's folders for the program's files (XDG base directories).
#ifndef APP_FOLDERS_H
#define APP_FOLDERS_H

#include "base/error.h"
#include <stddef.h>

enum folder {
    FOLDER_CONFIG, ///< $XDG_CONFIG_HOME/wiggly, else ~/.config/wiggly: settings
    FOLDER_STATE,  ///< $XDG_STATE_HOME/wiggly, else ~/.local/state/wiggly: unsaved work
};

/// Writes the folder's path, and makes it and its parents if missing (readable by the user alone). On failure false with a
/// sentence.
bool folder_make(enum folder folder, char *path, size_t size, struct error *error);

#endif
