/// The tail's pose: directions and units of the file format, lag (paper, section 7.1), and the default scene's
/// motion.
#include "documents.h"
#include "model/fox.h"
#include "posed_tail.h"

enum { JOINTS = 24, LOOP_FRAMES = 120 };

static const double turn = 6.283185307179586;

static struct channel channels[2];
static struct pose pose;

/// A straight tail with one channel: lag 6.5 and gain 5 degrees.
static struct tail plain_tail(enum axis axis)
{
    memset(channels, 0, sizeof channels);
    channels[0].axis = axis;
    channels[0].lag.value[0] = 6.5;
    channels[0].gain.value[0] = 5.0;
    return (struct tail){.joints = JOINTS,
                         .length = 1.6,
                         .position = {{0.1, -1}, {0.2, -1}, {0.3, -1}},
                         .channels = channels,
                         .channel_count = 1};
}

/// Frame n's column c, relative to frame n − 1 (frame −1 is the world).
static void relative_axis(const struct pose *of, int n, int c, double out[3])
{
    static const float world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const float *before = n > 0 ? of->matrix[n - 1] : world;
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0;
        for (int r = 0; r < 3; r++) out[k] += (double)before[4 * k + r] * (double)of->matrix[n][4 * c + r];
    }
}

/// How far joint n turns about +y, in radians.
static double side_bend(const struct pose *of, int n)
{
    double z[3];
    relative_axis(of, n, 2, z);
    return atan2(z[0], z[2]);
}

static wiggly_value oscillation(double phase) { return (wiggly_value){.re = cos(phase), .im = sin(phase)}; }

TEST(side_turns_about_y_and_up_lifts)
{
    const wiggly_value one = {.y = 1.0};
    struct tail tail = plain_tail(AXIS_SIDE);
    pose_tail(&tail, &one, LOOK_WIGGLY, &pose);
    assert_int_equal(pose.count, JOINTS + 1);
    assert_near(side_bend(&pose, 0), 5.0 * turn / 360.0, 1e-6);
    assert_true(pose.matrix[JOINTS][12] > 0.3f); // counter-clockwise about +y takes +z to +x
    assert_near(pose.matrix[JOINTS][13], 0.2, 1e-5);
    tail = plain_tail(AXIS_UP);
    pose_tail(&tail, &one, LOOK_WIGGLY, &pose);
    assert_true(pose.matrix[JOINTS][13] > 0.5f);
    assert_near(pose.matrix[JOINTS][12], 0.1, 1e-5);
}

TEST(rest_bends_without_any_channel)
{
    struct tail tail = plain_tail(AXIS_SIDE);
    tail.channel_count = 0;
    tail.rest.form = ANGLES_EACH;
    tail.rest.count = JOINTS;
    tail.rest.value[0] = 90.0;
    pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
    assert_near(pose.matrix[JOINTS][12], 0.1, 1e-5);
    assert_near(pose.matrix[JOINTS][13], 0.2 + 1.6, 1e-5);
    assert_near(pose.matrix[JOINTS][14], 0.3, 1e-5);
}

TEST(segments_keep_their_length_and_frames_stay_square)
{
    struct tail tail = plain_tail(AXIS_SIDE);
    channels[1] = channels[0];
    channels[1].axis = AXIS_UP;
    tail.channel_count = 2;
    const wiggly_value wild[2] = {{.y = 0.0, .re = 3.0, .im = -7.0}, {.y = -4.0, .re = 1.0, .im = 2.0}};
    pose_tail(&tail, wild, LOOK_WIGGLY, &pose);
    for (int n = 1; n <= JOINTS; n++) {
        double length = 0.0;
        for (int k = 0; k < 3; k++) length += pow(pose.matrix[n][12 + k] - pose.matrix[n - 1][12 + k], 2.0);
        assert_near(sqrt(length), 1.6 / JOINTS, 1e-6);
        for (int c = 0; c < 3; c++) {
            for (int d = 0; d < 3; d++) {
                double dot = 0.0;
                for (int r = 0; r < 3; r++)
                    dot += (double)pose.matrix[n][4 * c + r] * (double)pose.matrix[n][4 * d + r];
                assert_near(dot, c == d, 1e-5);
            }
        }
    }
    assert_near(pose.scale, 1.6 / (double)FOX_TAIL_LENGTH, 1e-5);
}

TEST(moving_takes_the_whole_pose_along)
{
    static struct pose moved;
    struct tail tail = plain_tail(AXIS_SIDE);
    const wiggly_value value = {.y = 7.0, .re = 0.4, .im = 0.3};
    pose_tail(&tail, &value, LOOK_WIGGLY, &pose);
    for (int k = 0; k < 3; k++) tail.position[k].value += (const double[3]){1.0, -2.0, 0.5}[k];
    pose_tail(&tail, &value, LOOK_WIGGLY, &moved);
    assert_near(moved.matrix[JOINTS][12], pose.matrix[JOINTS][12] + 1.0, 1e-6);
    assert_near(moved.matrix[0][13], pose.matrix[0][13] - 2.0, 1e-6);
    assert_near(moved.matrix[5][14], pose.matrix[5][14] + 0.5, 1e-6);
}

