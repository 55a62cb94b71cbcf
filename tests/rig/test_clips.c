/// Clips of other programs, in and out: they begin and end where their own keys do, and loop where they do.
#include "export/export.h"
#include "gltf_builder.h"
#include "rig/import.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include <jansson.h>

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
    return (size_t)sprintf(json,
                           "{'name':'%s','samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{"
                           "'node':%d,'path':'rotation'}}]}",
                           action->name, input, output, ARM);
}

/// A file of an arm, a hand and a finger, with these clips.
static const char *write_actions(const struct action *from, int count)
{
    struct builder b = {0};
    char json[4096], *end = json;
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 0, 1, 0, 0.1f, 0, 0);
    end += sprintf(end, "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'scenes':[{'nodes':[0]}],'nodes':["
                        "{'name':'arm','mesh':0,'children':[1]},{'name':'hand','translation':[0,1,0],'children':[2]},"
                        "{'name':'finger','translation':[0,0.5,0]}],'animations':[");
    for (int a = 0; a < count; a++) {
        if (a > 0) *end++ = ',';
        end += add_action(&b, &from[a], end);
    }
    strcpy(end, "]");
    return write_built(&b, "actions.gltf", json);
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
        const struct clip_play play = {.first = 1 / 24.0, .length = 1, .loops = cases[c].loops};
        struct document *document = document_create();
        document->fps = 24;
        document->first_frame = cases[c].first;
        document->last_frame = cases[c].last;
        assert_near(24 * posing_clip_time(document, 0, &play), cases[c].frame, 1e-5);
        document_destroy(document);
    }
}

// --- rates, and ends between frames

/// A clip of `count` evenly spaced keys, the middle one of which is a hit.
static struct document *scene_of_keys(double first, double step, int count)
{
    struct builder *b = calloc(1, sizeof *b);
    float *times = malloc((size_t)count * sizeof *times), (*places)[3] = calloc((size_t)count, sizeof *places);
    char json[1024];
    struct document *document;
    assert_true(b && times && places);
    for (int k = 0; k < count; k++) times[k] = (float)(first + k * step);
    places[count / 2][1] = places[count - 1][0] = 1;
    const int input = add_data(b, FLOAT, "SCALAR", count, times, (size_t)count * sizeof *times);
    const int output = add_data(b, FLOAT, "VEC3", count, places, (size_t)count * sizeof *places);
    sprintf(json,
            "'nodes':[{'name':'it'}],'animations':[{'name':'Hit','samplers':[{'input':%d,'output':%d}],'channels':[{"
            "'sampler':0,'target':{'node':0,'path':'translation'}}]}]",
            input, output);
    assert_done(document = import_scene(write_built(b, "keys.gltf", json), &error));
    free(b);
    free(times);
    free(places);
    return document;
}

/// A scene has the clip's own rate, and its frames hold the first key and the last. One that is too long for it has fewer frames.
TEST(a_scene_has_the_rate_and_the_ends_of_its_clip)
{
    static const struct {
        double first, step;
        int count;
        double fps;
        int frames[2];
    } cases[] = {
        {0, 1 / 24.0, 25, 24, {0, 24}},
        {0, 1 / 30.0, 31, 30, {0, 30}},
        {0, 1 / 25.0, 26, 25, {0, 25}},
        {0, 1001 / 24000.0, 701, 24000 / 1001.0, {0, 700}},
        {0, 1001 / 30000.0, 701, 30000 / 1001.0, {0, 700}},
        {0, 1001 / 60000.0, 701, 60000 / 1001.0, {0, 700}},
        {0, 1 / 72.0, 73, 72, {0, 72}},
        {0, 1 / 90.0, 91, 90, {0, 90}},
        {0, 1 / 100.0, 101, 100, {0, 100}},
        {0, 1 / 120.0, 121, 120, {0, 120}},
        {0, 1 / 144.0, 145, 144, {0, 144}},
        {0, 1 / 1000.0, 301, 1000, {0, 300}},
        {0, 0.33 / 8, 9, 8 / 0.33, {0, 8}},
        {0, 0.33, 2, 100, {0, 33}},
        {5.013, 1 / 24.0, 25, 24, {120, 145}},
        {-1, 1 / 24.0, 25, 24, {-24, 0}},
        {0, 173.625, 25, 12, {0, 50004}},
        {0, 5000, 25, 0.75, {0, 90000}},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct document *document = scene_of_keys(cases[c].first, cases[c].step, cases[c].count);
        assert_near(document->fps / cases[c].fps, 1, 1e-6);
        assert_int_equal(document->first_frame, cases[c].frames[0]);
        assert_int_equal(document->last_frame, cases[c].frames[1]);
        document_destroy(document);
    }
}

