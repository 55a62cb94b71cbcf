/// Files in a folder of their own beside the one that is written: all of them are there in the end, or none. Private to src/export.
#ifndef EXPORT_BESIDE_H
#define EXPORT_BESIDE_H

#include "base/file.h"
#include "base/path.h"
#include <stdbool.h>

/// All zero at first.
struct beside {
    struct beside_file {
        struct file_output output;
        char *path;
        bool is_new; ///< none was there before
    } * files;
    int count;
    char folder[PATH_LIMIT];
    bool is_new; ///< so is the folder
};

/// Writes a file of a folder into a temporary one. False with a sentence.
bool beside_add(struct beside *beside, const char *folder, const char *name, const void *data, size_t size,
                struct error *error);

/// Gives all files their names. False with a sentence, and what was there before is there still.
bool beside_commit(struct beside *beside, struct error *error);

/// Removes what was written, committed or not, unless it has replaced something.
void beside_discard(struct beside *beside);

/// Keeps what was committed.
void beside_free(struct beside *beside);

#endif