/// Joint n now bends as the base did n·lag earlier.
TEST(every_joint_lags_behind_the_base)
{
    static struct pose now, before;
    const struct tail tail = plain_tail(AXIS_SIDE);
    const double phase = 1.1, lag = 6.5 * turn / 360.0;
    wiggly_value value = oscillation(phase);
    pose_tail(&tail, &value, LOOK_WIGGLY, &now);
    for (int n = 0; n < JOINTS; n++) {
        value = oscillation(phase - n * lag);
        pose_tail(&tail, &value, LOOK_WIGGLY, &before);
        assert_near(side_bend(&now, n), side_bend(&before, 0), 1e-6);
    }
    assert_true(fabs(side_bend(&now, JOINTS - 1) - side_bend(&now, 0)) > 0.02);
}

TEST(the_stiff_look_moves_all_joints_in_phase)
{
    const struct tail tail = plain_tail(AXIS_SIDE);
    const wiggly_value value = oscillation(1.1);
    pose_tail(&tail, &value, LOOK_STIFF, &pose);
    for (int n = 1; n < JOINTS; n++) assert_near(side_bend(&pose, n), side_bend(&pose, 0), 1e-6);
}

TEST(arrays_give_each_joint_its_own_lag_and_gain)
{
    const struct tail tail = plain_tail(AXIS_SIDE);
    channels[0].lag.form = channels[0].gain.form = ANGLES_EACH;
    channels[0].lag.count = channels[0].gain.count = JOINTS;
    channels[0].lag.value[7] = 40.0;
    channels[0].gain.value[7] = 8.0;
    const wiggly_value value = oscillation(0.3);
    pose_tail(&tail, &value, LOOK_WIGGLY, &pose);
    assert_near(side_bend(&pose, 7), 8.0 * turn / 360.0 * cos(0.3 - 40.0 * turn / 360.0), 1e-6);
    assert_near(side_bend(&pose, 8), 0.0, 1e-6);
}

TEST(the_longest_chain_fits)
{
    struct tail tail = plain_tail(AXIS_SIDE);
    tail.joints = TAIL_MAX_JOINTS;
    const wiggly_value value = oscillation(0.3);
    pose_tail(&tail, &value, LOOK_WIGGLY, &pose);
    assert_int_equal(pose.count, TAIL_MAX_JOINTS + 1);
    assert_true(isfinite(pose.matrix[TAIL_MAX_JOINTS][12]));
}

/// The default scene, solved, and its tail posed at any time.
struct scene {
    struct document *document;
    struct evaluation evaluation;
};

static void open_scene(struct scene *scene)
{
    scene->document = document_of_file("assets/scenes/tail.json");
    evaluation_update(&scene->evaluation, scene->document, false);
}

static void close_scene(struct scene *scene)
{
    evaluation_free(&scene->evaluation);
    document_destroy(scene->document);
}

#define SCENE_TEST(name) TEST_OF(struct scene, scene, open_scene(scene), close_scene(scene), name)

static void pose_at(const struct scene *scene, double frame, struct pose *out)
{
    const struct posing posing = {.document = scene->document, .evaluation = &scene->evaluation};
    struct rig_pose posed;
    assert_true(rig_pose(&posing, 0, frame, NULL, &posed));
    *out = posed.strand;
}

static double distance(const float a[3], const float b[3])
{
    return sqrt(pow(a[0] - b[0], 2.0) + pow(a[1] - b[1], 2.0) + pow(a[2] - b[2], 2.0));
}

SCENE_TEST(the_default_scene_is_made_of_few_knots)
{
    int knots = 0;
    for (int s = 0; s < scene->document->spline_count; s++) {
        knots += s < 2 ? scene->document->splines[s]->knot_count : 0; // those of the tail, which come first
        assert_int_equal(scene->evaluation.status[s], WIGGLY_OK);
    }
    assert_true(knots <= 9);
}

/// Positions and velocities from frame to frame change no more where the loop closes than elsewhere.
SCENE_TEST(the_default_scene_loops_without_a_pop)
{
    static struct pose poses[LOOP_FRAMES];
    for (int f = 0; f < LOOP_FRAMES; f++) pose_at(scene, f, &poses[f]);
    double step_elsewhere = 0.0, jerk_elsewhere = 0.0, step_at_seam = 0.0, jerk_at_seam = 0.0;
    for (int f = 0; f < LOOP_FRAMES; f++) {
        const int next = (f + 1) % LOOP_FRAMES, after = (f + 2) % LOOP_FRAMES;
        for (int n = 0; n < poses[f].count; n++) {
            const float *a = poses[f].matrix[n] + 12, *b = poses[next].matrix[n] + 12,
                        *c = poses[after].matrix[n] + 12;
            const float ahead[3] = {2 * b[0] - a[0], 2 * b[1] - a[1], 2 * b[2] - a[2]};
            double *step = next == 0 ? &step_at_seam : &step_elsewhere;
            double *jerk = next == 0 || after == 0 ? &jerk_at_seam : &jerk_elsewhere;
            *step = fmax(*step, distance(a, b));
            *jerk = fmax(*jerk, distance(ahead, c));
        }
    }
    assert_true(step_elsewhere > 0.02); // it moves at all
    assert_true(step_at_seam <= step_elsewhere);
    assert_true(jerk_at_seam <= jerk_elsewhere);
    static struct pose last;
    pose_at(scene, LOOP_FRAMES, &last);
    assert_near(distance(last.matrix[JOINTS] + 12, poses[0].matrix[JOINTS] + 12), 0.0, 1e-5);
}

