/// The scenes that come with the running program: those of the tree that it was built in, or of its installation.
#ifndef APP_ASSETS_H
#define APP_ASSETS_H

#include "base/file.h"
#include <stdbool.h>

/// The folder of these scenes. false if the program stands alone.
bool assets_folder(char folder[PATH_LIMIT]);

/// Whether a file (after following links) is in that folder.
bool assets_has(const char *path);

#endif
