/// Applies painted phases and amplitudes to a figure.
#include "base/need.h"
#include "model/figure.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void reserve(struct painted *painted)
{
    const struct character *plain = &painted->plain->character;
    struct figure *figure = &painted->figure;
    const size_t vertices = (size_t)plain->vertex_count, coordinates = (size_t)plain->coordinate_count;
    figure->slopes = need(vertices * coordinates + 1, sizeof *figure->slopes);
    figure->largest = need(coordinates + 1, sizeof *figure->largest);
    figure->character.coordinates = need_zeroed(coordinates + 1, sizeof *figure->character.coordinates);
    painted->applied = need_zeroed(vertices * coordinates + 1, sizeof *painted->applied);
    painted->stale = need_zeroed(vertices + 1, sizeof *painted->stale);
    for (size_t k = 0; k < coordinates; k++) {
        struct coordinate *c = &figure->character.coordinates[k];
        *c = plain->coordinates[k]; // the name is shared
        c->re = need(vertices + 1, sizeof *c->re);
        c->im = need(vertices + 1, sizeof *c->im);
    }
}

static void copy_coordinates(struct painted *painted)
{
    const struct character *plain = &painted->plain->character;
    const size_t vertices = (size_t)plain->vertex_count, coordinates = (size_t)plain->coordinate_count;
    for (size_t k = 0; k < coordinates; k++) {
        struct coordinate *c = &painted->figure.character.coordinates[k];
        memcpy(c->re, plain->coordinates[k].re, vertices * sizeof *c->re);
        memcpy(c->im, plain->coordinates[k].im, vertices * sizeof *c->im);
    }
    memcpy(painted->figure.slopes, painted->plain->slopes, vertices * coordinates * sizeof(struct slope));
    memcpy(painted->figure.largest, painted->plain->largest, coordinates * sizeof *painted->figure.largest);
}

struct painted *painted_create(const struct figure *plain)
{
    struct painted *painted = need_zeroed(1, sizeof *painted);
    painted->plain = plain;
    painted->figure = *plain;
    painted->figure.id = figure_new_id();
    painted->figure.version = 1;
    painted->figure.slopes = NULL;
    painted->figure.largest = NULL;
    painted->figure.character.coordinates = NULL;
    reserve(painted);
    copy_coordinates(painted);
    return painted;
}

void painted_destroy(struct painted *painted)
{
    if (!painted) return;
    struct coordinate *coordinates = painted->figure.character.coordinates;
    for (int k = 0; coordinates && k < painted->plain->character.coordinate_count; k++) {
        if (coordinates[k].re != painted->plain->character.coordinates[k].re) free(coordinates[k].re);
        if (coordinates[k].im != painted->plain->character.coordinates[k].im) free(coordinates[k].im);
    }
    free(coordinates);
    free(painted->figure.slopes);
    free(painted->figure.largest);
    free(painted->applied);
    free(painted->stale);
    free(painted);
}

/// Ñ' = Ñ e^{a + jψ} at one vertex; its slopes and its neighbours' become stale.
static void turn(struct painted *painted, int coordinate, int vertex, const float value[2])
{
    const struct coordinate *from = &painted->plain->character.coordinates[coordinate];
    struct coordinate *to = &painted->figure.character.coordinates[coordinate];
    const struct adjacency *edges = &painted->figure.edges;
    const float size = expf(value[0]), re = size * cosf(value[1]), im = size * sinf(value[1]);
    for (int k = 0; k < 3; k++) {
        to->re[vertex][k] = re * from->re[vertex][k] - im * from->im[vertex][k];
        to->im[vertex][k] = re * from->im[vertex][k] + im * from->re[vertex][k];
    }
    painted->stale[vertex] = true;
    for (int e = edges->first[vertex]; e < edges->first[vertex + 1]; e++) painted->stale[edges->other[e]] = true;
}

/// Applies the paint to one coordinate; false if nothing changed.
static bool apply(struct painted *painted, int coordinate, const float (*paint)[2])
{
    static const float none[2];
    const int vertices = painted->figure.character.vertex_count;
    float(*applied)[2] = painted->applied + (size_t)coordinate * (size_t)vertices;
    bool any = false;
    for (int i = 0; i < vertices; i++) {
        const float *value = paint ? paint[(size_t)coordinate * (size_t)vertices + (size_t)i] : none;
        if (applied[i][0] == value[0] && applied[i][1] == value[1]) continue;
        memcpy(applied[i], value, sizeof applied[i]);
        turn(painted, coordinate, i, value);
        any = true;
    }
    return any;
}

void painted_update(struct painted *painted, const float (*paint)[2])
{
    struct figure *figure = &painted->figure;
    const uint64_t next = figure->version + 1;
    for (int k = 0; k < figure->character.coordinate_count; k++) {
        if (!apply(painted, k, paint)) continue;
        for (int i = 0; i < figure->character.vertex_count; i++) {
            if (!painted->stale[i]) continue;
            painted->stale[i] = false;
            figure_fit(figure, k, i);
        }
        figure_measure(figure, k);
        figure->version = next;
    }
}
