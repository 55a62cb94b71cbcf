/// What wiggly export writes, read back: by the reader of characters, by that of motions, and number by number; and every bone of a
/// .bvh, where the .glb of the same scene has it.
#include "export_scene.h"
#include "gltf_builder.h"
#include "model/character.h"
#include "model/vector.h"

#define EXPORT_TEST(name) TEST_WITH(folder_make, folder_remove, name)

/// Formats move as the stage does. Half of the keys miss the swing between them.
EXPORT_TEST(gltf_moves_as_the_stage_does)
{
    static const char fox_scene[] =
        "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"damping\": 0.1, "
        "\"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 60, \"value\": -1}]}], \"rigs\": [{\"type\": "
        "\"model\", \"name\": \"fox\", \"model\": \"fox.glb\", \"clip\": \"tail\"}, {\"type\": \"chain\", "
        "\"model\": \"fox\", \"from\": \"tail_0\", \"to\": \"tail_3\", \"channels\": [{\"spline\": \"s\", "
        "\"axis\": \"side\", \"gain\": 20}]}]}";
    static const struct {
        const char *scene;
        int dense; ///< substeps of the points between which the file is judged
        const char *file, *clip;
        double rate;
        int first, last; ///< 0: all frames
        bool is_signed;
        double least, most;
    } rows[] = {
        {"tail", 4, "a.glb", NULL, 96, 0, 0, false, 0, 5e-6},
        {"tail", 4, "a.gltf", NULL, 96, 0, 0, true, 0, 5e-6},
        {"tail", 4, "a.glb", NULL, 8, 0, 0, false, 0.05, 1},
        {"follow", 0, "a.glb", NULL, 0, 0, 0, false, 0, 5e-6},
        {"character", 0, "a.glb", NULL, 0, 0, 0, false, 0, 5e-6},
        {"character", 0, "a.gltf", NULL, 0, 0, 0, true, 0, 5e-6},
        {"character", 4, "a.glb", NULL, 12, 0, 0, false, 0.01, 1},
        {"curved", 0, "a.glb", NULL, 0, 0, 0, false, 0, 1e-6},
        {"curved", 0, "a.gltf", NULL, 0, 0, 0, true, 0, 1e-6},
        {"dog", 2, "a.glb", "Walk", 24, 0, 0, false, 0.004, 1},
        {"dog", 2, "a.glb", "Walk", 24, 5, 77, false, 0.004, 1},
        {"fox", 2, "a.glb", "tail", 12, 0, 0, false, 0.004, 1},
    };
    struct points points = {0};
    char fox[128];
    export_scene("tail", "fox.glb", (struct export_options){0});
    snprintf(fox, sizeof fox, "%s", folder_file("fox.json", fox_scene));
    struct opened made = open_scene(fox), curved = open_curved();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char path[128];
        snprintf(path, sizeof path, "assets/scenes/%s.json", rows[i].scene);
        struct opened *scene = strcmp(rows[i].scene, "fox") == 0      ? &made
                               : strcmp(rows[i].scene, "curved") == 0 ? &curved
                                                                      : kept_scene(path);
        struct export_options options = {
            .substeps = rows[i].dense, .has_frames = rows[i].last > 0, .first = rows[i].first, .last = rows[i].last};
        if (i == 0 || strcmp(rows[i].scene, rows[i - 1].scene) != 0 || rows[i].dense != rows[i - 1].dense ||
            rows[i].last != rows[i - 1].last) {
            free(points.number);
            points = read_points(export_opened(scene, "points.npy", options));
        }
        options.substeps = 0;
        options.rate = rows[i].rate;
        options.is_signed = rows[i].is_signed;
        const double off = glb_is_off(export_opened(scene, rows[i].file, options), rows[i].clip, &points);
        if (!(off >= rows[i].least && off <= rows[i].most))
            fail_msg("row %zu, %s as %s, is off by %g", i, rows[i].scene, rows[i].file, off);
    }
    free(points.number);
    close_scene(&made);
    close_scene(&curved);
}

