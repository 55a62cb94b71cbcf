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
};

static int reads; ///< of motions

/// A walk that depends on all that a reader may look at.
static bool read_walk(const void *context, const struct document *document, const struct joint_motion *motion,
                      const char *coordinate, double *samples)
{
    assert_null(coordinate);
    const struct solved *s = context;
    const int model = document_find_model(document, motion->model);
    reads++;
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
    reads = 0;
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
            "{'frames': [0, 40], 'splines': [{'name': 'a', 'start': 'loop', 'knots': [{'frame': 0, 'value': "
            "1}, {'frame': 30, 'value': -1.7e308}]}]}")
{
    char sentence[EVALUATION_SENTENCE];
    for (int round = 0; round < 2; round++) {
        assert_int_equal(s->evaluation.status[0], WIGGLY_ERROR_KNOT_NUMBER);
        assert_true(evaluation_sentence(&s->evaluation, 0, sentence));
        assert_non_null(strstr(sentence, "the knot at frame 30: "));
        const wiggly_value value = wiggly_evaluate(&s->evaluation.curves[0], 12.5);
        assert_int_equal(s->evaluation.curves[0].start, WIGGLY_FREE);
        assert_near(value.y + value.re, 0, 0);
        solve_after(s, "move a 1 30 -1");
        assert_near(s->evaluation.curves[0].total[30], -1, 0);
        assert_false(evaluation_sentence(&s->evaluation, 0, sentence));
        solve_after(s, "move a 1 30 -1.7e308");
    }
}

/// Knots that settle move the equilibrium; between two samples it is read as y is, and beyond the ends as at them.
SOLVED_TEST(
    settling_knots_move_the_equilibrium,
    "{'frames': [0, 40], 'splines': [{'name': 'a', 'frequency': 1, 'damping': 0.1, 'equilibrium': 3, 'knots': "
    "[{'frame': 0, 'value': 0, 'settles': true}, {'frame': 20, 'value': 1, 'settles': true}]}]}")
{
    double at[42];
    for (int i = 0; i <= 41; i++) at[i] = evaluation_offset(&s->evaluation, s->world.document, 0, i);
    for (int i = 0; i < 40; i++)
        assert_near(evaluation_offset(&s->evaluation, s->world.document, 0, i + 0.25),
                    evaluation_at(&s->evaluation, 0, i + 0.25).y - 3, 1e-12);
    assert_near(at[20], -2, 0.5);
    assert_true(fabs(at[20] - at[0]) > 0.1 && at[41] == at[40]);
    assert_near(evaluation_offset(&s->evaluation, s->world.document, 0, -9), at[0], 0);
    solve_after(s, "settle a 0");
    assert_near(evaluation_offset(&s->evaluation, s->world.document, 0, 20), 0, 0);
}

/// Finds no point.
static bool find_nothing(const void *context, const struct evaluation *evaluation, const struct document *document,
                         const struct pin_query *query, pin_pull *c, struct pin_point *point)
{
    (void)context, (void)evaluation, (void)document, (void)query, (void)c, (void)point;
    return false;
}

