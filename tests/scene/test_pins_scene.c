/// Pins of whole scenes: points of characters, tails and chains are where they must be, whatever was edited before.
#include "stand.h"
#include "temporary.h"

static struct document *document_of(struct stand *stand) { return stand->opened.document; }

/// A vertex moves as far as x, however far: one round of solving is enough for its pins.
STAND_TEST(a_characters_point_moves_by_its_pull_however_far, stand_open(stand, "assets/scenes/character.json"))
{
    pin_pull c[64];
    opened_solve(&stand->opened, SOLVER_BY_LENGTH);
    const int sample = document_sample(document_of(stand), 30);
    const struct pin_point near = stand_find(stand, 0, 100, 30, c);
    stand->opened.evaluation.curves[0].re[sample] += 1000;
    const struct pin_point far = stand_find(stand, 0, 100, 30, NULL);
    assert_true(near.is_linear && far.is_linear);
    for (int k = 0; k < 3; k++) assert_near(far.at[k] - near.at[k], 1000 * c[0][k][0], 1e-6 * near.size);
}

static double left_of(struct stand *stand, int rig, int pin) { return length_of(stand_left(stand, rig, pin)->way); }

/// c against what small changes of x do.
static void check_pulls(const char *path, int rig, int point, double frame, double step, double tolerance)
{
    struct stand stand = {0};
    stand_open(&stand, path);
    stand_solve(&stand);
    const int sample = document_sample(document_of(&stand), frame);
    pin_pull c[64];
    const struct pin_point at = stand_find(&stand, rig, point, frame, c);
    bool any = false;
    for (int s = 0; s < document_of(&stand)->spline_count; s++) {
        wiggly_curve *curve = &stand.opened.evaluation.curves[s];
        for (int part = 0; part < 2; part++) {
            double *x = part == 0 ? &curve->re[sample] : &curve->im[sample];
            const double before = *x;
            *x = before + step;
            const struct pin_point up = stand_find(&stand, rig, point, frame, NULL);
            *x = before - step;
            const struct pin_point down = stand_find(&stand, rig, point, frame, NULL);
            *x = before;
            for (int k = 0; k < 3; k++) {
                const double seen = (up.at[k] - down.at[k]) / (2 * step);
                const double said = part == 0 ? c[s][k][0] : -c[s][k][1];
                assert_near(said, seen, tolerance * at.size);
                any |= fabs(said) > 0.01 * at.size;
            }
        }
    }
    assert_true(any);
    stand_close(&stand);
}

TEST(test_pulls_are_derivatives)
{
    check_pulls("assets/scenes/tail.json", 0, 23, 30, 1e-4, 1e-6);
    check_pulls("assets/scenes/follow.json", 0, 11, 40, 1e-4, 1e-6);
    check_pulls("assets/scenes/character.json", 0, 100, 30, 1e-2, 1e-9);
    check_pulls("assets/scenes/dog.json", 1, 7, 30, 1e-2, 1e-4);
    check_pulls("assets/scenes/dog.json", 2, 1, 30, 1e-2, 1e-4);
}

static const char four_splines[] =
    "{\"name\": \"up\", \"frequency\": 1.5, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0.2}, "
    "{\"frame\": 20, \"value\": 1}]},"
    "{\"name\": \"side\", \"frequency\": 1, \"damping\": 0.1, \"equilibrium\": 0.3, \"knots\": [{\"frame\": 5, "
    "\"value\": -0.5}]},"
    "{\"name\": \"sway\", \"frequency\": 0.8, \"damping\": 0.1, \"knots\": [{\"frame\": 50, \"value\": 0.1}]},"
    "{\"name\": \"after\", \"frequency\": 2, \"damping\": 0.2, \"equilibrium\": {\"spline\": \"up\"}}";

/// A scene of those and some rigs, which say `%s` for the folder that models are in.
static const char *write_scene(const char *name, const char *rigs)
{
    char folder[1024], filled[2048], text[4096];
    assert_non_null(getcwd(folder, sizeof folder));
    snprintf(filled, sizeof filled, rigs, folder); // NOLINT
    const int size =
        snprintf(text, sizeof text, "{\"frames\": [0, 60], \"splines\": [%s], \"rigs\": [%s]}", four_splines, filled);
    return temporary_file(name, text, (size_t)size);
}

