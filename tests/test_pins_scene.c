/// Pins of whole scenes: points of characters, tails and chains are where they must be, whatever was edited before.
#include "near.h"

#include "model/morph.h"
#include "rig/opened.h"
#include "rig/pinning.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "scene/pins.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A scene that is edited and solved.
struct stand {
    struct opened opened;
    struct history *history;
};

static struct document *document_of(struct stand *stand) { return stand->opened.document; }

static void open(struct stand *stand, const char *path)
{
    struct error error = {0};
    if (!opened_read(&stand->opened, path, &error)) fail_msg("%s", error.text);
    stand->history = history_create();
    assert_non_null(stand->history);
}

static void close(struct stand *stand)
{
    history_destroy(stand->history);
    opened_free(&stand->opened);
}

static void must(struct stand *stand, struct edit edit)
{
    struct error error = {0};
    history_begin(stand->history, "Edit", 0);
    if (!history_apply(stand->history, document_of(stand), &edit, &error)) fail_msg("%s", error.text);
    history_end(stand->history);
}

/// As a frame solves what its edits changed.
static void solve(struct stand *stand)
{
    struct document *document = document_of(stand);
    struct evaluation *evaluation = &stand->opened.evaluation;
    bool dirty[64];
    evaluation->pins = pin_points(stand->opened.models);
    assert_true(evaluation_resize(evaluation, document, NULL));
    history_take_dirty(stand->history, document, dirty, document->spline_count);
    evaluation_update(evaluation, document, dirty, false);
}

/// Solves from nothing.
static void solve_whole(struct stand *stand)
{
    evaluation_free(&stand->opened.evaluation);
    assert_true(opened_solve(&stand->opened, WIGGLY_CHAIN, NULL));
}

static struct edit pin_edit(int rig, int point, double frame, const double to[3])
{
    return (struct edit){.kind = EDIT_PIN_ADD,
                         .rig = rig,
                         .pin = {.frame = frame, .point = point, .to = {to[0], to[1], to[2]}}};
}

/// The point and, of each spline, how it moves it.
static struct pin_point find(struct stand *stand, int rig, int point, double frame, pin_pull *c)
{
    const struct document *document = document_of(stand);
    const struct pin_source source = pin_points(stand->opened.models);
    struct pin_point found;
    struct pin pin = {.frame = frame, .point = point};
    int splines[64];
    for (int s = 0; s < document->spline_count; s++) splines[s] = s;
    assert_true(source.find(source.context, &stand->opened.evaluation, document, rig, &pin, splines,
                            document->spline_count, c, &found));
    return found;
}

static double left_of(struct stand *stand, int rig, int pin)
{
    const struct pin_left *left = evaluation_pin(&stand->opened.evaluation, document_of(stand), rig, pin);
    assert_non_null(left);
    assert_true(left->is_found);
    return hypot(hypot(left->way[0], left->way[1]), left->way[2]);
}

/// c against what small changes of x do.
static void check_pulls(const char *path, int rig, int point, double frame, double step, double tolerance)
{
    struct stand stand = {0};
    open(&stand, path);
    solve_whole(&stand);
    const int sample = document_sample(document_of(&stand), frame);
    pin_pull c[64], ignored[64];
    const struct pin_point at = find(&stand, rig, point, frame, c);
    bool any = false;
    for (int s = 0; s < document_of(&stand)->spline_count; s++) {
        wiggly_curve *curve = &stand.opened.evaluation.curves[s];
        for (int part = 0; part < 2; part++) {
            double *x = part == 0 ? &curve->re[sample] : &curve->im[sample];
            const double before = *x;
            *x = before + step;
            const struct pin_point up = find(&stand, rig, point, frame, ignored);
            *x = before - step;
            const struct pin_point down = find(&stand, rig, point, frame, ignored);
            *x = before;
            for (int k = 0; k < 3; k++) {
                const double seen = (up.at[k] - down.at[k]) / (2 * step);
                const double said = part == 0 ? c[s][k][0] : -c[s][k][1];
                printf("%s spline %d part %d axis %d: %g %g\n", path, s, part, k, said, seen);
                assert_near(said, seen, tolerance * at.size);
                any |= fabs(said) > 0.01 * at.size;
            }
        }
    }
    assert_true(any);
    close(&stand);
}

static void test_pulls_are_derivatives(void **state)
{
    (void)state;
    check_pulls("assets/scenes/tail.json", 0, 23, 30, 1e-4, 1e-6);
    check_pulls("assets/scenes/follow.json", 0, 11, 40, 1e-4, 1e-6);
    check_pulls("assets/scenes/character.json", 0, 100, 30, 1e-2, 1e-9);
    check_pulls("assets/scenes/dog.json", 1, 7, 30, 1e-2, 1e-4);
    check_pulls("assets/scenes/dog.json", 2, 1, 30, 1e-2, 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pulls_are_derivatives)};
    (void)must;(void)solve;(void)pin_edit;(void)left_of;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
