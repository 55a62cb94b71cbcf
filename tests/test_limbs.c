/// The fox lives: splines breathe, blink, turn its head, flick its ears and squash it, and its skin follows.
#include "model/creature.h"
#include "model/limbs.h"
#include "model/tail_skin.h"
#include "model/vector.h"
#include "near.h"
#include "rig/opened.h"
#include "rig/pinning.h"
#include "scene/edit.h"
#include "scene/history.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct opened scene;

static void open_scene(const char *path)
{
    struct error error = {0};
    if (!opened_read(&scene, path, &error)) fail_msg("%s", error.text);
    opened_solve(&scene, SOLVER_BY_LENGTH);
}

static const struct pose *pose_at(double frame)
{
    static struct rig_pose pose;
    const struct posing posing = {.document = scene.document, .evaluation = &scene.evaluation};
    assert_true(rig_pose(&posing, 0, frame * scene.document->substeps, NULL, &pose));
    return &pose.tail;
}

static void the_start_scene_breathes_and_blinks(void **state)
{
    (void)state;
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
static void the_head_looks_where_the_tail_goes(void **state)
{
    (void)state;
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

/// Lowest point of the skin.
static float lowest(const struct pose *pose, const struct mesh *mesh, float (*place)[3])
{
    float low = INFINITY;
    tail_skin(pose, mesh, place, NULL);
    for (int v = 0; v < mesh->vertex_count; v++) low = fminf(low, place[v][1]);
    return low;
}

/// It crouches before it leaves the ground, stretches as it rises, gives way as it lands, and its feet never sink in.
static void a_hop_is_anticipated_and_squashes(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    open_scene("assets/scenes/follow.json");
    mesh_creature(2, &mesh);
    float(*place)[3] = calloc((size_t)mesh.vertex_count, sizeof *place);
    assert_non_null(place);
    assert_true(pose_at(5)->limbs.stretch < -0.1f);
    assert_true(pose_at(10)->limbs.stretch > 0.1f);
    assert_true(pose_at(19)->limbs.stretch < -0.1f);
    assert_true(fabsf(pose_at(42)->limbs.stretch) < 0.02f);
    for (int f = 0; f <= 96; f++) assert_true(lowest(pose_at(f), &mesh, place) > -0.03f);
    assert_true(lowest(pose_at(5), &mesh, place) < 0.02f);
    assert_true(lowest(pose_at(12), &mesh, place) > 0.1f);
    free(place);
    mesh_free(&mesh);
    opened_free(&scene);
}

/// However far the parts move, the skin stays in the pose's bounds, which cameras and redraws go by.
static void bounds_hold_the_skin(void **state)
{
    (void)state;
    static const struct limbs wild[] = {
        {.look = 1.2f, .nod = 0.6f, .ears = {1, 1}},
        {.look = -1.2f, .nod = -0.6f, .ears = {-0.5f, -0.5f}},
        {.breath = 0.25f, .stretch = 0.4f},
        {.breath = 0.25f, .stretch = -0.4f, .nod = 0.6f},
    };
    struct mesh mesh = {0};
    open_scene("assets/scenes/tail.json");
    mesh_creature(1, &mesh);
    float(*place)[3] = calloc((size_t)mesh.vertex_count, sizeof *place);
    assert_non_null(place);
    for (size_t w = 0; w < sizeof wild / sizeof *wild; w++) {
        struct pose pose = *pose_at(0);
        float lo[3], hi[3];
        pose.limbs = wild[w];
        pose_bounds(&pose, lo, hi);
        tail_skin(&pose, &mesh, place, NULL);
        for (int v = 0; v < mesh.vertex_count; v++) {
            if (mesh.vertices[v].bend > 0) continue;
            for (int k = 0; k < 3; k++) assert_true(place[v][k] > lo[k] - 0.005f && place[v][k] < hi[k] + 0.005f);
        }
    }
    free(place);
    mesh_free(&mesh);
    opened_free(&scene);
}

/// An ear bends as a chain: its tip by more than its root. What is no ear stays with the head.
static void ears_bend_as_chains(void **state)
{
    (void)state;
    const struct limbs back = {.ears = {0.3f, 0.5f}};
    float matrix[LIMBS][16];
    limbs_matrices(&back, 1.0f, matrix);
    const float upright[2] = {matrix[LIMB_EAR][5], matrix[LIMB_EAR_TIP][5]};
    assert_near(matrix[LIMB_HEAD][5], 1.0, 1e-6);
    assert_true(upright[0] < 0.99f && upright[1] < upright[0] - 0.1f);
}

/// What moves the body bends no joint: a wild spline on the lids leaves the tail as it is.
static void the_body_leaves_the_tail_alone(void **state)
{
    (void)state;
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
    history_begin(history, "Axis", 0);
    const bool possible = edit_axis(scene.document, (struct channel_place){rig, channel}, axis, NULL);
    history_end(history);
    return possible;
}

/// A channel can be given to a part of the body and back; bending chains have none, and more joints leave it as it is.
static void axes_are_edited_and_undone(void **state)
{
    (void)state;
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

/// A vertex as the stage draws it.
static vec3s moved(const struct vertex *vertex, float matrix[LIMBS][16])
{
    const vec3s p = vec3_from(vertex->position);
    const vec3s a = glms_mat4_mulv3(mat4_from(matrix[(int)vertex->limb[0]]), p, 1.0f);
    const vec3s b = glms_mat4_mulv3(mat4_from(matrix[(int)vertex->limb[1]]), p, 1.0f);
    return glms_vec3_lerp(a, b, vertex->limb[2]);
}

static bool is_ear(const struct vertex *vertex) { return (int)vertex->limb[1] >= LIMB_EAR; }

/// The distance by which the pointer's ray is marched. Between body and head the skin is bent, there it need only be near.
static void the_moved_skin_is_where_it_is_picked(void **state)
{
    static const struct limbs poses[] = {
        {0}, {.look = 0.8f}, {.nod = 0.4f}, {.stretch = 0.2f}, {.look = -0.6f, .nod = -0.3f, .stretch = -0.15f}};
    struct mesh mesh = {0};
    (void)state;
    mesh_torso(0.05f, 0.01f, 0, &mesh);
    assert_true(mesh.vertex_count > 100);
    for (size_t n = 0; n < sizeof poses / sizeof *poses; n++) {
        const struct limbs_back back = limbs_back(&poses[n]);
        float matrix[LIMBS][16];
        int head = 0, off = 0, count = 0;
        limbs_matrices(&poses[n], 1.0f, matrix);
        for (int v = 0; v < mesh.vertex_count; v++) {
            const struct vertex *vertex = &mesh.vertices[v];
            const float alone = fabsf(creature_torso_distance(vertex->position));
            if (is_ear(vertex)) continue;
            const vec3s at = moved(vertex, matrix);
            const float distance = fabsf(limbs_distance(&back, at.raw));
            const bool is_bent = vertex->limb[2] > 0 && vertex->limb[2] < 1;
            count++;
            head += !is_bent && (int)vertex->limb[1] == LIMB_HEAD;
            off += !is_bent && distance > alone + 1e-4f;
            if (is_bent) assert_true(distance < 0.12f);
        }
        assert_true(head > 20);
        if (off > 0) fail_msg("pose %zu: %d of %d vertices are off the skin", n, off, count);
    }
    mesh_free(&mesh);
}

/// The points of pins are those of the picture, however the body moves.
static void pins_hold_what_is_drawn(void **state)
{
    (void)state;
    open_scene("assets/scenes/follow.json");
    const struct pin_source source = pin_points(NULL);
    const struct tail *tail = &scene.document->rigs[0]->tail;
    float stretched = 0;
    for (int f = 0; f <= 120; f += 3) {
        const struct pose *pose = pose_at(f);
        stretched = fmaxf(stretched, fabsf(pose->limbs.stretch));
        for (int joint = 0; joint < tail->joints; joint += 5) {
            const struct pin pin = {.frame = f, .point = joint};
            struct pin_point point;
            assert_true(source.find(NULL, &scene.evaluation, scene.document, 0, &pin, NULL, 0, NULL, &point));
            for (int k = 0; k < 3; k++) assert_near(point.at[k], (double)pose->matrix[joint + 1][12 + k], 1e-5);
        }
    }
    assert_true(stretched > 0.05f);
    opened_free(&scene);
}

/// The ears, laid back as far as they go and forward: each vertex of them is near the skin that the pointer's ray meets, and where they were at
/// rest there is nothing.
static void a_laid_ear_is_picked_where_it_is_drawn(void **state)
{
    static const struct limbs poses[] = {{.ears = {1.05f, 1.05f}},
                                         {.ears = {-0.5f, -0.5f}, .look = 0.7f, .nod = 0.3f}};
    struct mesh mesh = {0};
    (void)state;
    mesh_torso(0.05f, 0.01f, 0, &mesh);
    for (size_t n = 0; n < sizeof poses / sizeof *poses; n++) {
        const struct limbs_back back = limbs_back(&poses[n]);
        struct limbs rest = poses[n];
        float matrix[LIMBS][16], at_rest[LIMBS][16];
        int gone = 0;
        memset(rest.ears, 0, sizeof rest.ears);
        limbs_matrices(&poses[n], 1.0f, matrix);
        limbs_matrices(&rest, 1.0f, at_rest);
        for (int v = 0; v < mesh.vertex_count; v++) {
            const struct vertex *vertex = &mesh.vertices[v];
            if (!is_ear(vertex)) continue;
            const vec3s at = moved(vertex, matrix), was = moved(vertex, at_rest);
            const bool is_bent = vertex->limb[2] < 1;
            const float alone = fabsf(creature_torso_distance(vertex->position));
            assert_true(fabsf(limbs_distance(&back, at.raw)) < (is_bent ? 0.05f : alone + 1e-4f));
            if (is_bent || glms_vec3_distance(at, was) < 0.1f) continue;
            gone++;
            assert_true(limbs_distance(&back, was.raw) > 0.02f);
        }
        assert_true(gone >= 2);
    }
    mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_start_scene_breathes_and_blinks),
        cmocka_unit_test(the_head_looks_where_the_tail_goes),
        cmocka_unit_test(a_hop_is_anticipated_and_squashes),
        cmocka_unit_test(bounds_hold_the_skin),
        cmocka_unit_test(ears_bend_as_chains),
        cmocka_unit_test(the_body_leaves_the_tail_alone),
        cmocka_unit_test(axes_are_edited_and_undone),
        cmocka_unit_test(the_moved_skin_is_where_it_is_picked),
        cmocka_unit_test(a_laid_ear_is_picked_where_it_is_drawn),
        cmocka_unit_test(pins_hold_what_is_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