static const char creature_and_tails[] =
    "{\"type\": \"character\", \"name\": \"creature\", \"model\": \"%s/assets/models/creature.glb\", \"position\": "
    "[0.5, 1, -0.25], \"coordinates\": [{\"name\": \"up-3\", \"spline\": \"up\", \"amplitude\": 11, \"lag\": 40}, "
    "{\"name\": \"side-2\", \"spline\": \"side\", \"amplitude\": 4, \"lag\": -10}]},"
    "{\"type\": \"tail\", \"name\": \"shared\", \"joints\": 10, \"position\": [1, 0.5, 0], \"channels\": "
    "[{\"spline\": \"side\", \"gain\": 6}, {\"spline\": \"sway\", \"axis\": \"up\", \"gain\": 7}]},"
    "{\"type\": \"tail\", \"name\": \"own\", \"joints\": 12, \"position\": [0, {\"spline\": \"up\"}, 0], \"rest\": "
    "3, \"channels\": [{\"spline\": \"after\", \"gain\": 7, \"of\": \"displacement\"}]}";

static void open_zoo(struct stand *stand)
{
    stand_open(stand, write_scene("zoo.json", creature_and_tails));
    stand_solve(stand);
}

enum { CREATURE, SHARED, OWN };

/// How freely splines move a point: 1 where equally far in all directions, 0 where some cannot be reached.
static double freedom(const pin_pull *c, const int *splines, int count)
{
    double b[3][3] = {{0}}, trace = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int s = 0; s < count; s++) {
                const double(*of)[2] = c[splines[s]];
                b[i][j] += of[i][0] * of[j][0] + of[i][1] * of[j][1];
            }
        }
        trace += b[i][i] / 3;
    }
    const double det = b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1]) -
                       b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0]) +
                       b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0]);
    return trace > 0 ? det / (trace * trace * trace) : 0;
}

/// The vertex that the splines move most freely of those that they move by at least a few centimetres a unit.
static int free_vertex(struct stand *stand)
{
    const int all[] = {0, 1, 2, 3}, vertices = models_figure(stand->opened.models, 0)->character.vertex_count;
    int freest = 0;
    double most = 0;
    for (int v = 0; v < vertices; v += 3) {
        pin_pull c[64];
        double far = 0;
        stand_find(stand, CREATURE, v, 0, c);
        for (int s = 0; s < 2; s++) {
            for (int k = 0; k < 3; k++) far += c[s][k][0] * c[s][k][0] + c[s][k][1] * c[s][k][1];
        }
        const double freely = freedom(c, all, 4);
        if (far < 0.03 || freely <= most) continue;
        most = freely;
        freest = v;
    }
    if (most < 0.2) fail_msg("the splines hardly move the creature anywhere: %g", most);
    return freest;
}

/// The frame from `from` on at which the splines move a tail's joint most freely.
static int free_frame(struct stand *stand, int joint, int from)
{
    const int all[] = {0, 1};
    int freest = from;
    double most = 0;
    for (int frame = from; frame < document_of(stand)->last_frame; frame++) {
        pin_pull c[64];
        stand_find(stand, 0, joint, frame, c);
        if (freedom(c, all, 2) <= most) continue;
        most = freedom(c, all, 2);
        freest = frame;
    }
    return freest;
}

/// Pins a point where it would be if all splines were `by` away from where they are.
static void pin_near(struct stand *stand, int rig, int point, double frame, double re, double im)
{
    pin_pull c[64];
    struct pin_point at = stand_find(stand, rig, point, frame, c);
    for (int s = 0; s < document_of(stand)->spline_count; s++) {
        for (int k = 0; k < 3; k++) at.at[k] += c[s][k][0] * re - c[s][k][1] * im;
    }
    const struct pin pin = {.frame = frame, .point = point, .to = {at.at[0], at.at[1], at.at[2]}};
    stand_end(stand, edit_pin_add(stand_begin(stand), rig, &pin, NULL));
}