static double weigh_nothing(const void *context, const struct document *document, int rig, int spline)
{
    (void)context, (void)document, (void)rig, (void)spline;
    return 0;
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
    const int count = document_samples(document), before = reads;
    double *track = calloc((size_t)count, sizeof *track), *rows = calloc(5 * (size_t)count, sizeof *rows);
    if (!read_walk(s, document, spline->parameter[PARAMETER_EQUILIBRIUM].motion, NULL, track))
        memset(track, 0, (size_t)count * sizeof *track);
    reads = before;
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
    assert_int_equal(reads, 2);
    assert_int_equal(solve(s), 0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!rows[i].edit) assert_true(history_undo(s->world.history));
        const long solved = rows[i].edit ? solve_after(s, rows[i].edit) : solve(s);
        if (solved != rows[i].solved || reads != rows[i].reads)
            fail_msg("row %zu, %s: %ld are solved, %d read", i, rows[i].edit, solved, reads);
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

/// Knots as JSON, of words such as "v10=1 p12=1~3 s14 x20": values, poses, values and poses with a slope (s, q), knots that settle (t) and
/// still ones (x), each at its frame, with value and im.
static void knots_of(const char *words, double slope, char json_text[512])
{
    char list[256], *rest = list, *word, *to = json_text;
    snprintf(list, sizeof list, "%s", words);
    while ((word = strsep(&rest, " "))) {
        const char kind = *word, *value = strchr(word, '='), *im = strchr(word, '~');
        const double standard = kind == 's' || kind == 'q' ? 0.3 : 0.5;
        if (!kind) continue;
        to += sprintf(to, "%s{'frame': %d", to > json_text ? ", " : "", atoi(word + 1));
        if (kind == 'x') to += sprintf(to, ", 'still': true");
        if (kind != 'x') to += sprintf(to, ", 'value': %g", value ? atof(value + 1) : standard);
        if (kind == 'p' || kind == 'q') to += sprintf(to, ", 'im': %g", im ? atof(im + 1) : kind == 'p' ? 0.2 : 0.4);
        if (kind == 's' || kind == 'q') to += sprintf(to, ", 'slope': %g", slope);
        to += sprintf(to, kind == 't' ? ", 'settles': true}" : "}");
    }
}

/// A spline's members, its knots (knots_of()) and all warnings: sentences, the remedy and what is left, and of a far swing phase and limits.
static const char *const warned[][3] = {
    {"'frequency': 1, 'damping': 0.1", "v0=0 v10=1 v17=1 v30=0",
     "Frame 36: the curve swings to 1.81, far beyond the knots around it. (0.707, -0.00557, -1.2 to 1.2; 1.28 left)"},
    {"'frequency': 1, 'damping': 0.1, 'equilibrium': 3", "v0=3 v11=4 v13=2 v40=3",
     "Frame 6: the curve swings to 7.32, far beyond the knots around it. (4, 0.00608, 1.8 to 4.2; 2.16 left)"},
    {"'frequency': 1, 'damping': 0.1, 'equilibrium': 3, 'limits': [-9, 9]", "v0=3 v11=4 v13=2 v40=3", ""},
    {"'frequency': 1, 'damping': 0.1", "v0=0 p11=1~3 v13=-1 v40=0", ""},
    {"'frequency': 1, 'damping': 0.1", "v0=0 p11=1~0.5 x14 v16=-1 v40=0",
     "Frame 27: the curve swings to 2.36, far beyond the knots around it. (1, -0.337, -1.2 to 1.2; 1.18 left)"},
    {"'frequency': 1, 'damping': 0.1", "v0=0 p12=0.1~5 v17=0.2 v40=0",
     "Frame 5: the curve swings to 10.5, far beyond the knots around it. (5, -1.35, -0.23 to 0.23; 1.05 left)"},
    {"'mode': 'real', 'frequency': 1, 'damping': 0.01", "v0=0 v11=1 v13=-1 v40=0",
     "Frame 6: the curve swings to 3.51, far beyond the knots around it. (1, 0, -1.2 to 1.2; 1.76 left)"},
    {"'frequency': 1, 'damping': 0.1, 'start': 'loop'", "v3=0 v12=1 v14=-1",
     "Frame 19: the curve swings to -3.54, far beyond the knots around it. (-1, -0.116, -1.2 to 1.2; 1.77 left)"},
    {"'mode': 'real', 'frequency': 1, 'damping': 0.1", "p0=1~2 p10=0.1~1 s11=0 v12=0.1",
     "Frame 0: the pose holds only its value, because only Wiggly splines have a phase. Frame 11: the slope has no "
     "effect: both samples beside it have knots."},
    {"'mode': 'cubic'", "v0=0 t40=0.1 t44=0.2",
     "Frame 40: the knot does not settle, because a Cubic does not swing."},
    {"'frequency': 5.9, 'bandwidth': 0", "v10=0.1", ""},
    {"'frequency': 8, 'bandwidth': 0.5", "v10=0.1",
     "12 Hz is too close to half the sample rate to keep its shape (the limit is 9.6 Hz). (2; 1.25 left)"},
    {"'frequency': 2, 'bandwidth': 0.3, 'damping': 0.1", "v0=0.1 v10=0.1 v40=0.1 v48=0.1",
     "Frames 10 to 40: the swing drifts, because bandwidth 0.3 is too wide for 2.5 periods. (0.12; 0 left)"},
    {"'frequency': 2, 'bandwidth': 0.075, 'damping': 0.1", "v0=0.1 v48=0.1", ""},
    {"'frequency': 2, 'bandwidth': 0.076, 'damping': 0.1", "v0=0.1 v48=0.1",
     "Frames 0 to 48: the swing drifts, because bandwidth 0.076 is too wide for 4.0 periods. (0.075; 0 left)"},
    {"'frequency': 2, 'bandwidth': 0.3, 'damping': 0.1, 'start': 'loop'", "v20=0.1 v30=0.1",
     "Frames 30 to 20: the swing drifts, because bandwidth 0.3 is too wide for 3.2 periods. (0.094; 0 left)"},
    {"'frequency': 1, 'bandwidth': 0.05, 'damping': 0.1", "p0=0~1 p36=0~1",
     "Frames 0 to 36: the poses are 150 degrees out of step, so they break the swing between them. (0; 29.6 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", "p0=1~0 p36=0.1~1 p40=0~0.2",
     "Frame 18: the curve swings to -2.28, far beyond the knots around it. (-1, -0.244, -1.2 to 1.2; 1.13 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", "p0=0~0.1 p36=0~0.1",
     "Frames 0 to 36: the poses are 177 degrees out of step, so they break the swing between them. (0; 30.8 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", "p0=0~10 p36=0~3", ""},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", "p0=1~1 p27=1~0.9", ""},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1", "p0=0~1 p22=0~1", ""},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1, 'equilibrium': 1", "p0=1~1 p36=1~1",
     "Frames 0 to 36: the poses are 177 degrees out of step, so they break the swing between them. (0; 30.8 left)"},
    {"'frequency': 1, 'bandwidth': 0, 'damping': 0.1, 'start': 'loop'", "p0=0~1 p12=0~1",
     "Frames 12 to 0: the poses are 177 degrees out of step, so they break the swing between them. (0; 12.8 left)"},
    {"'frequency': 1, 'damping': 0.1, 'wind_up': 0.05", "v0=1 v36=1",
     "The wind-up is 1.2 samples long at the highest frequency: below two, it is a jerk. (0.09; 0 left)"},
    {"'frequency': 1, 'damping': 0.1, 'wind_up': 0.09", "v0=1 v36=1", ""},
    {"'frequency': 0, 'wind_up': 0.5", "v0=1 v36=1", ""},
    {"'frequency': 1, 'passive': 'filter', 'wind_up': 0.5", "v0=1 v36=1",
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
        if (is_left || w->remedy > 0) snprintf(numbers, sizeof numbers, " (%.3g; %.3g left)", w->remedy, left);
        if (w->kind == WARNING_FAR)
            snprintf(numbers, sizeof numbers, " (%.3g, %.3g, %.3g to %.3g; %.3g left)", w->remedy, w->phase, w->low,
                     w->high, left);
        snprintf(said + strlen(said), 512 - strlen(said), "%s%s%s", i > 0 ? " " : "", sentence, numbers);
    }
}

