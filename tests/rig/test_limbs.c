/// The fox lives: splines breathe, blink, turn its head, flick its ears and squash it, and its skin follows.
#include "model/fox.h"
#include "model/vector.h"
#include "posed_tail.h"
#include "rig/import.h"
#include "scene/edit.h"
#include "scene/history.h"

static struct opened scene;

static void open_scene(const char *path)
{
    assert_done(opened_read(&scene, path, &error));
    opened_solve(&scene, SOLVER_BY_LENGTH);
}

static const struct pose *pose_at(double frame)
{
    static struct rig_pose pose;
    const struct posing posing = {.document = scene.document, .evaluation = &scene.evaluation};
    assert_true(rig_pose(&posing, 0, frame * scene.document->substeps, NULL, &pose));
    return &pose.strand;
}

TEST(the_start_scene_breathes_and_blinks)
{
    open_scene("assets/scenes/tail.json");
    float in = 0, out = 0;
    int blinks = 0, shut = 0;
    for (int f = 0; f <= 120; f++) {
        const struct limbs limbs = pose_at(f)->limbs;
        in = fmaxf(in, limbs.breath);
        out = fminf(out, limbs.breath);
        blinks += f > 0 && limbs.blink > 0.5f && pose_at(f - 1)->limbs.blink <= 0.5f;
        shut += limbs.blink > 0.1f;
    }
    assert_near(in, 0.02, 0.004);
    assert_near(out, -0.02, 0.004);
    assert_int_equal(blinks, 1);
    assert_true(shut > 1 && shut < 10);
    opened_free(&scene);
}

