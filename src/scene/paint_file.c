/// Reads and writes paint as .npy.
#include "scene/paint_file.h"
#include "base/file.h"
#include "base/npy.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t LARGEST = (size_t)1 << 30;

static bool check_shape(const char *name, const struct npy *npy, size_t size, struct error *error)
{
    const int64_t *n = npy->lengths;
    const bool fits =
        npy->count == 3 && n[2] == 2 && n[0] > 0 && n[1] > 0 && n[0] <= INT_MAX && n[1] <= INT_MAX / n[0];
    if (!fits)
        return fail(error, ERROR_INPUT, "%s: expected paint, an array of shape (coordinates, vertices, 2), got %s",
                    name, npy->shape);
    const int64_t expected = npy->data + 2 * n[0] * n[1] * npy->number_size;
    return (int64_t)size == expected || fail(error, ERROR_INPUT, "%s: expected %lld bytes for the shape %s, got %zu",
                                             name, (long long)expected, npy->shape, size);
}

/// Number `part` (a or ψ) at a vertex of a coordinate.
static double number_at(const struct npy *npy, const char *data, int64_t coordinate, int64_t vertex, int64_t part)
{
    const int64_t *n = npy->lengths;
    const int64_t index =
        npy->columns_first ? coordinate + n[0] * (vertex + n[1] * part) : part + 2 * (vertex + n[1] * coordinate);
    return npy_number(npy, data + npy->data + index * npy->number_size);
}

static bool read_values(const char *name, const struct npy *npy, const char *data, struct paint *paint,
                        struct error *error)
{
    static const double most[2] = {PAINT_MOST_SWELL, PAINT_MOST_LEAD};
    static const char *const what[2] = {"the logarithm of an amplitude", "a phase in radians"};
    for (int c = 0; c < paint->coordinates; c++) {
        for (int v = 0; v < paint->vertices; v++) {
            for (int k = 0; k < 2; k++) {
                const double number = number_at(npy, data, c, v, k);
                if (!(fabs(number) <= most[k]))
                    return fail(error, ERROR_INPUT, "%s: coordinate %d, vertex %d: expected %s within ±%g, got %g",
                                name, c, v, what[k], most[k], number);
                paint->values[(size_t)c * (size_t)paint->vertices + (size_t)v][k] = (float)number;
            }
        }
    }
    return true;
}

static bool read_header(struct npy *npy, const char *name, const char *data, size_t size, struct error *error)
{
    char text[NPY_DICTIONARY + 1];
    if (size < NPY_START) return fail(error, ERROR_INPUT, "%s: expected an .npy file, got %zu bytes", name, size);
    if (!npy_start(npy, name, (const unsigned char *)data, error)) return false;
    if (npy->data > (int64_t)size)
        return fail(error, ERROR_INPUT, "%s: expected a header of %lld bytes, got %zu", name, (long long)npy->data,
                    size);
    memcpy(text, data + npy->data - (int64_t)npy->dictionary, npy->dictionary);
    text[npy->dictionary] = '\0';
    return npy_dictionary(npy, name, text, error) && check_shape(name, npy, size, error);
}

struct paint *paint_parse(const char *name, const char *data, size_t size, struct error *error)
{
    struct npy npy;
    if (!read_header(&npy, name, data, size, error)) return NULL;
    struct paint *paint = paint_create((int)npy.lengths[0], (int)npy.lengths[1]);
    if (read_values(name, &npy, data, paint, error)) return paint;
    paint_drop(paint);
    return NULL;
}

struct paint *paint_read(const char *path, struct error *error)
{
    char *data;
    size_t size;
    if (!file_read(path, LARGEST, &data, &size, error)) return NULL;
    struct paint *paint = paint_parse(path, data, size, error);
    free(data);
    return paint;
}

static size_t values_size(const struct paint *paint)
{
    return (size_t)paint->coordinates * (size_t)paint->vertices * sizeof *paint->values;
}

static void header_of(const struct paint *paint, char header[NPY_HEADER])
{
    npy_print_header((const int[]){paint->coordinates, paint->vertices, 2}, 3, header);
}

size_t paint_file_size(const struct paint *paint) { return NPY_HEADER + values_size(paint); }

void paint_print(struct text *text, const struct paint *paint)
{
    char header[NPY_HEADER];
    header_of(paint, header);
    text_bytes(text, header, sizeof header);
    text_bytes(text, (const char *)paint->values, values_size(paint));
}

bool paint_write(const struct paint *paint, const char *path, const char *like, struct error *error)
{
    struct file_output output;
    char header[NPY_HEADER];
    header_of(paint, header);
    if (!file_output_open_like(&output, path, like, error)) return false;
    fwrite(header, 1, sizeof header, output.stream);
    fwrite(paint->values, 1, values_size(paint), output.stream);
    return file_output_commit(&output, error);
}
