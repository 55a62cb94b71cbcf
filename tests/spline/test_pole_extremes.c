/// Poles, their speeds and the start's cost against the textbook in quadruple precision, as far as parameters go and beyond; and poles by
/// the block against poles sample by sample.
#include "near.h"

#include "spline/poles.h"
#include "textbook.h"
#include <limits.h>

static const double step = 1.0 / 30;

static wiggly_desc describe(wiggly_mode mode, double frequency, double damping)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.step = step;
    desc.mode = mode;
    desc.frequency.value = frequency;
    desc.damping.value = damping;
    desc.bandwidth.value = 0.2;
    return desc;
}

static void assert_poles(const wiggly_desc *desc)
{
    const struct textbook_poles expected = textbook_poles_at(desc, 0, 0);
    const wiggly_poles found = wiggly_poles_at(desc, 0);
    const double size = (double)expected.natural * 2;
    for (int k = 0; k < 2; k++) {
        const number z = cexpq(expected.s[k] * desc->step);
        assert_near(found.s[k][0], (double)crealq(expected.s[k]), 1e-14 * size);
        assert_near(found.s[k][1], (double)cimagq(expected.s[k]), 1e-14 * size);
        assert_near(found.z[k][0], (double)crealq(z), 1e-13);
        assert_near(found.z[k][1], (double)cimagq(z), 1e-13);
    }
}

TEST(poles_are_the_textbooks)
{
    static const double frequencies[] = {0, 1e-6, 1, 14.9, 60}, dampings[] = {0, 1e-9, 0.3, 1, 1.0001, 2};
    for (size_t f = 0; f < sizeof frequencies / sizeof *frequencies; f++) {
        for (size_t d = 0; d < sizeof dampings / sizeof *dampings; d++) {
            wiggly_desc stiff = describe(WIGGLY_REAL, frequencies[f], dampings[d]);
            wiggly_desc turning = describe(WIGGLY_COMPLEX, frequencies[f], dampings[d]);
            assert_poles(&stiff);
            assert_poles(&turning); // no more than critically damped
        }
    }
}

/// A pole that hardly turns keeps all its digits, wherever damping and bandwidth meet; in tracks, too.
TEST(the_slower_pole_is_the_textbooks)
{
    static const double dampings[] = {1e-9, 0.6, 0.99, 1 - 1e-6, 1 - 1e-9, 1 - 0x1p-53}, beside[] = {0, 1e-9, 0.3};
    for (int n = 0; n < 18; n++) {
        double frequency = 1, damping = dampings[n / 3],
               bandwidth = (1 - beside[n % 3]) * sqrt(1 - damping * damping);
        wiggly_desc desc = describe(WIGGLY_COMPLEX, frequency, damping);
        desc.bandwidth.value = bandwidth;
        const struct textbook_poles expected = textbook_poles_at(&desc, 0, 0);
        const double turn = (double)cimagq(expected.s[1]);
        assert_near(wiggly_poles_at(&desc, 0).s[1][1], turn, 1e-15 * fabs(turn));
        const number mu[2] = {cexpq(expected.s[0] * step) - 1, cexpq(expected.s[1] * step) - 1};
        poles_block block;
        desc.frequency.track = &frequency, desc.damping.track = &damping, desc.bandwidth.track = &bandwidth;
        poles_block_fill(&desc, 0, 1, 0, &block);
        assert_near(block.p_re[0], (double)crealq(mu[0] * mu[1]), 1e-16);
        assert_near(block.p_im[0], (double)cimagq(mu[0] * mu[1]), 4e-17);
    }
}

/// What is as good as infinite is no number that overflows later, and all of it the same.
TEST(beyond_the_largest_nothing_changes)
{
    static const double beyond[] = {1e70, 1e75, 1e140, 1e200, INFINITY};
    for (size_t b = 0; b < sizeof beyond / sizeof *beyond; b++) {
        wiggly_desc at = describe(WIGGLY_REAL, 1e70, 1e70), desc = describe(WIGGLY_REAL, beyond[b], beyond[b]);
        wiggly_poles expected = wiggly_poles_at(&at, 0), found = wiggly_poles_at(&desc, 0);
        assert_memory_equal(&found, &expected, sizeof found);
        for (int k = 0; k < 2; k++) assert_true(isfinite(found.s[k][0] * found.s[k][0]));
    }
}

TEST(poles_are_those_of_a_sample_or_0)
{
    double *frequency = calloc(3, sizeof *frequency);
    wiggly_desc desc = describe(WIGGLY_REAL, 0, 0);
    desc.samples = 3, desc.frequency.track = frequency;
    for (int i = 0; i < 3; i++) frequency[i] = 1 + i;
    const int outside[] = {-1, 3, 1 << 30, INT_MIN};
    for (int i = 0; i < 3; i++) assert_near(wiggly_poles_at(&desc, i).s[0][1], 2 * M_PI * frequency[i], 1e-14);
    for (int i = 0; i < 4; i++) assert_near(wiggly_poles_at(&desc, outside[i]).z[0][0], 0, 0);
    free(frequency);
}

