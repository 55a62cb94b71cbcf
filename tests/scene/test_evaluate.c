/// What is read of curves: rows of float values against wiggly_evaluate(), values and changes in seconds against the motion, and values of
/// any size a double can hold against those of ordinary ones.
#include "near.h"

#include "curve.h"
#include "uniform.h"
#include <wiggly/more.h>

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

enum track { STEADY, TURNING, JUMPING }; ///< in frequency

static const double *frequencies_of(enum track track)
{
    static double frequencies[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) {
        frequencies[i] = i < 100 ? 1 : i < 150 ? 1 + 0.01 * (i - 100) : 200;
        if (track == TURNING) frequencies[i] = 2 + sin(0.05 * i);
    }
    return track == STEADY ? NULL : frequencies;
}

/// In every mode and start, at frequencies that change, and of the shortest curves.
TEST(a_row_is_what_its_values_are)
{
    static const struct {
        int modes, starts;
        enum track track;
        int samples;
    } rows[] = {{3, 3, STEADY, SAMPLES}, {1, 1, JUMPING, SAMPLES}, {1, 3, TURNING, SAMPLES}, {1, 1, STEADY, 1},
                {1, 3, STEADY, 2},       {1, 3, STEADY, 3},        {1, 3, STEADY, 4},        {1, 3, STEADY, 5}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        for (int n = 0; n < rows[i].modes * rows[i].starts; n++) {
            wiggly_curve curve = solved((wiggly_mode)(n / rows[i].starts), (wiggly_start)(n % rows[i].starts),
                                        frequencies_of(rows[i].track), rows[i].samples);
            sweep(&curve);
            curve_destroy(&curve);
        }
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

/// A curve that was never solved is 0; one without what it takes is no number.
TEST(curves_that_lack_their_rows)
{
    wiggly_curve curve = solved(WIGGLY_COMPLEX, WIGGLY_FREE, NULL, SAMPLES), lacking = curve,
                 none = {.size = sizeof none};
    wiggly_value rate = {1, 1, 1}, value = wiggly_evaluate(&none, 3);
    float out[2] = {5, 5};
    lacking.omega = NULL;
    assert_true(isnan(wiggly_evaluate_at(&lacking, 1, &rate).re) && isnan(rate.re));
    assert_true(wiggly_evaluate_at(&none, 1, &rate).re == 0 && rate.re == 0);
    assert_true(value.y == 0 && value.re == 0 && value.im == 0);
    wiggly_evaluate_float(&none, 3, 1, 2, out, 1);
    assert_true(out[0] == 0 && out[1] == 0);
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

// --- values of any size: those of ordinary ones, times the power of two between them, bit for bit. (The search for samples that limits
// hold takes roots: there the last digits may differ.)

enum { SIZED = 90, SIZED_KNOTS = 5 };

static const int exponents[] = {515, -515, 660, -665, 990, -995};
enum { EXPONENTS = sizeof exponents / sizeof *exponents };

/// A description with its arrays.
struct subject {
    wiggly_desc desc;
    wiggly_knot knots[SIZED_KNOTS];
    double y[SIZED];
};

/// All of its values times 2ⁿ.
static void times(struct subject *s, int n)
{
    for (int k = 0; k < SIZED_KNOTS; k++) {
        wiggly_knot *knot = &s->knots[k];
        knot->value = ldexp(knot->value, n), knot->slope = ldexp(knot->slope, n), knot->phase = ldexp(knot->phase, n);
    }
    for (int i = 0; i < SIZED; i++) s->y[i] = ldexp(s->y[i], n);
    s->desc.equilibrium.value = ldexp(s->desc.equilibrium.value, n);
    s->desc.low = ldexp(s->desc.low, n), s->desc.high = ldexp(s->desc.high, n);
}

/// Every mode, start and way to move, with slopes, phases, tracks, limits and variations in turn.
static void make(struct subject *s, uint64_t seed)
{
    const uint64_t kind = seed;
    for (int i = 0; i < 20; i++) uniform(&seed);
    s->desc = wiggly_default_desc();
    s->desc.samples = SIZED;
    s->desc.mode = (wiggly_mode)(kind % 3);
    s->desc.start = (wiggly_start)(kind / 3 % 3);
    s->desc.passive = kind / 9 % 3 == 2 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    s->desc.frequency.value = 0.3 + 2 * uniform(&seed);
    s->desc.damping.value = 0.3 * uniform(&seed);
    s->desc.calm = kind % 7 == 0 ? 0 : 1;
    s->desc.knots = s->knots;
    s->desc.knot_count = SIZED_KNOTS;
    for (int k = 0; k < SIZED_KNOTS; k++) {
        s->knots[k] = (wiggly_knot){.sample = 3 + 17 * k, .value = uniform(&seed) - 0.4, .stiffness = 100};
        s->knots[k].has_slope = uniform(&seed) < 0.3;
        s->knots[k].has_phase = uniform(&seed) < 0.3;
        s->knots[k].slope = uniform(&seed), s->knots[k].phase = uniform(&seed);
    }
    for (int i = 0; i < SIZED; i++) s->y[i] = 0.3 * sin(0.2 * i);
    s->desc.equilibrium.value = uniform(&seed);
    if (kind / 2 % 3 == 0) s->desc.equilibrium.track = s->y;
    if (kind / 3 % 5 == 0) s->desc.variation = 0.3;
    s->desc.has_high = kind % 4 == 0, s->desc.high = 0.7;
    s->desc.has_low = kind % 8 == 0, s->desc.low = -0.6;
}

static void assert_times(const double *found, const double *ordinary, int n, double tolerance)
{
    for (int i = 0; i < SIZED; i++) {
        if (!(fabs(ldexp(found[i], -n) - ordinary[i]) <= tolerance))
            fail_msg("2^%d: sample %d is %.17g, not %.17g", n, i, found[i], ldexp(ordinary[i], n));
    }
}

static void assert_curve(const wiggly_curve *found, const wiggly_curve *ordinary, int n, bool is_limited)
{
    const double tolerance = is_limited ? 1e-13 : 0;
    assert_times(found->total, ordinary->total, n, tolerance);
    assert_times(found->y, ordinary->y, n, 0);
    assert_times(found->re, ordinary->re, n, tolerance);
    assert_times(found->im, ordinary->im, n, tolerance);
    for (int i = 0; i < 2; i++) assert_near(ldexp(found->before[i], -n), ordinary->before[i], tolerance);
    if (is_limited) return;
    if (found->error != ordinary->error) fail_msg("2^%d: error %g, not %g", n, found->error, ordinary->error);
}

/// One solver for all of them, so that whatever it keeps of the one before must not matter.
TEST(one_spline_after_another)
{
    wiggly_solver *solver;
    wiggly_curve ordinary = curve_create(SIZED), found = curve_create(SIZED);
    assert_int_equal(wiggly_create(SIZED, SIZED_KNOTS + SIZED, &solver), WIGGLY_OK);
    for (uint64_t kind = 0; kind < 270; kind++) {
        struct subject s;
        make(&s, kind);
        wiggly_set_method(solver, kind % 2 ? WIGGLY_BAND : WIGGLY_CHAIN);
        const wiggly_status status = wiggly_solve(solver, &s.desc, &ordinary);
        assert_true(status < WIGGLY_SINGULAR);
        for (int e = 0; e < EXPONENTS; e++) {
            times(&s, exponents[e]);
            assert_int_equal(wiggly_solve(solver, &s.desc, &found), status);
            assert_curve(&found, &ordinary, exponents[e], s.desc.has_high);
            times(&s, -exponents[e]);
        }
        s.knots[1].value += 0.01; // the rest is as it was
        assert_int_equal(wiggly_solve(solver, &s.desc, &found), wiggly_solve(solver, &s.desc, &ordinary));
        times(&s, 700);
        wiggly_solve(solver, &s.desc, &found);
        assert_curve(&found, &ordinary, 700, s.desc.has_high);
    }
    wiggly_destroy(solver);
    curve_destroy(&ordinary);
    curve_destroy(&found);
}

/// What cannot be solved says so at any size, and what is not exact is off by the same share.
TEST(statuses_and_errors_are_the_same)
{
    wiggly_solver *solver;
    wiggly_curve curve = curve_create(1501);
    assert_int_equal(wiggly_create(1501, 4, &solver), WIGGLY_OK);
    wiggly_knot knots[4] = {{.sample = 0, .value = 1}, {.sample = 400, .value = -2}, {.sample = 1200, .value = 0.5}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = 1501, desc.knots = knots, desc.knot_count = 3;
    desc.frequency.value = 0.2, desc.calm = 1e-10;
    desc.passive = WIGGLY_FILTER;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_INEXACT);
    const double error = curve.error, last = curve.total[1500];
    for (int k = 0; k < 3; k++) knots[k].value = ldexp(knots[k].value, 800);
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_INEXACT);
    assert_true(curve.error == error && curve.total[1500] == ldexp(last, 800));
    knots[1].value = 1.1e300;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_ERROR_KNOT_NUMBER);
    assert_int_equal(curve.knot, 1);
    knots[1].value = 1e300;
    desc.has_high = true, desc.high = 0.9e300;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_ERROR_KNOT_LIMIT);
    wiggly_destroy(solver);
    curve_destroy(&curve);
}

