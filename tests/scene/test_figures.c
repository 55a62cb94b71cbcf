/// The paper's figures as scenes: each shows what the paper says it shows.
#include "documents.h"

#include "rig/posing.h"
#include "scene/load.h"
#include <complex.h>

static struct document *document;
static struct evaluation evaluation;

static void open_figure(const char *path)
{
    document = document_of_file(path);
    evaluation_update(&evaluation, document, false);
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
    const struct spline *spline = document->splines[document_find_spline(document, name)];
    for (int i = 0; i < spline->knot_count; i++) {
        int sample = document_sample(document, spline->knots[i].frame);
        assert_near(curve(name)->total[sample], spline->knots[i].value, 0);
    }
}

/// Figure 1: with the resonance at zero on the left the curve is a familiar cubic, rising without a swing; where the
/// resonance has jumped up it oscillates on its way to the third knot.
TEST_WITH(NULL, close_figure, test_figure1)
{
    double smallest;
    open_figure("assets/scenes/figure1.json");
    const double *total = curve("curve")->total;
    assert_hits_knots("curve");
    for (int i = 1; i < 90; i++) assert_true(total[i] > total[i - 1]);
    for (int i = 2; i < 85; i++) assert_near(third_difference(total, i), third_difference(total, 1), 1e-12);
    assert_true(count_extrema(total, 96, 178, &smallest) >= 6);
}

