/// Paths of files that are named relative to a folder. Absolute paths stay as they are; "" and NULL are the working folder.
#ifndef BASE_PATH_H
#define BASE_PATH_H

#include <stdbool.h>

enum { PATH_LIMIT = 4096 }; ///< bytes of a path, with its end

/// The folder that a file is in, with all but the last name of its path: "a/b.json" → "a", "b.json" → "". false where
/// it is too long.
bool path_folder(const char *path, char folder[PATH_LIMIT]);

/// The absolute path, without "." and "..", of a file named from a folder. Symbolic links in the folder's path are
/// followed where it exists. false where it is too long.
bool path_resolve(const char *folder, const char *path, char absolute[PATH_LIMIT]);

/// How a file that is named from one folder is named from another. false where nothing changes or the path is too long.
bool path_rebase(const char *path, const char *from, const char *to, char moved[PATH_LIMIT]);

#endif
