/// Keeps the files beside another in step with it.
#include "export/beside.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool make_folder(struct beside *beside, const char *folder, struct error *error)
{
    if (beside->folder[0]) return true;
    snprintf(beside->folder, sizeof beside->folder, "%s", folder);
    beside->is_new = mkdir(folder, 0777) == 0;
    if (beside->is_new || errno == EEXIST) return true;
    return fail(error, ERROR_ENVIRONMENT, "%s: cannot be made: %s", folder, strerror(errno));
}

bool beside_add(struct beside *beside, const char *folder, const char *name, const void *data, size_t size,
                struct error *error)
{
    if (!make_folder(beside, folder, error)) return false;
    struct beside_file *larger = realloc(beside->files, ((size_t)beside->count + 1) * sizeof *larger);
    if (!larger) return fail_no_memory(error, folder);
    beside->files = larger;
    struct beside_file *file = &beside->files[beside->count];
    if (asprintf(&file->path, "%s/%s", folder, name) < 0) return fail_no_memory(error, folder);
    file->is_new = access(file->path, F_OK) != 0;
    if (!file_check_place(file->path, error) || !file_output_open(&file->output, file->path, error)) {
        free(file->path);
        return false;
    }
    beside->count++;
    fwrite(data, 1, size, file->output.stream); // whether it could be written is seen as it is committed
    return true;
}

bool beside_commit(struct beside *beside, struct error *error)
{
    for (int i = 0; i < beside->count; i++) {
        if (!file_output_commit(&beside->files[i].output, error)) return false;
    }
    return true;
}

void beside_discard(struct beside *beside)
{
    for (int i = 0; i < beside->count; i++) {
        const bool committed = !beside->files[i].output.stream;
        if (!committed) file_output_discard(&beside->files[i].output);
        if (committed && beside->files[i].is_new) unlink(beside->files[i].path);
    }
    if (beside->is_new) rmdir(beside->folder);
    beside_free(beside);
}

void beside_free(struct beside *beside)
{
    for (int i = 0; i < beside->count; i++) free(beside->files[i].path);
    free(beside->files);
    *beside = (struct beside){0};
}
