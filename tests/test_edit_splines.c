/// Edits of the list of splines and of the scene's timing: what they do to what refers to a spline, and that undo
/// brings back every byte and every id.
#include "near.h"

#include "world.h"
#include <stdlib.h>
#include <string.h>

static struct edit on(enum edit_kind kind, int spline) { return (struct edit){.kind = kind, .spline = spline}; }

static struct edit edit_name(int spline, const char *name)
{
    return (struct edit){.kind = EDIT_SPLINE_NAME, .spline = spline, .text = name};
}

static struct edit edit_color(int spline, int color)
{
    return (struct edit){.kind = EDIT_SPLINE_COLOR, .spline = spline, .color = color};
}

static struct edit edit_reorder(int spline, int to)
{
    return (struct edit){.kind = EDIT_SPLINE_MOVE, .spline = spline, .to = to};
}

static struct edit fps_edit(double fps, bool seconds)
{
    return (struct edit){.kind = EDIT_FPS, .number = fps, .flag = seconds};
}

static struct edit edit_fit(int first, int last, enum range_fit fit)
{
    return (struct edit){.kind = EDIT_RANGE, .first = first, .last = last, .fit = fit};
}

static void test_a_new_spline(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    struct edit add = {.kind = EDIT_SPLINE_ADD, .spline = 1, .flag = true, .knot = {.frame = 7, .value = 0.5}};
    assert_reversible(&world, add);
    const struct spline *added = world.document->splines[1];
    assert_string_equal(added->name, "spline");
    assert_near(added->parameter[PARAMETER_FREQUENCY].value, 1, 0);
    assert_near(added->parameter[PARAMETER_DAMPING].value, 0.1, 0);
    assert_near(added->parameter[PARAMETER_BANDWIDTH].value, 0.1, 0);
    assert_int_equal(added->knot_count, 1);
    assert_near(added->knots[0].frame, 7, 0);
    assert_int_equal(world.document->splines[3]->parameter[PARAMETER_EQUILIBRIUM].track, 0);
    assert_int_equal(document_tail(world.document, 0)->channels[1].spline,
                     3); // "loop" has moved on, and its channel with it
    add.spline = -1;
    world_must(&world, add);
    assert_string_equal(world.document->splines[4]->name, "spline 2");
    unsigned id = world.document->splines[4]->id, knot = world.document->splines[4]->knots[0].id;
    assert_true(history_undo(world.history) && history_redo(world.history));
    assert_int_equal(document_find_spline_id(world.document, id), 4);
    assert_int_equal(world.document->splines[4]->knots[0].id, knot);
    add.text = "sway";
    assert_refused(&world, add, "a spline called sway already exists");
    add.text = NULL;
    add.knot.frame = 49;
    assert_refused(&world, add, "frame 49 is outside 0 to 48");
    world_close(&world);
}

static void test_a_copy(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, on(EDIT_SPLINE_COPY, LOOP));
    const struct spline *copy = world.document->splines[LOOP + 1], *loop = world.document->splines[LOOP];
    assert_string_equal(copy->name, "loop 2");
    assert_int_equal(copy->parameter[PARAMETER_EQUILIBRIUM].track, SWAY);
    assert_int_equal(spline_start(copy), WIGGLY_LOOP);
    assert_true(copy->id != loop->id && copy->knots[0].id != loop->knots[0].id);
    world_must(&world, on(EDIT_SPLINE_COPY, LOOP + 1));
    assert_string_equal(world.document->splines[LOOP + 2]->name, "loop 3");
    world_must(&world, edit_insert(LOOP + 1, 9, 9)); // a copy's knots are its own
    assert_int_equal(world.document->splines[LOOP]->knot_count, 1);
    world_close(&world);
}

static void test_removal_needs_no_followers(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_refused(&world, on(EDIT_SPLINE_REMOVE, SWAY), "sway: still used in 2 places; remove those first");
    assert_refused(&world, on(EDIT_SPLINE_REMOVE, LOOP), "loop: still used in 1 place; remove those first");
    unsigned id = world.document->splines[PLUCK]->id;
    assert_reversible(&world, on(EDIT_SPLINE_REMOVE, PLUCK));
    assert_int_equal(document_find_spline_id(world.document, id), -1);
    assert_int_equal(document_tail(world.document, 0)->channels[1].spline, 1);
    assert_int_equal(world.document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].track, 0);
    assert_true(history_undo(world.history));
    assert_int_equal(document_find_spline_id(world.document, id), PLUCK);
    world_close(&world);
}

