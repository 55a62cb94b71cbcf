/// What wiggly export writes of characters: their own files with a clip more, in either container; and .usda, of all rigs.
#include "base/png.h"
#include "beast.h"
#include "export/form.h"
#include "export_scene.h"
#include "gltf_builder.h"
#include "model/vector.h"
#include "scene/edit.h"

#include <jansson.h>
#include <sys/stat.h>
#include <unistd.h>

#define EXPORT_TEST(name) TEST_WITH(folder_make, folder_remove, name)

static const char dog_scene[] = "assets/scenes/dog.json", dog_model[] = "assets/models/dog.glb";

/// A spline "s" and these rigs, with ' for ".
static const char *made_scene(const char *rigs)
{
    char text[4096];
    snprintf(
        text, sizeof text,
        "{'wiggly': 1, 'frames': [0, 24], 'splines': [{'name': 's', 'frequency': 1, 'knots': [{'frame': 0, 'value': "
        "2}, {'frame': 2, 'value': -2}]}], 'rigs': [%s]}",
        rigs);
    return folder_file("made.json", quote(text));
}

/// Exports that scene.
static void export_made(const char *rigs, const char *file)
{
    struct opened scene = open_scene(made_scene(rigs));
    export_opened(&scene, file, (struct export_options){0});
    close_scene(&scene);
}

static size_t word_at(const char *bytes)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

// --- soft on its own skeleton

/// Shapes and skin together are where they are posed, in all clips of the file; by weights from 0 to 1, or signed; and what is painted.
EXPORT_TEST(a_soft_beast_gets_its_swing)
{
    static const char beast[] = "{'type': 'model', 'name': 'beast', 'model': 'beast.glb', %s'coordinates': [{'name': "
                                "'belly', 'spline': 's', 'lag': 40}]}%s";
    static const struct {
        const char *more, *rigs;
        bool is_signed, is_painted;
        int targets;
    } rows[] = {
        {"'clip': 'Walk', ", "", false, false, 10},
        {"'clip': 'Walk', ", "", true, false, 6},
        {"'clip': 'Walk', ",
         ", {'type': 'chain', 'model': 'beast', 'from': 'tail_1', 'to': 'tail_8', 'channels': [{'spline': 's'}]}",
         false, false, 10},
        {"'clip': 'Walk', ", "", false, true, 10},
        {"'clip': 'Walk', ", "", true, true, 6},
        {"", "", false, false, 10},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char rigs[1024];
        assert_true(beast_write_as(folder_path("beast.glb"), true));
        snprintf(rigs, sizeof rigs, beast, rows[r].more, rows[r].rigs);
        struct opened scene = open_scene(made_scene(rigs));
        if (rows[r].is_painted) {
            const int vertices = 8 * BEAST_BONES;
            assert_true(edit_paint_new(scene.document, 0, 1, vertices, NULL));
            struct paint *paint = scene.document->rigs[0]->model.painted;
            for (int v = 0; v < vertices; v++) paint->values[v][0] = 0.3f, paint->values[v][1] = 0.02f * (float)v;
            paint->version++;
            models_follow(scene.models, scene.document);
        }
        struct export_options options = {.is_signed = rows[r].is_signed};
        struct points points = read_points(export_opened(&scene, "beast.npy", (struct export_options){0}));
        const char *path = export_opened(&scene, "out.glb", options), *clip = rows[r].more[0] ? "Walk" : "made";
        assert_near(glb_is_off(path, clip, &points), 0, 1e-6);
        struct gltf after;
        assert_done(gltf_read(path, &after, &error));
        assert_int_equal(after.meshes->target_count, rows[r].targets);
        assert_true(gltf_is_soft(&after));
        gltf_free(&after);
        struct imported before, again; // its coordinate is the same, with the paint in it
        assert_done(imported_read(&before, folder_path("beast.glb"), &error));
        assert_done(imported_read(&again, path, &error));
        for (int v = 0; v < 8 * BEAST_BONES && !rows[r].is_painted; v++)
            assert_near((double)again.figure.character.coordinates[0].re[v][0],
                        (double)before.figure.character.coordinates[0].re[v][0], 1e-6);
        imported_free(&before);
        imported_free(&again);
        free(points.number);
        close_scene(&scene);
    }
}

// --- a clip more

