/// Makes paint and changes it.
#include "base/need.h"
#include "scene/character.h"
#include <stdlib.h>
#include <string.h>

/// Gives it another version: its values have changed.
static void touch(struct paint *paint)
{
    static uint64_t last;
    paint->version = ++last;
}

struct paint *paint_create(int coordinates, int vertices)
{
    struct paint *paint = need_zeroed(1, sizeof *paint);
    atomic_init(&paint->holders, 1);
    paint->coordinates = coordinates;
    paint->vertices = vertices;
    paint->values = need_zeroed((size_t)coordinates * (size_t)vertices, sizeof *paint->values);
    touch(paint);
    return paint;
}

struct paint *paint_hold(struct paint *paint)
{
    if (paint) atomic_fetch_add(&paint->holders, 1);
    return paint;
}

void paint_drop(struct paint *paint)
{
    if (!paint || atomic_fetch_sub(&paint->holders, 1) > 1) return;
    free(paint->values);
    free(paint);
}

bool paint_is_plain(const struct paint *paint)
{
    const size_t count = (size_t)paint->coordinates * (size_t)paint->vertices;
    for (size_t i = 0; i < count; i++) {
        if (paint->values[i][0] != 0 || paint->values[i][1] != 0) return false;
    }
    return true;
}

size_t paint_bytes(const struct paint *paint)
{
    if (!paint) return 0;
    return sizeof *paint + (size_t)paint->coordinates * (size_t)paint->vertices * sizeof *paint->values;
}

static struct paint *copy_of(const struct paint *paint)
{
    struct paint *copy = need(1, sizeof *copy);
    const size_t size = paint_bytes(paint) - sizeof *paint;
    *copy = *paint;
    atomic_init(&copy->holders, 1);
    copy->values = need(size + 1, 1);
    memcpy(copy->values, paint->values, size);
    return copy;
}

void paint_dab(struct paint **paint, const struct dab *dab)
{
    if (atomic_load(&(*paint)->holders) > 1) {
        struct paint *copy = copy_of(*paint);
        paint_drop(*paint);
        *paint = copy;
    }
    const size_t first = (size_t)dab->coordinate * (size_t)(*paint)->vertices;
    for (int i = 0; i < dab->count; i++)
        memcpy((*paint)->values[first + (size_t)dab->vertices[i]], dab->values[i], sizeof *dab->values);
    touch(*paint);
}

struct paint_file *paint_file_create(void)
{
    struct paint_file *file = need_zeroed(1, sizeof *file);
    atomic_init(&file->holders, 1);
    return file;
}

struct paint_file *paint_file_hold(struct paint_file *file)
{
    if (file) atomic_fetch_add(&file->holders, 1);
    return file;
}

void paint_file_drop(struct paint_file *file)
{
    if (!file || atomic_fetch_sub(&file->holders, 1) > 1) return;
    free(file->path);
    free(file);
}

void paint_file_part(struct paint_file **file)
{
    struct paint_file *old = *file, *copy = paint_file_create();
    if (old) {
        copy->path = old->path ? need_text(old->path) : NULL;
        copy->version = old->version;
        copy->stamp = old->stamp;
    }
    paint_file_drop(old);
    *file = copy;
}
