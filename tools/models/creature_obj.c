/// creature_obj OUT.obj: the soft character of the paper's Figure 7 as a closed mesh, for `wiggly simulate`.
///
/// One closed manifold: a smooth union of round cones, cut off flat at the ground. It is 1.5 m high, looks towards +z and stands on y = 0.
/// Its arms keep clear of the body, so that a lattice around the mesh does not join them.
#include "base/need.h"
#include "model/surface.h"
#include "model/vector.h"
#include "models/isosurface.h"
#include "models/mesh.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SKIN 0x62A9B5u
#define DARKER 0x3D8496u
#define BELLY 0xF3E6CBu
#define CHEEK 0xE79A8Eu

/// Later parts override the colours and fillets of earlier ones.
static const struct part body[] = {
    {{0, 0.40f, 0}, {0, 0.88f, -0.01f}, 0.345f, 0.215f, 0.001f, SKIN, false},                        // rump to chest
    {{0, 0.42f, 0.10f}, {0, 0.76f, 0.08f}, 0.270f, 0.185f, 0.09f, BELLY, false},                     // belly
    {{0.165f, 0.22f, 0.02f}, {0.180f, 0.10f, 0.05f}, 0.155f, 0.125f, 0.10f, SKIN, true},             // legs
    {{0.185f, 0.075f, 0.06f}, {0.215f, 0.070f, 0.235f}, 0.115f, 0.100f, 0.06f, DARKER, true},        // feet
    {{0.190f, 0.925f, 0}, {0.440f, 0.90f, 0.02f}, 0.122f, 0.098f, 0.12f, SKIN, true},                // upper arms
    {{0.440f, 0.90f, 0.02f}, {0.610f, 0.845f, 0.06f}, 0.098f, 0.095f, 0.06f, SKIN, true},            // lower arms
    {{0.655f, 0.825f, 0.07f}, {0.692f, 0.800f, 0.08f}, 0.118f, 0.110f, 0.06f, DARKER, true},         // hands
    {{0.612f, 0.770f, 0.135f}, {0.597f, 0.742f, 0.160f}, 0.050f, 0.042f, 0.035f, DARKER, true},      // thumbs
    {{-0.045f, 1.215f, 0.015f}, {0.045f, 1.215f, 0.015f}, 0.280f, 0.280f, 0.10f, SKIN, false},       // head
    {{0.13f, 1.125f, 0.105f}, {0.09f, 1.13f, 0.17f}, 0.155f, 0.125f, 0.09f, SKIN, true},             // cheeks
    {{0, 1.125f, 0.210f}, {0, 1.125f, 0.280f}, 0.115f, 0.088f, 0.08f, BELLY, false},                 // muzzle
    {{0.215f, 1.42f, -0.01f}, {0.235f, 1.465f, -0.01f}, 0.090f, 0.080f, 0.05f, SKIN, true},          // ears
    {{0.215f, 1.425f, 0.050f}, {0.232f, 1.458f, 0.050f}, 0.050f, 0.045f, 0.03f, CHEEK, true},        // and insides
    {{-0.014f, 1.170f, 0.345f}, {0.014f, 1.170f, 0.345f}, 0.034f, 0.034f, 0.006f, COAT_DARK, false}, // nose
    {{0.122f, 1.248f, 0.268f}, {0.124f, 1.272f, 0.262f}, 0.044f, 0.044f, 0.004f, COAT_DARK, true},   // eyes
};

/// Centre of the cheeks' blush, for x > 0. Nose and eyes are at this place in the table: they shine.
static const float blush[3] = {0.205f, 1.135f, 0.245f};
static const float glint[3] = {0.30f, 0.72f, 0.62f};
enum { FIRST_SHINING = 13, PART_COUNT = sizeof body / sizeof *body };

static const float lo[3] = {-0.90f, -0.02f, -0.45f}, hi[3] = {0.90f, 1.60f, 0.55f};

#define CELL 0.0345f         /* makes about 12,000 triangles: six coordinates of them are a megabyte */
#define TOLERANCE 0.0016f    /* of flat triangles, metres */
#define GROUND_FILLET 0.035f /* of the soles' edges */
enum { REFINE_ROUNDS = 3 };

/// Everything below the ground is cut off, which flattens the soles.
static float distance(const float p[3])
{
    return -parts_union(-parts_add(body, PART_COUNT, p, 1e3f, NULL), p[1], GROUND_FILLET, NULL, NULL);
}

static void paint(struct vertex *vertex)
{
    const float *p = vertex->position;
    const vec3s cheek = {{fabsf(p[0]), p[1], p[2]}};
    parts_add(body, PART_COUNT, p, 1e3f, vertex->color);
    const float face = parts_add(body + FIRST_SHINING, PART_COUNT - FIRST_SHINING, p, 1e3f, NULL);
    const float away = glms_vec3_distance(cheek, vec3_from(blush));
    coat_mix(vertex->color, CHEEK, 0.75f * glm_smoothstep(0.085f, 0.025f, away));
    // A dark rim hides the hard line where eyes and nose meet the skin.
    coat_mix(vertex->color, COAT_DARK, glm_smoothstep(0.014f, 0.004f, face));
    const float shine = glm_smoothstep(0.92f, 0.95f, glms_vec3_dot(vec3_from(vertex->normal), vec3_from(glint)));
    if (face < 0.002f) coat_mix(vertex->color, COAT_TIP, shine);
}

/// Triangles below the nose reach from it to the muzzle. Their corners there are dark as well, or the nose would look jagged.
static void darken_below_nose(struct mesh *mesh)
{
    for (int i = 0; i < mesh->vertex_count; i++) {
        struct vertex *vertex = &mesh->vertices[i];
        const float away = parts_add(body + FIRST_SHINING, 1, vertex->position, 1e3f, NULL);
        if (away >= 0.002f && vertex->position[1] < body[FIRST_SHINING].a[1])
            coat_mix(vertex->color, COAT_DARK, glm_smoothstep(0.026f, 0.012f, away));
    }
}

static bool write(const struct mesh *mesh, const char *path, struct error *error)
{
    struct surface surface = {
        .vertex_count = mesh->vertex_count, .indices = mesh->indices, .index_count = mesh->index_count};
    const size_t bytes = (size_t)mesh->vertex_count * sizeof *surface.position;
    surface.position = need(bytes, 1);
    surface.color = need(bytes, 1);
    for (int i = 0; i < mesh->vertex_count; i++) {
        memcpy(surface.position[i], mesh->vertices[i].position, sizeof *surface.position);
        memcpy(surface.color[i], mesh->vertices[i].color, sizeof *surface.color);
    }
    const bool written = obj_write(path, &surface, error);
    free(surface.position);
    free(surface.color);
    return written;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: creature_obj OUT.obj\n", stderr);
        return ERROR_USAGE;
    }
    const struct solid solid = {distance, paint};
    struct mesh mesh = {0};
    struct error error = {0};
    isosurface(&solid, lo, hi, CELL, &mesh);
    refine(&solid, TOLERANCE, REFINE_ROUNDS, 0, &mesh);
    darken_below_nose(&mesh);
    if (write(&mesh, argv[1], &error)) {
        printf("%s: %d vertices, %d triangles\n", argv[1], mesh.vertex_count, mesh.index_count / 3);
    }
    mesh_free(&mesh);
    if (error.kind != ERROR_NONE) fprintf(stderr, "creature_obj: %s\n", error.text);
    return (int)error.kind;
}
