/// The curves of documents: solved when something has changed, and then those that follow; poses hold and slopes act as they say.
#include "curve.h"
#include "world.h"

#include "scene/evaluate.h"
#include "scene/warnings.h"

/// A scene under edit, its curves, and who reads joints.
struct solved {
    struct world world;
    struct evaluation evaluation;
    bool is_missing; ///< no joint can be read
    int reads;
};

/// A walk that depends on all that a reader may look at.
static bool read_walk(void *context, const struct document *document, const struct joint_motion *motion,
                      double *samples)
{
    struct solved *s = context;
    const int model = document_find_model(document, motion->model, motion->by_file);
    s->reads++;
    if (s->is_missing || model < 0) return false;
    const char *clip = document->rigs[model]->model.clip;
    for (int i = 0; i < document_samples(document); i++) {
        const double seconds = document_frame(document, i) / document->fps, pace = clip ? (double)strlen(clip) : 0;
        samples[i] = sin(pace * seconds + (double)motion->of) + 0.01 * (double)strlen(motion->joint);
    }
    return true;
}

/// Solves what changed since the last call; how many splines that were.
static long solve(struct solved *s)
{
    evaluation_update(&s->evaluation, s->world.document, false);
    return s->evaluation.solved_splines;
}

static void solved_open(struct solved *s, const char *text)
{
    *s = (struct solved){.evaluation.models = {.follow = read_walk, .context = s, .version = 1}};
    world_open_scene(&s->world, json(text));
    solve(s);
}

static void solved_close(struct solved *s)
{
    evaluation_free(&s->evaluation);
    world_close(&s->world);
}

/// After an edit in words.
static long solve_after(struct solved *s, const char *edit)
{
    world_must(&s->world, world_do(&s->world, edit));
    return solve(s);
}

#define SOLVED_TEST(name, text) TEST_OF(struct solved, s, solved_open(s, text), solved_close(s), name)

// --- what is solved when

/// d follows c in the equilibrium, c follows b in the frequency, b is a cubic whose frequency "follows" a without effect.
static const char chain[] =
    "{'frames': [0, 48], 'splines': [{'name': 'd', 'equilibrium': {'spline': 'c'}, 'frequency': 1, 'start': 'rest'}, "
    "{'name': 'c', 'frequency': {'spline': 'b'}, 'knots': [{'frame': 0, 'value': 0}, {'frame': 20, 'value': 1}]}, "
    "{'name': 'b', 'mode': 'cubic', 'frequency': {'spline': 'a'}, 'knots': [{'frame': 0, 'value': 1}, {'frame': 48, "
    "'value': 2}]}, {'name': 'a', 'mode': 'cubic', 'knots': [{'frame': 9, 'value': 3}]}]}";

SOLVED_TEST(only_followers_are_solved, chain)
{
    static const struct {
        const char *edited; ///< the splines' names
        int solved, solved_as_cubics;
    } rows[] = {{"", 0, 0}, {"d", 1, 1}, {"c", 2, 2}, {"b", 3, 1}, {"a", 1, 1}, {"da", 2, 2}};
    assert_int_equal(s->evaluation.solved_splines, 4);
    assert_int_equal(s->evaluation.solved_samples, 4 * 49);
    assert_int_equal(s->evaluation.solved_knots, 5);
    for (int i = 0; i < 4; i++) assert_int_equal(s->evaluation.status[i], WIGGLY_OK);
    assert_near(s->evaluation.curves[1].total[20], 1, 0);
    assert_near(s->evaluation.curves[0].y[20], 1, 0);
    for (int as_cubics = 0; as_cubics < 2; as_cubics++) {
        const uint64_t revision = s->evaluation.revision;
        evaluation_update(&s->evaluation, s->world.document, as_cubics);
        assert_int_equal(s->evaluation.solved_splines, as_cubics ? 4 : 0); // another look solves all
        assert_int_equal(s->evaluation.revision != revision, as_cubics);
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
            for (const char *c = rows[i].edited; *c; c++)
                document_own_spline(s->world.document,
                                    document_find_spline(s->world.document, (const char[]){*c, '\0'}));
            assert_int_equal(evaluation_is_of(&s->evaluation, s->world.document), i == 0);
            evaluation_update(&s->evaluation, s->world.document, as_cubics);
            const int expected = as_cubics ? rows[i].solved_as_cubics : rows[i].solved;
            if (s->evaluation.solved_splines != expected)
                fail_msg("%s: %ld", rows[i].edited, s->evaluation.solved_splines);
        }
    }
}

