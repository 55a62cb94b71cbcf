/// Edits of tails and channels: what they do, that undoing gives the same text again, and what is refused.
#include "near.h"

#include "world.h"
#include <stdlib.h>
#include <string.h>

static struct edit position_edit(int coordinate, double value, int track)
{
    return (struct edit){.kind = EDIT_POSITION, .coordinate = coordinate, .param = {value, track}};
}

static void test_places(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, position_edit(0, 0.5, -1));
    assert_reversible(&world, position_edit(2, 0, LOOP));
    assert_near(document_tail(world.document, 0)->position[0].value, 0.5, 0);
    assert_int_equal(document_tail(world.document, 0)->position[2].track, LOOP);
    assert_reversible(&world, (struct edit){.kind = EDIT_LENGTH, .number = 2.5});
    assert_near(document_tail(world.document, 0)->length, 2.5, 0);
    assert_refused(&world, position_edit(0, NAN, -1), "t: the position must be finite");
    assert_refused(&world, position_edit(1, 0, 3), "t: there is no spline to follow");
    assert_refused(&world, position_edit(3, 0, -1), "there is no such coordinate");
    assert_refused(&world, (struct edit){.kind = EDIT_LENGTH}, "t: the length must be above 0");
    assert_refused(&world, (struct edit){.kind = EDIT_LENGTH, .rig = 1, .number = 1}, "there is no such tail");
    world_close(&world);
}

static void test_channels(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, (struct edit){.kind = EDIT_FEED, .channel = 1, .spline = PLUCK});
    assert_int_equal(document_tail(world.document, 0)->channels[1].spline, PLUCK);
    assert_reversible(&world, (struct edit){.kind = EDIT_PART, .channel = 1, .of = PART_DISPLACEMENT});
    assert_int_equal(document_tail(world.document, 0)->channels[1].of, PART_DISPLACEMENT);
    enum axis other = document_tail(world.document, 0)->channels[1].axis == AXIS_UP ? AXIS_SIDE : AXIS_UP;
    assert_reversible(&world, (struct edit){.kind = EDIT_AXIS, .channel = 1, .axis = other});
    assert_int_equal(document_tail(world.document, 0)->channels[1].axis, other);
    assert_refused(&world, (struct edit){.kind = EDIT_FEED, .channel = 1, .spline = 9}, "there is no such spline");
    assert_refused(&world, (struct edit){.kind = EDIT_PART, .channel = 2}, "there is no such channel");
    world_close(&world);
}

static void test_which_tails_there_are(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    char *before = world_print(&world);
    assert_reversible(&world, (struct edit){.kind = EDIT_TAIL_ADD});
    assert_int_equal(document_count_rigs(world.document, RIG_TAIL), 2);
    const struct tail *copy = document_tail(world.document, 1);
    assert_string_equal(world.document->rigs[1]->name, "tail");
    assert_int_equal(copy->channel_count, 2);
    assert_near(copy->channels[1].gain.value[2], 3, 0);
    assert_true(copy->position[0].value > document_tail(world.document, 0)->position[0].value);
    assert_reversible(&world, (struct edit){.kind = EDIT_RIG_NAME, .rig = 1, .text = "other"});
    assert_refused(&world, (struct edit){.kind = EDIT_RIG_NAME, .rig = 1, .text = "t"},
                   "there is a rig called t already");
    assert_refused(&world, (struct edit){.kind = EDIT_RIG_NAME, .rig = 1, .text = ""}, "a tail needs a name");
    struct edit lag = {.kind = EDIT_ANGLES, .rig = 1, .channel = 1, .angle = ANGLE_LAG};
    const struct angles angles = {.value = {9}};
    lag.angles = &angles;
    assert_reversible(&world, lag); // angles go by index: they find their place in a list that came back
    assert_reversible(&world, (struct edit){.kind = EDIT_RIG_REMOVE, .rig = 0});
    assert_string_equal(world.document->rigs[0]->name, "other");
    assert_reversible(&world, (struct edit){.kind = EDIT_RIG_REMOVE, .rig = 0});
    assert_reversible(&world, (struct edit){.kind = EDIT_TAIL_ADD, .rig = -1, .spline = PLUCK});
    assert_int_equal(document_tail(world.document, 0)->channels[0].spline, PLUCK);
    world_undo_all(&world);
    assert_document(&world, before);
    free(before);
    world_close(&world);
}