static void assert_loops(const struct gltf_channel *channel)
{
    const float *last = channel->values + (channel->key_count - 1) * channel->components;
    assert_memory_equal(channel->values, last, (size_t)channel->components * sizeof *last);
}

static void assert_short_way(const struct gltf_channel *channel)
{
    for (int k = 1; channel->path == GLTF_ROTATION && k < channel->key_count; k++) {
        const float *a = channel->values + 4 * (k - 1), *b = channel->values + 4 * k;
        assert_true(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] > 0);
    }
}

static void assert_within_one(const struct gltf_channel *channel)
{
    for (int i = 0; channel->path == GLTF_WEIGHTS && i < channel->key_count * channel->components; i++)
        assert_true(channel->values[i] >= 0 && channel->values[i] <= 1);
}

/// Judges each channel of a file's first clip; its first mesh has so many morph targets.
static void each_channel(const char *path, void (*judge)(const struct gltf_channel *channel), int targets)
{
    struct gltf gltf;
    assert_done(gltf_read(path, &gltf, &error));
    for (int c = 0; judge && c < gltf.clips[0].channel_count; c++) judge(&gltf.clips[0].channels[c]);
    assert_int_equal(gltf.meshes[0].target_count, targets);
    gltf_free(&gltf);
}

EXPORT_TEST(keys_loop_turn_the_short_way_and_stay_within_one_unless_signed)
{
    // 30 keys a second do not fall on the samples, but the last falls on the first.
    each_channel(export_scene("tail", "loop.glb", (struct export_options){.rate = 30}), assert_loops, 0);
    const char *path = export_scene("character", "loop.glb", (struct export_options){0});
    each_channel(path, assert_loops, 8); // of the two coordinates that the scene moves it by
    each_channel(path, assert_within_one, 8);
    each_channel(export_scene("character", "signed.glb", (struct export_options){.is_signed = true}), NULL, 4);
    struct opened scene = open_scene("assets/scenes/tail.json");
    struct tail *tail = document_tail(scene.document, 0);
    for (int n = 0; n < tail->joints; n++)
        tail->rest.value[n] = 119; // where a matrix gives the one quaternion now, its negative then
    each_channel(export_opened(&scene, "wild.glb", (struct export_options){0}), assert_short_way, 0);
    close_scene(&scene);
}

/// What is exported can be exported again: our own reader finds the coordinates that moved, to their last digits.
EXPORT_TEST(an_exported_creature_opens_as_one)
{
    struct character original, again;
    struct opened curved = open_curved();
    assert_done(character_read(export_opened(&curved, "again.glb", (struct export_options){0}), &again, &error));
    assert_done(character_read(folder_path("curved.glb"), &original, &error));
    close_scene(&curved);
    assert_int_equal(again.coordinate_count, 2);
    assert_int_equal(again.vertex_count, original.vertex_count);
    for (int c = 0; c < 2; c++) {
        const struct coordinate *to = &again.coordinates[c], *from = original.coordinates;
        while (strcmp(from->name, c ? "side" : "up") != 0) from++;
        assert_string_equal(to->name, from->name);
        assert_near(to->frequency, from->frequency, 0);
        assert_near(to->most, from->most, 0);
        for (int n = 0; n < 3 * COORDINATE_PARTS * original.vertex_count; n++) {
            const int i = n / COORDINATE_PARTS, p = n % COORDINATE_PARTS;
            assert_near(to->parts[p][i / 3][i % 3], from->parts[p][i / 3][i % 3], 1e-7);
        }
    }
    character_free(&original);
    character_free(&again);
}

