/// Rows of float values against wiggly_evaluate(), value by value: in every mode, in tiny and long steps, forwards, backwards, round
/// loops, beyond the ends, between frequencies that change.
#include "near.h"

#include "curve.h"

enum { SAMPLES = 240, KNOTS = 8, COUNT = 20000, STRIDE = 3 };

static wiggly_curve solved(wiggly_mode mode, wiggly_start start, const double *frequencies, int samples)
{
    wiggly_knot knots[KNOTS];
    int count = samples < 3 * KNOTS ? 1 : KNOTS;
    for (int k = 0; k < count; k++) knots[k] = (wiggly_knot){.sample = (k + 1) * samples / 10, .value = k % 3 - 1};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = samples;
    desc.mode = mode;
    desc.start = start;
    desc.frequency = (wiggly_param){.value = 1.5, .track = frequencies};
    desc.damping.value = 0.05;
    desc.knots = knots;
    desc.knot_count = count;
    wiggly_solver *solver = NULL;
    wiggly_curve curve = curve_create(samples);
    assert_int_equal(wiggly_create(samples, KNOTS, &solver), WIGGLY_OK);
    assert_true(wiggly_solve(solver, &desc, &curve) < WIGGLY_ERROR_ARGUMENT);
    wiggly_destroy(solver);
    return curve;
}

/// As near as floats are to doubles of the values' size.
static void compare(const wiggly_curve *curve, double from, double by, int count)
{
    static float out[COUNT * STRIDE];
    for (int i = 0; i < COUNT * STRIDE; i++) out[i] = -77;
    wiggly_evaluate_float(curve, from, by, count, out, STRIDE);
    for (int i = 0; i < COUNT; i++) {
        if (i < count) {
            wiggly_value value = wiggly_evaluate(curve, from + by * i);
            double total = value.y + value.re;
            assert_near(out[STRIDE * i], total, 2e-7 * fmax(1, fmax(fabs(total), hypot(value.re, value.im))));
        } else {
            assert_true(out[STRIDE * i] == -77);
        }
        assert_true(out[STRIDE * i + 1] == -77 && out[STRIDE * i + 2] == -77);
    }
}

static void sweep(const wiggly_curve *curve)
{
    static const double steps[] = {1e-4, 1.0 / 77, 0.07, 0.1, 0.3, 0.4,    0.5,  0.7,  1,  1.3,
                                   2,    2.5,      7,    40,  0,   -0.013, -0.2, -0.4, -1, -3.7};
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
        compare(curve, 0, steps[s], COUNT);
        compare(curve, 17.3, steps[s], COUNT);
        compare(curve, -30.6, steps[s], COUNT);
        compare(curve, curve->samples - 1.2, steps[s], COUNT - 5);
    }
    compare(curve, -1e-17, 0, 2); // a step before the seam that rounds to it
    compare(curve, NAN, 0.1, 10);
    compare(curve, INFINITY, 1, 10);
    compare(curve, 0, INFINITY, 10);
    compare(curve, -1e15, 1e14, 30);
    compare(curve, 3, 1, 0);
}

TEST(a_row_is_what_its_values_are)
{
    for (int mode = 0; mode < 3; mode++) {
        for (int start = 0; start < 3; start++) {
            wiggly_curve curve = solved((wiggly_mode)mode, (wiggly_start)start, NULL, SAMPLES);
            sweep(&curve);
            curve_destroy(&curve);
        }
    }
}

TEST(frequencies_that_change_are_followed)
{
    double frequencies[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) frequencies[i] = i < 100 ? 1 : i < 150 ? 1 + 0.01 * (i - 100) : 200;
    wiggly_curve curve = solved(WIGGLY_COMPLEX, WIGGLY_FREE, frequencies, SAMPLES);
    sweep(&curve);
    curve_destroy(&curve);
}

TEST(a_frequency_that_changes_everywhere_is_followed)
{
    double frequencies[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) frequencies[i] = 2 + sin(0.05 * i);
    for (int start = 0; start < 3; start++) {
        wiggly_curve curve = solved(WIGGLY_COMPLEX, (wiggly_start)start, frequencies, SAMPLES);
        sweep(&curve);
        curve_destroy(&curve);
    }
}

TEST(far_apart_a_value_is_the_same_in_every_row)
{
    wiggly_curve curve = solved(WIGGLY_COMPLEX, WIGGLY_FREE, NULL, SAMPLES);
    float near[2 * SAMPLES], far[SAMPLES];
    wiggly_evaluate_float(&curve, 0.125, 0.5, 2 * SAMPLES, near, 1);
    for (int steps = 1; steps < 20; steps++) {
        for (int from = 0; from < 40; from++) {
            int count = (2 * SAMPLES - from) / steps < SAMPLES ? (2 * SAMPLES - from) / steps : SAMPLES;
            wiggly_evaluate_float(&curve, 0.125 + 0.5 * from, 0.5 * steps, count, far, 1);
            for (int i = 0; i < count; i++) assert_true(far[i] == near[from + steps * i]);
        }
    }
    curve_destroy(&curve);
}

TEST(shortest_curves)
{
    for (int samples = 1; samples <= 5; samples++) {
        for (int start = samples == 1 ? 0 : 2; start >= 0; start--) {
            wiggly_curve curve = solved(WIGGLY_COMPLEX, (wiggly_start)start, NULL, samples);
            sweep(&curve);
            curve_destroy(&curve);
        }
    }
}

/// A band that turns many times between two samples.
TEST(a_band_far_above_the_sample_rate)
{
    wiggly_curve curve = solved(WIGGLY_COMPLEX, WIGGLY_FREE, NULL, SAMPLES);
    for (int i = 0; i < SAMPLES; i++) curve.omega[i] = i < 100 ? 24 * 5000.0 : 24e9;
    compare(&curve, 0, 0.25, 800);
    for (int i = 100; i < SAMPLES; i++) curve.omega[i] = 24e12;
    compare(&curve, 0, 0.7, 300);
    curve_destroy(&curve);
}

TEST(a_curve_that_was_never_solved_is_0)
{
    wiggly_curve curve = {0};
    wiggly_value value = wiggly_evaluate(&curve, 3);
    assert_true(value.y == 0 && value.re == 0 && value.im == 0);
    float out[2] = {5, 5};
    wiggly_evaluate_float(&curve, 3, 1, 2, out, 1);
    assert_true(out[0] == 0 && out[1] == 0);
}
