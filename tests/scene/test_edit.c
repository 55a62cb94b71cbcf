/// Edits: what they do, and what is refused. That any of them in any order gives a document that loads, and comes back, has test_history.c.

#include "scene/pins.h"
#include "world.h"

/// A knot may pass others: it is found by its id, and knots stay by sample; its unknown keys go with it.
WORLD_TEST(test_knots, world_open(world))
{
    unsigned id = world->document->splines[SWAY]->knots[0].id;
    world_must(world, edit_move(world, SWAY, 0, 20.5, 7));
    assert_int_equal(world->document->splines[SWAY]->knots[1].id, id);
    assert_near(world->document->splines[SWAY]->knots[1].frame, 20.5, 0);
    assert_non_null(world->document->splines[SWAY]->knots[1].extra);
    world_must(world, edit_insert(world, SWAY, 4, 0));
    assert_int_equal(world->document->splines[SWAY]->knot_count, 4);
    assert_int_equal(spline_find_knot(world->document, world->document->splines[SWAY], 4), 0);
    world_must(world, EDIT(edit_knot_remove, SWAY, id));
    assert_int_equal(spline_find_id(world->document->splines[SWAY], id), -1);
    assert_true(history_undo(world->history));
    assert_int_equal(spline_find_id(world->document->splines[SWAY], id), 2);
    assert_non_null(world->document->splines[SWAY]->knots[2].extra);
}

/// A file has no −0, so neither has the document: as it is saved it is loaded.
WORLD_TEST(test_negative_zeros, world_open(world))
{
    struct knot minus = world->document->splines[SWAY]->knots[0];
    minus.frame = minus.value = minus.slope = -0.0;
    minus.has_slope = true;
    world_must(world, EDIT(edit_knot_set, SWAY, &minus));
    const struct knot *knot = &world->document->splines[SWAY]->knots[0];
    assert_true(knot->has_slope);
    assert_false(signbit(knot->frame) || signbit(knot->value) || signbit(knot->slope));
}

WORLD_TEST(test_refused_knots, world_open(world))
{
    assert_refused(world, edit_insert(world, SWAY, 12.4, 0), "sway: there is already a knot at frame 12.4");
    assert_refused(world, edit_move(world, SWAY, 0, 30, 0), "sway: there is already a knot at frame 30");
    assert_refused(world, edit_insert(world, SWAY, 48.5, 0), "sway: frame 48.5 is outside 0 to 48");
    assert_refused(world, edit_insert(world, SWAY, -0.6, 0), "sway: frame -0.6 is outside 0 to 48");
    assert_refused(world, edit_insert(world, LOOP, 48, 0),
                   "loop: frame 48 is outside 0 to 48; the last frame of a loop repeats the first");
    assert_refused(world, edit_insert(world, SWAY, 5, NAN), "sway: a knot: the value must be finite");
    assert_refused(world, edit_insert(world, SWAY, INFINITY, 0), "sway: a knot: the frame must be finite");
    struct knot soft = world->document->splines[SWAY]->knots[1];
    soft.value = soft.stiffness = 0;
    assert_refused(world, EDIT(edit_knot_set, SWAY, &soft), "sway: a knot: the stiffness must be above 0 and finite");
    assert_refused(world, EDIT(edit_knot_remove, SWAY, 99), "sway: this knot no longer exists");
    assert_refused(world, edit_insert(world, 3, 5, 0), "there is no such spline");
    assert_refused(world, edit_insert(world, -1, 5, 0), "there is no such spline");
}

