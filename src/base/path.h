/// Paths relative to a folder. Absolute paths stay as they are; "" and NULL mean the working folder.
#ifndef BASE_PATH_H
#define BASE_PATH_H

#include <stdbool.h>

enum { PATH_LIMIT = 4096 }; ///< bytes of a path, with its end

/// The folder of a file: "a/b.json" → "a", "b.json" → "". false if it is too long.
bool path_folder(const char *path, char folder[PATH_LIMIT]);

/// The name of a file or folder: "a/b.json" → "b.json".
const char *path_name(const char *path);

/// The absolute path, without "." and "..", of a file named from a folder. Symbolic links in the folder's path are
/// followed where it exists. false where it is too long.
bool path_resolve(const char *folder, const char *path, char absolute[PATH_LIMIT]);

/// Rewrites a path relative to one folder as a path relative to another. false if nothing changes or the path is too long.
bool path_rebase(const char *path, const char *from, const char *to, char moved[PATH_LIMIT]);

/// The same in place, of a path that malloc() made or NULL. false if memory runs out.
bool path_move(char **path, const char *from, const char *to);

/// Whether a file's name ends so, as ".glb", in small letters or capitals.
bool path_has_end(const char *path, const char *end);

#endif
