/// A tail and its fox: directions and units of the file format, lag (paper, section 7.1), angles along it, the body's parts, bounds and
/// shadows, the motion of the committed scenes, and what it follows a dragged body by.
#include "curve.h"
#include "model/fox.h"
#include "posed_tail.h"
#include "rig/import.h"
#include "rig/swing.h"
#include "spline_of.h"
#include "world.h"

enum { JOINTS = 24, LOOP_FRAMES = 120 };

static const double degree = 6.283185307179586 / 360;

static struct channel channels[2];
static struct pose pose;

/// A straight tail with one channel, lag 6.5 and gain 5 degrees, or none.
static struct tail plain_tail(enum axis axis, int channel_count)
{
    memset(channels, 0, sizeof channels);
    for (int c = 0; c < 2; c++) channels[c] = (struct channel){.axis = axis, .lag.value = {6.5}, .gain.value = {5.0}};
    channels[1].axis = AXIS_UP;
    return (struct tail){.joints = JOINTS,
                         .length = 1.6,
                         .position = {param_number(0.1), param_number(0.2), param_number(0.3)},
                         .channels = channels,
                         .channel_count = channel_count};
}

/// How far joint n turns about +y against the one before, in radians: the angle of its z axis.
static double side_bend(const struct pose *of, int n)
{
    static const float world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const float *before = n > 0 ? of->matrix[n - 1] : world;
    double z[3] = {0};
    for (int k = 0; k < 3; k++)
        for (int r = 0; r < 3; r++) z[k] += (double)before[4 * k + r] * (double)of->matrix[n][8 + r];
    return atan2(z[0], z[2]);
}

static wiggly_value oscillation(double phase) { return (wiggly_value){.re = cos(phase), .im = sin(phase)}; }

static void assert_tip(const double expected[3], double tolerance)
{
    for (int k = 0; k < 3; k++) assert_near(pose.matrix[pose.count - 1][12 + k], expected[k], tolerance);
}

/// Counter-clockwise about +y takes +z to +x; up lifts; rest bends without any channel.
TEST(axes_and_rest)
{
    const wiggly_value one = {.y = 1.0};
    double x = 0, z = 0;
    for (int n = 1; n <= JOINTS; n++)
        x += sin(5 * degree * n) * 1.6 / JOINTS, z += cos(5 * degree * n) * 1.6 / JOINTS;
    struct tail tail = plain_tail(AXIS_SIDE, 1);
    pose_tail(&tail, &one, LOOK_WIGGLY, &pose);
    assert_int_equal(pose.count, JOINTS + 1);
    assert_near(side_bend(&pose, 0), 5 * degree, 1e-6);
    assert_tip((const double[]){0.1 + x, 0.2, 0.3 + z}, 1e-5);
    tail = plain_tail(AXIS_UP, 1);
    pose_tail(&tail, &one, LOOK_WIGGLY, &pose);
    assert_tip((const double[]){0.1, 0.2 + x, 0.3 + z}, 1e-5);
    tail = plain_tail(AXIS_TWIST, 1);
    pose_tail(&tail, &one, LOOK_WIGGLY, &pose);
    assert_tip((const double[]){0.1, 0.2, 0.3 + 1.6}, 1e-5);
    tail = plain_tail(AXIS_SIDE, 0);
    tail.rest = (struct angles){.form = ANGLES_EACH, .count = JOINTS, .value = {90}};
    pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
    assert_tip((const double[]){0.1, 0.2 + 1.6, 0.3}, 1e-5);
    tail.joints = TAIL_MAX_JOINTS;
    pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
    assert_int_equal(pose.count, TAIL_MAX_JOINTS + 1);
    assert_true(isfinite(pose.matrix[TAIL_MAX_JOINTS][12]));
}

/// However wild it bends, and wherever it is moved to.
TEST(segments_keep_their_length_and_frames_stay_square)
{
    static struct pose moved;
    static const double way[] = {1, -2, 0.5};
    struct tail tail = plain_tail(AXIS_SIDE, 2);
    const wiggly_value wild[2] = {{.y = 0.0, .re = 3.0, .im = -7.0}, {.y = -4.0, .re = 1.0, .im = 2.0}};
    pose_tail(&tail, wild, LOOK_WIGGLY, &pose);
    for (int k = 0; k < 3; k++) tail.position[k].value += way[k];
    pose_tail(&tail, wild, LOOK_WIGGLY, &moved);
    for (int n = 0; n <= JOINTS; n++) {
        double length = 0.0;
        for (int k = 0; k < 3; k++) {
            if (n > 0) length += pow(pose.matrix[n][12 + k] - pose.matrix[n - 1][12 + k], 2.0);
            assert_near(moved.matrix[n][12 + k], pose.matrix[n][12 + k] + way[k], 1e-6);
        }
        if (n > 0) assert_near(sqrt(length), 1.6 / JOINTS, 1e-6);
        for (int i = 0; i < 9; i++) {
            double dot = 0.0;
            for (int r = 0; r < 3; r++)
                dot += (double)pose.matrix[n][4 * (i / 3) + r] * (double)pose.matrix[n][4 * (i % 3) + r];
            assert_near(dot, i / 3 == i % 3, 1e-5);
        }
    }
    assert_near(pose.scale, 1.6 / (double)FOX_TAIL_LENGTH, 1e-5);
}

