/// Long documents, edited as at a window: what is looked at is right in the frame of the edit, and once the thread is done every
/// row is wiggly_solve()'s, bit for bit, whatever was edited while it worked.
#include "inside.h"
#include "session.h"

#include "scene/edit.h"
#include "scene/extremes.h"
#include "scene/storage.h"
#include "spline/stop.h"
#include <stdio.h>
#include <stdlib.h>
#include <threads.h>

enum { LONG_SAMPLES = 700001, ROWS_COMPARED = 5 };

static int below(uint64_t *seed, int count)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (int)((*seed >> 33) % (uint64_t)count);
}

static double number(uint64_t *seed) { return below(seed, 2001) / 1000.0 - 1; }

/// A scene of one spline with a knot every 12 frames of 10 samples.
static char *long_scene(int samples)
{
    int frames = (samples - 1) / 10;
    size_t size = 400 + (size_t)(frames / 12 + 1) * 64, at = 0;
    char *text = malloc(size);
    assert_non_null(text);
    uint64_t seed = 7;
    at += (size_t)snprintf(
        text, size,
        "{ \"wiggly\": 1, \"fps\": 24, \"substeps\": 10, \"frames\": [0, %d], \"splines\": [ { \"name\": "
        "\"long\", \"mode\": \"complex\", \"frequency\": 1.5, \"damping\": 0.1, \"bandwidth\": 0.1, "
        "\"knots\": [ { \"frame\": 6, \"value\": 0 }",
        frames);
    for (int f = 12; f < frames; f += 12) {
        at += (size_t)snprintf(text + at, size - at, ", { \"frame\": %d, \"value\": %.3f }", f, number(&seed));
    }
    snprintf(text + at, size - at, " ] } ] }");
    return text;
}

/// Two splines, the second following the first by its frequency and equilibrium, which is solved in the band; %d: frames of 10
/// samples.
static const char *const followed =
    "{ \"wiggly\": 1, \"fps\": 24, \"substeps\": 10, \"frames\": [0, %d], \"splines\": ["
    "{ \"name\": \"leader\", \"mode\": \"real\", \"frequency\": 1, \"damping\": 0.2, "
    "\"knots\": [ { \"frame\": 0, \"value\": 1 }, { \"frame\": 600, \"value\": 2 }, "
    "{ \"frame\": 1100, \"value\": 1 } ] },"
    "{ \"name\": \"follower\", \"mode\": \"complex\", \"frequency\": { \"spline\": "
    "\"leader\" }, \"equilibrium\": { \"spline\": \"leader\" }, "
    "\"knots\": [ { \"frame\": 10, \"value\": 0 }, { \"frame\": 400, \"value\": 1 }, "
    "{ \"frame\": 900, \"value\": -1 } ] } ] }";

static void open_threaded(struct session *s, const char *scene)
{
    session_open(s, scene);
    s->table.threaded = true;
    assert_true(background_serves(s->document, WIGGLY_CHAIN));
    session_frame(s);
}

static void settle(struct session *s)
{
    struct focus focus = editor_focus(s->editor, s->document);
    background_settle(&s->table.evaluation, s->document, &focus);
    assert_false(s->table.evaluation.stale);
}

static void solve_whole(const struct session *s, struct evaluation *whole)
{
    *whole = (struct evaluation){.method = s->table.evaluation.method};
    assert_true(evaluation_resize(whole, s->document, NULL));
    evaluation_update(whole, s->document, NULL, s->table.solved_cubic);
}