/// The clip is replaced or added; the chunk begins with all bytes that it had. Without a chain the file stays the same.
EXPORT_TEST(an_imported_character_gets_a_clip)
{
    static const char *const names[] = {NULL, "Wag"};
    struct points points = read_points(export_scene("dog", "dog.npy", (struct export_options){.substeps = 2}));
    struct gltf before, after;
    size_t size, larger;
    char *original = bytes_of(dog_model, &size), *copy;
    const size_t json = word_at(original + 12), chunk = word_at(original + 20 + json);
    assert_done(gltf_read(dog_model, &before, &error));
    for (int n = 0; n < 2; n++) {
        const struct export_options options = {.clip = names[n], .substeps = 2};
        const char *path = export_scene("dog", "dog.glb", options);
        assert_near(glb_is_off(path, n ? "Wag" : "Walk", &points), 0, 5e-6);
        assert_done(gltf_read(path, &after, &error));
        assert_int_equal(after.clip_count, before.clip_count + n);
        assert_string_equal(after.clips[1].name, before.clips[1].name);
        assert_near(after.clips[1].last, before.clips[1].last, 0);
        gltf_free(&after);
        copy = bytes_of(path, &larger);
        assert_memory_equal(original + 28 + json, copy + 28 + word_at(copy + 12), chunk);
        free(copy);
    }
    gltf_free(&before);
    free(points.number);

    struct opened scene = open_scene(dog_scene);
    for (int r = scene.document->rig_count - 1; r >= 0; r--)
        if (scene.document->rigs[r]->kind == RIG_CHAIN) document_remove_rig(scene.document, r);
    copy = bytes_of(export_opened(&scene, "same.glb", (struct export_options){0}), &larger);
    assert_int_equal(size, larger);
    assert_memory_equal(original, copy, size);
    free(original);
    free(copy);
    close_scene(&scene);
}

/// A .gltf of ours goes in as a character, gets a chain, and comes out as a .gltf or .glb.
EXPORT_TEST(text_files_get_a_clip_too)
{
    export_scene("tail", "fox.gltf", (struct export_options){0});
    struct opened scene = open_scene(
        made_scene("{'type': 'model', 'name': 'fox', 'model': 'fox.gltf', 'clip': 'tail'}, {'type': 'chain', 'name': "
                   "'end', 'model': 'fox', 'from': 'tail_12', 'to': 'tail_23', 'channels': [{'spline': 's'}]}"));
    struct points points = read_points(export_opened(&scene, "fox.npy", (struct export_options){0}));
    export_opened(&scene, "out.gltf", (struct export_options){.is_signed = true});
    assert_near(glb_is_off(folder_path("out.gltf"), "tail", &points), 0, 5e-6);
    export_opened(&scene, "out.glb", (struct export_options){0});
    assert_near(glb_is_off(folder_path("out.glb"), "tail", &points), 0, 5e-6);
    close_scene(&scene);
    free(points.number);
}

/// All that a file of the dog holds, as bytes, but its clip "Walk".
static char *contents_of(const char *path, size_t *size)
{
#define PUT(at, count) fwrite(at, sizeof *(at), (size_t)(count), out)
    char *bytes;
    struct gltf g;
    FILE *out = open_memstream(&bytes, size);
    assert_non_null(out);
    assert_done(gltf_read(path, &g, &error));
    for (const struct gltf_node *n = g.nodes; n < g.nodes + g.node_count; n++) {
        PUT(n->name, strlen(n->name));
        PUT(&n->place, 1);
    }
    for (const struct gltf_part *p = g.meshes[0].parts; p < g.meshes[0].parts + g.meshes[0].part_count; p++) {
        PUT(&p->material, 1);
        PUT(p->position, p->vertex_count);
        PUT(p->normal, p->vertex_count);
        PUT(p->joints, p->vertex_count);
        PUT(p->weights, p->vertex_count);
        PUT(p->indices, p->index_count);
    }
    for (const struct gltf_clip *clip = g.clips; clip < g.clips + g.clip_count; clip++) {
        PUT(clip->name, strlen(clip->name));
        for (int c = 0; strcmp(clip->name, "Walk") != 0 && c < clip->channel_count; c++) {
            const struct gltf_channel *channel = &clip->channels[c];
            PUT(channel->times, channel->key_count);
            PUT(channel->values, channel->key_count * channel->components);
        }
    }
    for (const struct gltf_material *m = g.materials; m < g.materials + g.material_count; m++) {
        PUT(m->name, strlen(m->name));
        PUT(&m->color, 1);
        PUT(&m->sampler, 1);
    }
    assert_int_equal(g.image_count, 1);
    PUT(g.images[0].pixels, 4 * g.images[0].width * g.images[0].height);
    gltf_free(&g);
    assert_int_equal(fclose(out), 0);
    return bytes;
}

