/// The frequency response beside the poles: the three rows of the paper's Figure 2, computed and ranked as it shows them.
#include "near.h"

#include "editor/inspector/poles.h"
#include <wiggly/more.h>

static const double step = 1.0 / 24;

static struct passband row(enum filter_kind kind)
{
    struct filter filter = filter_of(kind, 1, 0.05, 0.1, step);
    return filter_passband(&filter);
}

/// "There is significant response at zero frequency" of the two-pole real filter; four poles broaden the resonance, but it "is
/// still unacceptably high"; the complex one is as wide "while keeping the response at zero frequency much lower".
TEST(test_figure2)
{
    struct passband two = row(FILTER_TWO_REAL), four = row(FILTER_FOUR_REAL), complex = row(FILTER_TWO_COMPLEX);
    assert_near(two.zero, -20.1, 0.05);
    assert_near(four.zero, -28.7, 0.05);
    assert_near(complex.zero, -39.9, 0.05);
    assert_near(two.width, 0.10, 0.005);
    assert_near(four.width, 0.25, 0.005);
    assert_near(complex.width, 0.265, 0.005);
}

/// The active filter's poles are those that the solver uses.
TEST(test_same_poles_as_solver)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = 100;
    desc.step = step;
    desc.frequency.value = 1.7;
    desc.damping.value = 0.2;
    desc.bandwidth.value = 0.15;
    wiggly_poles poles = wiggly_poles_at(&desc, 0);
    struct filter filter = filter_of(FILTER_TWO_COMPLEX, 1.7, 0.2, 0.15, step);
    assert_int_equal(filter.count, 2);
    for (int i = 0; i < 2; i++) {
        assert_near(filter.s[i][0], poles.s[i][0], 1e-12);
        assert_near(filter.s[i][1], poles.s[i][1], 1e-12);
    }
    desc.mode = WIGGLY_REAL;
    for (double damping = 0.3; damping < 3; damping += 1.2) {
        desc.damping.value = damping;
        poles = wiggly_poles_at(&desc, 0);
        filter = filter_of(FILTER_TWO_REAL, 1.7, damping, 0.15, step);
        assert_int_equal(filter.count, 2);
        for (int i = 0; i < 2; i++) {
            assert_near(filter.s[i][0], poles.s[i][0], 1e-12);
            assert_near(filter.s[i][1], poles.s[i][1], 1e-12);
        }
    }
}

/// The gain is what a long run of the recurrence gives when it is driven at one frequency.
TEST(test_gain_is_the_recurrences)
{
    const double hz = 1.3, turn = 2 * M_PI * hz * step;
    struct filter filter = filter_of(FILTER_TWO_REAL, 1, 0.2, 0, step);
    double size = exp(filter.s[0][0] * step), a = 2 * size * cos(filter.s[0][1] * step), b = -size * size;
    double before = 0, now = 0, largest = 0;
    for (int i = 0; i < 4000; i++) {
        double next = a * now + b * before + cos(turn * i);
        before = now;
        now = next;
        if (i > 2000) largest = fmax(largest, fabs(now));
    }
    assert_near(filter_decibels(&filter, hz), 20 * log10(largest), 0.02);
}

/// Nothing that a slider can be set to gives a number that cannot be shown.
TEST(test_finite_over_the_slider_box)
{
    const double hz[] = {0, 0.01, 1, 11.9, 12, 40}, damping[] = {0, 0.001, 1, 3}, bandwidth[] = {0, 0.1, 1};
    for (int kind = 0; kind < FILTER_KINDS; kind++) {
        for (int i = 0; i < 6 * 4 * 3; i++) {
            struct filter filter =
                filter_of((enum filter_kind)kind, hz[i % 6], damping[i / 6 % 4], bandwidth[i / 24], step);
            struct passband band = filter_passband(&filter);
            assert_true(isfinite(band.peak) && isfinite(band.zero) && band.zero <= 1e-9);
            assert_true(band.width >= 0 && band.width <= 12);
        }
    }
}