/// Where the stage shows a point.
static void stage_point(const struct stand *stand, int rig, int point, double frame, float at[3])
{
    struct rig_pose pose;
    const struct posing posing = opened_posing(&stand->opened);
    assert_true(rig_pose(&posing, rig, document_sample(stand->opened.document, frame), NULL, &pose));
    if (pose.kind == RIG_CHARACTER) {
        const struct figure *figure = pose.character.figure;
        morph_vertex(figure, &pose.character.morph, point, at, NULL);
        for (int k = 0; k < 3; k++) at[k] += pose.character.position[k] - (k == 1 ? figure->lo[1] : 0);
    } else {
        memcpy(at, pose.strand.matrix[point + 1] + 12, 3 * sizeof *at);
    }
}

/// All pins of a rig are met, also where the stage shows them, and knots as ever.
static void assert_met(struct stand *stand, int rig, double tolerance)
{
    const struct rig *of = document_of(stand)->rigs[rig];
    for (int i = 0; i < of->pin_count; i++) {
        const struct pin_left *left = stand_left(stand, rig, i);
        float at[3];
        if (!(length_of(left->way) <= tolerance * left->size))
            fail_msg("pin %d of %s is off by %g m", i, rig_title(of), length_of(left->way));
        stage_point(stand, rig, of->pins[i].point, of->pins[i].frame, at);
        for (int k = 0; k < 3; k++) assert_near(at[k], of->pins[i].to[k], 1e-5);
    }
    assert_knots_are_hit(stand);
}

/// Solves, and bit by bit it is what a solve from nothing gives.
static void assert_same_as_whole(struct stand *stand)
{
    stand_solve(stand);
    struct evaluation whole = {.models = models_source(stand->opened.models)};
    const struct evaluation *seen = &stand->opened.evaluation;
    evaluation_update(&whole, document_of(stand), false);
    for (int s = 0; s < whole.count; s++) {
        const size_t size = (size_t)whole.samples * sizeof(double);
        assert_memory_equal(whole.curves[s].total, seen->curves[s].total, size);
        assert_memory_equal(whole.curves[s].im, seen->curves[s].im, size);
    }
    evaluation_free(&whole);
}

STAND_TEST(test_a_character_meets_its_pins, open_zoo(stand))
{
    const int vertex = free_vertex(stand);
    pin_near(stand, CREATURE, vertex, 30, 0.4, -0.3);
    pin_near(stand, CREATURE, vertex, 41, -0.5, 0.2);
    stand_solve(stand);
    assert_met(stand, CREATURE, 1e-9);
    assert_same_as_whole(stand);
}

STAND_TEST(test_a_tail_meets_its_pins, stand_open(stand, "assets/scenes/tail.json"))
{
    stand_solve(stand);
    pin_near(stand, 0, 23, 30, 0.2, 0.1);
    pin_near(stand, 0, 23, free_frame(stand, 23, 70), -0.1, 0.1);
    stand_solve(stand);
    assert_met(stand, 0, 1e-6);
    assert_same_as_whole(stand);
}

/// What a pin leaves, and what there was before it.
static double part_left(struct stand *stand, int rig, int point, double frame, double re, double im)
{
    const struct pin_point before = stand_find(stand, rig, point, frame, NULL);
    pin_near(stand, rig, point, frame, re, im);
    stand_solve(stand);
    const double *to = document_of(stand)->rigs[rig]->pins[0].to;
    return left_of(stand, rig, 0) /
           length_of((const double[]){to[0] - before.at[0], to[1] - before.at[1], to[2] - before.at[2]});
}

STAND_TEST(test_a_chain_on_a_clip_is_pinned, stand_open(stand, "assets/scenes/dog.json"))
{
    stand_solve(stand);
    assert_true(part_left(stand, 1, 7, 30, 0.3, 0.1) < 0.3);
    assert_same_as_whole(stand);
    float at[3];
    stage_point(stand, 1, 7, 30, at);
    const struct pin_left *left = stand_left(stand, 1, 0);
    for (int k = 0; k < 3; k++) assert_near(at[k], left->at[k], 1e-6);
}

