/// What wiggly export writes of imported characters: their own files with a clip more, in either container, and .usda.
#include "base/file.h"
#include "export/form.h"
#include "export_scene.h"
#include "model/vector.h"

#include <jansson.h>
#include <sys/stat.h>
#include <unistd.h>

/// The dog's scene without its chains; the caller closes it.
static struct opened open_dog_without_chains(void)
{
    struct opened scene = open_scene("assets/scenes/dog.json");
    struct document *document = scene.document;
    for (int r = document->rig_count - 1; r >= 0; r--) {
        if (document->rigs[r]->kind != RIG_CHAIN) continue;
        document_remove_rig(document, r);
    }
    return scene;
}

TEST_WITH(folder_make, folder_remove, without_a_chain_the_file_stays_the_same)
{
    struct opened scene = open_dog_without_chains();
    size_t size, again;
    export_opened(&scene, "same.glb", (struct export_options){0});
    close_scene(&scene);
    char *original = bytes_of("assets/models/dog.glb", &size), *copy = bytes_of(folder_path("same.glb"), &again);
    assert_int_equal(size, again);
    assert_memory_equal(original, copy, size);
    free(original);
    free(copy);
}

/// The clip is replaced or added; the chunk begins with all bytes that it had.
TEST_WITH(folder_make, folder_remove, an_imported_character_gets_a_clip)
{
    static const char *const names[] = {NULL, "Wag"};
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
        assert_near(after.clips[1].last, before.clips[1].last, 0);
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
TEST_WITH(folder_make, folder_remove, text_files_get_a_clip_too)
{
    static const char scene_text[] =
        "{\"wiggly\": 1, \"frames\": [0, 24], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": "
        "[{\"frame\": 0, \"value\": 2}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"fox\", \"model\": "
        "\"fox.gltf\", \"clip\": \"tail\"}, {\"type\": \"chain\", \"name\": \"end\", \"model\": \"fox\", \"from\": "
        "\"tail_12\", \"to\": \"tail_23\", \"channels\": [{\"spline\": \"s\"}]}]}";
    const struct export_options usual = {0}, signed_weights = {.is_signed = true};
    export_scene("tail", "fox.gltf", usual);
    struct opened scene = open_scene(folder_file("scene.json", scene_text));
    export_opened(&scene, "fox.npy", (struct export_options){0});
    struct points points = read_points(folder_path("fox.npy"));
    export_opened(&scene, "out.gltf", signed_weights);
    assert_near(glb_clip_is_off(folder_path("out.gltf"), "tail", &points), 0, 5e-6);
    export_opened(&scene, "out.glb", (struct export_options){0});
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
    assert_done(gltf_read(path, &a, &error) && gltf_read(other_path, &b, &error));
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
    assert_int_equal(a.material_count, b.material_count);
    for (int m = 0; m < a.material_count; m++) {
        assert_string_equal(a.materials[m].name, b.materials[m].name);
        assert_memory_equal(a.materials[m].color, b.materials[m].color, sizeof a.materials[m].color);
        assert_memory_equal(&a.materials[m].sampler, &b.materials[m].sampler, sizeof a.materials[m].sampler);
    }
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
    snprintf(text, sizeof text,
             "{\"wiggly\": 1, \"frames\": [0, 24], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": "
             "[]}], \"rigs\": [{\"type\": \"model\", \"model\": \"%s\"}]}",
             model);
    struct opened scene = open_scene(folder_file("one.json", text));
    export_opened(&scene, file, (struct export_options){0});
    close_scene(&scene);
}

/// dog.glb as a .gltf that names a file of bytes and a picture beside it.
static void scatter_dog(void)
{
    size_t size;
    char *dog = bytes_of("assets/models/dog.glb", &size);
    const size_t length = word_at(dog + 12), chunk = word_at(dog + 20 + length);
    char *picture = memmem(dog, size, "\x89PNG", 4);
    json_t *json = json_loadb(dog + 20, length, 0, NULL);
    assert_non_null(picture);
    json_object_set_new(json_array_get(json_object_get(json, "buffers"), 0), "uri", json_string("a%20dog.bin"));
    json_array_set_new(json_object_get(json, "images"), 0, json_pack("{s:s}", "uri", "tag.png"));
    assert_int_equal(json_dump_file(json, folder_path("dog.gltf"), 0), 0);
    assert_done(file_write_atomic(folder_path("a dog.bin"), dog + 28 + length, chunk, &error));
    assert_done(file_write_atomic(folder_path("tag.png"), picture, (size_t)(dog + size - picture), &error));
    json_decref(json);
    free(dog);
}

/// What wiggly does not know, numbers to the last bit, odd names and the order of members: all stays but what the clip adds.
TEST_WITH(folder_make, folder_remove, what_is_not_known_stays)
{
    static const char text[] =
        "{\"extras\":{\"big\":9007199254740993,\"real\":0.1,\"whole\":2.0,\"tiny\":1e-300,\"odd\":[null,true,"
        "\"\\u00e9/\\n\"]},"
        "\"as\\u0073et\":{\"version\":\"2.0\",\"generator\":\"theirs\"},\"nodes\":[{\"name\":\"a\",\"children\":[1],"
        "\"translation\":[0,0.30000000000000004,0]},{\"name\":\"b\",\"translation\":[0,1,0],\"extensions\":{\"EXT_"
        "none\":"
        "{\"k\":[1.5]}}}],\"unknown\":[{\"x\":1},{}],\"extensionsUsed\":[\"EXT_none\"],\"unknown\":[{\"x\":2}]}";
    static const char scene_text[] =
        "{\"wiggly\": 1, \"frames\": [0, 2], \"splines\": [{\"name\": \"s\", \"knots\": [{\"frame\": 0, \"value\": "
        "1}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"it\", \"model\": \"theirs.gltf\"}, {\"type\": "
        "\"chain\", \"name\": \"c\", \"model\": \"it\", \"from\": \"a\", \"to\": \"b\", \"channels\": [{\"spline\": "
        "\"s\"}]}]}";
    static const char *const added[] = {"animations", "accessors", "bufferViews", "buffers"};
    folder_file("theirs.gltf", text);
    struct opened scene = open_scene(folder_file("scene.json", scene_text));
    export_opened(&scene, "out.gltf", (struct export_options){0});
    close_scene(&scene);
    json_t *before = json_loads(text, 0, NULL), *after = json_load_file(folder_path("out.gltf"), 0, NULL);
    assert_int_equal(json_array_size(json_object_get(after, "animations")), 1);
    for (int a = 0; a < 4; a++) assert_int_equal(json_object_del(after, added[a]), 0);
    char *as_it_was = json_dumps(before, JSON_REAL_PRECISION(17)),
         *as_it_is = json_dumps(after, JSON_REAL_PRECISION(17));
    assert_string_equal(as_it_was, as_it_is);
    free(as_it_was);
    free(as_it_is);
    json_decref(before);
    json_decref(after);
}

/// A .gltf with files beside it becomes one .glb, and a .glb one .gltf; there and back nothing is lost.
TEST_WITH(folder_make, folder_remove, containers_change_and_hold_the_same)
{
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

/// What is behind a name that the file has from `from` on; fails where it has none.
static size_t behind(const char *text, size_t from, const char *name)
{
    const char *found = strstr(text + from, name);
    if (!found) fail_msg("there is no %s", name);
    return (size_t)(found - text) + strlen(name);
}

/// Where the numbers begin that are behind a name.
static size_t numbers_of(const char *text, size_t from, const char *name)
{
    const size_t at = behind(text, from, name);
    return at + strcspn(text + at, "0123456789");
}

/// Reads the next number of a list in brackets, however they nest; false at its end.
static bool next_number(const char *text, size_t *at, double *number)
{
    char *end;
    const char *begin = text + *at + strspn(text + *at, "(, )");
    *number = strtod(begin, &end);
    *at = (size_t)(end - text);
    return end != begin;
}

/// Bound where the skin of the file says: a joint's bind matrix undoes its inverse bind matrix. Every face has one material. Textures, in a
/// folder beside it, are as the file had them.
TEST_WITH(folder_make, folder_remove, usd_has_the_skin_and_looks_of_the_file)
{
    size_t size;
    char *text = bytes_of(export_scene("dog", "dog.usda", (struct export_options){.substeps = 1}), &size);
    struct gltf dog;
    assert_done(gltf_read("assets/models/dog.glb", &dog, &error));
    const struct gltf_skin *skin = &dog.skins[0];
    int found = 0;
    size_t at = numbers_of(text, 0, "] bindTransforms = ");
    for (double bind[16]; next_number(text, &at, &bind[0]);) {
        for (int i = 1; i < 16; i++) assert_true(next_number(text, &at, &bind[i]));
        for (int j = 0; j < skin->joint_count; j++) {
            double off = 0;
            for (int i = 0; i < 16; i++) {
                double product = 0;
                for (int k = 0; k < 4; k++)
                    product += bind[4 * k + i % 4] * (double)skin->inverse_bind[j][i / 4 * 4 + k];
                off = fmax(off, fabs(product - (i % 5 == 0)));
            }
            found += off < 1e-5;
        }
    }
    assert_int_equal(found, skin->joint_count);

    int faces = 0, next = 0;
    double number;
    for (at = numbers_of(text, 0, "] faceVertexCounts = "); next_number(text, &at, &number); faces++)
        assert_near(number, 3, 0);
    while (next < faces) {
        at = numbers_of(text, at, "int[] indices = ");
        for (; next_number(text, &at, &number); next++) assert_near(number, next, 0);
    }
    assert_int_equal(next, faces);
    assert_null(strstr(text + at, "int[] indices = "));

    assert_non_null(strstr(text, "asset inputs:file = @./dog_textures/tag_0.png@"));
    assert_non_null(strstr(text, "rel material:binding = </scene/dog/materials/tag>"));
    char *picture = bytes_of(folder_path("dog_textures/tag_0.png"), &size);
    assert_int_equal(size, dog.images[0].size);
    assert_memory_equal(picture, dog.images[0].bytes, size);
    assert_int_equal(files_in_folder(), 2);
    free(picture);
    gltf_free(&dog);
    free(text);
}

/// As many numbers of an array as there is room for; returns how many.
static int read_numbers(const char *text, size_t at, double *numbers, int room)
{
    int count = 0;
    while (count < room && next_number(text, &at, &numbers[count])) count++;
    return count;
}

/// The quoted names of an array, a row of `names` each; returns how many.
static int read_names(const char *text, size_t at, char names[][256])
{
    int count = 0;
    for (const char *end = text + at; *end == '"' || *(end += strspn(end, "[, ")) == '"'; end++) {
        const size_t length = strcspn(++end, "\"");
        snprintf(names[count++], sizeof *names, "%.*s", (int)length, end);
        end += length;
    }
    return count;
}

/// A key's array behind `attribute`, or the only one.
static size_t key_of(const char *text, const char *attribute, int key)
{
    const char *samples = strstr(text, attribute), *end = samples ? strchr(samples, '}') : NULL;
    char number[16];
    assert_non_null(end);
    snprintf(number, sizeof number, " %d: [", key);
    const char *at = strstr(samples, number);
    if (!at || at > end) at = strstr(samples, " 0: [");
    return (size_t)(strchr(at, '[') + 1 - text);
}

/// UsdSkel's rule for a mesh at a key: p Σ w B⁻¹ J with rows for vectors, J a joint's matrix on its parents'.
TEST_WITH(folder_make, folder_remove, usd_skins_move_as_the_stage_does)
{
    enum { JOINTS = 128, KEY = 2, VERTICES = 16384, EACH = 4 };
    static char joints[JOINTS][256], moved[JOINTS][256];
    static double bind[JOINTS * 16], rest[JOINTS * 16], place[JOINTS * 3], turn[JOINTS * 4], size_of[JOINTS * 3],
        point[VERTICES * 3], slot[VERTICES * EACH], weight[VERTICES * EACH];
    const struct export_options options = {.has_frames = true, .last = 4, .substeps = 1};
    struct points points = read_points(export_scene("dog", "dog.npy", options));
    size_t size;
    char *text = bytes_of(export_scene("dog", "dog.usda", options), &size);
    mat4s world[JOINTS], skin[JOINTS];
    const int count = read_names(text, behind(text, 0, "joints = "), joints);
    const char *animation = strstr(text, "def SkelAnimation");
    const int moving = read_names(animation, behind(animation, 0, "joints = "), moved);
    assert_int_equal(read_numbers(text, numbers_of(text, 0, "] bindTransforms = "), bind, JOINTS * 16), 16 * count);
    assert_int_equal(read_numbers(text, numbers_of(text, 0, "] restTransforms = "), rest, JOINTS * 16), 16 * count);
    assert_int_equal(read_numbers(text, key_of(text, "translations.timeSamples", KEY), place, JOINTS * 3),
                     3 * moving);
    assert_int_equal(read_numbers(text, key_of(text, "rotations.timeSamples", KEY), turn, JOINTS * 4), 4 * moving);
    assert_int_equal(read_numbers(text, key_of(text, "scales.timeSamples", KEY), size_of, JOINTS * 3), 3 * moving);
    for (int j = 0; j < count; j++) { // USD's rows are cglm's columns
        mat4s local, bound;
        for (int i = 0; i < 16; i++) local.raw[i / 4][i % 4] = (float)rest[16 * j + i];
        for (int i = 0; i < 16; i++) bound.raw[i / 4][i % 4] = (float)bind[16 * j + i];
        for (int m = 0; m < moving; m++) {
            const double *q = turn + 4 * m, *t = place + 3 * m, *s = size_of + 3 * m;
            if (strcmp(moved[m], joints[j]) != 0) continue;
            local = glms_translate_make((vec3s){{(float)t[0], (float)t[1], (float)t[2]}});
            local =
                glms_mat4_mul(local, glms_quat_mat4((versors){{(float)q[1], (float)q[2], (float)q[3], (float)q[0]}}));
            local = glms_scale(local, (vec3s){{(float)s[0], (float)s[1], (float)s[2]}});
        }
        world[j] = local;
        char *slash = strrchr(joints[j], '/');
        for (int p = 0; slash && p < j; p++) {
            const size_t length = (size_t)(slash - joints[j]);
            if (strlen(joints[p]) == length && strncmp(joints[p], joints[j], length) == 0)
                world[j] = glms_mat4_mul(world[p], local);
        }
        skin[j] = glms_mat4_mul(world[j], glms_mat4_inv(bound));
    }
    const double *expected = frame_of(&points, KEY);
    int vertex = 0;
    double off = 0;
    for (const char *mesh = text; (mesh = strstr(mesh, "def Mesh")); mesh++) {
        const int numbers = read_numbers(mesh, numbers_of(mesh, 0, "points = "), point, VERTICES * 3);
        const int slots = read_numbers(mesh, numbers_of(mesh, 0, "jointIndices = "), slot, VERTICES * EACH);
        assert_int_equal(read_numbers(mesh, numbers_of(mesh, 0, "jointWeights = "), weight, VERTICES * EACH), slots);
        const int each = slots / (numbers / 3);
        for (int v = 0; v < numbers / 3; v++, vertex++) {
            const vec3s at = {{(float)point[3 * v], (float)point[3 * v + 1], (float)point[3 * v + 2]}};
            vec3s sum = {{0}};
            for (int e = each * v; e < each * (v + 1); e++)
                sum = glms_vec3_muladds(glms_mat4_mulv3(skin[(int)slot[e]], at, 1), (float)weight[e], sum);
            for (int k = 0; k < 3; k++) off = fmax(off, fabs((double)sum.raw[k] - expected[3 * vertex + k]));
        }
    }
    assert_int_equal(vertex, points.vertices);
    assert_near(off, 0, 1e-5);
    free(points.number);
    free(text);
}

static int compare_names(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/// Prims may not share a name, however many joints of a file do.
TEST_WITH(folder_make, folder_remove, usd_tells_joints_of_one_name_apart)
{
    enum { JOINTS = 3000 };
    static const char scene_text[] =
        "{\"wiggly\": 1, \"frames\": [0, 1], \"splines\": [], \"rigs\": [{\"type\": \"model\", "
        "\"model\": \"many.gltf\"}]}";
    json_t *joints = json_pack("[i]", 0), *below = json_array(),
           *nodes = json_pack("[{s:s, s:O}]", "name", "b", "children", below);
    for (int n = 1; n < JOINTS; n++) {
        json_array_append_new(joints, json_integer(n));
        json_array_append_new(below, json_integer(n));
        json_array_append_new(nodes, json_pack("{s:s}", "name", "b"));
    }
    json_t *json =
        json_pack("{s:{s:s}, s:o, s:[{s:o}]}", "asset", "version", "2.0", "nodes", nodes, "skins", "joints", joints);
    assert_int_equal(json_dump_file(json, folder_path("many.gltf"), 0), 0);
    json_decref(json);
    json_decref(below);
    struct opened scene = open_scene(folder_file("one.json", scene_text));
    export_opened(&scene, "many.usda", (struct export_options){0});
    close_scene(&scene);
    static char *names[JOINTS];
    size_t size;
    char *text = bytes_of(folder_path("many.usda"), &size);
    size_t at = behind(text, 0, "joints = [\"");
    for (int n = 0; n < JOINTS; n++) {
        const size_t length = strcspn(text + at, "\"]");
        names[n] = strndup(text + at, length);
        assert_true(length > 0 && names[n]);
        at += length + strlen("\", \"");
    }
    assert_memory_equal(text + at - 3, "]\n", 2); // behind the last
    qsort(names, JOINTS, sizeof *names, compare_names);
    for (int n = 1; n < JOINTS; n++) assert_string_not_equal(names[n - 1], names[n]);
    for (int n = 0; n < JOINTS; n++) free(names[n]);
    free(text);
}

/// Where the textures cannot be written, nothing is: neither the file nor a part of them.
TEST_WITH(folder_make, folder_remove, without_its_textures_nothing_is_written)
{
    struct export_report report;
    const struct export_options usual = {.substeps = 1};
    assert_done(file_write_atomic(folder_path("dog_textures"), "a file", 6, &error));
    assert_refusal(export_write(posing_of(kept_scene("assets/scenes/dog.json")), folder_path("dog.usda"), &usual,
                                &report, &error),
                   "dog_textures");
    assert_int_equal(files_in_folder(), 1);
}

/// A picture that cannot take its place in the end: that is said, and neither it nor its folder stays.
TEST_WITH(folder_make, folder_remove, a_texture_that_cannot_take_its_place_is_told)
{
    struct sidecars sidecars = {0};
    char textures[PATH_LIMIT];
    snprintf(textures, sizeof textures, "%s", folder_path("textures"));
    assert_done(sidecars_add(&sidecars, textures, "a.png", "picture", 7, &error));
    assert_int_equal(mkdir(folder_path("textures/a.png"), 0777), 0);
    assert_refusal(sidecars_commit(&sidecars, &error), "a.png");
    assert_int_equal(rmdir(folder_path("textures/a.png")), 0);
    sidecars_discard(&sidecars);
    assert_int_equal(files_in_folder(), 0);
}

/// Under cubic keys only the chains are a little off: a body of straight lines with a key at each of its own, and one of curves with few.
TEST_WITH(folder_make, folder_remove, a_body_keeps_its_curves)
{
    static const char scene_text[] =
        "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"damping\": 0.1, "
        "\"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 60, \"value\": -1}]}], \"rigs\": [{\"type\": "
        "\"model\", \"name\": \"fox\", \"model\": \"fox.glb\", \"clip\": \"tail\"}, {\"type\": \"chain\", "
        "\"model\": \"fox\", \"from\": \"tail_0\", \"to\": \"tail_3\", \"channels\": [{\"spline\": \"s\", "
        "\"axis\": \"side\", \"gain\": 20}]}]}";
    export_scene("tail", "fox.glb", (struct export_options){.is_cubic = true});
    char fox[128];
    snprintf(fox, sizeof fox, "%s", folder_file("fox.json", scene_text));
    const struct {
        const char *scene, *clip;
        double rate;
        struct export_options part;
    } cases[] = {{"assets/scenes/dog.json", "Walk", 24, {0}},
                 {"assets/scenes/dog.json", "Walk", 24, {.has_frames = true, .first = 5, .last = 77}},
                 {fox, "tail", 12, {0}}};
    for (int c = 0; c < 3; c++) {
        struct export_options options = cases[c].part;
        options.substeps = 4;
        struct points points = read_points(export_file(cases[c].scene, "it.npy", options));
        options.substeps = 0;
        options.rate = cases[c].rate;
        const double linear = glb_clip_is_off(export_file(cases[c].scene, "it.glb", options), cases[c].clip, &points);
        options.is_cubic = true;
        assert_true(linear > 0.004);
        assert_near(glb_clip_is_off(export_file(cases[c].scene, "it.glb", options), cases[c].clip, &points), 0, 1e-3);
        free(points.number);
    }
}

/// Characters that others have written with a bone of scale 0, with a buffer longer than it says, and one that does not say how long it is.
TEST_WITH(folder_make, folder_remove, what_opens_is_exported_whole)
{
    static const char *const models[] = {"flat.glb", "short.glb", "unsaid.glb"}, *const files[] = {"out.glb",
                                                                                                   "out.gltf"};
    char here[2048];
    assert_non_null(getcwd(here, sizeof here));
    for (int n = 0; n < 6; n++) {
        char text[4096];
        struct error error = {0};
        struct gltf gltf;
        snprintf(
            text, sizeof text,
            "{\"wiggly\": 1, \"frames\": [0, 2], \"splines\": [{\"name\": \"s\", \"frequency\": 2, \"knots\": "
            "[{\"frame\": 0, \"value\": 1}, {\"frame\": 2, \"value\": -1}]}], \"rigs\": [{\"type\": \"model\", "
            "\"name\": \"it\", \"model\": \"%s/tests/fuzz/seeds/export/%s\"}, {\"type\": \"chain\", \"name\": "
            "\"tail\", \"model\": \"it\", \"from\": \"root\", \"to\": \"%s\", \"channels\": [{\"spline\": \"s\", "
            "\"axis\": \"side\", \"gain\": 9}]}]}",
            here, models[n / 2], n < 2 ? "node 1" : "tip");
        struct opened scene = open_scene(folder_file("odd.json", text));
        const struct skeleton *skeleton = &models_imported(scene.models, scene.document, 0)->skeleton;
        for (int bone = 0; bone < skeleton->count; bone++) {
            for (int k = 0; k < 3; k++) assert_true(isfinite(skeleton->bones[bone].tip[k]));
        }
        const char *file = export_opened(&scene, files[n % 2], (struct export_options){0});
        if (!gltf_read(file, &gltf, &error)) fail_msg("%s: %s", models[n / 2], error.text);
        gltf_free(&gltf);
        close_scene(&scene);
    }
}