static void assert_same_dog(const char *path)
{
    size_t size, other_size;
    char *dog = contents_of(dog_model, &size), *other = contents_of(path, &other_size);
    assert_int_equal(size, other_size);
    assert_memory_equal(dog, other, size);
    free(dog);
    free(other);
}

/// A .gltf with files beside it, of bytes and a picture, becomes one .glb, and a .glb one .gltf; there and back nothing is lost.
EXPORT_TEST(containers_change_and_hold_the_same)
{
    size_t size;
    char *dog = bytes_of(dog_model, &size), *picture = memmem(dog, size, "\x89PNG", 4);
    const size_t length = word_at(dog + 12), chunk = word_at(dog + 20 + length);
    json_t *json = json_loadb(dog + 20, length, 0, NULL);
    assert_true(picture && json);
    json_object_set_new(json_array_get(json_object_get(json, "buffers"), 0), "uri", json_string("a%20dog.bin"));
    json_array_set_new(json_object_get(json, "images"), 0, json_pack("{s:s}", "uri", "tag.png"));
    assert_int_equal(json_dump_file(json, folder_path("dog.gltf"), 0), 0);
    assert_done(file_write_atomic(folder_path("a dog.bin"), dog + 28 + length, chunk, &error));
    assert_done(file_write_atomic(folder_path("tag.png"), picture, (size_t)(dog + size - picture), &error));
    json_decref(json);
    free(dog);

    assert_same_dog(folder_path("dog.gltf"));
    export_made("{'type': 'model', 'model': 'dog.gltf'}", "whole.glb");
    const char *const beside[] = {"dog.gltf", "a dog.bin", "tag.png"};
    for (int i = 0; i < 3; i++) assert_int_equal(remove(folder_path(beside[i])), 0);
    assert_same_dog(folder_path("whole.glb"));
    export_made("{'type': 'model', 'model': 'whole.glb'}", "back.gltf");
    assert_same_dog(folder_path("back.gltf"));
    const struct export_options options = {.substeps = 2};
    struct points points = read_points(export_scene("dog", "dog.npy", options));
    const char *chained = export_scene("dog", "chained.gltf", options);
    assert_near(glb_is_off(chained, "Walk", &points), 0, 5e-6);
    assert_same_dog(chained);
    free(points.number);
}

/// What wiggly does not know, numbers to the last bit, odd names and the order of members: all stays but what the clip adds.
EXPORT_TEST(what_is_not_known_stays)
{
    static const char text[] =
        "{\"extras\":{\"big\":9007199254740993,\"real\":0.1,\"whole\":2.0,\"tiny\":1e-300,\"odd\":[null,true,"
        "\"\\u00e9/\\n\"]},"
        "\"as\\u0073et\":{\"version\":\"2.0\",\"generator\":\"theirs\"},\"nodes\":[{\"name\":\"a\",\"children\":[1],"
        "\"translation\":[0,0.30000000000000004,0]},{\"name\":\"b\",\"translation\":[0,1,0],\"extensions\":{\"EXT_"
        "none\":"
        "{\"k\":[1.5]}}}],\"unknown\":[{\"x\":1},{}],\"extensionsUsed\":[\"EXT_none\"],\"unknown\":[{\"x\":2}]}";
    static const char *const added[] = {"animations", "accessors", "bufferViews", "buffers"};
    folder_file("theirs.gltf", text);
    export_made(
        "{'type': 'model', 'name': 'it', 'model': 'theirs.gltf'}, {'type': 'chain', 'name': 'c', 'model': 'it', "
        "'from': 'a', 'to': 'b', 'channels': [{'spline': 's'}]}",
        "out.gltf");
    json_t *before = json_loads(text, 0, NULL), *after = json_load_file(folder_path("out.gltf"), 0, NULL);
    assert_int_equal(json_array_size(json_object_get(after, "animations")), 1);
    for (int a = 0; a < 4; a++) assert_int_equal(json_object_del(after, added[a]), 0);
    char *was = json_dumps(before, JSON_REAL_PRECISION(17)), *is = json_dumps(after, JSON_REAL_PRECISION(17));
    assert_string_equal(was, is);
    free(was);
    free(is);
    json_decref(before);
    json_decref(after);
}

