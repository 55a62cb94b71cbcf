/// Clips of other programs, in and out: they begin and end where their own keys do, and loop where they do.
#include "export/export.h"
#include "gltf_builder.h"
#include "rig/chain_make.h"
#include "rig/opened.h"
#include "rig/posing_kind.h"

enum { MOST_KEYS = 41, ARM = 0 };

/// A clip that turns an arm, a key a frame at 24 frames a second, as Blender writes actions.
struct action {
    const char *name;
    int first, last;
    bool loops;
};

static const struct action actions[] = {{"Walk", 1, 25, true}, {"Fall", 10, 30, false}, {"Run", 0, 16, true}};
enum { ACTIONS = sizeof actions / sizeof *actions };

static double turn_at(const struct action *action, double frame)
{
    const double part = (frame - action->first) / fmax(action->last - action->first, 1);
    return action->loops ? 0.4 * sin(2 * 3.14159265358979323846 * part) : 0.9 * part * part;
}

static size_t add_action(struct builder *b, const struct action *action, char *json)
{
    float times[MOST_KEYS], turns[MOST_KEYS][4];
    const int count = action->last - action->first + 1;
    for (int k = 0; k < count; k++) {
        const double half = turn_at(action, action->first + k) / 2;
        times[k] = (float)((action->first + k) / 24.0);
        memcpy(turns[k], (float[4]){(float)sin(half), 0, 0, (float)cos(half)}, sizeof turns[k]);
    }
    const int input = add_data(b, FLOAT, "SCALAR", count, times, (size_t)count * sizeof *times);
    const int output = add_data(b, FLOAT, "VEC4", count, turns, (size_t)count * sizeof *turns);
    return (size_t)sprintf(
        json,
        "{\"name\":\"%s\",\"samplers\":[{\"input\":%d,\"output\":%d}],\"channels\":[{\"sampler\":0,"
        "\"target\":{\"node\":%d,\"path\":\"rotation\"}}]}",
        action->name, input, output, ARM);
}

/// A file of an arm, a hand and a finger, with these clips.
static const char *write_actions(const struct action *from, int count)
{
    static const float position[3][3] = {{0, 0, 0}, {0, 1, 0}, {0.1f, 0, 0}};
    struct builder b = {0};
    char json[4096], *end = json;
    add_data(&b, FLOAT, "VEC3", 3, position, sizeof position);
    end +=
        sprintf(end, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"scenes\":[{\"nodes\":[0]}],"
                     "\"nodes\":[{\"name\":\"arm\",\"mesh\":0,\"children\":[1]},"
                     "{\"name\":\"hand\",\"translation\":[0,1,0],\"children\":[2]},"
                     "{\"name\":\"finger\",\"translation\":[0,0.5,0]}],\"animations\":[");
    for (int a = 0; a < count; a++) {
        if (a > 0) *end++ = ',';
        end += add_action(&b, &from[a], end);
    }
    strcpy(end, "]");
    const char *text = builder_json(&b, json);
    return temporary_file("actions.gltf", text, strlen(text));
}

static void add_chain(struct opened *opened)
{
    int rig;
    const struct chain_wish wish = {.from = "hand", .follows = true};
    assert_done(chain_make(opened->document, opened->models, &wish, &rig, &error));
}

/// The arm in the file turns at the times of the action's keys as it did, and no key is one too many.
static void check_clip(const struct gltf *gltf, const struct action *action)
{
    struct gltf_pose pose;
    const int clip = gltf_find_clip(gltf, action->name);
    assert_true(clip >= 0 && gltf_pose_create(gltf, &pose));
    assert_near(gltf->clips[clip].first, action->first / 24.0, 1e-6);
    assert_near(gltf->clips[clip].last, action->last / 24.0, 1e-6);
    assert_int_equal(gltf->clips[clip].channels[0].key_count, action->last - action->first + 1);
    for (int frame = action->first; frame <= action->last; frame++) {
        gltf_pose_clip(gltf, clip, frame / 24.0, &pose);
        assert_near(2 * asin((double)pose.place[ARM].rotation[0]), turn_at(action, frame), 1e-6);
    }
    gltf_pose_free(&pose);
}

