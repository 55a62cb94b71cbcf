/// What the inspector computes of a spline's poles: the frequency response beside them, against the three rows of the paper's Figure 2; and the
/// settle time beside damping, against the differential equation solved on a fine grid by other means.
#include "near.h"

#include "curve.h"
#include "editor/inspector/poles.h"
#include "spline_of.h"

static const double step = 1.0 / 24, turn = 6.283185307179586;

/// The largest response to 2 Hz, decibels; and how much of that range, Hz, is within half its power.
static double top_of(const struct filter *filter)
{
    double top = -INFINITY;
    for (int i = 0; i <= 20000; i++) top = fmax(top, filter_decibels(filter, 1e-4 * i));
    return top;
}

static double width_of(const struct filter *filter)
{
    const double least = top_of(filter) - 10 * log10(2);
    int first = 0, last = 20000;
    while (filter_decibels(filter, 1e-4 * first) < least) first++;
    while (filter_decibels(filter, 1e-4 * last) < least) last--;
    return 1e-4 * (last - first);
}

/// "There is significant response at zero frequency" of the two-pole real filter; four poles broaden the resonance, but it "is
/// still unacceptably high"; the complex one is as wide "while keeping the response at zero frequency much lower".
TEST(figure2)
{
    static const struct {
        enum filter_kind kind;
        double zero, width;
    } rows[] = {{FILTER_TWO_REAL, -20.1, 0.10}, {FILTER_FOUR_REAL, -28.7, 0.25}, {FILTER_TWO_COMPLEX, -39.9, 0.265}};
    for (int i = 0; i < 3; i++) {
        const struct filter filter = filter_of(rows[i].kind, 1, 0.05, 0.1, step);
        const double zero = filter_decibels(&filter, 0) - top_of(&filter), width = width_of(&filter);
        if (!(fabs(zero - rows[i].zero) <= 0.05 && fabs(width - rows[i].width) <= 0.005))
            fail_msg("row %d: %g dB, %g Hz", i, zero, width);
    }
}

/// The active filter's poles are those that the solver uses.
TEST(poles_are_the_solvers)
{
    static const struct {
        enum wiggly_mode mode;
        enum filter_kind kind;
        double damping;
    } rows[] = {{WIGGLY_COMPLEX, FILTER_TWO_COMPLEX, 0.2},
                {WIGGLY_REAL, FILTER_TWO_REAL, 0.3},
                {WIGGLY_REAL, FILTER_TWO_REAL, 1.5},
                {WIGGLY_REAL, FILTER_TWO_REAL, 2.7}};
    for (int i = 0; i < 4; i++) {
        wiggly_desc desc = wiggly_default_desc();
        desc.samples = 100;
        desc.step = step;
        desc.mode = rows[i].mode;
        desc.frequency.value = 1.7;
        desc.damping.value = rows[i].damping;
        desc.bandwidth.value = 0.15;
        const wiggly_poles poles = wiggly_poles_at(&desc, 0);
        const struct filter filter = filter_of(rows[i].kind, 1.7, rows[i].damping, 0.15, step);
        assert_int_equal(filter.count, 2);
        for (int k = 0; k < 4; k++) {
            const double is = filter.s[k / 2][k % 2], expected = poles.s[k / 2][k % 2];
            if (!(fabs(is - expected) <= 1e-12)) fail_msg("row %d: %g, expected %g", i, is, expected);
        }
    }
}

/// The gain is what a long run of the recurrence gives when it is driven at one frequency.
TEST(gain_is_the_recurrences)
{
    const double hz = 1.3;
    struct filter filter = filter_of(FILTER_TWO_REAL, 1, 0.2, 0, step);
    double size = exp(filter.s[0][0] * step), a = 2 * size * cos(filter.s[0][1] * step), b = -size * size;
    double before = 0, now = 0, largest = 0;
    for (int i = 0; i < 4000; i++) {
        double next = a * now + b * before + cos(turn * hz * step * i);
        before = now;
        now = next;
        if (i > 2000) largest = fmax(largest, fabs(now));
    }
    assert_near(filter_decibels(&filter, hz), 20 * log10(largest), 0.02);
}

/// Nothing that a slider can be set to gives a number that cannot be shown.
TEST(finite_over_the_slider_box)
{
    const double hz[] = {0, 0.01, 1, 11.9, 12, 40}, damping[] = {0, 0.001, 1, 3}, bandwidth[] = {0, 0.1, 1};
    for (int kind = 0; kind < FILTER_KINDS; kind++) {
        for (int i = 0; i < 6 * 4 * 3; i++) {
            struct filter filter =
                filter_of((enum filter_kind)kind, hz[i % 6], damping[i / 6 % 4], bandwidth[i / 24], step);
            for (int at = -12; at <= 12; at++) assert_true(isfinite(filter_decibels(&filter, at)));
        }
    }
}

// --- settling ---

/// x″ + 2ζω x′ + ω² x = 0 from 1 at standstill, by a fourth-order Runge-Kutta method: last time at which |x| > 0.05.
static double textbook_real(double omega, double zeta)
{
    double x = 1, v = 0, last = 0, h = 1e-4;
    for (int i = 0; i < 200000; i++) {
        double k[4][2];
        for (int stage = 0; stage < 4; stage++) {
            double weight = stage == 0 ? 0 : stage == 3 ? h : h / 2;
            double at_x = x + (stage ? weight * k[stage - 1][0] : 0),
                   at_v = v + (stage ? weight * k[stage - 1][1] : 0);
            k[stage][0] = at_v;
            k[stage][1] = -2 * zeta * omega * at_v - omega * omega * at_x;
        }
        x += h / 6 * (k[0][0] + 2 * k[1][0] + 2 * k[2][0] + k[3][0]);
        v += h / 6 * (k[0][1] + 2 * k[1][1] + 2 * k[2][1] + k[3][1]);
        if (fabs(x) > 0.05) last = (i + 1) * h;
    }
    return last;
}