/// Joint n now bends as the base did n·lag earlier, but in the stiff look; arrays give each joint its own lag and gain.
TEST(every_joint_lags_behind_the_base)
{
    static struct pose before;
    const struct tail tail = plain_tail(AXIS_SIDE, 1);
    const wiggly_value value = oscillation(1.1);
    for (int stiff = 0; stiff < 2; stiff++) {
        pose_tail(&tail, &value, stiff ? LOOK_STIFF : LOOK_WIGGLY, &pose);
        for (int n = 0; n < JOINTS; n++) {
            const wiggly_value earlier = oscillation(1.1 - (stiff ? 0 : n * 6.5 * degree));
            pose_tail(&tail, &earlier, LOOK_WIGGLY, &before);
            assert_near(side_bend(&pose, n), side_bend(&before, 0), 1e-6);
        }
        assert_int_equal(fabs(side_bend(&pose, JOINTS - 1) - side_bend(&pose, 0)) > 0.02, !stiff);
    }
    channels[0].lag = channels[0].gain = (struct angles){.form = ANGLES_EACH, .count = JOINTS};
    channels[0].lag.value[7] = 40.0;
    channels[0].gain.value[7] = 8.0;
    pose_tail(&tail, &value, LOOK_WIGGLY, &pose);
    for (int n = 0; n < JOINTS; n++)
        assert_near(side_bend(&pose, n), n == 7 ? 8 * degree * cos(1.1 - 40 * degree) : 0, 1e-6);
}

// --- angles along a tail: looked up, read, printed, edited, and resampled for another number of joints

static const struct angles ramp = {.form = ANGLES_RAMP, .count = 3, .ramp = {{0.25, 10}, {0.5, 40}, {1, 120}}};
static const struct angles one = {.value = {6}}, each = {.form = ANGLES_EACH, .count = 3, .value = {1, 5, 2}};

/// A ramp is straight between its points; only a lag of one number grows by itself.
TEST(angles_of_a_joint)
{
    static const struct {
        const struct angles *angles;
        int joint, joints;
        double angle, lag;
    } rows[] = {
        {&ramp, 0, 5, 10, 10}, {&ramp, 1, 5, 10, 10}, {&ramp, 2, 5, 40, 40},   {&ramp, 3, 5, 80, 80},
        {&ramp, 3, 9, 25, 25}, {&ramp, 0, 1, 10, 10}, {&ramp, 4, 5, 120, 120}, {&one, 4, 5, 6, 24},
        {&each, 1, 5, 5, 5},   {&each, 4, 5, 2, 2},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        assert_near(angles_at(rows[r].angles, rows[r].joint, rows[r].joints), rows[r].angle, 1e-12);
        assert_near(angles_lag(rows[r].angles, rows[r].joint, rows[r].joints), rows[r].lag, 1e-12);
    }
}

/// A ramp is printed as it was read, and poses a tail exactly as the numbers that it stands for.
TEST(ramps_are_printed_and_pose_like_their_numbers)
{
    static struct pose posed[2];
    struct document *document = document_of_text(
        "{\"frames\": [0, 9], \"splines\": [{\"name\": \"s\"}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\","
        " \"joints\": 5, \"rest\": {\"ramp\": [[0, 1], [1, 2]], \"mood\": 1}, \"spline\": \"s\","
        " \"lag\": {\"ramp\": [[0.25, 10], [0.5, 40], [1, 120]], \"ease\": \"in\"}}]}");
    struct tail *tail = &document->rigs[0]->tail;
    assert_memory_equal(tail->channels[0].lag.ramp, &ramp.ramp, 3 * sizeof *ramp.ramp);
    char *first = text_of_document(document);
    assert_non_null(strstr(first, "\"rest\": { \"ramp\": [[0, 1], [1, 2]], \"mood\": 1 }"));
    assert_non_null(
        strstr(first, "\"lag\": { \"ramp\": [[0.25, 10], [0.5, 40], [1, 120]], \"ease\": \"in\" }, \"gain\": 5 }"));
    assert_loads_again(document);
    const wiggly_value value = {.y = 0.1, .re = 0.7, .im = -0.4};
    pose_tail(tail, &value, LOOK_WIGGLY, &posed[0]);
    struct angles *const all[] = {&tail->rest, &tail->channels[0].lag, &tail->channels[0].gain};
    for (int a = 0; a < 3; a++) {
        struct angles numbers = {.form = ANGLES_EACH, .count = tail->joints};
        for (int n = 0; n < tail->joints; n++) numbers.value[n] = angles_at(all[a], n, tail->joints);
        *all[a] = numbers;
    }
    pose_tail(tail, &value, LOOK_WIGGLY, &posed[1]);
    assert_memory_equal(posed[0].matrix, posed[1].matrix, (size_t)posed[0].count * sizeof *posed[0].matrix);
    free(first);
    document_destroy(document);
}

static bool edit_second(struct world *world, enum angle_kind kind, const struct angles *angles)
{
    return edit_angles(world_edit(world), (struct channel_place){0, 1}, kind, angles, &world->error);
}

