/// The public library as a user meets it: the corner cases of docs/mathematics.md, every status, values between samples,
/// and finite answers whatever is asked.
#include "near.h"

#include "curve.h"
#include "uniform.h"

enum { MAX = 11000 };

SHARED_SOLVER_AND_CURVE(MAX, MAX)

static wiggly_desc describe(int samples, wiggly_mode mode, wiggly_start start, const wiggly_knot *knots, int count)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = samples, desc.mode = mode, desc.start = start;
    desc.frequency.value = 1, desc.damping.value = 0.05;
    desc.knots = knots, desc.knot_count = count;
    return desc;
}

/// A frequency as high as a number can be turns by no angle that could be told; the drive of a filter turns with it.
TEST(a_frequency_without_bounds_is_solved)
{
    double frequency[12], y[12];
    for (int i = 0; i < 12; i++) frequency[i] = 1.7e308 - i * 1e306, y[i] = sin(i);
    const wiggly_knot knots[] = {{.sample = 0, .value = 1}, {.sample = 7, .value = -1}};
    wiggly_desc desc = describe(12, WIGGLY_COMPLEX, WIGGLY_FREE, knots, 2);
    desc.passive = WIGGLY_FILTER;
    desc.damping.value = 0;
    desc.frequency.track = frequency;
    desc.equilibrium.track = y;
    const wiggly_status status = wiggly_solve(solver, &desc, &curve);
    assert_true(status == WIGGLY_OK || status == WIGGLY_INEXACT);
    for (int i = 0; i < 12; i++) assert_true(isfinite(curve.total[i]) && isfinite(curve.im[i]));
}

/// A slope that leads beyond what a double can hold: straight lines join the knots.
TEST(what_cannot_be_solved_is_joined_by_lines)
{
    const wiggly_knot knots[] = {{.sample = 2, .value = -9e299},
                                 {.sample = 3, .value = 9e299},
                                 {.sample = 7, .value = 1e299},
                                 {.sample = 9, .value = 5e299, .has_slope = true, .slope = 1e308}};
    wiggly_desc desc = describe(12, WIGGLY_CUBIC, WIGGLY_FREE, knots, 4);
    desc.step = 10;
    desc.passive = WIGGLY_FILTER;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_SINGULAR);
    const double expected[] = {-9, -9, -9, 9, 7, 5, 3, 1, 3, 5, 5, 5};
    for (int i = 0; i < 12; i++) assert_near(curve.total[i] / 1e299, expected[i], 1e-12);
}

/// The paper's cubic goes straight on: two keys side by side throw it as far as it runs, and beyond 10⁴ times their scale that
/// cannot be meant (and no level slope helps: it would lie between the two). The oscillator's holds its last value.
TEST(a_thrown_cubic_is_said)
{
    static const wiggly_knot knots[] = {{.sample = 0, .value = 0}, {.sample = 1, .value = 1}};
    for (int samples = 9000; samples <= MAX; samples += 2000) {
        wiggly_desc desc = describe(samples, WIGGLY_CUBIC, WIGGLY_FREE, knots, 2);
        desc.passive = WIGGLY_FILTER;
        assert_int_equal(wiggly_solve(solver, &desc, &curve), samples > 10000 ? WIGGLY_SINGULAR : WIGGLY_OK);
        if (samples < 10000) assert_near(curve.total[samples - 1], samples - 1, 1e-6);
        desc.passive = WIGGLY_OSCILLATOR;
        assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
        assert_near(curve.total[samples - 1], 1, 1e-12);
    }
}

TEST(between_samples_a_free_oscillation_is_followed)
{
    const wiggly_knot knot = {.sample = 0, .value = 1};
    wiggly_desc desc = describe(97, WIGGLY_COMPLEX, WIGGLY_FREE, &knot, 1);
    desc.frequency.value = 2; // 12 samples a turn
    desc.damping.value = desc.bandwidth.value = desc.calm = 0;
    assert_in_range(wiggly_solve(solver, &desc, &curve), WIGGLY_OK, WIGGLY_CALMED);
    double worst = 0;
    for (int i = 2; i < 94; i++) {
        wiggly_value a = wiggly_evaluate(&curve, i), b = wiggly_evaluate(&curve, i + 0.5);
        assert_true(a.re == curve.re[i] && a.im == curve.im[i] && a.y == curve.y[i]);
        worst = fmax(worst, fabs(hypot(a.re, a.im) - hypot(b.re, b.im)));
    }
    assert_near(worst, 0, 1e-3);
    assert_near(wiggly_lagged((wiggly_value){0.5, 1, 2}, 1.5707963267948966), 0.5 + 2, 1e-12);
    float out[2 * 3] = {0};
    wiggly_evaluate_float(&curve, 4, 0.5, 3, out, 2);
    assert_near(out[4], curve.total[5], 1e-6);
    assert_near(out[3], 0, 0);
}