TEST(what_is_warned_of)
{
    for (size_t i = 0; i < sizeof warned / sizeof *warned; i++) {
        struct solved s;
        char text[1024], knots[512], said[512];
        knots_of(warned[i][1], 1, knots);
        snprintf(text, sizeof text, "{'frames': [0, 48], 'splines': [{'name': 'x', %s, 'knots': [%s]}]}",
                 warned[i][0], knots);
        solved_open(&s, text);
        say_all(&s, said);
        if (strcmp(said, warned[i][2]) != 0) fail_msg("%s [%s]: %s", warned[i][0], warned[i][1], said);
        solved_close(&s);
    }
}

// --- slopes without effect: said of just those that change nothing when the scene is solved with another slope

/// A spline, knots with a slope that is idle (knots_of(), with | between them), and such where it would change the curve.
static const char *const idles[][3] = {
#define COMPLEX "'frequency': 1, 'damping': 0.1"
#define REAL "'mode': 'real', " COMPLEX
#define FILTER ", 'passive': 'filter'"
#define ROUND ", 'start': 'loop'"
    {REAL, "v9 s10 v11 | v9 s10 x11 | s10 v11 v20 | v3 v29 s30 | s29", "v8 s10 v11 | s10 v12 | v3 s10"},
    {"'mode': 'cubic'", "v9 s10 v11", "v9 s10 v12 | v3 v28 s30 | v3 v9 s10"},
    {COMPLEX, "p9 q10 p11 | x9 q10 p11 | p9 q10 x11 | q10 p11 v20 | v3 q10 | q10 | v3 q30 | s29",
     "v9 s10 v11 | p9 s10 p11 | p9 q10 v11 v20 | q10 p12 | v3 s10 | v20 s29"},
    {REAL ", 'start': 'rest'", "", "s10 v11"},
    {"'frequency': 1, 'damping': 0.97", "", "v3 q10"},
    {"'frequency': 0", "", "v3 q10"},
    {REAL ROUND, "v0 v28 s29 | s0 v1 v29", "v1 v12 s29"},
    {COMPLEX ROUND, "q0 p1 p29", "q0 p1 v29 | v3 q10"},
    {REAL FILTER, "s10 v11 v20 | v3 v29 s30", ""},
    {COMPLEX FILTER, "v3 s10 v11", "p9 q10"},
    {REAL FILTER ROUND, "v0 v12 s29", "v1 v12 s29"},
};