static void assert_speed(const wiggly_desc *desc, double tolerance)
{
    const struct textbook_poles expected = textbook_poles_at(desc, 0, 0);
    const struct textbook_speed speed = textbook_speed_of(&expected, (real)desc->step);
    const poles at = poles_at(desc, 0, 0);
    const speed_form found = poles_speed(&at, desc->step, false);
    const double on_e = (double)crealq(speed.Q * desc->step), on_x = (double)crealq((speed.P + speed.Q) * desc->step);
    assert_near(found.on_e.re, on_e, tolerance * fabs(on_e));
    assert_near(found.on_x.re, on_x, tolerance * fmax(1, fabs(on_x)));
}

/// From poles that nearly are one to those that nearly alias.
TEST(speeds_are_the_textbooks)
{
    for (double frequency = 1e-4; frequency < 14; frequency *= 1.3) {
        for (double damping = 0; damping < 1.5; damping += 0.24) {
            wiggly_desc desc = describe(WIGGLY_REAL, frequency, damping);
            assert_speed(&desc, 1e-13);
        }
    }
    wiggly_desc desc = describe(WIGGLY_REAL, 15 * (1 - 1e-6), 0);
    assert_speed(&desc, 1e-8);
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

/// A spring and a friction, and the roots of s² + γs + k.
TEST(a_spring_is_a_frequency_and_a_damping)
{
    static const double springs[] = {1e-6, 1, 40, 4e4}, frictions[] = {0, 0.1, 12.6, 600};
    for (int n = 0; n < 16; n++) {
        const double k = springs[n / 4], gamma = frictions[n % 4];
        wiggly_desc desc = describe(WIGGLY_REAL, 0, 0);
        wiggly_from_spring(k, gamma, &desc.frequency.value, &desc.damping.value);
        const wiggly_poles at = wiggly_poles_at(&desc, 0);
        assert_near(at.s[0][0] + at.s[1][0], -gamma, 1e-14 * gamma);
        assert_near(at.s[0][0] * at.s[1][0] - at.s[0][1] * at.s[1][1], k, 1e-14 * k);
    }
    double frequency, damping;
    wiggly_from_spring(0, 0, &frequency, &damping);
    assert_true(frequency == 0 && damping == 0);
    wiggly_desc desc = describe(WIGGLY_REAL, 0, 0); // without a spring: one pole as good as 0
    wiggly_from_spring(0, 2, &desc.frequency.value, &desc.damping.value);
    const wiggly_poles at = wiggly_poles_at(&desc, 0);
    assert_near(at.s[1][0], -2, 1e-14);
    assert_near(at.s[0][0], 0, 1e-15);
}

enum { SAMPLES = 3 * POLES_BLOCK + 7 };

/// The filter by the block and sample by sample: two texts of one formula must not drift apart.
static void compare(const wiggly_desc *desc, double floor)
{
    poles_block block;
    for (int from = 0; from < SAMPLES; from += POLES_BLOCK) {
        int count = SAMPLES - from < POLES_BLOCK ? SAMPLES - from : POLES_BLOCK;
        poles_block_fill(desc, from, count, floor, &block);
        for (int i = 0; i < count; i++) {
            poles at = poles_at(desc, from + i, floor);
            coefficients c = poles_coefficients(&at, desc->step);
            double size = sqrt(cplx_norm(at.s[0]) + cplx_norm(at.s[1])) * desc->step,
                   error = 1e-14 * (size + size * size);
            assert_near(block.natural[i], at.natural, 1e-14 * at.natural);
            assert_near(block.centre[i], at.centre, 1e-14 * at.natural);
            assert_near(block.exponent[i], poles_weight_exponent(&at, desc->step), 1e-14 * (1 + size));
            assert_near(block.m_re[i], c.m.re, error);
            assert_near(block.m_im[i], c.m.im, error);
            assert_near(block.p_re[i], c.p.re, error);
            assert_near(block.p_im[i], c.p.im, error);
        }
    }
}

/// From slow at a high sample rate, where all digits are in the difference from 1, to beyond what the polynomials reach.
TEST(blocks_are_samples)
{
    static double frequency[SAMPLES], damping[SAMPLES], bandwidth[SAMPLES];
    for (int kind = 0; kind < 24; kind++) {
        wiggly_desc desc = wiggly_default_desc();
        double highest = pow(10, kind / 3 - 3);
        for (int i = 0; i < SAMPLES; i++) {
            frequency[i] = highest * (0.5 + 0.5 * sin(0.1 * i));
            damping[i] = 1.3 + 1.4 * sin(0.07 * i);
            bandwidth[i] = 0.5 + 0.6 * sin(0.05 * i);
        }
        desc.samples = SAMPLES;
        desc.mode = kind % 3 == 0 ? WIGGLY_COMPLEX : WIGGLY_REAL;
        desc.frequency.track = frequency;
        desc.damping.track = damping;
        desc.bandwidth.track = bandwidth;
        compare(&desc, 0);
        compare(&desc, 0.05);
    }
}
