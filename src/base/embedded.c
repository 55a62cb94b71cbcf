/// Looks up files built into the program.
#include "base/embedded.h"
#include <assert.h>
#include <string.h>

/// Made by tools/embed.sh.
extern const struct embedded embedded_files[];
extern const size_t embedded_file_count;

const struct embedded *embedded_find(const char *name)
{
    const struct embedded *file = embedded_files;
    for (; strcmp(file->name, name) != 0; file++) assert(file + 1 < embedded_files + embedded_file_count);
    return file;
}

const struct embedded *embedded_next(const char *folder, const struct embedded *previous)
{
    const struct embedded *file = previous ? previous + 1 : embedded_files,
                          *end = embedded_files + embedded_file_count;
    while (file < end && strncmp(file->name, folder, strlen(folder)) != 0) file++;
    return file < end ? file : NULL;
}