static void assert_settles(struct spline spline, double expected)
{
    const struct settling settling = settle_alone(&spline, step);
    if (settling.kind != SETTLE_ALONE || !(fabs(settling.seconds - expected) <= 0.05 * expected))
        fail_msg("%g Hz, damping %g: %g s, expected %g", spline.parameter[PARAMETER_FREQUENCY].value,
                 spline.parameter[PARAMETER_DAMPING].value, settling.seconds, expected);
}

TEST(a_spring_settles)
{
    static const double zeta[] = {0.08, 0.2, 0.5, 0.8, 1, 1.5, 3};
    for (int z = 0; z < 7; z++) assert_settles(spline_of(WIGGLY_REAL, 1, zeta[z], 0), textbook_real(turn, zeta[z]));
}

/// Poles alike: |x| = e^{−ζωt} |cos(βω t)|.
TEST(a_filter_settles)
{
    static const double cases[][3] = {{1, 0.1, 0}, {1, 0.1, 0.1}, {0.5, 0.05, 0.2}, {3, 0.3, 0.1}, {2, 0.9, 0.1}};
    for (int c = 0; c < 5; c++) {
        double omega = turn * cases[c][0], zeta = cases[c][1], beta = cases[c][2], expected = 0;
        for (double t = 0; t < 40; t += 1e-4) {
            if (exp(-zeta * omega * t) * fabs(cos(beta * omega * t)) > 0.05) expected = t;
        }
        struct spline spline = spline_of(WIGGLY_COMPLEX, cases[c][0], zeta, beta);
        spline.parameter[PARAMETER_PASSIVE].value = WIGGLY_FILTER;
        assert_settles(spline, expected);
    }
}

/// The five knots of docs/corrections.md at 24 fps, over so many frames.
static struct settling settling_of(wiggly_passive passive, enum wiggly_mode mode, int frames)
{
    static const int frame[] = {0, 8, 14, 22, 30};
    static const double value[] = {0, 0, 0.8, -0.735, 0.802};
    struct spline spline = spline_of(mode, 1, 0.1, 0.1);
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = curve_create(frames + 1);
    wiggly_knot knots[5] = {{0}};
    for (int i = 0; i < 5; i++) knots[i] = (wiggly_knot){.sample = frame[i], .value = value[i]};
    spline.parameter[PARAMETER_PASSIVE].value = passive;
    desc.samples = frames + 1;
    desc.mode = mode;
    desc.frequency.value = 1;
    desc.damping.value = 0.1;
    desc.passive = passive;
    desc.knots = knots;
    desc.knot_count = 5;
    curve_solve(&curve, &desc);
    struct settling settling = settle_measure(&spline, &curve, 30);
    curve_destroy(&curve);
    return settling;
}

/// Behind the last knot an oscillator's swing is e^{−ζωt} of what it was; the filter's grows first.
TEST(settling_is_measured_from_the_motion)
{
    const double expected = log(20) / (0.1 * turn);
    static const struct {
        wiggly_passive passive;
        enum wiggly_mode mode;
        double least, most; ///< more than expected
    } rows[] = {{WIGGLY_OSCILLATOR, WIGGLY_COMPLEX, -1.01 / 24, 1.01 / 24},
                {WIGGLY_FILTER, WIGGLY_COMPLEX, 0.953, INFINITY},
                {WIGGLY_OSCILLATOR, WIGGLY_REAL, -0.5, 0.5}};
    for (int i = 0; i < 3; i++) {
        const struct settling seen = settling_of(rows[i].passive, rows[i].mode, 240);
        assert_int_equal(seen.kind, SETTLE_SEEN);
        const double more = seen.seconds - expected;
        if (!(more >= rows[i].least && more <= rows[i].most)) fail_msg("row %d: %g s", i, seen.seconds);
    }
    const struct settling cut = settling_of(WIGGLY_OSCILLATOR, WIGGLY_COMPLEX, 80);
    assert_int_equal(cut.kind, SETTLE_LEFT);
    assert_near(cut.left, exp(-0.1 * turn * 50 / 24), 1e-6);
}

TEST(what_has_no_number)
{
    static const struct {
        enum wiggly_mode mode;
        double frequency, damping;
        int kind;
    } rows[] = {{WIGGLY_CUBIC, 1, 0.1, SETTLE_CUBIC},
                {WIGGLY_COMPLEX, 0, 0.1, SETTLE_CUBIC},
                {WIGGLY_COMPLEX, 1, 0, SETTLE_NEVER},
                {WIGGLY_COMPLEX, 0.01, 0.001, SETTLE_LATE}};
    struct spline spline;
    for (int i = 0; i < 4; i++) {
        spline = spline_of(rows[i].mode, rows[i].frequency, rows[i].damping, 0.1);
        const struct settling settling = settle_alone(&spline, step);
        if ((int)settling.kind != rows[i].kind) fail_msg("row %d: kind %d", i, (int)settling.kind);
    }
    spline = spline_of(WIGGLY_COMPLEX, 1, 0.1, 0.1);
    spline.parameter[PARAMETER_DAMPING].track = 0;
    assert_int_equal(settle_alone(&spline, step).kind, SETTLE_UNKNOWN);
    spline = spline_of(WIGGLY_REAL, 1, 0.01, 0); // so finely sampled that nobody would wait for the sum
    const struct settling fine = settle_alone(&spline, 1e-6);
    assert_int_equal(fine.kind, SETTLE_ALONE);
    assert_near(fine.seconds, log(20) / (0.01 * turn), 1e-9);
}