static void test_which_channels_there_are(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    const struct edit add = {.kind = EDIT_CHANNEL_ADD, .spline = PLUCK, .axis = AXIS_UP, .of = PART_DISPLACEMENT};
    assert_reversible(&world, add);
    const struct tail *tail = document_tail(world.document, 0);
    assert_int_equal(tail->channel_count, 3);
    assert_int_equal(tail->channels[2].spline, PLUCK);
    assert_int_equal(tail->channels[2].of, PART_DISPLACEMENT);
    assert_near(tail->channels[2].lag.value[0], CHANNEL_DEFAULT_LAG, 0);
    assert_reversible(&world, (struct edit){.kind = EDIT_CHANNEL_REMOVE, .channel = 0});
    assert_int_equal(document_tail(world.document, 0)->channel_count, 2);
    assert_int_equal(document_tail(world.document, 0)->channels[1].spline, PLUCK);
    assert_refused(&world, (struct edit){.kind = EDIT_CHANNEL_REMOVE, .channel = 2}, "there is no such channel");
    assert_refused(&world, (struct edit){.kind = EDIT_CHANNEL_ADD, .spline = -1}, "there is no such spline");
    for (int c = 2; c < SCENE_MAX_CHANNELS; c++) assert_true(world_step(&world, add));
    assert_refused(&world, add, "t: there are 64 channels, and no more fit");
    world_close(&world);
}

/// The gains of all joints together, and the lag from base to tip, stay; arrays are read at the same shares of the length.
static void test_joints_keep_the_shape(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, (struct edit){.kind = EDIT_JOINTS, .to = 5});
    const struct tail *tail = document_tail(world.document, 0);
    assert_int_equal(tail->joints, 5);
    assert_near(tail->channels[0].gain.value[0], 5 * 3.0 / 5, 1e-6);
    assert_near(tail->channels[0].lag.value[0], 6.5 * 3.0 / 5, 1e-6);
    const double gains[] = {0.6, 0.9, 1.2, 1.5, 1.8}; // 1, 1.5, 2, 2.5, 3, each three fifths
    for (int n = 0; n < 5; n++) assert_near(tail->channels[1].gain.value[n], gains[n], 1e-6);
    assert_reversible(&world, (struct edit){.kind = EDIT_JOINTS, .to = 1});
    assert_reversible(&world, (struct edit){.kind = EDIT_JOINTS, .to = TAIL_MAX_JOINTS});
    assert_refused(&world, (struct edit){.kind = EDIT_JOINTS, .to = 0}, "t: joints must be from 1 to 256");
    assert_refused(&world, (struct edit){.kind = EDIT_JOINTS, .to = 257}, "t: joints must be from 1 to 256");
    world_close(&world);
}

/// What moves the tail as a whole moves it as far, and still has one number for each joint.
static void test_joints_of_what_does_not_bend(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    world_must(&world, (struct edit){.kind = EDIT_AXIS, .channel = 1, .axis = AXIS_STRETCH});
    assert_int_equal(document_tail(world.document, 0)->channels[1].gain.form, ANGLES_EACH);
    assert_reversible(&world, (struct edit){.kind = EDIT_JOINTS, .to = 5});
    const struct channel *stretch = &document_tail(world.document, 0)->channels[1];
    assert_int_equal(stretch->gain.count, 5);
    for (int n = 0; n < 5; n++) assert_near(stretch->gain.value[n], 1 + 0.5 * n, 1e-6);
    world_close(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_channels),
        cmocka_unit_test(test_which_tails_there_are),
        cmocka_unit_test(test_which_channels_there_are),
        cmocka_unit_test(test_joints_keep_the_shape),
        cmocka_unit_test(test_joints_of_what_does_not_bend),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
