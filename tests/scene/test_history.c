/// Steps of edits: every one can be taken back and done again.

#include "invariants.h"
#include "world.h"

static void assert_label(const struct world *world, const char *label)
{
    const char *found = history_label(world->history, history_done(world->history) - 1);
    if (!found != !label || (label && strcmp(found, label) != 0)) fail_msg("the last step is %s", found);
}

/// A drag re-applies its edits from the same state each frame, gives an inserted knot the same id again, and is one
/// step.
WORLD_TEST(a_drag_is_one_step, world_open(world))
{
    const char *before = world_print(world);
    unsigned id = 0;
    history_begin(world->history, "Drag", 0);
    for (int frame = 0; frame < 10; frame++) { // in the next one the second knot would land on the third
        history_restart(world->history);
        assert_true(edit_insert(world, SWAY, 2 + frame % 3, frame));
        char move[64];
        snprintf(move, sizeof move, "move sway 2 %d 0", 20 + frame);
        assert_true(world_do(world, move));
        const struct spline *sway = world->document->splines[SWAY];
        const int at = spline_find_knot(world->document, sway, 2 + frame % 3);
        assert_true(at >= 0 && (frame == 0 || sway->knots[at].id == id));
        id = sway->knots[at].id;
    }
    assert_prints(history_before(world->history), before);
    history_end(world->history);
    assert_label(world, "Drag");
    assert_true(history_undo(world->history));
    assert_string_equal(history_label(world->history, history_done(world->history)), "Drag");
    assert_document(world, before);
    assert_false(history_undo(world->history));
}

/// Esc in a drag: nothing is left, not even of the steps that could be done again.
WORLD_TEST(a_cancelled_step_is_none, world_open(world))
{
    world_must(world, world_do(world, "insert sway 5 5"));
    const char *after = world_print(world);
    assert_true(history_undo(world->history));
    history_begin(world->history, "Cancelled", 0);
    assert_true(world_do(world, "insert sway 6 6"));
    history_restart(world->history);
    assert_true(history_is_open(world->history));
    history_end(world->history);
    assert_false(history_is_open(world->history));
    assert_label(world, NULL);
    assert_true(history_redo(world->history));
    assert_document(world, after);
    world_must(world, world_do(world, "move sway 0 0 0")); // what changes nothing is no step either
    assert_false(history_redo(world->history));
    assert_null(history_label(world->history, history_done(world->history)));
    assert_true(history_undo(world->history));
    assert_label(world, NULL);
}

static void nudge(struct world *world, double value, uint64_t merge)
{
    history_begin(world->history, "Nudge", merge);
    struct knot knot = world->document->splines[SWAY]->knots[0];
    knot.value = value;
    assert_true(edit_knot_set(world->document, SWAY, &knot, &world->error));
    history_end(world->history);
}

static double nudged(const struct world *world) { return world->document->splines[SWAY]->knots[0].value; }

/// Nudges, each with the run that it belongs to (- for none), undo (u), redo (r) and saving (s); and how many steps that is.
TEST(nudges_of_a_run_are_one_step)
{
    static const struct {
        const char *what;
        int steps;
    } rows[] = {
        {"aaab--", 4}, {"a", 1}, {"aa", 1}, {"--", 2}, {"aaura", 2}, // what was done again is done
        {"abua", 2},                                                 // an undo ends a run
        {"asa", 2}, // and so does saving: the saved state can be reached again
        {"as-", 2},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct world world;
        world_open(&world);
        const char *before = world_print(&world);
        for (const char *c = rows[i].what; *c; c++) {
            if (*c == 'u') assert_true(history_undo(world.history));
            if (*c == 'r') assert_true(history_redo(world.history));
            if (*c == 's') history_mark_saved(world.history);
            if (!strchr("urs", *c)) nudge(&world, (double)(c - rows[i].what + 1), *c == '-' ? 0 : (uint64_t)*c);
        }
        if (strchr(rows[i].what, 's')) {
            assert_false(history_is_saved(world.history));
            assert_true(history_undo(world.history) && history_is_saved(world.history));
            assert_true(history_redo(world.history));
        }
        const int steps = world_undo_all(&world);
        if (steps != rows[i].steps) fail_msg("%s: %d steps", rows[i].what, steps);
        assert_document(&world, before);
        world_close(&world);
    }
}