/// Figure 3: three keyed knots on the real part; the imaginary part is computed, and turns a quarter of a period with it.
TEST_WITH(NULL, close_figure, test_figure3)
{
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
TEST_WITH(NULL, close_figure, test_figure4)
{
    double before_smallest, moved_smallest;
    open_figure("assets/scenes/figure4.json");
    assert_hits_knots("before");
    assert_hits_knots("moved");
    int before = count_extrema(curve("before")->total, 36 + 3, 108 - 3, &before_smallest);
    int moved = count_extrema(curve("moved")->total, 36 + 3, 115 - 3, &moved_smallest);
    assert_int_equal(before, 5);
    assert_int_equal(moved, 5);
    assert_near(moved_smallest, 0.795, 0.0005);
    for (int i = 0; i < document->spline_count; i++)
        document_own_spline(document, i)->parameter[PARAMETER_MODE].value = WIGGLY_REAL;
    evaluation_update(&evaluation, document, false);
    assert_int_equal(count_extrema(curve("moved")->total, 36 + 3, 115 - 3, &moved_smallest), 5);
    assert_near(moved_smallest, 0.598, 0.0005); // the sharp resonance cannot stretch, and finds another way
}

/// The same filter run forwards on its own: x_{i+1} = a x_i + b x_{i−1} − g (y_{i+1} − 2y_i + y_{i−1}) from rest (eq. 25).
static void assert_forward_response(const wiggly_curve *shown, const struct spline *spline, double step)
{
    const double omega = 2 * M_PI * spline->parameter[PARAMETER_FREQUENCY].value;
    const double zeta = spline->parameter[PARAMETER_DAMPING].value;
    const double turn = omega * spline->parameter[PARAMETER_BANDWIDTH].value;
    const double complex pole = -zeta * omega + I * omega * sqrt(1 - zeta * zeta);
    const double complex l0 = cexp((pole + I * turn) * step), l1 = cexp((pole - I * turn) * step);
    const double complex a = l0 + l1, b = -l0 * l1, g = cexp(pole * step);
    const double *y = shown->y;
    double complex before = 0, now = 0;
    for (int i = 1; i + 1 < shown->samples; i++) {
        double complex next = a * now + b * before - g * (y[i + 1] - 2 * y[i] + y[i - 1]);
        assert_near(shown->re[i + 1], creal(next), 1e-9);
        assert_near(shown->im[i + 1], cimag(next), 1e-9);
        before = now;
        now = next;
    }
}

/// Figure 5: the passive response follows the step of the equilibrium late, overshoots and dies down; the edited curve goes
/// through the knot and is the same kind of motion.
TEST_WITH(NULL, close_figure, test_figure5)
{
    double smallest, largest = 0;
    open_figure("assets/scenes/figure5.json");
    const wiggly_curve *still = curve("equilibrium"), *loose = curve("free"), *edited = curve("edited");
    for (int i = 0; i <= 192; i++) {
        assert_near(loose->y[i], still->total[i], 0);
        largest = fmax(largest, loose->total[i]);
    }
    assert_forward_response(loose, document->splines[document_find_spline(document, "free")],
                            document_step(document));
    assert_true(largest > 1.1);
    assert_true(count_extrema(loose->total, 55, 150, &smallest) >= 6);
    assert_true(fabs(loose->re[192]) < 0.1 * (largest - 1));
    assert_hits_knots("edited");
    assert_near(edited->total[100], 0.2, 0);
    assert_true(fabs(edited->re[192]) < 0.2);
    assert_near(edited->total[0], loose->total[0], 1e-12); // both start from rest
}

/// How far a tail's joint has turned the tail aside, radians.
static double heading(const struct pose *pose, int joint)
{
    const float *z = &pose->matrix[joint][8];
    return atan2(z[0], z[2]);
}

/// Figure 6: each joint bends as the first one does, later by its lag: the tip reaches its turning point well after the base.
TEST_WITH(NULL, close_figure, test_figure6)
{
    enum { BASE = 0, LATE = 18 };
    open_figure("assets/scenes/figure6.json");
    const struct tail *tail = document_tail(document, 0);
    const struct posing posing = {.document = document, .evaluation = &evaluation};
    double bend[2][128], best = -INFINITY;
    int lag = 0, count = evaluation.samples;
    assert_in_range(count, 100, 128);
    for (int i = 0; i < count; i++) {
        struct rig_pose pose;
        assert_true(rig_pose(&posing, 0, i, NULL, &pose));
        bend[0][i] = heading(&pose.strand, BASE);
        bend[1][i] = heading(&pose.strand, LATE) - heading(&pose.strand, LATE - 1);
    }
    for (int shift = 0; shift < 24; shift++) {
        double sum = 0;
        for (int i = 24; i + shift < count; i++) sum += bend[0][i] * bend[1][i + shift];
        if (sum > best) lag = shift, best = sum;
    }
    double expected = LATE * tail->channels[0].lag.value[0] / 360 * 24; // frames, at 1 Hz
    assert_true(fabs(lag - expected) <= 1.5);
}

static const double knot_value[] = {0, 1, -0.5, 0.7}, knot_slope[] = {0.5, 0, -1, 2};
static const int knot_frame[] = {0, 24, 60, 96};

/// The largest difference, at every eighth frame, between our cubic through four knots and numbers that SciPy made.
static double cubic_error(int substeps, double stiffness, const double *expected)
{
    enum { KNOTS = 4, FRAMES = 96 };
    double *rows = malloc(sizeof *rows * 4 * (FRAMES * (size_t)substeps + 1)), worst = 0;
    wiggly_solver *solver;
    wiggly_knot knots[KNOTS];
    wiggly_desc desc = wiggly_default_desc();
    size_t n = FRAMES * (size_t)substeps + 1;
    for (int i = 0; i < KNOTS; i++) {
        knots[i] = (wiggly_knot){.sample = knot_frame[i] * substeps,
                                 .has_slope = stiffness > 0,
                                 .value = knot_value[i],
                                 .slope = knot_slope[i],
                                 .stiffness = stiffness};
    }
    desc.mode = WIGGLY_CUBIC;
    desc.passive = WIGGLY_FILTER; // the textbook's ends: nothing is held behind the last knot
    desc.samples = (int)n;
    desc.step = 1.0 / (24 * substeps);
    desc.knots = knots;
    desc.knot_count = KNOTS;
    wiggly_curve solved = {
        .size = sizeof solved, .total = rows, .y = rows + n, .re = rows + 2 * n, .im = rows + 3 * n};
    assert_non_null(rows);
    assert_int_equal(wiggly_create((int)n, KNOTS, &solver), WIGGLY_OK);
    assert_int_equal(wiggly_solve(solver, &desc, &solved), WIGGLY_OK);
    for (int i = 0; i <= FRAMES / 8; i++) worst = fmax(worst, fabs(rows[8 * i * substeps] - expected[i]));
    wiggly_destroy(solver);
    free(rows);
    return worst;
}

/// Without tangents the classical spline is the natural C² cubic (scipy.interpolate.CubicSpline, bc_type="natural").
TEST(test_cubic_is_the_natural_spline)
{
    static const double natural[] = {0,
                                     0.4902902902902902,
                                     0.86286286286286262,
                                     1,
                                     0.82736069402736068,
                                     0.44411077744411065,
                                     -0.0072072072072071336,
                                     -0.38405071738405083,
                                     -0.54818151484818145,
                                     -0.46036036036036038,
                                     -0.18034701368034683,
                                     0.22779446112779428,
                                     0.70000000000000051};
    double coarse = cubic_error(4, 0, natural), fine = cubic_error(32, 0, natural);
    assert_true(coarse < 1e-3 && fine < 1e-5);
    assert_true(fine < coarse / 50); // as h²
}

/// With tangents that are held more and more firmly it becomes the Hermite cubic (scipy.interpolate.CubicHermiteSpline): global
/// smoothness at one end of the scale, local support at the other.
TEST(test_stiff_tangents_make_the_hermite_cubic)
{
    static const double hermite[] = {0,
                                     0.33333333333333326,
                                     0.77777777777777768,
                                     1,
                                     0.86831275720164613,
                                     0.53909465020576131,
                                     0.11111111111111116,
                                     -0.3168724279835391,
                                     -0.62345679012345667,
                                     -0.63333333333333341,
                                     -0.37654320987654311,
                                     0.087654320987654077,
                                     0.69999999999999984};
    double before = INFINITY;
    for (double stiffness = 0.01; stiffness < 1e5; stiffness *= 100) {
        double error = cubic_error(32, stiffness, hermite);
        assert_true(error < before);
        before = error;
    }
    double coarse = cubic_error(16, 1e8, hermite), fine = cubic_error(64, 1e8, hermite);
    assert_true(coarse < 0.01 && fine < 0.3 * coarse); // as h: eq. 9 holds the slope half a sample late
}
