/// A film as numbered pictures, written to a temporary folder and moved out when complete.
#include "app/film_file.h"
#include "base/file.h"
#include "base/need.h"
#include "base/png.h"
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct film_file {
    struct film_shape shape;
    const char *path;
    int before, digits; ///< bytes of the path before the number; least number of digits; −1: no number
    const char *after;  ///< the path after the number
    char *folder;       ///< temporary
    int lock;           ///< descriptor of the folder's lock
    long written;
};

/// Splits the path at its "%04d", or before ".png" if there is more than one picture.
static bool split(struct film_file *file, struct error *error)
{
    const char *path = file->path, *name = path_name(path);
    const char *sign = strchr(name, '%');
    file->digits = -1;
    file->before = (int)(strlen(path) - strlen(".png"));
    file->after = path + file->before;
    if (!sign) {
        if (file->shape.count > 1) file->digits = 4;
        return true;
    }
    int digits = 1, length = 0;
    if (isdigit((unsigned char)sign[1])) sscanf(sign + 1, "%9d%n", &digits, &length);
    const char *end = sign + 1 + length;
    if (*end != 'd' || digits > 9 || strchr(end, '%'))
        return fail(error, ERROR_USAGE, "%s: expected one number in the name, as in walk-%%04d.png", path);
    file->before = (int)(sign - path);
    file->digits = digits;
    file->after = end + 1;
    return true;
}

static bool name_picture(const struct film_file *file, long number, char name[PATH_LIMIT])
{
    int length = file->digits < 0 ? snprintf(name, PATH_LIMIT, "%s", file->path)
                                  : snprintf(name, PATH_LIMIT, "%.*s%s%0*ld%s", file->before, file->path,
                                             strchr(file->path, '%') ? "" : "-", file->digits, number, file->after);
    return length < PATH_LIMIT;
}

static bool name_temporary(const struct film_file *file, long number, char name[PATH_LIMIT])
{
    return snprintf(name, PATH_LIMIT, "%s/%ld.png", file->folder, number) < PATH_LIMIT;
}

/// Whether all places are free, before anything is drawn.
static bool check_places(const struct film_file *file, struct error *error)
{
    for (long n = 1; n <= file->shape.count; n++) {
        char name[PATH_LIMIT];
        if (name_picture(file, n, name) && !file_check_place(name, error)) return false;
    }
    return true;
}

static struct film_file *open_pictures(const char *path, const struct film_shape *shape, struct error *error)
{
    struct film_file *file = need_zeroed(1, sizeof *file);
    file->path = path;
    file->shape = *shape;
    if (split(file, error) && check_places(file, error)) {
        file->lock = file_folder_beside(path, &file->folder);
        if (file->lock >= 0) return file;
        fail(error, ERROR_ENVIRONMENT, "%s: cannot be written: %s", path, strerror(errno));
    }
    free(file);
    return NULL;
}

static enum film_state put(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error)
{
    char name[PATH_LIMIT];
    (void)wait;
    if (!name_temporary(file, file->written + 1, name)) {
        fail(error, ERROR_INPUT, "%s: the path is too long", file->path);
        return FILM_FAILED;
    }
    struct error inner;
    if (!png_write(name, file->shape.width, file->shape.height, pixels, &inner)) {
        // The user knows the path, not the temporary folder.
        const bool named = strncmp(inner.text, name, strlen(name)) == 0;
        fail(error, inner.kind, "%s%s", file->path, named ? inner.text + strlen(name) : ": cannot be written");
        return FILM_FAILED;
    }
    file->written++;
    return FILM_DONE;
}

static enum film_state finish(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    (void)wait;
    *bytes = 0;
    for (long n = 1; n <= file->written; n++) {
        char from[PATH_LIMIT], to[PATH_LIMIT];
        struct stat about;
        if (!name_temporary(file, n, from) || !name_picture(file, n, to)) {
            fail(error, ERROR_INPUT, "%s: the path is too long", file->path);
            return FILM_FAILED;
        }
        if (stat(from, &about) == 0) *bytes += about.st_size;
        if (!file_move(from, to, error)) return FILM_FAILED;
    }
    return FILM_DONE;
}

static void close_pictures(struct film_file *file)
{
    char name[PATH_LIMIT];
    for (long n = 1; n <= file->written; n++) {
        if (name_temporary(file, n, name)) unlink(name);
    }
    rmdir(file->folder);
    close(file->lock);
    free(file->folder);
    free(file);
}

const struct film_file_kind film_png = {open_pictures, put, finish, close_pictures};