/// Characters that others have written with a bone of scale 0, with a buffer longer than it says, and one that does not say how long it is.
EXPORT_TEST(what_opens_is_exported_whole)
{
    static const char *const models[] = {"flat.glb", "short.glb", "unsaid.glb"};
    char here[2048], rigs[3000];
    assert_non_null(getcwd(here, sizeof here));
    for (int n = 0; n < 6; n++) {
        struct error error = {0};
        struct gltf gltf;
        snprintf(
            rigs, sizeof rigs,
            "{'type': 'model', 'name': 'it', 'model': '%s/tests/fuzz/seeds/export/%s'}, {'type': 'chain', 'name': "
            "'tail', 'model': 'it', 'from': 'root', 'to': '%s', 'channels': [{'spline': 's', 'axis': 'side', "
            "'gain': 9}]}",
            here, models[n / 2], n < 2 ? "node 1" : "tip");
        struct opened scene = open_scene(made_scene(rigs));
        const struct skeleton *skeleton = &models_imported(scene.models, scene.document, 0)->skeleton;
        for (int i = 0; i < 3 * skeleton->count; i++) assert_true(isfinite(skeleton->bones[i / 3].tip[i % 3]));
        const char *file = export_opened(&scene, n % 2 ? "out.gltf" : "out.glb", (struct export_options){0});
        if (!gltf_read(file, &gltf, &error)) fail_msg("%s: %s", models[n / 2], error.text);
        gltf_free(&gltf);
        close_scene(&scene);
    }
}

// --- .usda

/// As many numbers behind a name as there is room for, however their brackets nest; −1: there is no such name.
static int read_numbers(const char *text, const char *name, double *numbers, int room)
{
    const char *at = strstr(text, name);
    int count = 0;
    if (!at) return -1;
    at += strlen(name);
    for (char *end; count < room; count++, at = end) {
        at += strspn(at, " (,)[");
        numbers[count] = strtod(at, &end);
        if (end == at) break;
    }
    return count;
}

/// The quoted names of the array behind a name, a row of `names` each; returns how many.
static int read_names(const char *text, const char *name, char names[][256], int room)
{
    const char *at = strstr(text, name), *end;
    int count = 0;
    if (!at) return 0;
    for (at += strlen(name); count < room && *(at += strspn(at, "[, ")) == '"'; at = end + 1) {
        end = strchr(at + 1, '"');
        snprintf(names[count++], sizeof *names, "%.*s", (int)(end - at - 1), at + 1);
    }
    return count;
}

/// The samples of an attribute at a key, or the only ones.
static int read_key(const char *text, const char *attribute, int key, double *numbers, int room)
{
    char name[64];
    const char *samples = strstr(text, attribute), *end = samples ? strchr(samples, '}') : NULL, *at;
    if (!end) return 0;
    snprintf(name, sizeof name, " %d: ", key);
    at = strstr(samples, name);
    if (!at || at > end) at = strstr(samples, strcpy(name, " 0: "));
    return read_numbers(at, name, numbers, room);
}

enum { JOINTS = 128, VERTICES = 16384, EACH = 4, TARGETS = 16, KEY = 2 };

static mat4s matrix_of(const double *rows) // USD's rows are cglm's columns
{
    mat4s m;
    for (int i = 0; i < 16; i++) m.raw[i / 4][i % 4] = (float)rows[i];
    return m;
}