EXPORT_TEST(point_caches_hold_the_same)
{
    static const char *const names[] = {"p.npy", "p.pc2", "p.mdd"};
    const struct export_options some = {.has_frames = true, .first = 12, .last = 24, .substeps = 2};
    struct points points[3];
    for (int i = 0; i < 3; i++) points[i] = read_points(export_scene("tail", names[i], some));
    const size_t size = 3 * (size_t)points->vertices * (size_t)points->frames * sizeof *points->number;
    assert_int_equal(points[0].frames, 25);
    assert_near(points[2].fps, 48, 1e-3);
    for (int i = 1; i < 3; i++) assert_memory_equal(points[0].number, points[i].number, size);
    size_t bytes;
    float time[2], seconds; // of the .pc2 in frames: the first, and from one to the next; the .mdd's first
    char *pc2 = bytes_of(folder_path("p.pc2"), &bytes), *mdd = bytes_of(folder_path("p.mdd"), &bytes);
    memcpy(time, pc2 + 20, sizeof time);
    for (size_t k = 0; k < 4; k++) memcpy((char *)&seconds + k, mdd + 11 - k, 1);
    assert_near(time[0], 12, 0);
    assert_near(time[1], 0.5, 0);
    assert_near(seconds, 0.5, 0);
    free(pc2);
    free(mdd);
    for (int i = 0; i < 3; i++) free(points[i].number);
}

/// A program plays a cache in the node that has the mesh: a row for each of the mesh's vertices, in the file's order. If several nodes have it, the
/// vertices of each are in the file's space.
EXPORT_TEST(point_caches_stand_in_their_node)
{
#define MESH(...) "'meshes':[{'primitives':[" #__VA_ARGS__ "]}],"
#define NODES "'nodes':[{'children':[1],'scale':[2,2,2]},{'mesh':0,'translation':[5,0,0],'rotation':[0,0,1,0]}"
    static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 1], \"rigs\": [{\"type\": \"model\", \"name\": "
                                "\"box\", \"model\": \"box.gltf\"}]}";
    static const struct {
        const char *members;
        int vertices;
        bool in_file, as_shown;
    } rows[] = {
        {MESH({'attributes' : {'POSITION' : 0}, 'indices' : 1}) NODES "]", 4, false,
         false}, // no triangle has the last vertex
        {MESH({'attributes' : {'POSITION' : 0, 'NORMAL' : 0, 'TEXCOORD_0' : 3}, 'indices' : 1}) NODES "]", 4, false,
         false},
        {MESH({'attributes' : {'POSITION' : 0}, 'indices' : 1}, {'attributes' : {'POSITION' : 0}, 'indices' : 2})
             NODES "]",
         4, false, false}, // of two materials
        {MESH({'attributes' : {'POSITION' : 0}, 'indices' : 1}) NODES ",{'mesh':0}]", 8, true, false},
        {MESH({'attributes' : {'POSITION' : 0}, 'indices' : 1}) NODES "]", 4, true, true}, // 0 is its lowest
    };
    struct builder b = {0};
    add_data(&b, FLOAT, "VEC3", 4, corners, sizeof corners);
    ADD(&b, USHORT, uint16_t, 1, 0, 1, 2);
    ADD(&b, USHORT, uint16_t, 1, 0, 2, 1, 0, 1, 3);
    ADD(&b, FLOAT, float, 2, 0, 0, 1, 0, 0, 1, 1, 1);
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        folder_file("box.gltf", builder_json(&b, rows[r].members));
        struct opened opened = open_scene(folder_file("box.json", scene));
        const double up = rows[r].as_shown ? 4 : 0;
        for (int f = 0; f < 3; f++) {
            static const char *const names[] = {"box.pc2", "box.mdd", "box.npy"};
            const struct export_options options = {.as_shown = rows[r].as_shown};
            struct points points = read_points(export_opened(&opened, names[f], options));
            if (points.vertices != rows[r].vertices)
                fail_msg("row %zu, %s: %d vertices", r, names[f], points.vertices);
            for (int i = 0; i < 12; i++) {
                const double own = (double)corners[i / 3][i % 3],
                             turned = 2 * ((i % 3 == 2 ? own : -own) + (i % 3 == 0 ? 5 : 0)); // half a turn
                assert_near(frame_of(&points, 1)[i], rows[r].in_file ? turned + (i % 3 == 1 ? up : 0) : own, 2e-6);
            }
            free(points.number);
        }
        close_scene(&opened);
    }
