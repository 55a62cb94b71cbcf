/// Shared by export tests: exports a scene into the test's folder, and measures a glTF file's distance from vertices.
#ifndef TESTS_EXPORT_SCENE_H
#define TESTS_EXPORT_SCENE_H

#include "base/file.h"
#include "documents.h"
#include "export/export.h"
#include "folder.h"
#include "model/gltf.h"
#include "model/motion.h"
#include "model/vector.h"
#include "puppet.h"
#include "rig/models.h"
#include <dirent.h>
#include <jansson.h>

/// An open, solved scene with its models loaded.
struct opened {
    struct document *document;
    struct evaluation evaluation;
    struct models *models;
    struct posing posing;
};

static inline struct opened open_scene(const char *path)
{
    struct opened scene = {.models = models_create()};
    scene.document = document_of_file(path);
    document_set_path(scene.document, path);
    assert_done(models_update(scene.models, scene.document, &error));
    scene.evaluation.models = models_source(scene.models);
    evaluation_update(&scene.evaluation, scene.document, false);
    return scene;
}

/// assets/scenes/character.json with curved coordinates, in the test's folder.
static inline struct opened open_curved(void)
{
    struct character creature;
    json_t *scene = json_load_file("assets/scenes/character.json", 0, NULL);
    char path[128];
    assert_done(character_read("assets/models/creature.glb", &creature, &error));
    for (int k = 0; k < creature.coordinate_count; k++) puppet_curve(&creature, k, 0.02, 0.8);
    puppet_write(&creature, folder_path("curved.glb"));
    json_object_set_new(json_array_get(json_object_get(scene, "rigs"), 0), "model", json_string("curved.glb"));
    char *text = json_dumps(scene, 0);
    snprintf(path, sizeof path, "%s", folder_file("curved.json", text));
    free(text);
    json_decref(scene);
    return open_scene(path);
}

static inline struct posing *posing_of(struct opened *scene)
{
    scene->posing =
        (struct posing){.document = scene->document, .evaluation = &scene->evaluation, .models = scene->models};
    return &scene->posing;
}

static inline void close_scene(struct opened *scene)
{
    evaluation_free(&scene->evaluation);
    models_destroy(scene->models);
    document_destroy(scene->document);
}

/// Exports the open scene; returns the file's path. Every second call reuses the storage.
static inline const char *export_opened(struct opened *scene, const char *file, struct export_options options)
{
    struct export_report report;
    const char *path = folder_path(file);
    assert_done(export_write(posing_of(scene), path, &options, &report, &error));
    return path;
}

/// The scene of a file that stays as it is. Opened once and kept: nobody may change it.
static inline struct opened *kept_scene(const char *path)
{
    static struct {
        char path[128];
        struct opened scene;
    } kept[8];
    size_t k = 0;
    while (kept[k].path[0] && strcmp(kept[k].path, path) != 0) assert_true(++k < sizeof kept / sizeof *kept);
    if (!kept[k].path[0]) {
        kept[k].scene = open_scene(path);
        snprintf(kept[k].path, sizeof kept[k].path, "%s", path);
    }
    return &kept[k].scene;
}

/// Exports a scene from assets/scenes.
static inline const char *export_scene(const char *name, const char *file, struct export_options options)
{
    char scene_path[128];
    snprintf(scene_path, sizeof scene_path, "assets/scenes/%s.json", name);
    return export_opened(kept_scene(scene_path), file, options);
}

/// All numbers of a motion, as floats.
struct points {
    int frames, vertices;
    double fps;
    double *number;
};

static inline struct points read_points(const char *path)
{
    struct motion motion;
    assert_done(motion_open(&motion, path, &error));
    struct points points = {motion.frames, motion.vertices, motion.fps, NULL};
    const int columns = 3 * motion.vertices;
    points.number = malloc((size_t)columns * (size_t)motion.frames * sizeof *points.number);
    assert_non_null(points.number);
    assert_done(motion_columns(&motion, 0, columns, points.number, &error));
    motion_close(&motion);
    return points;
}

static inline const double *frame_of(const struct points *points, int frame)
{
    return points->number + 3 * (ptrdiff_t)points->vertices * frame;
}

/// A glTF file's largest distance from a motion in the node that has its mesh, over all vertices and coordinates, at evenly spaced times. Without a
/// name it has one clip.
static inline double glb_is_off(const char *path, const char *name, const struct points *points)
{
    struct gltf gltf;
    struct gltf_pose pose;
    double off = 0;
    int node = 0;
    float(*place)[3] = malloc((size_t)points->vertices * sizeof *place);
    assert_done(gltf_read(path, &gltf, &error));
    assert_true(place && gltf_pose_create(&gltf, &pose));
    const int clip = name ? gltf_find_clip(&gltf, name) : 0;
    assert_true(name ? clip >= 0 : gltf.clip_count == 1);
    while (gltf.nodes[node].mesh < 0) node++;
    assert_int_equal(gltf_vertex_count(&gltf, node), points->vertices);
    for (int f = 0; f < points->frames; f += 3) { // a third of the frames suffices
        const double *expected = frame_of(points, f);
        const double part = (double)f / (points->frames - 1), first = gltf.clips[clip].first;
        gltf_pose_clip(&gltf, clip, first + (gltf.clips[clip].last - first) * part, &pose);
        gltf_pose_world(&gltf, &pose);
        gltf_pose_vertices(&gltf, &pose, node, place, NULL);
        mat4s inward = glms_mat4_inv(mat4_from(pose.world[node]));
        for (int v = 0; v < points->vertices; v++) {
            glm_mat4_mulv3(inward.raw, place[v], 1, place[v]);
            for (int k = 0; k < 3; k++) off = fmax(off, fabs((double)place[v][k] - expected[3 * v + k]));
        }
    }
    free(place);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
    return off;
}

/// All bytes of a file; the caller frees them.
static inline char *bytes_of(const char *path, size_t *size)
{
    char *data;
    assert_done(file_read(path, 1 << 28, &data, size, &error));
    return data;
}

static inline int files_in_folder(void)
{
    int count = 0;
    DIR *open = opendir(folder);
    assert_non_null(open);
    for (struct dirent *entry; (entry = readdir(open));)
        count += strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..");
    closedir(open);
    return count;
}

#endif