/// UsdSkel's rule for a mesh at a key: (p + Σ weight · offset) G Σ w B⁻¹ J with rows for vectors, J a joint's matrix on its parents'; and where
/// the whole stands.
static double usda_is_off(const char *text, const struct points *points)
{
    static char joints[JOINTS][256], moved[JOINTS][256], shapes[TARGETS][256], own[TARGETS][256];
    static double bind[JOINTS * 16], rest[JOINTS * 16], place[JOINTS * 3], turn[JOINTS * 4], size[JOINTS * 3],
        point[VERTICES * 3], slot[VERTICES * EACH], weight[VERTICES * EACH], offset[VERTICES * 3], amount[TARGETS];
    double matrix[16];
    mat4s world[JOINTS], skin[JOINTS], stage = glms_mat4_identity();
    const int count = read_names(text, "joints = ", joints, JOINTS);
    const char *animation = strstr(text, "def SkelAnimation");
    const int moving = animation ? read_names(animation, "joints = ", moved, JOINTS) : 0;
    const int shape_count = animation ? read_names(animation, "blendShapes = ", shapes, TARGETS) : 0;
    assert_true(animation && count > 0);
    if (read_numbers(text, "xformOp:transform = ", matrix, 16) == 16) stage = matrix_of(matrix);
    assert_int_equal(read_numbers(text, "] bindTransforms = ", bind, JOINTS * 16), 16 * count);
    assert_int_equal(read_numbers(text, "] restTransforms = ", rest, JOINTS * 16), 16 * count);
    assert_int_equal(read_key(text, "translations.timeSamples", KEY, place, JOINTS * 3), 3 * moving);
    assert_int_equal(read_key(text, "rotations.timeSamples", KEY, turn, JOINTS * 4), 4 * moving);
    assert_int_equal(read_key(text, "scales.timeSamples", KEY, size, JOINTS * 3), 3 * moving);
    assert_int_equal(read_key(text, "blendShapeWeights.timeSamples", KEY, amount, TARGETS), shape_count);
    for (int j = 0; j < count; j++) {
        mat4s local = matrix_of(rest + 16 * j);
        for (int m = 0; m < moving; m++) {
            const double *q = turn + 4 * m, *t = place + 3 * m, *s = size + 3 * m;
            if (strcmp(moved[m], joints[j]) != 0) continue;
            local = glms_translate_make((vec3s){{(float)t[0], (float)t[1], (float)t[2]}});
            local =
                glms_mat4_mul(local, glms_quat_mat4((versors){{(float)q[1], (float)q[2], (float)q[3], (float)q[0]}}));
            local = glms_scale(local, (vec3s){{(float)s[0], (float)s[1], (float)s[2]}});
        }
        world[j] = local;
        const char *slash = strrchr(joints[j], '/');
        for (int p = 0; slash && p < j; p++)
            if (strncmp(joints[p], joints[j], (size_t)(slash - joints[j])) == 0 && !joints[p][slash - joints[j]])
                world[j] = glms_mat4_mul(world[p], local);
        skin[j] = glms_mat4_mul(world[j], glms_mat4_inv(matrix_of(bind + 16 * j)));
    }
    const double *expected = frame_of(points, KEY);
    int vertex = 0;
    double off = 0;
    for (const char *mesh = text; (mesh = strstr(mesh, "def Mesh")); mesh++) {
        const char *next = strstr(mesh + 1, "def Mesh");
        char *block = strndup(mesh, next ? (size_t)(next - mesh) : strlen(mesh));
        const int numbers = read_numbers(block, "points = ", point, VERTICES * 3);
        const int slots = read_numbers(block, "jointIndices = ", slot, VERTICES * EACH);
        assert_int_equal(read_numbers(block, "jointWeights = ", weight, VERTICES * EACH), slots);
        const bool is_whole = strstr(block, "interpolation = \"constant\""); // all hangs at one joint
        const mat4s bound =
            read_numbers(block, "geomBindTransform = ", matrix, 16) == 16 ? matrix_of(matrix) : glms_mat4_identity();
        const int own_count = read_names(block, "skel:blendShapes = ", own, TARGETS);
        const char *shape = block;
        for (int t = 0; t < own_count; t++) {
            double by = 0;
            for (int s = 0; s < shape_count; s++) by = strcmp(own[t], shapes[s]) == 0 ? amount[s] : by;
            shape = strstr(shape + 1, "def BlendShape");
            assert_non_null(shape);
            assert_int_equal(read_numbers(shape, " offsets = ", offset, VERTICES * 3), numbers);
            for (int i = 0; i < numbers; i++) point[i] += by * offset[i];
        }
        const int each = is_whole ? 1 : slots / (numbers / 3);
        for (int v = 0; v < numbers / 3; v++, vertex++) {
            const vec3s at = {{(float)point[3 * v], (float)point[3 * v + 1], (float)point[3 * v + 2]}};
            const vec3s there = glms_mat4_mulv3(bound, at, 1);
            vec3s sum = {{0}};
            for (int e = is_whole ? 0 : each * v, end = e + each; e < end; e++)
                sum = glms_vec3_muladds(glms_mat4_mulv3(skin[(int)slot[e]], there, 1), (float)weight[e], sum);
            sum = glms_mat4_mulv3(stage, sum, 1);
            for (int k = 0; k < 3; k++) off = fmax(off, fabs((double)sum.raw[k] - expected[3 * vertex + k]));
        }
        free(block);
    }
    assert_int_equal(vertex, points->vertices);
    return off;
}

