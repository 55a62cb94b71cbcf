/// Steps of edits: every one can be taken back and done again.

#include "invariants.h"
#include "world.h"

/// A drag re-applies its edits from the same state each frame, gives an inserted knot the same id again, and is one
/// step.
WORLD_TEST(test_restart, world_open(world))
{
    const char *before = world_print(world);
    unsigned id = 0;
    history_begin(world->history, "Drag", 0);
    for (int frame = 0; frame < 20; frame++) {
        history_restart(world->history);
        assert_true(edit_insert(world, SWAY, 2 + frame % 3, frame));
        assert_true(edit_move(world, SWAY, 2, 20 + frame, 0));
        int at = spline_find_knot(world->document, world->document->splines[SWAY], 2 + frame % 3);
        assert_true(at >= 0);
        if (frame > 0) assert_int_equal(world->document->splines[SWAY]->knots[at].id, id);
        id = world->document->splines[SWAY]->knots[at].id;
        if (frame == 9) break; // the second knot would land on the third
    }
    history_end(world->history);
    assert_string_equal(history_undo_label(world->history), "Drag");
    assert_true(history_undo(world->history));
    assert_document(world, before);
    assert_false(history_undo(world->history));
}

/// Esc in a drag: nothing is left, not even of the steps that could be done again.
WORLD_TEST(test_cancelled_step, world_open(world))
{
    world_must(world, edit_insert(world, SWAY, 5, 5));
    const char *after = world_print(world);
    assert_true(history_undo(world->history));
    history_begin(world->history, "Cancelled", 0);
    assert_true(edit_insert(world, SWAY, 6, 6));
    history_restart(world->history);
    assert_true(history_is_open(world->history));
    history_end(world->history);
    assert_null(history_undo_label(world->history));
    assert_true(history_redo(world->history));
    assert_document(world, after);
    world_must(world, edit_move(world, SWAY, 0, 0, 0)); // what changes nothing is no step either
    assert_false(history_redo(world->history));
    assert_true(history_undo(world->history));
    assert_null(history_undo_label(world->history));
}

static void nudge(struct world *world, double value, uint64_t merge)
{
    history_begin(world->history, "Nudge", merge);
    assert_true(edit_move(world, SWAY, 0, 0, value));
    history_end(world->history);
}

WORLD_TEST(test_merge, world_open(world))
{
    const char *before = world_print(world);
    for (int i = 1; i <= 3; i++) nudge(world, i, 77);
    nudge(world, 4, 78);
    nudge(world, 5, 0);
    nudge(world, 6, 0);
    assert_int_equal(world_undo_all(world), 4);
    assert_document(world, before);
    nudge(world, 1, 77);
    nudge(world, 2, 77);
    assert_true(history_undo(world->history));
    assert_true(history_redo(world->history));
    nudge(world, 3, 77); // what was done again is done
    assert_int_equal(world_undo_all(world), 2);
    nudge(world, 1, 77);
    nudge(world, 2, 78);
    assert_true(history_undo(world->history));
    nudge(world, 3, 77); // an undo ends a run
    assert_int_equal(world_undo_all(world), 2);
    nudge(world, 1, 77);
    history_mark_saved(world->history);
    nudge(world, 2, 77); // and so does saving: the saved state can be reached again
    assert_true(history_undo(world->history));
    assert_true(history_is_saved(world->history));
    assert_int_equal(world_undo_all(world), 1);
}

WORLD_TEST(test_saved, world_open(world))
{
    assert_true(history_is_saved(world->history));
    world_must(world, edit_insert(world, SWAY, 5, 5));
    assert_false(history_is_saved(world->history));
    history_mark_saved(world->history);
    world_must(world, edit_insert(world, SWAY, 6, 6));
    assert_true(history_undo(world->history));
    assert_true(history_is_saved(world->history));
    assert_true(history_undo(world->history));
    assert_false(history_is_saved(world->history));
    world_must(world, edit_insert(world, SWAY, 5, 5)); // the same document by another way counts as changed
    assert_false(history_is_saved(world->history));
    history_begin(world->history, "Drag", 0);
    history_mark_saved(world->history);
    assert_true(history_is_saved(world->history));
    assert_true(edit_insert(world, SWAY, 7, 7));
    assert_false(history_is_saved(world->history));
    history_restart(world->history);
    assert_true(history_is_saved(world->history));
    history_end(world->history);
}