static void assert_same_bits(const struct session *s)
{
    struct evaluation whole;
    solve_whole(s, &whole);
    for (int i = 0; i < whole.count; i++) {
        const wiggly_curve *a = &s->table.evaluation.curves[i], *b = &whole.curves[i];
        const double *rows[ROWS_COMPARED][2] = {
            {a->total, b->total}, {a->y, b->y}, {a->re, b->re}, {a->im, b->im}, {a->omega, b->omega}};
        for (int r = 0; r < ROWS_COMPARED; r++) {
            assert_memory_equal(rows[r][0], rows[r][1], sizeof(double) * (size_t)whole.samples);
        }
        assert_int_equal(s->table.evaluation.status[i], whole.status[i]);
        assert_int_equal(a->first, b->first);
        assert_int_equal(evaluation_extreme(&s->table.evaluation, i, 5, whole.samples - 7, true),
                         evaluation_extreme(&whole, i, 5, whole.samples - 7, true));
    }
    evaluation_free(&whole);
}

/// What the frame shows of the active spline, against a whole solve of the document.
static void assert_focus_exact(const struct session *s, const struct evaluation *whole)
{
    struct focus focus = editor_focus(s->editor, s->document);
    for (int i = focus.first; i < focus.first + focus.count; i++) {
        assert_near(s->table.evaluation.curves[focus.spline].total[i], whole->curves[focus.spline].total[i], 1e-9);
        assert_near(s->table.evaluation.curves[focus.spline].im[i], whole->curves[focus.spline].im[i], 1e-9);
        assert_near(s->table.evaluation.curves[focus.spline].re[i], whole->curves[focus.spline].re[i], 1e-9);
    }
}

static void change(struct session *s, struct edit edit)
{
    struct error error = {0};
    history_begin(s->history, "test", 0);
    if (!history_apply(s->history, s->document, &edit, &error)) fail_msg("%s", error.text);
    history_end(s->history);
}

enum { FIRST_SHOWN = 60000, KNOT_SHOWN = 60012 / 12 };

static void open_long(struct session *s)
{
    char *scene = long_scene(LONG_SAMPLES);
    open_threaded(s, scene);
    free(scene);
    s->editor->curves->view.frame0 = FIRST_SHOWN;
    s->editor->curves->view.frame1 = FIRST_SHOWN + 100;
    session_frame(s);
    settle(s);
}

static void a_dragged_knot_is_seen_at_once(void **state)
{
    (void)state;
    struct session s;
    open_long(&s);
    char knot[64];
    snprintf(knot, sizeof knot, "knot(long,%d)", KNOT_SHOWN);
    session_point(&s, knot);
    session_press(&s, BUTTON_LEFT, 1);
    for (int step = 0; step < 8; step++) {
        session_drag(&s, 3, 7, 1);
        assert_true(s.table.evaluation.stale);
        struct evaluation whole;
        solve_whole(&s, &whole);
        assert_focus_exact(&s, &whole);
        evaluation_free(&whole);
    }
    double value = s.document->splines[0].knots[KNOT_SHOWN].value;
    assert_true(s.table.evaluation.curves[0]
                    .total[document_sample(s.document, s.document->splines[0].knots[KNOT_SHOWN].frame)] == value);
    session_release(&s, BUTTON_LEFT);
    settle(&s);
    assert_same_bits(&s);
    session_key(&s, 'Z', MOD_CTRL);
    settle(&s);
    assert_same_bits(&s);
    session_close(&s);
}

static struct edit slider(double frequency)
{
    return (struct edit){.kind = EDIT_PARAMETER, .parameter = PARAMETER_FREQUENCY, .param = param_number(frequency)};
}

static struct edit moved(const struct session *s, int knot, double frames, double by)
{
    struct edit edit = {.kind = EDIT_KNOT_SET, .knot = s->document->splines[0].knots[knot]};
    edit.knot.frame += frames;
    edit.knot.value += by;
    return edit;
}