TEST(wrong_descriptions_are_named_and_leave_the_curve_alone)
{
    const wiggly_knot good = {.sample = 1, .value = 1}, twice[] = {{.sample = 9}, good, good},
                      outside = {.sample = 50, .value = 1}, before = {.sample = -1},
                      seam = {.sample = 49, .value = 1};
    const wiggly_knot nan[] = {good, {.sample = 2, .value = NAN}}, steep = {.has_slope = true, .slope = INFINITY},
                      slack = {.has_slope = true, .stiffness = -1}, lost = {.has_phase = true, .phase = NAN},
                      both = {.still = true, .has_phase = true}, rests[] = {good, {.sample = 9, .still = true}};
    double broken_track[50] = {[7] = NAN};
    const struct {
        wiggly_status expected;
        int knot;
        wiggly_start start;
        const wiggly_knot *knots;
        int count, samples;
        const double *track;
        double step, calm, low, high;
        size_t size; ///< less than its own
        wiggly_mode mode;
        wiggly_passive passive;
    } cases[] = {
        {WIGGLY_ERROR_KNOT_TWICE, 2, .knots = twice, .count = 3},
        {WIGGLY_ERROR_KNOT_OUTSIDE, 0, .knots = &outside, .count = 1},
        {WIGGLY_ERROR_KNOT_OUTSIDE, 0, .knots = &before, .count = 1},
        {WIGGLY_ERROR_KNOT_OUTSIDE, 0, WIGGLY_LOOP, .knots = &seam, .count = 1},
        {WIGGLY_ERROR_KNOT_OUTSIDE, 0, .knots = &good, .count = 1, .samples = -50},
        {WIGGLY_ERROR_KNOT_NUMBER, 1, .knots = nan, .count = 2},
        {WIGGLY_ERROR_KNOT_NUMBER, 0, .knots = &steep, .count = 1},
        {WIGGLY_ERROR_KNOT_NUMBER, 0, .knots = &slack, .count = 1},
        {WIGGLY_ERROR_KNOT_NUMBER, 0, .knots = &lost, .count = 1},
        {WIGGLY_ERROR_KNOT_STILL, 0, .knots = &both, .count = 1},
        {WIGGLY_ERROR_KNOT_LIMIT, 0, .knots = &good, .count = 1, .low = -1, .high = 0.5},
        {WIGGLY_ERROR_KNOT_LIMIT, 0, .knots = &good, .count = 1, .low = 1.5, .high = 2},
        {WIGGLY_ERROR_KNOT_LIMIT, 1, .knots = rests, .count = 2, .low = 0.5, .high = 2},
        {WIGGLY_ERROR_LIMITS, -1, .low = 1, .high = -1},
        {WIGGLY_ERROR_LIMITS, -1, .low = -1, .high = INFINITY},
        {WIGGLY_ERROR_ARGUMENT, -1, .count = 1},
        {WIGGLY_ERROR_ARGUMENT, -1, .samples = -51},
        {WIGGLY_ERROR_CAPACITY, -1, .samples = MAX + 1},
        {WIGGLY_ERROR_LOOP, -1, WIGGLY_LOOP, .samples = -49},
        {WIGGLY_ERROR_NUMBER, -1, .step = -1},
        {WIGGLY_ERROR_NUMBER, -1, .calm = 1.5},
        {WIGGLY_ERROR_NUMBER, -1, .track = broken_track},
        {WIGGLY_ERROR_NUMBER, -1, .mode = (wiggly_mode)(WIGGLY_CUBIC + 1)},
        {WIGGLY_ERROR_NUMBER, -1, .mode = (wiggly_mode)-1},
        {WIGGLY_ERROR_NUMBER, -1, .start = (wiggly_start)(WIGGLY_LOOP + 1)},
        {WIGGLY_ERROR_NUMBER, -1, .passive = (wiggly_passive)(WIGGLY_FILTER + 1)},
        {WIGGLY_ERROR_SIZE, -1, .size = sizeof(wiggly_desc)},
        {WIGGLY_ERROR_SIZE, -1, .size = 1},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        wiggly_desc desc =
            describe(50 + cases[c].samples, WIGGLY_COMPLEX, cases[c].start, cases[c].knots, cases[c].count);
        desc.size -= cases[c].size;
        desc.damping.track = cases[c].track;
        desc.mode = cases[c].mode, desc.passive = cases[c].passive;
        if (cases[c].step != 0) desc.step = cases[c].step;
        if (cases[c].calm != 0) desc.calm = cases[c].calm;
        desc.low = cases[c].low, desc.high = cases[c].high;
        desc.has_low = desc.has_high = desc.low != 0;
        memset(curve.total, 0x5A, sizeof(double) * 100);
        wiggly_curve before_it = curve;
        wiggly_status status = wiggly_solve(solver, &desc, &curve);
        if (status != cases[c].expected) fail_msg("case %zu: %s", c, wiggly_status_text(status));
        if (curve.knot != cases[c].knot) fail_msg("case %zu: knot %d", c, curve.knot);
        before_it.knot = curve.knot;
        assert_memory_equal(&before_it, &curve, sizeof curve);
        for (size_t b = 0; b < sizeof(double) * 100; b++) assert_int_equal(((unsigned char *)curve.total)[b], 0x5A);
    }
    wiggly_desc ok = describe(50, WIGGLY_COMPLEX, WIGGLY_FREE, &good, 1);
    wiggly_curve unsized = {0};
    assert_int_equal(wiggly_solve(NULL, &ok, &curve), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_solve(solver, NULL, &curve), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_solve(solver, &ok, &unsized), WIGGLY_ERROR_SIZE);
}