/// Of characters, in their file's place or the stage's, and of all other rigs.
EXPORT_TEST(usd_moves_as_the_stage_does)
{
    static const struct {
        const char *scene, *rig;
        bool as_shown;
    } rows[] = {{"dog", NULL, false},       {"dog", NULL, true},     {"tail", NULL, false},
                {"character", NULL, false}, {"curved", NULL, false}, {"compositing", "nodder", false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct export_options options = {
            .has_frames = true, .last = 4, .substeps = 1, .rig = rows[i].rig, .as_shown = rows[i].as_shown};
        char path[128];
        size_t size;
        snprintf(path, sizeof path, "assets/scenes/%s.json", rows[i].scene);
        struct opened scene = strcmp(rows[i].scene, "curved") == 0 ? open_curved() : open_scene(path);
        if (i == 1) scene.document->rigs[0]->model.scale = 0.3, scene.document->rigs[0]->model.turn = 30;
        char *text = bytes_of(export_opened(&scene, "it.usda", options), &size);
        options.as_shown = i > 0; // others are on the stage in any case
        struct points points = read_points(export_opened(&scene, "it.npy", options));
        assert_int_equal(strstr(text, "matrix4d xformOp:transform = ") != NULL, rows[i].as_shown);
        const double off = usda_is_off(text, &points);
        if (!(off <= 1e-5)) fail_msg("%s is off by %g", rows[i].scene, off);
        free(text);
        free(points.number);
        close_scene(&scene);
    }
}

/// Bound where the skin of the file says: a joint's bind matrix undoes its inverse bind matrix. Every face has one material. Textures, in a
/// folder beside it, are as the file had them.
EXPORT_TEST(usd_has_the_skin_and_looks_of_the_file)
{
    static double bind[JOINTS * 16], faces[2 * VERTICES], subset[2 * VERTICES];
    size_t size;
    char *text = bytes_of(export_scene("dog", "dog.usda", (struct export_options){.substeps = 1}), &size);
    struct gltf dog;
    assert_done(gltf_read(dog_model, &dog, &error));
    const struct gltf_skin *skin = &dog.skins[0];
    const int binds = read_numbers(text, "] bindTransforms = ", bind, JOINTS * 16) / 16;
    int found = 0, next = 0;
    for (int n = 0; n < binds * skin->joint_count; n++) {
        double off = 0;
        for (int i = 0; i < 16; i++) {
            double product = 0;
            for (int k = 0; k < 4; k++)
                product += bind[n / skin->joint_count * 16 + 4 * k + i % 4] *
                           (double)skin->inverse_bind[n % skin->joint_count][i / 4 * 4 + k];
            off = fmax(off, fabs(product - (i % 5 == 0)));
        }
        found += off < 1e-5;
    }
    assert_int_equal(found, skin->joint_count);
    const int face_count = read_numbers(text, "] faceVertexCounts = ", faces, 2 * VERTICES);
    for (int f = 0; f < face_count; f++) assert_near(faces[f], 3, 0);
    for (const char *at = text; (at = strstr(at, "int[] indices = ")); at++) {
        const int count = read_numbers(at, "int[] indices = ", subset, 2 * VERTICES);
        for (int i = 0; i < count; i++, next++) assert_near(subset[i], next, 0);
    }
    assert_int_equal(next, face_count);
    assert_non_null(strstr(text, "asset inputs:file = @./dog_textures/tag_0.png@"));
    assert_non_null(strstr(text, "rel material:binding = </scene/dog/materials/tag>"));
    free(text);
    char *picture = bytes_of(folder_path("dog_textures/tag_0.png"), &size);
    assert_int_equal(size, dog.images[0].size);
    assert_memory_equal(picture, dog.images[0].bytes, size);
    assert_int_equal(files_in_folder(), 2);
    free(picture);
    gltf_free(&dog);

    static char joints[2][256];
    text = bytes_of(export_scene("tail", "t.usda", (struct export_options){.substeps = 1}), &size);
    assert_int_equal(read_names(text, "joints = ", joints, 2),
                     2); // a joint's path begins with those that it hangs on
    assert_string_equal(joints[0], "tail_base");
    assert_string_equal(joints[1], "tail_base/tail_body");
    free(text);
}

/// A triangle of each material: what .usda says of it, in this order.
EXPORT_TEST(usd_has_each_material)
{
    static const char *const expected[] = {
        "startTimeCode = 0\n    endTimeCode = 24\n    timeCodesPerSecond = 24\n",
        "def SkelRoot \"_1_a_b\" (\n        displayName = \"1 a-b\"",
        "def Material \"glass\"\n",
        "def Shader \"surface\"\n                {\n                    uniform token info:id = "
        "\"UsdPreviewSurface\"\n",
        "inputs:diffuseColor = (0.5, 0.25, 1)",
        "inputs:opacity = 0.5\n",
        "def Material \"leaf\"\n",
        "inputs:diffuseColor.connect = </scene/_1_a_b/materials/leaf/texture.outputs:rgb>",
        "inputs:opacity.connect = </scene/_1_a_b/materials/leaf/texture.outputs:a>",
        "inputs:opacityThreshold = 0.25\n",
        "def Shader \"texture\"\n                {\n                    uniform token info:id = \"UsdUVTexture\"\n",
        "asset inputs:file = @./m_textures/leaf_0.png@",
        "inputs:scale = (1, 0.5, 1, 1)",
        "inputs:wrapS = \"clamp\"\n",
        "inputs:wrapT = \"mirror\"\n",
        "def Shader \"st\"\n                {\n                    uniform token info:id = "
        "\"UsdPrimvarReader_float2\"\n",
        "def Material \"metal_plate\" (\n                displayName = \"metal.plate\"",
        "inputs:metallic = 0.75\n",
        "inputs:roughness = 0.125\n",
        "def Material \"painted\"\n",
        "inputs:diffuseColor.connect = </scene/_1_a_b/materials/painted/color.outputs:result>",
        "def Shader \"color\"\n                {\n                    uniform token info:id = "
        "\"UsdPrimvarReader_float3\"\n",
        "string inputs:varname = \"displayColor\"",
        "def Mesh \"sheet\"",
        "uniform bool doubleSided = 1",
        "points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0), ",
        "primvars:displayColor = [(0.5, 0.25, 1), (0.5, 0.25, 1), (0.5, 0.25, 1), (1, 0.5, 1), ",
        "(1, 0, 0), (0, 1, 0), (0, 0, 1)]",
        "primvars:st = [(0, 1), (0, 1), (0, 1), (0, 1), (1, 1), (0, 0), ",
        "faceVertexCounts = [3, 3, 3, 3]\n",
        "faceVertexIndices = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]\n",
        "jointIndices = [0] (\n                elementSize = 1\n                interpolation = \"constant\"",
        "GeomSubset \"part_1\"",
        "int[] indices = [0]\n",
        "material:binding = </scene/_1_a_b/materials/glass>",
        "GeomSubset \"part_4\"",
        "int[] indices = [3]\n",
        "material:binding = </scene/_1_a_b/materials/painted>",
    };
    struct builder b = {0};
    size_t size;
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD(&b, FLOAT, float, 2, 0, 0, 1, 0, 0, 1);
    ADD(&b, FLOAT, float, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1);
    assert_done(png_write(folder_path("leaf.png"), 1, 1, (const unsigned char[]){9, 99, 9, 255}, &error));
    folder_file(
        "m.gltf",
        builder_json(
            &b,
            "'images':[{'uri':'leaf.png'}],'samplers':[{'wrapS':33071,'wrapT':33648}],'textures':[{'source':0,'"
            "sampler':0}],"
            "'materials':[{'name':'glass','alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,"
            "0.5]}},"
            "{'name':'leaf','alphaMode':'MASK','alphaCutoff':0.25,'doubleSided':true,'pbrMetallicRoughness':{"
            "'baseColorTexture':{'index':0},'baseColorFactor':[1,0.5,1,1]}},{'name':'metal.plate','"
            "pbrMetallicRoughness':{"
            "'metallicFactor':0.75,'roughnessFactor':0.125}},{'name':'painted'}],'meshes':[{'primitives':["
            "{'attributes':{'POSITION':0},'material':0},{'attributes':{'POSITION':0,'TEXCOORD_0':1},'material':1},"
            "{'attributes':{'POSITION':0},'material':2},{'attributes':{'POSITION':0,'COLOR_0':2},'material':3}]}],"
            "'nodes':[{'name':'sheet','mesh':0}]"));
    export_made("{'type': 'model', 'name': '1 a-b', 'model': 'm.gltf'}", "m.usda");
    char *text = bytes_of(folder_path("m.usda"), &size), *at = text;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        char *found = strstr(at, expected[i]);
        if (!found) fail_msg("the .usda lacks %s in\n%.3000s", expected[i], at);
        at = found + strlen(expected[i]);
    }
    free(text);
}

