/// Edits of the list of splines and of the scene's timing: what they do to what refers to a spline, and that undo
/// brings back every byte and every id.

#include "world.h"

WORLD_TEST(test_a_new_spline, world_open(world))
{
    const struct knot first = {.frame = 7, .value = 0.5};
    assert_reversible(world, edit_spline_add(world_edit(world), 1, NULL, &first, &world->error));
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
    world_must(world, edit_spline_add(world_edit(world), -1, NULL, &first, &world->error));
    assert_string_equal(world->document->splines[4]->name, "spline 2");
    unsigned id = world->document->splines[4]->id, knot = world->document->splines[4]->knots[0].id;
    assert_true(history_undo(world->history) && history_redo(world->history));
    assert_int_equal(document_find_spline_id(world->document, id), 4);
    assert_int_equal(world->document->splines[4]->knots[0].id, knot);
    assert_refused(world, edit_spline_add(world_edit(world), -1, "sway", &first, &world->error),
                   "a spline called sway already exists");
    const struct knot outside = {.frame = 49};
    assert_refused(world, edit_spline_add(world_edit(world), -1, NULL, &outside, &world->error),
                   "frame 49 is outside 0 to 48");
    const struct knot last = {.frame = 48, .value = 0.5}; // of a loop, whose first frame it repeats
    world_must(world, edit_spline_add(world_edit(world), -1, NULL, &last, &world->error));
    assert_near(world->document->splines[5]->knots[0].frame, 0, 0);
}

WORLD_TEST(test_a_copy, world_open(world))
{
    assert_reversible(world, edit_spline_copy(world_edit(world), LOOP, &world->error));
    const struct spline *copy = world->document->splines[LOOP + 1], *loop = world->document->splines[LOOP];
    assert_string_equal(copy->name, "loop 2");
    assert_int_equal(copy->parameter[PARAMETER_EQUILIBRIUM].track, SWAY);
    assert_int_equal(spline_start(copy), WIGGLY_LOOP);
    assert_true(copy->id != loop->id && copy->knots[0].id != loop->knots[0].id);
    world_must(world, edit_spline_copy(world_edit(world), LOOP + 1, &world->error));
    assert_string_equal(world->document->splines[LOOP + 2]->name, "loop 3");
    world_must(world, edit_insert(world, LOOP + 1, 9, 9)); // a copy's knots are its own
    assert_int_equal(world->document->splines[LOOP]->knot_count, 1);
}

WORLD_TEST(test_removal_needs_no_followers, world_open(world))
{
    assert_refused(world, edit_spline_remove(world_edit(world), SWAY, &world->error),
                   "sway: still used in 2 places; remove those first");
    assert_refused(world, edit_spline_remove(world_edit(world), LOOP, &world->error),
                   "loop: still used in 1 place; remove those first");
    unsigned id = world->document->splines[PLUCK]->id;
    assert_reversible(world, edit_spline_remove(world_edit(world), PLUCK, &world->error));
    assert_int_equal(document_find_spline_id(world->document, id), -1);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, 1);
    assert_int_equal(world->document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].track, 0);
    assert_true(history_undo(world->history));
    assert_int_equal(document_find_spline_id(world->document, id), PLUCK);
}

WORLD_TEST(test_order, world_open(world))
{
    assert_reversible(world, edit_spline_move(world_edit(world), SWAY, 2, &world->error));
    assert_string_equal(world->document->splines[2]->name, "sway");
    assert_string_equal(world->document->splines[1]->name, "loop");
    assert_int_equal(world->document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].track, 2);
    assert_int_equal(document_tail(world->document, 0)->channels[0].spline, 2);
    assert_int_equal(document_tail(world->document, 0)->channels[1].spline, 1);
    assert_reversible(world, edit_spline_move(world_edit(world), 2, 0, &world->error));
    assert_string_equal(world->document->splines[0]->name, "sway");
    assert_refused(world, edit_spline_move(world_edit(world), 0, 3, &world->error),
                   "there is no such place in the list");
}

WORLD_TEST(test_names_and_colours, world_open(world))
{
    assert_reversible(world, edit_spline_name(world_edit(world), SWAY, "Schwung · 1", &world->error));
    assert_refused(world, edit_spline_name(world_edit(world), SWAY, "", &world->error), "a spline needs a name");
    assert_refused(world, edit_spline_name(world_edit(world), SWAY, "loop", &world->error),
                   "a spline called loop already exists");
    world_must(world, edit_spline_name(world_edit(world), LOOP, "loop", &world->error)); // its own
    assert_reversible(world, edit_spline_color(world_edit(world), PLUCK, 0x4FA3E3, &world->error));
    const char *text = world_print(world);
    assert_non_null(strstr(text, "\"color\": \"#4FA3E3\""));
    struct document *again = document_of_text(text);
    assert_int_equal(again->splines[PLUCK]->color, 0x4FA3E3);
    assert_int_equal(again->splines[SWAY]->color, -1);
    document_destroy(again);
    world_must(world, edit_spline_color(world_edit(world), PLUCK, -1, &world->error));
    text = world_print(world);
    assert_null(strstr(text, "color"));
    assert_refused(world, edit_spline_color(world_edit(world), PLUCK, 0x1000000, &world->error),
                   "there is no such colour");
}