/// What zeroes mean is what the numbers beside them in the header mean.
TEST(a_description_of_zeroes_is_valid)
{
    const wiggly_knot knots[] = {{.sample = 3, .value = 1}, {.sample = 30, .value = -1, .has_slope = true}},
                      said[] = {knots[0], {.sample = 30, .value = -1, .has_slope = true, .stiffness = 1000}};
    static double total[2][50];
    wiggly_curve own = {.size = sizeof own, .total = total[0]}, same = {.size = sizeof same, .total = total[1]};
    wiggly_desc zero = {.size = sizeof zero}, full = wiggly_default_desc();
    assert_int_equal(wiggly_solve(solver, &zero, &own), WIGGLY_OK);
    assert_int_equal(own.samples, 0);
    zero.samples = full.samples = 50;
    zero.frequency.value = full.frequency.value = 1.5;
    zero.knots = knots, full.knots = said;
    zero.knot_count = full.knot_count = 2;
    full.bandwidth.value = 0;
    assert_int_equal(wiggly_solve(solver, &zero, &own), WIGGLY_OK);
    assert_int_equal(wiggly_solve(solver, &full, &same), WIGGLY_OK);
    assert_memory_equal(total[0], total[1], sizeof total[0]);
    assert_true(own.step == 1.0 / 24 && own.knot == -1);
    full.calm = 0.3, full.has_calm = false; // a number says itself that it is one
    zero.calm = 0.3, zero.has_calm = true;
    wiggly_solve(solver, &zero, &own);
    wiggly_solve(solver, &full, &same);
    assert_memory_equal(total[0], total[1], sizeof total[0]);
}

TEST(every_status_has_a_text_of_its_own)
{
    for (int a = 0; a < WIGGLY_STATUS_COUNT; a++) {
        const bool is_free = a > WIGGLY_SINGULAR && a < WIGGLY_ERROR_ARGUMENT; // for later versions
        assert_int_equal(strcmp(wiggly_status_text((wiggly_status)a), "unknown status") == 0, is_free);
        for (int b = 0; b < a && !is_free; b++) {
            assert_string_not_equal(wiggly_status_text((wiggly_status)a), wiggly_status_text((wiggly_status)b));
        }
    }
    assert_non_null(wiggly_status_text((wiggly_status)-1));
}