// --- what loops

enum gait { CYCLE, WAVE, LEAP, DOOR };

/// Hips, two legs and a tail in a clip of `keys` keys at 24 frames a second.
struct gait_case {
    const char *what;
    enum gait gait;
    int keys;
    bool has_copy;      ///< the last key is a copy of the first
    double travel, end; ///< metres; and the part of the motion by which it ends beside its start
    bool loops;
    int frames; ///< of the scene
};

static const struct gait_case gaits[] = {
    {"a walk in place", CYCLE, 25, true, 0, 0, true, 24},
    {"that was cleaned up by hand", CYCLE, 25, true, 0, 0.005, true, 24},
    {"that was cut by hand", CYCLE, 25, true, 0, 0.05, true, 24},
    {"a walk with root motion", CYCLE, 25, true, 1.4, 0, true, 24},
    {"a run without a copy of the first key", CYCLE, 16, false, 0, 0, true, 16},
    {"one of few keys", CYCLE, 8, false, 0, 0, true, 8},
    {"a run without a copy, with root motion", CYCLE, 16, false, 3, 0, true, 16},
    {"a cycle that was cut off", CYCLE, 20, true, 0, 0.2, false, 19},
    {"a wave that ends near its start", WAVE, 25, true, 0, 0.05, false, 24},
    {"a wave of few keys", WAVE, 9, true, 0, 0.1, false, 8},
    {"a wave that comes back", WAVE, 25, true, 0, 0, true, 24},
    {"a leap forward", LEAP, 25, true, 1.5, 0, false, 24},
    {"a jump in place", LEAP, 25, true, 0, 0, true, 24},
    {"a fall", WAVE, 25, true, 0, 1, false, 24},
    {"a door that slides", DOOR, 2, true, 1, 0, false, 2},
};

/// Writes a clip's channel for a node; `at` gives its numbers at a key, from 0 to 1.
static int add_gait(struct builder *b, const struct gait_case *of, int node, char **samplers, char **channels)
{
    enum { MOST = 32 };
    float times[MOST], turns[MOST][4], places[MOST][3];
    const int parts = of->has_copy ? of->keys - 1 : of->keys;
    for (int k = 0; k < of->keys; k++) {
        const double u = (double)k / parts, ease = u * u * (3 - 2 * u), pi = 3.14159265358979323846;
        const double swing = of->gait == CYCLE ? sin(2 * pi * u + 2 * node) + 0.3 * sin(4 * pi * u + node)
                                               : 2 * sin(pi * u) * sin(pi * u) * (1 + 0.2 * node);
        const double turn = of->gait == DOOR ? 0 : 0.4 * swing + 0.8 * of->end * (of->gait == CYCLE ? u : ease);
        times[k] = (float)(of->gait == DOOR ? k / 12.0 : k / 24.0);
        memcpy(turns[k], (float[]){(float)sin(turn / 2), 0, 0, (float)cos(turn / 2)}, sizeof turns[k]);
        const double way = of->gait == LEAP ? ease : u + (of->gait == CYCLE ? 0.02 * sin(4 * pi * u) : 0);
        memcpy(places[k], (float[]){(float)(of->travel * way), (float)(1 + 0.05 * (of->gait == DOOR ? 0 : swing)), 0},
               sizeof places[k]);
    }
    const size_t count = (size_t)of->keys;
    const int input = add_data(b, FLOAT, "SCALAR", of->keys, times, count * sizeof *times);
    for (int path = node == 0 ? 0 : 1; path < 2; path++) {
        const int output = path ? add_data(b, FLOAT, "VEC4", of->keys, turns, count * sizeof *turns)
                                : add_data(b, FLOAT, "VEC3", of->keys, places, count * sizeof *places);
        const char *comma = node + path > 0 ? "," : "";
        *samplers += sprintf(*samplers, "%s{'input':%d,'output':%d}", comma, input, output);
        *channels += sprintf(*channels, "%s{'sampler':%d,'target':{'node':%d,'path':'%s'}}", comma, node + path, node,
                             path ? "rotation" : "translation");
    }
    return input;
}