WORLD_TEST(test_refused_parameters, world_open(world))
{
    assert_refused(world, edit_number(world, SWAY, PARAMETER_FREQUENCY, -1), "sway: frequency must be at least 0");
    assert_refused(world, edit_number(world, SWAY, PARAMETER_DAMPING, 1.5), "sway: damping must be at most 1");
    assert_refused(world, edit_number(world, SWAY, PARAMETER_EQUILIBRIUM, NAN), "sway: equilibrium must be finite");
    assert_refused(world, edit_track(world, SWAY, PARAMETER_CALM, LOOP), "sway: calm must be a number");
    assert_refused(world, edit_track(world, SWAY, PARAMETER_DAMPING, 3), "sway: there is no spline to follow");
    assert_refused(world, edit_track(world, SWAY, PARAMETER_DAMPING, SWAY),
                   "sway cannot follow sway, which already follows it");
    assert_refused(world, edit_track(world, SWAY, PARAMETER_DAMPING, LOOP),
                   "sway cannot follow loop, which already follows it");
    world_must(world, edit_track(world, PLUCK, PARAMETER_FREQUENCY, LOOP));
    assert_refused(world, edit_track(world, SWAY, PARAMETER_BANDWIDTH, PLUCK),
                   "sway cannot follow pluck, which already follows it");
}

/// What is out of the new mode's range is clamped, so that what is saved loads.
WORLD_TEST(test_modes_clamp, world_open(world))
{
    world_must(world, edit_number(world, PLUCK, PARAMETER_DAMPING, 2.4));
    const char *before = world_print(world);
    world_must(world, edit_mode(world, PLUCK, WIGGLY_COMPLEX));
    assert_near(world->document->splines[PLUCK]->parameter[PARAMETER_DAMPING].value, 1, 0);
    assert_true(history_undo(world->history));
    assert_document(world, before);
}

/// The paper's pair in a file (eq. 12) is read as what it is: ω = √k, ζ = γ/2√k.
WORLD_TEST(test_a_spring_is_saved_as_frequency_and_damping, world_open(world))
{
    assert_near(world->document->splines[PLUCK]->parameter[PARAMETER_FREQUENCY].value, sqrt(40) / (8 * atan(1)),
                1e-15);
    assert_near(world->document->splines[PLUCK]->parameter[PARAMETER_DAMPING].value, 0.5 / sqrt(40), 1e-15);
    const char *text = world_print(world);
    assert_non_null(strstr(text, "\"pluck\""));
    assert_null(strstr(text, "\"spring\""));
    assert_null(strstr(text, "\"friction\""));
}

WORLD_TEST(test_range_and_loops, world_open(world))
{
    assert_refused(world, edit_frames(world, 1, 48), "sway: the knot at frame 0 would fall outside the range");
    assert_refused(world, edit_frames(world, 0, 29), "sway: the knot at frame 30 would fall outside the range");
    assert_refused(world, edit_frames(world, 5, 4), "the last frame must not be before the first");
    assert_refused(world, edit_frames(world, 0, 1000000000), "at most 100000 samples a spline, got 1000000001");
    assert_refused(world, edit_frames(world, INT32_MIN, INT32_MAX), "frames must be from -1000000000 to 1000000000");
    world_must(world, edit_frames(world, -10, 30));
    assert_int_equal(document_samples(world->document), 41);
    assert_refused(world, edit_start(world, SWAY, WIGGLY_LOOP),
                   "sway: delete the knot at the last frame first; in a loop that frame repeats the first");
    world_must(world, edit_start(world, LOOP, WIGGLY_FREE));
    world_must(world, edit_frames(world, -10, 48));
    world_must(world, edit_start(world, SWAY, WIGGLY_LOOP));
    assert_refused(world, edit_frames(world, -10, 30), "sway: the knot at frame 30 would fall outside the range");
}

WORLD_TEST(test_angles, world_open(world))
{
    struct angles all = {.value = {4}}, each = {.form = ANGLES_EACH, .count = 3, .value = {1, 2, 9}},
                  wrong = {.value = {NAN}};
    const struct channel_place at = {0, 1}, no_channel = {0, 2}, no_rig = {1, 2};
    assert_reversible(world, EDIT(edit_angles, at, ANGLE_GAIN, &all));
    assert_int_equal(document_tail(world->document, 0)->channels[1].gain.form, ANGLES_ONE);
    assert_near(document_tail(world->document, 0)->channels[1].gain.value[0], 4, 0);
    assert_reversible(world, EDIT(edit_angles, at, ANGLE_LAG, &each));
    assert_near(document_tail(world->document, 0)->channels[1].lag.value[2], 9, 0);
    assert_reversible(world, EDIT(edit_angles, (struct channel_place){0, -1}, ANGLE_REST, &each));
    assert_int_equal(document_tail(world->document, 0)->rest.form, ANGLES_EACH);
    world_must(world, edit_bend(world, 0, 0, -1, AXIS_UP, -1));
    assert_refused(world, EDIT(edit_angles, at, ANGLE_LAG, &wrong), "t: angles must be finite");
    assert_refused(world, EDIT(edit_angles, no_channel, ANGLE_LAG, &wrong), "there is no such channel");
    assert_refused(world, EDIT(edit_angles, no_rig, ANGLE_LAG, &wrong), "there is no such rig");
}