SOLVED_TEST(it_fits_another_document, "{'frames': [0, 5], 'splines': [{'name': 'x'}]}")
{
    struct document *large = document_of_text(json(chain));
    evaluation_update(&s->evaluation, large, false);
    assert_int_equal(s->evaluation.solved_splines, 4); // nothing was solved before
    const double *kept = s->evaluation.curves[0].total;
    document_touch(large);
    evaluation_update(&s->evaluation, large, false);
    assert_ptr_equal(s->evaluation.curves[0].total, kept);
    evaluation_update(&s->evaluation, large, false);
    assert_int_equal(s->evaluation.solved_splines, 0);
    assert_int_equal(solve(s), 1);
    struct document *empty = document_create();
    evaluation_update(&s->evaluation, empty, false);
    assert_int_equal(s->evaluation.solved_splines, 0);
    document_destroy(empty);
    document_destroy(large);
}

/// A value that no curve can pass: nothing moves any more, the status says why, and nothing that reads the curve falls over.
SOLVED_TEST(a_value_beyond_reach_is_flat,
            "{'frames': [0, 40], 'splines': [{'name': 'a', 'knots': [{'frame': 0, 'value': "
            "1}, {'frame': 30, 'value': -1.7e308}]}]}")
{
    char sentence[EVALUATION_SENTENCE];
    for (int round = 0; round < 2; round++) {
        assert_int_equal(s->evaluation.status[0], WIGGLY_ERROR_KNOT_NUMBER);
        assert_true(evaluation_sentence(&s->evaluation, 0, sentence));
        assert_non_null(strstr(sentence, "the knot at frame 30: "));
        const wiggly_value value = wiggly_evaluate(&s->evaluation.curves[0], 12.5);
        assert_near(value.y + value.re, 0, 0);
        solve_after(s, "move a 1 30 -1");
        assert_near(s->evaluation.curves[0].total[30], -1, 0);
        assert_false(evaluation_sentence(&s->evaluation, 0, sentence));
        solve_after(s, "move a 1 30 -1.7e308");
    }
}

/// Finds no point.
static bool find_nothing(void *context, const struct evaluation *evaluation, const struct document *document,
                         const struct pin_query *query, pin_pull *c, struct pin_point *point)
{
    (void)context, (void)evaluation, (void)document, (void)query, (void)c, (void)point;
    return false;
}

static void weigh_nothing(void *context, const struct document *document, int rig, const int *splines, int count,
                          double *weights)
{
    (void)context, (void)document, (void)rig, (void)splines, (void)count, (void)weights;
}

/// Where nobody knows where points are, pins are ignored: every curve is the one without them.
SOLVED_TEST(
    pins_of_no_point_are_ignored,
    "{'frames': [0, 40], 'splines': [{'name': 'a', 'frequency': 1, 'knots': [{'frame': 3, 'value': 1}]}, {'name': "
    "'b', 'frequency': 2, 'equilibrium': 1}, {'name': 'c', 'frequency': 3, 'equilibrium': {'spline': 'b'}}], 'rigs': "
    "[{'type': 'tail', 'name': 't', 'channels': [{'spline': 'b'}, {'spline': 'a', 'axis': 'up'}]}]}")
{
    double free_curves[3][41];
    for (int i = 0; i < 3; i++) memcpy(free_curves[i], s->evaluation.curves[i].total, sizeof free_curves[i]);
    assert_int_equal(solve_after(s, "pin t 20 5 0 1 0"), 0);
    s->evaluation.models.find = find_nothing, s->evaluation.models.weigh = weigh_nothing;
    s->evaluation.models.version++;
    assert_int_equal(solve(s), 3); // two in a group and what follows it
    for (int i = 0; i < 3 * 41; i++)
        assert_near(s->evaluation.curves[i / 41].total[i % 41], free_curves[i / 41][i % 41], 1e-12);
    solve_after(s, "set b equilibrium 2");
    assert_near(s->evaluation.curves[2].y[9], s->evaluation.curves[1].total[9], 0);
}

// --- equilibria that follow a joint

