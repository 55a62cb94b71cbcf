/// A character's floor: no vertex below it at any sample, knots and pins met as ever, whatever was edited before.
#include "documents.h"
#include "stand.h"
#include "temporary.h"

/// `more` is of the character, `spline` of the one that moves it up.
static struct stand open_with(const char *start, const char *knots, const char *spline, const char *more)
{
    char text[8192], folder[PATH_LIMIT];
    struct stand stand = {0};
    if (!realpath("assets/models", folder)) fail_msg("no assets");
    snprintf(text, sizeof text,
             "{ \"wiggly\": 1, \"fps\": 24, \"frames\": [0, 120], \"splines\": ["
             "{ \"name\": \"up\", \"frequency\": 1, \"damping\": 0.1, \"start\": \"%s\", \"knots\": [%s]%s },"
             "{ \"name\": \"side\", \"frequency\": 0.8, \"damping\": 0.1, \"start\": \"%s\", \"knots\": [] } ],"
             "\"rigs\": [ { \"type\": \"character\", \"name\": \"creature\", \"model\": \"%s/creature.glb\", "
             "\"coordinates\": [ { \"name\": \"up\", \"spline\": \"up\" }, { \"name\": \"side\", \"spline\": "
             "\"side\" } ]%s } ] }",
             start, knots, spline, start, folder, more);
    stand_open(&stand, temporary_file("floor.json", text, strlen(text)));
    stand_solve(&stand);
    return stand;
}

static struct stand open_scene(const char *start, const char *knots, const char *more)
{
    return open_with(start, knots, "", more);
}

static double lowest(const struct stand *stand, int sample)
{
    struct rig_pose pose;
    double low = INFINITY;
    const struct posing posing = opened_posing(&stand->opened);
    assert_true(rig_pose(&posing, 0, sample, NULL, &pose));
    const struct figure *figure = pose.character.figure;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        float at[3];
        morph_vertex(figure, &pose.character.morph, v, at, NULL);
        low = fmin(low, (double)(at[1] + pose.character.position[1] - figure->lo[1]));
    }
    return low;
}

TEST(nothing_is_below_the_floor)
{
    static const char *const starts[] = {"free", "loop", "rest"};
    static const char knots[] =
        "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": 5 }, { \"frame\": 40, \"value\": 2 }";
    for (int s = 0; s < 3; s++) {
        double before = INFINITY;
        struct stand free_to_go = open_scene(starts[s], knots, ""),
                     kept = open_scene(starts[s], knots, ", \"floor\": 0");
        for (int i = 0; i < kept.opened.evaluation.samples; i++) {
            before = fmin(before, lowest(&free_to_go, i));
            assert_true(lowest(&kept, i) > -3e-5);
        }
        assert_true(before < -0.1);
        assert_true(evaluation_floor(&kept.opened.evaluation, 0)->depth < 3e-5);
        assert_knots_are_hit(&kept);
        stand_close(&free_to_go);
        stand_close(&kept);
    }
}

/// Solved again after a knot was elsewhere meanwhile.
STAND_TEST(the_same_document_gives_the_same_bits,
           *stand = open_scene("free", "{ \"frame\": 20, \"value\": 5 }", ", \"floor\": 0"))
{
    struct evaluation *evaluation = &stand->opened.evaluation;
    const size_t size = (size_t)evaluation->samples * sizeof(double);
    double *was = malloc(size);
    assert_non_null(was);
    memcpy(was, evaluation->curves[0].im, size);
    for (double value = 5.5; value >= 5; value -= 0.25) {
        document_own_spline(stand->opened.document, 0)->knots[0].value = value;
        evaluation_update(evaluation, stand->opened.document, false);
    }
    assert_memory_equal(was, evaluation->curves[0].im, size);
    free(was);
}

/// A floor that nothing touches changes no bit, and it is said where knots hold the character below.
TEST(an_untouched_floor_is_none_and_a_missed_one_is_told)
{
    static const char knot[] = "{ \"frame\": 20, \"value\": 2 }";
    struct stand plain = open_scene("free", knot, ""), floored = open_scene("free", knot, ", \"floor\": -1");
    assert_memory_equal(plain.opened.evaluation.curves[0].im, floored.opened.evaluation.curves[0].im,
                        (size_t)plain.opened.evaluation.samples * sizeof(double));
    assert_true(evaluation_floor(&floored.opened.evaluation, 0)->depth == 0);
    stand_close(&plain);
    stand_close(&floored);
}

