/// What wiggly export writes, read back: by the reader of imported characters, by that of motions, and number by number.
#include "export_scene.h"
#include "gltf_builder.h"
#include "model/character.h"

static double glb_is_off(const char *path, const struct points *points)
{
    return glb_clip_is_off(path, NULL, points);
}

TEST_WITH(folder_make, folder_remove, glb_moves_as_the_stage_does)
{
    static const char *const scenes[] = {"tail", "follow", "character", "figure7"};
    for (size_t s = 0; s < (size_t)quick_or_all(3, sizeof scenes / sizeof *scenes); s++) {
        struct points points = read_points(export_scene(scenes[s], "points.npy", (struct export_options){0}));
        const char *glb = export_scene(scenes[s], "rig.glb", (struct export_options){0});
        assert_near(glb_is_off(glb, &points), 0, 5e-6);
        const char *text = export_scene(scenes[s], "rig.gltf", (struct export_options){.is_signed = true});
        assert_near(glb_is_off(text, &points), 0, 5e-6);
        free(points.number);
    }
}

/// Half of the keys miss the swing between them; with tangents they miss much less.
TEST_WITH(folder_make, folder_remove, tangents_make_up_for_keys)
{
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

/// The only clip of a file; its channels are given one by one.
static void each_channel(const char *path, void (*visit)(const struct gltf_channel *channel))
{
    struct gltf gltf;
    assert_done(gltf_read(path, &gltf, &error));
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

TEST_WITH(folder_make, folder_remove, keys_loop_and_turn_the_short_way)
{
    // 30 keys a second do not fall on the samples, but the last falls on the first.
    each_channel(export_scene("tail", "loop.glb", (struct export_options){.rate = 30}), assert_loops);
    each_channel(export_scene("character", "loop.glb", (struct export_options){0}), assert_loops);
    struct opened scene = open_scene("assets/scenes/tail.json");
    struct tail *tail = document_tail(scene.document, 0);
    for (int n = 0; n < tail->joints; n++)
        tail->rest.value[n] = 119; // where a matrix gives the one quaternion now, its negative then
    export_opened(&scene, "wild.glb", (struct export_options){0});
    close_scene(&scene);
    each_channel(folder_path("wild.glb"), assert_short_way);
}

TEST_WITH(folder_make, folder_remove, weights_stay_within_one_unless_signed)
{
    struct gltf gltf;
    const char *path = export_scene("character", "split.glb", (struct export_options){0});
    each_channel(path, assert_within_one);
    assert_done(gltf_read(path, &gltf, &error));
    assert_int_equal(gltf.meshes[0].target_count, 8); // of the two coordinates that the scene moves it by
    gltf_free(&gltf);
    path = export_scene("character", "signed.glb", (struct export_options){.is_signed = true});
    assert_done(gltf_read(path, &gltf, &error));
    assert_int_equal(gltf.meshes[0].target_count, 4);
    gltf_free(&gltf);
}

/// What is exported can be exported again: our own reader finds the coordinates that moved, to their last digits.
TEST_WITH(folder_make, folder_remove, an_exported_creature_opens_as_one)
{
    struct character original, again;
    const char *path = export_scene("character", "again.glb", (struct export_options){0});
    assert_done(character_read(path, &again, &error));
    assert_done(character_read("assets/models/creature.glb", &original, &error));
    assert_int_equal(again.coordinate_count, 2);
    assert_int_equal(again.vertex_count, original.vertex_count);
    for (int c = 0; c < 2; c++) {
        const struct coordinate *to = &again.coordinates[c], *from = original.coordinates;
        while (strcmp(from->name, c ? "side" : "up") != 0) from++;
        assert_string_equal(to->name, from->name);
        assert_near(to->frequency, from->frequency, 0);
        for (int i = 0; i < 3 * original.vertex_count; i++) {
            assert_near(to->re[i / 3][i % 3], from->re[i / 3][i % 3], 1e-7);
            assert_near(to->im[i / 3][i % 3], from->im[i / 3][i % 3], 1e-7);
        }
    }
    character_free(&original);
    character_free(&again);
}

TEST_WITH(folder_make, folder_remove, point_caches_hold_the_same)
{
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

/// A program plays a .pc2 in the node that has the mesh. An .npy is in the space of the character's file.
TEST_WITH(folder_make, folder_remove, point_caches_stand_in_their_node)
{
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    const uint16_t indices[3] = {0, 1, 2}; // without normals, and with a vertex that no triangle has
    static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 1], \"rigs\": [{\"type\": \"model\", \"name\": "
                                "\"box\", \"model\": \"box.gltf\"}]}";
    struct builder b = {0};
    add_data(&b, FLOAT, "VEC3", 4, corners, sizeof corners);
    add_data(&b, USHORT, "SCALAR", 3, indices, sizeof indices);
    const char *json = builder_json(
        &b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"nodes\":["
            "{\"children\":[1],\"scale\":[2,2,2]},{\"mesh\":0,\"translation\":[5,0,0],\"rotation\":[0,0,1,0]}]");
    assert_done(file_write_atomic(folder_path("box.gltf"), json, strlen(json), &error));
    assert_done(file_write_atomic(folder_path("box.json"), scene, strlen(scene), &error));
    struct points pc2 = read_points(export_file(folder_path("box.json"), "box.pc2", (struct export_options){0}));
    struct points npy = read_points(export_file(folder_path("box.json"), "box.npy", (struct export_options){0}));
    assert_int_equal(pc2.vertices, 4);
    for (int i = 0; i < 12; i++) {
        const double side = i % 3 == 2 ? 1 : -1; // half a turn about z
        assert_near(frame_of(&pc2, 1)[i], (double)corners[i / 3][i % 3], 1e-6);
        assert_near(frame_of(&npy, 1)[i], 2 * (side * (double)corners[i / 3][i % 3] + (i % 3 == 0 ? 5 : 0)), 1e-6);
    }
    free(pc2.number);
    free(npy.number);
}

/// Where no key falls on the last frame, the report says where the last key is; else it says nothing of it.
TEST_WITH(folder_make, folder_remove, a_rate_that_misses_the_end_is_said)
{
    struct opened *scene = kept_scene("assets/scenes/tail.json"); // 24 frames a second
    for (int misses = 0; misses < 2; misses++) {
        const struct export_options options = {.rate = misses ? 18 : 12, .has_frames = true, .last = 22};
        struct export_report report = {0};
        assert_done(export_write(posing_of(scene), folder_path("t.csv"), &options, &report, &error));
        assert_int_equal(strstr(report.note, "the last key is on frame") != NULL, misses);
    }
}

/// A joint's path in a .usda begins with those that it hangs on.
TEST_WITH(folder_make, folder_remove, usd_joints_hang_on_each_other)
{
    size_t size;
    char *text = bytes_of(export_scene("tail", "t.usda", (struct export_options){.substeps = 1}), &size);
    assert_non_null(strstr(text, "joints = [\"tail_base\", \"tail_base/tail_body\", "));
    assert_non_null(strstr(text, ", \"tail_base/tail_body/tail_chest\", "));
    free(text);
}

/// Each row has every spline's value and, over a channel's joints, the angles of the pose.
TEST_WITH(folder_make, folder_remove, a_table_has_splines_and_channels)
{
    char line[8192], expected[128];
    struct opened *scene = kept_scene("assets/scenes/tail.json");
    export_opened(scene, "t.csv", (struct export_options){0});
    FILE *file = fopen(folder_path("t.csv"), "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(strncmp(line, "frame,sway,up,breath,blink,tail.side.sway.0,tail.side.sway.1,", 61), 0);
    assert_non_null(strstr(line, ",tail.up.up.23,tail.look.sway,"));
    for (int k = 0; k <= 30; k++) assert_non_null(fgets(line, sizeof line, file));
    const struct tail *tail = document_tail(scene->document, 0);
    const wiggly_value sway = evaluation_at(&scene->evaluation, 0, 30), up = evaluation_at(&scene->evaluation, 1, 30);
    const double side = tail->channels[0].gain.value[0] * (sway.y + sway.re);
    snprintf(expected, sizeof expected, "30,%.9g", sway.y + sway.re);
    assert_int_equal(strncmp(line, expected, 9), 0);
    double number[6];
    assert_int_equal(
        sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf", number, number + 1, number + 2, number + 3, number + 4, number + 5),
        6);
    assert_near(number[2], up.y + up.re, 1e-12);
    assert_near(number[5], side, 1e-9);
    assert_int_equal(fclose(file), 0);
}

static bool stop_at_ten(void *user, long done, long total)
{
    *(long *)user = total;
    return done < 10;
}

/// An export that is stopped leaves neither half a file nor a temporary one, and the old file as it was.
TEST_WITH(folder_make, folder_remove, stopping_leaves_nothing_behind)
{
    static const char *const names[] = {"a.glb", "a.gltf", "a.usda", "a.bvh", "a.csv", "a.pc2", "a.mdd", "a.npy"};
    struct opened *scene = kept_scene("assets/scenes/tail.json");
    long total = 0;
    const struct export_options options = {.proceed = stop_at_ten, .user = &total};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct export_report report;
        struct error error;
        assert_false(export_write(posing_of(scene), folder_path(names[i]), &options, &report, &error));
        assert_int_equal(total, 121);
        assert_int_equal(files_in_folder(), 0);
    }
    scene = kept_scene("assets/scenes/dog.json"); // its .usda has a folder of textures
    struct export_report report;
    struct error error;
    assert_false(export_write(posing_of(scene), folder_path("a.usda"), &options, &report, &error));
    assert_int_equal(files_in_folder(), 0);
}

/// Expects an export to be refused with that sentence.
static void assert_fails(const char *scene_path, const char *file, struct export_options options,
                         const char *sentence)
{
    struct export_report report;
    assert_refusal(export_write(posing_of(kept_scene(scene_path)), folder_path(file), &options, &report, &error),
                   sentence);
    assert_int_equal(files_in_folder(), 0);
}

TEST_WITH(folder_make, folder_remove, refusals_say_what_to_do)
{
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
TEST_WITH(folder_make, folder_remove, all_rigs_come_out)
{
    struct gltf gltf;
    struct error error;
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