static const char walk[] =
    "{'frames': [0, 48], 'substeps': 2, 'splines': [{'name': 'wag', 'frequency': 1.5, 'damping': 0.1, 'knots': "
    "[{'frame': 10, 'value': 2}], 'equilibrium': {'model': 'dog', 'joint': 'hips', 'of': 'across', 'gain': -2.5, "
    "'chain': 'tail'}}, {'name': 'ear', 'start': 'loop', 'frequency': 2, 'damping': 0.2, 'equilibrium': {'model': "
    "'dog.glb', 'joint': 'head', 'of': 'turn'}}, {'name': 'tip', 'frequency': 1, 'damping': 0.3, 'equilibrium': "
    "{'spline': 'wag'}}, {'name': 'alone', 'knots': [{'frame': 3, 'value': 1}]}], 'rigs': [{'type': 'model', 'name': "
    "'dog', 'model': 'dog.glb', 'clip': 'Walk'}, {'type': 'chain', 'name': 'tail', 'model': 'dog', 'from': 'a', "
    "'to': "
    "'b'}]}";

enum { WAG, EAR, TIP, ALONE };

/// Solved by hand, with the same samples as a track: its own motion times the gain.
static void assert_followed(struct solved *s, int index, double gain)
{
    const struct document *document = s->world.document;
    const struct spline *spline = document->splines[index];
    const int count = document_samples(document), reads = s->reads;
    double *track = calloc((size_t)count, sizeof *track), *rows = calloc(5 * (size_t)count, sizeof *rows);
    if (!read_walk(s, document, spline->parameter[PARAMETER_EQUILIBRIUM].motion, track))
        memset(track, 0, (size_t)count * sizeof *track);
    s->reads = reads;
    for (int i = 0; i < count; i++) track[i] *= gain;
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = count;
    desc.step = document_step(document);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++)
        parameter_describe(p, spline->parameter[p].value, p == PARAMETER_EQUILIBRIUM ? track : NULL, &desc);
    wiggly_knot knot = {.stiffness = KNOT_DEFAULT_STIFFNESS};
    desc.knot_count = spline->knot_count;
    desc.knots = &knot;
    if (spline->knot_count > 0) {
        knot.sample = document_sample(document, spline->knots[0].frame);
        knot.value = spline->knots[0].value;
    }
    wiggly_curve curve = curve_in(rows, count);
    curve.omega = NULL;
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(count, 1, &solver), WIGGLY_OK);
    wiggly_set_method(solver, evaluation_method(&s->evaluation));
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    assert_memory_equal(s->evaluation.curves[index].y, curve.y, (size_t)count * sizeof *curve.y);
    assert_memory_equal(s->evaluation.curves[index].total, curve.total, (size_t)count * sizeof *curve.total);
    wiggly_destroy(solver);
    free(track);
    free(rows);
}

/// Each motion is read again only when something that it depends on has changed; then its splines and their followers are solved.
SOLVED_TEST(a_motion_is_read_when_it_has_changed, walk)
{
    static const struct {
        const char *edit; ///< NULL: undo
        int reads, solved;
    } rows[] = {
        {"move alone 0 7 1", 2, 1},
        {"clip dog Gallop", 4, 3}, // wag, its follower, ear
        {NULL, 6, 3},
        {"turn tail 30", 7, 2}, // only wag's goes by the chain
        {"range -10 60 refuse", 9, 4},
        {"follow alone equilibrium dog spine up 3", 10, 1},
        {"follow alone equilibrium dog spine up 4", 10, 1}, // a gain alone reads nothing
        {"follow alone equilibrium dog head turn 1", 11, 1},
        {"track wag equilibrium alone", 11, 2},
        {NULL, 11, 2},
    };
    assert_int_equal(s->reads, 2);
    assert_int_equal(solve(s), 0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!rows[i].edit) assert_true(history_undo(s->world.history));
        const long solved = rows[i].edit ? solve_after(s, rows[i].edit) : solve(s);
        if (solved != rows[i].solved || s->reads != rows[i].reads)
            fail_msg("row %zu, %s: %ld are solved, %d read", i, rows[i].edit, solved, s->reads);
        if (s->world.document->splines[WAG]->parameter[PARAMETER_EQUILIBRIUM].motion) assert_followed(s, WAG, -2.5);
        assert_followed(s, EAR, 1);
        if (i == 6) assert_followed(s, ALONE, 4);
    }
    const wiggly_curve *ear = &s->evaluation.curves[EAR];
    assert_near(ear->y[0], ear->y[ear->samples - 1], 0);
    assert_true(fabs(ear->y[0] - ear->y[1]) > 1e-6);
    assert_true(evaluation_motion(&s->evaluation, WAG) && !evaluation_motion(&s->evaluation, TIP));
}

