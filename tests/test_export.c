/// What wiggly export writes, read back: by the reader of imported characters, by that of motions, and number by number.
#include "base/file.h"
#include "export/export.h"
#include "export/gltf_splice.h"
#include "folder.h"
#include "model/character.h"
#include "model/gltf.h"
#include "model/motion.h"
#include "near.h"
#include "rig/models.h"
#include "scene/load.h"
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

/// A scene that is open, solved, its models read.
struct opened {
    struct document *document;
    struct evaluation evaluation;
    struct models *models;
    struct posing posing;
};

static struct opened open_scene(const char *path)
{
    struct opened scene = {.models = models_create()};
    struct error error = {0};
    scene.document = scene_load(path, NULL, &error);
    if (!scene.document) fail_msg("%s", error.text);
    assert_true(document_set_path(scene.document, path));
    assert_true(models_update(scene.models, scene.document, &error));
    assert_true(evaluation_resize(&scene.evaluation, scene.document, &error));
    evaluation_update(&scene.evaluation, scene.document, NULL, false);
    return scene;
}

static struct posing *posing_of(struct opened *scene)
{
    scene->posing =
        (struct posing){.document = scene->document, .evaluation = &scene->evaluation, .models = scene->models};
    return &scene->posing;
}

static void close_scene(struct opened *scene)
{
    evaluation_free(&scene->evaluation);
    models_destroy(scene->models);
    document_destroy(scene->document);
}

/// Exports a scene of assets/scenes; returns the file's path, of the same storage at each second call.
static const char *export_scene(const char *name, const char *file, struct export_options options)
{
    char scene_path[128];
    struct error error = {0};
    struct export_report report;
    const char *path = folder_path(file);
    snprintf(scene_path, sizeof scene_path, "assets/scenes/%s.json", name);
    struct opened scene = open_scene(scene_path);
    if (!export_write(posing_of(&scene), path, &options, &report, &error)) fail_msg("%s", error.text);
    close_scene(&scene);
    return path;
}

/// All numbers of a motion, as floats.
struct points {
    int frames, vertices;
    double fps;
    double *number;
};

static struct points read_points(const char *path)
{
    struct motion motion;
    struct error error;
    if (!motion_open(&motion, path, &error)) fail_msg("%s", error.text);
    struct points points = {motion.frames, motion.vertices, motion.fps, NULL};
    const int columns = 3 * motion.vertices;
    points.number = malloc((size_t)columns * (size_t)motion.frames * sizeof *points.number);
    assert_non_null(points.number);
    assert_true(motion_columns(&motion, 0, columns, points.number, &error));
    motion_close(&motion);
    return points;
}

static const double *frame_of(const struct points *points, int frame)
{
    return points->number + 3 * (ptrdiff_t)points->vertices * frame;
}

/// The largest distance, over all vertices and coordinates, of a glTF file at each of `frames` evenly spaced times from a motion.
static double glb_clip_is_off(const char *path, const char *name, const struct points *points)
{
    struct gltf gltf;
    struct gltf_pose pose;
    struct error error;
    double off = 0;
    int node = 0;
    float(*place)[3] = malloc((size_t)points->vertices * sizeof *place);
    if (!gltf_read(path, &gltf, &error)) fail_msg("%s", error.text);
    assert_true(place && gltf_pose_create(&gltf, &pose));
    const int clip = name ? gltf_find_clip(&gltf, name) : 0;
    assert_true(name ? clip >= 0 : gltf.clip_count == 1);
    while (gltf.nodes[node].mesh < 0) node++;
    assert_int_equal(gltf_vertex_count(&gltf, node), points->vertices);
    for (int f = 0; f < points->frames; f += 3) { // a third says as much
        const double *expected = frame_of(points, f);
        gltf_pose_clip(&gltf, clip, gltf.clips[clip].duration * f / (points->frames - 1), &pose);
        gltf_pose_world(&gltf, &pose);
        gltf_pose_vertices(&gltf, &pose, node, place, NULL);
        for (int i = 0; i < 3 * points->vertices; i++)
            off = fmax(off, fabs((double)place[i / 3][i % 3] - expected[i]));
    }
    free(place);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
    return off;
}

static double glb_is_off(const char *path, const struct points *points)
{
    return glb_clip_is_off(path, NULL, points);
}