STAND_TEST(test_a_tail_on_a_moving_base_is_pinned, stand_open(stand, "assets/scenes/follow.json"))
{
    stand_solve(stand);
    assert_true(part_left(stand, 0, 23, 30, 0.1, 0.1) < 0.5);
    assert_same_as_whole(stand);
    struct knot base = document_of(stand)->splines[0]->knots[1];
    base.value = 0.9;
    stand_end(stand, edit_knot_set(stand_begin(stand), 0, &base, NULL));
    assert_same_as_whole(stand); // the pinned splines follow the base by a track, and where it is
}

/// The creature and a tail share a spline; another tail, pinned itself, follows a third that is pinned.
STAND_TEST(test_rigs_that_share_splines, open_zoo(stand))
{
    const double own = stand_find(stand, OWN, 11, 20, NULL).at[1];
    pin_near(stand, CREATURE, free_vertex(stand), 30, 0.4, -0.3);
    pin_near(stand, SHARED, 9, 44, 0.1, 0);
    stand_solve(stand);
    assert_met(stand, CREATURE, 1e-6);
    assert_true(left_of(stand, SHARED, 0) < 0.05);
    const double followed = stand_find(stand, OWN, 11, 20, NULL).at[1];
    assert_true(fabs(followed - own) > 1e-3); // it sees the pinned curve
    pin_near(stand, OWN, 11, 20, 0.3, 0.2);
    assert_same_as_whole(stand);
}

/// Edit number `i` of those below; false after the last.
static bool edit_once(struct stand *stand, int i)
{
    struct document *document = stand_begin(stand);
    struct pin moved = document->rigs[SHARED]->pins ? document->rigs[SHARED]->pins[0] : (struct pin){0};
    struct knot knot = document->splines[0]->knots[1];
    struct angles gain = document->rigs[SHARED]->tail.channels[1].gain;
    struct rig aside = *document->rigs[SHARED];
    static const int pinned[] = {CREATURE, OWN, SHARED};
    moved.to[1] += 0.1;
    moved.frame = 40;
    knot.value = 0.5;
    gain.value[0] = 9;
    aside.tail.position[0] = param_number(0.9);
    bool done = false;
    if (i == 0) done = edit_pin_set(document, SHARED, &moved, NULL);
    if (i == 1) done = edit_angles(document, (struct channel_place){SHARED, 1}, ANGLE_GAIN, &gain, NULL);
    if (i == 2) done = edit_knot_set(document, 0, &knot, NULL);
    if (i == 3) done = edit_rig_set(document, SHARED, &aside, NULL);
    if (i >= 4 && i < 7)
        done = edit_pin_remove(document, pinned[i - 4], document->rigs[pinned[i - 4]]->pins[0].id, NULL);
    history_end(stand->history);
    return done;
}

/// Whatever was edited, undone and looked at in between, the curves are those of the document.
STAND_TEST(test_edits_give_the_same_bits, open_zoo(stand))
{
    struct document *document = document_of(stand);
    pin_near(stand, CREATURE, free_vertex(stand), 30, 0.4, -0.3);
    pin_near(stand, SHARED, 9, 44, 0.1, 0.2);
    pin_near(stand, OWN, 7, 10, 0.2, 0.2);
    stand_solve(stand);
    for (int i = 0; i < 7; i++) {
        assert_true(edit_once(stand, i));
        assert_same_as_whole(stand);
    }
    evaluation_update(&stand->opened.evaluation, document, true);
    while (history_undo(stand->history)) {
        assert_same_as_whole(stand);
    }
    while (history_redo(stand->history)) {
        assert_same_as_whole(stand);
    }
}

TEST(test_a_point_that_the_model_lacks)
{
    struct opened opened = {0};
    const char *path = write_scene(
        "lacks.json",
        "{\"type\": \"character\", \"name\": \"soft\", \"model\": \"%s/assets/models/creature.glb\", "
        "\"coordinates\": [{\"name\": \"up\", \"spline\": \"up\"}], \"pins\": [{\"frame\": 4, \"vertex\": "
        "9999999, \"to\": [0, 0, 0]}]}");
    assert_refusal(opened_read(&opened, path, &error), "soft: expected a vertex from 0 to ");
    assert_refusal(opened_read(&opened, path, &error), " in the pin at frame 4, got 9999999");
}