// --- splines and timing: what refers to a spline goes with it

WORLD_TEST(test_a_new_spline, world_open(world))
{
    const struct knot first = {.frame = 7, .value = 0.5};
    assert_reversible(world, EDIT(edit_spline_add, 1, NULL, &first));
    const struct spline *added = world->document->splines[1];
    assert_string_equal(added->name, "spline");
    assert_near(added->parameter[PARAMETER_FREQUENCY].value, 1, 0);
    assert_near(added->parameter[PARAMETER_DAMPING].value, 0.1, 0);
    assert_near(added->parameter[PARAMETER_BANDWIDTH].value, 0.1, 0);
    assert_int_equal(spline_start(added), WIGGLY_LOOP); // as one of the others does
    assert_int_equal(added->knot_count, 1);
    assert_near(added->knots[0].frame, 7, 0);
    assert_int_equal(world->document->splines[3]->parameter[PARAMETER_EQUILIBRIUM].track, 0);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline,
                     3); // "loop" has moved on, and its channel with it
    world_must(world, EDIT(edit_spline_add, -1, NULL, &first));
    assert_string_equal(world->document->splines[4]->name, "spline 2");
    unsigned id = world->document->splines[4]->id, knot = world->document->splines[4]->knots[0].id;
    assert_true(history_undo(world->history) && history_redo(world->history));
    assert_int_equal(document_find_spline_id(world->document, id), 4);
    assert_int_equal(world->document->splines[4]->knots[0].id, knot);
    assert_refused(world, EDIT(edit_spline_add, -1, "sway", &first), "a spline called sway already exists");
    const struct knot outside = {.frame = 49};
    assert_refused(world, EDIT(edit_spline_add, -1, NULL, &outside), "frame 49 is outside 0 to 48");
    const struct knot last = {.frame = 48, .value = 0.5}; // of a loop, whose first frame it repeats
    world_must(world, EDIT(edit_spline_add, -1, NULL, &last));
    assert_near(world->document->splines[5]->knots[0].frame, 0, 0);
}

WORLD_TEST(test_a_copy, world_open(world))
{
    assert_reversible(world, EDIT(edit_spline_copy, LOOP));
    const struct spline *copy = world->document->splines[LOOP + 1], *loop = world->document->splines[LOOP];
    assert_string_equal(copy->name, "loop 2");
    assert_int_equal(copy->parameter[PARAMETER_EQUILIBRIUM].track, SWAY);
    assert_int_equal(spline_start(copy), WIGGLY_LOOP);
    assert_true(copy->id != loop->id && copy->knots[0].id != loop->knots[0].id);
    world_must(world, EDIT(edit_spline_copy, LOOP + 1));
    assert_string_equal(world->document->splines[LOOP + 2]->name, "loop 3");
    world_must(world, edit_insert(world, LOOP + 1, 9, 9)); // a copy's knots are its own
    assert_int_equal(world->document->splines[LOOP]->knot_count, 1);
}

WORLD_TEST(test_removal_needs_no_followers, world_open(world))
{
    assert_refused(world, EDIT(edit_spline_remove, SWAY), "sway: still used in 2 places; remove those first");
    assert_refused(world, EDIT(edit_spline_remove, LOOP), "loop: still used in 1 place; remove those first");
    unsigned id = world->document->splines[PLUCK]->id;
    assert_reversible(world, EDIT(edit_spline_remove, PLUCK));
    assert_int_equal(document_find_spline_id(world->document, id), -1);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, 1);
    assert_int_equal(world->document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].track, 0);
    assert_true(history_undo(world->history));
    assert_int_equal(document_find_spline_id(world->document, id), PLUCK);
}