#undef MESH
#undef NODES
}

/// What was written, and where the last key is if none falls on the last frame.
EXPORT_TEST(reports_say_what_was_written)
{
    static const struct {
        const char *scene, *file;
        struct export_options options;
        const char *text, *note;
    } rows[] = {
        {"tail", "a.glb", {.rate = 12, .has_frames = true, .last = 22}, "24 joints, 12 keys, ", ""},
        {"tail", "a.csv", {.rate = 12, .has_frames = true, .last = 22}, "58 columns, 12 rows, ", ""},
        {"tail",
         "a.csv",
         {.rate = 18, .has_frames = true, .last = 22},
         "58 columns, 17 rows, ",
         "the last key is on frame 21.3333, because no key falls on frame 22"},
        {"tail", "a.pc2", {.substeps = 1, .has_frames = true, .last = 4}, "6866 vertices, 5 frames, 412 KB", ""},
        {"tail", "a.bvh", {.substeps = 1}, "24 joints, 121 frames, ", ""},
        {"tail", "a.usda", {.rate = 6}, "1 rig, 31 keys, ", ""},
        {"compositing", "a.usda", {.substeps = 1, .has_frames = true}, "2 rigs, 1 keys, ", ""},
        {"character", "a.glb", {.substeps = 1}, "8 morph targets, 145 keys, ", ""},
        {"dog", "a.glb", {.substeps = 1}, "16 bones bent by chains in 1 clip, 97 keys, ", ""},
        {"dog", "a.glb", {.substeps = 1, .all_clips = true}, "16 bones bent by chains in 3 clips, 233 keys, ", ""},
        {"dog",
         "a.usda",
         {.substeps = 1, .has_frames = true, .last = 4},
         "1 rig, 5 keys, 1 texture in a_textures, ",
         ""},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct export_report report = {0};
        char path[128];
        snprintf(path, sizeof path, "assets/scenes/%s.json", rows[i].scene);
        assert_done(
            export_write(posing_of(kept_scene(path)), folder_path(rows[i].file), &rows[i].options, &report, &error));
        if (strncmp(report.text, rows[i].text, strlen(rows[i].text)) != 0 || !strstr(report.note, rows[i].note) ||
            !*report.note != !*rows[i].note)
            fail_msg("row %zu: \"%s\", \"%s\"", i, report.text, report.note);
    }
}