WORLD_TEST(test_revision, world_open(world))
{
    uint64_t revision = history_revision(world->history);
    world_must(world, edit_insert(world, SWAY, 5, 5));
    assert_true(history_revision(world->history) > revision);
    revision = history_revision(world->history);
    assert_true(history_undo(world->history));
    assert_true(history_revision(world->history) > revision);
    revision = history_revision(world->history);
    assert_true(history_redo(world->history));
    assert_true(history_revision(world->history) > revision);
    revision = history_revision(world->history);
    assert_false(history_redo(world->history));
    assert_true(history_revision(world->history) == revision);
}

// --- everything at once

static double random_number(void) { return (double)(rand() % 2001 - 1000) / 128; }

/// One of so many, or of none the first.
static int any(int count) { return rand() % (count > 0 ? count : 1); }

static bool edit_random_knot(struct world *world, int spline)
{
    struct document *document = world->document;
    const double frame = (double)(rand() % 450 - 30) / 8;
    if (spline >= document->spline_count || document->splines[spline]->knot_count == 0 || rand() % 3 == 0)
        return edit_insert(world, spline, frame, random_number());
    struct knot knot = document->splines[spline]->knots[any(document->splines[spline]->knot_count)];
    if (rand() % 4 == 0) return edit_knot_remove(document, spline, knot.id, &world->error);
    if (rand() % 2) knot.frame = frame;
    knot.value = random_number();
    knot.has_slope = rand() % 2;
    knot.slope = random_number();
    knot.stiffness = fabs(random_number());
    return edit_knot_set(document, spline, &knot, &world->error);
}

static bool edit_random_parameter(struct world *world, int spline)
{
    enum parameter parameter = (enum parameter)(rand() % PARAMETER_COUNT);
    struct param param = {.value = rand() % 2 ? fabs(random_number()) : 0.5, .track = rand() % 6 - 3};
    if (rand() % 3 == 0) {
        parameter = rand() % 2 ? PARAMETER_MODE : PARAMETER_START;
        param = param_number(rand() % 3);
    }
    return edit_parameter(world->document, spline, parameter, &param, &world->error);
}

static bool edit_random_pin(struct world *world, int rig)
{
    struct document *document = world->document;
    struct pin pin = {.frame = rand() % 49, .point = rand() % 6, .to = {random_number(), 1, 0}};
    const int count = rig < document->rig_count ? document->rigs[rig]->pin_count : 0;
    if (count == 0 || rand() % 3 == 0) return edit_pin_add(document, rig, &pin, &world->error);
    pin.id = document->rigs[rig]->pins[any(count)].id;
    if (rand() % 3 == 0) return edit_pin_remove(document, rig, pin.id, &world->error);
    return edit_pin_set(document, rig, &pin, &world->error);
}

static bool edit_random_rig(struct world *world, int rig)
{
    static const char *const names[] = {"a", "b", "c d", "t"};
    struct document *document = world->document;
    struct error *error = &world->error;
    const struct channel_place at = {rig, rand() % 4 - 1};
    const int spline = any(document->spline_count);
    struct angles angles = {.form = (enum angle_form)(rand() % 3), .count = 3};
    for (int i = 0; i < 3; i++) {
        if (angles.form == ANGLES_RAMP) angles.ramp[i].at = i / 2.0;
        angles_set_number(&angles, i, random_number());
    }
    switch (rand() % 10) {
    case 0:
        return edit_tail_add(document, any(document->rig_count + 1) - 1, spline, error);
    case 1:
        return edit_rig_remove(document, rig, error);
    case 2:
        return edit_rig_name(document, rig, names[rand() % 4], error);
    case 3:
        return edit_joints(document, rig, rand() % 30, error);
    case 4:
        return edit_channel_add(document, rig, spline, (enum axis)(rand() % 3), (enum channel_part)(rand() % 2),
                                error);
    case 5:
        return edit_channel_remove(document, at, error);
    case 6:
        return rig < document->rig_count && edit_bend(world, rig, rand() % 3, -1, rand() % 2, -1);
    case 7:
        return edit_random_pin(world, rig);
    default:
        return edit_angles(document, at, (enum angle_kind)(rand() % 3), &angles, error);
    }
}

