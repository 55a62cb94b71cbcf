/// Edits of tails and channels: what they do, that undoing gives the same text again, and what is refused.
#include "near.h"

#include "world.h"
#include <stdlib.h>
#include <string.h>

/// The edit must be refused with that sentence and leave the document as it was.
static void assert_refused(struct world *world, struct edit edit, const char *sentence)
{
    char *before = world_print(world);
    assert_false(world_step(world, edit));
    assert_string_equal(world->error.text, sentence);
    assert_document(world, before);
    free(before);
}

/// The edit must change the text; undoing it must give the old one, doing it again the new one.
static void assert_there_and_back(struct world *world, struct edit edit)
{
    char *before = world_print(world);
    world_must(world, edit);
    char *after = world_print(world);
    assert_string_not_equal(before, after);
    assert_true(history_undo(world->history, world->document));
    assert_document(world, before);
    assert_true(history_redo(world->history, world->document));
    assert_document(world, after);
    free(after);
    free(before);
}

static struct edit edit_position(int coordinate, double value, int track)
{
    return (struct edit){.kind = EDIT_POSITION, .coordinate = coordinate, .param = {value, track}};
}

static void test_places(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    const struct tail *tail = &world.document->tails[0];
    assert_there_and_back(&world, edit_position(0, 0.5, -1));
    assert_there_and_back(&world, edit_position(2, 0, LOOP));
    assert_near(tail->position[0].value, 0.5, 0);
    assert_int_equal(tail->position[2].track, LOOP);
    assert_there_and_back(&world, (struct edit){.kind = EDIT_LENGTH, .number = 2.5});
    assert_near(tail->length, 2.5, 0);
    assert_refused(&world, edit_position(0, NAN, -1), "t: the position must be finite");
    assert_refused(&world, edit_position(1, 0, 3), "t: there is no spline to follow");
    assert_refused(&world, edit_position(3, 0, -1), "there is no such coordinate");
    assert_refused(&world, (struct edit){.kind = EDIT_LENGTH}, "t: the length must be above 0");
    assert_refused(&world, (struct edit){.kind = EDIT_LENGTH, .tail = 1, .number = 1}, "there is no such tail");
    world_close(&world);
}

static void test_channels(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    const struct channel *channel = &world.document->tails[0].channels[1];
    assert_there_and_back(&world, (struct edit){.kind = EDIT_FEED, .channel = 1, .spline = PLUCK});
    assert_int_equal(channel->spline, PLUCK);
    assert_there_and_back(&world, (struct edit){.kind = EDIT_PART, .channel = 1, .of = PART_DISPLACEMENT});
    assert_int_equal(channel->of, PART_DISPLACEMENT);
    enum axis other = channel->axis == AXIS_UP ? AXIS_SIDE : AXIS_UP;
    assert_there_and_back(&world, (struct edit){.kind = EDIT_AXIS, .channel = 1, .axis = other});
    assert_int_equal(channel->axis, other);
    assert_refused(&world, (struct edit){.kind = EDIT_FEED, .channel = 1, .spline = 9}, "there is no such spline");
    assert_refused(&world, (struct edit){.kind = EDIT_PART, .channel = 2}, "there is no such channel");
    world_close(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_channels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
