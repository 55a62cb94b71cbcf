/// Edits of tails and channels: what they do, that undoing gives the same text again, and what is refused.

#include "world.h"

static bool set_position(struct world *world, int coordinate, double value, int track)
{
    struct rig moved = *world_edit(world)->rigs[0];
    moved.tail.position[coordinate] = (struct param){.value = value, .track = track};
    return edit_rig_set(world->document, 0, &moved, &world->error);
}

WORLD_TEST(test_places, world_open(world))
{
    assert_reversible(world, set_position(world, 0, 0.5, -1));
    assert_reversible(world, set_position(world, 2, 0, LOOP));
    assert_near(document_tail(world->document, 0)->position[0].value, 0.5, 0);
    assert_int_equal(document_tail(world->document, 0)->position[2].track, LOOP);
    struct rig longer = *world->document->rigs[0];
    longer.tail.length = 2.5;
    assert_reversible(world, edit_rig_set(world_edit(world), 0, &longer, &world->error));
    assert_near(document_tail(world->document, 0)->length, 2.5, 0);
    assert_refused(world, set_position(world, 0, NAN, -1), "t: the position must be finite");
    assert_refused(world, set_position(world, 1, 0, 3), "t: there is no spline to follow");
    longer = *world->document->rigs[0];
    longer.tail.length = 0;
    assert_refused(world, edit_rig_set(world_edit(world), 0, &longer, &world->error),
                   "t: the length must be above 0 and finite");
    assert_refused(world, edit_rig_set(world_edit(world), 1, &longer, &world->error), "there is no such tail");
}

WORLD_TEST(test_channels, world_open(world))
{
    assert_reversible(world, edit_bend(world, 0, 1, PLUCK, -1, -1));
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, PLUCK);
    assert_reversible(world, edit_bend(world, 0, 1, -1, -1, PART_DISPLACEMENT));
    assert_int_equal(document_tail(world->document, 0)->channels[1].of, PART_DISPLACEMENT);
    enum axis other = document_tail(world->document, 0)->channels[1].axis == AXIS_UP ? AXIS_SIDE : AXIS_UP;
    assert_reversible(world, edit_bend(world, 0, 1, -1, other, -1));
    assert_int_equal(document_tail(world->document, 0)->channels[1].axis, other);
    assert_refused(world, edit_bend(world, 0, 1, 9, -1, -1), "t: there is no such spline");
    assert_refused(world, edit_bend(world, 0, 2, -1, -1, PART_TOTAL), "there is no such channel");
}

WORLD_TEST(test_which_tails_there_are, world_open(world))
{
    const char *before = world_print(world);
    assert_reversible(world, edit_tail_add(world_edit(world), 0, 0, &world->error));
    assert_int_equal(document_count_rigs(world->document, RIG_TAIL), 2);
    const struct tail *copy = document_tail(world->document, 1);
    assert_string_equal(world->document->rigs[1]->name, "tail");
    assert_int_equal(copy->channel_count, 2);
    assert_near(copy->channels[1].gain.value[2], 3, 0);
    assert_true(copy->position[0].value > document_tail(world->document, 0)->position[0].value);
    assert_reversible(world, edit_rig_name(world_edit(world), 1, "other", &world->error));
    assert_refused(world, edit_rig_name(world_edit(world), 1, "t", &world->error), "there is a rig called t already");
    assert_refused(world, edit_rig_name(world_edit(world), 1, "", &world->error), "a tail needs a name");
    const struct channel_place second = {1, 1};
    const struct angles angles = {.value = {9}};
    assert_reversible(
        world, edit_angles(world_edit(world), second, ANGLE_LAG, &angles,
                           &world->error)); // angles go by index: they find their place in a list that came back
    assert_reversible(world, edit_rig_remove(world_edit(world), 0, &world->error));
    assert_string_equal(world->document->rigs[0]->name, "other");
    assert_reversible(world, edit_rig_remove(world_edit(world), 0, &world->error));
    assert_reversible(world, edit_tail_add(world_edit(world), -1, PLUCK, &world->error));
    assert_int_equal(document_tail(world->document, 0)->channels[0].spline, PLUCK);
    world_undo_all(world);
    assert_document(world, before);
}