/// The band has no takes, and a switch while the thread is at work ends in the chosen one's rows.
static void the_band_solves_all_whole(void **state)
{
    (void)state;
    struct session s;
    open_long(&s);
    editor_set_method(s.editor, WIGGLY_BAND);
    session_frame(&s);
    assert_true(s.table.evaluation.stale);
    settle(&s);
    assert_same_bits(&s);
    uint64_t revision = s.table.evaluation.revision;
    change(&s, moved(&s, KNOT_SHOWN, 0, 0.5));
    session_frame(&s);
    assert_true(s.table.evaluation.stale && s.table.evaluation.revision == revision); // nothing was read from a take
    for (int turn = 0; turn < 3; turn++) {
        editor_set_method(s.editor, turn % 2 == 0 ? WIGGLY_CHAIN : WIGGLY_BAND);
        session_frame(&s);
    }
    settle(&s);
    assert_int_equal(s.table.evaluation.method, WIGGLY_CHAIN);
    assert_same_bits(&s);
    session_close(&s);
}

static void newer_edits_come_before_older_ones_are_solved(void **state)
{
    (void)state;
    struct session s;
    open_long(&s);
    for (int i = 0; i < 10; i++) {
        change(&s, slider(1 + 0.1 * i));
        session_frame(&s);
    }
    settle(&s);
    assert_same_bits(&s);
    change(&s, moved(&s, 4000, 0, 0.5)); // a drag after a slider, then a slider before the thread is done
    session_frame(&s);
    change(&s, slider(2));
    session_frame(&s);
    change(&s, moved(&s, 4001, 0.5, 0.25));
    session_frame(&s);
    settle(&s);
    assert_same_bits(&s);
    session_close(&s);
}

static void what_a_take_cannot_is_solved_whole(void **state)
{
    (void)state;
    struct session s;
    open_long(&s);
    change(&s, moved(&s, 0, -3, 0.5)); // the first knot in time
    session_frame(&s);
    settle(&s);
    assert_same_bits(&s);
    change(&s, moved(&s, 500, 11.9, 0)); // beside the next one
    session_frame(&s);
    settle(&s);
    assert_same_bits(&s);
    change(&s, (struct edit){.kind = EDIT_KNOT_REMOVE, .knot = s.document->splines[0].knots[700]});
    session_frame(&s);
    change(&s, moved(&s, 700, 0, 1));
    session_frame(&s);
    settle(&s);
    assert_same_bits(&s);
    session_close(&s);
}

static void ends_with_the_thread_at_work(void **state)
{
    (void)state;
    struct session s;
    open_long(&s);
    change(&s, slider(3));
    session_frame(&s);
    change(&s, (struct edit){.kind = EDIT_RANGE, .first = 0, .last = 60000, .fit = RANGE_TRIM});
    session_frame(&s); // other rows while the old ones are being written
    settle(&s);
    assert_same_bits(&s);
    change(&s, slider(2));
    session_frame(&s);
    session_close(&s);
}

static void edit_somehow(struct session *s, uint64_t *seed)
{
    int spline = below(seed, 2), knot = below(seed, s->document->splines[spline].knot_count);
    struct edit edit = {.kind = EDIT_KNOT_SET, .spline = spline, .knot = s->document->splines[spline].knots[knot]};
    edit.knot.value += 0.1 * number(seed);
    switch (below(seed, 5)) {
    case 0:
        edit.kind = EDIT_PARAMETER;
        edit.parameter = PARAMETER_DAMPING;
        edit.param = param_number(0.2 + 0.1 * number(seed));
        break;
    case 1:
        edit.kind = EDIT_KNOT_INSERT;
        edit.knot.id = 0;
        edit.knot.frame = 150 + 10 * (double)history_count(s->history) + spline;
        break;
    default:
        break;
    }
    change(s, edit);
}

static void followers_catch_up(void **state)
{
    (void)state;
    struct session s;
    uint64_t seed = 11;
    char scene[1000];
    snprintf(scene, sizeof scene, followed, 1200);
    open_threaded(&s, scene);
    for (int round = 0; round < 6; round++) {
        for (int i = 0; i < 5; i++) {
            edit_somehow(&s, &seed);
            session_frame(&s);
        }
        if (round == 3) session_key(&s, 'V', 0);
        settle(&s);
        session_frame(&s);
        assert_same_bits(&s);
    }
    session_close(&s);
}

