/// Pins and floors of whole scenes: points of characters, tails and chains are where they must be and no vertex is below its floor, whatever
/// was edited before; and a motion is a continuous function of where a pin is to be.
#include "puppet.h"
#include "stand.h"
#include "temporary.h"
#include "world.h"

static struct document *document_of(const struct stand *stand) { return stand->opened.document; }

/// A scene of those splines and rigs; the text has %s for the folder of models.
static struct stand open_in(const char *models, const char *text)
{
    struct stand stand = {0};
    char folder[PATH_LIMIT], filled[8192];
    if (!realpath(models, folder)) fail_msg("no models");
    snprintf(filled, sizeof filled, json(text), folder); // NOLINT: a format of this file
    stand_open(&stand, temporary_file("stand.json", filled, strlen(filled)));
    stand_solve(&stand);
    return stand;
}

static struct stand open_text(const char *text) { return open_in("assets/models", text); }

/// The same with a creature whose coordinates are curved.
static struct stand open_curved(const char *text)
{
    static const double most[] = {1, 1, 11, 1, 4, 1};
    struct character creature;
    char folder[PATH_LIMIT];
    assert_done(character_read("assets/models/creature.glb", &creature, &error));
    assert_int_equal(creature.coordinate_count, sizeof most / sizeof *most);
    for (int k = 0; k < creature.coordinate_count; k++) puppet_curve(&creature, k, 0.02 / most[k] / most[k], most[k]);
    snprintf(folder, sizeof folder, "%s", temporary_path(""));
    puppet_write(&creature, temporary_path("creature.glb"));
    return open_in(folder, text);
}