/// 24 to 30 frames a second: kept seconds put the knot of frame 12 on 15, and a slope per second stays what it is.
WORLD_TEST(test_frames_per_second, world_open(world))
{
    assert_reversible(world, edit_fps(world_edit(world), 30, false, &world->error));
    assert_near(world->document->splines[SWAY]->knots[1].frame, 12, 0);
    assert_true(history_undo(world->history));
    assert_reversible(world, edit_fps(world_edit(world), 30, true, &world->error));
    assert_near(world->document->splines[SWAY]->knots[1].frame, 15, 0);
    assert_near(world->document->splines[SWAY]->knots[2].frame, 37.5, 0);
    assert_near(world->document->splines[SWAY]->knots[1].slope, 0, 0);
    assert_int_equal(world->document->last_frame, 60);
    assert_refused(world, edit_fps(world_edit(world), 0, false, &world->error),
                   "frames per second must be above 0 and at most 100000");
    assert_refused(world, edit_fps(world_edit(world), NAN, true, &world->error),
                   "frames per second must be above 0 and at most 100000");
    world_must(world, edit_insert(world, SWAY, 16, 0));
    assert_refused(world, edit_fps(world_edit(world), 10, true, &world->error),
                   "sway: two knots would land on frame 5.333333333");
}

WORLD_TEST(test_substeps, world_open(world))
{
    assert_reversible(world, edit_substeps(world_edit(world), 4, &world->error));
    world_must(world, edit_insert(world, SWAY, 12.25, 0));
    assert_refused(world, edit_substeps(world_edit(world), 1, &world->error),
                   "sway: two knots would land on frame 12.25");
}

WORLD_TEST(test_a_range_that_knots_do_not_fit, world_open(world))
{
    world_must(world, edit_insert(world, SWAY, 28, 4));
    assert_refused(world, edit_range(world_edit(world), 2, 28, RANGE_REFUSE, &world->error),
                   "sway: the knot at frame 0 would fall outside the range");
    assert_reversible(world, edit_range(world_edit(world), 2, 28, RANGE_TRIM, &world->error));
    assert_int_equal(world->document->splines[SWAY]->knot_count, 2);
    assert_near(world->document->splines[SWAY]->knots[0].frame, 12, 0);
    assert_true(history_undo(world->history));
    assert_int_equal(world->document->splines[SWAY]->knot_count, 4);
    assert_reversible(world, edit_range(world_edit(world), 2, 28, RANGE_MOVE, &world->error));
    const double moved[] = {2, 12, 27, 28}; // the knot at 28 makes room for the one from 30
    for (int k = 0; k < 4; k++) assert_near(world->document->splines[SWAY]->knots[k].frame, moved[k], 0);
    assert_refused(world, edit_range(world_edit(world), 2, 4, RANGE_MOVE, &world->error),
                   "sway: 4 knots do not fit into 3 frames");
    assert_refused(world, edit_range(world_edit(world), 2, 2, RANGE_TRIM, &world->error),
                   "loop: a loop needs more than one frame");
}

static unsigned next_random(unsigned *seed) { return (*seed = *seed * 1664525u + 1013904223u) >> 8; }

static bool random_edit(struct world *world, unsigned *seed)
{
    static const char *const names[] = {"a", "b", "c d", "e 2", "sway"};
    struct document *document = world_edit(world);
    struct error *error = &world->error;
    const int count = document->spline_count;
    int spline = count ? (int)(next_random(seed) % (unsigned)count) : 0, other = (int)(next_random(seed) % 8);
    switch (next_random(seed) % 12) {
    case 0:
        return edit_spline_add(document, other, NULL, other > 2 ? &(struct knot){.frame = other} : NULL, error);
    case 1:
        return edit_spline_copy(document, spline, error);
    case 2:
    case 3:
        return edit_spline_remove(document, spline, error);
    case 4:
        return edit_spline_move(document, spline, other, error);
    case 5:
        return edit_spline_name(document, spline, names[other % 5], error);
    case 6:
        return edit_spline_color(document, spline, other - 1, error);
    case 7:
        return edit_fps(document, 12 + 6 * other, other % 2, error);
    case 8:
        return edit_substeps(document, 1 + other % 3, error);
    case 9:
        return edit_range(document, other - 4, 20 + 8 * other, (enum range_fit)(other % 3), error);
    case 10:
        return edit_track(world, spline, (enum parameter)(other % PARAMETER_COUNT), other - 2);
    default:
        return edit_insert(world, spline, next_random(seed) % 48, other);
    }
}

/// Many edits in a row, some of them refused, some undone on the way: whatever there is loads, undoing all gives the
/// first document and redoing all the last one.
TEST(test_random_sessions_come_back)
{
    for (unsigned seed = 1; seed <= 40; seed++) {
        struct world world;
        unsigned random = seed;
        world_open(&world);
        const char *first = world_print(&world);
        for (int i = 0; i < 150; i++) {
            world_step(&world, random_edit(&world, &random));
            if (next_random(&random) % 8 == 0) history_undo(world.history);
        }
        world_must(&world,
                   edit_fps(world_edit(&world), 23.976, false, &world.error)); // nothing is left to be done again
        const char *last = world_print(&world);
        assert_loads_again(world.document);
        world_undo_all(&world);
        assert_document(&world, first);
        while (history_redo(world.history)) continue;
        assert_document(&world, last);
        world_close(&world);
    }
}

/// A drag takes its step back at every movement: what it adds then has the same ids again.
WORLD_TEST(test_ids_of_a_restarted_step, world_open(world))
{
    history_begin(world->history, "Copy", 0);
    assert_true(edit_spline_copy(world_edit(world), SWAY, &world->error));
    unsigned id = world->document->splines[1]->id, knot = world->document->splines[1]->knots[0].id;
    history_restart(world->history);
    assert_int_equal(world->document->spline_count, 3);
    assert_true(edit_spline_copy(world_edit(world), SWAY, &world->error));
    assert_int_equal(world->document->splines[1]->id, id);
    assert_int_equal(world->document->splines[1]->knots[0].id, knot);
    history_end(world->history);
}