/// Each row has every spline's value and, over a channel's joints, the angles of the pose.
EXPORT_TEST(a_table_has_splines_and_channels)
{
    char line[8192], expected[128];
    double number[6];
    struct opened *scene = kept_scene("assets/scenes/tail.json");
    FILE *file = fopen(export_opened(scene, "t.csv", (struct export_options){0}), "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(strncmp(line, "frame,sway,up,breath,blink,tail.side.sway.0,tail.side.sway.1,", 61), 0);
    assert_non_null(strstr(line, ",tail.up.up.23,tail.look.sway,"));
    for (int k = 0; k <= 30; k++) assert_non_null(fgets(line, sizeof line, file));
    const struct tail *tail = document_tail(scene->document, 0);
    const wiggly_value sway = evaluation_at(&scene->evaluation, 0, 30), up = evaluation_at(&scene->evaluation, 1, 30);
    snprintf(expected, sizeof expected, "30,%.9g", sway.y + sway.re);
    assert_int_equal(strncmp(line, expected, 9), 0);
    char *at = line;
    for (int i = 0; i < 6; i++, at++) number[i] = strtod(at, &at);
    assert_near(number[2], up.y + up.re, 1e-12);
    assert_near(number[5], tail->channels[0].gain.value[0] * (sway.y + sway.re), 1e-9);
    assert_int_equal(fclose(file), 0);
}

static bool stop_at_ten(void *user, long done, long total)
{
    *(long *)user = total;
    return done < 10;
}

/// An export that is stopped leaves neither half a file nor a temporary one. The dog's .usda has a folder of textures.
EXPORT_TEST(stopping_leaves_nothing_behind)
{
    static const char *const names[] = {"a.glb", "a.gltf", "a.usda", "a.bvh", "a.csv",
                                        "a.pc2", "a.mdd",  "a.npy",  "a.usda"};
    long total = 0;
    const struct export_options options = {.proceed = stop_at_ten, .user = &total};
    for (int i = 0; i < 9; i++) {
        struct opened *scene = kept_scene(i < 8 ? "assets/scenes/tail.json" : "assets/scenes/dog.json");
        struct export_report report;
        assert_refusal(export_write(posing_of(scene), folder_path(names[i]), &options, &report, &error),
                       "interrupted; nothing was written");
        assert_int_equal(total, i < 8 ? 121 : 385);
        assert_int_equal(files_in_folder(), 0);
    }
}

EXPORT_TEST(refusals_say_what_to_do)
{
    static const char tail[] = "assets/scenes/tail.json", two[] = "assets/scenes/compositing.json",
                      character[] = "assets/scenes/character.json", bare[] = "tests/vectors/complex_default.json";
    static const struct {
        const char *scene, *file;
        struct export_options options;
        const char *says;
    } rows[] = {
        {tail, "a.fbx", {0}, ".glb, .gltf, .usda, .bvh, .csv, .pc2, .mdd or .npy"},
        {tail, "a.gif", {0}, "expected a name ending in"},
        {tail, "a.usda", {.all_clips = true}, "a.usda: holds one clip: all clips need .glb or .gltf"},
        {bare, "a.glb", {0}, "no rig to export: its splines go into a .csv"},
        {character, "a.bvh", {0}, "cannot hold the model \"model\": export it as .glb, .gltf, .usda, .csv, "},
        {two, "a.pc2", {0}, "choose one of \"nodder\", \"swayer\" with --rig"},
        {two, "a.pc2", {.rig_choice = "a row"}, "choose one of \"nodder\", \"swayer\" with a row"},
        {two, "a.glb", {.rig = "noder"}, "\"nodder\", \"swayer\", got \"noder\""},
        {tail, "a.glb", {.has_frames = true, .first = 5, .last = 500}, "from 0 to 120"},
        {tail, "a.glb", {.has_frames = true, .first = -1, .last = 5}, "from 0 to 120"},
        {tail, "a.glb", {.has_frames = true, .first = 9, .last = 5}, "got 9:5"},
        {tail, "a.glb", {.rate = 1e9}, "expected at most 100000000 keys, got "},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct export_report report;
        assert_refusal(export_write(posing_of(kept_scene(rows[i].scene)), folder_path(rows[i].file), &rows[i].options,
                                    &report, &error),
                       rows[i].says);
        assert_int_equal(files_in_folder(), 0);
    }
}

/// Films have as many pictures as their frames and rounds say, at a rate that players show.
TEST(films_count_their_pictures)
{
    static const struct {
        const char *file;
        double frames;
        int loops;
        double rate, pictures, rated;
    } rows[] = {
        {"a.mp4", 120, 0, 0, 121, 24}, {"a.mp4", 120, 1, 0, 120, 24},  {"a.mp4", 120, 2, 12, 120, 12},
        {"a.gif", 120, 0, 0, 120, 24}, {"a.png", 10, 0, 60, 26, 60},   {"a.mp4", 0, 3, 0, 1, 24},
        {"a.webm", 0.1, 1, 0, 1, 24},  {"A.MP4", 120, 0, 24, 121, 24},
    };
    const struct document *document = kept_scene("assets/scenes/tail.json")->document;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double rate = rows[i].rate;
        const double pictures =
            export_pictures(export_format(rows[i].file), document, rows[i].frames, rows[i].loops, &rate);
        if (pictures != rows[i].pictures || rate != rows[i].rated)
            print_error("row %zu: %g at %g\n", i, pictures, rate);
    }
    assert_null(export_format("mp4"));
    assert_true(export_loops(document));
    assert_true(export_loops(kept_scene("assets/scenes/dog.json")->document));
    assert_false(export_loops(kept_scene("tests/vectors/complex_default.json")->document));
}