WORLD_TEST(test_which_channels_there_are, world_open(world))
{
    assert_reversible(world,
                      edit_channel_add(world_edit(world), 0, PLUCK, AXIS_UP, PART_DISPLACEMENT, &world->error));
    const struct tail *tail = document_tail(world->document, 0);
    assert_int_equal(tail->channel_count, 3);
    assert_int_equal(tail->channels[2].spline, PLUCK);
    assert_int_equal(tail->channels[2].of, PART_DISPLACEMENT);
    assert_near(tail->channels[2].lag.value[0], CHANNEL_DEFAULT_LAG, 0);
    assert_reversible(world, edit_channel_remove(world_edit(world), (struct channel_place){0, 0}, &world->error));
    assert_int_equal(document_tail(world->document, 0)->channel_count, 2);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, PLUCK);
    assert_refused(world, edit_channel_remove(world_edit(world), (struct channel_place){0, 2}, &world->error),
                   "there is no such channel");
    assert_refused(world, edit_channel_add(world_edit(world), 0, -1, AXIS_SIDE, PART_TOTAL, &world->error),
                   "t: there is no such spline");
    for (int c = 2; c < SCENE_MAX_CHANNELS; c++)
        assert_true(world_step(
            world, edit_channel_add(world_edit(world), 0, PLUCK, AXIS_UP, PART_DISPLACEMENT, &world->error)));
    assert_refused(world, edit_channel_add(world_edit(world), 0, PLUCK, AXIS_UP, PART_DISPLACEMENT, &world->error),
                   "t: at most 64 channels fit");
}

/// The gains of all joints together, and the lag from base to tip, stay; arrays are read at the same shares of the length.
WORLD_TEST(test_joints_keep_the_shape, world_open(world))
{
    assert_reversible(world, edit_joints(world_edit(world), 0, 5, &world->error));
    const struct tail *tail = document_tail(world->document, 0);
    assert_int_equal(tail->joints, 5);
    assert_near(tail->channels[0].gain.value[0], 5 * 3.0 / 5, 1e-6);
    assert_near(tail->channels[0].lag.value[0], 6.5 * 3.0 / 5, 1e-6);
    const double gains[] = {0.6, 0.9, 1.2, 1.5, 1.8}; // 1, 1.5, 2, 2.5, 3, each three fifths
    for (int n = 0; n < 5; n++) assert_near(tail->channels[1].gain.value[n], gains[n], 1e-6);
    assert_reversible(world, edit_joints(world_edit(world), 0, 1, &world->error));
    assert_reversible(world, edit_joints(world_edit(world), 0, TAIL_MAX_JOINTS, &world->error));
    assert_refused(world, edit_joints(world_edit(world), 0, 0, &world->error), "t: joints must be from 1 to 256");
    assert_refused(world, edit_joints(world_edit(world), 0, 257, &world->error), "t: joints must be from 1 to 256");
}

/// What moves the tail as a whole moves it as far, and still has one number for each joint.
WORLD_TEST(test_joints_of_what_does_not_bend, world_open(world))
{
    world_must(world, edit_bend(world, 0, 1, -1, AXIS_STRETCH, -1));
    assert_int_equal(document_tail(world->document, 0)->channels[1].gain.form, ANGLES_EACH);
    assert_reversible(world, edit_joints(world_edit(world), 0, 5, &world->error));
    const struct channel *stretch = &document_tail(world->document, 0)->channels[1];
    assert_int_equal(stretch->gain.count, 5);
    for (int n = 0; n < 5; n++) assert_near(stretch->gain.value[n], 1 + 0.5 * n, 1e-6);
}
