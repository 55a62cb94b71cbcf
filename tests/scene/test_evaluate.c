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

/// As near as floats are to doubles of the values' size; nothing is written beside them or behind.
static void compare(const wiggly_curve *curve, double from, double by, int count)
{
    static float out[(COUNT + 1) * STRIDE];
    for (int i = 0; i < (count + 1) * STRIDE; i++) out[i] = -77;
    wiggly_evaluate_float(curve, from, by, count, out, STRIDE);
    for (int i = 0; i <= count; i++) {
        const wiggly_value value = wiggly_evaluate(curve, from + by * i);
        const double total = i < count ? value.y + value.re : -77;
        if (!(out[STRIDE * i + 1] == -77 && out[STRIDE * i + 2] == -77)) fail_msg("written beside %d", i);
        if (isnan(total) && isnan(out[STRIDE * i])) continue;
        assert_near(out[STRIDE * i], total, 2e-7 * fmax(1, fmax(fabs(total), hypot(value.re, value.im))));
    }
}

static void sweep(const wiggly_curve *curve)
{
    static const double steps[] = {1e-4, 1.0 / 77, 0.07, 0.1, 0.3, 0.4,    0.5,  0.7,  1,  1.3,
                                   2,    2.5,      7,    40,  0,   -0.013, -0.2, -0.4, -1, -3.7};
    const int count = quick_or_all(2500, COUNT);
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
        compare(curve, 0, steps[s], count);
        compare(curve, 17.3, steps[s], count);
        compare(curve, -30.6, steps[s], count);
        compare(curve, curve->samples - 1.2, steps[s], count - 5);
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

// --- in seconds, with what changes ---------------------------------------------------------------------------------------

/// What a hand-made curve is of: x of a swing e^{(−decay + jω)t}, or a parabola, on an equilibrium that is a parabola.
static const struct motion {
    const char *what;
    wiggly_mode mode;
    double decay, omega, near; ///< near: how close a value comes; its change ten times as far in a second
} motions[] = {
    {"a parabola", WIGGLY_REAL, 0, 0, 1e-12},           {"a cubic's parabola", WIGGLY_CUBIC, 0, 0, 1e-12},
    {"an undamped swing", WIGGLY_COMPLEX, 0, 9, 1e-12}, {"a fast one", WIGGLY_COMPLEX, 0, 140, 1e-12},
    {"a damped one", WIGGLY_COMPLEX, 0.8, 7.5, 1e-5},
};

static wiggly_value motion_at(const struct motion *m, double t, wiggly_value *rate)
{
    const double y = 0.5 - t + 0.25 * t * t, dy = -1 + 0.5 * t;
    if (m->mode != WIGGLY_COMPLEX) {
        *rate = (wiggly_value){dy, 2 - 0.6 * t, 0};
        return (wiggly_value){y, 1 + 2 * t - 0.3 * t * t, 0};
    }
    const double size = exp(-m->decay * t), re = size * cos(m->omega * t), im = size * sin(m->omega * t);
    *rate = (wiggly_value){dy, -m->decay * re - m->omega * im, -m->decay * im + m->omega * re};
    return (wiggly_value){y, re, im};
}

static void assert_value(wiggly_value got, wiggly_value expected, double near, const char *what, double t)
{
    const double off = fmax(fabs(got.y - expected.y), fmax(fabs(got.re - expected.re), fabs(got.im - expected.im)));
    if (!(off <= near)) fail_msg("%s, at %g s: off by %g", what, t, off);
}

TEST(values_and_changes_are_those_of_the_motion)
{
    for (size_t m = 0; m < sizeof motions / sizeof *motions; m++) {
        wiggly_curve curve = curve_create(SAMPLES);
        wiggly_value rate, own;
        curve.samples = SAMPLES, curve.step = 1.0 / 24, curve.mode = motions[m].mode, curve.start = WIGGLY_FREE;
        for (int i = 0; i < SAMPLES; i++) {
            const wiggly_value at = motion_at(&motions[m], i / 24.0, &rate);
            curve.y[i] = at.y, curve.re[i] = at.re, curve.im[i] = at.im, curve.omega[i] = motions[m].omega;
        }
        for (double t = 0; t < (SAMPLES - 1) / 24.0; t += 0.0137) {
            wiggly_value expected = motion_at(&motions[m], t, &rate), value = wiggly_evaluate_at(&curve, t, &own);
            if (t < 1.0 / 24 || t > (SAMPLES - 2) / 24.0) expected.y = value.y, rate.y = own.y; // y ends straight
            assert_value(value, expected, 20 * motions[m].near, motions[m].what, t);
            assert_value(own, rate, 2000 * motions[m].near, motions[m].what, t);
        }
        curve_destroy(&curve);
    }
}

/// Behind its last knot a solved spline turns by its pole: x there times e^{pt}.
TEST(a_solved_swing_dies_away_as_its_pole_says)
{
    const wiggly_knot knots[] = {{.sample = 0}, {.sample = 40, .value = 1}};
    wiggly_desc desc = {.size = sizeof desc, .samples = SAMPLES, .knots = knots, .knot_count = 2};
    desc.frequency.value = 1.2, desc.damping.value = 0.08;
    wiggly_curve curve = curve_create(SAMPLES);
    curve_solve(&curve, &desc);
    const wiggly_poles poles = wiggly_poles_at(&desc, 0);
    const double d = poles.s[0][0], w = poles.s[0][1], x[2] = {curve.re[40], curve.im[40]};
    for (double t = 0.05; t < 8; t += 0.0113) {
        const double size = exp(d * t), c = size * cos(w * t), s = size * sin(w * t);
        const double re = c * x[0] - s * x[1], im = s * x[0] + c * x[1];
        wiggly_value rate, value = wiggly_evaluate_at(&curve, 40 / 24.0 + t, &rate);
        assert_value(value, (wiggly_value){0, re, im}, 1e-5, "the swing", t);
        assert_value(rate, (wiggly_value){0, d * re - w * im, d * im + w * re}, 1e-3, "its speed", t);
    }
    curve_destroy(&curve);
}

/// In every mode and start: exact at samples whatever the step, the change that of the values, still beyond the ends, round in loops.
TEST(time_is_position_times_the_step)
{
    static const double steps[] = {1.0 / 24, 1.0 / 30, 0.1, 1001.0 / 30000, 1e-4 / 3};
    for (int n = 0; n < 9 * 5; n++) {
        wiggly_curve curve = solved((wiggly_mode)(n % 3), (wiggly_start)(n / 3 % 3), NULL, SAMPLES);
        const double step = curve.step = steps[n / 9], end = (SAMPLES - 1) * step;
        const bool is_loop = curve.start == WIGGLY_LOOP;
        wiggly_value rate;
        for (int i = 0; i < curve.samples - is_loop; i++) {
            const wiggly_value value = wiggly_evaluate_at(&curve, i * step, NULL);
            assert_true(value.y == curve.y[i] && value.re == curve.re[i] && value.im == curve.im[i]);
        }
        for (double at = 0.3; at < SAMPLES - 1; at += 0.577) {
            const double t = at * step, little = 1e-5 * step, over = is_loop ? t + 3 * end : t;
            const wiggly_value a = wiggly_evaluate_at(&curve, t - little, NULL),
                               b = wiggly_evaluate_at(&curve, t + little, NULL);
            const double slope = (b.re - a.re) / (2 * little), size = fmax(1, fabs(slope)) + 10 / step;
            wiggly_evaluate_at(&curve, over, &rate);
            assert_near(rate.re, slope, 1e-5 * size);
        }
        for (int side = 0; side < 2 && !is_loop; side++) {
            const wiggly_value out = wiggly_evaluate_at(&curve, side ? end + 1 : -1, &rate);
            assert_true(out.re == curve.re[side ? SAMPLES - 1 : 0]);
            assert_true(rate.y == 0 && rate.re == 0 && rate.im == 0);
        }
        if (is_loop) { // no kink at the seam
            wiggly_value before;
            wiggly_evaluate_at(&curve, end - 1e-7 * step, &before);
            wiggly_evaluate_at(&curve, 0, &rate);
            assert_near(before.re, rate.re, 1e-3 / step);
        }
        curve_destroy(&curve);
    }
}

TEST(a_curve_without_what_it_takes_is_no_number)
{
    wiggly_curve curve = solved(WIGGLY_COMPLEX, WIGGLY_FREE, NULL, SAMPLES), lacking = curve,
                 none = {.size = sizeof none};
    wiggly_value rate = {1, 1, 1};
    lacking.omega = NULL;
    assert_true(isnan(wiggly_evaluate_at(&lacking, 1, &rate).re) && isnan(rate.re));
    assert_true(wiggly_evaluate_at(&none, 1, &rate).re == 0 && rate.re == 0);
    curve_destroy(&curve);
}

TEST(nowhere_is_no_number)
{
    for (int n = 0; n < 9; n++) {
        wiggly_curve curve = solved((wiggly_mode)(n % 3), (wiggly_start)(n / 3), NULL, SAMPLES);
        const double times[] = {NAN, INFINITY, -INFINITY};
        for (int t = 0; t < 3; t++) {
            wiggly_value rate, value = wiggly_evaluate_at(&curve, times[t], &rate);
            const bool is_nowhere = t == 0 || curve.start == WIGGLY_LOOP;
            assert_true(isnan(value.y) == is_nowhere && isnan(value.re) == is_nowhere &&
                        isnan(value.im) == is_nowhere);
            assert_true(is_nowhere ? isnan(rate.re) : rate.re == 0);
            assert_true(is_nowhere || value.re == curve.re[t == 1 ? SAMPLES - 1 : 0]);
        }
        curve_destroy(&curve);
    }
}

/// Whatever the rate, from both sides, at ends and between; without stiffness as the curve runs.
TEST(the_change_at_a_knot_with_a_slope_is_that_slope)
{
    static const double slopes[] = {2, -3, 1};
    static const int rates[] = {24, 30, 100}, at[] = {0, 20, 50};
    double wave[SAMPLES], slope[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) wave[i] = 0.3 * sin(0.05 * i);
    for (int n = 0; n < 3 * 3 * 2 * 3 * 2; n++) {
        const int rate = rates[n / 18 % 3], late = n % 9 / 3 == WIGGLY_FREE ? 5 : 0, samples = late + 2 * rate + 1;
        wiggly_knot knots[3];
        for (int k = 0; k < 3; k++)
            knots[k] = (wiggly_knot){.sample = late + at[k] * rate / 25 - (k == 2 && n % 9 / 3 == WIGGLY_LOOP),
                                     .has_slope = true,
                                     .value = 0.5 * k,
                                     .slope = slopes[k],
                                     .stiffness = 1e9};
        wiggly_desc desc = {.size = sizeof desc, .knots = knots, .knot_count = 3, .samples = samples};
        desc.step = 1.0 / rate, desc.mode = (wiggly_mode)(n % 3), desc.start = (wiggly_start)(n % 9 / 3);
        desc.passive = (wiggly_passive)(n / 9 % 2);
        desc.frequency.value = 1.5, desc.damping.value = 0.1, desc.bandwidth.value = 0.1;
        if (n / 54) desc.equilibrium.track = wave;
        wiggly_curve curve = curve_create(samples);
        curve.slope = slope;
        curve_solve(&curve, &desc);
        for (int k = 0; k < 3; k++) {
            wiggly_value value;
            for (int side = -1; side <= 1; side++) {
                if ((side < 0 && knots[k].sample == curve.first) || (side > 0 && knots[k].sample == samples - 1))
                    continue;
                wiggly_evaluate_at(&curve, (knots[k].sample + 1e-8 * side) / rate, &value);
                assert_near(value.y + value.re, slopes[k], 1e-4);
            }
        }
        for (int i = 0; i < samples - (desc.start == WIGGLY_LOOP); i++)
            assert_true(isnan(slope[i]) == (i != knots[0].sample && i != knots[1].sample && i != knots[2].sample));
        for (int k = 0; k < 3; k++) knots[k].stiffness = 1e-9;
        curve_solve(&curve, &desc);
        wiggly_value own, plain;
        wiggly_evaluate_at(&curve, (double)knots[1].sample / rate, &own);
        curve.slope = NULL;
        wiggly_evaluate_at(&curve, (double)knots[1].sample / rate, &plain);
        assert_near(own.re, plain.re, 1e-6);
        curve_destroy(&curve);
    }
}

/// A cubic's speed at an end is the one that its slope there was solved for, without `slope`, too.
TEST(a_cubic_ends_with_its_slope)
{
    const wiggly_knot knots[] = {{.sample = 0, .has_slope = true, .slope = 2, .stiffness = 1e12},
                                 {.sample = 24, .value = 1},
                                 {.sample = 48, .has_slope = true, .slope = 1, .stiffness = 1e12}};
    const wiggly_desc desc = {
        .size = sizeof desc, .knots = knots, .knot_count = 3, .samples = 49, .mode = WIGGLY_CUBIC};
    wiggly_curve curve = curve_create(49);
    curve_solve(&curve, &desc);
    for (int side = 0; side < 2; side++) {
        wiggly_value rate;
        wiggly_evaluate_at(&curve, 2 * side, &rate);
        assert_near(rate.re, 2 - side, 1e-6);
    }
    curve_destroy(&curve);
}

TEST(many_times_are_as_one_by_one)
{
    double frequencies[SAMPLES], seconds[300];
    for (int i = 0; i < SAMPLES; i++) frequencies[i] = i < 100 ? 1.5 : 2 + sin(0.05 * i);
    for (int n = 0; n < 9; n++) {
        wiggly_curve curve = solved((wiggly_mode)(n % 3), (wiggly_start)(n / 3), frequencies, SAMPLES);
        wiggly_value values[300], rates[300], own[2][300];
        for (int i = 0; i < 300; i++) seconds[i] = i == 7 ? NAN : (i * 89 % 300 - 20) / (i % 3 ? 24.0 : 25.3);
        wiggly_evaluate_many(&curve, seconds, 300, values, rates);
        wiggly_evaluate_many(&curve, seconds, 300, own[0], NULL);
        wiggly_evaluate_many(&curve, seconds, 300, NULL, own[1]);
        assert_memory_equal(own[0], values, sizeof values);
        assert_memory_equal(own[1], rates, sizeof rates);
        for (int i = 0; i < 300; i++) {
            wiggly_value rate, value = wiggly_evaluate_at(&curve, seconds[i], &rate);
            assert_memory_equal(&value, &values[i], sizeof value);
            assert_memory_equal(&rate, &rates[i], sizeof rate);
        }
        curve_destroy(&curve);
    }
}
