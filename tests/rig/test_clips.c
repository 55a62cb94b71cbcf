/// Clips of other programs: they begin and end where their own keys do, and loop where they do; splines follow their joints, without the
/// corners; and exports edit them.
#include "export/export.h"
#include "gltf_builder.h"
#include "rig/import.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include <jansson.h>

static const double pi = 3.14159265358979323846;

// --- files with clips

/// A clip's channels, as they are added.
struct clip {
    char samplers[1024], channels[1024];
    int count;
};

/// Rotations (4 numbers a key) or translations (3) of a node.
static void add_channel(struct builder *b, struct clip *clip, int node, int numbers, int keys, const float *times,
                        const float *values)
{
    const char *comma = clip->count ? "," : "";
    const int input = add_data(b, FLOAT, "SCALAR", keys, times, (size_t)keys * sizeof *times);
    const int output =
        add_data(b, FLOAT, numbers == 4 ? "VEC4" : "VEC3", keys, values, (size_t)(keys * numbers) * sizeof *values);
    sprintf(clip->samplers + strlen(clip->samplers), "%s{'input':%d,'output':%d}", comma, input, output);
    sprintf(clip->channels + strlen(clip->channels), "%s{'sampler':%d,'target':{'node':%d,'path':'%s'}}", comma,
            clip->count++, node, numbers == 4 ? "rotation" : "translation");
}

static char *print_clip(char *out, const struct clip *clip, const char *name)
{
    return out + sprintf(out, "{'name':'%s','samplers':[%s],'channels':[%s]}", name, clip->samplers, clip->channels);
}

#define SHOWN "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'scenes':[{'nodes':[0]}],'nodes':["
#define BELOW "{'name':'hand','translation':[0,1,0],'children':[2]},{'name':'finger','translation':[0,0.5,0]}"
#define ARM_HAND_FINGER "{'name':'arm','mesh':0,'children':[1]}," BELOW "],'animations':["

static const char *start_file(struct builder *b)
{
    *b = (struct builder){0};
    ADD(b, FLOAT, float, 3, 0, 0, 0, 0, 1, 0, 0.1f, 0, 0);
    return SHOWN;
}

/// A file, and it at a time of its first clip.
struct played {
    struct gltf gltf;
    struct gltf_pose pose;
};

static void play_open(struct played *played, const char *path)
{
    assert_done(gltf_read(path, &played->gltf, &error));
    assert_true(gltf_pose_create(&played->gltf, &played->pose));
}

static void play_close(struct played *played)
{
    gltf_pose_free(&played->pose);
    gltf_free(&played->gltf);
}

static void add_chain(struct opened *opened, const char *from, bool follows)
{
    int rig;
    const struct chain_wish wish = {.from = from, .follows = follows};
    assert_done(chain_make(opened->document, opened->models, &wish, &rig, &error));
    opened_solve(opened, SOLVER_BY_LENGTH);
}

static const char *export_opened(struct opened *opened, struct export_options options, const char *name)
{
    struct export_report report;
    const struct posing posing = opened_posing(opened);
    const char *path = temporary_path(name);
    assert_done(export_write(&posing, path, &options, &report, &error));
    opened_free(opened);
    return path;
}

// --- a clip is the scene from its first key to its last

enum { MOST_KEYS = 41, ARM = 0, HAND };

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
    return action->loops ? 0.4 * sin(2 * pi * part) : 0.9 * part * part;
}

/// A file of an arm, a hand and a finger, with these clips.
static const char *write_actions(const struct action *from, int count)
{
    struct builder b;
    char json[4096], *end = stpcpy(stpcpy(json, start_file(&b)), ARM_HAND_FINGER);
    for (int a = 0; a < count; a++) {
        struct clip clip = {.count = 0};
        float times[MOST_KEYS], turns[MOST_KEYS][4] = {{0}};
        const int keys = from[a].last - from[a].first + 1;
        for (int k = 0; k < keys; k++) {
            const double half = turn_at(&from[a], from[a].first + k) / 2;
            times[k] = (float)((from[a].first + k) / 24.0);
            turns[k][0] = (float)sin(half);
            turns[k][3] = (float)cos(half);
        }
        add_channel(&b, &clip, ARM, 4, keys, times, *turns);
        if (a > 0) *end++ = ',';
        end = print_clip(end, &clip, from[a].name);
    }
    strcpy(end, "]");
    return write_built(&b, "actions.gltf", json);
}