/// Where its model is missing, or nobody reads joints, a motion stays at 0.
SOLVED_TEST(without_its_joint_it_stays_at_0, walk)
{
    s->is_missing = true;
    assert_int_equal(solve(s), 0);
    s->evaluation.models.version++;
    assert_true(solve(s) > 0);
    assert_followed(s, WAG, -2.5);
    s->evaluation.models = (struct model_source){0};
    solve(s);
    for (int i = 0; i < s->evaluation.samples; i++) assert_near(s->evaluation.curves[EAR].total[i], 0, 0);
}

// --- poses hold every part that lags, whatever is changed later; limits hold beside poses and still knots

/// Two knots, a pose on frame 60, a still knot, and two more knots; members of the spline, and a spline before it.
static const char posed[] =
    "{'wiggly': 2, 'frames': [0, 144], 'splines': [{'name': 'base', 'mode': 'cubic', 'knots': [{'frame': 0, 'value': "
    "0}, {'frame': 70, 'value': 0.5}, {'frame': 144, 'value': -0.2}]}, {'name': 'sway', 'frequency': 1.1, 'damping': "
    "0.1, 'bandwidth': 0.1, %s 'knots': [%s{'frame': 6, 'value': 0.7}, {'frame': 30, 'value': -1, 'im': 0.4}, "
    "{'frame': 60, 'value': 0.6, 'im': -0.8}, {'frame': 85, 'value': 0.2, 'slope': 3}, {'frame': 110, 'value': "
    "-0.5}]}]}";

enum { POSED = 1, POSE_FRAME = 60 };

static const char *const still_knots[] = {"", "{'frame': 46, 'still': true},"};

static void open_posed(struct solved *s, const char *members, int kind)
{
    char text[1200];
    snprintf(text, sizeof text, posed, members, still_knots[kind / 2]);
    *s = (struct solved){.evaluation.solver = kind % 2 ? SOLVER_CHAIN : SOLVER_BAND};
    world_open_scene(&s->world, json(text));
    solve(s);
}

static void measure(const struct solved *s, double parts[3])
{
    static const double lags[] = {0, 60, 150};
    const wiggly_value at = evaluation_at(&s->evaluation, POSED, POSE_FRAME);
    for (int i = 0; i < 3; i++) parts[i] = wiggly_lagged(at, lags[i] * M_PI / 180);
}

TEST(a_pose_holds_every_part_whatever_is_changed)
{
    static const char *const members[] = {
        "",
        "'start': 'loop',",
        "'start': 'rest',",
        "'equilibrium': {'spline': 'base'},",
        "'passive': 'filter', 'equilibrium': {'spline': 'base'},",
        "'variation': {'seed': 3, 'amount': 0.5},",
        "'calm': 0.1,",
        "'limits': [-1.1, 1],",
    };
    static const char *const edits[] = {
        "set sway frequency 1.43",
        "remove sway @6; remove sway @30; remove sway @85; remove sway @110",
        "remove sway @85",
        "move sway @30 30 0.9; move sway @85 85 -0.9",
        "move sway @30 41 -1; move sway @85 66 0.2; move sway @6 17 0.7",
        "move sway @30 59 -1; move sway @85 61 0.2",
    };
    for (size_t n = 0; n < sizeof members / sizeof *members * sizeof edits / sizeof *edits * 4; n++) {
        const char *edit = edits[n / 4 % (sizeof edits / sizeof *edits)],
                   *member = members[n / 4 / (sizeof edits / sizeof *edits)];
        struct solved s;
        double before[3], after[3];
        open_posed(&s, member, (int)n % 4);
        measure(&s, before);
        world_must(&s.world, world_do_all(&s.world, edit));
        solve(&s);
        measure(&s, after);
        for (int i = 0; i < 3; i++) {
            if (!(fabs(after[i] - before[i]) <= 1e-9))
                fail_msg("%s %s, part %d of %zu: off by %g", member, edit, i, n % 4, after[i] - before[i]);
        }
        solved_close(&s);
    }
}