static void glb_moves_as_the_stage_does(void **state)
{
    static const char *const scenes[] = {"tail", "follow", "character", "figure7"};
    (void)state;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        struct points points = read_points(export_scene(scenes[s], "points.npy", (struct export_options){0}));
        const char *glb = export_scene(scenes[s], "rig.glb", (struct export_options){0});
        assert_near(glb_is_off(glb, &points), 0, 5e-6);
        const char *text = export_scene(scenes[s], "rig.gltf", (struct export_options){.is_signed = true});
        assert_near(glb_is_off(text, &points), 0, 5e-6);
        free(points.number);
    }
}

/// Half of the keys miss the swing between them; with tangents they miss much less.
static void tangents_make_up_for_keys(void **state)
{
    (void)state;
    struct points points = read_points(export_scene("tail", "points.npy", (struct export_options){.substeps = 4}));
    const double dense = glb_is_off(export_scene("tail", "d.glb", (struct export_options){.substeps = 4}), &points);
    const double linear = glb_is_off(export_scene("tail", "l.glb", (struct export_options){.rate = 8}), &points);
    const double cubic =
        glb_is_off(export_scene("tail", "c.glb", (struct export_options){.rate = 8, .is_cubic = true}), &points);
    assert_near(dense, 0, 5e-6);
    assert_true(linear > 0.02);
    assert_true(cubic < linear / 5);
    free(points.number);
}

/// All bytes of a file; the caller frees them.
static char *bytes_of(const char *path, size_t *size)
{
    char *data;
    struct error error;
    if (!file_read(path, 1 << 28, &data, size, &error)) fail_msg("%s", error.text);
    return data;
}

static uint32_t word_at(const char *bytes)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

/// The dog's scene without its chains; the caller closes it.
static struct opened open_dog_without_chains(void)
{
    struct opened scene = open_scene("assets/scenes/dog.json");
    struct document *document = scene.document;
    for (int r = document->rig_count - 1; r >= 0; r--) {
        if (document->rigs[r].kind != RIG_CHAIN) continue;
        rig_release(&document->rigs[r]);
        memmove(&document->rigs[r], &document->rigs[r + 1],
                (size_t)(document->rig_count - r - 1) * sizeof *document->rigs);
        document->rig_count--;
    }
    return scene;
}

static void without_a_chain_the_file_stays_the_same(void **state)
{
    (void)state;
    struct opened scene = open_dog_without_chains();
    struct export_report report;
    struct error error;
    const struct export_options usual = {0};
    size_t size, again;
    assert_true(export_write(posing_of(&scene), folder_path("same.glb"), &usual, &report, &error));
    close_scene(&scene);
    char *original = bytes_of("assets/models/dog.glb", &size), *copy = bytes_of(folder_path("same.glb"), &again);
    assert_int_equal(size, again);
    assert_memory_equal(original, copy, size);
    free(original);
    free(copy);
}

/// The clip is replaced or added; the chunk begins with all bytes that it had, and the JSON keeps its words.
static void an_imported_character_gets_a_clip(void **state)
{
    static const char *const names[] = {NULL, "Wag"};
    (void)state;
    struct points points = read_points(export_scene("dog", "dog.npy", (struct export_options){.substeps = 2}));
    size_t size, larger;
    char *original = bytes_of("assets/models/dog.glb", &size);
    const size_t json = word_at(original + 12), chunk = word_at(original + 20 + json);
    for (int n = 0; n < 2; n++) {
        const struct export_options options = {.clip = names[n], .substeps = 2};
        struct gltf before, after;
        struct error error;
        const char *path = export_scene("dog", "dog.glb", options);
        assert_near(glb_clip_is_off(path, n ? "Wag" : "Walk", &points), 0, 5e-6);
        assert_true(gltf_read("assets/models/dog.glb", &before, &error) && gltf_read(path, &after, &error));
        assert_int_equal(after.clip_count, before.clip_count + n);
        assert_string_equal(after.clips[1].name, before.clips[1].name);
        assert_near(after.clips[1].duration, before.clips[1].duration, 0);
        gltf_free(&before);
        gltf_free(&after);
        char *copy = bytes_of(path, &larger);
        assert_memory_equal(original + 28 + json, copy + 28 + word_at(copy + 12), chunk);
        free(copy);
    }
    free(original);
    free(points.number);
}

