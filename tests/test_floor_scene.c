/// A character's floor: no vertex below it at any sample, knots and pins met as ever, whatever was edited before.
#include "near.h"

#include "model/morph.h"
#include "rig/opened.h"
#include "rig/pinning.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "temporary.h"
#include <stdlib.h>
#include <string.h>

static struct opened open_scene(const char *start, const char *knots, const char *more)
{
    char text[4096], folder[2048];
    struct opened opened;
    struct error error = {0};
    if (!realpath("assets/models", folder)) fail_msg("no assets");
    snprintf(text, sizeof text,
             "{ \"wiggly\": 1, \"fps\": 24, \"frames\": [0, 120], \"splines\": ["
             "{ \"name\": \"up\", \"frequency\": 1, \"damping\": 0.1, \"start\": \"%s\", \"knots\": [%s] },"
             "{ \"name\": \"side\", \"frequency\": 0.8, \"damping\": 0.1, \"start\": \"%s\", \"knots\": [] } ],"
             "\"rigs\": [ { \"type\": \"character\", \"name\": \"creature\", \"model\": \"%s/creature.glb\", "
             "\"coordinates\": [ { \"name\": \"up\", \"spline\": \"up\" }, { \"name\": \"side\", \"spline\": "
             "\"side\" } ]%s } ] }",
             start, knots, start, folder, more);
    const char *path = temporary_file("floor.json", text, strlen(text));
    if (!opened_read(&opened, path, &error)) fail_msg("%s", error.text);
    assert_true(opened_solve(&opened, WIGGLY_CHAIN, &error));
    return opened;
}

static double lowest(const struct opened *opened, int sample)
{
    struct rig_pose pose;
    double low = INFINITY;
    const struct posing posing = opened_posing(opened);
    assert_true(rig_pose(&posing, 0, sample, NULL, &pose));
    const struct figure *figure = pose.character.figure;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        float at[3];
        morph_vertex(figure, &pose.character.morph, v, at, NULL);
        low = fmin(low, (double)(at[1] + pose.character.position[1] - figure->lo[1]));
    }
    return low;
}

static void check_knots(const struct opened *opened)
{
    const struct spline *spline = &opened->document->splines[0];
    for (int k = 0; k < spline->knot_count; k++) {
        const int sample = document_sample(opened->document, spline->knots[k].frame);
        assert_near(opened->evaluation.curves[0].total[sample], spline->knots[k].value, 1e-9);
    }
}

static void nothing_is_below_the_floor(void **state)
{
    static const char *const starts[] = {"free", "loop", "rest"};
    static const char knots[] =
        "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": 5 }, { \"frame\": 40, \"value\": 2 }";
    (void)state;
    for (int s = 0; s < 3; s++) {
        double before = INFINITY;
        struct opened free_to_go = open_scene(starts[s], knots, ""),
                      kept = open_scene(starts[s], knots, ", \"floor\": 0");
        for (int i = 0; i < kept.evaluation.samples; i++) {
            before = fmin(before, lowest(&free_to_go, i));
            assert_true(lowest(&kept, i) > -3e-5);
        }
        assert_true(before < -0.1);
        assert_true(evaluation_floor(&kept.evaluation, 0)->depth < 3e-5);
        check_knots(&kept);
        opened_free(&free_to_go);
        opened_free(&kept);
    }
}

/// Solved again after a knot was elsewhere meanwhile.
static void the_same_document_gives_the_same_bits(void **state)
{
    struct opened opened = open_scene("free", "{ \"frame\": 20, \"value\": 5 }", ", \"floor\": 0");
    struct evaluation *evaluation = &opened.evaluation;
    const size_t size = (size_t)evaluation->samples * sizeof(double);
    double *was = malloc(size), *value = &opened.document->splines[0].knots[0].value;
    (void)state;
    assert_non_null(was);
    memcpy(was, evaluation->curves[0].im, size);
    for (*value = 5.5; *value >= 5; *value -= 0.25) evaluation_update(evaluation, opened.document, NULL, false);
    assert_memory_equal(was, evaluation->curves[0].im, size);
    free(was);
    opened_free(&opened);
}

/// A floor that nothing touches changes no bit, and it is said where knots hold the character below.
static void an_untouched_floor_is_none_and_a_missed_one_is_told(void **state)
{
    static const char knot[] = "{ \"frame\": 20, \"value\": 2 }";
    struct opened plain = open_scene("free", knot, ""), floored = open_scene("free", knot, ", \"floor\": -1");
    (void)state;
    assert_memory_equal(plain.evaluation.curves[0].im, floored.evaluation.curves[0].im,
                        (size_t)plain.evaluation.samples * sizeof(double));
    assert_true(evaluation_floor(&floored.evaluation, 0)->depth == 0);
    opened_free(&plain);
    opened_free(&floored);
}

static void a_floor_above_the_feet_is_refused(void **state)
{
    struct opened opened = open_scene("free", "", ", \"floor\": -1");
    struct history *history = history_create();
    struct error error = {0};
    struct edit edit = {.kind = EDIT_FLOOR, .rig = 0, .flag = true, .number = 0.5};
    (void)state;
    history_begin(history, "Floor", 0);
    assert_false(history_apply(history, opened.document, &edit, &error));
    assert_non_null(strstr(error.text, "floor: expected a height of at most 0"));
    assert_true(opened.document->rigs[0].character.floor == -1);
    edit.number = -0.25;
    assert_true(history_apply(history, opened.document, &edit, &error));
    history_end(history);
    assert_true(opened.document->rigs[0].character.floor == -0.25);
    assert_true(history_undo(history, opened.document));
    assert_true(opened.document->rigs[0].character.floor == -1);
    history_destroy(history);
    opened_free(&opened);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_below_the_floor),
                                       cmocka_unit_test(the_same_document_gives_the_same_bits),
                                       cmocka_unit_test(an_untouched_floor_is_none_and_a_missed_one_is_told),
                                       cmocka_unit_test(a_floor_above_the_feet_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
