/// src/maths against quadruple precision, in units in the last place, and the ends of its ranges. Poles, their speeds and the start's cost
/// against the textbook, as far as parameters go and beyond; and poles by the block against poles sample by sample.
#include "near.h"

#include "maths/maths.h"
#include "spline/poles.h"
#include "textbook.h"
#include "uniform.h"
#include <limits.h>
#include <quadmath.h>

typedef double plain(double);
typedef __float128 exact(__float128);

static double turned_cos(double x) { return maths_cos(x); }
static double turned_sin(double x) { return maths_sin(x); }
static double own_acos(double x) { return maths_acos(x); }
static double own_asin(double x) { return maths_asin(x); }
static double own_atan(double x) { return maths_atan2(x, 1); }
static double own_hypot(double x) { return maths_hypot(x, 0.75); }
static __float128 exact_hypot(__float128 x) { return hypotq(x, 0.75); }

TEST(errors_are_small)
{
    static const struct {
        const char *name;
        plain *ours;
        exact *theirs;
        double from, to, most;
    } cases[] = {
        {"exp", maths_exp, expq, -1, 1, 0.56},
        {"exp", maths_exp, expq, -700, 700, 0.56},
        {"expm1", maths_expm1, expm1q, -1e-6, 1e-6, 0.51},
        {"expm1", maths_expm1, expm1q, -0.1, 0.1, 0.6},
        {"expm1", maths_expm1, expm1q, -50, 50, 0.8},
        {"sin", turned_sin, sinq, -0.3, 0.3, 0.6},
        {"sin", turned_sin, sinq, -10, 10, 0.9},
        {"sin", turned_sin, sinq, -1e6, 1e6, 0.9},
        {"cos", turned_cos, cosq, -0.78, 0.78, 0.56},
        {"cos", turned_cos, cosq, -1e6, 1e6, 0.9},
        {"log", maths_log, logq, 0.5, 2, 0.9},
        {"log", maths_log, logq, 1e-300, 1e300, 0.6},
        {"atan", own_atan, atanq, -5, 5, 2.2},
        {"acos", own_acos, acosq, -1, 1, 3},
        {"asin", own_asin, asinq, -1, 1, 3},
        {"hypot", own_hypot, exact_hypot, -2, 2, 1.2},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double worst = 0;
        uint64_t seed = 1;
        for (int i = 0; i < 100000; i++) {
            const double x = cases[c].from + (cases[c].to - cases[c].from) * uniform(&seed);
            const __float128 expected = cases[c].theirs(x);
            int exponent;
            frexp((double)expected, &exponent);
            worst = fmax(worst, (double)fabsq((cases[c].ours(x) - expected) / ldexp(1, exponent - 53)));
        }
        if (!(worst <= cases[c].most))
            fail_msg("%s from %g to %g: %.3f units in the last place", cases[c].name, cases[c].from, cases[c].to,
                     worst);
    }
}

static void assert_same(double actual, double expected)
{
    if (isnan(expected) ? !isnan(actual) : actual != expected || signbit(actual) != signbit(expected))
        fail_msg("expected %.17g, got %.17g", expected, actual);
}

TEST(ends_of_ranges_are_those_of_libm)
{
    static const double ends[] = {0.0, -0.0, 1, -1, 1e-320, -1e-320, 1e308, -1e308, INFINITY, -INFINITY, NAN};
    const int count = sizeof ends / sizeof *ends;
    for (int i = 0; i < count; i++) {
        const double x = ends[i];
        if (fabs(x) != 1) assert_same(maths_exp(x), exp(x)), assert_same(maths_expm1(x), expm1(x));
        if (x >= 0 || isnan(x)) assert_same(maths_log(x), log(x));
        if (fabs(x) < 1) assert_same(maths_sin(x), sin(x)), assert_same(maths_cos(x), cos(x));
        for (int j = 0; j < count; j++) {
            assert_same(maths_atan2(x, ends[j]), atan2(x, ends[j]));
            assert_same(maths_hypot(x, ends[j]), hypot(x, ends[j]));
        }
    }
    assert_same(maths_exp(-745), exp(-745));
    assert_same(maths_exp(709.75), exp(709.75));
    assert_same(maths_exp(710), INFINITY);
    assert_true(isnan(maths_sin(INFINITY)));
    assert_near(maths_sin(1e9), sin(1e9), 1e-7); // of an angle within its last digit
    assert_near(hypot(maths_sin(1e300), maths_cos(1e300)), 1, 1e-15);
}

TEST(powers_of_ten_are_exact)
{
    for (int n = -22; n <= 22; n++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", n);
        assert_same(maths_power_of_ten(n), strtod(text, NULL));
        assert_int_equal(maths_decade(maths_power_of_ten(n)), n);
        assert_int_equal(maths_decade(nextafter(maths_power_of_ten(n), 0)), n - 1);
    }
    assert_int_equal(maths_decade(3e-308), -308);
    assert_int_equal(maths_decade(1.5e308), 308);
}