/// Frames go on for longer than a solve is worth waiting for, then the next edit has it stopped.
static void a_slow_solve_is_dropped_for_a_newer_edit(void **state)
{
    (void)state;
    struct session s;
    char scene[1000];
    snprintf(scene, sizeof scene, followed, 15000);
    open_threaded(&s, scene);
    for (int i = 0; i < 3; i++) {
        struct edit edit = slider(0.1 + 0.01 * i);
        edit.spline = i == 2 ? 1 : 0;
        edit.parameter = PARAMETER_DAMPING;
        change(&s, edit);
        for (int frame = 0; frame < 12; frame++) {
            session_frame(&s);
            thrd_sleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
        }
    }
    settle(&s);
    assert_same_bits(&s);
    change(&s, (struct edit){.kind = EDIT_PARAMETER, .parameter = PARAMETER_DAMPING, .param = param_number(0.3)});
    for (int frame = 0; frame < 5; frame++) session_frame(&s);
    session_close(&s); // the follower may take as long as it wants
}

static void a_stopped_solver_is_as_good_as_new(void **state)
{
    (void)state;
    enum { SAMPLES = 5000 };
    static double numbers[4][SAMPLES][5];
    double *track = numbers[3][0];
    for (int i = 0; i < SAMPLES; i++) track[i] = 1 + 0.5 * i / SAMPLES;
    const wiggly_knot knots[] = {{.sample = 0, .value = 1}, {.sample = 3000, .value = -1}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES;
    desc.frequency.track = track;
    desc.knots = knots;
    desc.knot_count = 2;
    wiggly_solver *solver = NULL;
    solver_stop stop = {.wanted = true};
    assert_int_equal(wiggly_create(SAMPLES, 2, &solver), WIGGLY_OK);
    for (int i = 0; i < 3; i++) {
        wiggly_curve curve;
        storage_place(&curve, numbers[i][0], SAMPLES);
        solver_watch(solver, i == 1 ? &stop : NULL);
        wiggly_status status = wiggly_solve(solver, &desc, &curve);
        assert_true((status == WIGGLY_OK) == (i != 1));
    }
    assert_true(stop.noticed);
    assert_memory_equal(numbers[0], numbers[2], sizeof numbers[0]);
    wiggly_destroy(solver);
}

static void extremes_are_those_of_a_plain_search(void **state)
{
    (void)state;
    enum { COUNT = 5000, BLOCKS = (COUNT + EXTREMES_BLOCK - 1) / EXTREMES_BLOCK };
    static double numbers[COUNT];
    double low[BLOCKS], high[BLOCKS];
    struct extremes extremes = {low, high}, none = {0};
    uint64_t seed = 3;
    assert_int_equal(extremes_blocks(COUNT), BLOCKS);
    for (int i = 0; i < COUNT; i++) numbers[i] = below(&seed, 400);
    extremes_update(&extremes, numbers, COUNT, 0, COUNT);
    for (int n = 0; n < 500; n++) {
        int at = below(&seed, COUNT), first = below(&seed, COUNT), last = first + below(&seed, COUNT - first);
        numbers[at] = below(&seed, 400);
        extremes_update(&extremes, numbers, COUNT, at, 1);
        for (int highest = 0; highest < 2; highest++) {
            assert_int_equal(extremes_find(&extremes, numbers, first, last, highest),
                             extremes_find(&none, numbers, first, last, highest));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dragged_knot_is_seen_at_once),
        cmocka_unit_test(the_band_solves_all_whole),
        cmocka_unit_test(newer_edits_come_before_older_ones_are_solved),
        cmocka_unit_test(what_a_take_cannot_is_solved_whole),
        cmocka_unit_test(ends_with_the_thread_at_work),
        cmocka_unit_test(followers_catch_up),
        cmocka_unit_test(a_slow_solve_is_dropped_for_a_newer_edit),
        cmocka_unit_test(a_stopped_solver_is_as_good_as_new),
        cmocka_unit_test(extremes_are_those_of_a_plain_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