WORLD_TEST(test_order, world_open(world))
{
    assert_reversible(world, EDIT(edit_spline_move, SWAY, 2));
    assert_string_equal(world->document->splines[2]->name, "sway");
    assert_string_equal(world->document->splines[1]->name, "loop");
    assert_int_equal(world->document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].track, 2);
    assert_int_equal(document_tail(world->document, 0)->channels[0].spline, 2);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, 1);
    assert_reversible(world, EDIT(edit_spline_move, 2, 0));
    assert_string_equal(world->document->splines[0]->name, "sway");
    assert_refused(world, EDIT(edit_spline_move, 0, 3), "there is no such place in the list");
}

WORLD_TEST(test_names_and_colours, world_open(world))
{
    assert_reversible(world, EDIT(edit_spline_name, SWAY, "Schwung · 1"));
    assert_refused(world, EDIT(edit_spline_name, SWAY, ""), "a spline needs a name");
    assert_refused(world, EDIT(edit_spline_name, SWAY, "loop"), "a spline called loop already exists");
    world_must(world, EDIT(edit_spline_name, LOOP, "loop")); // its own
    assert_reversible(world, EDIT(edit_spline_color, PLUCK, 0x4FA3E3));
    const char *text = world_print(world);
    assert_non_null(strstr(text, "\"color\": \"#4FA3E3\""));
    struct document *again = document_of_text(text);
    assert_int_equal(again->splines[PLUCK]->color, 0x4FA3E3);
    assert_int_equal(again->splines[SWAY]->color, -1);
    document_destroy(again);
    world_must(world, EDIT(edit_spline_color, PLUCK, -1));
    text = world_print(world);
    assert_null(strstr(text, "color"));
    assert_refused(world, EDIT(edit_spline_color, PLUCK, 0x1000000), "there is no such colour");
}

/// 24 to 30 frames a second: kept seconds put the knot of frame 12 on 15, and a slope per second stays what it is.
WORLD_TEST(test_frames_per_second, world_open(world))
{
    assert_reversible(world, EDIT(edit_fps, 30, false));
    assert_near(world->document->splines[SWAY]->knots[1].frame, 12, 0);
    assert_true(history_undo(world->history));
    assert_reversible(world, EDIT(edit_fps, 30, true));
    assert_near(world->document->splines[SWAY]->knots[1].frame, 15, 0);
    assert_near(world->document->splines[SWAY]->knots[2].frame, 37.5, 0);
    assert_near(world->document->splines[SWAY]->knots[1].slope, 0, 0);
    assert_int_equal(world->document->last_frame, 60);
    assert_refused(world, EDIT(edit_fps, 0, false), "frames per second must be above 0 and at most 100000");
    assert_refused(world, EDIT(edit_fps, NAN, true), "frames per second must be above 0 and at most 100000");
    world_must(world, edit_insert(world, SWAY, 16, 0));
    assert_refused(world, EDIT(edit_fps, 10, true), "sway: two knots would land on frame 5.333333333");
}

WORLD_TEST(test_substeps, world_open(world))
{
    assert_reversible(world, EDIT(edit_substeps, 4));
    world_must(world, edit_insert(world, SWAY, 12.25, 0));
    assert_refused(world, EDIT(edit_substeps, 1), "sway: two knots would land on frame 12.25");
}

WORLD_TEST(test_a_range_that_knots_do_not_fit, world_open(world))
{
    world_must(world, edit_insert(world, SWAY, 28, 4));
    assert_refused(world, EDIT(edit_range, 2, 28, RANGE_REFUSE),
                   "sway: the knot at frame 0 would fall outside the range");
    assert_reversible(world, EDIT(edit_range, 2, 28, RANGE_TRIM));
    assert_int_equal(world->document->splines[SWAY]->knot_count, 2);
    assert_near(world->document->splines[SWAY]->knots[0].frame, 12, 0);
    assert_true(history_undo(world->history));
    assert_int_equal(world->document->splines[SWAY]->knot_count, 4);
    assert_reversible(world, EDIT(edit_range, 2, 28, RANGE_MOVE));
    const double moved[] = {2, 12, 27, 28}; // the knot at 28 makes room for the one from 30
    for (int k = 0; k < 4; k++) assert_near(world->document->splines[SWAY]->knots[k].frame, moved[k], 0);
    assert_refused(world, EDIT(edit_range, 2, 4, RANGE_MOVE), "sway: 4 knots do not fit into 3 frames");
    assert_refused(world, EDIT(edit_range, 2, 2, RANGE_TRIM), "loop: a loop needs more than one frame");
}