/// Exports the first clip of a file of actions, with a chain from the hand on, or all of them.
static void export_actions(const struct action *from, int count, bool all, struct played *played)
{
    struct opened opened;
    assert_done(opened_read(&opened, write_actions(from, count), &error));
    assert_int_equal(opened.document->first_frame, from->first);
    assert_int_equal(opened.document->last_frame, from->last);
    add_chain(&opened, "hand", true);
    assert_int_equal(spline_start(opened.document->splines[0]), from->loops ? WIGGLY_LOOP : WIGGLY_REST);
    play_open(played,
              export_opened(&opened, (struct export_options){.substeps = 1, .all_clips = all}, "actions.glb"));
}

/// The arm turns at the times of the action's keys as it did, and no key is one too many.
static void check_clip(struct played *played, const struct action *action)
{
    const int clip = gltf_find_clip(&played->gltf, action->name);
    assert_true(clip >= 0);
    assert_near(played->gltf.clips[clip].first, action->first / 24.0, 1e-6);
    assert_near(played->gltf.clips[clip].last, action->last / 24.0, 1e-6);
    assert_int_equal(played->gltf.clips[clip].channels[0].key_count, action->last - action->first + 1);
    for (int frame = action->first; frame <= action->last; frame++) {
        gltf_pose_clip(&played->gltf, clip, frame / 24.0, &played->pose);
        assert_near(2 * asin((double)played->pose.place[ARM].rotation[0]), turn_at(action, frame), 1e-6);
    }
}

