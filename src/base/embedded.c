#include "base/embedded.h"
#include <string.h>

/// Made by tools/embed.sh.
extern const struct embedded embedded_files[];
extern const size_t embedded_file_count;

const struct embedded *embedded_find(const char *name)
{
    for (size_t i = 0; i < embedded_file_count; i++) {
        if (strcmp(embedded_files[i].name, name) == 0) return &embedded_files[i];
    }
    return NULL;
}