WORLD_TEST(the_saved_state_is_known, world_open(world))
{
    assert_true(history_is_saved(world->history));
    world_must(world, world_do(world, "insert sway 5 5"));
    assert_false(history_is_saved(world->history));
    history_mark_saved(world->history);
    world_must(world, world_do(world, "insert sway 6 6"));
    assert_true(history_undo(world->history) && history_is_saved(world->history));
    assert_true(history_undo(world->history) && !history_is_saved(world->history));
    world_must(world, world_do(world, "insert sway 5 5")); // the same document by another way counts as changed
    assert_false(history_is_saved(world->history));
    history_begin(world->history, "Drag", 0);
    history_mark_saved(world->history);
    assert_true(history_is_saved(world->history));
    assert_true(world_do(world, "insert sway 7 7"));
    assert_false(history_is_saved(world->history));
    history_restart(world->history);
    assert_true(history_is_saved(world->history));
    history_end(world->history);
}

WORLD_TEST(the_revision_tells_of_each_change, world_open(world))
{
    uint64_t before = history_revision(world->history);
    world_must(world, world_do(world, "insert sway 5 5"));
    assert_true(history_revision(world->history) > before);
    before = history_revision(world->history);
    assert_true(history_undo(world->history) && history_revision(world->history) > before);
    before = history_revision(world->history);
    assert_true(history_redo(world->history) && history_revision(world->history) > before);
    before = history_revision(world->history);
    assert_true(!history_redo(world->history) && history_revision(world->history) == before);
}

// --- everything at once

/// Edits of a random walk: S is a spline, K a knot or other part, F a frame, V a value, P a parameter, R a rig, N a small number, W a name.
static const char walks[] =
    "insert S F V; insert S F V; insert S F V; insert S F V; insert S F V; insert S F V; insert S F V; "
    "move S K F V; move S K F V; move S K F V; move S K F V; move S K F V; knot S K slope V; "
    "knot S K slope V; knot S K im V; knot S K still N; knot S K settles 1; knot S K stiffness V; "
    "knot S K stiffness V; remove S K; remove S K; set S P V; set S P V; set S P V; track S P S; track S P S; "
    "set S mode N; set S mode N; set S start N; set S low V; set S high V; settle S N; add N - F V; add N W; "
    "copy S; drop S; order S N; name S W; color S N; fps 1N; fps 2N keep; substeps N; range -N 2N refuse; "
    "range N 4N move; range -N 3N trim; tail R S; unrig R; rename R W; joints R N; joints R 1N; "
    "channel R S up total; channel R S N N; unchannel R K; bend R K S up total; bend R K - N N; "
    "angles R K lag V; angles R -1 rest V V V; angles R K gain V V V; place R 0 V; ride R 1 S; "
    "angles R K gain 0:V 0.N:V 1:V; pin R F N V 1 0; repin R K F N V 1 0; unpin R K; length R V";

static int any(int count) { return rand() % (count > 0 ? count : 1); }

static int put_random(const struct document *document, char what, char *to)
{
    static const char *const names[] = {"a", "b", "sway", "t", "e-2"};
    if (what == 'S') return sprintf(to, "%d", any(document->spline_count));
    if (what == 'R') return sprintf(to, "%d", any(document->rig_count));
    if (what == 'K') return sprintf(to, "%d", rand() % 5);
    if (what == 'N') return sprintf(to, "%d", rand() % 9);
    if (what == 'F') return sprintf(to, "%.3f", (rand() % 450 - 30) / 8.0);
    if (what == 'V') return sprintf(to, "%.7f", (rand() % 2 ? 1 : 0.125) * (rand() % 2001 - 1000) / 128.0);
    if (what == 'W') return sprintf(to, "%s", names[rand() % 5]);
    if (what == 'P') return sprintf(to, "%d", rand() % PARAMETER_COUNT);
    return sprintf(to, "%c", what);
}

static void random_edit(const struct document *document, char edit[128])
{
    int count = 1;
    for (const char *c = walks; *c; c++) count += *c == ';';
    const char *from = walks;
    for (int i = any(count); i > 0; i--) from = strchr(from, ';') + 2;
    for (; *from && *from != ';'; from++) edit += put_random(document, *from, edit);
}

/// Some edits, a restart now and then, undo and redo in between.
static void random_step(struct world *world, int done[2])
{
    history_begin(world->history, "Random", (uint64_t)(rand() % 3));
    for (int i = rand() % 4; i >= 0; i--) {
        char edit[128];
        random_edit(world->document, edit);
        done[world_do(world, edit)]++;
        if (rand() % 8 == 0) history_restart(world->history);
    }
    history_end(world->history);
    for (int i = rand() % 6 - 3; i > 0; i--) history_undo(world->history);
    for (int i = rand() % 6 - 3; i > 0; i--) history_redo(world->history);
}