/// A drag takes its step back at every movement: what it adds then has the same ids again.
WORLD_TEST(test_ids_of_a_restarted_step, world_open(world))
{
    history_begin(world->history, "Copy", 0);
    assert_true(EDIT(edit_spline_copy, SWAY));
    unsigned id = world->document->splines[1]->id, knot = world->document->splines[1]->knots[0].id;
    history_restart(world->history);
    assert_int_equal(world->document->spline_count, 3);
    assert_true(EDIT(edit_spline_copy, SWAY));
    assert_int_equal(world->document->splines[1]->id, id);
    assert_int_equal(world->document->splines[1]->knots[0].id, knot);
    history_end(world->history);
}

// --- tails and channels

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
    assert_reversible(world, EDIT(edit_rig_set, 0, &longer));
    assert_near(document_tail(world->document, 0)->length, 2.5, 0);
    assert_refused(world, set_position(world, 0, NAN, -1), "t: the position must be finite");
    assert_refused(world, set_position(world, 1, 0, 3), "t: there is no spline to follow");
    longer = *world->document->rigs[0];
    longer.tail.length = 0;
    assert_refused(world, EDIT(edit_rig_set, 0, &longer), "t: the length must be above 0 and finite");
    assert_refused(world, EDIT(edit_rig_set, 1, &longer), "there is no such tail");
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
    assert_reversible(world, EDIT(edit_tail_add, 0, 0));
    assert_int_equal(document_count_rigs(world->document, RIG_TAIL), 2);
    const struct tail *copy = document_tail(world->document, 1);
    assert_string_equal(world->document->rigs[1]->name, "tail");
    assert_int_equal(copy->channel_count, 2);
    assert_near(copy->channels[1].gain.value[2], 3, 0);
    assert_true(copy->position[0].value > document_tail(world->document, 0)->position[0].value);
    assert_reversible(world, EDIT(edit_rig_name, 1, "other"));
    assert_refused(world, EDIT(edit_rig_name, 1, "t"), "there is a rig called t already");
    assert_refused(world, EDIT(edit_rig_name, 1, ""), "a tail needs a name");
    const struct channel_place second = {1, 1};
    const struct angles angles = {.value = {9}};
    assert_reversible(world, EDIT(edit_angles, second, ANGLE_LAG,
                                  &angles)); // angles go by index: they find their place in a list that came back
    assert_reversible(world, EDIT(edit_rig_remove, 0));
    assert_string_equal(world->document->rigs[0]->name, "other");
    assert_reversible(world, EDIT(edit_rig_remove, 0));
    assert_reversible(world, EDIT(edit_tail_add, -1, PLUCK));
    assert_int_equal(document_tail(world->document, 0)->channels[0].spline, PLUCK);
}

WORLD_TEST(test_which_channels_there_are, world_open(world))
{
    assert_reversible(world, EDIT(edit_channel_add, 0, PLUCK, AXIS_UP, PART_DISPLACEMENT));
    const struct tail *tail = document_tail(world->document, 0);
    assert_int_equal(tail->channel_count, 3);
    assert_int_equal(tail->channels[2].spline, PLUCK);
    assert_int_equal(tail->channels[2].of, PART_DISPLACEMENT);
    assert_near(tail->channels[2].lag.value[0], CHANNEL_DEFAULT_LAG, 0);
    assert_reversible(world, EDIT(edit_channel_remove, (struct channel_place){0, 0}));
    assert_int_equal(document_tail(world->document, 0)->channel_count, 2);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, PLUCK);
    assert_refused(world, EDIT(edit_channel_remove, (struct channel_place){0, 2}), "there is no such channel");
    assert_refused(world, EDIT(edit_channel_add, 0, -1, AXIS_SIDE, PART_TOTAL), "t: there is no such spline");
    for (int c = 2; c < SCENE_MAX_CHANNELS; c++)
        assert_true(world_step(world, EDIT(edit_channel_add, 0, PLUCK, AXIS_UP, PART_DISPLACEMENT)));
    assert_refused(world, EDIT(edit_channel_add, 0, PLUCK, AXIS_UP, PART_DISPLACEMENT), "t: at most 64 channels fit");
}

