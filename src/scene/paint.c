/// Makes and changes paint.
#include "scene/paint.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

/// Changes its version, because its values have changed.
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

bool paint_is_plain_at(const struct paint *paint, int coordinate)
{
    const size_t count = (size_t)paint->vertices;
    const float(*values)[2] = (const float(*)[2])paint->values + (size_t)coordinate * count;
    for (size_t i = 0; i < count; i++) {
        if (values[i][0] != 0 || values[i][1] != 0) return false;
    }
    return true;
}

bool paint_is_plain(const struct paint *paint)
{
    for (int c = 0; c < paint->coordinates; c++) {
        if (!paint_is_plain_at(paint, c)) return false;
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