/// Limits only just beyond the knots, which press the curve on either side of poses and still knots.
TEST(limits_hold_beside_poses_and_still_knots)
{
    static const char *const starts[] = {"", "'start': 'loop',", "'start': 'rest',", "'passive': 'filter',"};
    for (int n = 0; n < 4 * 4; n++) {
        char members[100];
        struct solved s;
        snprintf(members, sizeof members, "%s 'limits': [-1.02, 0.72],", starts[n / 4]);
        open_posed(&s, members, n % 4);
        const wiggly_curve *curve = &s.evaluation.curves[POSED];
        int pressed = 0;
        assert_true(s.evaluation.status[POSED] <= WIGGLY_LEVELLED);
        for (int i = 0; i < curve->samples; i++) {
            if (!(curve->total[i] >= -1.02 - 1e-9 && curve->total[i] <= 0.72 + 1e-9))
                fail_msg("%s %d: %g at %d", members, n % 4, curve->total[i], i);
            pressed += curve->total[i] > 0.72 - 1e-9 || curve->total[i] < -1.02 + 1e-9;
        }
        assert_true(pressed > 0); // else this proves nothing
        for (int k = 0; k < s.world.document->splines[POSED]->knot_count; k++) {
            const struct knot *knot = &s.world.document->splines[POSED]->knots[k];
            const int sample = document_sample(s.world.document, knot->frame);
            assert_true(curve->total[sample] == (knot->still ? 0 : knot->value)); // to the bit
            if (knot->has_phase || knot->still) assert_near(curve->im[sample], knot->phase, 1e-9);
        }
        solved_close(&s);
    }
}

// --- what is said of a solved spline

#define STILL(frame) "{'frame': " #frame ", 'still': true}"
#define AT(frame, value) "{'frame': " #frame ", 'value': " #value "}"
#define POSE_AT(frame, value, im) "{'frame': " #frame ", 'value': " #value ", 'im': " #im "}"
#define SLOPE_AT(frame, value) "{'frame': " #frame ", 'value': " #value ", 'slope': 1}"
#define SETTLES_AT(frame, value) "{'frame': " #frame ", 'value': " #value ", 'settles': true}"

