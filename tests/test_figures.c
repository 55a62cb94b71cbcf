/// The paper's figures as scenes: each shows what the paper says it shows.
#include "near.h"

#include "scene/evaluate.h"
#include "scene/load.h"

static struct document *document;
static struct evaluation evaluation;

static void open_figure(const char *path)
{
    struct error error = {0};
    document = scene_load(path, NULL, &error);
    if (!document) fail_msg("%s", error.text);
    assert_true(evaluation_resize(&evaluation, document, &error));
    evaluation_update(&evaluation, document, NULL, false);
    for (int i = 0; i < evaluation.count; i++) assert_int_equal(evaluation.status[i], WIGGLY_OK);
}

static int close_figure(void **state)
{
    (void)state;
    evaluation_free(&evaluation);
    document_destroy(document);
    document = NULL;
    return 0;
}

static const wiggly_curve *curve(const char *name)
{
    int spline = document_find_spline(document, name);
    assert_true(spline >= 0);
    return &evaluation.curves[spline];
}

static bool is_extremum(const double *row, int at)
{
    return (row[at] > row[at - 1] && row[at] >= row[at + 1]) || (row[at] < row[at - 1] && row[at] <= row[at + 1]);
}

/// Extrema strictly between two samples, and the smallest of their magnitudes.
static int count_extrema(const double *row, int from, int to, double *smallest)
{
    int count = 0;
    *smallest = INFINITY;
    for (int i = from + 1; i < to; i++) {
        if (!is_extremum(row, i)) continue;
        count++;
        *smallest = fmin(*smallest, fabs(row[i]));
    }
    return count;
}

/// The same everywhere on a cubic.
static double third_difference(const double *row, int at)
{
    return row[at + 2] - 3 * row[at + 1] + 3 * row[at] - row[at - 1];
}

static void assert_hits_knots(const char *name)
{
    const struct spline *spline = &document->splines[document_find_spline(document, name)];
    for (int i = 0; i < spline->knot_count; i++) {
        int sample = document_sample(document, spline->knots[i].frame);
        assert_near(curve(name)->total[sample], spline->knots[i].value, 0);
    }
}

/// Figure 1: with the resonance at zero on the left the curve is a familiar cubic, rising without a swing; where the
/// resonance has jumped up it oscillates on its way to the third knot.
static void test_figure1(void **state)
{
    (void)state;
    double smallest;
    open_figure("assets/scenes/figure1.json");
    const double *total = curve("curve")->total;
    assert_hits_knots("curve");
    for (int i = 1; i < 90; i++) assert_true(total[i] > total[i - 1]);
    for (int i = 2; i < 85; i++) assert_near(third_difference(total, i), third_difference(total, 1), 1e-12);
    assert_true(count_extrema(total, 96, 178, &smallest) >= 6);
}

/// Figure 3: three keyed knots on the real part; the imaginary part is computed, and turns a quarter of a period with it.
static void test_figure3(void **state)
{
    (void)state;
    open_figure("assets/scenes/figure3.json");
    const wiggly_curve *shown = curve("curve");
    double re = 0, im = 0, cross = 0;
    assert_hits_knots("curve");
    for (int i = 40; i < 104; i++) {
        re += shown->re[i] * shown->re[i];
        im += shown->im[i] * shown->im[i];
        cross += shown->re[i] * shown->im[i];
    }
    assert_true(im > 0.5 * re && im < 2 * re);
    assert_true(fabs(cross) < 0.2 * sqrt(re * im));
}

/// Figure 4: the third knot moves by a tenth of its span, and the curve stretches: as many swings, none of them lost.
static void test_figure4(void **state)
{
    (void)state;
    double before_smallest, moved_smallest;
    open_figure("assets/scenes/figure4.json");
    assert_hits_knots("before");
    assert_hits_knots("moved");
    int before = count_extrema(curve("before")->total, 36 + 3, 108 - 3, &before_smallest);
    int moved = count_extrema(curve("moved")->total, 36 + 3, 115 - 3, &moved_smallest);
    assert_int_equal(before, 5);
    assert_int_equal(moved, 5);
    assert_near(moved_smallest, 0.795, 0.0005); // 0.598 without the second pole
}

/// Figure 5: the passive response follows the step of the equilibrium late, overshoots and dies down; the edited curve goes
/// through the knot and is the same kind of motion.
static void test_figure5(void **state)
{
    (void)state;
    double smallest, largest = 0;
    open_figure("assets/scenes/figure5.json");
    const wiggly_curve *still = curve("equilibrium"), *loose = curve("free"), *edited = curve("edited");
    for (int i = 0; i <= 192; i++) {
        assert_near(loose->y[i], still->total[i], 0);
        largest = fmax(largest, loose->total[i]);
    }
    assert_true(largest > 1.1);
    assert_true(count_extrema(loose->total, 55, 150, &smallest) >= 6);
    assert_true(fabs(loose->re[192]) < 0.1 * (largest - 1));
    assert_hits_knots("edited");
    assert_near(edited->total[100], 0.2, 0);
    assert_true(fabs(edited->re[192]) < 0.2);
    assert_near(edited->total[0], loose->total[0], 1e-12); // both start from rest
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_figure1, close_figure),
        cmocka_unit_test_teardown(test_figure3, close_figure),
        cmocka_unit_test_teardown(test_figure4, close_figure),
        cmocka_unit_test_teardown(test_figure5, close_figure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
