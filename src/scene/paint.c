/// Makes and changes paint, and reads and writes it as .npy.
#include "base/file.h"
#include "base/need.h"
#include "base/npy.h"
#include "scene/rig.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t LARGEST = (size_t)1 << 30; ///< bytes of a file

/// Changes its version, because its values have changed.
static void paint_touch(struct paint *paint)
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
    paint_touch(paint);
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

void paint_dab(struct paint **paint, const struct dab *dab)
{
    if (atomic_load(&(*paint)->holders) > 1) {
        struct paint *copy = need(1, sizeof *copy);
        const size_t size = paint_bytes(*paint) - sizeof *copy;
        *copy = **paint;
        atomic_init(&copy->holders, 1);
        copy->values = need(size + 1, 1);
        memcpy(copy->values, (*paint)->values, size);
        paint_drop(*paint);
        *paint = copy;
    }
    const size_t first = (size_t)dab->coordinate * (size_t)(*paint)->vertices;
    for (int i = 0; i < dab->count; i++)
        memcpy((*paint)->values[first + (size_t)dab->vertices[i]], dab->values[i], sizeof *dab->values);
    paint_touch(*paint);
}

bool paint_check(const struct paint *paint, int coordinate, struct error *error)
{
    static const float most[2] = {PAINT_MOST_SWELL, PAINT_MOST_LEAD};
    static const char *const what[2] = {"the logarithm of an amplitude", "a phase in radians"};
    const float(*values)[2] = (const float(*)[2])paint->values + (size_t)coordinate * (size_t)paint->vertices;
    for (int v = 0; v < paint->vertices; v++) {
        for (int k = 0; k < 2; k++) {
            if (!(fabsf(values[v][k]) <= most[k]))
                return fail(error, ERROR_INPUT, "coordinate %d, vertex %d: expected %s within ±%g, got %g",
                            coordinate, v, what[k], (double)most[k], (double)values[v][k]);
        }
    }
    return true;
}

struct paint *paint_read(const char *path, struct error *error)
{
    struct npy npy;
    struct paint *paint = NULL;
    char *data;
    size_t size;
    if (!file_read(path, LARGEST, &data, &size, error)) return NULL;
    const int64_t *n = npy.lengths;
    bool good = npy_read_header(&npy, path, data, size, error);
    if (good && !(npy.count == 3 && n[2] == 2 && n[0] > 0 && n[1] > 0 && n[0] <= INT_MAX && n[1] <= INT_MAX / n[0]))
        good = fail(error, ERROR_INPUT, "%s: expected paint, an array of shape (coordinates, vertices, 2), got %s",
                    path, npy.shape);
    const int64_t expected = good ? npy.data + 2 * n[0] * n[1] * npy.number_size : 0;
    if (good && (int64_t)size != expected)
        good = fail(error, ERROR_INPUT, "%s: expected %lld bytes for the shape %s, got %zu", path,
                    (long long)expected, npy.shape, size);

    if (good) paint = paint_create((int)n[0], (int)n[1]);
    for (int64_t c = 0, index = 0; good && c < n[0]; c++) {
        for (int64_t v = 0; v < n[1]; v++) {
            for (int64_t part = 0; part < 2; part++, index++) { // a, then ψ
                const int64_t at = npy.columns_first ? c + n[0] * (v + n[1] * part) : index;
                paint->values[c * n[1] + v][part] = (float)npy_number(&npy, data + npy.data + at * npy.number_size);
            }
        }
        struct error why;
        if (!paint_check(paint, (int)c, &why)) good = fail(error, ERROR_INPUT, "%s: %s", path, why.text);
    }
    free(data);
    if (good) return paint;
    paint_drop(paint);
    return NULL;
}

bool paint_write(const struct paint *paint, const char *path, struct error *error)
{
    struct file_output output;
    char header[NPY_HEADER];
    if (!file_output_open(&output, path, error)) return false;
    npy_print_header((const int[]){paint->coordinates, paint->vertices, 2}, header);
    fwrite(header, 1, sizeof header, output.stream);
    fwrite(paint->values, 1, paint_bytes(paint) - sizeof *paint, output.stream);
    return file_output_commit(&output, error);
}