/// A spline's members and knots, and all warnings: sentences, and where there is one the remedy, phase, limits and what is left of it.
static const char *const warned[][3] = {
    {"'frequency': 1, 'damping': 0.1", AT(0, 0) "," AT(10, 1) "," AT(17, 1) "," AT(30, 0),
     "Frame 36: the curve swings to 1.81, far beyond the knots around it. (0.707, -0.00557, -1.2 to 1.2; 1.28 left)"},
    {"'frequency': 1, 'damping': 0.1, 'equilibrium': 3", AT(0, 3) "," AT(11, 4) "," AT(13, 2) "," AT(40, 3),
     "Frame 6: the curve swings to 7.32, far beyond the knots around it. (4, 0.00608, 1.8 to 4.2; 2.16 left)"},
    {"'frequency': 1, 'damping': 0.1, 'equilibrium': 3, 'limits': [-9, 9]",
     AT(0, 3) "," AT(11, 4) "," AT(13, 2) "," AT(40, 3), ""},
    {"'frequency': 1, 'damping': 0.1", AT(0, 0) "," POSE_AT(11, 1, 3) "," AT(13, -1) "," AT(40, 0), ""},
    {"'frequency': 1, 'damping': 0.1", AT(0, 0) "," POSE_AT(11, 1, 0.5) "," STILL(14) "," AT(16, -1) "," AT(40, 0),
     "Frame 27: the curve swings to 2.36, far beyond the knots around it. (1, -0.337, -1.2 to 1.2; 1.18 left)"},
    {"'frequency': 1, 'damping': 0.1", AT(0, 0) "," POSE_AT(12, 0.1, 5) "," AT(17, 0.2) "," AT(40, 0),
     "Frame 5: the curve swings to 10.5, far beyond the knots around it. (5, -1.35, -0.23 to 0.23; 1.05 left)"},
    {"'mode': 'real', 'frequency': 1, 'damping': 0.01", AT(0, 0) "," AT(11, 1) "," AT(13, -1) "," AT(40, 0),
     "Frame 6: the curve swings to 3.51, far beyond the knots around it. (1, 0, -1.2 to 1.2; 1.76 left)"},
    {"'frequency': 1, 'damping': 0.1, 'start': 'loop'", AT(3, 0) "," AT(12, 1) "," AT(14, -1),
     "Frame 19: the curve swings to -3.54, far beyond the knots around it. (-1, -0.116, -1.2 to 1.2; 1.77 left)"},
    {"'mode': 'real', 'frequency': 1, 'damping': 0.1",
     POSE_AT(0, 1, 2) "," POSE_AT(10, 0.1, 1) "," SLOPE_AT(11, 0) "," AT(12, 0.1),
     "Frame 0: the pose holds only its value, because only Wiggly splines have a phase. Frame 11: the slope has no "
     "effect: both samples beside it have knots."},
    {"'mode': 'cubic'", AT(0, 0) "," SETTLES_AT(40, 0.1) "," SETTLES_AT(44, 0.2),
     "Frame 40: the knot does not settle, because a Cubic does not swing."},
    {"'frequency': 5.9, 'bandwidth': 0", AT(10, 0.1), ""},
    {"'frequency': 8, 'bandwidth': 0.5", AT(10, 0.1),
     "12 Hz is too close to half the sample rate to keep its shape (the limit is 9.6 Hz). (2, 0, 0 to 0; 1.25 left)"},
    {"'frequency': 2, 'bandwidth': 0.3, 'damping': 0.1", AT(0, 0.1) "," AT(10, 0.1) "," AT(40, 0.1) "," AT(48, 0.1),
     "Frames 10 to 40: the swing drifts, because bandwidth 0.3 is too wide for 2.5 periods. (0.12, 0, 0 to 0; 0 "
     "left)"},
    {"'frequency': 2, 'bandwidth': 0.075, 'damping': 0.1", AT(0, 0.1) "," AT(48, 0.1), ""},
    {"'frequency': 2, 'bandwidth': 0.076, 'damping': 0.1", AT(0, 0.1) "," AT(48, 0.1),
     "Frames 0 to 48: the swing drifts, because bandwidth 0.076 is too wide for 4.0 periods. (0.075, 0, 0 to 0; 0 "
     "left)"},
    {"'frequency': 2, 'bandwidth': 0.3, 'damping': 0.1, 'start': 'loop'", AT(20, 0.1) "," AT(30, 0.1),
     "Frames 30 to 20: the swing drifts, because bandwidth 0.3 is too wide for 3.2 periods. (0.094, 0, 0 to 0; 0 "
     "left)"},
    {"'frequency': 1, 'bandwidth': 0.05, 'damping': 0.1", POSE_AT(0, 0, 1) "," POSE_AT(36, 0, 1),
     "Frames 0 to 36: the poses are 150 degrees out of step, so they break the swing between them. (0, 0, 0 to 0; "
     "29.6 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1",
     POSE_AT(0, 1, 0) "," POSE_AT(36, 0.1, 1) "," POSE_AT(40, 0, 0.2),
     "Frame 18: the curve swings to -2.28, far beyond the knots around it. (-1, -0.244, -1.2 to 1.2; 1.13 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", POSE_AT(0, 0, 0.1) "," POSE_AT(36, 0, 0.1),
     "Frames 0 to 36: the poses are 177 degrees out of step, so they break the swing between them. (0, 0, 0 to 0; "
     "30.8 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", POSE_AT(0, 0, 10) "," POSE_AT(36, 0, 3), ""},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", POSE_AT(0, 1, 1) "," POSE_AT(27, 1, 0.9), ""},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", POSE_AT(0, 0, 1) "," POSE_AT(22, 0, 1), ""},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1, 'equilibrium': 1", POSE_AT(0, 1, 1) "," POSE_AT(36, 1, 1),
     "Frames 0 to 36: the poses are 177 degrees out of step, so they break the swing between them. (0, 0, 0 to 0; "
     "30.8 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1, 'start': 'loop'", POSE_AT(0, 0, 1) "," POSE_AT(12, 0, 1),
     "Frames 12 to 0: the poses are 177 degrees out of step, so they break the swing between them. (0, 0, 0 to 0; "
     "12.8 left)"},
    {"'frequency': 1, 'damping': 0.1, 'wind_up': 0.05", AT(0, 1) "," AT(36, 1),
     "The wind-up is 1.2 samples long at the highest frequency: below two, it is a jerk. (0.09, 0, 0 to 0; 0 left)"},
    {"'frequency': 1, 'damping': 0.1, 'wind_up': 0.09", AT(0, 1) "," AT(36, 1), ""},
    {"'frequency': 0, 'wind_up': 0.5", AT(0, 1) "," AT(36, 1), ""},
    {"'frequency': 1, 'passive': 'filter', 'wind_up': 0.5", AT(0, 1) "," AT(36, 1),
     "The wind-up has no effect: the paper's filter has none."},
};