static const char *write_gait(const struct gait_case *of)
{
    static struct builder b;
    char samplers[1024], channels[1024], json[4096], *sampler = samplers, *channel = channels;
    b = (struct builder){0};
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 0, 1, 0, 0.1f, 0, 0);
    for (int node = 0; node < (of->gait == DOOR ? 1 : 4); node++) add_gait(&b, of, node, &sampler, &channel);
    sprintf(json,
            "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'scenes':[{'nodes':[0]}],'nodes':[{'name':"
            "'hips','mesh':0,'children':[1,2,3]},{'name':'left'},{'name':'right'},{'name':'tail','translation':[0,0,-"
            "0.3],'children':[4]},{'name':'tip','translation':[0,0,-0.3]}],"
            "'animations':[{'name':'gait','samplers':[%s],'channels':[%s]}]",
            samplers, channels);
    return write_built(&b, "gait.gltf", json);
}

/// A clip loops if its pose ends as it begins, wherever the character is by then. Its scene is a whole round, and what follows it does not
/// jump, nor lie back because of the travel.
TEST(what_loops)
{
    for (size_t g = 0; g < sizeof gaits / sizeof *gaits; g++) {
        const struct gait_case *of = &gaits[g];
        struct opened opened;
        int rig;
        assert_done(opened_read(&opened, write_gait(of), &error));
        struct document *document = opened.document;
        const struct gltf_clip *clip = &models_imported(opened.models, document, 0)->gltf.clips[0];
        if (clip->loops != of->loops) fail_msg("%s %s", of->what, clip->loops ? "loops" : "plays once");
        assert_near(clip->last + (clip->loops ? clip->gap : 0), of->frames / 24.0, 1e-6);
        assert_int_equal(document->last_frame - document->first_frame, of->frames);
        const struct chain_wish wish = {.from = "tail", .follows = true};
        assert_done(chain_make(document, opened.models, &wish, &rig, &error));
        assert_int_equal(spline_start(document->splines[0]), of->loops ? WIGGLY_LOOP : WIGGLY_REST);
        opened_solve(&opened, SOLVER_BY_LENGTH);
        const int last = document_samples(document) - 1;
        for (int s = 0; of->loops && s < document->spline_count; s++) {
            const double *total = opened.evaluation.curves[s].total;
            assert_near(total[0], total[last], 1e-9);
            for (int i = 0; s == 0 && i <= last; i++) // across the tail there is nothing but travel
                if (!(fabs(total[i]) < 0.1)) fail_msg("%s: spline %d at %d is %g", of->what, s, i, total[i]);
        }
        opened_free(&opened);
    }
}

