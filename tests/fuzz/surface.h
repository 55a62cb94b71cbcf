/// Reads a surface, checks that it holds together, and makes of it what analyses and drawn frames do.
#ifndef TESTS_FUZZ_SURFACE_H
#define TESTS_FUZZ_SURFACE_H

#include "draw/posed.h"
#include "fuzz.h"
#include "model/adjacency.h"
#include "model/figure.h"
#include <stdlib.h>
#include <string.h>

/// The outlines of a mesh as it stands, from an eye.
static inline void fuzz_outlines(const struct posed *mesh, const float eye[3])
{
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        struct skirt_vertex skirt[SKIRT_CORNERS];
        for (int i = part->first - 1; (i = skirt_next(mesh, part, i + 1)) < part->end;)
            skirt_hang(mesh, part, i, eye, 1e-3f, skirt);
    }
}

static inline void fuzz_triangles(const struct figure *figure, bool coarse)
{
    const float eye[3] = {1, 2, 3};
    const struct stage_character shown = {.figure = figure};
    struct posed mesh;
    posed_from_figure(&mesh, figure, coarse);
    posed_pose_figure(&mesh, &shown, eye);
    fuzz_outlines(&mesh, eye);
    posed_free(&mesh);
}

/// What `analyze` writes of a character, and what a frame that shows it hands to the GPU. Takes the character.
static inline void fuzz_figure(struct character *character)
{
    struct figure figure;
    figure_create(&figure, character);
    const struct character *c = &figure.character;
    for (int e = 0; e < figure.edges.first[c->vertex_count]; e++)
        fuzz_expect(figure.edges.other[e] < (uint32_t)c->vertex_count, "an edge ends at a vertex of the surface");
    for (int k = 0; k < 2 * c->coordinate_count; k++) figure_target_create(&figure, k / 2, k % 2, &figure.pool);
    fuzz_triangles(&figure, false);
    decimate(c, c->index_count / 6, figure.coarse, figure.coarse_from, &figure.coarse_count);
    fuzz_triangles(&figure, true);
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
    if (character_create(&character, &surface, 1)) {
        character.coordinates[0].name = strdup("up");
        fuzz_figure(&character);
    }
    surface_free(&surface);
}

#endif