/// The head turns the way that the tip swings, and later than the tail's root.
TEST(the_head_looks_where_the_tail_goes)
{
    static const char *const paths[] = {"assets/scenes/tail.json", "assets/scenes/follow.json"};
    for (int p = 0; p < 2; p++) {
        open_scene(paths[p]);
        double both = 0, looks = 0, swings = 0, steps = 0;
        for (int f = scene.document->first_frame; f < scene.document->last_frame; f++) {
            const struct pose *pose = pose_at(f);
            const double look = (double)pose->limbs.look;
            const double tip = (double)(pose->matrix[pose->count - 1][12] - pose->matrix[0][12]);
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

/// Its fox at a frame.
static struct rig_pose fox_at(double frame)
{
    static struct rig_pose fox;
    const struct posing posing = opened_posing(&scene);
    assert_true(rig_pose_body(&posing, 0, frame * scene.document->substeps, NULL, &fox));
    return fox;
}

/// Lowest point of the skin.
static float lowest(double frame)
{
    const struct rig_pose fox = fox_at(frame);
    float low = INFINITY;
    int count;
    float(*place)[3] = fox_places(&fox, &count);
    for (int v = 0; v < count; v++) low = fminf(low, place[v][1]);
    free(place);
    return low;
}

/// It crouches before it leaves the ground, stretches as it rises, gives way as it lands, and its feet never sink in.
TEST(a_hop_is_anticipated_and_squashes)
{
    open_scene("assets/scenes/follow.json");
    assert_true(pose_at(5)->limbs.stretch < -0.1f);
    assert_true(pose_at(10)->limbs.stretch > 0.1f);
    assert_true(pose_at(19)->limbs.stretch < -0.1f);
    assert_true(fabsf(pose_at(42)->limbs.stretch) < 0.02f);
    for (int f = 0; f <= 96; f++) assert_true(lowest(f) > -0.03f);
    assert_true(lowest(5) < 0.02f);
    assert_true(lowest(12) > 0.1f);
    opened_free(&scene);
}

/// However far the parts move, the skin stays in the pose's bounds, which cameras and redraws go by.
TEST(bounds_hold_the_skin)
{
    static const struct limbs wild[] = {
        {.look = 1.2f, .nod = 0.6f, .ears = {1, 1}},
        {.look = -1.2f, .nod = -0.6f, .ears = {-0.5f, -0.5f}},
        {.breath = 0.25f, .stretch = 0.4f},
        {.breath = 0.25f, .stretch = -0.4f, .nod = 0.6f},
    };
    open_scene("assets/scenes/tail.json");
    const struct rig_pose fox = fox_at(0);
    struct gltf_pose *moved = models_pose(scene.models, scene.document, 0, POSE_UNSEEN);
    const struct gltf *gltf = &fox.model.imported->gltf;
    const struct gltf_part *coat = &gltf->meshes->parts[0], *face = coat + 1;
    for (size_t w = 0; w < sizeof wild / sizeof *wild; w++) {
        struct pose pose = *pose_at(0);
        float lo[3], hi[3];
        int count;
        pose.limbs = wild[w];
        pose_bounds(&pose, lo, hi);
        fox_move(&wild[w], moved);
        gltf_pose_world(gltf, moved);
        float(*place)[3] = fox_places(&fox, &count);
        assert_true(face->vertex_count > 0);
        for (int v = 0; v < coat->vertex_count + face->vertex_count; v++) {
            if (v < coat->vertex_count && coat->fur[v][0] > 0) continue;
            for (int k = 0; k < 3; k++) assert_true(place[v][k] > lo[k] - 0.005f && place[v][k] < hi[k] + 0.005f);
        }
        free(place);
    }
    opened_free(&scene);
}

/// An ear bends as a chain: its tip by more than its root. What is no ear stays with the head.
TEST(ears_bend_as_chains)
{
    const struct limbs back = {.ears = {0.3f, 0.5f}};
    struct gltf fox;
    struct gltf_pose pose;
    fox_create(FOX_LEVELS - 1, 1, &fox);
    assert_true(gltf_pose_create(&fox, &pose));
    fox_move(&back, &pose);
    gltf_pose_world(&fox, &pose);
    const float upright[2] = {pose.joints[LIMB_EAR][5], pose.joints[LIMB_EAR_TIP][5]};
    assert_near(pose.joints[LIMB_HEAD][5], 1.0, 1e-6);
    assert_true(upright[0] < 0.99f && upright[1] < upright[0] - 0.1f);
    gltf_pose_free(&pose);
    gltf_free(&fox);
}

/// What moves the body bends no joint: a wild spline on the lids leaves the tail as it is.
TEST(the_body_leaves_the_tail_alone)
{
    open_scene("assets/scenes/tail.json");
    const struct pose before = *pose_at(30);
    struct tail *tail = &scene.document->rigs[0]->tail;
    for (int c = 2; c < tail->channel_count; c++) tail->channels[c].gain.value[0] = 1e6;
    const struct pose *after = pose_at(30);
    for (int n = 0; n < before.count; n++)
        assert_memory_equal(before.matrix[n], after->matrix[n], sizeof before.matrix[n]);
    assert_true(after->limbs.look < 1.3f && after->limbs.blink <= 1.0f && after->limbs.blink >= 0.0f);
    opened_free(&scene);
}

static bool try_axis(struct history *history, int rig, int channel, enum axis axis)
{
    struct channel changed = scene.document->rigs[rig]->bent.channels[channel];
    changed.axis = axis;
    history_begin(history, "Axis", 0);
    const bool possible = edit_channel(scene.document, (struct channel_place){rig, channel}, &changed, NULL);
    history_end(history);
    return possible;
}

/// A channel can be given to a part of the body and back; bending chains have none, and more joints leave it as it is.
TEST(axes_are_edited_and_undone)
{
    open_scene("assets/scenes/tail.json");
    struct history *history = history_create(scene.document);
    assert_true(try_axis(history, 0, 1, AXIS_NOD));
    assert_int_equal(scene.document->rigs[0]->tail.channels[1].axis, AXIS_NOD);
    assert_true(history_undo(history));
    assert_int_equal(scene.document->rigs[0]->tail.channels[1].axis, AXIS_UP);
    assert_false(try_axis(history, 0, 1, AXES));
    const double gain = scene.document->rigs[0]->tail.channels[2].gain.value[0];
    history_begin(history, "Joints", 0);
    assert_true(edit_joints(scene.document, 0, 12, NULL));
    history_end(history);
    assert_near(scene.document->rigs[0]->tail.channels[2].gain.value[0], gain, 0);
    history_destroy(history);
    opened_free(&scene);
    open_scene("assets/scenes/dog.json");
    history = history_create(scene.document);
    assert_false(try_axis(history, 1, 0, AXIS_BLINK));
    history_destroy(history);
    opened_free(&scene);
}

/// The points of pins are those of the picture, however the body moves.
TEST(pins_hold_what_is_drawn)
{
    open_scene("assets/scenes/follow.json");
    const struct model_source source = models_source(NULL);
    const struct tail *tail = &scene.document->rigs[0]->tail;
    float stretched = 0;
    for (int f = 0; f <= 120; f += 3) {
        const struct pose *pose = pose_at(f);
        stretched = fmaxf(stretched, fabsf(pose->limbs.stretch));
        for (int joint = 0; joint < tail->joints; joint += 5) {
            const struct pin pin = {.frame = f, .point = joint};
            struct pin_point point;
            const struct pin_query query = {.pin = &pin};
            assert_true(source.find(NULL, &scene.evaluation, scene.document, &query, NULL, &point));
            for (int k = 0; k < 3; k++) assert_near(point.at[k], (double)pose->matrix[joint + 1][12 + k], 1e-5);
        }
    }
    assert_true(stretched > 0.05f);
    opened_free(&scene);
}