static void test_order(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, edit_reorder(SWAY, 2));
    assert_string_equal(world.document->splines[2]->name, "sway");
    assert_string_equal(world.document->splines[1]->name, "loop");
    assert_int_equal(world.document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].track, 2);
    assert_int_equal(document_tail(world.document, 0)->channels[0].spline, 2);
    assert_int_equal(document_tail(world.document, 0)->channels[1].spline, 1);
    assert_reversible(&world, edit_reorder(2, 0));
    assert_string_equal(world.document->splines[0]->name, "sway");
    assert_refused(&world, edit_reorder(0, 3), "there is no such place in the list");
    world_close(&world);
}

static void test_names_and_colours(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, edit_name(SWAY, "Schwung · 1"));
    assert_refused(&world, edit_name(SWAY, ""), "a spline needs a name");
    assert_refused(&world, edit_name(SWAY, "loop"), "a spline called loop already exists");
    world_must(&world, edit_name(LOOP, "loop")); // its own
    assert_reversible(&world, edit_color(PLUCK, 0x4FA3E3));
    char *text = world_print(&world);
    assert_non_null(strstr(text, "\"color\": \"#4FA3E3\""));
    struct document *again = scene_parse("again", text, strlen(text), NULL, &world.error);
    assert_non_null(again);
    assert_int_equal(again->splines[PLUCK]->color, 0x4FA3E3);
    assert_int_equal(again->splines[SWAY]->color, -1);
    document_destroy(again);
    free(text);
    world_must(&world, edit_color(PLUCK, -1));
    text = world_print(&world);
    assert_null(strstr(text, "color"));
    free(text);
    assert_refused(&world, edit_color(PLUCK, 0x1000000), "there is no such colour");
    world_close(&world);
}

/// 24 to 30 frames a second: kept seconds put the knot of frame 12 on 15, and a slope per second stays what it is.
static void test_frames_per_second(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    assert_reversible(&world, fps_edit(30, false));
    assert_near(world.document->splines[SWAY]->knots[1].frame, 12, 0);
    assert_true(history_undo(world.history));
    assert_reversible(&world, fps_edit(30, true));
    assert_near(world.document->splines[SWAY]->knots[1].frame, 15, 0);
    assert_near(world.document->splines[SWAY]->knots[2].frame, 37.5, 0);
    assert_near(world.document->splines[SWAY]->knots[1].slope, 0, 0);
    assert_int_equal(world.document->last_frame, 60);
    assert_refused(&world, fps_edit(0, false), "frames per second must be above 0 and at most 100000");
    assert_refused(&world, fps_edit(NAN, true), "frames per second must be above 0 and at most 100000");
    world_must(&world, edit_insert(SWAY, 16, 0));
    assert_refused(&world, fps_edit(10, true), "sway: two knots would land on frame 5.333333333");
    world_close(&world);
}

static void test_substeps(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    struct edit edit = {.kind = EDIT_SUBSTEPS, .substeps = 4};
    assert_reversible(&world, edit);
    world_must(&world, edit_insert(SWAY, 12.25, 0));
    edit.substeps = 1;
    assert_refused(&world, edit, "sway: two knots would land on frame 12.25");
    world_close(&world);
}

static void test_a_range_that_knots_do_not_fit(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    world_must(&world, edit_insert(SWAY, 28, 4));
    assert_refused(&world, edit_fit(2, 28, RANGE_REFUSE), "sway: the knot at frame 0 would fall outside the range");
    assert_reversible(&world, edit_fit(2, 28, RANGE_TRIM));
    assert_int_equal(world.document->splines[SWAY]->knot_count, 2);
    assert_near(world.document->splines[SWAY]->knots[0].frame, 12, 0);
    assert_true(history_undo(world.history));
    assert_int_equal(world.document->splines[SWAY]->knot_count, 4);
    assert_reversible(&world, edit_fit(2, 28, RANGE_MOVE));
    const double moved[] = {2, 12, 27, 28}; // the knot at 28 makes room for the one from 30
    for (int k = 0; k < 4; k++) assert_near(world.document->splines[SWAY]->knots[k].frame, moved[k], 0);
    assert_refused(&world, edit_fit(2, 4, RANGE_MOVE), "sway: 4 knots do not fit into 3 frames");
    assert_refused(&world, edit_fit(2, 2, RANGE_TRIM), "loop: a loop needs more than one frame");
    world_close(&world);
}

