/// Chains: bones of imported characters, whatever their rolls, bend as the tail does.
#include "posed_tail.h"
#include "rig/strand.h"

#include "model/vector.h"

enum { BONES = 8 };

static const double LENGTH = 0.8;

/// A character of one straight chain along +z from (0, 1, 0), whose bones have rolls of their own, under a root that is turned; and a second
/// child of bone 3.
static struct imported make_character(void)
{
    struct imported imported = {0};
    struct gltf *gltf = &imported.gltf;
    versors before = glms_quatv(0.4f, (vec3s){.raw = {0.3f, 1, 0.2f}});
    gltf->path = "made.glb";
    gltf->node_count = BONES + 3; // root, bones, tip, spur
    gltf->nodes = pool_take(&gltf->pool, (size_t)gltf->node_count, sizeof *gltf->nodes);
    gltf->order = pool_take(&gltf->pool, (size_t)gltf->node_count, sizeof *gltf->order);
    for (int n = 0; n < gltf->node_count; n++) {
        struct gltf_node *node = &gltf->nodes[n];
        const bool is_spur = n == BONES + 2;
        char *name = pool_take(&gltf->pool, 16, 1);
        snprintf(name, 16, n == 0 ? "root" : is_spur ? "spur" : "bone_%d", n);
        *node = (struct gltf_node){
            .name = name, .parent = is_spur ? 3 : n - 1, .mesh = -1, .skin = -1, .place.scale = {1, 1, 1}};
        versors after =
            n == 0 ? before
                   : glms_quatv(1.7f * (float)n, glms_vec3_normalize((vec3s){.raw = {1, 0.3f * (float)n, -0.7f}}));
        const vec3s step = n == 1 ? (vec3s){.raw = {0, 1, 0}} : (vec3s){.raw = {0, 0, (float)LENGTH / BONES}};
        const versors turn = n == 0 ? after : glms_quat_mul(glms_quat_inv(before), after);
        const vec3s move = n == 0 ? (vec3s){0} : glms_quat_rotatev(glms_quat_inv(before), step);
        memcpy(node->place.rotation, turn.raw, sizeof turn.raw);
        memcpy(node->place.translation, move.raw, sizeof move.raw);
        gltf->order[n] = n;
        before = after;
    }
    gltf_link_nodes(gltf);
    assert_true(imported_complete(&imported));
    return imported;
}

/// `spur` has the wrong place under bone 3, which no test looks at.
static void free_character(struct imported *imported) { imported_free(imported); }

struct points {
    float point[BONES + 1][3];
};

/// Where bone_1 … bone_8 begin, bent by the chain's channels and at rest otherwise, and the tip.
static void bend(const struct imported *imported, const struct chain *chain, const wiggly_value *values,
                 struct points *points)
{
    struct strand strand;
    struct gltf_pose pose;
    assert_true(strand_of_chain(chain, imported, &strand));
    assert_int_equal(strand.joints, BONES);
    assert_true(gltf_pose_create(&imported->gltf, &pose));
    gltf_pose_clip(&imported->gltf, -1, 0, &pose);
    strand_bend(&strand, values, LOOK_WIGGLY, &pose);
    gltf_pose_world(&imported->gltf, &pose);
    for (int n = 0; n <= BONES; n++) memcpy(points->point[n], pose.world[n + 1] + 12, sizeof points->point[n]);
    gltf_pose_free(&pose);
}

static char first[] = "bone_1", last[] = "bone_8";

static struct channel channel_of(enum axis axis, double gain)
{
    return (struct channel){.axis = axis, .lag.value = {20}, .gain.value = {gain}};
}

#define CHARACTER_TEST(name)                                                                                         \
    TEST_OF(struct imported, imported, *imported = make_character(), free_character(imported), name)

CHARACTER_TEST(test_bends_as_the_tail_does)
{
    struct channel channels[] = {channel_of(AXIS_SIDE, 9), channel_of(AXIS_UP, 6)};
    const wiggly_value values[] = {{.y = 0.2, .re = 1, .im = -0.5}, {.re = -0.7, .im = 0.9}};
    const struct chain chain = {.from = first, .to = last, .channels = channels, .channel_count = 2};
    struct tail tail = {.joints = BONES, .length = LENGTH, .channels = channels, .channel_count = 2};
    for (int k = 0; k < 3; k++) tail.position[k] = param_number(k == 1 ? 1 : 0);
    struct points points;
    struct pose expected;
    bend(imported, &chain, values, &points);
    pose_tail(&tail, values, LOOK_WIGGLY, &expected);
    assert_int_equal(expected.count, BONES + 1);
    for (int n = 0; n <= BONES; n++) {
        for (int k = 0; k < 3; k++) assert_near(points.point[n][k], expected.matrix[n][12 + k], 2e-6);
    }
    assert_true(fabsf(points.point[BONES][0]) > 0.1f);
}

CHARACTER_TEST(test_axes_turn_and_mirror)
{
    struct channel side = channel_of(AXIS_SIDE, 9);
    const wiggly_value value = {.re = 1};
    struct chain chain = {.from = first, .to = last, .channels = &side, .channel_count = 1};
    struct points plain, mirrored, turned;
    bend(imported, &chain, &value, &plain);
    chain.mirror = true;
    bend(imported, &chain, &value, &mirrored);
    chain.mirror = false;
    chain.turn = 90;
    bend(imported, &chain, &value, &turned);
    assert_near(mirrored.point[BONES][0], -plain.point[BONES][0], 2e-6);
    assert_near(plain.point[BONES][1], 1, 2e-6);
    // a quarter turn about +z takes y to -x: what went to +x now goes to +y
    assert_near(turned.point[BONES][0], 0, 2e-6);
    assert_near(turned.point[BONES][1] - 1, plain.point[BONES][0], 2e-6);
}

CHARACTER_TEST(test_twist_turns_without_moving)
{
    struct channel twist = channel_of(AXIS_TWIST, 9);
    const wiggly_value value = {.re = 1};
    const struct chain chain = {.from = first, .to = last, .channels = &twist, .channel_count = 1};
    struct points points;
    bend(imported, &chain, &value, &points);
    for (int n = 0; n <= BONES; n++) assert_near(points.point[n][0], 0, 2e-6);
}

CHARACTER_TEST(test_what_is_no_chain)
{
    const struct gltf *gltf = &imported->gltf;
    struct chain_bones bones;
    struct error error;
    assert_false(chain_find(gltf, "bone_4", "bone_2", &bones, &error));
    assert_string_equal(error.text, "made.glb: expected \"bone_2\" below \"bone_4\", got it elsewhere");
    assert_false(chain_find(gltf, "bone_4", "ear", &bones, &error));
    assert_string_equal(error.text, "made.glb: expected a bone called \"ear\", got none");
    assert_int_equal(chain_end(imported, 1, &error), -1);
    assert_string_equal(
        error.text,
        "\"bone_3\" branches into \"bone_4\" and \"spur\": choose the bone where the chain begins or ends");
    assert_int_equal(chain_end(imported, 4, &error), BONES + 1);
}