/// Two rigs of a scene come out as two meshes that do not share a name.
EXPORT_TEST(all_rigs_come_out)
{
    struct gltf gltf;
    assert_done(gltf_read(export_scene("compositing", "two.glb", (struct export_options){0}), &gltf, &error));
    assert_int_equal(gltf.mesh_count, 2);
    assert_true(gltf_find_node(&gltf, "nodder") >= 0 && gltf_find_node(&gltf, "swayer") >= 0);
    assert_string_equal(gltf.clips[0].name, "compositing");
    gltf_free(&gltf);
    const struct export_options one = {.rig = "swayer", .clip = "Sway"};
    assert_done(gltf_read(export_scene("compositing", "one.glb", one), &gltf, &error));
    assert_int_equal(gltf.mesh_count, 1);
    assert_string_equal(gltf.clips[0].name, "Sway");
    gltf_free(&gltf);
}

// --- .bvh

enum { MOST_JOINTS = 64, MOST_DEPTH = 40 };

struct bvh {
    struct {
        char name[64];
        int parent, channels;
        double offset[3], tip[3];
    } joints[MOST_JOINTS];
    int count, frames;
    double seconds; ///< a frame
    char *motion;   ///< the text of its numbers, in `data`
    char *data;
};

static struct bvh read_bvh(const char *path)
{
    struct bvh bvh = {0};
    size_t size;
    int above[MOST_DEPTH] = {-1}, depth = 0, current = -1, used;
    bool has_tip = false;
    char word[64], *at = bvh.data = bytes_of(path, &size);
    for (; sscanf(at, "%63s%n", word, &used) == 1 && strcmp(word, "MOTION") != 0;) {
        at += used;
        if (strcmp(word, "ROOT") == 0 || strcmp(word, "JOINT") == 0) {
            assert_true(bvh.count < MOST_JOINTS);
            current = bvh.count++;
            has_tip = false;
            bvh.joints[current].parent = depth == 0 ? -1 : above[depth];
            assert_int_equal(sscanf(at, "%63s", bvh.joints[current].name), 1);
        } else if (strcmp(word, "End") == 0) {
            has_tip = true;
        } else if (strcmp(word, "{") == 0) {
            assert_true(depth + 1 < MOST_DEPTH);
            above[++depth] = current;
        } else if (strcmp(word, "}") == 0) {
            depth--;
        } else if (strcmp(word, "OFFSET") == 0 && current >= 0) {
            double *o = has_tip ? bvh.joints[current].tip : bvh.joints[current].offset;
            assert_int_equal(sscanf(at, "%lf %lf %lf", &o[0], &o[1], &o[2]), 3);
        } else if (strcmp(word, "CHANNELS") == 0) {
            bvh.joints[current].channels = atoi(at);
        }
    }
    assert_int_equal(sscanf(at, " MOTION Frames: %d Frame Time: %lf%n", &bvh.frames, &bvh.seconds, &used), 2);
    bvh.motion = at + used;
    return bvh;
}