/// With twice the joints each bends half as much, but for parts of the body; where along the tail is where it was.
WORLD_TEST(angles_and_axes_are_edited_and_undone, world_open(world))
{
    struct angles longer = ramp, wrong;
    longer.ramp[longer.count++] = (struct ramp_point){1, 7};
    longer.ramp[2].at = 0.75;
    const struct angles *const turns[] = {&ramp, &longer, &each, &ramp, &one, &each};
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++)
        assert_reversible(world, edit_second(world, ANGLE_LAG, turns[i]));
    wrong = ramp;
    wrong.ramp[0].at = 0; // the first place has none before it
    assert_reversible(world, edit_second(world, ANGLE_LAG, &wrong));
    wrong = ramp;
    wrong.ramp[1].at = 0.25;
    assert_refused(world, edit_second(world, ANGLE_LAG, &wrong), "t: the places of a ramp must ascend");
    wrong.ramp[1].at = 2;
    assert_refused(world, edit_second(world, ANGLE_LAG, &wrong), "t: the places of a ramp are from 0 to 1");
    wrong.count = 1;
    assert_refused(world, edit_second(world, ANGLE_LAG, &wrong), "t: a ramp has from 2 to 32 points");
    wrong = each;
    wrong.count = 2;
    assert_refused(world, edit_second(world, ANGLE_LAG, &wrong),
                   "t: there must be one angle for each of the 3 joints");
    world_must(world, edit_second(world, ANGLE_LAG, &ramp));
    world_must(world, edit_second(world, ANGLE_GAIN, &ramp));
    assert_reversible(world, edit_joints(world_edit(world), 0, 6, &world->error));
    const struct channel *channel = &document_tail(world->document, 0)->channels[1];
    assert_int_equal(channel->gain.form, ANGLES_RAMP);
    for (int i = 0; i < ramp.count; i++) {
        assert_near(channel->gain.ramp[i].at, ramp.ramp[i].at, 0);
        assert_near(channel->gain.ramp[i].angle, ramp.ramp[i].angle / 2, 1e-6);
        assert_near(channel->lag.ramp[i].angle, ramp.ramp[i].angle, 0);
    }
    assert_reversible(world, edit_bend(world, 0, 1, -1, AXIS_NOD, -1));
    assert_reversible(world, edit_joints(world_edit(world), 0, 3, &world->error));
    assert_near(document_tail(world->document, 0)->channels[1].gain.ramp[1].angle, ramp.ramp[1].angle / 2, 1e-6);
    assert_refused(
        world, edit_bend(world, 0, 1, -1, AXES, -1),
        "t: the axis must be \"side\", \"up\", \"look\", \"nod\", \"ears\", \"breath\", \"stretch\" or \"blink\"");
    world_undo_all(world);
}

// --- bounds, the ground and shadows

/// The body stands where its height says, on 0 where that follows a spline, wherever it is to the side.
TEST(the_ground_is_below_the_base)
{
    const double sunk = 0.2 - FOX_BASE_HEIGHT * 1.6 / FOX_TAIL_LENGTH;
    for (int follows = 0; follows < 8; follows++) {
        struct tail tail = plain_tail(AXIS_SIDE, 0);
        for (int k = 0; k < 3; k++) tail.position[k].track = follows >> k & 1 ? 0 : -1;
        pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
        assert_near(pose.ground, follows & 2 ? 0 : sunk, 1e-6);
    }
}

/// The skin, or what of it has no fur, stays in the box that redraws and cameras go by; returns its lowest point.
static float assert_holds(const struct rig_pose *fox, const struct pose *of, bool furless)
{
    const struct gltf_part *coat = &fox->imported->gltf.meshes->parts[0];
    float lo[3], hi[3], low = INFINITY;
    int count;
    pose_bounds(of, lo, hi);
    float(*place)[3] = fox_places(fox, &count);
    assert_true(count > coat->vertex_count);
    for (int v = 0; v < count; v++) {
        low = fminf(low, place[v][1]);
        if (furless && v < coat->vertex_count && coat->fur[v][0] > 0) continue;
        for (int k = 0; k < 3; k++) assert_true(place[v][k] > lo[k] - 0.005f && place[v][k] < hi[k] + 0.005f);
    }
    free(place);
    return low;
}

/// Curled into a ring over the back, or into one below the feet.
TEST(bounds_hold_a_curled_tail)
{
    static struct rig_pose fox;
    struct models *models = models_create();
    for (int up = 0; up < 2; up++) {
        struct tail tail = plain_tail(AXIS_SIDE, 0);
        tail.rest.value[0] = up ? 15.0 : -15.0;
        pose_tail_in(models, &tail, NULL, LOOK_WIGGLY, &pose, &fox);
        assert_holds(&fox, &pose, false);
    }
    models_destroy(models);
}

static const float overhead[3] = {0, 1, 0};

