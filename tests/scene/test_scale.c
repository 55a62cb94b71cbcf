/// Values of any size: whatever a double can hold gives the curve of ordinary values, times the power of two between them, bit for bit. (The
/// search for samples that limits hold takes roots: there the last digits may differ.)
#include "near.h"

#include "curve.h"
#include "uniform.h"
#include <wiggly/more.h>

enum { SAMPLES = 90, KNOTS = 5 };

static const int exponents[] = {515, -515, 660, -665, 990, -995};
enum { EXPONENTS = sizeof exponents / sizeof *exponents };

/// A description with its arrays.
struct subject {
    wiggly_desc desc;
    wiggly_knot knots[KNOTS];
    double y[SAMPLES];
};

/// All of its values times 2ⁿ.
static void times(struct subject *s, int n)
{
    for (int k = 0; k < KNOTS; k++) {
        wiggly_knot *knot = &s->knots[k];
        knot->value = ldexp(knot->value, n), knot->slope = ldexp(knot->slope, n), knot->phase = ldexp(knot->phase, n);
    }
    for (int i = 0; i < SAMPLES; i++) s->y[i] = ldexp(s->y[i], n);
    s->desc.equilibrium.value = ldexp(s->desc.equilibrium.value, n);
    s->desc.low = ldexp(s->desc.low, n), s->desc.high = ldexp(s->desc.high, n);
}

/// Every mode, start and way to move, with slopes, phases, tracks, limits and variations in turn.
static void make(struct subject *s, uint64_t seed)
{
    const uint64_t kind = seed;
    for (int i = 0; i < 20; i++) uniform(&seed);
    s->desc = wiggly_default_desc();
    s->desc.samples = SAMPLES;
    s->desc.mode = (wiggly_mode)(kind % 3);
    s->desc.start = (wiggly_start)(kind / 3 % 3);
    s->desc.passive = kind / 9 % 3 == 2 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    s->desc.frequency.value = 0.3 + 2 * uniform(&seed);
    s->desc.damping.value = 0.3 * uniform(&seed);
    s->desc.calm = kind % 7 == 0 ? 0 : 1;
    s->desc.knots = s->knots;
    s->desc.knot_count = KNOTS;
    for (int k = 0; k < KNOTS; k++) {
        s->knots[k] = (wiggly_knot){.sample = 3 + 17 * k, .value = uniform(&seed) - 0.4, .stiffness = 100};
        s->knots[k].has_slope = uniform(&seed) < 0.3;
        s->knots[k].has_phase = uniform(&seed) < 0.3;
        s->knots[k].slope = uniform(&seed), s->knots[k].phase = uniform(&seed);
    }
    for (int i = 0; i < SAMPLES; i++) s->y[i] = 0.3 * sin(0.2 * i);
    s->desc.equilibrium.value = uniform(&seed);
    if (kind / 2 % 3 == 0) s->desc.equilibrium.track = s->y;
    if (kind / 3 % 5 == 0) s->desc.variation = 0.3;
    s->desc.has_high = kind % 4 == 0, s->desc.high = 0.7;
    s->desc.has_low = kind % 8 == 0, s->desc.low = -0.6;
}

static void assert_times(const double *found, const double *ordinary, int n, double tolerance)
{
    for (int i = 0; i < SAMPLES; i++) {
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
    wiggly_curve ordinary = curve_create(SAMPLES), found = curve_create(SAMPLES);
    assert_int_equal(wiggly_create(SAMPLES, KNOTS + SAMPLES, &solver), WIGGLY_OK);
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
    double total[SAMPLES], y[SAMPLES];
    float floats[SAMPLES];
    assert_int_equal(wiggly_create(SAMPLES, 3, &solver), WIGGLY_OK);
    wiggly_knot knots[] = {
        {.sample = 0, .value = 1e-200}, {.sample = 40, .value = 1e200}, {.sample = 70, .value = 1}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES, desc.knots = knots, desc.knot_count = 3;
    desc.frequency.value = 1, desc.damping.value = 0.1;
    wiggly_curve curve = {.size = sizeof curve, .total = total, .floats = floats};
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    for (int k = 0; k < 3; k++) assert_true(total[knots[k].sample] == knots[k].value);
    assert_true(isinf(floats[40]) && floats[70] == 1);

    for (int i = 0; i < SAMPLES; i++) y[i] = 1e-200 * sin(i); // the caller's own array is both
    knots[1].value = 3e-200, knots[2].value = 0;
    desc.equilibrium.track = curve.y = y;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    for (int i = 0; i < SAMPLES; i++) assert_true(y[i] == 1e-200 * sin(i));

    const wiggly_knot light = {.sample = 40, .value = 1, .has_slope = true, .slope = 1e250, .stiffness = 1e-290};
    knots[0].value = 0.5, knots[1] = light;
    desc.equilibrium.track = NULL;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    assert_true(fabs(total[20]) > 1e-3 && fabs(total[20]) < 10);
    wiggly_destroy(solver);
}

TEST(many_at_once)
{
    enum { COUNT = 4 };
    wiggly_batch *batch;
    assert_int_equal(wiggly_batch_create(SAMPLES, KNOTS, 2, &batch), WIGGLY_OK);
    struct subject s;
    make(&s, 1);
    static double total[2][COUNT][SAMPLES], each[COUNT * SAMPLES];
    wiggly_desc descs[COUNT];
    wiggly_curve curves[COUNT];
    double sample[COUNT][3], value[COUNT][3];
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < 3; k++)
            sample[i][k] = 10 + 30 * k, value[i][k] = ldexp(0.3 + k, i == 0 ? 0 : exponents[i]);
        descs[i] = s.desc;
        curves[i] = (wiggly_curve){.size = sizeof(wiggly_curve), .total = total[0][i]};
    }
    struct subject large = s;
    times(&large, 660);
    large.desc.knots = large.knots, large.desc.equilibrium.track = large.y;
    descs[2] = large.desc;
    assert_int_equal(wiggly_batch_solve(batch, descs, curves, NULL, COUNT), WIGGLY_OK);
    assert_times(total[0][2], total[0][0], 660, 0);
    assert_times(total[0][3], total[0][0], 0, 0);

    const wiggly_many many = {.size = sizeof many,
                              .count = COUNT,
                              .knot_count = 3,
                              .sample = {&sample[0][0], 3, 1},
                              .value = {&value[0][0], 3, 1},
                              .total = {each, 1, COUNT}};
    s.desc.equilibrium = (wiggly_param){0};
    assert_int_equal(wiggly_batch_solve_many(batch, &s.desc, &many), WIGGLY_OK);
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < SAMPLES; k++) total[1][i][k] = each[COUNT * k + i];
        assert_times(total[1][i], total[1][0], i == 0 ? 0 : exponents[i], 0);
    }
    wiggly_batch_destroy(batch);
}

/// Two splines that share a pin and a bound, of which one has no values of its own.
TEST(groups)
{
    wiggly_group *group;
    wiggly_curve curves[2][2];
    for (int i = 0; i < 4; i++) curves[i / 2][i % 2] = curve_create(SAMPLES);
    assert_int_equal(wiggly_group_create_bounded(SAMPLES, KNOTS, 2, 1, 1, &group), WIGGLY_OK);
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