/// Where all joints are at the next frame: y, x, z turn in this order, a place is one in the parent.
static void next_frame(struct bvh *bvh, mat4 world[MOST_JOINTS])
{
    for (int j = 0; j < bvh->count; j++) {
        const int channels = bvh->joints[j].channels, parent = bvh->joints[j].parent;
        double number[6];
        vec3 place;
        for (int c = 0; c < channels; c++) number[c] = strtod(bvh->motion, &bvh->motion);
        for (int k = 0; k < 3; k++) place[k] = (float)(channels == 6 ? number[k] : bvh->joints[j].offset[k]);
        glm_mat4_identity(world[j]);
        if (parent >= 0) glm_mat4_copy(world[parent], world[j]);
        const double *turn = number + channels - 3;
        glm_translate(world[j], place);
        glm_rotate_y(world[j], glm_rad((float)turn[0]), world[j]);
        glm_rotate_x(world[j], glm_rad((float)turn[1]), world[j]);
        glm_rotate_z(world[j], glm_rad((float)turn[2]), world[j]);
    }
}

/// Every bone is where the .glb has it. Without --as-shown the stage's size and place are in no file, with it in all; and all agree.
EXPORT_TEST(a_character_keeps_the_size_and_place_of_its_file)
{
    for (int shown = 0; shown < 2; shown++) {
        struct opened scene = open_scene("assets/scenes/dog.json");
        struct export_options options = {.substeps = 1, .as_shown = shown};
        struct gltf gltf;
        struct gltf_pose pose;
        mat4 world[MOST_JOINTS];
        scene.document->rigs[0]->model.scale = 0.3; // the test's own
        scene.document->rigs[0]->model.turn = 30;
        struct bvh bvh = read_bvh(export_opened(&scene, "dog.bvh", options));
        assert_done(gltf_read(export_opened(&scene, "dog.glb", options), &gltf, &error));
        assert_true(gltf_pose_create(&gltf, &pose));
        assert_int_equal(bvh.count, gltf.skins[0].joint_count);
        assert_int_equal(bvh.frames, 97);
        assert_near(bvh.seconds, 1 / 24.0, 1e-9);
        const struct imported *dog = models_imported(scene.models, scene.document, 0);
        int placed = 0; // joints that move in their parents: the root does
        for (int j = 0; j < bvh.count; j++) placed += bvh.joints[j].channels == 6;
        assert_int_equal(placed, 1);
        for (int i = 0; i < dog->skeleton.count && !shown; i++) { // a bone at the end of its limb has a tip
            const struct bone *bone = &dog->skeleton.bones[i];
            float ends[2][3];
            int j = 0;
            if (bone->child >= 0) continue;
            while (j < bvh.count && strcmp(bvh.joints[j].name, dog->gltf.nodes[bone->node].name) != 0) j++;
            assert_true(j < bvh.count);
            if (j + 1 < bvh.count && bvh.joints[j + 1].parent == j) continue;
            skeleton_ends(bone, &dog->rest, ends);
            for (int k = 0; k < 3; k++) assert_near(bvh.joints[j].tip[k], ends[1][k] - ends[0][k], 1e-6);
        }
        for (int f = 0; f < bvh.frames; f++) {
            gltf_pose_clip(&gltf, 0, f / 24.0, &pose);
            gltf_pose_world(&gltf, &pose);
            next_frame(&bvh, world);
            for (int j = 0; j < bvh.count; j++) {
                const int node = gltf_find_node(&gltf, bvh.joints[j].name);
                assert_true(node >= 0);
                for (int k = 0; k < 3; k++) assert_near(world[j][3][k], pose.world[node][12 + k], 2e-6);
            }
        }
        gltf_pose_free(&pose);
        gltf_free(&gltf);
        free(bvh.data);

        options.has_frames = true;
        options.last = 4;
        struct points points = read_points(export_opened(&scene, "dog.pc2", options));
        assert_near(glb_is_off(export_opened(&scene, "dog.glb", options), "Walk", &points), 0, 2e-6);
        double top = 0;
        for (int v = 0; v < points.vertices; v++) top = fmax(top, frame_of(&points, 0)[3 * v + 1]);
        assert_true(shown ? top < 0.5 : top > 0.5);
        free(points.number);
        close_scene(&scene);
    }
}