/// Small beside large: knots keep their values, and what has no weight does not decide the size.
TEST(small_values_beside_large_ones)
{
    wiggly_solver *solver;
    double total[SIZED], y[SIZED];
    float floats[SIZED];
    assert_int_equal(wiggly_create(SIZED, 3, &solver), WIGGLY_OK);
    wiggly_knot knots[] = {
        {.sample = 0, .value = 1e-200}, {.sample = 40, .value = 1e200}, {.sample = 70, .value = 1}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SIZED, desc.knots = knots, desc.knot_count = 3;
    desc.frequency.value = 1, desc.damping.value = 0.1;
    wiggly_curve curve = {.size = sizeof curve, .total = total, .floats = floats};
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    for (int k = 0; k < 3; k++) assert_true(total[knots[k].sample] == knots[k].value);
    assert_true(isinf(floats[40]) && floats[70] == 1);

    for (int i = 0; i < SIZED; i++) y[i] = 1e-200 * sin(i); // the caller's own array is both
    knots[1].value = 3e-200, knots[2].value = 0;
    desc.equilibrium.track = curve.y = y;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    for (int i = 0; i < SIZED; i++) assert_true(y[i] == 1e-200 * sin(i));

    const wiggly_knot light = {.sample = 40, .value = 1, .has_slope = true, .slope = 1e250, .stiffness = 1e-290};
    knots[0].value = 0.5, knots[1] = light;
    desc.equilibrium.track = NULL;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    assert_true(fabs(total[20]) > 1e-3 && fabs(total[20]) < 10);
    wiggly_destroy(solver);
}

TEST(many_at_once)
{
    enum { FOUR = 4 };
    wiggly_batch *batch;
    assert_int_equal(wiggly_batch_create(SIZED, SIZED_KNOTS, 2, &batch), WIGGLY_OK);
    struct subject s;
    make(&s, 1);
    static double total[2][FOUR][SIZED], each[FOUR * SIZED];
    wiggly_desc descs[FOUR];
    wiggly_curve curves[FOUR];
    double sample[FOUR][3], value[FOUR][3];
    for (int i = 0; i < FOUR; i++) {
        for (int k = 0; k < 3; k++)
            sample[i][k] = 10 + 30 * k, value[i][k] = ldexp(0.3 + k, i == 0 ? 0 : exponents[i]);
        descs[i] = s.desc;
        curves[i] = (wiggly_curve){.size = sizeof(wiggly_curve), .total = total[0][i]};
    }
    struct subject large = s;
    times(&large, 660);
    large.desc.knots = large.knots, large.desc.equilibrium.track = large.y;
    descs[2] = large.desc;
    assert_int_equal(wiggly_batch_solve(batch, descs, curves, NULL, FOUR), WIGGLY_OK);
    assert_times(total[0][2], total[0][0], 660, 0);
    assert_times(total[0][3], total[0][0], 0, 0);

    const wiggly_many many = {.size = sizeof many,
                              .count = FOUR,
                              .knot_count = 3,
                              .sample = {&sample[0][0], 3, 1},
                              .value = {&value[0][0], 3, 1},
                              .total = {each, 1, FOUR}};
    s.desc.equilibrium = (wiggly_param){0};
    assert_int_equal(wiggly_batch_solve_many(batch, &s.desc, &many), WIGGLY_OK);
    for (int i = 0; i < FOUR; i++) {
        for (int k = 0; k < SIZED; k++) total[1][i][k] = each[FOUR * k + i];
        assert_times(total[1][i], total[1][0], i == 0 ? 0 : exponents[i], 0);
    }
    wiggly_batch_destroy(batch);
}

/// Two splines that share a pin and a bound, of which one has no values of its own.
TEST(groups)
{
    wiggly_group *group;
    wiggly_curve curves[2][2];
    for (int i = 0; i < 4; i++) curves[i / 2][i % 2] = curve_create(SIZED);
    assert_int_equal(wiggly_group_create_bounded(SIZED, SIZED_KNOTS, 2, 1, 1, &group), WIGGLY_OK);
    const wiggly_pull pulls[] = {{0, {{1, 0.2}, {0, 0.1}, {0, 0}}}, {1, {{0.5, 0}, {0.3, -0.2}, {0, 0}}}};
    const double c[][2] = {{1, 0.1}, {0.7, 0}}, weights[] = {1, 0.5};
    for (int moves = 0; moves < 2; moves++) {
        struct subject s[2];
        make(&s[0], 0), make(&s[1], 18);
        for (int i = 0; i < 2; i++) s[i].desc.calm = 1, s[i].desc.mode = WIGGLY_COMPLEX;
        s[1].desc.passive = WIGGLY_OSCILLATOR;
        s[1].desc.knot_count = 0;
        if (moves) s[1].desc.equilibrium.track = s[1].y;
        wiggly_desc descs[] = {s[0].desc, s[1].desc};
        descs[0].knots = s[0].knots;
        wiggly_pin pin = {.sample = 45, .pulls = pulls, .pull_count = 2, .to = {1.3, 0.4, 0.2}};
        wiggly_bound bound = {.sample = 60, .c = c, .least = 0.9};
        const wiggly_status status =
            wiggly_group_solve_bounded(group, descs, weights, curves[0], 2, &pin, 1, &bound, 1);
        assert_true(status <= WIGGLY_INEXACT);
        for (int e = 0; e < EXPONENTS; e++) {
            const int n = exponents[e];
            wiggly_pin other = pin;
            wiggly_bound limit = {.sample = 60, .c = c, .least = ldexp(0.9, n)};
            for (int i = 0; i < 2; i++) times(&s[i], n), descs[i].equilibrium = s[i].desc.equilibrium;
            descs[0].low = s[0].desc.low, descs[0].high = s[0].desc.high;
            for (int axis = 0; axis < 3; axis++) other.to[axis] = ldexp(pin.to[axis], n);
            assert_int_equal(wiggly_group_solve_bounded(group, descs, weights, curves[1], 2, &other, 1, &limit, 1),
                             status);
            for (int i = 0; i < 2; i++) assert_curve(&curves[1][i], &curves[0][i], n, false), times(&s[i], -n);
            for (int axis = 0; axis < 3; axis++) assert_true(other.left[axis] == ldexp(pin.left[axis], n));
            assert_true(limit.left == ldexp(bound.left, n) && limit.push == ldexp(bound.push, n));
        }
    }
    wiggly_group_destroy(group);
    for (int i = 0; i < 4; i++) curve_destroy(&curves[i / 2][i % 2]);
}