/// A clip that loops goes on from its last key to its first; one that plays once stays at its end.
TEST(between_the_last_key_and_the_first)
{
    struct gltf gltf;
    struct gltf_pose pose, end;
    assert_done(gltf_read(write_gait(&gaits[6]), &gltf, &error));
    assert_true(gltf_pose_create(&gltf, &pose) && gltf_pose_create(&gltf, &end));
    const double last = gltf.clips[0].last, gap = gltf.clips[0].gap;
    assert_near(gap, 1 / 24.0, 1e-6);
    gltf_pose_loop(&gltf, 0, last + gap, &pose);
    gltf_pose_clip(&gltf, 0, 0, &end);
    for (int n = 0; n < 4; n++)
        for (int k = 0; k < 4; k++) assert_near(pose.place[n].rotation[k], end.place[n].rotation[k], 1e-6);
    assert_near(pose.place[0].translation[0], 3, 0.1); // a whole round on
    gltf_pose_loop(&gltf, 0, last + gap / 2, &pose);
    gltf_pose_clip(&gltf, 0, last, &end);
    assert_true(pose.place[0].translation[0] > end.place[0].translation[0]);
    assert_true(pose.place[1].rotation[0] != end.place[1].rotation[0]);
    gltf_pose_clip(&gltf, 0, last + gap / 2, &pose);
    assert_memory_equal(pose.place, end.place, 4 * sizeof *pose.place);
    gltf_pose_free(&pose);
    gltf_pose_free(&end);
    gltf_free(&gltf);
}

// --- exports edit the file's own clip

enum { THEIR_SAMPLERS = 8, HAND_SAMPLER = 5 };

/// A clip with all that others write: steps, cubics, sparse and normalised numbers, pointers, channels without a node, extras; with keys between
/// frames, beginning at 0.51 s. Node 1 and 2 are a chain, node 4 has a matrix.
static const char *write_theirs(char json[1 << 16])
{
    struct builder b = {0};
    char sparse[256];
    ADD(&b, FLOAT, float, 1, 0.51f, 0.7f, 1, 1.02f, 1.51f);
    ADD(&b, FLOAT, float, 1, 0.51f, 1.51f);
    ADD(&b, FLOAT, float, 1, 0.8f, 1.2f);
    ADD(&b, FLOAT, float, 3, 1, 1, 1, 0, 0, 0, 1, 1, 1, 2, 1, 1, 1, 1, 1);
    ADD(&b, FLOAT, float, 4, 0, 0, 0, 1, 0.1f, 0, 0, 0.995f, 0, 0.2f, 0, 0.98f, 0.6f, 0, 0, 0.8f, 0, 0, 0, 1);
    ADD_NORMALISED(&b, SHORT, short, 4, 0, 0, 0, 32767, 0, 23170, 0, 23170);
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 1, 2, 3, 4, 0, -2, 0, 5, 1, 2, 2, 2, 0, 0, 0);
    const int index = add_view(&b, (const unsigned char[]){1, 0, 0, 0}, 1, 0);
    snprintf(sparse, sizeof sparse,
             ",'sparse':{'count':1,'indices':{'bufferView':%d,'componentType':5121},'values':{'bufferView':%d}}",
             index, add_view(&b, (const float[]){7, 8, 9}, 3 * sizeof(float), 0));
    assert_int_equal(add_accessor(&b, FLOAT, "VEC3", 2, sparse), 7);
    const char *file = write_built(
        &b, "theirs.gltf",
        "'scenes':[{'nodes':[0,3,4]}],'materials':[{'name':'glow'}],"
        "'extensionsUsed':['KHR_animation_pointer','EXT_none'],'nodes':[{'name':'arm','children':[1]},"
        "{'name':'hand','translation':[0,1,0],'children':[2]},{'name':'finger','translation':[0,0.5,0]},"
        "{'name':'prop'},{'name':'lamp','matrix':[1,0,0,0,0,0,-1,0,0,1,0,0,3,0,0,1]}],'animations':[{"
        "'extras':{'event':'step@0.3'},'name':'Act','extensions':{'EXT_none':{'k':[1.5]}},'samplers':["
        "{'input':0,'output':3,'interpolation':'STEP','extras':5},{'input':1,'output':5},"
        "{'input':1,'output':6,'interpolation':'CUBICSPLINE'},{'input':1,'output':7},{'input':0,'output':3},"
        "{'input':0,'output':4},{'input':2,'output':7},{'input':2,'output':6,'interpolation':'CUBICSPLINE'}],"
        "'channels':[{'sampler':0,'target':{'node':3,'path':'scale'}},"
        "{'sampler':1,'target':{'node':3,'path':'rotation'}},{'sampler':2,'target':{'node':0,'path':'translation'}},"
        "{'sampler':3,'target':{'node':3,'path':'translation'}},{'sampler':4,'target':{'path':'pointer',"
        "'extensions':{'KHR_animation_pointer':{'pointer':'/materials/0/emissiveFactor'}}}},"
        "{'sampler':5,'extras':1,'target':{'node':1,'path':'rotation'}},{'sampler':6,'target':{'path':'translation'}}"
        ","
        "{'sampler':7,'target':{'node':4,'path':'translation'}}]}]");
    strcpy(json, b.json);
    return file;
}