/// Every format has a rig with an offset as its spline was then, between two frames.
EXPORT_TEST(an_offset_is_in_every_file)
{
    static const char text[] =
        "{'frames': [0, 24], 'splines': [{'name': 's', 'frequency': 1.3, 'start': 'loop', 'knots': [{'frame': 2, "
        "'value': 1}, {'frame': 14, 'value': -1}]}], 'rigs': [{'type': 'tail', 'name': 't', 'joints': 2, 'channels': "
        "[{'spline': 's', 'gain': 20, 'lag': 0}], 'offset': 1.25}, {'type': 'character', 'name': 'c', 'model': "
        "'%s/assets/models/creature.glb', 'coordinates': [{'name': 'up', 'spline': 's', 'amplitude': 2}], 'offset': "
        "-3.4}]}";
    char here[512], filled[1024], line[256];
    assert_non_null(getcwd(here, sizeof here));
    snprintf(filled, sizeof filled, json(text), here); // NOLINT: a format of this file
    struct opened scene = open_scene(folder_file("later.json", filled));
    const wiggly_curve *curve = &scene.evaluation.curves[0];
    const double degree = 3.14159265358979323846 / 180;
    for (int f = 0; f <= 24; f += 6) {
        const wiggly_value then = wiggly_evaluate(curve, f - 1.25), soft = wiggly_evaluate(curve, f + 3.4);
        const double angle = 20 * (then.y + then.re);
        double number[6], quat[4];
        mat4 world[MOST_JOINTS];
        struct gltf gltf;
        struct gltf_pose pose;
        size_t size;

        FILE *file = fopen(export_opened(&scene, "it.csv", (struct export_options){0}), "r");
        for (int row = -1; file && row <= f; row++) assert_non_null(fgets(line, sizeof line, file));
        assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf", &number[0], &number[1], &number[2], &number[3],
                                &number[4], &number[5]),
                         6);
        assert_int_equal(fclose(file), 0);
        assert_near(number[2], angle, 1e-9);
        assert_near(number[4], 2 * (soft.y + soft.re), 1e-6);
        assert_near(number[5], 2 * soft.im, 1e-6);

        struct bvh bvh = read_bvh(export_opened(&scene, "it.bvh", (struct export_options){.rig = "t"}));
        for (int row = 0; row <= f; row++) next_frame(&bvh, world);
        assert_near(atan2((double)world[0][2][0], (double)world[0][2][2]), angle * degree, 1e-6);
        free(bvh.data);

        assert_done(gltf_read(export_opened(&scene, "it.glb", (struct export_options){0}), &gltf, &error));
        assert_true(gltf_pose_create(&gltf, &pose));
        gltf_pose_clip(&gltf, 0, f / 24.0, &pose);
        const float *turn = pose.place[gltf_find_node(&gltf, "t_0")].rotation;
        assert_near(2 * atan2((double)turn[1], (double)turn[3]), angle * degree, 1e-6);
        gltf_pose_free(&pose);
        gltf_free(&gltf);

        char *usda = bytes_of(export_opened(&scene, "it.usda", (struct export_options){.rig = "t"}), &size), key[16];
        const char *at = strstr(usda, "rotations.timeSamples");
        snprintf(key, sizeof key, " %d: [(", f);
        at = at ? strstr(at, key) : NULL;
        assert_non_null(at);
        assert_int_equal(sscanf(at + strlen(key), "%lf, %lf, %lf, %lf", &quat[0], &quat[1], &quat[2], &quat[3]), 4);
        assert_near(2 * atan2(quat[2], quat[0]), angle * degree, 1e-6);
        free(usda);
    }
    close_scene(&scene);
}
