/// Keeps models by path.
#include "rig/model_files.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// A file that was read, and its state at that time.
struct model_file {
    char *path; ///< absolute
    struct timespec changed;
    off_t size;
    enum model_kind kind;
    union {
        struct figure figure;
        struct imported imported;
    };
};

static void file_destroy(struct model_file *file)
{
    if (!file) return;
    if (file->kind == MODEL_FIGURE) {
        figure_free(&file->figure);
    } else {
        imported_free(&file->imported);
    }
    free(file->path);
    free(file);
}

void model_files_free(struct model_files *files)
{
    for (int i = 0; i < files->count; i++) file_destroy(files->files[i]);
    free(files->files);
    *files = (struct model_files){0};
}

static bool is_current(const struct model_file *file, const struct stat *about)
{
    return file->size == about->st_size && file->changed.tv_sec == about->st_mtim.tv_sec &&
           file->changed.tv_nsec == about->st_mtim.tv_nsec;
}

static int find_file(const struct model_files *files, const char *path, enum model_kind kind)
{
    for (int i = 0; i < files->count; i++) {
        if (files->files[i]->kind == kind && strcmp(files->files[i]->path, path) == 0) return i;
    }
    return -1;
}

static bool read_figure(struct figure *figure, const char *path, struct error *error)
{
    struct character character = {0};
    if (!character_read(path, &character, error)) return false;
    if (!figure_has_room(&character)) {
        character_free(&character);
        return fail_no_memory(error, path);
    }
    figure_create(figure, &character);
    return true;
}

static struct model_file *read_file(const char *path, enum model_kind kind, struct error *error)
{
    struct model_file *file = need_zeroed(1, sizeof *file);
    file->path = need_text(path);
    file->kind = kind;
    if (kind == MODEL_FIGURE ? read_figure(&file->figure, path, error) : imported_read(&file->imported, path, error))
        return file;
    file_destroy(file);
    return NULL;
}

/// Puts a file that was read in the place of an older one, or (`at` −1) adds it.
static void keep(struct model_files *files, int at, struct model_file *file)
{
    if (at >= 0) {
        file_destroy(files->files[at]);
        files->files[at] = file;
        return;
    }
    files->files = need_more(files->files, (size_t)files->count + 1, sizeof *files->files);
    files->files[files->count++] = file;
}

/// The model in a file, read again only if the file has changed; NULL with a sentence.
static const struct model_file *obtain(struct model_files *files, const char *path, enum model_kind kind,
                                       struct error *error)
{
    struct stat about = {0};
    bool is_there = stat(path, &about) == 0;
    int at = find_file(files, path, kind);
    if (at >= 0 && is_there && is_current(files->files[at], &about)) return files->files[at];
    struct model_file *file = read_file(path, kind, error);
    if (!file) return NULL;
    file->changed = about.st_mtim;
    file->size = about.st_size;
    keep(files, at, file);
    return file;
}

const struct figure *model_files_figure(struct model_files *files, const char *path, struct error *error)
{
    const struct model_file *file = obtain(files, path, MODEL_FIGURE, error);
    return file ? &file->figure : NULL;
}

const struct imported *model_files_imported(struct model_files *files, const char *path, struct error *error)
{
    const struct model_file *file = obtain(files, path, MODEL_IMPORTED, error);
    return file ? &file->imported : NULL;
}
