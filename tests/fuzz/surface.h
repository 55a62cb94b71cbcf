/// Reads a surface, checks that it holds together, and makes of it what analyses and drawn frames do.
#ifndef TESTS_FUZZ_SURFACE_H
#define TESTS_FUZZ_SURFACE_H

#include "draw/skirt.h"
#include "fuzz.h"
#include "model/adjacency.h"
#include "model/decimate.h"
#include "model/figure.h"
#include <stdlib.h>

/// The outlines of a mesh as it stands, from an eye.
static inline void fuzz_outlines(const struct skirt_mesh *mesh, const float (*normal)[3], int first, int end)
{
    const float eye[3] = {1, 2, 3};
    skirt_face(mesh, first, end, eye);
    for (int i = first - 1; (i = skirt_next(mesh, i + 1, end, i % 2 == 0)) < end;) {
        float ends[2][3], out[2][3];
        for (int k = 0; k < 3; k++) {
            ends[0][k] = normal[mesh->indices[i]][k];
            ends[1][k] = normal[mesh->indices[next_corner(i)]][k];
        }
        skirt_out(mesh, i, (const float(*)[3])ends, eye, 1e-3f, out);
    }
}

static inline void fuzz_triangles(const struct character *c, const uint32_t *indices, int index_count)
{
    const float(*place)[3] = (const float(*)[3])c->position;
    const size_t room = (size_t)index_count + 1;
    int *neighbours = malloc(room * sizeof *neighbours);
    uint32_t *look = malloc(room * sizeof *look);
    bool *front = malloc(room * sizeof *front);
    for (int i = 0; i < index_count; i++) look[i] = neighbours_look(0, c->color[indices[i]]);
    neighbours_find(place, c->vertex_count, indices, index_count, neighbours);
    neighbours_cut(place, indices, look, index_count, neighbours);
    const struct skirt_mesh mesh = {.indices = indices, .neighbours = neighbours, .place = place, .front = front};
    fuzz_outlines(&mesh, (const float(*)[3])c->normal, 0, index_count);
    free(neighbours);
    free(look);
    free(front);
}

/// What `analyze` writes of a character, and what a frame that shows it hands to the GPU. Takes the character.
static inline void fuzz_figure(struct character *character)
{
    struct figure figure;
    figure_create(&figure, character);
    const struct character *c = &figure.character;
    float(*turn)[3] = malloc(((size_t)c->vertex_count + 1) * sizeof *turn);
    for (int e = 0; e < figure.edges.first[c->vertex_count]; e++)
        fuzz_expect(figure.edges.other[e] < (uint32_t)c->vertex_count, "an edge ends at a vertex of the surface");
    for (int k = 0; k < 2 * c->coordinate_count; k++) figure_turn_normals(&figure, k / 2, k % 2, turn);
    free(turn);
    fuzz_triangles(c, c->indices, c->index_count);
    decimate(c, c->index_count / 6, figure.coarse, figure.coarse_from, &figure.coarse_count);
    fuzz_triangles(c, figure.coarse, figure.coarse_count);
    figure_free(&figure);
}

/// Reads a file by the end of its name; every index of what it gives must be within it.
static inline void fuzz_surface(const char *path)
{
    struct error error = {0};
    struct surface surface;
    const bool good = surface_read(path, &surface, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a surface is refused with a sentence");
    if (!good) return;
    const struct looks *looks = &surface.looks;
    for (int i = 0; i < surface.index_count; i++) {
        fuzz_expect(surface.indices[i] < (uint32_t)surface.vertex_count, "a triangle has vertices of the surface");
        fuzz_expect(!looks->corner || looks->corner[i] == LOOKS_NONE || looks->corner[i] < (uint32_t)looks->uv_count,
                    "a corner has texture coordinates of the surface");
    }
    for (int i = 0; i < surface.index_count / 3; i++) {
        fuzz_expect(!looks->material || looks->material[i] == LOOKS_NONE ||
                        looks->material[i] < (uint32_t)looks->material_count,
                    "a triangle has a material of the surface");
        fuzz_expect(!triangle_repeats(surface.indices + 3 * i), "a triangle has three different vertices");
    }
    struct character character;
    if (character_create(&character, &surface, 1)) fuzz_figure(&character);
    surface_free(&surface);
}

#endif
