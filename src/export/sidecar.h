/// Files in a folder of their own beside the one that is written: all of them are there in the end, or none. Private to src/export.
#ifndef EXPORT_SIDECAR_H
#define EXPORT_SIDECAR_H

#include "base/file.h"
#include <stdbool.h>

/// All zero at first.
struct sidecars {
    struct sidecar {
        struct file_output output;
        char *path;
        bool is_new; ///< none was there before
    } * files;
    int count;
    char folder[PATH_LIMIT];
    bool is_new; ///< so is the folder
};

/// Writes a file of a folder into a temporary one. False with a sentence.
bool sidecars_add(struct sidecars *sidecars, const char *folder, const char *name, const void *data, size_t size,
                  struct error *error);

/// Gives all files their names. False with a sentence, and what was there before is there still.
bool sidecars_commit(struct sidecars *sidecars, struct error *error);

/// Removes what was written, committed or not, unless it has replaced something.
void sidecars_discard(struct sidecars *sidecars);

/// Keeps what was committed.
void sidecars_free(struct sidecars *sidecars);

#endif