/// Twice the frequency, sample rate and stiffness on the same samples is the same curve (docs/mathematics.md, Poles).
TEST(the_whole_curve_scales)
{
    wiggly_knot knots[] = {{.sample = 0, .value = 0, .has_slope = true, .slope = 1, .stiffness = 50},
                           {.sample = 30, .value = 1},
                           {.sample = 80, .value = -0.4, .has_slope = true, .slope = -2, .stiffness = 9}};
    wiggly_desc desc = describe(120, WIGGLY_COMPLEX, WIGGLY_FREE, knots, 3);
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    wiggly_curve other = curve_create(MAX);
    desc.step /= 2;
    desc.frequency.value *= 2;
    for (int k = 0; k < 3; k++) knots[k].slope *= 2, knots[k].stiffness *= 2;
    assert_int_equal(wiggly_solve(solver, &desc, &other), WIGGLY_OK);
    for (int i = 0; i < 120; i++) assert_near(other.total[i], curve.total[i], 1e-12);
    curve_destroy(&other);
}

static double pick(uint64_t *seed, const double *values, int count) { return values[(int)(uniform(seed) * count)]; }

#define PICK(seed, ...)                                                                                              \
    pick(seed, (const double[]){__VA_ARGS__}, (int)(sizeof(double[]){__VA_ARGS__} / sizeof(double)))

/// Every parameter at its ends and far beyond them, values up to 1e±150, any number of knots: never a NaN, never an infinity.
TEST(extremes_stay_finite)
{
    static wiggly_knot knots[400];
    uint64_t seed = 7;
    for (int n = 0; n < 6000; n++) {
        int samples = (int)PICK(&seed, 2, 3, 4, 5, 20, 121, 500), wanted = (int)PICK(&seed, 0, 1, 2, 5, 400);
        wiggly_start start = (wiggly_start)PICK(&seed, 0, 1, 2);
        int room = samples - (start == WIGGLY_LOOP), count = wanted < room ? wanted : room;
        for (int k = 0; k < count; k++) {
            knots[k] = (wiggly_knot){.sample = (int)((long)k * room / count),
                                     .value = PICK(&seed, 0, 1, -1, 0.3, 1e150, 1e-150, -1e9),
                                     .has_slope = PICK(&seed, 0, 1) > 0,
                                     .slope = PICK(&seed, 0, 1, -1e6, 1e100),
                                     .stiffness = PICK(&seed, 1000, 1e-300, 1e300)};
        }
        wiggly_desc desc = describe(samples, (wiggly_mode)PICK(&seed, 0, 1, 2), start, knots, count);
        desc.step = 1 / PICK(&seed, 24, 1e5, 1e-3);
        desc.frequency.value = PICK(&seed, -1, 0, 1e-9, 1, 12, 1e300);
        desc.damping.value = PICK(&seed, -1, 0, 1e-12, 1, 3, 1e300);
        desc.bandwidth.value = PICK(&seed, -1, 0, 0.1, 1, 1e300);
        desc.calm = PICK(&seed, 0, 1e-9, 1);
        const double k = PICK(&seed, 0, 1e-300, 1, 1e308), gamma = PICK(&seed, 0, 1e-300, 1, 1e308);
        if (desc.mode == WIGGLY_REAL && PICK(&seed, 0, 1) > 0)
            wiggly_from_spring(k, gamma, &desc.frequency.value, &desc.damping.value);
        wiggly_status status = wiggly_solve(solver, &desc, &curve);
        if (status >= WIGGLY_ERROR_ARGUMENT) fail_msg("example %d: %s", n, wiggly_status_text(status));
        for (int i = 0; i < samples; i++) {
            wiggly_value v = wiggly_evaluate(&curve, i + 0.37);
            bool finite = isfinite(curve.total[i]) && isfinite(curve.im[i]) && isfinite(v.y + v.re + v.im);
            if (!finite)
                fail_msg("example %d: sample %d of %d is not finite (%s)", n, i, samples, wiggly_status_text(status));
        }
    }
}

TESTS_BETWEEN(set_up, tear_down)