SCENE_TEST(the_default_scene_swings_widely_above_the_ground)
{
    float low = INFINITY, left = INFINITY, right = -INFINITY;
    for (double f = 0.0; f < LOOP_FRAMES; f += 0.25) {
        float lo[3], hi[3];
        pose_at(scene, f, &pose);
        pose_bounds(&pose, lo, hi);
        for (int n = 0; n < pose.count; n++) {
            for (int k = 0; k < 3; k++) {
                assert_true(pose.matrix[n][12 + k] >= lo[k] && pose.matrix[n][12 + k] <= hi[k]);
            }
            low = fminf(low, pose.matrix[n][13] - 0.05f - pose.ground);
        }
        left = fminf(left, pose.matrix[JOINTS][12]);
        right = fmaxf(right, pose.matrix[JOINTS][12]);
    }
    assert_true(low > 0.0f);
    assert_true(right - left > 1.0f);
}

/// The body stands where its height says, on 0 where that follows a spline, wherever it is to the side.
TEST(the_ground_is_below_the_base)
{
    struct tail tail = plain_tail(AXIS_SIDE);
    tail.channel_count = 0;
    pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
    const double sunk = 0.2 - FOX_BASE_HEIGHT * 1.6 / FOX_TAIL_LENGTH;
    assert_near(pose.ground, sunk, 1e-6);
    tail.position[0].track = 0;
    tail.position[2].track = 0;
    pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
    assert_near(pose.ground, sunk, 1e-6);
    tail.position[1].track = 0;
    pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
    assert_near(pose.ground, 0, 0);
}

/// Curled into a ring over the back, or into one below the feet: what redraws and cameras go by holds the skin.
TEST(bounds_hold_a_curled_tail)
{
    static struct rig_pose fox;
    struct models *models = models_create();
    for (int up = 0; up < 2; up++) {
        struct tail tail = plain_tail(AXIS_SIDE);
        float lo[3], hi[3];
        tail.channel_count = 0;
        tail.rest.value[0] = up ? 15.0 : -15.0;
        int count;
        pose_tail_in(models, &tail, NULL, LOOK_WIGGLY, &pose, &fox);
        pose_bounds(&pose, lo, hi);
        float(*place)[3] = fox_places(&fox, &count);
        for (int v = 0; v < count; v++) {
            for (int k = 0; k < 3; k++) assert_true(place[v][k] > lo[k] - 0.005f && place[v][k] < hi[k] + 0.005f);
        }
        free(place);
    }
    models_destroy(models);
}

/// A tail that lies on the ground throws more shadow than one held up; both stay within the room given.
TEST(shadows_are_stronger_near_the_ground)
{
    struct shadow_blob blobs[32];
    struct tail tail = plain_tail(AXIS_SIDE);
    tail.channel_count = 0;
    tail.rest.form = ANGLES_EACH;
    tail.rest.count = JOINTS;
    static const float overhead[3] = {0, 1, 0};
    float total[2];
    for (int high = 0; high < 2; high++) {
        tail.rest.value[0] = high ? 60.0 : -3.0;
        pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
        const int count = pose_blobs(&pose, overhead, blobs, 32);
        total[high] = 0.0f;
        for (int b = 0; b < count; b++) {
            assert_true(blobs[b].strength > 0.0f && blobs[b].strength <= 1.0f && blobs[b].radius > 0.0f);
            total[high] += blobs[b].strength;
        }
        assert_int_equal(pose_blobs(&pose, overhead, blobs, 3), 3);
    }
    assert_true(total[0] > 1.5f * total[1]);
}

/// The higher an animal hops, the weaker the shadow under its body: what is left falls to 1 : e in a third of its size.
TEST(a_hop_takes_the_shadow_along)
{
    static const float overhead[3] = {0, 1, 0};
    struct shadow_blob blobs[2][32];
    struct tail tail = plain_tail(AXIS_SIDE);
    tail.channel_count = 0;
    tail.length *= 0.2; // a small animal
    for (int high = 0; high < 2; high++) {
        pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
        const float scale = pose.scale;
        if (high) {
            for (int n = 0; n < pose.count; n++) pose.matrix[n][13] += 0.35f * scale;
        }
        assert_true(pose_blobs(&pose, overhead, blobs[high], 32) >= 3);
    }
    for (int b = 0; b < 3; b++) assert_near((double)(blobs[1][b].strength / blobs[0][b].strength), exp(-1), 0.02);
}