/// A .gltf of ours goes in as a character, gets a chain, and comes out as a .gltf or .glb.
static void text_files_get_a_clip_too(void **state)
{
    static const char scene_text[] =
        "{\"wiggly\": 1, \"frames\": [0, 24], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": "
        "[{\"frame\": 0, "
        "\"value\": 2}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"fox\", \"model\": \"fox.gltf\", \"clip\": "
        "\"tail\"}, "
        "{\"type\": \"chain\", \"name\": \"end\", \"model\": \"fox\", \"from\": \"tail_12\", \"to\": \"tail_23\", "
        "\"channels\": [{\"spline\": \"s\"}]}]}";
    (void)state;
    struct export_report report;
    struct error error = {0};
    const struct export_options usual = {0}, signed_weights = {.is_signed = true};
    export_scene("tail", "fox.gltf", usual);
    assert_true(file_write_atomic(folder_path("scene.json"), scene_text, strlen(scene_text), &error));
    struct opened scene = open_scene(folder_path("scene.json"));
    assert_true(export_write(posing_of(&scene), folder_path("fox.npy"), &usual, &report, &error));
    struct points points = read_points(folder_path("fox.npy"));
    if (!export_write(posing_of(&scene), folder_path("out.gltf"), &signed_weights, &report, &error))
        fail_msg("%s", error.text);
    assert_near(glb_clip_is_off(folder_path("out.gltf"), "tail", &points), 0, 5e-6);
    assert_true(export_write(posing_of(&scene), folder_path("out.glb"), &usual, &report, &error));
    assert_near(glb_clip_is_off(folder_path("out.glb"), "tail", &points), 0, 5e-6);
    close_scene(&scene);
    free(points.number);
}

static void assert_same_part(const struct gltf_part *a, const struct gltf_part *b)
{
    const size_t count = (size_t)a->vertex_count;
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->index_count, b->index_count);
    assert_int_equal(a->material, b->material);
    assert_memory_equal(a->position, b->position, count * sizeof *a->position);
    assert_memory_equal(a->normal, b->normal, count * sizeof *a->normal);
    assert_memory_equal(a->joints, b->joints, count * sizeof *a->joints);
    assert_memory_equal(a->weights, b->weights, count * sizeof *a->weights);
    assert_memory_equal(a->indices, b->indices, (size_t)a->index_count * sizeof *a->indices);
}

static void assert_same_clip(const struct gltf_clip *a, const struct gltf_clip *b)
{
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->channel_count, b->channel_count);
    for (int c = 0; c < a->channel_count; c++) {
        const struct gltf_channel *one = &a->channels[c], *other = &b->channels[c];
        const size_t keys = (size_t)one->key_count, numbers = keys * (size_t)one->components;
        assert_int_equal(one->key_count, other->key_count);
        assert_memory_equal(one->times, other->times, keys * sizeof *one->times);
        assert_memory_equal(one->values, other->values, numbers * sizeof *one->values);
    }
}

/// Two files of a dog hold the same, whatever its clip "Walk" is.
static void assert_same_dog(const char *path, const char *other_path)
{
    struct gltf a, b;
    struct error error;
    if (!gltf_read(path, &a, &error) || !gltf_read(other_path, &b, &error)) fail_msg("%s", error.text);
    assert_int_equal(a.node_count, b.node_count);
    for (int n = 0; n < a.node_count; n++) {
        assert_string_equal(a.nodes[n].name, b.nodes[n].name);
        assert_memory_equal(&a.nodes[n].place, &b.nodes[n].place, sizeof a.nodes[n].place);
    }
    assert_int_equal(a.meshes[0].part_count, b.meshes[0].part_count);
    for (int p = 0; p < a.meshes[0].part_count; p++) assert_same_part(&a.meshes[0].parts[p], &b.meshes[0].parts[p]);
    assert_int_equal(a.clip_count, b.clip_count);
    for (int c = 0; c < a.clip_count; c++) {
        if (strcmp(a.clips[c].name, "Walk") != 0) assert_same_clip(&a.clips[c], &b.clips[c]);
    }
    assert_memory_equal(a.materials, b.materials, (size_t)a.material_count * sizeof *a.materials);
    assert_int_equal(a.image_count, 1);
    assert_int_equal(b.image_count, 1);
    assert_memory_equal(a.images[0].pixels, b.images[0].pixels, 4 * (size_t)(a.images[0].width * a.images[0].height));
    gltf_free(&a);
    gltf_free(&b);
}

