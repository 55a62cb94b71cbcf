/// Meshes and colours the dog's coat.
#include "model/coat.h"
#include "model/decimate.h"
#include "model/dog.h"
#include "model/isosurface.h"
#include "model/refine.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

#define CHESTNUT 0xA5633Au
#define MOUTH 0x4A1F22u
#define LIPS 0x3A2420u

#define CELL 0.0105f
#define TOLERANCE 0.0006f
enum { REFINE_ROUNDS = 2 };

static const float lo[3] = {-0.26f, -0.02f, -0.82f}, hi[3] = {0.26f, 0.95f, 0.66f};

static float distance(const float p[3]) { return dog_distance(p, NULL); }

/// 1 where a is beyond b by more than a soft edge.
static float beyond(float a, float b, float edge) { return glm_smoothstep(-edge, edge, a - b); }

static float patches(const float p[3])
{
    const float side = fabsf(p[0]);
    const float saddle = beyond(0.19f, hypotf(hypotf(0.8f * p[0], p[1] - 0.61f), p[2] + 0.10f), 0.008f);
    const float nape = beyond(p[1] - 0.50f, 1.1f * (p[2] - 0.12f), 0.006f) * beyond(p[1], 0.60f, 0.006f);
    const float tail = beyond(-0.27f, p[2], 0.006f) * beyond(p[1], 0.45f, 0.02f) * beyond(0.735f, p[1], 0.008f);
    const float mask = beyond(side, 0.014f + 0.25f * fmaxf(0.80f - p[1], 0.0f), 0.005f) *
                       beyond(0.448f, p[2], 0.006f) * beyond(p[1], 0.675f + 0.25f * (p[2] - 0.36f), 0.006f);
    return fmaxf(fmaxf(saddle, tail), fmaxf(p[2] < 0.30f ? nape : 0.0f, mask * beyond(p[2], 0.22f, 0.02f)));
}

/// White with chestnut patches: a saddle, a mask with a blaze, the nape and the tail up to its white tip. What is near both lips is the
/// inside of the mouth.
static void paint(struct vertex *vertex)
{
    const float *p = vertex->position;
    float own[3];
    dog_distance(p, vertex->color);
    memcpy(own, vertex->color, sizeof own);
    coat_mix(vertex->color, CHESTNUT, patches(p));
    const float head = dog_limb_distance(DOG_HEAD, p, NULL), jaw = dog_limb_distance(DOG_JAW, p, NULL);
    const float ear = fminf(dog_limb_distance(DOG_EAR_LEFT, p, NULL), dog_limb_distance(DOG_EAR_RIGHT, p, NULL));
    glm_vec3_lerp(vertex->color, own, beyond(0.5f * fmaxf(head, 0.0f) + 0.004f, ear, 0.002f), vertex->color);
    glm_vec3_lerp(vertex->color, own, beyond(head, jaw + 0.002f, 0.002f), vertex->color);
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
    good = good && decimate(&c, triangles, indices, &index_count);
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
    const struct solid solid = {distance, paint};
    isosurface(&solid, lo, hi, CELL, mesh);
    refine(&solid, TOLERANCE, REFINE_ROUNDS, 0, mesh);
    if (mesh->failed || !thin(mesh, triangles) || !drop_unused(mesh)) mesh->failed = true;
}