/// Whatever was done with splines, knots, rigs and timing: undo all gives the first document byte by byte, redo all the last; all between
/// holds what every document does, and loads as it is saved.
TEST(random_walks_lead_back)
{
    int done[2] = {0};
    for (unsigned seed = 1; seed <= 24; seed++) {
        struct world world;
        srand(seed);
        world_open(&world);
        const char *first = world_print(&world);
        for (int i = 0; i < 300; i++) {
            random_step(&world, done);
            assert_invariants(world.document);
            if (i % 5 == 0) assert_loads_again(world.document);
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
    if (3 * done[true] < done[true] + done[false])
        fail_msg("of %d edits, only %d are possible", done[0] + done[1], done[1]);
}

// --- how much is kept

/// More than the history may keep: the oldest steps go, the rest still leads back and forth.
WORLD_TEST(the_history_is_bounded, world_open(world))
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
    assert_label(world, NULL);
    assert_near(nudged(world), STEPS - undone, 0);
    while (history_redo(world->history)) continue;
    assert_near(nudged(world), STEPS, 0);
    history_set_limit(world->history, 1);
    nudge(world, -1, 0); // one step is always kept
    assert_int_equal(history_count(world->history), 1);
    assert_true(history_undo(world->history));
    assert_near(nudged(world), STEPS, 0);
}

/// What was undone and then written over is counted no longer; a run of nudges counts as what it holds.
WORLD_TEST(the_bytes_are_of_what_it_holds, world_open(world))
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
    world_must(world, world_do(world, "insert pluck 5 1"));
    size_t before = history_bytes(world->history);
    world_must(world, world_do(world, "drop pluck")); // is kept, with its knots, for undo
    assert_true(history_bytes(world->history) > before + one + sizeof(struct spline));
    history_clear(world->history, world->document);
    assert_int_equal(history_bytes(world->history), 0);
    assert_int_equal(history_dropped(world->history), 0);
    assert_true(history_is_saved(world->history) && history_count(world->history) == 0);
}

/// Any step of the list can be gone to directly, from either side.
WORLD_TEST(any_step_can_be_gone_to, world_open(world))
{
    const char *first = world_print(world);
    for (int i = 1; i <= 6; i++) nudge(world, i, 0);
    history_mark_saved(world->history);
    assert_false(history_jump(world->history, 6));
    assert_true(history_jump(world->history, 2));
    assert_near(nudged(world), 2, 0);
    assert_int_equal(history_done(world->history), 2);
    assert_int_equal(history_count(world->history), 6);
    for (size_t done = 0; done <= 6; done++) assert_int_equal(history_step_is_saved(world->history, done), done == 6);
    assert_true(history_jump(world->history, 5));
    assert_near(nudged(world), 5, 0);
    assert_true(history_jump(world->history, 0));
    assert_document(world, first);
    assert_false(history_jump(world->history, 7));
    assert_string_equal(history_label(world->history, 5), "Nudge");
    history_mark_unsaved(world->history);
    for (size_t done = 0; done <= 6; done++) assert_false(history_step_is_saved(world->history, done));
}

/// A whole document may come as one step; what was there before, and what is done to it, goes and comes back with it.
WORLD_TEST(another_document_is_a_step, world_open(world))
{
    world_must(world, world_do(world, "insert sway 4 1"));
    history_set_path(world->history, "own.json");
    const char *first = world_print(world);
    struct document *other = document_of_text(json("{'about': 'Another. One.', 'frames': [3, 9], 'splines': "
                                                   "[{'name': 'only', 'knots': [{'frame': 4, 'value': 1}]}]}"));
    const size_t bytes = history_bytes(world->history), whole = document_bytes_beside(world->document, NULL);
    history_begin(world->history, "Open another", 0);
    document_become(world->document, other);
    history_end(world->history);
    assert_null(world->document->path);
    assert_int_equal(world->document->spline_count, 1);
    assert_true(history_bytes(world->history) > bytes + whole);
    world_must(world, world_do(world, "insert only 6 -1"));
    const char *second = world_print(world);
    assert_true(history_undo(world->history) && history_undo(world->history));
    assert_document(world, first);
    assert_string_equal(world->document->path, "own.json");
    assert_true(history_redo(world->history) && history_redo(world->history));
    assert_document(world, second);
}