/// Exports a file with a chain that nothing bends, over some frames (0, 0: all).
static const char *export_plain(const char *file, int first, int last, struct export_options options,
                                const char *name)
{
    struct opened opened;
    struct export_report report;
    int rig;
    assert_done(opened_read(&opened, file, &error));
    if (last) assert_done(edit_range(opened.document, first, last, RANGE_TRIM, &error));
    const struct chain_wish wish = {.from = "hand"};
    assert_done(chain_make(opened.document, opened.models, &wish, &rig, &error));
    opened_solve(&opened, SOLVER_BY_LENGTH);
    const struct posing posing = opened_posing(&opened);
    const char *path = temporary_path(name);
    assert_done(export_write(&posing, path, &options, &report, &error));
    opened_free(&opened);
    return path;
}

/// Everything in an array is still there and equal.
static void assert_begins(const json_t *before, const json_t *after, const char *array)
{
    size_t i;
    const json_t *thing;
    json_array_foreach(json_object_get(before, array), i, thing)
    {
        if (!json_equal(thing, json_array_get(json_object_get(after, array), i)))
            fail_msg("%s[%zu] is another", array, i);
    }
}

/// What no chain moves stays bit for bit; a clip by another name is a copy that shares all numbers.
TEST(exports_edit_the_clip_of_the_file)
{
    static const char *const names[] = {NULL, "Else"};
    static const char *const arrays[] = {"accessors", "bufferViews", "buffers", "materials"};
    static char text[1 << 16];
    for (int n = 0; n < 2; n++) {
        const char *file = write_theirs(text);
        json_t *before = json_loads(text, 0, NULL);
        json_t *after =
            json_load_file(export_plain(file, 0, 0, (struct export_options){.clip = names[n]}, "out.gltf"), 0, NULL);
        for (int a = 0; a < 4; a++) assert_begins(before, after, arrays[a]);
        json_t *was = json_array_get(json_object_get(before, "animations"), 0),
               *is = json_array_get(json_object_get(after, "animations"), (size_t)n);
        assert_int_equal(json_array_size(json_object_get(after, "animations")), n + 1);
        if (n) assert_true(json_equal(was, json_array_get(json_object_get(after, "animations"), 0)));
        assert_begins(was, is, "samplers");
        json_t *hand = json_array_get(json_object_get(is, "channels"), HAND_SAMPLER);
        assert_int_equal(json_integer_value(json_object_get(hand, "sampler")), THEIR_SAMPLERS);
        json_object_set_new(hand, "sampler", json_integer(HAND_SAMPLER));
        assert_begins(was, is, "channels");
        assert_true(json_equal(json_object_get(was, "extras"), json_object_get(is, "extras")));
        assert_true(json_equal(json_object_get(was, "extensions"), json_object_get(is, "extensions")));
        assert_string_equal(json_string_value(json_object_get(is, "name")), n ? "Else" : "Act");
        json_t *lamp = json_array_get(json_object_get(after, "nodes"), 4);
        assert_null(json_object_get(lamp, "matrix")); // glTF does not let a clip move one
        assert_non_null(json_object_get(lamp, "rotation"));
        json_decref(before);
        json_decref(after);
    }
}

