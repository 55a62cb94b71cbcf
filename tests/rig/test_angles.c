/// Angles along a tail: looked up, read, printed, edited, and resampled for another number of joints.
#include "posed_tail.h"
#include "world.h"

enum { JOINTS = 5 };

static const struct angles ramp = {.form = ANGLES_RAMP, .count = 3, .ramp = {{0.25, 10}, {0.5, 40}, {1, 120}}};

TEST(a_ramp_is_straight_between_its_points)
{
    static const double expected[JOINTS] = {10, 10, 40, 80, 120};
    for (int n = 0; n < JOINTS; n++) assert_near(angles_at(&ramp, n, JOINTS), expected[n], 1e-12);
    assert_near(angles_at(&ramp, 3, 9), 25, 1e-12);
    assert_near(angles_at(&ramp, 0, 1), 10, 0);
}

TEST(only_a_lag_of_one_number_grows_by_itself)
{
    const struct angles one = {.value = {6}}, each = {.form = ANGLES_EACH, .count = 3, .value = {1, 5, 2}};
    assert_near(angles_at(&one, 4, JOINTS), 6, 0);
    assert_near(angles_lag(&one, 4, JOINTS), 24, 0);
    assert_near(angles_lag(&each, 1, JOINTS), 5, 0);
    assert_near(angles_lag(&each, 4, JOINTS), 2, 0);
    assert_near(angles_lag(&ramp, 2, JOINTS), 40, 1e-12);
}

static const char text[] =
    "{\"frames\": [0, 9], \"splines\": [{\"name\": \"s\"}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\","
    " \"joints\": 5, \"rest\": {\"ramp\": [[0, 1], [1, 2]], \"mood\": 1}, \"spline\": \"s\","
    " \"lag\": {\"ramp\": [[0.25, 10], [0.5, 40], [1, 120]], \"ease\": \"in\"}}]}";

TEST(ramps_are_printed_as_they_were_read)
{
    struct document *document = document_of_text(text);
    assert_memory_equal(&document->rigs[0]->tail.channels[0].lag.ramp, &ramp.ramp, 3 * sizeof *ramp.ramp);
    char *first = text_of_document(document);
    assert_non_null(strstr(first, "\"rest\": { \"ramp\": [[0, 1], [1, 2]], \"mood\": 1 }"));
    assert_non_null(
        strstr(first, "\"lag\": { \"ramp\": [[0.25, 10], [0.5, 40], [1, 120]], \"ease\": \"in\" }, \"gain\": 5 }"));
    assert_loads_again(document);
    free(first);
    document_destroy(document);
}

/// A ramp poses a tail exactly as the numbers that it stands for.
TEST(a_ramp_poses_like_its_numbers)
{
    static struct pose posed[2];
    struct document *document = document_of_text(text);
    struct tail *tail = &document->rigs[0]->tail;
    const wiggly_value value = {.y = 0.1, .re = 0.7, .im = -0.4};
    pose_tail(tail, &value, LOOK_WIGGLY, &posed[0]);
    struct angles *const all[] = {&tail->rest, &tail->channels[0].lag, &tail->channels[0].gain};
    for (int a = 0; a < 3; a++) {
        struct angles each = {.form = ANGLES_EACH, .count = tail->joints};
        for (int n = 0; n < tail->joints; n++) each.value[n] = angles_at(all[a], n, tail->joints);
        *all[a] = each;
    }
    pose_tail(tail, &value, LOOK_WIGGLY, &posed[1]);
    assert_memory_equal(posed[0].matrix, posed[1].matrix, (size_t)posed[0].count * sizeof *posed[0].matrix);
    document_destroy(document);
}

static const struct channel_place second = {0, 1};

static bool edit_lag(struct world *world, const struct angles *angles)
{
    return edit_angles(world_edit(world), second, ANGLE_LAG, angles, &world->error);
}

WORLD_TEST(forms_are_edited_and_undone, world_open(world))
{
    const struct angles one = {.value = {3}}, each = {.form = ANGLES_EACH, .count = 3, .value = {1, 2, 9}};
    struct angles longer = ramp;
    longer.ramp[longer.count++] = (struct ramp_point){1, 7};
    longer.ramp[2].at = 0.75;
    const struct angles *const turns[] = {&ramp, &longer, &each, &ramp, &one, &each};
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) assert_reversible(world, edit_lag(world, turns[i]));
    struct angles wrong = ramp;
    wrong.ramp[0].at = 0; // the first place has none before it
    assert_reversible(world, edit_lag(world, &wrong));
    wrong = ramp;
    wrong.ramp[1].at = 0.25;
    assert_refused(world, edit_lag(world, &wrong), "t: the places of a ramp must ascend");
    wrong.ramp[1].at = 2;
    assert_refused(world, edit_lag(world, &wrong), "t: the places of a ramp are from 0 to 1");
    wrong.count = 1;
    assert_refused(world, edit_lag(world, &wrong), "t: a ramp has from 2 to 32 points");
    wrong = each;
    wrong.count = 2;
    assert_refused(world, edit_lag(world, &wrong), "t: there must be one angle for each of the 3 joints");
    world_undo_all(world);
}

/// With twice the joints each bends half as much; where along the tail is where it was.
WORLD_TEST(a_ramp_stays_as_joints_are_added, world_open(world))
{
    world_must(world, edit_lag(world, &ramp));
    world_must(world, edit_angles(world_edit(world), second, ANGLE_GAIN, &ramp, &world->error));
    assert_reversible(world, edit_joints(world_edit(world), 0, 6, &world->error));
    const struct channel *channel = &document_tail(world->document, 0)->channels[1];
    assert_int_equal(channel->gain.form, ANGLES_RAMP);
    for (int i = 0; i < ramp.count; i++) {
        assert_near(channel->gain.ramp[i].at, ramp.ramp[i].at, 0);
        assert_near(channel->gain.ramp[i].angle, ramp.ramp[i].angle / 2, 1e-6);
        assert_near(channel->lag.ramp[i].angle, ramp.ramp[i].angle, 0);
    }
}