static unsigned next_random(unsigned *seed) { return (*seed = *seed * 1664525u + 1013904223u) >> 8; }

static struct edit random_edit(unsigned *seed, int count)
{
    static const char *const names[] = {"a", "b", "c d", "e 2", "sway"};
    int spline = count ? (int)(next_random(seed) % (unsigned)count) : 0, other = (int)(next_random(seed) % 8);
    switch (next_random(seed) % 12) {
    case 0:
        return (struct edit){.kind = EDIT_SPLINE_ADD, .spline = other, .flag = other > 2, .knot = {.frame = other}};
    case 1:
        return on(EDIT_SPLINE_COPY, spline);
    case 2:
    case 3:
        return on(EDIT_SPLINE_REMOVE, spline);
    case 4:
        return edit_reorder(spline, other);
    case 5:
        return edit_name(spline, names[other % 5]);
    case 6:
        return edit_color(spline, other - 1);
    case 7:
        return fps_edit(12 + 6 * other, other % 2);
    case 8:
        return (struct edit){.kind = EDIT_SUBSTEPS, .substeps = 1 + other % 3};
    case 9:
        return edit_fit(other - 4, 20 + 8 * other, (enum range_fit)(other % 3));
    case 10:
        return edit_track(spline, (enum parameter)(other % PARAMETER_COUNT), other - 2);
    default:
        return edit_insert(spline, next_random(seed) % 48, other);
    }
}

/// Many edits in a row, some of them refused, some undone on the way: whatever there is loads, undoing all gives the
/// first document and redoing all the last one.
static void test_random_sessions_come_back(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed <= 40; seed++) {
        struct world world;
        unsigned random = seed;
        world_open(&world);
        char *first = world_print(&world);
        for (int i = 0; i < 150; i++) {
            world_step(&world, random_edit(&random, world.document->spline_count));
            if (next_random(&random) % 8 == 0) history_undo(world.history);
        }
        world_must(&world, (struct edit){.kind = EDIT_FPS, .number = 23.976}); // nothing is left to be done again
        char *last = world_print(&world);
        struct document *again = scene_parse("again", last, strlen(last), NULL, &world.error);
        if (!again) fail_msg("seed %u: what was saved does not load: %s", seed, world.error.text);
        document_destroy(again);
        world_undo_all(&world);
        assert_document(&world, first);
        while (history_redo(world.history)) continue;
        assert_document(&world, last);
        free(first);
        free(last);
        world_close(&world);
    }
}

/// A drag takes its step back at every movement: what it adds then has the same ids again.
static void test_ids_of_a_restarted_step(void **state)
{
    (void)state;
    struct world world;
    world_open(&world);
    history_begin(world.history, "Copy", 0);
    assert_true(world_apply(&world, on(EDIT_SPLINE_COPY, SWAY)));
    unsigned id = world.document->splines[1]->id, knot = world.document->splines[1]->knots[0].id;
    history_restart(world.history);
    assert_int_equal(world.document->spline_count, 3);
    assert_true(world_apply(&world, on(EDIT_SPLINE_COPY, SWAY)));
    assert_int_equal(world.document->splines[1]->id, id);
    assert_int_equal(world.document->splines[1]->knots[0].id, knot);
    history_end(world.history);
    world_close(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_new_spline),
        cmocka_unit_test(test_a_copy),
        cmocka_unit_test(test_removal_needs_no_followers),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_names_and_colours),
        cmocka_unit_test(test_frames_per_second),
        cmocka_unit_test(test_substeps),
        cmocka_unit_test(test_a_range_that_knots_do_not_fit),
        cmocka_unit_test(test_random_sessions_come_back),
        cmocka_unit_test(test_ids_of_a_restarted_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
