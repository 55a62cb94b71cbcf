/// Reads and writes paint: in scenes, and as .npy.
#include "base/base64.h"
#include "base/file.h"
#include "base/need.h"
#include "base/npy.h"
#include "scene/rig_kind.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t LARGEST = (size_t)1 << 30;

enum { MOST_VALUES = 1 << 27 }; ///< pairs in a file of the largest size

static float (*values_of(const struct paint *paint, int coordinate))[2]
{
    return paint->values + (size_t)coordinate * (size_t)paint->vertices;
}

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

/// Component `part` (a or ψ) of a coordinate at a vertex.
static double value_at(const struct npy *npy, const char *data, int64_t coordinate, int64_t vertex, int64_t part)
{
    const int64_t *n = npy->lengths;
    const int64_t index =
        npy->columns_first ? coordinate + n[0] * (vertex + n[1] * part) : part + 2 * (vertex + n[1] * coordinate);
    return npy_number(npy, data + npy->data + index * npy->number_size);
}

/// Whether a coordinate's values are within the limits; NaN is not.
static bool check_values(const struct paint *paint, int coordinate, struct error *error)
{
    static const float most[2] = {PAINT_MOST_SWELL, PAINT_MOST_LEAD};
    static const char *const what[2] = {"the logarithm of an amplitude", "a phase in radians"};
    const float(*values)[2] = (const float(*)[2])values_of(paint, coordinate);
    for (int v = 0; v < paint->vertices; v++) {
        for (int k = 0; k < 2; k++) {
            if (!(fabsf(values[v][k]) <= most[k]))
                return fail(error, ERROR_INPUT, "coordinate %d, vertex %d: expected %s within ±%g, got %g",
                            coordinate, v, what[k], (double)most[k], (double)values[v][k]);
        }
    }
    return true;
}

static bool read_values(const char *name, const struct npy *npy, const char *data, struct paint *paint,
                        struct error *error)
{
    struct error why;
    for (int c = 0; c < paint->coordinates; c++) {
        for (int v = 0; v < paint->vertices; v++) {
            for (int k = 0; k < 2; k++) values_of(paint, c)[v][k] = (float)value_at(npy, data, c, v, k);
        }
        if (!check_values(paint, c, &why)) return fail(error, ERROR_INPUT, "%s: %s", name, why.text);
    }
    return true;
}

static struct paint *paint_parse(const char *name, const char *data, size_t size, struct error *error)
{
    struct npy npy;
    if (!npy_read_header(&npy, name, data, size, error) || !check_shape(name, &npy, size, error)) return NULL;
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

bool scene_read_paint(struct document *document, struct error *error)
{
    struct error first = {0};
    for (int i = -1; (i = document_next_rig(document, RIG_CHARACTER, i)) >= 0;) {
        const struct character_rig *character = &document->rigs[i]->character;
        if (!character->paint_file || character->painted) continue;
        struct error trouble = {0};
        char path[PATH_LIMIT];
        struct paint *paint = NULL;
        if (path_resolve(document->folder, character->paint_file, path)) {
            paint = paint_read(path, &trouble);
        } else {
            fail(&trouble, ERROR_INPUT, "%s: the path is too long", character->paint_file);
        }
        if (paint) document_own_rig(document, i)->character.painted = paint;
        if (first.kind == ERROR_NONE) first = trouble;
    }
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

// --- in a scene

static void load_coordinate(struct reader *reader, struct value value, struct paint *paint, int coordinate)
{
    const char *text = json_string_value(value.json);
    const size_t expected = (size_t)paint->vertices * sizeof *paint->values;
    size_t size = 0;
    if (json_is_null(value.json)) return;
    if (!text) {
        reader_unexpected(reader, value, "a string in base64 or null");
        return;
    }
    char *bytes = need(base64_capacity(json_string_length(value.json)), 1);
    if (!base64_decode(text, bytes, &size)) {
        reader_fail(reader, &value.at, "expected base64, got something else");
    } else if (size != expected) {
        reader_fail(reader, &value.at, "expected the %zu bytes of %d vertices, got %zu", expected, paint->vertices,
                    size);
    } else {
        struct error error;
        memcpy(values_of(paint, coordinate), bytes, size);
        if (!check_values(paint, coordinate, &error)) reader_fail(reader, &value.at, "%s", error.text);
    }
    free(bytes);
}

static void load_inside(struct reader *reader, const struct value *object, struct value value,
                        struct character_rig *character)
{
    const struct value vertices = reader_member(object, "vertices");
    const size_t coordinates = json_array_size(value.json);
    int count = 0;
    if (!vertices.json) {
        reader_fail(reader, &value.at, "expected \"vertices\", how many there are, beside it, got nothing");
        return;
    }
    if (coordinates == 0 || !reader_integer(reader, vertices, 1, MOST_VALUES, &count)) {
        if (coordinates == 0) reader_fail(reader, &value.at, "expected a string for each coordinate, got none");
        return;
    }
    if (coordinates > (size_t)(MOST_VALUES / count) ||
        !need_has_room(coordinates * (size_t)count * sizeof *character->painted->values)) {
        reader_fail(reader, &vertices.at, "expected at most %d vertices over all coordinates, and memory for them",
                    MOST_VALUES);
        return;
    }
    character->painted = paint_create((int)coordinates, count);
    for (int i = 0; i < (int)coordinates; i++)
        load_coordinate(reader, reader_element(&value, i), character->painted, i);
}

void paint_load(struct reader *reader, const struct value *object, void *at)
{
    struct rig *rig = at;
    const struct value paint = reader_member(object, "paint");
    if (json_is_array(paint.json)) {
        load_inside(reader, object, paint, &rig->character);
    } else if (paint.json) {
        rig->character.paint_file = reader_path(reader, paint);
    }
}

/// A coordinate's values as a string; null if they have no effect.
static void print_coordinate(struct text *text, const struct paint *paint, int coordinate)
{
    const size_t size = (size_t)paint->vertices * sizeof *paint->values;
    if (paint_is_plain_at(paint, coordinate)) {
        text_string(text, "null");
        return;
    }
    char *base64 = need(base64_length(size) + 1, 1);
    base64_encode(values_of(paint, coordinate), size, base64);
    text_quoted(text, base64);
    free(base64);
}

void paint_print(struct members *members, const struct document *document, const void *at, const char *folder)
{
    const struct character_rig *character = &((const struct rig *)at)->character;
    const struct paint *paint = character->painted;
    if (!paint && character->paint_file) member_path(members, "paint", document, character->paint_file, folder);
    if (!paint || paint_is_plain(paint)) return;
    member_number(members, "vertices", paint->vertices);
    member(members, "paint");
    for (int i = 0; i < paint->coordinates; i++) {
        text_string(members->text, i > 0 ? ",\n        " : "[\n        ");
        print_coordinate(members->text, paint, i);
    }
    text_string(members->text, "\n      ]");
}