/// The gains of all joints together, and the lag from base to tip, stay; arrays are read at the same shares of the length.
WORLD_TEST(test_joints_keep_the_shape, world_open(world))
{
    assert_reversible(world, EDIT(edit_joints, 0, 5));
    const struct tail *tail = document_tail(world->document, 0);
    assert_int_equal(tail->joints, 5);
    assert_near(tail->channels[0].gain.value[0], 5 * 3.0 / 5, 1e-6);
    assert_near(tail->channels[0].lag.value[0], 6.5 * 3.0 / 5, 1e-6);
    const double gains[] = {0.6, 0.9, 1.2, 1.5, 1.8}; // 1, 1.5, 2, 2.5, 3, each three fifths
    for (int n = 0; n < 5; n++) assert_near(tail->channels[1].gain.value[n], gains[n], 1e-6);
    assert_reversible(world, EDIT(edit_joints, 0, 1));
    assert_reversible(world, EDIT(edit_joints, 0, TAIL_MAX_JOINTS));
    assert_refused(world, EDIT(edit_joints, 0, 0), "t: joints must be from 1 to 256");
    assert_refused(world, EDIT(edit_joints, 0, 257), "t: joints must be from 1 to 256");
}

/// What moves the tail as a whole moves it as far, and still has one number for each joint.
WORLD_TEST(test_joints_of_what_does_not_bend, world_open(world))
{
    world_must(world, edit_bend(world, 0, 1, -1, AXIS_STRETCH, -1));
    assert_int_equal(document_tail(world->document, 0)->channels[1].gain.form, ANGLES_EACH);
    assert_reversible(world, EDIT(edit_joints, 0, 5));
    const struct channel *stretch = &document_tail(world->document, 0)->channels[1];
    assert_int_equal(stretch->gain.count, 5);
    for (int n = 0; n < 5; n++) assert_near(stretch->gain.value[n], 1 + 0.5 * n, 1e-6);
}

// --- pins

enum { SIDE, UP, BASE };

static const char pinned_text[] =
    "{\"frames\": [0, 48], \"splines\": [{\"name\": \"side\", \"frequency\": 1, \"knots\": [{\"frame\": 0, "
    "\"value\": 0}]},{\"name\": \"up\", \"frequency\": 2, \"equilibrium\": {\"spline\": \"base\"}},{\"name\": "
    "\"base\", \"mode\": \"cubic\"}],\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"joints\": 12, \"position\": "
    "[0, {\"spline\": \"base\"}, 0],\"channels\": [{\"spline\": \"side\"}, {\"spline\": \"up\", \"axis\": "
    "\"up\"}],\"pins\": [{\"frame\": 30, \"joint\": 11, \"to\": [0, 1, 0.5], \"why\": \"grip\"},{\"frame\": 12.25, "
    "\"joint\": 5, \"to\": [0.25, 0, 1]}]},{\"type\": \"tail\", \"name\": \"free\"}]}";

#define PINNED_TEST(name) WORLD_TEST(name, world_open_scene(world, pinned_text))

PINNED_TEST(test_saves_what_it_reads)
{
    const struct rig *rig = world->document->rigs[0];
    assert_int_equal(rig->pin_count, 2);
    assert_near(rig->pins[0].frame, 12.25, 0);
    assert_int_equal(rig->pins[1].point, 11);
    assert_near(rig->pins[1].to[2], 0.5, 0);
    const char *text = world_print(world);
    assert_non_null(strstr(text, "\"pins\": [\n        { \"frame\": 12.25, \"joint\": 5, \"to\": [0.25, 0, 1] },\n"
                                 "        { \"frame\": 30, \"joint\": 11, \"to\": [0, 1, 0.5], \"why\": \"grip\" }"));
    assert_loads_again(world->document);
}

