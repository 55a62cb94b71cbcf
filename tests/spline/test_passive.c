/// What moves by itself, of both kinds: the figures in docs/corrections.md are those of the solver, and the oscillator is what a damped
/// spring does.
#include "near.h"

#include "base/file.h"
#include "curve.h"

enum { MOST = 4096 };

static const double turn = 6.283185307179586;

static wiggly_desc swinging(wiggly_passive passive, double frequency, double damping)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.passive = passive;
    desc.frequency.value = frequency;
    desc.damping.value = damping;
    return desc;
}

/// Frame 0 to 1 in 20 frames, from `start` on, as smoothly as a cubic does it.
static double step_at(double frame, double start)
{
    double u = fmin(fmax((frame - start) / 20, 0), 1);
    return u * u * (3 - 2 * u);
}

/// Five plausible knots, and the turning points behind the last one.
static int after_the_knots(wiggly_passive passive, double extrema[5])
{
    static const double frame[] = {0, 8, 14, 22, 30}, value[] = {0, 0, 0.8, -0.735, 0.802};
    wiggly_knot knots[5] = {{0}};
    wiggly_desc desc = swinging(passive, 1, 0.1);
    wiggly_curve curve = curve_create(MOST);
    int count = 0;
    for (int i = 0; i < 5; i++) knots[i] = (wiggly_knot){.sample = (int)frame[i], .value = value[i]};
    desc.samples = 121;
    desc.knots = knots;
    desc.knot_count = 5;
    curve_solve(&curve, &desc);
    for (int i = 31; i < 120 && count < 5; i++) {
        const double *x = curve.total + i;
        if ((x[0] - x[-1]) * (x[1] - x[0]) <= 0) extrema[count++] = x[0];
    }
    curve_destroy(&curve);
    return count;
}

/// The largest total as the equilibrium steps aside.
static double peak_of_step(wiggly_passive passive, int substeps)
{
    static double track[MOST];
    wiggly_desc desc = swinging(passive, 1.2, 0.08);
    wiggly_curve curve = curve_create(MOST);
    double largest = 0;
    desc.samples = 152 * substeps + 1;
    desc.step = 1.0 / (24 * substeps);
    desc.start = WIGGLY_REST;
    desc.equilibrium.track = track;
    for (int i = 0; i < desc.samples; i++) track[i] = step_at((double)i / substeps, 40);
    curve_solve(&curve, &desc);
    for (int i = 0; i < desc.samples; i++) largest = fmax(largest, curve.total[i]);
    curve_destroy(&curve);
    return largest;
}

/// The same of x'' + 2ζω x' + ω² x = −y'', by a fourth-order Runge-Kutta method for v = total' on a fine grid.
static double peak_of_differential_equation(void)
{
    const double omega = 1.2 * turn, zeta = 0.08, h = 1e-4;
    double total = 0, v = 0, largest = 0;
    for (int i = 0; i < 60000; i++) {
        double k[4][2];
        for (int stage = 0; stage < 4; stage++) {
            double t = i * h + (stage == 0 ? 0 : stage == 3 ? h : h / 2), ahead = stage == 3 ? h : h / 2;
            double at = total + (stage ? ahead * k[stage - 1][0] : 0),
                   speed = v + (stage ? ahead * k[stage - 1][1] : 0);
            double y = step_at(24 * t, 40),
                   slope = (step_at(24 * t + 1e-4, 40) - step_at(24 * t - 1e-4, 40)) / 2e-4 * 24;
            k[stage][0] = speed;
            k[stage][1] = -2 * zeta * omega * (speed - slope) - omega * omega * (at - y);
        }
        total += h / 6 * (k[0][0] + 2 * k[1][0] + 2 * k[2][0] + k[3][0]);
        v += h / 6 * (k[0][1] + 2 * k[1][1] + 2 * k[2][1] + k[3][1]);
        largest = fmax(largest, total);
    }
    return largest;
}

/// A frequency that rises from nothing to 5 Hz, and three knots.
static double largest_on_a_rising_frequency(wiggly_passive passive)
{
    static double track[MOST];
    static const wiggly_knot knots[] = {{.sample = 0, .value = 0.5, .has_slope = true, .slope = 0, .stiffness = 1000},
                                        {.sample = 20, .value = 1},
                                        {.sample = 60, .value = 0}};
    wiggly_desc desc = swinging(passive, 0, 0.1);
    wiggly_curve curve = curve_create(MOST);
    double largest = 0;
    desc.samples = 241;
    desc.frequency.track = track;
    desc.knots = knots;
    desc.knot_count = 3;
    for (int i = 0; i < 241; i++) track[i] = 5.0 * i / 240;
    curve_solve(&curve, &desc);
    for (int i = 0; i < 241; i++) largest = fmax(largest, fabs(curve.total[i]));
    curve_destroy(&curve);
    return largest;
}