/// Whatever clip the scene plays comes out alone, or with all others; each has the keys of the chain in its own frames.
TEST(clips_come_out_with_their_chains)
{
    for (int first = 0; first < ACTIONS; first++) {
        struct played played;
        struct action turned[ACTIONS];
        for (int a = 0; a < ACTIONS; a++) turned[a] = actions[(first + a) % ACTIONS];
        export_actions(turned, 1, false, &played);
        check_clip(&played, turned);
        play_close(&played);
        export_actions(turned, ACTIONS, true, &played);
        assert_int_equal(played.gltf.clip_count, ACTIONS);
        for (int a = 0; a < ACTIONS; a++) {
            const struct gltf_channel *hand = &played.gltf.clips[a].channels[1];
            const int last = hand->key_count - 1;
            double swing = 0;
            assert_string_equal(played.gltf.clips[a].name, turned[a].name);
            check_clip(&played, &turned[a]);
            assert_int_equal(hand->node, HAND);
            assert_int_equal(last, turned[a].last - turned[a].first);
            for (int k = 0; k <= last; k++) swing = fmax(swing, fabs((double)hand->values[4 * k]));
            assert_true(swing > 0.01);
            const double end = (double)fabsf(hand->values[4 * last] - hand->values[0]);
            assert_true(turned[a].loops ? end < 1e-5 : end > 1e-3);
        }
        play_close(&played);
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
    struct played played;
    export_actions(twins, 3, true, &played);
    assert_int_equal(played.gltf.clip_count, 3);
    for (int c = 0; c < 3; c++) {
        const struct gltf_clip *clip = &played.gltf.clips[c];
        assert_string_equal(clip->name, expected[c].name);
        assert_int_equal(clip->channel_count, expected[c].channels);
        assert_int_equal(clip->channels[0].key_count, expected[c].keys);
    }
    play_close(&played);
}

/// Of one that begins at 1/24 s and lasts a second. A scene may begin before its clip, as those of earlier versions do: the clip waits, unless
/// it loops in the scene.
TEST(the_time_of_a_clip)
{
    static const struct {
        int first, last;
        bool loops;
        double sample, frame; ///< of the scene, of the clip
    } rows[] = {
        {0, 25, true, 0, 1},    {0, 25, false, 0, 1}, {0, 24, false, 0, 1},   {0, 24, true, 0, 24},
        {-24, 24, true, 0, 24}, {1, 25, true, 0, 1},  {1, 25, true, 48, 1},   {1, 25, false, 48, 25},
        {1, 25, false, 60, 25}, {1, 25, true, 60, 7}, {1, 25, false, 7, 4.5}, {1, 49, true, 72, 13},
        {0, 12, true, 0, 1},    {0, 36, true, 0, 1},  {1, 25, false, -9, 1},  {25, 49, false, 0, 25},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const struct clip_play play = {.first = 1 / 24.0, .length = 1, .loops = rows[r].loops};
        struct document *document = document_create();
        document->fps = 24;
        document->substeps = 2;
        document->first_frame = rows[r].first;
        document->last_frame = rows[r].last;
        const double frame = 24 * posing_clip_time(document, rows[r].sample, &play);
        if (!(fabs(frame - rows[r].frame) < 1e-5))
            fail_msg("row %zu: frame %g, expected %g", r, frame, rows[r].frame);
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
    struct clip clip = {.count = 0};
    struct document *document;
    assert_true(b && times && places);
    for (int k = 0; k < count; k++) times[k] = (float)(first + k * step);
    places[count / 2][1] = places[count - 1][0] = 1;
    add_channel(b, &clip, 0, 3, count, times, *places);
    strcpy(print_clip(stpcpy(json, "'nodes':[{'name':'it'}],'animations':["), &clip, "Hit"), "]");
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
    } rows[] = {
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
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct document *document = scene_of_keys(rows[r].first, rows[r].step, rows[r].count);
        if (!(fabs(document->fps / rows[r].fps - 1) < 1e-6) || document->first_frame != rows[r].frames[0] ||
            document->last_frame != rows[r].frames[1])
            fail_msg("row %zu: %g fps, frames %d to %d", r, document->fps, document->first_frame,
                     document->last_frame);
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

static void add_gait(struct builder *b, struct clip *clip, const struct gait_case *of, int node)
{
    enum { MOST = 32 };
    float times[MOST], turns[MOST][4], places[MOST][3];
    const int parts = of->has_copy ? of->keys - 1 : of->keys;
    for (int k = 0; k < of->keys; k++) {
        const double u = (double)k / parts, ease = u * u * (3 - 2 * u);
        const double swing = of->gait == CYCLE ? sin(2 * pi * u + 2 * node) + 0.3 * sin(4 * pi * u + node)
                                               : 2 * sin(pi * u) * sin(pi * u) * (1 + 0.2 * node);
        const double turn = of->gait == DOOR ? 0 : 0.4 * swing + 0.8 * of->end * (of->gait == CYCLE ? u : ease);
        const double way = of->gait == LEAP ? ease : u + (of->gait == CYCLE ? 0.02 * sin(4 * pi * u) : 0);
        times[k] = (float)(of->gait == DOOR ? k / 12.0 : k / 24.0);
        memcpy(turns[k], (float[]){(float)sin(turn / 2), 0, 0, (float)cos(turn / 2)}, sizeof turns[k]);
        memcpy(places[k], (float[]){(float)(of->travel * way), (float)(1 + 0.05 * (of->gait == DOOR ? 0 : swing)), 0},
               sizeof places[k]);
    }
    if (node == 0) add_channel(b, clip, node, 3, of->keys, times, *places);
    add_channel(b, clip, node, 4, of->keys, times, *turns);
}

static const char *write_gait(const struct gait_case *of)
{
    static struct builder b;
    struct clip clip = {.count = 0};
    char json[4096], *end = stpcpy(json, start_file(&b));
    for (int node = 0; node < (of->gait == DOOR ? 1 : 4); node++) add_gait(&b, &clip, of, node);
    end = stpcpy(end,
                 "{'name':'hips','mesh':0,'children':[1,2,3]},{'name':'left'},{'name':'right'},{'name':'tail',"
                 "'translation':[0,0,-0.3],'children':[4]},{'name':'tip','translation':[0,0,-0.3]}],'animations':[");
    strcpy(print_clip(end, &clip, "gait"), "]");
    return write_built(&b, "gait.gltf", json);
}

/// A clip loops if its pose ends as it begins, wherever the character is by then. Its scene is a whole round, and what follows it does not
/// jump, nor lie back because of the travel.
TEST(what_loops)
{
    for (size_t g = 0; g < sizeof gaits / sizeof *gaits; g++) {
        const struct gait_case *of = &gaits[g];
        struct opened opened;
        assert_done(opened_read(&opened, write_gait(of), &error));
        struct document *document = opened.document;
        const struct gltf_clip *clip = &models_imported(opened.models, document, 0)->gltf.clips[0];
        if (clip->loops != of->loops) fail_msg("%s %s", of->what, clip->loops ? "loops" : "plays once");
        assert_near(clip->last + (clip->loops ? clip->gap : 0), of->frames / 24.0, 1e-6);
        assert_int_equal(document->last_frame - document->first_frame, of->frames);
        add_chain(&opened, "tail", true);
        assert_int_equal(spline_start(document->splines[0]), of->loops ? WIGGLY_LOOP : WIGGLY_REST);
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
    struct played played;
    struct gltf_pose end;
    play_open(&played, write_gait(&gaits[6]));
    const struct gltf *gltf = &played.gltf;
    struct gltf_pose *pose = &played.pose;
    assert_true(gltf_pose_create(gltf, &end));
    const double last = gltf->clips[0].last, gap = gltf->clips[0].gap;
    assert_near(gap, 1 / 24.0, 1e-6);
    gltf_pose_loop(gltf, 0, last + gap, pose);
    gltf_pose_clip(gltf, 0, 0, &end);
    for (int n = 0; n < 4; n++)
        for (int k = 0; k < 4; k++) assert_near(pose->place[n].rotation[k], end.place[n].rotation[k], 1e-6);
    assert_near(pose->place[0].translation[0], 3, 0.1); // a whole round on
    gltf_pose_loop(gltf, 0, last + gap / 2, pose);
    gltf_pose_clip(gltf, 0, last, &end);
    assert_true(pose->place[0].translation[0] > end.place[0].translation[0]);
    assert_true(pose->place[1].rotation[0] != end.place[1].rotation[0]);
    gltf_pose_clip(gltf, 0, last + gap / 2, pose);
    assert_memory_equal(pose->place, end.place, 4 * sizeof *pose->place);
    gltf_pose_free(&end);
    play_close(&played);
}

// --- what joints do in the dog's walk, as equilibria follow it: against the clip itself, without its corners, again and again

enum { SUBSTEPS = 4, CYCLES = 3, MOST_SAMPLES = 3000 };

static double samples[MOST_SAMPLES]; ///< of a joint that is followed

struct walk {
    struct opened opened;
    int count; ///< of samples
};

static void open_walk(struct walk *walk, double fps, int frames)
{
    assert_done(opened_read(&walk->opened, "assets/models/dog.glb", &error));
    walk->opened.document->substeps = SUBSTEPS;
    walk->opened.document->fps = fps;
    walk->opened.document->last_frame = frames;
    walk->count = document_samples(walk->opened.document);
    assert_true(walk->count <= MOST_SAMPLES);
}

#define WALK_TEST(name, fps, frames)                                                                                 \
    TEST_OF(struct walk, walk, open_walk(walk, fps, frames), opened_free(&walk->opened), name)

/// Returns the largest, or −1: there is no such joint. `chain` may be NULL.
static double follow(const struct walk *walk, const char *model, const char *joint, enum motion_of of,
                     const char *chain)
{
    char names[3][16];
    const struct model_source source = models_source(walk->opened.models);
    const struct joint_motion motion = {.model = strcpy(names[0], model),
                                        .joint = strcpy(names[1], joint),
                                        .of = of,
                                        .chain = chain ? strcpy(names[2], chain) : NULL};
    double most = 0;
    if (!source.follow(source.context, walk->opened.document, &motion, NULL, samples)) return -1;
    for (int s = 0; s < walk->count; s++) most = fmax(most, fabs(samples[s]));
    return most;
}

/// A joint's place along an axis in the clip at a sample, metres.
static double joint_at(const struct walk *walk, const char *joint, int sample, int axis)
{
    const struct document *document = walk->opened.document;
    const struct imported *imported = models_imported(walk->opened.models, document, 0);
    struct gltf_pose *pose = models_pose(walk->opened.models, document, 0, POSE_UNSEEN);
    const double time = fmod(sample * document_step(document), imported->gltf.clips[0].last);
    gltf_pose_clip(&imported->gltf, 0, time, pose);
    gltf_pose_world(&imported->gltf, pose);
    return (double)pose->world[gltf_find_node(&imported->gltf, joint)][12 + axis];
}

/// Up is the height, and across is to the left (of a tail, which points back, to the right), less the means over whole rounds of samples.
static void check_joints(struct walk *walk, int over)
{
    static const struct {
        const char *joint;
        enum motion_of of;
        const char *chain;
        int axis;
        double scale, sign, within;
    } rows[] = {{"hips", MOTION_UP, NULL, 1, 1, 1, 2e-3},
                {"hips", MOTION_ACROSS, NULL, 0, 1, 1, 2e-3},
                {"hips", MOTION_ACROSS, "tail", 0, 2, -1, 4e-3},
                {"hips", MOTION_ACROSS, "nothing", 0, 1, 1, 2e-3},
                {"toe_back_L", MOTION_UP, NULL, 1, 1, 1, 2e-2}}; // which goes far along
    add_chain(&walk->opened, "tail_1", false);
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        double mean = 0;
        walk->opened.document->rigs[0]->model.scale = rows[r].scale;
        assert_true(follow(walk, "dog", rows[r].joint, rows[r].of, rows[r].chain) > 0.005);
        for (int s = 0; s < over; s++) mean += joint_at(walk, rows[r].joint, s, rows[r].axis) / over;
        for (int s = 0; s < walk->count; s++) {
            const double moved = joint_at(walk, rows[r].joint, s, rows[r].axis) - mean;
            assert_near(samples[s], rows[r].scale * rows[r].sign * moved, rows[r].within);
        }
    }
}

WALK_TEST(what_follows_a_joint_moves_as_it_does, 24, 24 * CYCLES) { check_joints(walk, 24 * SUBSTEPS); }

/// A clip that no number of samples fits goes on in its own time, round after round: one of a second is 93.5 samples.
WALK_TEST(a_clip_between_samples_does_not_drift, 23.375, 720) { check_joints(walk, 187); }

/// Straight lines from key to key would bend at every fourth sample only; a spline's second differences do not jump.
WALK_TEST(every_cycle_is_the_same_and_its_corners_are_rounded, 24, 24 * CYCLES)
{
    double largest = 0, jump = 0, before = 0;
    follow(walk, "dog", "head", MOTION_ACROSS, NULL);
    for (int s = 24 * SUBSTEPS; s < walk->count; s++) assert_near(samples[s], samples[s - 24 * SUBSTEPS], 0);
    follow(walk, "dog", "hips", MOTION_ACROSS, NULL);
    for (int s = 1; s + 1 < walk->count; s++) {
        const double bend = samples[s - 1] - 2 * samples[s] + samples[s + 1];
        if (s > 1) jump = fmax(jump, fabs(bend - before));
        largest = fmax(largest, fabs(bend));
        before = bend;
    }
    assert_true(largest > 0 && jump < 0.5 * largest);
}

WALK_TEST(turns_are_degrees_and_nobody_has_no_motion, 24, 24)
{
    const double most = follow(walk, "dog", "hips", MOTION_TURN, NULL);
    assert_true(most > 0.5 && most < 45);
    assert_near(follow(walk, "dog", "nobody", MOTION_UP, NULL), -1, 0);
    assert_near(follow(walk, "nobody", "hips", MOTION_UP, NULL), -1, 0);
}

// --- exports edit the file's own clip

enum { THEIR_SAMPLERS = 8, HAND_SAMPLER = 5 };

/// A clip with all that others write: steps, cubics, sparse and normalised numbers, pointers, channels without a node, extras; with keys between
/// frames, beginning at 0.51 s. Node 1 and 2 are a chain, node 4 has a matrix.
static const char *write_theirs(void)
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
    return write_built(
        &b, "theirs.gltf",
        "'scenes':[{'nodes':[0,3,4]}],'materials':[{'name':'glow'}],"
        "'extensionsUsed':['KHR_animation_pointer','EXT_none'],'nodes':[{'name':'arm','children':[1]}," BELOW
        ",{'name':'prop'},{'name':'lamp','matrix':[1,0,0,0,0,0,-1,0,0,1,0,0,3,0,0,1]}],'animations':[{"
        "'extras':{'event':'step@0.3'},'name':'Act','extensions':{'EXT_none':{'k':[1.5]}},'samplers':["
        "{'input':0,'output':3,'interpolation':'STEP','extras':5},{'input':1,'output':5},"
        "{'input':1,'output':6,'interpolation':'CUBICSPLINE'},{'input':1,'output':7},{'input':0,'output':3},"
        "{'input':0,'output':4},{'input':2,'output':7},{'input':2,'output':6,'interpolation':'CUBICSPLINE'}],"
        "'channels':[{'sampler':0,'target':{'node':3,'path':'scale'}},"
        "{'sampler':1,'target':{'node':3,'path':'rotation'}},{'sampler':2,'target':{'node':0,'path':'translation'}},"
        "{'sampler':3,'target':{'node':3,'path':'translation'}},{'sampler':4,'target':{'path':'pointer',"
        "'extensions':{'KHR_animation_pointer':{'pointer':'/materials/0/emissiveFactor'}}}},"
        "{'sampler':5,'extras':1,'target':{'node':1,'path':'rotation'}},"
        "{'sampler':6,'target':{'path':'translation'}},{'sampler':7,'target':{'node':4,'path':'translation'}}]}]");
}

static const char *write_steps(void)
{
    struct builder b = {0};
    ADD(&b, FLOAT, float, 1, 0, 0.21f, 0.77f, 1);
    ADD(&b, FLOAT, float, 4, 0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0.6f, 0, 0.8f, 0, 0, 0, 1);
    return write_built(
        &b, "steps.gltf",
        "'nodes':[{'name':'arm','children':[1]}," BELOW "],'animations':[{'name':'Act','samplers':[{'input':0,"
        "'output':1,'interpolation':'STEP'}],'channels':[{'sampler':0,'target':{'node':1,'path':'rotation'}}]}]");
}

/// Exports a file with a chain that nothing bends, over some frames (0, 0: all).
static const char *export_plain(const char *file, int first, int last, struct export_options options,
                                const char *name)
{
    struct opened opened;
    assert_done(opened_read(&opened, file, &error));
    if (last) assert_done(edit_range(opened.document, first, last, RANGE_TRIM, &error));
    add_chain(&opened, "hand", false);
    return export_opened(&opened, options, name);
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
    static const char *const names[] = {NULL, "Else"}, *const kept[] = {"extras", "extensions"},
                             *const arrays[] = {"accessors", "bufferViews", "buffers", "materials"};
    for (size_t n = 0; n < 2; n++) {
        const char *file = write_theirs();
        json_t *before = json_load_file(file, 0, NULL);
        json_t *after =
            json_load_file(export_plain(file, 0, 0, (struct export_options){.clip = names[n]}, "out.gltf"), 0, NULL);
        json_t *clips = json_object_get(after, "animations");
        json_t *was = json_array_get(json_object_get(before, "animations"), 0), *is = json_array_get(clips, n);
        for (int a = 0; a < 4; a++) assert_begins(before, after, arrays[a]);
        assert_int_equal(json_array_size(clips), n + 1);
        if (n) assert_true(json_equal(was, json_array_get(clips, 0)));
        assert_begins(was, is, "samplers");
        json_t *hand = json_array_get(json_object_get(is, "channels"), HAND_SAMPLER);
        assert_int_equal(json_integer_value(json_object_get(hand, "sampler")), THEIR_SAMPLERS);
        json_object_set_new(hand, "sampler", json_integer(HAND_SAMPLER));
        assert_begins(was, is, "channels");
        for (int k = 0; k < 2; k++)
            assert_true(json_equal(json_object_get(was, kept[k]), json_object_get(is, kept[k])));
        assert_string_equal(json_string_value(json_object_get(is, "name")), n ? "Else" : "Act");
        json_t *lamp = json_array_get(json_object_get(after, "nodes"), 4);
        assert_null(json_object_get(lamp, "matrix")); // glTF does not let a clip move one
        assert_non_null(json_object_get(lamp, "rotation"));
        json_decref(before);
        json_decref(after);
    }
}

/// However many rounds of the clip the scene shows, or which part of it, all nodes move as in the clip, also between frames: steps step, a
/// chain's bone too and at the end of a round, and cubics are the same curves.
TEST(exports_hold_the_clip_over_any_frames)
{
    static const struct {
        const char *(*write)(void);
        int first, last;
        double start, length; ///< seconds of the clip
        double lead;          ///< seconds of the scene before it
    } rows[] = {
        {write_theirs, 0, 0, 0.51, 1, 0},          {write_theirs, 51, 351, 0.51, 3, 0},
        {write_theirs, 73, 142, 0.73, 0.69, 0},    {write_theirs, 93, 231, 0.93, 1.38, 0},
        {write_theirs, 22, 160, 0.51, 1.38, 0.29}, {write_steps, 0, 0, 0, 1, 0},
    };
    enum { TIMES = 1000 };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct played was, is;
        const char *file = rows[r].write();
        play_open(&was, file);
        play_open(&is, export_plain(file, rows[r].first, rows[r].last, (struct export_options){0}, "out.glb"));
        const double first = was.gltf.clips[0].first;
        assert_near(is.gltf.clips[0].first, first, 1e-6);
        assert_near(is.gltf.clips[0].last, first + rows[r].length, 1e-5);
        for (int i = 0; i < TIMES; i++) {
            const double into = rows[r].length * (i + 0.5) / TIMES,
                         time = fmax(rows[r].start + into - rows[r].lead - first, 0);
            gltf_pose_clip(&was.gltf, 0, first + (was.gltf.clips[0].loops ? fmod(time, 1) : fmin(time, 1)),
                           &was.pose);
            gltf_pose_clip(&is.gltf, 0, first + into, &is.pose);
            for (int n = 0; n < was.gltf.node_count; n++) {
                const float *a = (const float *)&was.pose.place[n], *b = (const float *)&is.pose.place[n];
                for (size_t k = 0; k < sizeof was.pose.place[n] / sizeof *a; k++)
                    if (!(fabsf(a[k] - b[k]) < 2e-5f))
                        fail_msg("row %zu at %g s: node %d, number %zu is %g, was %g", r, time, n, k, (double)b[k],
                                 (double)a[k]);
            }
        }
        play_close(&was);
        play_close(&is);
    }
}