PINNED_TEST(test_every_edit_is_undone)
{
    assert_reversible(world, EDIT(edit_pin_add, 0, &(struct pin){.frame = 20, .point = 3, .to = {1, 2, 3}}));
    assert_int_equal(world->document->rigs[0]->pin_count, 3);
    struct pin moved = world->document->rigs[0]->pins[1];
    moved.frame = 40; // past the other
    moved.to[1] = -2;
    assert_reversible(world, EDIT(edit_pin_set, 0, &moved));
    assert_int_equal(world->document->rigs[0]->pins[2].id, moved.id);
    assert_reversible(world, EDIT(edit_pin_remove, 0, world->document->rigs[0]->pins[0].id));
    assert_reversible(world, EDIT(edit_joints, 0, 24));
    assert_int_equal(world->document->rigs[0]->pins[0].point, 23);
    assert_reversible(world, EDIT(edit_fps, 48, true));
    assert_near(world->document->rigs[0]->pins[1].frame, 80, 0);
    assert_reversible(world, EDIT(edit_tail_add, 0, 0));
    assert_int_equal(world->document->rigs[2]->pin_count, 0);
    assert_reversible(world, EDIT(edit_range, 0, 70, RANGE_MOVE));
    assert_near(world->document->rigs[0]->pins[1].frame, 70, 0);
    assert_reversible(world, EDIT(edit_range, 0, 65, RANGE_TRIM));
    assert_int_equal(world->document->rigs[0]->pin_count, 1);
}

PINNED_TEST(test_what_would_not_load_is_refused)
{
    struct pin pin = world->document->rigs[0]->pins[1];
    assert_refused(world, EDIT(edit_pin_add, 0, &pin),
                   "t: pins: expected one pin per point and sample, got another at frame 30");
    pin.frame = 49;
    assert_refused(world, EDIT(edit_pin_set, 0, &pin), "t: pins: expected a frame from 0 to 48, got 49");
    pin.to[1] = NAN;
    assert_refused(world, EDIT(edit_pin_set, 0, &pin), "t: a pin: the to must be finite");
    pin = (struct pin){.frame = 2, .point = 12};
    assert_refused(world, EDIT(edit_pin_add, 0, &pin), "t: pins: expected a whole number from 0 to 11, got 12");
    assert_refused(world, EDIT(edit_pin_remove, 0, pin.id), "t: this pin no longer exists");
    assert_refused(world, edit_mode(world, SIDE, WIGGLY_CUBIC),
                   "t: pins: expected splines with a swing of their own, got \"side\", which is cubic");
    assert_refused(world, edit_number(world, UP, PARAMETER_FREQUENCY, 0),
                   "t: pins: expected splines with a swing of their own, got \"up\", whose frequency is 0");
    assert_refused(world, edit_number(world, UP, PARAMETER_CALM, 0),
                   "t: pins: expected splines with a swing of their own, got \"up\", whose calm is 0");
    assert_refused(world, edit_track(world, UP, PARAMETER_EQUILIBRIUM, SIDE),
                   "t: pins: expected splines that do not follow each other, got \"up\", which follows \"side\"");
    assert_refused(world, edit_track(world, BASE, PARAMETER_EQUILIBRIUM, SIDE),
                   "t: pins: expected splines without a cycle, got \"up\", which follows \"base\"");
    assert_refused(world, edit_bend(world, 0, 1, BASE, -1, -1),
                   "t: pins: expected splines with a swing of their own, got \"base\", which is cubic");
    assert_refused(world, edit_frames(world, 0, 20), "t: pins: expected a frame from 0 to 20, got 30");
    pin.frame = 48;
    pin.point = 1;
    world_must(world, EDIT(edit_pin_add, 0, &pin));
    assert_refused(world, edit_start(world, UP, WIGGLY_LOOP),
                   "t: pins: expected a frame before 48, because the last frame of a loop repeats the first, got 48");
}