static bool edit_random_spline(struct world *world, int spline)
{
    static const char *const names[] = {"a", "b", "c d", "e 2", "sway"};
    struct document *document = world->document;
    struct error *error = &world->error;
    const int other = rand() % 8;
    const struct knot first = {.frame = other};
    switch (rand() % 9) {
    case 0:
        return edit_spline_add(document, other, NULL, other > 2 ? &first : NULL, error);
    case 1:
        return edit_spline_copy(document, spline, error);
    case 2:
        return edit_spline_remove(document, spline, error);
    case 3:
        return edit_spline_move(document, spline, other, error);
    case 4:
        return edit_spline_name(document, spline, names[other % 5], error);
    case 5:
        return edit_spline_color(document, spline, other - 1, error);
    case 6:
        return edit_fps(document, 12 + 6 * other, other % 2, error);
    case 7:
        return edit_substeps(document, 1 + other % 3, error);
    default:
        return edit_range(document, other - 4, 20 + 8 * other, (enum range_fit)(rand() % 3), error);
    }
}

/// Some edits, a restart now and then, undo and redo in between.
static void random_step(struct world *world)
{
    history_begin(world->history, "Random", (uint64_t)(rand() % 3));
    for (int i = rand() % 4; i >= 0; i--) {
        const int kind = rand() % 8, spline = any(world->document->spline_count);
        if (kind == 0) edit_random_rig(world, any(world->document->rig_count));
        if (kind == 1) edit_random_spline(world, spline);
        if (kind == 2 || kind == 3) edit_random_parameter(world, spline);
        if (kind > 3) edit_random_knot(world, spline);
        if (rand() % 8 == 0) history_restart(world->history);
    }
    history_end(world->history);
    for (int i = rand() % 6 - 3; i > 0; i--) history_undo(world->history);
    for (int i = rand() % 6 - 3; i > 0; i--) history_redo(world->history);
}

/// Whatever was done with splines, knots, rigs and timing: undo all gives the first document byte by byte, redo all the last; all between
/// holds what every document does, and loads as it is saved.
TEST(test_random_walks)
{
    for (unsigned seed = 1; seed <= 24; seed++) {
        struct world world;
        srand(seed);
        world_open(&world);
        const char *first = world_print(&world);
        for (int i = 0; i < 300; i++) {
            random_step(&world);
            assert_invariants(world.document);
            if (i % 10 == 0) assert_loads_again(world.document);
        }
        while (history_redo(world.history)) continue;
        const char *last = world_print(&world);
        assert_string_not_equal(last, first);
        assert_true(world_undo_all(&world) > 20);
        assert_document(&world, first);
        while (history_redo(world.history)) continue;
        assert_document(&world, last);
        world_close(&world);
    }
}

/// More than the history may keep: the oldest steps go, the rest still leads back and forth.
WORLD_TEST(test_history_is_bounded, world_open(world))
{
    enum { STEPS = 3000, LIMIT = 100000 };
    history_set_limit(world->history, LIMIT);
    for (int i = 1; i <= STEPS; i++) {
        nudge(world, i, 0);
        assert_true(history_bytes(world->history) <= LIMIT);
        assert_int_equal(history_count(world->history) + history_dropped(world->history), i);
    }
    assert_true(history_bytes(world->history) > LIMIT / 2); // no more is dropped than has to be
    size_t dropped = history_dropped(world->history);
    int undone = world_undo_all(world);
    assert_true(undone > 100);
    assert_int_equal(dropped + (size_t)undone, STEPS);
    assert_near(world->document->splines[SWAY]->knots[0].value, STEPS - undone, 0);
    while (history_redo(world->history)) continue;
    assert_near(world->document->splines[SWAY]->knots[0].value, STEPS, 0);
    history_set_limit(world->history, 1);
    nudge(world, -1, 0); // one step is always kept
    assert_int_equal(history_count(world->history), 1);
    assert_true(history_undo(world->history));
    assert_near(world->document->splines[SWAY]->knots[0].value, STEPS, 0);
}