// --- poles -----------------------------------------------------------------------------------------------------------

static const double step = 1.0 / 30;

static wiggly_desc describe(wiggly_mode mode, double frequency, double damping)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.step = step, desc.mode = mode;
    desc.frequency.value = frequency, desc.damping.value = damping, desc.bandwidth.value = 0.2;
    return desc;
}

/// Modes differ: a complex spline is no more than critically damped.
TEST(poles_are_the_textbooks)
{
    static const double frequencies[] = {0, 1e-6, 1, 14.9, 60}, dampings[] = {0, 1e-9, 0.3, 1, 1.0001, 2};
    for (int n = 0; n < 5 * 6 * 2; n++) {
        const wiggly_desc desc =
            describe(n % 2 ? WIGGLY_REAL : WIGGLY_COMPLEX, frequencies[n / 12], dampings[n / 2 % 6]);
        const struct textbook_poles expected = textbook_poles_at(&desc, 0, 0);
        const wiggly_poles found = wiggly_poles_at(&desc, 0);
        const double size = (double)expected.natural * 2;
        for (int k = 0; k < 2; k++) {
            const number z = cexpq(expected.s[k] * desc.step);
            assert_near(found.s[k][0], (double)crealq(expected.s[k]), 1e-14 * size);
            assert_near(found.s[k][1], (double)cimagq(expected.s[k]), 1e-14 * size);
            assert_near(found.z[k][0], (double)crealq(z), 1e-13);
            assert_near(found.z[k][1], (double)cimagq(z), 1e-13);
        }
    }
}

/// A pole that hardly turns keeps all its digits, wherever damping and bandwidth meet; in tracks, too.
TEST(the_slower_pole_is_the_textbooks)
{
    static const double dampings[] = {1e-9, 0.6, 0.99, 1 - 1e-6, 1 - 1e-9, 1 - 0x1p-53}, beside[] = {0, 1e-9, 0.3};
    for (int n = 0; n < 18; n++) {
        const double frequency = 1, damping = dampings[n / 3],
                     bandwidth = (1 - beside[n % 3]) * sqrt(1 - damping * damping);
        wiggly_desc desc = describe(WIGGLY_COMPLEX, frequency, damping);
        desc.bandwidth.value = bandwidth;
        const struct textbook_poles expected = textbook_poles_at(&desc, 0, 0);
        const double turn = (double)cimagq(expected.s[1]);
        assert_near(wiggly_poles_at(&desc, 0).s[1][1], turn, 1e-15 * fabs(turn));
        const number p = (cexpq(expected.s[0] * step) - 1) * (cexpq(expected.s[1] * step) - 1);
        poles_block block;
        desc.frequency.track = &frequency, desc.damping.track = &damping, desc.bandwidth.track = &bandwidth;
        poles_block_fill(&desc, 0, 1, 0, &block);
        assert_near(block.p_re[0], (double)crealq(p), 1e-16);
        assert_near(block.p_im[0], (double)cimagq(p), 4e-17);
    }
}

/// What is as good as infinite is no number that overflows later, and all of it the same.
TEST(beyond_the_largest_nothing_changes)
{
    static const double beyond[] = {1e70, 1e75, 1e140, 1e200, INFINITY};
    const wiggly_desc at = describe(WIGGLY_REAL, 1e70, 1e70);
    const wiggly_poles expected = wiggly_poles_at(&at, 0);
    for (int b = 0; b < 5; b++) {
        const wiggly_desc desc = describe(WIGGLY_REAL, beyond[b], beyond[b]);
        const wiggly_poles found = wiggly_poles_at(&desc, 0);
        assert_memory_equal(&found, &expected, sizeof found);
        for (int k = 0; k < 2; k++) assert_true(isfinite(found.s[k][0] * found.s[k][0]));
    }
}

TEST(poles_are_those_of_a_sample_or_0)
{
    double *frequency = calloc(3, sizeof *frequency); // so that a sanitizer sees what is outside
    const int outside[] = {-1, 3, 1 << 30, INT_MIN};
    wiggly_desc desc = describe(WIGGLY_REAL, 0, 0);
    desc.samples = 3, desc.frequency.track = frequency;
    for (int i = 0; i < 3; i++) frequency[i] = 1 + i;
    for (int i = 0; i < 3; i++) assert_near(wiggly_poles_at(&desc, i).s[0][1], 2 * M_PI * frequency[i], 1e-14);
    for (int i = 0; i < 4; i++) assert_near(wiggly_poles_at(&desc, outside[i]).z[0][0], 0, 0);
    free(frequency);
}

