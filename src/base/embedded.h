/// Contents of the binary: files (shaders, fonts, the default scene), in a table generated at build time, and build information.
#ifndef BASE_EMBEDDED_H
#define BASE_EMBEDDED_H

#include <stddef.h>

struct embedded {
    const char *name; ///< "shaders/tail.vert", "font/label", "font/label-bold", "font/number", "scenes/tail.json",
                      ///< "LICENSE", "licenses/Inter"
    const unsigned char *data; ///< followed by a NUL that size does not count
    size_t size;
};

/// A file that exists.
const struct embedded *embedded_find(const char *name);

/// The next file whose name begins with `folder`, after `previous` or from the start (NULL); NULL after the last.
const struct embedded *embedded_next(const char *folder, const struct embedded *previous);

/// Facts known only at build time; tools/build-info.sh generates the definitions.
extern const char build_commit[];   ///< abbreviated, "-dirty" where the tree was; "unknown" outside git
extern const char build_compiler[]; ///< first line of its --version
extern const char build_flags[];    ///< those that affect the generated code

#endif