/// What was undone and then written over is counted no longer; a run of nudges counts as what it holds.
WORLD_TEST(test_bytes, world_open(world))
{
    nudge(world, 1, 0);
    size_t one = history_bytes(world->history);
    assert_true(one > 0);
    nudge(world, 2, 0);
    assert_int_equal(history_bytes(world->history), 2 * one);
    assert_true(history_undo(world->history));
    nudge(world, 3, 0);
    assert_int_equal(history_bytes(world->history), 2 * one);
    nudge(world, 4, 9);
    nudge(world, 5, 9);
    assert_int_equal(history_bytes(world->history), 3 * one);
    world_must(world, edit_insert(world, PLUCK, 5, 1));
    size_t before = history_bytes(world->history);
    world_must(world,
               edit_spline_remove(world_edit(world), PLUCK, &world->error)); // is kept, with its knots, for undo
    assert_true(history_bytes(world->history) > before + one + sizeof(struct spline));
    history_clear(world->history, world->document);
    assert_int_equal(history_bytes(world->history), 0);
    assert_int_equal(history_dropped(world->history), 0);
}

/// Any step of the list can be gone to directly, from either side.
WORLD_TEST(test_jump, world_open(world))
{
    const char *first = world_print(world);
    for (int i = 1; i <= 6; i++) nudge(world, i, 0);
    history_mark_saved(world->history);
    assert_false(history_jump(world->history, 6));
    assert_true(history_jump(world->history, 2));
    assert_near(world->document->splines[SWAY]->knots[0].value, 2, 0);
    assert_int_equal(history_done(world->history), 2);
    assert_int_equal(history_count(world->history), 6);
    assert_true(history_step_is_saved(world->history, 6));
    assert_false(history_step_is_saved(world->history, 2));
    assert_true(history_jump(world->history, 5));
    assert_near(world->document->splines[SWAY]->knots[0].value, 5, 0);
    assert_true(history_jump(world->history, 0));
    assert_document(world, first);
    assert_false(history_jump(world->history, 7));
    assert_string_equal(history_label(world->history, 5), "Nudge");
    history_mark_unsaved(world->history);
    for (size_t done = 0; done <= 6; done++) assert_false(history_step_is_saved(world->history, done));
}

/// A whole document may come as one step; what was there before, and what is done to it, goes and comes back with it.
WORLD_TEST(test_another_document, world_open(world))
{
    static const char text[] =
        "{\"about\": \"Another. One.\", \"frames\": [3, 9], \"splines\": [{\"name\": \"only\", "
        "\"knots\": [{\"frame\": 4, \"value\": 1}]}]}";
    world_must(world, edit_insert(world, SWAY, 4, 1));
    history_set_path(world->history, "own.json");
    const char *first = world_print(world);
    struct document *other = document_of_text(text);
    size_t bytes = history_bytes(world->history), whole = document_bytes_beside(world->document, NULL);
    history_begin(world->history, "Open another", 0);
    document_become(world->document, other);
    history_end(world->history);
    assert_null(world->document->path);
    assert_int_equal(world->document->spline_count, 1);
    assert_true(history_bytes(world->history) > bytes + whole);
    world_must(world, edit_insert(world, 0, 6, -1));
    const char *second = world_print(world);
    assert_true(history_undo(world->history));
    assert_true(history_undo(world->history));
    assert_document(world, first);
    assert_string_equal(world->document->path, "own.json");
    assert_true(history_redo(world->history));
    assert_true(history_redo(world->history));
    assert_document(world, second);
}