/// Exports a scene whose only character is that file, without a chain.
static void convert(const char *model, const char *file)
{
    char text[512];
    struct export_report report;
    struct error error;
    const struct export_options usual = {0};
    snprintf(text, sizeof text,
             "{\"wiggly\": 1, \"frames\": [0, 24], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": "
             "[]}], \"rigs\": [{\"type\": \"model\", \"model\": \"%s\"}]}",
             model);
    assert_true(file_write_atomic(folder_path("one.json"), text, strlen(text), &error));
    struct opened scene = open_scene(folder_path("one.json"));
    if (!export_write(posing_of(&scene), folder_path(file), &usual, &report, &error)) fail_msg("%s", error.text);
    close_scene(&scene);
}

/// dog.glb as a .gltf that names a file of bytes and a picture beside it.
static void scatter_dog(void)
{
    size_t size;
    struct error error;
    char *dog = bytes_of("assets/models/dog.glb", &size), buffer[64];
    const size_t json = word_at(dog + 12), chunk = word_at(dog + 20 + json);
    char *text = strndup(dog + 20, json), *picture = memmem(dog, size, "\x89PNG", 4);
    struct splice splice = {.text = text};
    assert_non_null(picture);
    snprintf(buffer, sizeof buffer, "{\"byteLength\":%zu,\"uri\":\"a%%20dog.bin\"}", chunk);
    splice_replace(&splice, "buffers", 0, NULL, buffer);
    splice_replace(&splice, "images", 0, NULL, "{\"uri\":\"tag.png\"}");
    char *scattered = splice_apply(&splice);
    assert_non_null(scattered);
    assert_true(file_write_atomic(folder_path("dog.gltf"), scattered, strlen(scattered), &error));
    assert_true(file_write_atomic(folder_path("a dog.bin"), dog + 28 + json, chunk, &error));
    assert_true(file_write_atomic(folder_path("tag.png"), picture, (size_t)(dog + size - picture), &error));
    splice_free(&splice);
    free(scattered);
    free(text);
    free(dog);
}

/// A .gltf with files beside it becomes one .glb, and a .glb one .gltf; there and back nothing is lost.
static void containers_change_and_hold_the_same(void **state)
{
    (void)state;
    scatter_dog();
    assert_same_dog("assets/models/dog.glb", folder_path("dog.gltf"));
    convert("dog.gltf", "whole.glb");
    const char *const beside[] = {"dog.gltf", "a dog.bin", "tag.png"};
    for (int i = 0; i < 3; i++) assert_int_equal(remove(folder_path(beside[i])), 0);
    assert_same_dog("assets/models/dog.glb", folder_path("whole.glb"));
    convert("whole.glb", "back.gltf");
    assert_same_dog("assets/models/dog.glb", folder_path("back.gltf"));
    struct points points = read_points(export_scene("dog", "dog.npy", (struct export_options){0}));
    const char *chained = export_scene("dog", "chained.gltf", (struct export_options){0});
    assert_near(glb_clip_is_off(chained, "Walk", &points), 0, 5e-6);
    assert_same_dog("assets/models/dog.glb", chained);
    free(points.number);
}

/// Every change is made, and no other byte: spaces, numbers and unknown members stay as they are.
static void splices_touch_nothing_else(void **state)
{
    (void)state;
    struct splice splice = {
        .text =
            "{ \"a\" : [ 1.0,{\"x\": \"]\\\"}\"} ],\n \"b\":[],\t\"n\":{\"a\":[7]}, \"c\":[{\"k\":1, \"l\":2 }] }"};
    splice_append(&splice, "a", "3");
    splice_append(&splice, "b", "4");
    splice_append(&splice, "d", "5");
    splice_replace(&splice, "a", 0, NULL, "9");
    splice_replace(&splice, "c", 0, "l", "8");
    char *text = splice_apply(&splice);
    assert_string_equal(text, "{\"d\":[5], \"a\" : [ 9,{\"x\": \"]\\\"}\"},3 ],\n \"b\":[4],\t\"n\":{\"a\":[7]}, "
                              "\"c\":[{\"k\":1, \"l\":8 }] }");
    free(text);
    splice_free(&splice);
}