/// A tail that lies on the ground throws more shadow than one held up; both stay within the room given. The higher an animal hops, the
/// weaker the shadow under its body: what is left falls to 1 : e in a third of its size.
TEST(shadows_are_stronger_near_the_ground)
{
    struct shadow_blob blobs[2][32];
    float total[2] = {0};
    for (int high = 0; high < 2; high++) {
        struct tail tail = plain_tail(AXIS_SIDE, 0);
        tail.rest = (struct angles){.form = ANGLES_EACH, .count = JOINTS, .value = {high ? 60 : -3}};
        pose_tail(&tail, NULL, LOOK_WIGGLY, &pose);
        const int count = pose_blobs(&pose, overhead, *blobs, 32);
        for (int b = 0; b < count; b++) {
            assert_true(blobs[0][b].strength > 0.0f && blobs[0][b].strength <= 1.0f && blobs[0][b].radius > 0.0f);
            total[high] += blobs[0][b].strength;
        }
        assert_int_equal(pose_blobs(&pose, overhead, *blobs, 3), 3);
    }
    assert_true(total[0] > 1.5f * total[1]);
    struct tail small = plain_tail(AXIS_SIDE, 0);
    small.length *= 0.2;
    pose_tail(&small, NULL, LOOK_WIGGLY, &pose);
    for (int high = 0; high < 2; high++) {
        for (int n = 0; n < pose.count && high; n++) pose.matrix[n][13] += 0.35f * pose.scale;
        assert_true(pose_blobs(&pose, overhead, blobs[high], 32) >= 3);
    }
    for (int b = 0; b < 3; b++) assert_near(blobs[1][b].strength / blobs[0][b].strength, exp(-1), 0.02);
}

// --- the committed scenes: splines swing the tail, breathe, blink, turn the head, flick the ears and squash the body, and its skin follows

static struct opened scene;

static void open_scene(const char *path)
{
    assert_done(opened_read(&scene, path, &error));
    opened_solve(&scene, SOLVER_BY_LENGTH);
}

static const struct pose *pose_at(double frame)
{
    static struct rig_pose posed;
    const struct posing posing = {.document = scene.document, .evaluation = &scene.evaluation};
    assert_true(rig_pose(&posing, 0, frame * scene.document->substeps, &posed));
    return &posed.strand;
}

static struct rig_pose fox_at(double frame)
{
    struct rig_pose fox;
    const struct posing posing = opened_posing(&scene);
    assert_true(rig_pose_body(&posing, 0, frame * scene.document->substeps, &fox));
    return fox;
}

static double distance(const float a[3], const float b[3])
{
    return sqrt(pow(a[0] - b[0], 2.0) + pow(a[1] - b[1], 2.0) + pow(a[2] - b[2], 2.0));
}

/// Few knots; positions and velocities from frame to frame change no more where the loop closes than elsewhere; it swings widely above the
/// ground, breathes evenly and blinks once.
TEST(the_start_scene)
{
    static struct pose poses[LOOP_FRAMES];
    float in = 0, out = 0, low = INFINITY, left = INFINITY, right = -INFINITY;
    double step[2] = {0}, jerk[2] = {0}; // elsewhere, and at the seam
    int knots = 0, blinks = 0, shut = 0;
    open_scene("assets/scenes/tail.json");
    for (int s = 0; s < scene.document->spline_count; s++) {
        knots += s < 2 ? scene.document->splines[s]->knot_count : 0; // those of the tail, which come first
        assert_int_equal(scene.evaluation.status[s], WIGGLY_OK);
    }
    assert_true(knots <= 9);
    for (int quarter = 0; quarter < 4 * LOOP_FRAMES; quarter++) {
        const struct pose *is = pose_at(quarter / 4.0);
        const int f = quarter / 4;
        float lo[3], hi[3];
        pose_bounds(is, lo, hi);
        for (int n = 0; n < is->count; n++) {
            for (int k = 0; k < 3; k++) assert_true(is->matrix[n][12 + k] >= lo[k] && is->matrix[n][12 + k] <= hi[k]);
            low = fminf(low, is->matrix[n][13] - 0.05f - is->ground);
        }
        left = fminf(left, is->matrix[JOINTS][12]);
        right = fmaxf(right, is->matrix[JOINTS][12]);
        if (quarter % 4 != 0) continue;
        poses[f] = *is;
        in = fmaxf(in, is->limbs.breath);
        out = fminf(out, is->limbs.breath);
        blinks += f > 0 && is->limbs.blink > 0.5f && poses[f - 1].limbs.blink <= 0.5f;
        shut += is->limbs.blink > 0.1f;
    }
    for (int f = 0; f < LOOP_FRAMES; f++) {
        const int next = (f + 1) % LOOP_FRAMES, after = (f + 2) % LOOP_FRAMES;
        for (int n = 0; n < poses[f].count; n++) {
            const float *a = poses[f].matrix[n] + 12, *b = poses[next].matrix[n] + 12,
                        *c = poses[after].matrix[n] + 12;
            const float ahead[3] = {2 * b[0] - a[0], 2 * b[1] - a[1], 2 * b[2] - a[2]};
            double *s = &step[next == 0], *j = &jerk[next == 0 || after == 0];
            *s = fmax(*s, distance(a, b));
            *j = fmax(*j, distance(ahead, c));
        }
    }
    assert_true(step[0] > 0.02); // it moves at all
    assert_true(step[1] <= step[0] && jerk[1] <= jerk[0]);
    assert_near(distance(pose_at(LOOP_FRAMES)->matrix[JOINTS] + 12, poses[0].matrix[JOINTS] + 12), 0.0, 1e-5);
    assert_true(low > 0.0f && right - left > 1.0f);
    assert_near(in, 0.02, 0.004);
    assert_near(out, -0.02, 0.004);
    assert_int_equal(blinks, 1);
    assert_true(shut > 1 && shut < 10);
    opened_free(&scene);
}