static void assert_speed(double frequency, double damping, double tolerance)
{
    const wiggly_desc desc = describe(WIGGLY_REAL, frequency, damping);
    const struct textbook_poles expected = textbook_poles_at(&desc, 0, 0);
    const struct textbook_speed speed = textbook_speed_of(&expected, (real)step);
    const poles at = poles_at(&desc, 0, 0);
    const speed_form found = poles_speed(&at, step, false);
    const double on_e = (double)crealq(speed.Q * step), on_x = (double)crealq((speed.P + speed.Q) * step);
    assert_near(found.on_e.re, on_e, tolerance * fabs(on_e));
    assert_near(found.on_x.re, on_x, tolerance * fmax(1, fabs(on_x)));
}

/// From poles that nearly are one to those that nearly alias.
TEST(speeds_are_the_textbooks)
{
    for (double frequency = 1e-4; frequency < 14; frequency *= 1.3) {
        for (double damping = 0; damping < 1.5; damping += 0.24) assert_speed(frequency, damping, 1e-13);
    }
    assert_speed(15 * (1 - 1e-6), 0, 1e-8);
}

/// However slowly it fades, swing at the start costs something; only where it does not fade at all, nothing.
TEST(the_start_costs_what_fades)
{
    for (double decay = 1e-20; decay < 1; decay *= 1000) {
        const poles at = {.s = {{-decay, 5}, {-decay, -5}}, .natural = 5, .centre = 5, .decay = decay};
        const double expected = -expm1(-4 * step * decay);
        assert_near(poles_start_cost(&at, step).row[0].weight, expected, 1e-14 * expected);
    }
    const poles still = {.s = {{0, 5}, {0, -5}}, .natural = 5, .centre = 5};
    assert_near(poles_start_cost(&still, step).row[0].weight, 0, 0);
}

/// A spring and a friction, and the roots of s² + γs + k; without a spring one pole is as good as 0.
TEST(a_spring_is_a_frequency_and_a_damping)
{
    static const double springs[] = {1e-6, 1, 40, 4e4, 0}, frictions[] = {0, 0.1, 12.6, 600, 2};
    for (int n = 0; n < 25; n++) {
        const double k = springs[n / 5], gamma = frictions[n % 5];
        wiggly_desc desc = describe(WIGGLY_REAL, 7, 7);
        wiggly_from_spring(k, gamma, &desc.frequency.value, &desc.damping.value);
        const wiggly_poles at = wiggly_poles_at(&desc, 0);
        const double sum = at.s[0][0] + at.s[1][0], product = at.s[0][0] * at.s[1][0] - at.s[0][1] * at.s[1][1];
        assert_near(sum, -gamma, 1e-14 * gamma);
        assert_near(product, k, k > 0 ? 1e-14 * k : 1e-15 * gamma * gamma);
        if (k == 0 && gamma == 0) assert_true(desc.frequency.value == 0 && desc.damping.value == 0);
    }
}

enum { SAMPLES = 3 * POLES_BLOCK + 7 };

/// The filter by the block and sample by sample: two texts of one formula must not drift apart. From slow at a high sample rate, where all
/// digits are in the difference from 1, to beyond what the polynomials reach.
TEST(blocks_are_samples)
{
    static double frequency[SAMPLES], damping[SAMPLES], bandwidth[SAMPLES];
    for (int kind = 0; kind < 48; kind++) {
        const double highest = pow(10, kind / 6 - 3), floor = kind % 2 ? 0.05 : 0;
        wiggly_desc desc = wiggly_default_desc();
        for (int i = 0; i < SAMPLES; i++) {
            frequency[i] = highest * (0.5 + 0.5 * sin(0.1 * i));
            damping[i] = 1.3 + 1.4 * sin(0.07 * i);
            bandwidth[i] = 0.5 + 0.6 * sin(0.05 * i);
        }
        desc.samples = SAMPLES, desc.mode = kind / 2 % 3 == 0 ? WIGGLY_COMPLEX : WIGGLY_REAL;
        desc.frequency.track = frequency, desc.damping.track = damping, desc.bandwidth.track = bandwidth;
        poles_block block;
        for (int i = 0; i < SAMPLES; i++) {
            const int from = i / POLES_BLOCK * POLES_BLOCK, k = i - from;
            if (k == 0)
                poles_block_fill(&desc, from, SAMPLES - from < POLES_BLOCK ? SAMPLES - from : POLES_BLOCK, floor,
                                 &block);
            const poles at = poles_at(&desc, i, floor);
            const coefficients c = poles_coefficients(&at, desc.step);
            const double size = sqrt(cplx_norm(at.s[0]) + cplx_norm(at.s[1])) * desc.step,
                         error = 1e-14 * (size + size * size);
            assert_near(block.natural[k], at.natural, 1e-14 * at.natural);
            assert_near(block.centre[k], at.centre, 1e-14 * at.natural);
            assert_near(block.exponent[k], poles_weight_exponent(&at, desc.step), 1e-14 * (1 + size));
            assert_near(block.m_re[k], c.m.re, error);
            assert_near(block.m_im[k], c.m.im, error);
            assert_near(block.p_re[k], c.p.re, error);
            assert_near(block.p_im[k], c.p.im, error);
        }
    }
}