/// Exports the first clip of a file of actions, with a chain from the hand on, or all of them; the caller frees what was read.
static void export_actions(const struct action *from, int count, bool all, struct gltf *gltf)
{
    struct opened opened;
    struct export_report report;
    assert_done(opened_read(&opened, write_actions(from, count), &error));
    assert_int_equal(opened.document->first_frame, from->first);
    assert_int_equal(opened.document->last_frame, from->last);
    add_chain(&opened);
    assert_int_equal(spline_start(opened.document->splines[0]), from->loops ? WIGGLY_LOOP : WIGGLY_REST);
    opened_solve(&opened, SOLVER_BY_LENGTH);
    const struct posing posing = opened_posing(&opened);
    const struct export_options options = {.substeps = 1, .all_clips = all};
    const char *path = temporary_path("actions.glb");
    assert_done(export_write(&posing, path, &options, &report, &error));
    assert_done(gltf_read(path, gltf, &error));
    opened_free(&opened);
}

TEST(a_clip_is_the_scene_from_its_first_key_to_its_last)
{
    for (int a = 0; a < ACTIONS; a++) {
        struct gltf gltf;
        export_actions(&actions[a], 1, false, &gltf);
        check_clip(&gltf, &actions[a]);
        gltf_free(&gltf);
    }
}

/// Whatever clip the scene plays, all of them come out, each with the keys of the chain in its own frames.
TEST(all_clips_get_the_chains)
{
    for (int first = 0; first < ACTIONS; first++) {
        struct gltf gltf;
        struct action turned[ACTIONS];
        for (int a = 0; a < ACTIONS; a++) turned[a] = actions[(first + a) % ACTIONS];
        export_actions(turned, ACTIONS, true, &gltf);
        assert_int_equal(gltf.clip_count, ACTIONS);
        for (int a = 0; a < ACTIONS; a++) {
            const struct gltf_channel *hand = &gltf.clips[a].channels[1];
            const int last = hand->key_count - 1;
            double swing = 0;
            assert_string_equal(gltf.clips[a].name, turned[a].name);
            check_clip(&gltf, &turned[a]);
            assert_int_equal(hand->node, ARM + 1);
            assert_int_equal(last, turned[a].last - turned[a].first);
            for (int k = 0; k <= last; k++) swing = fmax(swing, fabs((double)hand->values[4 * k]));
            assert_true(swing > 0.01);
            const double end = (double)fabsf(hand->values[4 * last] - hand->values[0]);
            assert_true(turned[a].loops ? end < 1e-5 : end > 1e-3);
        }
        gltf_free(&gltf);
    }
}

/// A second clip of one name is told apart. A pose stays as it is.
TEST(clips_of_one_name_and_poses_among_all_clips)
{
    static const struct action twins[] = {{"Walk", 1, 25, true}, {"Pose", 5, 5, true}, {"Walk", 0, 16, true}};
    static const struct {
        const char *name;
        int channels, keys;
    } expected[] = {{"Walk", 3, 25}, {"Pose", 1, 1}, {"Walk 3", 3, 17}};
    struct gltf gltf;
    export_actions(twins, 3, true, &gltf);
    assert_int_equal(gltf.clip_count, 3);
    for (int c = 0; c < 3; c++) {
        assert_string_equal(gltf.clips[c].name, expected[c].name);
        assert_int_equal(gltf.clips[c].channel_count, expected[c].channels);
        assert_int_equal(gltf.clips[c].channels[0].key_count, expected[c].keys);
    }
    gltf_free(&gltf);
}

/// A scene may begin before its clip, as those of earlier versions do: the clip waits, unless it loops in the scene.
TEST(a_clip_before_its_first_key)
{
    static const struct {
        int first, last;
        bool loops;
        double frame; ///< of the clip, as the scene begins
    } cases[] = {{0, 25, true, 1},  {0, 25, false, 1},   {0, 24, false, 1},
                 {0, 24, true, 24}, {-24, 24, true, 24}, {1, 25, true, 1}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const struct gltf_clip clip = {.first = 1 / 24.0, .last = 25 / 24.0, .loops = cases[c].loops};
        struct document *document = document_create();
        document->fps = 24;
        document->first_frame = cases[c].first;
        document->last_frame = cases[c].last;
        assert_near(24 * posing_clip_time(document, 0, &clip), cases[c].frame, 1e-5);
        document_destroy(document);
    }
}
