/// Makes paint, and remembers what a stroke touched, for undo.
#include "scene/paint.h"
#include <assert.h>
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
    struct paint *paint = calloc(1, sizeof *paint);
    if (!paint) return NULL;
    paint->coordinates = coordinates;
    paint->vertices = vertices;
    paint->values = calloc((size_t)coordinates * (size_t)vertices + 1, sizeof *paint->values);
    touch(paint);
    if (paint->values) return paint;
    free(paint);
    return NULL;
}

void paint_destroy(struct paint *paint)
{
    if (!paint) return;
    free(paint->values);
    free(paint);
}

struct paint *paint_copy(const struct paint *paint)
{
    struct paint *copy = paint_create(paint->coordinates, paint->vertices);
    if (!copy) return NULL;
    memcpy(copy->values, paint->values, paint_bytes(paint) - sizeof *paint);
    copy->version = paint->version;
    return copy;
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

struct touched *touched_create(const struct paint *paint, int coordinate)
{
    const size_t room = (size_t)paint->vertices + 1;
    struct touched *touched = calloc(1, sizeof *touched);
    if (!touched) return NULL;
    touched->coordinate = coordinate;
    touched->capacity = paint->vertices;
    touched->vertices = malloc(room * sizeof *touched->vertices);
    touched->values = malloc(room * sizeof *touched->values);
    touched->place = calloc(room, sizeof *touched->place);
    if (touched->vertices && touched->values && touched->place) return touched;
    touched_destroy(touched);
    return NULL;
}

void touched_destroy(struct touched *touched)
{
    if (!touched) return;
    free(touched->vertices);
    free(touched->values);
    free(touched->place);
    free(touched);
}

static float *value_at(struct paint *paint, int coordinate, int vertex)
{
    return paint->values[(size_t)coordinate * (size_t)paint->vertices + (size_t)vertex];
}

void touched_dab(struct touched *touched, struct paint *paint, const struct dab *dab)
{
    assert(touched->place && touched->coordinate == dab->coordinate);
    for (int i = 0; i < dab->count; i++) {
        const int vertex = dab->vertices[i];
        float *value = value_at(paint, dab->coordinate, vertex);
        if (touched->place[vertex] == 0) {
            const int place = touched->count++;
            touched->place[vertex] = 1 + place;
            touched->vertices[place] = vertex;
            memcpy(touched->values[place], value, sizeof *touched->values);
        }
        memcpy(value, dab->values[i], sizeof *dab->values);
    }
    touch(paint);
}

void touched_swap(struct touched *touched, struct paint *paint)
{
    for (int i = 0; i < touched->count; i++) {
        float *value = value_at(paint, touched->coordinate, touched->vertices[i]), other[2];
        memcpy(other, value, sizeof other);
        memcpy(value, touched->values[i], sizeof other);
        memcpy(touched->values[i], other, sizeof other);
    }
    touch(paint);
}

void touched_settle(struct touched *touched)
{
    const size_t room = (size_t)touched->count + 1;
    if (!touched->place) return;
    free(touched->place);
    touched->place = NULL;
    touched->capacity = touched->count;
    int *vertices = realloc(touched->vertices, room * sizeof *vertices);
    if (vertices) touched->vertices = vertices;
    float(*values)[2] = realloc(touched->values, room * sizeof *values);
    if (values) touched->values = values;
}

size_t touched_bytes(const struct touched *touched)
{
    const size_t each = sizeof *touched->vertices + sizeof *touched->values;
    return sizeof *touched + (size_t)touched->capacity * (each + (touched->place ? sizeof *touched->place : 0));
}