static void say_all(const struct solved *s, char said[512])
{
    static struct warnings found;
    found.count = 0;
    said[0] = '\0';
    warnings_add(s->world.document, &s->evaluation, 0, &found);
    for (int i = 0; i < found.count; i++) {
        const struct warning *w = &found.list[i];
        char sentence[WARNING_SENTENCE], numbers[100] = "";
        const bool is_left = w->kind == WARNING_FAR || w->kind == WARNING_RATE || w->kind == WARNING_FORCED;
        const double left = is_left ? warning_left(w, s->world.document, &s->evaluation) : 0;
        warning_say(w, sentence);
        if (is_left || w->remedy > 0)
            snprintf(numbers, sizeof numbers, " (%.3g, %.3g, %.3g to %.3g; %.3g left)", w->remedy, w->phase, w->low,
                     w->high, left);
        snprintf(said + strlen(said), 512 - strlen(said), "%s%s%s", i > 0 ? " " : "", sentence, numbers);
    }
}

TEST(what_is_warned_of)
{
    for (size_t i = 0; i < sizeof warned / sizeof *warned; i++) {
        struct solved s;
        char text[1024], said[512];
        snprintf(text, sizeof text, "{'frames': [0, 48], 'splines': [{'name': 'x', %s, 'knots': [%s]}]}",
                 warned[i][0], warned[i][1]);
        solved_open(&s, text);
        say_all(&s, said);
        if (strcmp(said, warned[i][2]) != 0) fail_msg("%s [%s]: %s", warned[i][0], warned[i][1], said);
        solved_close(&s);
    }
}

// --- slopes without effect: said of just those that change nothing when the scene is solved with another slope

/// A spline with one slope, %g; `knot` is its index.
static const struct idle {
    const char *spline, *knots;
    int knot;
    bool is_idle;
} idles[] = {
#define COMPLEX "'frequency': 1, 'damping': 0.1"
#define REAL "'mode': 'real', " COMPLEX
#define CUBIC "'mode': 'cubic'"
#define FILTER ", 'passive': 'filter'"
#define ROUND ", 'start': 'loop'"
#define REST ", 'start': 'rest'"
#define VALUE(frame) "{'frame': " #frame ", 'value': 0.5}"
#define SLOPE(frame) "{'frame': " #frame ", 'value': 0.3, 'slope': %g}"
#define POSE(frame) "{'frame': " #frame ", 'value': 0.5, 'im': 0.2}"
#define POSE_SLOPE(frame) "{'frame': " #frame ", 'value': 0.3, 'im': 0.4, 'slope': %g}"
    // between two neighbours
    {REAL, VALUE(9) "," SLOPE(10) "," VALUE(11), 1, true},
    {REAL, VALUE(9) "," SLOPE(10) "," STILL(11), 1, true},
    {REAL, VALUE(8) "," SLOPE(10) "," VALUE(11), 1, false},
    {CUBIC, VALUE(9) "," SLOPE(10) "," VALUE(11), 1, true},
    {CUBIC, VALUE(9) "," SLOPE(10) "," VALUE(12), 1, false},
    {COMPLEX, VALUE(9) "," SLOPE(10) "," VALUE(11), 1, false},
    {COMPLEX, POSE(9) "," SLOPE(10) "," POSE(11), 1, false},
    {COMPLEX, POSE(9) "," POSE_SLOPE(10) "," POSE(11), 1, true},
    {COMPLEX, POSE(9) "," POSE_SLOPE(10) "," VALUE(11) "," VALUE(20), 1, false},
    {COMPLEX, STILL(9) "," POSE_SLOPE(10) "," POSE(11), 1, true},
    {COMPLEX, POSE(9) "," POSE_SLOPE(10) "," STILL(11), 1, true},
    // at the ends, where one side is there
    {REAL, SLOPE(10) "," VALUE(11) "," VALUE(20), 0, true},
    {REAL, SLOPE(10) "," VALUE(12), 0, false},
    {REAL REST, SLOPE(10) "," VALUE(11), 0, false},
    {REAL, VALUE(3) "," VALUE(29) "," SLOPE(30), 2, true},
    {CUBIC, VALUE(3) "," VALUE(28) "," SLOPE(30), 2, false},
    {CUBIC, VALUE(3) "," VALUE(9) "," SLOPE(10), 2, false},
    {COMPLEX, POSE_SLOPE(10) "," POSE(11) "," VALUE(20), 0, true},
    {COMPLEX, POSE_SLOPE(10) "," POSE(12), 0, false},
    // the last one of complex mode, with and without a motion of its own after it
    {COMPLEX, VALUE(3) "," POSE_SLOPE(10), 1, true},
    {COMPLEX, POSE_SLOPE(10), 0, true},
    {COMPLEX, VALUE(3) "," POSE_SLOPE(30), 1, true},
    {COMPLEX, VALUE(3) "," SLOPE(10), 1, false},
    {"'frequency': 1, 'damping': 0.97", VALUE(3) "," POSE_SLOPE(10), 1, false},
    {"'frequency': 0", VALUE(3) "," POSE_SLOPE(10), 1, false},
    {REAL, VALUE(3) "," SLOPE(10), 1, false},
    // loops, around the seam
    {REAL ROUND, VALUE(1) "," VALUE(12) "," SLOPE(29), 2, false},
    {REAL ROUND, VALUE(0) "," VALUE(28) "," SLOPE(29), 2, true},
    {REAL ROUND, SLOPE(0) "," VALUE(1) "," VALUE(29), 0, true},
    {COMPLEX ROUND, POSE_SLOPE(0) "," POSE(1) "," POSE(29), 0, true},
    {COMPLEX ROUND, POSE_SLOPE(0) "," POSE(1) "," VALUE(29), 0, false},
    {COMPLEX ROUND, VALUE(3) "," POSE_SLOPE(10), 1, false},
    // the filter sees the next sample alone
    {REAL FILTER, SLOPE(10) "," VALUE(11) "," VALUE(20), 0, true},
    {COMPLEX FILTER, VALUE(3) "," SLOPE(10) "," VALUE(11), 1, true},
    {COMPLEX FILTER, POSE(9) "," POSE_SLOPE(10), 1, false},
    {REAL FILTER, VALUE(3) "," VALUE(29) "," SLOPE(30), 2, true},
    {REAL FILTER ROUND, VALUE(0) "," VALUE(12) "," SLOPE(29), 2, true},
    {REAL FILTER ROUND, VALUE(1) "," VALUE(12) "," SLOPE(29), 2, false},
    // a domain too short for slopes
    {REAL, SLOPE(29), 0, true},
    {COMPLEX, SLOPE(29), 0, true},
    {COMPLEX, VALUE(20) "," SLOPE(29), 1, false},
};