/// A rig reads its splines its offset earlier, between samples as their curves do, around the seam of a loop, and where an open curve ends as at
/// the end; settling knots' move of the equilibrium, too. Where a base or a clip moves it, it is not later.
TEST(an_offset_delays_all_that_splines_do)
{
    static const char text[] =
        "{'frames': [-4, 44], 'substeps': 2, 'splines': [{'name': 'free', 'frequency': 1, 'damping': 0.1, "
        "'equilibrium': {'spline': 'base'}, 'knots': [{'frame': 0, 'value': 1, 'slope': 2}, {'frame': 20, 'value': "
        "-1, "
        "'settles': true}]}, {'name': 'loop', 'frequency': 1.4, 'start': 'loop', 'knots': [{'frame': 3, 'value': 1}, "
        "{'frame': 30, 'value': -1}]}, {'name': 'rest', 'mode': 'real', 'frequency': 1, 'start': 'rest', 'knots': "
        "[{'frame': 9, 'value': 1}]}, {'name': 'base', 'mode': 'cubic', 'start': 'loop', 'knots': [{'frame': 0, "
        "'value': "
        "0}, {'frame': 20, 'value': 1}]}], 'rigs': [{'type': 'tail', 'name': 't', 'joints': 3, 'position': "
        "[{'spline': "
        "'base'}, 0, 0], 'channels': [{'spline': 'free'}, {'spline': 'free', 'of': 'displacement'}, {'spline': "
        "'loop', "
        "'axis': 'up'}, {'spline': 'rest', 'axis': 'blink'}]}]}";
    static const double offsets[] = {0, 3, 2.37, -3.6, 100.25, -100.25};
    struct world world;
    struct evaluation evaluation = {0};
    world_open_scene(&world, json(text));
    evaluation_update(&evaluation, world.document, false);
    const struct posing posing = {.document = world.document, .evaluation = &evaluation};
    const wiggly_curve *curves = evaluation.curves;
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        world.document->rigs[0]->offset = offsets[i];
        for (double at = 0; at <= 96; at += 0.75) {
            wiggly_value values[RIG_MAX_INPUTS];
            struct rig_pose posed;
            posing_values(&posing, 0, at, values);
            for (int c = 0; c < 4; c++) {
                const wiggly_value is = wiggly_evaluate(&curves[c - (c > 0)], at - 2 * offsets[i]);
                const double read = at - 2 * offsets[i], follows = c == 1 ? wiggly_evaluate(&curves[3], read).re : 0;
                if (c != 1 || (read >= 2 && read <= 94)) assert_near(values[c].y, is.y - follows, 1e-12);
                assert_near(values[c].re, is.re, 1e-12);
                assert_near(values[c].im, is.im, 1e-12);
            }
            assert_true(rig_pose(&posing, 0, at, &posed));
            const wiggly_value base = wiggly_evaluate(&curves[3], at);
            assert_near(posed.strand.matrix[0][12], base.y + base.re, 1e-6);
        }
        wiggly_value ends[2][RIG_MAX_INPUTS];
        for (int end = 0; end < 2; end++) posing_values(&posing, 0, 96 * end, ends[end]);
        assert_near(ends[0][2].re, ends[1][2].re, 1e-12);
        assert_near(ends[0][2].im, ends[1][2].im, 1e-12);
    }
    evaluation_free(&evaluation);
    world_close(&world);
}

/// The head turns the way that the tip swings, and later than the tail's root.
TEST(the_head_looks_where_the_tail_goes)
{
    static const char *const paths[] = {"assets/scenes/tail.json", "assets/scenes/follow.json"};
    for (int p = 0; p < 2; p++) {
        open_scene(paths[p]);
        double both = 0, looks = 0, swings = 0, steps = 0;
        for (int f = scene.document->first_frame; f < scene.document->last_frame; f++) {
            const struct pose *is = pose_at(f);
            const double look = (double)is->limbs.look;
            const double tip = (double)(is->matrix[is->count - 1][12] - is->matrix[0][12]);
            both += look * tip;
            looks += look * look;
            swings += tip * tip;
            steps = fmax(steps, fabs((double)pose_at(f + 1)->limbs.look - look));
        }
        assert_true(both / sqrt(looks * swings) > 0.5);
        assert_true(steps < 0.1); // radians a frame: it turns, and does not jerk
        opened_free(&scene);
    }
}

