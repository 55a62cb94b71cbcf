/// Files that are part of the binary: shaders, fonts, the default scene. The table is generated at build time.
#ifndef BASE_EMBEDDED_H
#define BASE_EMBEDDED_H

#include <stddef.h>

struct embedded {
    const char *name; ///< "shaders/tail.vert", "font/label", "font/label-bold", "font/number", "scenes/tail.json",
                      ///< "LICENSE", "licenses/Inter"
    const unsigned char *data; ///< followed by a NUL that size does not count
    size_t size;
};

/// NULL where there is no such file.
const struct embedded *embedded_find(const char *name);

/// The next file whose name begins with `folder`, after `previous` or from the start (NULL); NULL after the last.
const struct embedded *embedded_next(const char *folder, const struct embedded *previous);

#endif