/// How far the curve is from itself at twice the rate, of its range: real mode, three keyed slopes.
static double change_with_rate(wiggly_passive passive, int substeps)
{
    double *at[2], low = 0, high = 0, worst = 0;
    wiggly_curve curves[2];
    for (int fine = 0; fine < 2; fine++) {
        const int by = substeps << fine;
        const wiggly_knot knots[] = {
            {.sample = 0},
            {.sample = by * 30, .value = 1, .has_slope = true, .slope = -3, .stiffness = 1000},
            {.sample = by * 70, .value = 0.2, .has_slope = true, .slope = 1, .stiffness = 1000}};
        wiggly_desc desc = swinging(passive, 1, 0.1);
        desc.mode = WIGGLY_REAL;
        desc.samples = 96 * by + 1;
        desc.step = 1.0 / (24 * by);
        desc.knots = knots;
        desc.knot_count = 3;
        curves[fine] = curve_create(desc.samples);
        curve_solve(&curves[fine], &desc);
        at[fine] = curves[fine].total;
    }
    for (int i = 0; i <= 96 * substeps; i++) {
        low = fmin(low, at[1][2 * i]), high = fmax(high, at[1][2 * i]);
        worst = fmax(worst, fabs(at[1][2 * i] - at[0][i]));
    }
    for (int fine = 0; fine < 2; fine++) curve_destroy(&curves[fine]);
    return worst / (high - low);
}

/// Fails unless docs/corrections.md has the row: what it says first, and what the filter and the oscillator make of it.
static void assert_row(const char *first, const char *filter, const char *oscillator)
{
    char *text, row[256], dash[256];
    size_t size, at = 0;
    assert_done(file_read("docs/corrections.md", 1 << 20, &text, &size, &error));
    snprintf(row, sizeof row, " | %s | %s |", filter, oscillator);
    for (const char *c = row; *c; c++)
        at += (size_t)snprintf(dash + at, sizeof dash - at, *c == '-' ? "−" : "%c", *c);
    const char *line = strstr(text, first), *found = line ? strstr(line, dash) : NULL;
    if (!found || found > strchr(line, '\n')) fail_msg("docs/corrections.md has no row “%s … %s”", first, dash);
    free(text);
}

static void print_extrema(wiggly_passive passive, char *text, size_t size)
{
    double extrema[5];
    size_t at = 0;
    assert_int_equal(after_the_knots(passive, extrema), 5);
    for (int i = 0; i < 5; i++) at += (size_t)snprintf(text + at, size - at, i ? " %.2f" : "%.2f", extrema[i]);
}

/// With the filter the swing grows; an oscillator's dies away by e^{−ζωt} from turning point to turning point.
TEST(the_swing_dies_away)
{
    char filter[64], oscillator[64];
    double extrema[5];
    print_extrema(WIGGLY_FILTER, filter, sizeof filter);
    print_extrema(WIGGLY_OSCILLATOR, oscillator, sizeof oscillator);
    assert_row("turning points after the knots", filter, oscillator);
    assert_int_equal(after_the_knots(WIGGLY_OSCILLATOR, extrema), 5);
    for (int i = 1; i < 5; i++) assert_near(-extrema[i] / extrema[i - 1], exp(-0.1 * turn / 2), 0.02);
    assert_int_equal(after_the_knots(WIGGLY_FILTER, extrema), 5);
    assert_true(fabs(extrema[2]) > fabs(extrema[0]));
}

TEST(an_equilibrium_that_moves)
{
    char filter[64], oscillator[64];
    const double exact = peak_of_differential_equation();
    double coarse = fabs(peak_of_step(WIGGLY_OSCILLATOR, 1) - exact),
           fine = fabs(peak_of_step(WIGGLY_OSCILLATOR, 8) - exact);
    snprintf(filter, sizeof filter, "%.2f", peak_of_step(WIGGLY_FILTER, 1));
    snprintf(oscillator, sizeof oscillator, "%.2f", peak_of_step(WIGGLY_OSCILLATOR, 1));
    assert_row("largest total as y goes from 0 to 1", filter, oscillator);
    assert_true(coarse < 4e-3 && fine < 1e-4);
}

TEST(a_frequency_that_rises_from_zero)
{
    char filter[64], oscillator[64];
    snprintf(filter, sizeof filter, "%.1f", largest_on_a_rising_frequency(WIGGLY_FILTER));
    snprintf(oscillator, sizeof oscillator, "%.1f", largest_on_a_rising_frequency(WIGGLY_OSCILLATOR));
    assert_row("largest total where the frequency rises", filter, oscillator);
}

TEST(slopes_at_twice_the_rate)
{
    char text[2][64];
    double change[2][2];
    for (int passive = 0; passive < 2; passive++) {
        for (int i = 0; i < 2; i++) change[passive][i] = change_with_rate((wiggly_passive)passive, i ? 4 : 1);
        snprintf(text[passive], sizeof text[passive], "%.1f %%", 100 * change[passive][0]);
    }
    assert_row("change of a real spline with slopes", text[WIGGLY_FILTER], text[WIGGLY_OSCILLATOR]);
    assert_true(change[WIGGLY_OSCILLATOR][1] < 0.08 * change[WIGGLY_OSCILLATOR][0]); // as h²
    assert_true(change[WIGGLY_FILTER][1] > 0.2 * change[WIGGLY_FILTER][0]);          // as h
}