/// It crouches before it leaves the ground, stretches as it rises, gives way as it lands, and its feet never sink in. The points of pins are
/// those of the picture all the while.
TEST(a_hop_is_anticipated_and_squashes)
{
    static const struct {
        int frame;
        float least, most, lowest, highest; ///< of the stretch, and of the lowest point
    } rows[] = {{5, -1, -0.1f, -0.03f, 0.02f},
                {10, 0.1f, 1, -0.03f, 1},
                {12, 0, 1, 0.1f, 1},
                {19, -1, -0.1f, -0.03f, 1},
                {42, -0.02f, 0.02f, -0.03f, 1}};
    open_scene("assets/scenes/follow.json");
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const struct rig_pose fox = fox_at(rows[r].frame);
        const struct pose is = *pose_at(rows[r].frame);
        const float low = assert_holds(&fox, &is, true);
        if (!(is.limbs.stretch > rows[r].least && is.limbs.stretch < rows[r].most && low > rows[r].lowest &&
              low < rows[r].highest))
            fail_msg("frame %d: stretch %g, lowest %g", rows[r].frame, (double)is.limbs.stretch, (double)low);
    }
    const struct model_source source = models_source(NULL);
    for (int f = 0; f <= 120; f += 3) {
        const struct rig_pose fox = fox_at(f);
        const struct pose is = *pose_at(f);
        assert_true(f > 96 || assert_holds(&fox, &is, true) > -0.03f);
        for (int joint = 0; joint < scene.document->rigs[0]->tail.joints; joint += 5) {
            const struct pin pin = {.frame = f, .point = joint};
            struct pin_point point;
            const struct pin_query query = {.pin = &pin};
            assert_true(source.find(NULL, &scene.evaluation, scene.document, &query, NULL, &point));
            for (int k = 0; k < 3; k++) assert_near(point.at[k], (double)is.matrix[joint + 1][12 + k], 1e-5);
        }
    }
    opened_free(&scene);
}

/// However far the parts move, the skin stays in the pose's bounds, which cameras and redraws go by. An ear bends as a chain: its tip by more
/// than its root; what is no ear stays with the head.
TEST(bounds_hold_the_skin)
{
    static const struct limbs wild[] = {
        {.ears = {0.3f, 0.5f}},
        {.look = 1.2f, .nod = 0.6f, .ears = {1, 1}},
        {.look = -1.2f, .nod = -0.6f, .ears = {-0.5f, -0.5f}},
        {.breath = 0.25f, .stretch = 0.4f},
        {.breath = 0.25f, .stretch = -0.4f, .nod = 0.6f},
    };
    open_scene("assets/scenes/tail.json");
    struct rig_pose fox = fox_at(0);
    struct gltf_pose *moved = models_pose(scene.models, scene.document, 0, POSE_UNSEEN);
    for (size_t w = 0; w < sizeof wild / sizeof *wild; w++) {
        struct pose is = *pose_at(0);
        is.limbs = wild[w];
        fox_move(&wild[w], moved);
        gltf_pose_world(&fox.imported->gltf, moved);
        fox.model.pose = moved;
        assert_holds(&fox, &is, true);
        const float root = moved->joints[LIMB_EAR][5], tip = moved->joints[LIMB_EAR_TIP][5];
        if (w == 0) assert_true(root < 0.99f && tip < root - 0.1f && fabsf(moved->joints[LIMB_HEAD][5] - 1) < 1e-6f);
    }
    opened_free(&scene);
}

/// What moves the body bends no joint, and no spline breaks it: wild ones leave the tail as it is.
TEST(the_body_has_limits)
{
    open_scene("assets/scenes/tail.json");
    const struct pose before = *pose_at(30);
    struct tail *tail = &scene.document->rigs[0]->tail;
    for (int sign = -1; sign <= 1; sign += 2) {
        struct by_hand hand = {.base = {0}};
        for (int c = 2; c < tail->channel_count; c++) hand.input[c].y = sign * 1e6;
        struct rig_pose posed;
        const struct posing posing = {.document = scene.document, .evaluation = &scene.evaluation, .by_hand = &hand};
        assert_true(rig_pose(&posing, 0, 30 * scene.document->substeps, &posed));
        const struct limbs is = posed.strand.limbs;
        for (int n = 0; n < before.count; n++)
            assert_memory_equal(before.matrix[n], posed.strand.matrix[n], sizeof before.matrix[n]);
        assert_near(is.look, sign * 70 * degree, 1e-6);
        assert_near(is.breath, sign > 0 ? 0.25 : -0.15, 1e-6);
        assert_near(is.blink, sign > 0, 0);
    }
    opened_free(&scene);
}

/// Ears are joints 1 and 2 of a part of the body, each as much later; a head is joint 1.
TEST(parts_of_the_body_lag)
{
    const wiggly_value value = oscillation(0);
    for (int stiff = 0; stiff < 2; stiff++) {
        struct tail tail = plain_tail(AXIS_EARS, 2);
        channels[1].axis = AXIS_LOOK;
        channels[0].lag.value[0] = channels[1].lag.value[0] = 30;
        pose_tail(&tail, (const wiggly_value[]){value, value}, stiff ? LOOK_STIFF : LOOK_WIGGLY, &pose);
        for (int n = 0; n < 2; n++)
            assert_near(pose.limbs.ears[n], 5 * degree * cos(stiff ? 0 : 30 * degree * (n + 1)), 1e-6);
        assert_near(pose.limbs.look, 5 * degree * cos(stiff ? 0 : 30 * degree), 1e-6);
    }
}

// --- dragged: the solver's own oscillator or filter, whatever the frame rate, and it comes to rest