static struct stand open_path(const char *path)
{
    struct stand stand = {0};
    stand_open(&stand, path);
    stand_solve(&stand);
    return stand;
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

/// A creature and a tail share a spline; another tail, on a base that moves, follows what moves the creature.
static const char zoo[] =
    "{'frames': [0, 60], 'splines': [{'name': 'up', 'frequency': 1.5, 'damping': 0.1, 'knots': [{'frame': 0, "
    "'value': 0.2}, {'frame': 20, 'value': 1}]}, {'name': 'side', 'frequency': 1, 'damping': 0.1, 'equilibrium': "
    "0.3, 'knots': [{'frame': 5, 'value': -0.5}]}, {'name': 'sway', 'frequency': 0.8, 'damping': 0.1, 'knots': "
    "[{'frame': 50, 'value': 0.1}]}, {'name': 'after', 'frequency': 2, 'damping': 0.2, 'equilibrium': {'spline': "
    "'up'}}, {'name': 'east', 'mode': 'cubic', 'knots': [{'frame': 9, 'value': 0.1}]}, {'name': 'south', 'mode': "
    "'cubic', 'knots': [{'frame': 9, 'value': -0.1}]}], 'rigs': [{'type': 'character', 'name': 'creature', 'model': "
    "'%s/creature.glb', 'position': [0.5, 1, -0.25], 'coordinates': [{'name': 'up-3', 'spline': 'up', 'amplitude': "
    "11, 'lag': 40}, {'name': 'side-2', 'spline': 'side', 'amplitude': 4, 'lag': -10}]}, {'type': 'tail', 'name': "
    "'shared', 'joints': 10, 'position': [1, 0.5, 0], 'channels': [{'spline': 'side', 'gain': 6}, {'spline': 'sway', "
    "'axis': 'up', 'gain': 7}]}, {'type': 'tail', 'name': 'own', 'joints': 12, 'position': [{'spline': 'east'}, "
    "{'spline': 'up'}, {'spline': 'south'}], 'rest': 3, 'channels': [{'spline': 'after', 'gain': 7, 'of': "
    "'displacement'}]}]}";

enum { CREATURE, SHARED, OWN };

/// Where splines move points freely, each in another direction: so of the creature of the zoo, and of the tail's last joint at a frame.
enum { VERTEX = 1677, TIP = 23, FREE_FRAME = 74 };

// --- how splines move points

/// A vertex moves as far as x, however far: one round of solving is enough for its pins.
STAND_TEST(a_characters_point_moves_by_its_pull_however_far, *stand = open_path("assets/scenes/character.json"))
{
    pin_pull c[64];
    const int sample = document_sample(document_of(stand), 30);
    const struct pin_point near = stand_find(stand, 0, 100, 30, c);
    stand->opened.evaluation.curves[0].re[sample] += 1000;
    const struct pin_point far = stand_find(stand, 0, 100, 30, NULL);
    assert_true(near.is_linear && far.is_linear);
    for (int k = 0; k < 3; k++) assert_near(far.at[k] - near.at[k], 1000 * c[0][k][0], 1e-6 * near.size);
}

/// Pulls are what small changes of x do.
TEST(pulls_are_derivatives)
{
    static const struct {
        const char *path;
        int rig, point;
        double frame, step, tolerance;
    } rows[] = {
        {"assets/scenes/tail.json", 0, 23, 30, 1e-4, 1e-6},
        {"assets/scenes/follow.json", 0, 11, 40, 1e-4, 1e-6},
        {"assets/scenes/character.json", 0, 100, 30, 1e-2, 1e-9},
        {"assets/scenes/dog.json", 1, 7, 30, 1e-2, 1e-4},
        {"assets/scenes/dog.json", 2, 1, 30, 1e-2, 1e-4},
        {NULL, CREATURE, VERTEX, 20, 1e-5, 1e-7}, // on a curve, beyond what was seen
        {NULL, CREATURE, VERTEX, 2, 1e-5, 1e-7},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct stand stand = rows[i].path ? open_path(rows[i].path) : open_curved(zoo);
        const int sample = document_sample(document_of(&stand), rows[i].frame),
                  splines = document_of(&stand)->spline_count;
        pin_pull c[64];
        const struct pin_point at = stand_find(&stand, rows[i].rig, rows[i].point, rows[i].frame, c);
        bool any = false;
        for (int n = 0; n < 2 * splines; n++) {
            wiggly_curve *curve = &stand.opened.evaluation.curves[n / 2];
            double *x = n % 2 ? &curve->im[sample] : &curve->re[sample];
            const double before = *x;
            *x = before + rows[i].step;
            const struct pin_point up = stand_find(&stand, rows[i].rig, rows[i].point, rows[i].frame, NULL);
            *x = before - rows[i].step;
            const struct pin_point down = stand_find(&stand, rows[i].rig, rows[i].point, rows[i].frame, NULL);
            *x = before;
            for (int k = 0; k < 3; k++) {
                const double said = n % 2 ? -c[n / 2][k][1] : c[n / 2][k][0];
                assert_near(said, (up.at[k] - down.at[k]) / (2 * rows[i].step), rows[i].tolerance * at.size);
                any |= fabs(said) > 0.01 * at.size;
            }
        }
        assert_true(any);
        stand_close(&stand);
    }
}

// --- pins are met

static void edit(struct stand *stand, const char *words)
{
    struct world world = {.document = document_of(stand), .history = stand->history};
    world_must(&world, world_do_all(&world, words));
}

/// Pins a point where it would be if all splines were `re` and `im` away from where they are. Returns how far that is from where it is.
static double pin_near(struct stand *stand, int rig, int point, double frame, double re, double im)
{
    pin_pull c[64];
    const struct pin_point at = stand_find(stand, rig, point, frame, c);
    struct pin pin = {.frame = frame, .point = point, .to = {at.at[0], at.at[1], at.at[2]}};
    for (int s = 0; s < document_of(stand)->spline_count; s++) {
        for (int k = 0; k < 3; k++) pin.to[k] += c[s][k][0] * re - c[s][k][1] * im;
    }
    stand_end(stand, edit_pin_set(stand_begin(stand), rig, &pin, NULL));
    return length_of((const double[]){pin.to[0] - at.at[0], pin.to[1] - at.at[1], pin.to[2] - at.at[2]});
}

static double left_of(const struct stand *stand, int rig, int pin)
{
    return length_of(stand_left(stand, rig, pin)->way);
}

/// Where the stage shows a point.
static void stage_point(const struct stand *stand, int rig, int point, double frame, float at[3])
{
    struct rig_pose pose;
    const struct posing posing = opened_posing(&stand->opened);
    assert_true(rig_pose(&posing, rig, document_sample(document_of(stand), frame), &pose));
    if (pose.kind == RIG_MODEL) {
        figure_vertex(&pose.model, point, at);
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

STAND_TEST(a_character_meets_its_pins, *stand = open_text(zoo))
{
    pin_near(stand, CREATURE, VERTEX, 30, 0.4, -0.3);
    pin_near(stand, CREATURE, VERTEX, 41, -0.5, 0.2);
    stand_solve(stand);
    assert_met(stand, CREATURE, 1e-9);
    assert_same_as_whole(stand);
}

STAND_TEST(a_curved_character_meets_its_pins, *stand = open_curved(zoo))
{
    assert_false(stand_find(stand, CREATURE, VERTEX, 30, NULL).is_linear);
    pin_near(stand, CREATURE, VERTEX, 30, 0.4, -0.3);
    pin_near(stand, CREATURE, VERTEX, 41, -0.5, 0.2);
    stand_solve(stand);
    assert_met(stand, CREATURE, 1e-8);
    assert_same_as_whole(stand);
}

STAND_TEST(a_tail_meets_its_pins, *stand = open_path("assets/scenes/tail.json"))
{
    pin_near(stand, 0, TIP, 30, 0.2, 0.1);
    pin_near(stand, 0, TIP, FREE_FRAME, -0.1, 0.1);
    stand_solve(stand);
    assert_met(stand, 0, 1e-6);
    assert_same_as_whole(stand);
}

/// A rig with an offset is held at its pins' frames: between samples, around the seam of loops, and where a twin of its splines has another. By whole
/// frames, a place out of reach is missed as far as without one.
STAND_TEST(rigs_with_an_offset_meet_their_pins, *stand = open_text(zoo))
{
    static const struct {
        const char *path, *edits;
        int rig, point;
        double frame, tolerance;
    } rows[] = {
        {NULL, "offset creature 3", CREATURE, VERTEX, 30, 1e-9},
        {NULL, "offset creature 2.37", CREATURE, VERTEX, 30, 1e-8},
        {NULL, "offset creature 2.5; offset shared -3.6", CREATURE, VERTEX, 30, 1e-8},
        {"assets/scenes/tail.json", "offset 0 2", 0, TIP, FREE_FRAME + 2, 1e-6},
        {"assets/scenes/tail.json", "offset 0 2.37", 0, TIP, FREE_FRAME + 2, 1e-6},
        {"assets/scenes/tail.json", "offset 0 -46.3", 0, TIP, FREE_FRAME - 46, 1e-6},
        {"assets/scenes/tail.json", "offset 0 80.3", 0, TIP, 34, 1e-6}, // before the seam, after it
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct stand later = rows[i].path ? open_path(rows[i].path) : open_text(zoo);
        edit(&later, rows[i].edits);
        stand_solve(&later);
        pin_near(&later, rows[i].rig, rows[i].point, rows[i].frame, 0.2, 0.1);
        stand_solve(&later);
        assert_met(&later, rows[i].rig, rows[i].tolerance);
        assert_same_as_whole(&later);
        stand_close(&later);
    }
    double left[2];
    for (int i = 0; i < 2; i++) {
        struct stand far = open_path("assets/scenes/tail.json");
        edit(&far, i ? "offset 0 3" : "offset 0 0");
        stand_solve(&far);
        pin_near(&far, 0, TIP, i ? 0 : 117, 0.2, 0.1);
        stand_solve(&far);
        left[i] = left_of(&far, 0, 0);
        stand_close(&far);
    }
    assert_true(left[0] > 0.01);
    assert_near(left[1], left[0], 1e-9);
    edit(stand, "offset creature 2.25; offset shared -1.5");
    stand_solve(stand);
    pin_near(stand, CREATURE, VERTEX, 30, 0.4, -0.3);
    pin_near(stand, SHARED, 9, 44, 0.1, 0);
    stand_solve(stand);
    assert_met(stand, CREATURE, 1e-6);
    assert_true(left_of(stand, SHARED, 0) < 0.05);
    assert_same_as_whole(stand);
}

STAND_TEST(a_chain_on_a_clip_is_pinned, *stand = open_path("assets/scenes/dog.json"))
{
    const double far = pin_near(stand, 1, 7, 30, 0.3, 0.1);
    assert_same_as_whole(stand);
    assert_true(left_of(stand, 1, 0) < 0.3 * far);
    float at[3];
    stage_point(stand, 1, 7, 30, at);
    for (int k = 0; k < 3; k++) assert_near(at[k], stand_left(stand, 1, 0)->at[k], 1e-6);
}

STAND_TEST(a_tail_on_a_moving_base_is_pinned, *stand = open_path("assets/scenes/follow.json"))
{
    const double far = pin_near(stand, 0, 23, 30, 0.1, 0.1);
    assert_same_as_whole(stand);
    assert_true(left_of(stand, 0, 0) < 0.5 * far);
    char words[64];
    snprintf(words, sizeof words, "move 0 1 %g 0.9", document_of(stand)->splines[0]->knots[1].frame);
    edit(stand, words);
    assert_same_as_whole(stand); // the pinned splines follow the base by a track, and where it is
}

STAND_TEST(rigs_may_share_splines, *stand = open_text(zoo))
{
    const double own = stand_find(stand, OWN, 11, 20, NULL).at[1];
    pin_near(stand, CREATURE, VERTEX, 30, 0.4, -0.3);
    pin_near(stand, SHARED, 9, 44, 0.1, 0);
    stand_solve(stand);
    assert_met(stand, CREATURE, 1e-6);
    assert_true(left_of(stand, SHARED, 0) < 0.05);
    const double followed = stand_find(stand, OWN, 11, 20, NULL).at[1];
    assert_true(fabs(followed - own) > 1e-3); // it sees the pinned curve
    pin_near(stand, OWN, 11, 20, 0.3, 0.2);
    assert_same_as_whole(stand);
}

/// Whatever was edited, undone and looked at in between, the curves are those of the document.
STAND_TEST(edits_give_the_same_bits, *stand = open_text(zoo))
{
    static const char *const edits[] = {"repin shared 0 40 9 1 0.6 1.2",
                                        "angles shared 1 gain 9",
                                        "move up 1 20 0.5",
                                        "place shared 0 0.9",
                                        "move east 0 9 0.4",
                                        "move south 0 9 0.3",
                                        "unpin creature 0",
                                        "move south 0 9 0.5",
                                        "bend own 0 - stretch -",
                                        "unpin own 0",
                                        "move east 0 9 -0.4",
                                        "unpin shared 0"};
    pin_near(stand, CREATURE, VERTEX, 30, 0.4, -0.3);
    pin_near(stand, SHARED, 9, 44, 0.1, 0.2);
    pin_near(stand, OWN, 7, 10, 0.2, 0.2);
    assert_same_as_whole(stand);
    for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
        edit(stand, edits[i]);
        assert_same_as_whole(stand);
    }
    evaluation_update(&stand->opened.evaluation, document_of(stand), true);
    while (history_undo(stand->history)) assert_same_as_whole(stand);
    while (history_redo(stand->history)) assert_same_as_whole(stand);
}

TEST(a_point_that_the_model_lacks_is_refused)
{
    struct opened opened = {0};
    char folder[PATH_LIMIT], text[1024];
    if (!realpath("assets/models", folder)) fail_msg("no assets");
    snprintf(
        text, sizeof text,
        json("{'frames': [0, 60], 'splines': [{'name': 'up', 'frequency': 1}], 'rigs': [{'type': 'character', "
             "'name': 'soft', 'model': '%s/creature.glb', 'coordinates': [{'name': 'up', 'spline': 'up'}], 'pins': "
             "[{'frame': 4, 'vertex': 9999999, 'to': [0, 0, 0]}]}]}"),
        folder);
    const char *path = temporary_file("lacks.json", text, strlen(text));
    assert_refusal(opened_read(&opened, path, &error), "soft: expected a vertex from 0 to ");
    assert_refusal(opened_read(&opened, path, &error), " in the pin at frame 4, got 9999999");
}

// --- drags of pins out of reach

/// A pinned point of a scene, and the drag's circle or line.
static const struct drag {
    const char *scene;
    int rig, point;
    double frame;
    double u[3], v[3]; ///< of the rig's size, from where the point is without the pin: a circle; or a line along u
} drags[] = {
    {"tail", 0, 23, 30, {0, 0, -3}, {0}},
    {"tail", 0, 23, 30, {3, 0, 0}, {0}},
    {"tail", 0, 23, 30, {-2, 2, 1}, {0}},
    {"tail", 0, 23, 72, {0, 3, 0}, {0}},
    {"tail", 0, 23, 30, {0.8, 0, 0}, {0, 0.8, 0}},
    {"tail", 0, 23, 30, {0.8, 0, 0}, {0, 0, 0.8}},
    {"tail", 0, 23, 72, {2, 0, 0}, {0, 2, 0}},
    {"tail", 0, 12, 50, {1, 0, 0}, {0, 0, 1}},
    {"follow", 0, 11, 40, {1, 0, 0}, {0, 1, 0}},
    {"follow", 0, 23, 30, {0, 0, 2}, {0, 2, 0}},
    {"dog", 1, 7, 30, {0, 0, 2}, {0, 2, 0}},
    {"dog", 1, 7, 30, {1, 0, 0}, {0, 1, 0}},
    {"dog", 2, 1, 30, {1, 1, 1}, {0}},
};

enum { DRAGS = sizeof drags / sizeof *drags, STEPS = 90, HALVINGS = 14, MOST_NUMBERS = 8192 };

struct pulled {
    struct stand stand;
    double from[3], size; ///< the point without its pin
    double seen[2][MOST_NUMBERS];
};

static double *place_of(struct pulled *pulled, const struct drag *drag)
{
    return document_own_rig(document_of(&pulled->stand), drag->rig)->pins[0].to;
}

static void open_drag(struct pulled *pulled, const struct drag *drag)
{
    char path[64];
    snprintf(path, sizeof path, "assets/scenes/%s.json", drag->scene);
    pulled->stand = open_path(path);
    const struct pin_point at = stand_find(&pulled->stand, drag->rig, drag->point, drag->frame, NULL);
    memcpy(pulled->from, at.at, sizeof pulled->from);
    pulled->size = at.size;
    pin_near(&pulled->stand, drag->rig, drag->point, drag->frame, 0, 0);
}

/// What is left of the pin, of the size.
static double solve(struct pulled *pulled, const struct drag *drag)
{
    stand_solve(&pulled->stand);
    return left_of(&pulled->stand, drag->rig, 0) / pulled->size;
}

/// All curves with the pin at t of the drag.
static void solve_at(struct pulled *pulled, const struct drag *drag, double t, double *seen)
{
    const struct evaluation *evaluation = &pulled->stand.opened.evaluation;
    const bool is_line = length_of(drag->v) == 0;
    const double turn = 2 * M_PI * t, on[2] = {is_line ? t : cos(turn), is_line ? 0 : sin(turn)};
    for (int k = 0; k < 3; k++) {
        const double way = on[0] * drag->u[k] + on[1] * drag->v[k];
        place_of(pulled, drag)[k] = pulled->from[k] + pulled->size * way;
    }
    solve(pulled, drag);
    for (int s = 0, n = 0; s < evaluation->count; s++) {
        for (int i = 0; i < evaluation->samples && n < MOST_NUMBERS; i++) seen[n++] = evaluation->curves[s].total[i];
    }
}

static double difference(const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < MOST_NUMBERS; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/// The largest change of any spline between two neighbouring places of the drag, halved towards where it changes most.
static double largest_jump(struct pulled *pulled, const struct drag *drag, double *step_change)
{
    static double middle[MOST_NUMBERS];
    double most = 0, at = 0, width = 1.0 / STEPS;
    solve_at(pulled, drag, 0, pulled->seen[0]);
    for (int i = 1; i <= STEPS; i++) {
        solve_at(pulled, drag, (double)i / STEPS, pulled->seen[i % 2]);
        const double change = difference(pulled->seen[0], pulled->seen[1]);
        if (change > most) most = change, at = (double)(i - 1) / STEPS;
    }
    *step_change = most;
    solve_at(pulled, drag, at, pulled->seen[0]);
    solve_at(pulled, drag, at + width, pulled->seen[1]);
    for (int i = 0; i < HALVINGS; i++) {
        width /= 2;
        solve_at(pulled, drag, at + width, middle);
        const double before = difference(pulled->seen[0], middle), after = difference(middle, pulled->seen[1]);
        if (after > before) at += width;
        memcpy(pulled->seen[after > before ? 0 : 1], middle, sizeof middle);
        most = fmax(before, after);
    }
    return most;
}

TEST(far_drags_do_not_jump)
{
    static struct pulled pulled;
    for (int i = 0; i < DRAGS; i += quick_or_all(3, 1)) {
        const struct drag *drag = &drags[i];
        double change;
        open_drag(&pulled, drag);
        const double jump = largest_jump(&pulled, drag, &change);
        if (!(change < 4 && jump < 0.01))
            fail_msg("%s, rig %d, point %d, frame %g: changes by %g in a step of the drag, by %g in 1/%d of it",
                     drag->scene, drag->rig, drag->point, drag->frame, change, jump, 1 << HALVINGS);
        stand_close(&pulled.stand);
    }
}

/// A place where the point is after some change of what the splines are at its sample, up to `most` each.
static void move_within_reach(struct pulled *pulled, const struct drag *drag, double most)
{
    const struct document *document = document_of(&pulled->stand);
    const int sample = document_sample(document, drag->frame);
    memcpy(place_of(pulled, drag), pulled->from, sizeof pulled->from);
    solve(pulled, drag);
    for (int s = 0; s < document->spline_count; s++) {
        wiggly_curve *curve = &pulled->stand.opened.evaluation.curves[s];
        if (spline_find_knot(document, document->splines[s], sample) >= 0) continue;
        curve->re[sample] += most * (2.0 * rand() / RAND_MAX - 1);
        curve->im[sample] += most * (2.0 * rand() / RAND_MAX - 1);
    }
    const struct pin_point at = stand_find(&pulled->stand, drag->rig, drag->point, drag->frame, NULL);
    memcpy(place_of(pulled, drag), at.at, sizeof at.at);
}

/// Most directions in which a tail gives way by design are in these places too: so it is how many that counts.
TEST(what_can_be_reached_is_reached)
{
    static struct pulled pulled;
    int met = 0, near = 0, count = 0;
    srand(1);
    for (int i = 0; i < DRAGS; i++) {
        open_drag(&pulled, &drags[i]);
        for (int n = 0; n < quick_or_all(10, 50); n++) {
            move_within_reach(&pulled, &drags[i], 0.4);
            const double left = solve(&pulled, &drags[i]);
            met += left <= 1e-6, near += left < 0.01, count++;
        }
        stand_close(&pulled.stand);
    }
    if (met < 0.4 * count || near < 0.75 * count)
        fail_msg("of %d places %d are met, and %d nearly: expected 40 and 75 percent", count, met, near);
}

// --- floors

static bool floor_is_curved; ///< of what open_floor() opens

/// `spline` is of the one that moves it up, `more` of the character.
static struct stand open_floor(const char *start, const char *knots, const char *spline, const char *more)
{
    char text[4096];
    snprintf(
        text, sizeof text,
        "{'frames': [0, 120], 'splines': [{'name': 'up', 'frequency': 1, 'damping': 0.1, 'start': '%s', 'knots': "
        "[%s]%s}, {'name': 'side', 'frequency': 0.8, 'damping': 0.1, 'start': '%s', 'knots': []}], 'rigs': [{'type': "
        "'character', 'name': 'creature', 'model': '%%s/creature.glb', 'coordinates': [{'name': 'up', 'spline': "
        "'up'}, {'name': 'side', 'spline': 'side'}]%s}]}",
        start, knots, spline, start, more);
    return floor_is_curved ? open_curved(text) : open_text(text);
}

#define JUMP "{'frame': 0, 'value': 0}, {'frame': 20, 'value': 5}"

static double lowest(const struct stand *stand, int sample)
{
    struct rig_pose pose;
    double low = INFINITY;
    const struct posing posing = opened_posing(&stand->opened);
    assert_true(rig_pose(&posing, 0, sample, &pose));
    for (int v = 0; v < pose.model.figure->character.vertex_count; v++) {
        float at[3];
        figure_vertex(&pose.model, v, at);
        low = fmin(low, (double)at[1]);
    }
    return low;
}

TEST(nothing_is_below_the_floor)
{
    static const char *const starts[] = {"free", "loop", "rest"};
    static const char *const floors[] = {", 'floor': 0", ", 'floor': 0, 'offset': 3", ", 'floor': 0, 'offset': -2"};
    for (int s = 0; s<6; s++, floor_is_curved = s> 2) {
        double before = INFINITY;
        struct stand loose = open_floor(starts[s % 3], JUMP ", {'frame': 40, 'value': 2}", "", ""),
                     kept = open_floor(starts[s % 3], JUMP ", {'frame': 40, 'value': 2}", "", floors[s % 3]);
        for (int i = 0; i < kept.opened.evaluation.samples; i++) {
            before = fmin(before, lowest(&loose, i));
            assert_true(lowest(&kept, i) > -3e-5);
        }
        assert_true(before < -0.1);
        assert_true(evaluation_floor(&kept.opened.evaluation, 0)->depth < 3e-5);
        assert_knots_are_hit(&kept);
        stand_close(&loose);
        stand_close(&kept);
    }
    floor_is_curved = false;
}

/// Solved again after a knot was elsewhere meanwhile; one that nothing touches changes no bit.
TEST(a_floor_gives_the_same_bits)
{
    struct stand stand = open_floor("free", "{'frame': 20, 'value': 5}", "", ", 'floor': 0");
    for (double value = 5.5; value >= 5; value -= 0.25) {
        document_own_spline(document_of(&stand), 0)->knots[0].value = value;
        assert_same_as_whole(&stand);
    }
    stand_close(&stand);
    struct stand plain = open_floor("free", "{'frame': 20, 'value': 2}", "", ""),
                 floored = open_floor("free", "{'frame': 20, 'value': 2}", "", ", 'floor': -1");
    assert_memory_equal(plain.opened.evaluation.curves[0].im, floored.opened.evaluation.curves[0].im,
                        (size_t)plain.opened.evaluation.samples * sizeof(double));
    assert_true(evaluation_floor(&floored.opened.evaluation, 0)->depth == 0);
    stand_close(&plain);
    stand_close(&floored);
}

STAND_TEST(a_floor_above_the_feet_is_refused, *stand = open_floor("free", "", "", ", 'floor': -1"))
{
    struct world world = {.document = document_of(stand), .history = stand->history};
    assert_refused(&world, world_do(&world, "floor creature 0.5"),
                   "creature: floor: expected a height of at most 0, which is what the character stands on, got 0.5");
    assert_reversible(&world, world_do(&world, "floor creature -0.25"));
    assert_true(first_model(document_of(stand))->floor == -0.25);
}

/// A vertex low down that the splines move, and where it is at a sample.
static int low_vertex(const struct stand *stand, int sample, double at[3])
{
    int lowest = -1;
    for (int v = 0; v < models_figure(stand->opened.models, document_of(stand), 0)->character.vertex_count; v++) {
        pin_pull c[2];
        const struct pin_point found = stand_find(stand, 0, v, sample, c);
        if (hypot(c[0][1][0], c[0][1][1]) < 0.05 || (lowest >= 0 && found.at[1] >= at[1])) continue;
        lowest = v;
        memcpy(at, found.at, 3 * sizeof *at);
    }
    assert_true(lowest >= 0);
    return lowest;
}

/// Pins are met, in and out of the floor; where one holds the character below, the floor sinks there and nowhere else.
TEST(pins_come_first_and_the_floor_sinks_to_them)
{
    struct stand loose = open_floor("free", JUMP, "", "");
    double at[3] = {0};
    const int vertex = low_vertex(&loose, 60, at);
    stand_close(&loose);
    for (int below = 0; below < 2; below++) {
        char more[256];
        snprintf(more, sizeof more, ", 'floor': 0, 'pins': [{'frame': 60, 'vertex': %d, 'to': [%.9g, %.9g, %.9g]}]",
                 vertex, at[0], below ? -0.05 : 0.04, at[2]);
        struct stand stand = open_floor("free", JUMP, "", more);
        const struct floor_left *floor = evaluation_floor(&stand.opened.evaluation, 0);
        assert_true(fabs(stand_left(&stand, 0, 0)->way[1]) < 0.005);
        assert_knots_are_hit(&stand);
        if (!below) assert_true(floor->depth < 3e-5);
        if (below) {
            assert_true(floor->depth >= 0.045 && floor->sample == 60);
            assert_true(lowest(&stand, 60) < -0.045);
            assert_true(lowest(&stand, 59) < -0.02 && lowest(&stand, 61) < -0.02); // it does not jump up to the floor
        }
        for (int i = 0; i < stand.opened.evaluation.samples; i++) {
            if (!below || abs(i - 60) > 9) assert_true(lowest(&stand, i) > -3e-5); // a quarter of 30 samples
        }
        stand_close(&stand);
    }
}

/// A variation is of the motion that pins and the floor then change; limits are passed over.
TEST(all_that_a_spline_may_have_at_once)
{
    static const char *const splines[] = {"", ", 'variation': {'seed': 7, 'amount': 0.3}",
                                          ", 'variation': {'seed': 7, 'amount': 0.3}, 'limits': [-6, 6]"};
    double seen[3][121], most = 0;
    for (int n = 0; n < 3; n++) {
        struct stand stand = open_floor("free", JUMP, splines[n],
                                        ", 'floor': 0, 'pins': [{'frame': 60, 'vertex': 500, 'to': [0, 1, 0]}]");
        assert_int_equal(stand.opened.evaluation.samples, 121);
        assert_knots_are_hit(&stand);
        for (int i = 0; i < 121; i++) {
            assert_true(lowest(&stand, i) > -3e-5);
            seen[n][i] = stand.opened.evaluation.curves[0].total[i];
        }
        stand_close(&stand);
    }
    for (int i = 0; i < 121; i++) most = fmax(most, fabs(seen[1][i] - seen[0][i]));
    assert_true(most > 0.1);
    assert_memory_equal(seen[1], seen[2], sizeof seen[1]);
}
