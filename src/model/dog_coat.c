/// Meshes and colours the dog's coat.
#include "model/coat.h"
#include "model/decimate.h"
#include "model/dog.h"
#include "model/isosurface.h"
#include "model/parts.h"
#include "model/refine.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

#define WHITE 0xF1E7D8u
#define EAR 0x70402Cu
#define CHESTNUT 0xA5633Au
#define MOUTH 0x4A1F22u
#define SOFT 0.009f /* half the width of a patch's edge */

#define CELL 0.0090f
#define TOLERANCE 0.0006f
enum { REFINE_ROUNDS = 3 };

static const float lo[3] = {-0.26f, -0.02f, -0.82f}, hi[3] = {0.26f, 0.95f, 0.66f};

/// 1 where a is beyond b by more than a soft edge.
static float beyond(float a, float b, float edge) { return glm_smoothstep(-edge, edge, a - b); }

static float patches(const float p[3])
{
    const float side = fabsf(p[0]);
    const float saddle = beyond(0.19f, hypotf(hypotf(0.8f * p[0], p[1] - 0.61f), 0.8f * fabsf(p[2] + 0.11f)), SOFT);
    const float nape =
        beyond(p[1] - 0.50f, 1.1f * (p[2] - 0.12f), SOFT) * beyond(p[1], 0.60f, SOFT) * beyond(p[2], 0.0f, 0.01f);
    const float tail = beyond(-0.27f, p[2], SOFT) * beyond(p[1], 0.45f, 0.02f) * beyond(0.735f, p[1], SOFT);
    const float mask = beyond(side, 0.016f + 0.25f * fmaxf(0.80f - p[1], 0.0f), SOFT) * beyond(0.448f, p[2], SOFT) *
                       beyond(p[1], 0.675f + 0.25f * (p[2] - 0.36f), SOFT);
    return fmaxf(fmaxf(saddle, tail), fmaxf(p[2] < 0.30f ? nape : 0.0f, mask * beyond(p[2], 0.22f, 0.02f)));
}

/// Distance to the lines around the muzzle: from the nose down to the lip, and up from the corner of the mouth, so that it smiles.
static float smile(const float p[3])
{
    static const struct part lines[] = {
        {{0, 0.715f, 0.565f}, {0, 0.660f, 0.557f}, 0.0035f, 0.0025f, 0.001f, 0, false},
        {{0.062f, 0.684f, 0.418f}, {0.078f, 0.712f, 0.392f}, 0.0045f, 0.0030f, 0.001f, 0, true},
    };
    return parts_add(lines, sizeof lines / sizeof *lines, p, 1e3f, NULL);
}

/// White with chestnut patches: a saddle, a mask with a blaze, the nape and the tail up to its white tip. The ears are darker, and dark is
/// what is near both lips: the inside of the mouth.
static void paint(struct vertex *vertex)
{
    const float *p = vertex->position;
    coat_linear(WHITE, vertex->color);
    const float head = dog_limb_distance(DOG_HEAD, p), jaw = dog_limb_distance(DOG_JAW, p);
    const float ear = fminf(dog_limb_distance(DOG_EAR_LEFT, p), dog_limb_distance(DOG_EAR_RIGHT, p));
    coat_mix(vertex->color, CHESTNUT, patches(p) * beyond(jaw, head - 0.004f, 0.004f));
    coat_mix(vertex->color, EAR, glm_smoothstep(0.010f, -0.002f, ear - 0.3f * glm_clamp(head, 0.0f, 0.03f)));
    coat_mix(vertex->color, MOUTH, 0.8f * glm_smoothstep(0.006f, 0.0f, smile(p)));
    coat_mix(vertex->color, MOUTH, glm_smoothstep(0.014f, 0.003f, fmaxf(head, jaw)) * beyond(p[2], 0.405f, 0.01f));
}

/// The mesh as a character, which decimate() takes. It borrows nothing.
static bool thin(struct mesh *mesh, int triangles)
{
    const size_t count = (size_t)mesh->vertex_count;
    struct character c = {
        .vertex_count = mesh->vertex_count, .indices = mesh->indices, .index_count = mesh->index_count};
    uint32_t *indices = malloc((size_t)mesh->index_count * sizeof *indices);
    c.position = malloc(count * sizeof *c.position);
    c.color = malloc(count * sizeof *c.color);
    bool good = indices && c.position && c.color;
    for (size_t i = 0; good && i < count; i++) {
        memcpy(c.position[i], mesh->vertices[i].position, sizeof *c.position);
        memcpy(c.color[i], mesh->vertices[i].color, sizeof *c.color);
    }
    int index_count = 0;
    good = good && decimate(&c, triangles, indices, NULL, &index_count);
    if (good) memcpy(mesh->indices, indices, (size_t)index_count * sizeof *indices);
    if (good) mesh->index_count = index_count;
    free(indices);
    free(c.position);
    free(c.color);
    return good;
}

/// Drops the vertices that no triangle needs any more.
static bool drop_unused(struct mesh *mesh)
{
    uint32_t *place = malloc((size_t)mesh->vertex_count * sizeof *place);
    if (!place) return false;
    memset(place, 0xFF, (size_t)mesh->vertex_count * sizeof *place);
    for (int i = 0; i < mesh->index_count; i++) place[mesh->indices[i]] = 0;
    uint32_t kept = 0;
    for (int v = 0; v < mesh->vertex_count; v++) {
        if (place[v] != 0) continue;
        mesh->vertices[kept] = mesh->vertices[v];
        place[v] = kept++;
    }
    for (int i = 0; i < mesh->index_count; i++) mesh->indices[i] = place[mesh->indices[i]];
    mesh->vertex_count = (int)kept;
    free(place);
    return true;
}

void dog_coat(int triangles, struct mesh *mesh)
{
    const struct solid solid = {dog_distance, paint};
    isosurface(&solid, lo, hi, CELL, mesh);
    refine(&solid, TOLERANCE, REFINE_ROUNDS, 0, mesh);
    if (mesh->failed || !thin(mesh, triangles) || !drop_unused(mesh)) mesh->failed = true;
}