static struct swing_filter filter_of(const struct spline *spline)
{
    struct swing_filter filter;
    double parameter[PARAMETER_COUNT];
    for (int p = 0; p < PARAMETER_COUNT; p++) parameter[p] = spline->parameter[p].value;
    assert_true(swing_filter(spline, parameter, &filter));
    return filter;
}

/// Half a metre in half a second, from rest to rest.
static double base_at(double t)
{
    double u = fmin(fmax(t / 0.5, 0), 1);
    return 0.5 * u * u * (3 - 2 * u);
}

/// Follows base_at(), looked at `rate` times a second, for some seconds; notes |x| at each time in `sizes`, which may be NULL.
static struct swing shaken(const struct swing_filter *filter, double rate, double seconds, double *sizes)
{
    struct swing swing = {{0}, {0}};
    double velocity = 0;
    for (int i = 0; i < (int)lround(seconds * rate); i++) {
        double next = (base_at((i + 1) / rate) - base_at(i / rate)) * rate;
        swing_step(&swing, filter, next - velocity, 1 / rate);
        velocity = next;
        if (sizes) sizes[i] = fabs(swing.x[0]);
    }
    return swing;
}

enum { RATE = 960, SAMPLES = 3 * RATE + 1 };

static double y[SAMPLES], re[SAMPLES], im[SAMPLES], total[SAMPLES], omega[SAMPLES], track[SAMPLES];

/// The forward response of Figure 5: from rest, no knots, the base's motion as equilibrium.
static wiggly_value solved(const struct spline *spline)
{
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = {.size = sizeof curve, .total = total, .y = y, .re = re, .im = im, .omega = omega};
    for (int i = 0; i < SAMPLES; i++) track[i] = base_at((double)i / RATE);
    desc.samples = SAMPLES;
    desc.step = 1.0 / RATE;
    desc.mode = spline_mode(spline);
    desc.passive = (wiggly_passive)spline->parameter[PARAMETER_PASSIVE].value;
    desc.start = WIGGLY_REST;
    desc.frequency.value = spline->parameter[PARAMETER_FREQUENCY].value;
    desc.damping.value = spline->parameter[PARAMETER_DAMPING].value;
    desc.bandwidth.value = spline->parameter[PARAMETER_BANDWIDTH].value;
    desc.equilibrium.track = track;
    curve_solve(&curve, &desc);
    return (wiggly_value){y[SAMPLES - 1], re[SAMPLES - 1], im[SAMPLES - 1]};
}

/// Told of the same base at the same times, the oscillator is the solved curve, to the last digits.
TEST(a_swing_is_what_the_solver_says)
{
    struct spline splines[] = {spline_of(WIGGLY_COMPLEX, 1, 0.08, 0.08), spline_of(WIGGLY_COMPLEX, 2, 0.2, 0),
                               spline_of(WIGGLY_REAL, 1.5, 0.1, 0), spline_of(WIGGLY_REAL, 1, 1, 0),
                               spline_of(WIGGLY_REAL, 1, 3, 0)};
    for (size_t s = 0; s < 2 * (sizeof splines / sizeof splines[0]); s++) {
        struct spline *spline = &splines[s / 2];
        spline->parameter[PARAMETER_PASSIVE].value = s % 2 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
        const struct swing_filter filter = filter_of(spline);
        struct swing swing = shaken(&filter, RATE, 3, NULL);
        const wiggly_value value = solved(spline);
        assert_near(swing.x[0], value.re, 1e-3 * filter.peak);
        assert_near(swing.x[1], value.im, 1e-3 * filter.peak);
        swing = (struct swing){{0}, {0}};
        for (int i = 0; i + 1 < SAMPLES && s % 2 == 0; i++) {
            const double before = y[i > 0 ? i - 1 : 0], step = 1.0 / RATE;
            assert_near(total[i], y[i] + swing.x[0], 1e-13);
            swing_step(&swing, &filter, ((y[i + 1] - y[i]) - (y[i] - before)) / step, step);
        }
    }
}

/// A tail is no rod that starts to swing later: it has most of its swing while the base still moves, the largest within half a period
/// of its stop, and dies away from there. With the filter it is the other way round: its two poles ring up together first.
TEST(a_swing_answers_at_once_and_does_not_grow)
{
    enum { HZ = 60, STOP = HZ / 2, HALF_PERIOD = HZ / 2 };
    struct spline spline = spline_of(WIGGLY_COMPLEX, 1, 0.08, 0.1);
    for (int passive = 0; passive < 2; passive++) {
        double sizes[4 * HZ], early = 0;
        int largest = 0;
        spline.parameter[PARAMETER_PASSIVE].value = passive;
        const struct swing_filter filter = filter_of(&spline);
        shaken(&filter, HZ, 4, sizes);
        for (int i = 0; i < 4 * HZ; i++) {
            if (sizes[i] > sizes[largest]) largest = i;
            if (i < STOP) early = sizes[largest];
        }
        const bool at_once = early > 0.5 * sizes[largest] && largest < STOP + HALF_PERIOD;
        assert_int_equal(at_once, passive == WIGGLY_OSCILLATOR);
    }
}