static int compare_names(const void *a, const void *b) { return strcmp(a, b); }

/// Exports a skeleton whose root has the other bones below it, and reads its joints' paths.
static void export_bones(const char *const *bones, int count, char joints[][256])
{
    size_t size;
    json_t *list = json_array(), *below = json_array(), *nodes = json_array();
    for (int n = 0; n < count; n++) {
        json_array_append_new(list, json_integer(n));
        json_array_append_new(nodes, json_pack("{s:s}", "name", bones[n]));
        if (n > 0) json_array_append_new(below, json_integer(n));
    }
    json_object_set_new(json_array_get(nodes, 0), "children", below);
    json_t *json =
        json_pack("{s:{s:s}, s:o, s:[{s:o}]}", "asset", "version", "2.0", "nodes", nodes, "skins", "joints", list);
    assert_int_equal(json_dump_file(json, folder_path("bones.gltf"), 0), 0);
    json_decref(json);
    export_made("{'type': 'model', 'model': 'bones.gltf'}", "bones.usda");
    char *text = bytes_of(folder_path("bones.usda"), &size);
    assert_int_equal(read_names(text, "joints = ", joints, count + 1), count);
    free(text);
}

/// Prims are called by identifiers, in any script, and may not share a name, however many joints of a file do.
EXPORT_TEST(usd_names_joints)
{
    enum { MANY = 3000, ODD = 9 };
    static const char *const odd[ODD][2] = {
        {"b", "b"},           {"up.-re", "b/up_minus_re"}, {"1a", "b/_1a"},         {"-x", "b/_minus_x"},
        {"a b-c", "b/a_b_c"}, {"尻尾0", "b/尻尾0"},        {"\u0663", "b/_\u0663"}, {"×é", "b/__é"},
        {"хвост", "b/хвост"},
    };
    static char names[MANY + 1][256];
    static const char *bones[MANY];
    for (int n = 0; n < ODD; n++) bones[n] = odd[n][0];
    export_bones(bones, ODD, names);
    for (int n = 0; n < ODD; n++)
        if (strcmp(names[n], odd[n][1]) != 0) fail_msg("%s is called %s", odd[n][0], names[n]);
    for (int n = 0; n < MANY; n++) bones[n] = "b";
    export_bones(bones, MANY, names);
    qsort(names, MANY, sizeof *names, compare_names);
    for (int n = 1; n < MANY; n++) assert_string_not_equal(names[n - 1], names[n]);
}

/// Where the textures cannot be written, nothing is: neither the file nor a part of them. And a picture that cannot take its place in the end:
/// that is said, and neither it nor those before it nor their folder stays.
EXPORT_TEST(without_its_textures_nothing_is_written)
{
    struct export_report report;
    struct sidecars sidecars = {0};
    char textures[PATH_LIMIT];
    const struct export_options usual = {.substeps = 1};
    folder_file("dog_textures", "a file");
    assert_refusal(export_write(posing_of(kept_scene(dog_scene)), folder_path("dog.usda"), &usual, &report, &error),
                   "dog_textures");
    assert_int_equal(files_in_folder(), 1);
    snprintf(textures, sizeof textures, "%s", folder_path("textures"));
    assert_done(sidecars_add(&sidecars, textures, "b.png", "picture", 7, &error));
    assert_done(sidecars_add(&sidecars, textures, "a.png", "picture", 7, &error));
    assert_int_equal(mkdir(folder_path("textures/a.png"), 0777), 0);
    assert_refusal(sidecars_commit(&sidecars, &error), "a.png");
    assert_int_equal(rmdir(folder_path("textures/a.png")), 0);
    sidecars_discard(&sidecars);
    assert_int_equal(files_in_folder(), 1);
}