/// How far the curves with two slopes are apart, and what is said of the slope.
static double change(const char *members, const char *words, const char **why)
{
    struct solved s[2];
    double most = 0;
    for (int i = 0; i < 2; i++) {
        char knots[512], text[1024];
        knots_of(words, 3 * i, knots);
        snprintf(text, sizeof text, "{'wiggly': 2, 'frames': [0, 30], 'splines': [{'name': 'x', %s, 'knots': [%s]}]}",
                 members, knots);
        solved_open(&s[i], text);
    }
    const wiggly_curve *a = &s[0].evaluation.curves[0], *b = &s[1].evaluation.curves[0];
    for (int i = 0; i < a->samples; i++)
        most = fmax(most, fmax(fabs(a->re[i] - b->re[i]), fabs(a->im[i] - b->im[i])));
    int sloped = 0;
    while (!s[0].world.document->splines[0]->knots[sloped].has_slope) sloped++;
    *why = knot_idle_slope(s[0].world.document, 0, sloped);
    for (int i = 0; i < 2; i++) solved_close(&s[i]);
    return most;
}

TEST(a_slope_is_idle_where_another_one_changes_nothing)
{
    for (size_t n = 0; n < 2 * sizeof idles / sizeof *idles; n++) {
        const bool is_idle = n % 2 == 0;
        char list[512], *rest = list, *words;
        snprintf(list, sizeof list, "%s", idles[n / 2][is_idle ? 1 : 2]);
        while ((words = strsep(&rest, "|"))) {
            const char *why;
            if (!*words) continue;
            const double moved = change(idles[n / 2][0], words, &why);
            if (is_idle != (moved < 1e-9) || is_idle != (why != NULL))
                fail_msg("%s [%s]: the curve moves by %g, and it is said: %s", idles[n / 2][0], words, moved,
                         why ? why : "nothing");
        }
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