/// The same way of the base, told at 30, 60 and 144 frames a second.
TEST(frame_rate_does_not_matter)
{
    const struct spline spline = spline_of(WIGGLY_COMPLEX, 1.2, 0.1, 0.1);
    const struct swing_filter filter = filter_of(&spline);
    struct swing slow = {{0}, {0}}, fast = slow;
    swing_step(&slow, &filter, 0.7, 0.4);
    for (int i = 0; i < 100; i++) swing_step(&fast, &filter, i == 0 ? 0.7 : 0, 0.004);
    for (int k = 0; k < 2; k++) assert_near(fast.x[k], slow.x[k], 1e-13);
    assert_near(shaken(&filter, 30, 3, NULL).x[0], shaken(&filter, 144, 3, NULL).x[0], 0.01 * filter.peak);
}

/// Even a spline that rings forever lets its tail come to rest, and a step of the base swings it no further than `peak`. Nothing pulls a
/// cubic back.
TEST(a_swing_comes_to_rest_within_its_peak)
{
    const struct spline splines[] = {spline_of(WIGGLY_COMPLEX, 1, 0, 0.1), spline_of(WIGGLY_COMPLEX, 3, 0.3, 0.2),
                                     spline_of(WIGGLY_REAL, 1, 0.1, 0)};
    struct swing_filter filter;
    for (size_t s = 0; s < sizeof splines / sizeof splines[0]; s++) {
        filter = filter_of(&splines[s]);
        struct swing swing = {{0}, {0}};
        double largest = 0, seconds = 0;
        swing_step(&swing, &filter, 1000, 0.001); // a metre in a millisecond
        swing_step(&swing, &filter, -1000, 0.001);
        while (!swing_settled(&swing, &filter)) {
            swing_step(&swing, &filter, 0, 0.01);
            largest = fmax(largest, hypot(swing.x[0], swing.x[1]));
            seconds += 0.01;
            assert_true(seconds < 120);
        }
        assert_true(largest > 0.7 * filter.peak && largest < 1.25 * filter.peak);
    }
    const double parameter[PARAMETER_COUNT] = {0};
    struct spline spline = spline_of(WIGGLY_CUBIC, 1, 0.1, 0.1);
    assert_false(swing_filter(&spline, parameter, &filter));
    spline.parameter[PARAMETER_MODE].value = WIGGLY_COMPLEX;
    assert_false(swing_filter(&spline, parameter, &filter));
}

static void find_arm(const struct tail *tail, struct swing_arm *arm)
{
    struct rig rig = {.kind = RIG_TAIL, .tail = *tail};
    struct rig *rigs[] = {&rig};
    struct document document = {.rigs = rigs, .rig_count = 1};
    assert_true(swing_arm(&(struct posing){.document = &document}, 0, arm));
}

/// A channel of the total swings its tip about as far as the base goes; one of the displacement says itself how far, and then it
/// alone hangs on the base.
TEST(scale_and_direction_of_a_swing)
{
    struct tail tail = plain_tail(AXIS_SIDE, 1);
    channels[1].axis = AXIS_SIDE;
    channels[1].of = PART_DISPLACEMENT;
    const struct spline spline = spline_of(WIGGLY_COMPLEX, 1, 0.1, 0.1);
    const struct swing_filter filter = filter_of(&spline);
    struct swing_arm arm;
    find_arm(&tail, &arm);
    double bend = 5 * degree * swing_scale(&arm, &channels[0], &filter) * filter.peak, tip = 0;
    for (int n = 0; n < JOINTS; n++) tip += bend * 1.6 * (JOINTS - n) / JOINTS;
    assert_near(tip, 1, 1e-12);
    assert_near(swing_scale(&arm, &channels[1], &filter), 1, 0);
    assert_true(swing_hangs(channels, 1, &channels[0]));
    assert_false(swing_hangs(channels, 2, &channels[0]));
    assert_true(swing_hangs(channels, 2, &channels[1]));
    channels[0].axis = AXIS_UP;
    assert_true(swing_hangs(channels, 2, &channels[0])); // of another axis
    channels[0].axis = AXIS_NOD;
    assert_false(swing_hangs(channels, 1, &channels[0]));
    channels[0].axis = AXIS_SIDE;
    channels[0].gain.value[0] = 0;
    assert_near(swing_scale(&arm, &channels[0], &filter), 0, 0);
    // lifted by 30 degrees: moving away in front of it presses it down
    static const struct {
        enum axis axis;
        double lifted, direction[3];
    } rows[] = {{AXIS_SIDE, 0, {1, 0, 0}},
                {AXIS_LOOK, 0, {1, 0, 0}},
                {AXIS_UP, 0, {0, 1, 0}},
                {AXIS_NOD, 0, {0, 1, 0}},
                {AXIS_TWIST, 0, {0, 0, 0}},
                {AXIS_SIDE, 30, {1, 0, 0}},
                {AXIS_UP, 30, {0, 0.8660254037844386, -0.5}}};
    tail.rest = (struct angles){.form = ANGLES_EACH, .count = JOINTS};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        double direction[3];
        tail.rest.value[0] = rows[r].lifted;
        find_arm(&tail, &arm);
        swing_direction(&arm, rows[r].axis, direction);
        for (int k = 0; k < 3; k++) assert_near(direction[k], rows[r].direction[k], 1e-6);
    }
}