/// How far the curves of two slopes are apart; and the first document.
static double change(const struct idle *idle, struct document **level)
{
    struct evaluation solved[2] = {{0}, {0}};
    struct document *documents[2];
    double most = 0;
    for (int i = 0; i < 2; i++) {
        char knots[512], text[1024];
        snprintf(knots, sizeof knots, idle->knots, i * 3.0); // NOLINT: a format of the table above
        snprintf(text, sizeof text, "{'wiggly': 2, 'frames': [0, 30], 'splines': [{'name': 'x', %s, 'knots': [%s]}]}",
                 idle->spline, knots);
        documents[i] = document_of_text(json(text));
        evaluation_update(&solved[i], documents[i], false);
    }
    const wiggly_curve *a = &solved[0].curves[0], *b = &solved[1].curves[0];
    for (int i = 0; i < a->samples; i++)
        most = fmax(most, fmax(fabs(a->re[i] - b->re[i]), fabs(a->im[i] - b->im[i])));
    for (int i = 0; i < 2; i++) evaluation_free(&solved[i]);
    document_destroy(documents[1]);
    *level = documents[0];
    return most;
}

TEST(a_slope_is_idle_where_another_one_changes_nothing)
{
    for (size_t n = 0; n < sizeof idles / sizeof *idles; n++) {
        struct document *document;
        const double moved = change(&idles[n], &document);
        const char *why = knot_idle_slope(document, 0, idles[n].knot);
        if (idles[n].is_idle != (moved < 1e-9) || idles[n].is_idle != (why != NULL))
            fail_msg("%s [%s]: the curve moves by %g, and it is said: %s", idles[n].spline, idles[n].knots, moved,
                     why ? why : "nothing");
        document_destroy(document);
    }
}

/// Where a track decides how the motion goes on, nothing is said.
SOLVED_TEST(
    an_unknown_end_is_not_warned_of,
    "{'frames': [0, 30], 'splines': [{'name': 'pace', 'mode': 'cubic'}, {'name': 'x', 'frequency': {'spline': "
    "'pace'}, 'knots': [{'frame': 3, 'value': 1}, {'frame': 9, 'value': 1, 'im': 0, 'slope': 1}]}]}")
{
    assert_null(knot_idle_slope(s->world.document, 1, 1));
}