/// A chain's bone that steps still steps, also at the end of a round.
TEST(a_bone_of_a_chain_keeps_its_steps)
{
    struct gltf before, after;
    struct gltf_pose was, is;
    struct builder b = {0};
    ADD(&b, FLOAT, float, 1, 0, 0.21f, 0.77f, 1);
    ADD(&b, FLOAT, float, 4, 0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0.6f, 0, 0.8f, 0, 0, 0, 1);
    const char *file = write_built(
        &b, "steps.gltf",
        "'nodes':[{'name':'arm','children':[1]},{'name':'hand','translation':[0,1,0],'children':[2]},"
        "{'name':'finger','translation':[0,1,0]}],'animations':[{'name':'Act','samplers':[{'input':0,'output':1,"
        "'interpolation':'STEP'}],'channels':[{'sampler':0,'target':{'node':1,'path':'rotation'}}]}]");
    for (int cubic = 0; cubic < 2; cubic++) {
        assert_done(gltf_read(file, &before, &error));
        assert_done(gltf_read(export_plain(file, 0, 0, (struct export_options){.is_cubic = cubic}, "out.glb"), &after,
                              &error));
        assert_true(gltf_pose_create(&before, &was) && gltf_pose_create(&after, &is));
        for (int i = 0; i <= 3000; i++) {
            gltf_pose_clip(&before, 0, i / 3000.0, &was);
            gltf_pose_clip(&after, 0, i / 3000.0, &is);
            for (int k = 0; k < 4; k++) assert_near(is.place[1].rotation[k], was.place[1].rotation[k], 1e-5);
        }
        gltf_pose_free(&was);
        gltf_pose_free(&is);
        gltf_free(&before);
        gltf_free(&after);
    }
}

/// However many rounds of the clip the scene shows, or which part of it, all nodes move as in the clip, also between frames: steps step, and
/// cubics are the same curves.
TEST(exports_hold_the_clip_over_any_frames)
{
    static const struct {
        int first, last;
        double start; ///< seconds of the clip
        double length;
    } cases[] = {
        {0, 0, 0.51, 1}, {51, 351, 0.51, 3}, {73, 142, 0.73, 0.69}, {93, 231, 0.93, 1.38}, {22, 160, 0.51, 1.38}};
    static char text[1 << 16];
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct gltf before, after;
        struct gltf_pose was, is;
        const char *file = write_theirs(text);
        assert_done(gltf_read(file, &before, &error));
        const bool loops = before.clips[0].loops;
        assert_done(
            gltf_read(export_plain(file, cases[c].first, cases[c].last, (struct export_options){0}, "out.glb"),
                      &after, &error));
        assert_true(gltf_pose_create(&before, &was) && gltf_pose_create(&after, &is));
        assert_near(after.clips[0].first, 0.51, 1e-6);
        assert_near(after.clips[0].last, 0.51 + cases[c].length, 1e-5);
        for (int i = 0; i < 500; i++) {
            const double into = cases[c].length * (i + 0.5) / 500, lead = cases[c].first == 22 ? 0.29 : 0;
            double time = fmax(cases[c].start + into - lead - 0.51, 0);
            time = 0.51 + (loops ? fmod(time, 1) : fmin(time, 1));
            gltf_pose_clip(&before, 0, time, &was);
            gltf_pose_clip(&after, 0, 0.51 + into, &is);
            for (int n = 0; n < before.node_count; n++) {
                const float *a = (const float *)&was.place[n], *b = (const float *)&is.place[n];
                for (size_t k = 0; k < sizeof was.place[n] / sizeof *a; k++)
                    if (!(fabsf(a[k] - b[k]) < 2e-5f))
                        fail_msg("case %zu at %g s: node %d, number %zu is %g, was %g", c, time, n, k, (double)b[k],
                                 (double)a[k]);
            }
        }
        gltf_pose_free(&was);
        gltf_pose_free(&is);
        gltf_free(&before);
        gltf_free(&after);
    }
}
