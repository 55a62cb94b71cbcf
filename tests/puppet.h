/// A round figure with coordinates made by a test.
#ifndef TESTS_PUPPET_H
#define TESTS_PUPPET_H

#include "model/figure.h"
#include "models/isosurface.h"
#include "near.h"
#include "rig/models.h"
#include "temporary.h"
#include <unistd.h>

static inline float puppet_distance(const float p[3])
{
    const float y = p[1] - 0.5f;
    return sqrtf(p[0] * p[0] + y * y + p[2] * p[2]) - 0.5f;
}

static inline void puppet_paint(struct vertex *vertex)
{
    for (int k = 0; k < 3; k++) vertex->color[k] = 0.5f;
}

/// A solid's surface, with `coordinates` coordinates "a", "b" … whose Ñ are zero.
static inline struct character puppet_solid(const struct solid *made_of, const float lo[3], const float hi[3],
                                            float cell, int coordinates)
{
    struct mesh mesh = {0};
    struct character character;
    isosurface(made_of, lo, hi, cell, &mesh);
    struct surface surface = {
        .vertex_count = mesh.vertex_count, .indices = mesh.indices, .index_count = mesh.index_count};
    mesh.indices = NULL;
    surface.position = malloc((size_t)mesh.vertex_count * sizeof *surface.position);
    assert_non_null(surface.position);
    for (int i = 0; i < mesh.vertex_count; i++)
        memcpy(surface.position[i], mesh.vertices[i].position, 3 * sizeof(float));
    assert_true(character_create(&character, &surface, coordinates));
    for (int i = 0; i < mesh.vertex_count; i++) {
        memcpy(character.normal[i], mesh.vertices[i].normal, 3 * sizeof(float));
        for (int k = 0; k < 3; k++) character.color[i][k] = 0.5f;
    }
    for (int k = 0; k < coordinates; k++) {
        character.coordinates[k].name = strdup((const char[]){(char)('a' + k), '\0'});
        assert_non_null(character.coordinates[k].name);
    }
    mesh_free(&mesh);
    return character;
}

/// A ball of 1 m on the ground.
static inline struct character puppet_character(float cell, int coordinates)
{
    const struct solid ball = {puppet_distance, puppet_paint};
    const float lo[3] = {-0.55f, -0.05f, -0.55f}, hi[3] = {0.55f, 1.05f, 0.55f};
    return puppet_solid(&ball, lo, hi, cell, coordinates);
}

/// Makes a coordinate curved, differently at every vertex and up to `most`.
static inline void puppet_curve(struct character *character, int coordinate, double size, double most)
{
    struct coordinate *c = &character->coordinates[coordinate];
    assert_true(character_curve(character, coordinate));
    c->most = most;
    for (int p = COORDINATE_STRAIGHT; p < COORDINATE_PARTS; p++) {
        for (int i = 0; i < 3 * character->vertex_count; i++) {
            const float *at = character->position[i / 3];
            c->parts[p][i / 3][i % 3] =
                (float)(size *
                        sin(p * (double)at[i % 3] + (double)(3 * at[(i + 1) % 3] * at[(i + p) % 3]) + p * (i % 3)));
        }
    }
}

/// Writes and frees it.
static inline void puppet_write(struct character *character, const char *path)
{
    assert_done(character_write(path, character, true, &error));
    character_free(character);
}

/// The model that a character is in its file; takes over the character.
static inline struct imported puppet_imported(struct character *character)
{
    struct imported imported;
    const char *path = temporary_path("puppet-imported.glb");
    puppet_write(character, path);
    assert_done(imported_read(&imported, path, &error));
    assert_int_equal(unlink(path), 0);
    return imported;
}

/// As it stands at a place.
static inline struct model_pose puppet_pose(const struct imported *imported, const float at[3])
{
    return (struct model_pose){
        .gltf = &imported->gltf,
        .pose = &imported->rest,
        .root = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at[0], at[1] - imported->gltf.lo[1], at[2], 1},
        .ground = at[1],
        .figure = &imported->figure};
}

/// A character's figure; takes over the character.
static inline struct figure puppet_figure(struct character *character)
{
    struct figure figure;
    figure_create(&figure, character);
    return figure;
}

#endif