/// The only clip of a file; its channels are given one by one.
static void each_channel(const char *path, void (*visit)(const struct gltf_channel *channel))
{
    struct gltf gltf;
    struct error error;
    if (!gltf_read(path, &gltf, &error)) fail_msg("%s", error.text);
    for (int c = 0; c < gltf.clips[0].channel_count; c++) visit(&gltf.clips[0].channels[c]);
    gltf_free(&gltf);
}

static void assert_loops(const struct gltf_channel *channel)
{
    const size_t size = (size_t)channel->components * sizeof *channel->values;
    const float *last = channel->values + (channel->key_count - 1) * channel->components;
    assert_memory_equal(channel->values, last, size);
}

static void assert_short_way(const struct gltf_channel *channel)
{
    if (channel->path != GLTF_ROTATION) return;
    for (int k = 1; k < channel->key_count; k++) {
        const float *a = channel->values + 4 * (k - 1), *b = channel->values + 4 * k;
        assert_true(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] > 0);
    }
}

static void assert_within_one(const struct gltf_channel *channel)
{
    if (channel->path != GLTF_WEIGHTS) return;
    for (int i = 0; i < channel->key_count * channel->components; i++)
        assert_true(channel->values[i] >= 0 && channel->values[i] <= 1);
}

static void keys_loop_and_turn_the_short_way(void **state)
{
    (void)state;
    // 30 keys a second do not fall on the samples, but the last falls on the first.
    each_channel(export_scene("tail", "loop.glb", (struct export_options){.rate = 30}), assert_loops);
    each_channel(export_scene("character", "loop.glb", (struct export_options){0}), assert_loops);
    struct opened scene = open_scene("assets/scenes/tail.json");
    struct tail *tail = document_tail(scene.document, 0);
    for (int n = 0; n < tail->joints; n++)
        tail->rest.value[n] = 119; // where a matrix gives the one quaternion now, its negative then
    struct export_report report;
    struct error error;
    const struct export_options usual = {0};
    assert_true(export_write(posing_of(&scene), folder_path("wild.glb"), &usual, &report, &error));
    close_scene(&scene);
    each_channel(folder_path("wild.glb"), assert_short_way);
}

static void weights_stay_within_one_unless_signed(void **state)
{
    struct gltf gltf;
    struct error error;
    (void)state;
    const char *path = export_scene("character", "split.glb", (struct export_options){0});
    each_channel(path, assert_within_one);
    assert_true(gltf_read(path, &gltf, &error));
    assert_int_equal(gltf.meshes[0].target_count, 8);
    gltf_free(&gltf);
    path = export_scene("character", "signed.glb", (struct export_options){.is_signed = true});
    assert_true(gltf_read(path, &gltf, &error));
    assert_int_equal(gltf.meshes[0].target_count, 4);
    gltf_free(&gltf);
}

/// What is exported can be exported again: our own reader finds the coordinates, to their last digits.
static void an_exported_creature_opens_as_one(void **state)
{
    struct character original, again;
    struct error error;
    (void)state;
    const char *path = export_scene("character", "again.glb", (struct export_options){0});
    if (!character_read(path, &again, &error)) fail_msg("%s", error.text);
    assert_true(character_read("assets/models/creature.glb", &original, &error));
    assert_int_equal(again.coordinate_count, original.coordinate_count);
    assert_int_equal(again.vertex_count, original.vertex_count);
    for (int c = 0; c < original.coordinate_count; c++) {
        assert_string_equal(again.coordinates[c].name, original.coordinates[c].name);
        assert_near(again.coordinates[c].frequency, original.coordinates[c].frequency, 0);
        for (int i = 0; i < 3 * original.vertex_count; i++) {
            assert_near(again.coordinates[c].re[i / 3][i % 3], original.coordinates[c].re[i / 3][i % 3], 1e-7);
            assert_near(again.coordinates[c].im[i / 3][i % 3], original.coordinates[c].im[i / 3][i % 3], 1e-7);
        }
    }
    character_free(&original);
    character_free(&again);
}

