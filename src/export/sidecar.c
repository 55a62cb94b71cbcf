/// Keeps the files beside another in step with it.
#include "base/need.h"
#include "export/form.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool make_folder(struct sidecars *sidecars, const char *folder, struct error *error)
{
    if (sidecars->folder[0]) return true;
    snprintf(sidecars->folder, sizeof sidecars->folder, "%s", folder);
    sidecars->is_new = mkdir(folder, 0777) == 0;
    if (sidecars->is_new || errno == EEXIST) return true;
    return fail(error, ERROR_ENVIRONMENT, "%s: cannot be made: %s", folder, strerror(errno));
}

bool sidecars_add(struct sidecars *sidecars, const char *folder, const char *name, const void *data, size_t size,
                  struct error *error)
{
    if (!make_folder(sidecars, folder, error)) return false;
    sidecars->files = need_more(sidecars->files, (size_t)sidecars->count + 1, sizeof *sidecars->files);
    struct sidecar *file = &sidecars->files[sidecars->count];
    if (asprintf(&file->path, "%s/%s", folder, name) < 0) need_failed();
    file->is_new = access(file->path, F_OK) != 0;
    if (!file_check_place(file->path, error) || !file_output_open(&file->output, file->path, error)) {
        free(file->path);
        return false;
    }
    sidecars->count++;
    fwrite(data, 1, size, file->output.stream); // whether it could be written is seen as it is committed
    return true;
}

bool sidecars_commit(struct sidecars *sidecars, struct error *error)
{
    for (int i = 0; i < sidecars->count; i++) {
        if (!file_output_commit(&sidecars->files[i].output, error)) return false;
    }
    return true;
}

void sidecars_discard(struct sidecars *sidecars)
{
    for (int i = 0; i < sidecars->count; i++) {
        const bool committed = !sidecars->files[i].output.stream;
        if (!committed) file_output_discard(&sidecars->files[i].output);
        if (committed && sidecars->files[i].is_new) unlink(sidecars->files[i].path);
    }
    if (sidecars->is_new) rmdir(sidecars->folder);
    sidecars_free(sidecars);
}

void sidecars_free(struct sidecars *sidecars)
{
    for (int i = 0; i < sidecars->count; i++) free(sidecars->files[i].path);
    free(sidecars->files);
    *sidecars = (struct sidecars){0};
}
