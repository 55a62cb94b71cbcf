/// Edits: what they do, and that none makes a document that would not load.

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
    world_must(world, edit_knot_remove(world_edit(world), SWAY, id, &world->error));
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
    world_must(world, edit_knot_set(world_edit(world), SWAY, &minus, &world->error));
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
    assert_refused(world, edit_knot_set(world_edit(world), SWAY, &soft, &world->error),
                   "sway: a knot: the stiffness must be above 0 and finite");
    assert_refused(world, edit_knot_remove(world_edit(world), SWAY, 99, &world->error),
                   "sway: this knot no longer exists");
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
    const char *before = world_print(world);
    struct angles all = {.value = {4}}, each = {.form = ANGLES_EACH, .count = 3, .value = {1, 2, 9}},
                  wrong = {.value = {NAN}};
    const struct channel_place at = {0, 1}, no_channel = {0, 2}, no_rig = {1, 2};
    world_must(world, edit_angles(world_edit(world), at, ANGLE_GAIN, &all, &world->error));
    assert_int_equal(document_tail(world->document, 0)->channels[1].gain.form, ANGLES_ONE);
    assert_near(document_tail(world->document, 0)->channels[1].gain.value[0], 4, 0);
    world_must(world, edit_angles(world_edit(world), at, ANGLE_LAG, &each, &world->error));
    assert_near(document_tail(world->document, 0)->channels[1].lag.value[2], 9, 0);
    world_must(world,
               edit_angles(world_edit(world), (struct channel_place){0, -1}, ANGLE_REST, &each, &world->error));
    assert_int_equal(document_tail(world->document, 0)->rest.form, ANGLES_EACH);
    world_must(world, edit_bend(world, 0, 0, -1, AXIS_UP, -1));
    assert_refused(world, edit_angles(world_edit(world), at, ANGLE_LAG, &wrong, &world->error),
                   "t: angles must be finite");
    assert_refused(world, edit_angles(world_edit(world), no_channel, ANGLE_LAG, &wrong, &world->error),
                   "there is no such channel");
    assert_refused(world, edit_angles(world_edit(world), no_rig, ANGLE_LAG, &wrong, &world->error),
                   "there is no such rig");
    while (history_undo(world->history)) continue;
    assert_document(world, before);
}