static void point_caches_hold_the_same(void **state)
{
    (void)state;
    const struct export_options some = {.has_frames = true, .first = 12, .last = 24, .substeps = 2};
    struct points npy = read_points(export_scene("tail", "p.npy", some));
    struct points pc2 = read_points(export_scene("tail", "p.pc2", some));
    struct points mdd = read_points(export_scene("tail", "p.mdd", some));
    const size_t size = 3 * (size_t)npy.vertices * (size_t)npy.frames * sizeof *npy.number;
    assert_int_equal(npy.frames, 25);
    assert_memory_equal(npy.number, pc2.number, size);
    assert_memory_equal(npy.number, mdd.number, size);
    assert_near(mdd.fps, 48, 1e-3);
    float time[2]; // in frames: the first, and from one to the next
    FILE *file = fopen(folder_path("p.pc2"), "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 20, SEEK_SET), 0);
    assert_int_equal(fread(time, sizeof *time, 2, file), 2);
    assert_int_equal(fclose(file), 0);
    assert_near(time[0], 12, 0);
    assert_near(time[1], 0.5, 0);
    free(npy.number);
    free(pc2.number);
    free(mdd.number);
}

/// Each row has every spline's value and, over a channel's joints, the angles of the pose.
static void a_table_has_splines_and_channels(void **state)
{
    (void)state;
    char line[8192], expected[128];
    struct opened scene = open_scene("assets/scenes/tail.json");
    struct export_report report;
    struct error error;
    const struct export_options usual = {0};
    assert_true(export_write(posing_of(&scene), folder_path("t.csv"), &usual, &report, &error));
    FILE *file = fopen(folder_path("t.csv"), "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(strncmp(line, "frame,sway,up,tail.side.sway.0,tail.side.sway.1,", 48), 0);
    assert_non_null(strstr(line, ",tail.up.up.23\n"));
    for (int k = 0; k <= 30; k++) assert_non_null(fgets(line, sizeof line, file));
    const struct tail *tail = document_tail(scene.document, 0);
    const wiggly_value sway = evaluation_at(&scene.evaluation, 0, 30), up = evaluation_at(&scene.evaluation, 1, 30);
    const double side = tail->channels[0].gain.value[0] * (sway.y + sway.re);
    snprintf(expected, sizeof expected, "30,%.9g", sway.y + sway.re);
    assert_int_equal(strncmp(line, expected, 9), 0);
    double number[4];
    assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf", number, number + 1, number + 2, number + 3), 4);
    assert_near(number[2], up.y + up.re, 1e-12);
    assert_near(number[3], side, 1e-9);
    assert_int_equal(fclose(file), 0);
    close_scene(&scene);
}

static bool stop_at_ten(void *user, long done, long total)
{
    *(long *)user = total;
    return done < 10;
}

static int files_in_folder(void)
{
    int count = 0;
    DIR *open = opendir(folder);
    assert_non_null(open);
    for (struct dirent *entry; (entry = readdir(open));)
        count += strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..");
    closedir(open);
    return count;
}

/// An export that is stopped leaves neither half a file nor a temporary one, and the old file as it was.
static void stopping_leaves_nothing_behind(void **state)
{
    static const char *const names[] = {"a.glb", "a.gltf", "a.usda", "a.bvh", "a.csv", "a.pc2", "a.mdd", "a.npy"};
    (void)state;
    struct opened scene = open_scene("assets/scenes/tail.json");
    long total = 0;
    const struct export_options options = {.proceed = stop_at_ten, .user = &total};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct export_report report;
        struct error error;
        assert_false(export_write(posing_of(&scene), folder_path(names[i]), &options, &report, &error));
        assert_int_equal(total, 121);
        assert_int_equal(files_in_folder(), 0);
    }
    close_scene(&scene);
    scene = open_scene("assets/scenes/dog.json"); // its .usda has a folder of textures
    struct export_report report;
    struct error error;
    assert_false(export_write(posing_of(&scene), folder_path("a.usda"), &options, &report, &error));
    assert_int_equal(files_in_folder(), 0);
    close_scene(&scene);
}

/// A .usda of an imported character names its textures, which are in a folder beside it, as the file had them.
static void textures_are_written_beside(void **state)
{
    (void)state;
    const char *path = export_scene("dog", "dog.usda", (struct export_options){.substeps = 1});
    size_t size, chunk;
    char *text = bytes_of(path, &size), *picture = bytes_of(folder_path("dog_textures/tag_0.png"), &size),
         *dog = bytes_of("assets/models/dog.glb", &chunk);
    assert_non_null(strstr(text, "asset inputs:file = @./dog_textures/tag_0.png@"));
    assert_non_null(strstr(text, "rel material:binding = </scene/dog/materials/tag>"));
    assert_non_null(memmem(dog, chunk, picture, size));
    free(text);
    free(picture);
    free(dog);
    assert_int_equal(files_in_folder(), 2);
}

/// Where the textures cannot be written, nothing is: neither the file nor a part of them.
static void without_its_textures_nothing_is_written(void **state)
{
    (void)state;
    struct opened scene = open_scene("assets/scenes/dog.json");
    struct export_report report;
    struct error error = {0};
    const struct export_options usual = {.substeps = 1};
    assert_true(file_write_atomic(folder_path("dog_textures"), "a file", 6, &error));
    assert_false(export_write(posing_of(&scene), folder_path("dog.usda"), &usual, &report, &error));
    assert_non_null(strstr(error.text, "dog_textures"));
    assert_int_equal(files_in_folder(), 1);
    close_scene(&scene);
}

/// Expects an export to be refused with that sentence.
static void assert_fails(const char *scene_path, const char *file, struct export_options options,
                         const char *sentence)
{
    struct opened scene = open_scene(scene_path);
    struct export_report report;
    struct error error = {0};
    assert_false(export_write(posing_of(&scene), folder_path(file), &options, &report, &error));
    if (!strstr(error.text, sentence)) fail_msg("expected \"%s\" in: %s", sentence, error.text);
    assert_int_equal(files_in_folder(), 0);
    close_scene(&scene);
}

static void refusals_say_what_to_do(void **state)
{
    (void)state;
    const char *tail = "assets/scenes/tail.json", *two = "assets/scenes/compositing.json";
    const struct export_options usual = {0};
    assert_fails(tail, "a.fbx", usual, ".glb, .gltf, .usda, .bvh, .csv, .pc2, .mdd or .npy");
    assert_fails("tests/vectors/complex_default.json", "a.glb", usual,
                 "no rig to export: its splines go into a .csv");
    assert_fails("assets/scenes/character.json", "a.bvh", usual,
                 "cannot hold the character \"character\": export it as .glb, .gltf");
    assert_fails(two, "a.pc2", usual, "choose one of \"nodder\", \"swayer\" with --rig");
    assert_fails(two, "a.glb", (struct export_options){.rig = "noder"}, "\"nodder\", \"swayer\", got \"noder\"");
    assert_fails(tail, "a.glb", (struct export_options){.has_frames = true, .first = 5, .last = 500},
                 "from 0 to 120");
    assert_fails(tail, "a.glb", (struct export_options){.has_frames = true, .first = 9, .last = 5}, "got 9:5");
}

/// Two rigs of a scene come out as two meshes that do not share a name.
static void all_rigs_come_out(void **state)
{
    struct gltf gltf;
    struct error error;
    (void)state;
    assert_true(gltf_read(export_scene("compositing", "two.glb", (struct export_options){0}), &gltf, &error));
    assert_int_equal(gltf.mesh_count, 2);
    assert_true(gltf_find_node(&gltf, "nodder") >= 0 && gltf_find_node(&gltf, "swayer") >= 0);
    assert_string_equal(gltf.clips[0].name, "compositing");
    gltf_free(&gltf);
    const struct export_options one = {.rig = "swayer", .clip = "Sway"};
    assert_true(gltf_read(export_scene("compositing", "one.glb", one), &gltf, &error));
    assert_int_equal(gltf.mesh_count, 1);
    assert_string_equal(gltf.clips[0].name, "Sway");
    gltf_free(&gltf);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(glb_moves_as_the_stage_does, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(without_a_chain_the_file_stays_the_same, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(an_imported_character_gets_a_clip, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(text_files_get_a_clip_too, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(containers_change_and_hold_the_same, folder_make, folder_remove),
        cmocka_unit_test(splices_touch_nothing_else),
        cmocka_unit_test_setup_teardown(tangents_make_up_for_keys, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(keys_loop_and_turn_the_short_way, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(weights_stay_within_one_unless_signed, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(an_exported_creature_opens_as_one, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(point_caches_hold_the_same, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(a_table_has_splines_and_channels, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(stopping_leaves_nothing_behind, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(textures_are_written_beside, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(without_its_textures_nothing_is_written, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(refusals_say_what_to_do, folder_make, folder_remove),
        cmocka_unit_test_setup_teardown(all_rigs_come_out, folder_make, folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