STAND_TEST(a_floor_above_the_feet_is_refused, *stand = open_scene("free", "", ", \"floor\": -1"))
{
    const struct document *document = stand->opened.document;
    struct rig changed = *document->rigs[0];
    changed.character.floor = 0.5;
    assert_refusal(edit_rig_set(stand_begin(stand), 0, &changed, &error), "floor: expected a height of at most 0");
    assert_true(document->rigs[0]->character.floor == -1);
    changed.character.floor = -0.25;
    stand_end(stand, edit_rig_set(stand->opened.document, 0, &changed, NULL));
    assert_true(document->rigs[0]->character.floor == -0.25);
    assert_true(history_undo(stand->history));
    assert_true(document->rigs[0]->character.floor == -1);
}

/// A vertex low down that both splines move, and where it is at a sample.
static int low_vertex(const struct stand *stand, int sample, double at[3])
{
    int lowest = -1;
    for (int v = 0; v < models_figure(stand->opened.models, 0)->character.vertex_count; v++) {
        pin_pull c[2];
        const struct pin_point found = stand_find(stand, 0, v, sample, c);
        const double moves = hypot(c[0][1][0], c[0][1][1]);
        if (moves < 0.05 || (lowest >= 0 && found.at[1] >= at[1])) continue;
        lowest = v;
        memcpy(at, found.at, 3 * sizeof *at);
    }
    assert_true(lowest >= 0);
    return lowest;
}

/// Pins are met, in and out of the floor; where one holds the character below, the floor sinks there and nowhere else.
TEST(pins_come_first_and_the_floor_sinks_to_them)
{
    static const char knots[] = "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": 5 }";
    struct stand free_to_go = open_scene("free", knots, "");
    double at[3] = {0};
    const int vertex = low_vertex(&free_to_go, 60, at);
    stand_close(&free_to_go);
    for (int below = 0; below < 2; below++) {
        char more[256];
        snprintf(more, sizeof more,
                 ", \"floor\": 0, \"pins\": [ { \"frame\": 60, \"vertex\": %d, \"to\": [%.9g, %.9g, %.9g] } ]",
                 vertex, at[0], below ? -0.05 : 0.04, at[2]);
        struct stand stand = open_scene("free", knots, more);
        const struct pin_left *left = stand_left(&stand, 0, 0);
        const struct floor_left *floor = evaluation_floor(&stand.opened.evaluation, 0);
        assert_true(fabs(left->way[1]) < 0.005);
        assert_knots_are_hit(&stand);
        if (below) {
            assert_true(floor->depth >= 0.045 && floor->sample == 60);
            assert_true(lowest(&stand, 60) < -0.045);
            assert_true(lowest(&stand, 59) < -0.02 && lowest(&stand, 61) < -0.02); // it does not jump up to the floor
        } else {
            assert_true(floor->depth < 3e-5);
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
    static const char knots[] = "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": 5 }",
                      pin[] = ", \"floor\": 0, \"pins\": [ { \"frame\": 60, \"vertex\": 500, \"to\": [0, 1, 0] } ]";
    static const char *const splines[] = {"", ", \"variation\": { \"seed\": 7, \"amount\": 0.3 }",
                                          ", \"variation\": { \"seed\": 7, \"amount\": 0.3 }, "
                                          "\"limits\": [-6, 6]"};
    double seen[3][121];
    for (int n = 0; n < 3; n++) {
        struct stand stand = open_with("free", knots, splines[n], pin);
        assert_int_equal(stand.opened.evaluation.samples, 121);
        assert_knots_are_hit(&stand);
        for (int i = 0; i < 121; i++) {
            assert_true(lowest(&stand, i) > -3e-5);
            seen[n][i] = stand.opened.evaluation.curves[0].total[i];
        }
        stand_close(&stand);
    }
    double most = 0;
    for (int i = 0; i < 121; i++) most = fmax(most, fabs(seen[1][i] - seen[0][i]));
    assert_true(most > 0.1);
    assert_memory_equal(seen[1], seen[2], sizeof seen[1]);
}

STAND_TEST(a_floor_is_saved_with_what_is_not_known,
           *stand = open_scene("free", "", ", \"floor\": -0.5, \"carpet\": \"red\""))
{
    char *text = text_of_document(stand->opened.document);
    assert_non_null(strstr(text, "\"floor\": -0.5"));
    assert_non_null(strstr(text, "\"carpet\": \"red\""));
    free(text);
    stand->opened.document->rigs[0]->character.has_floor = false;
    text = text_of_document(stand->opened.document);
    assert_null(strstr(text, "\"floor\""));
    free(text);
}
