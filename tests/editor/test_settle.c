/// The settle time beside damping, against the differential equation solved on a fine grid by other means.
#include "near.h"

#include "curve.h"
#include "editor/inspector/poles.h"
#include "spline_of.h"

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

TEST(test_real_mode)
{
    static const double zeta[] = {0.08, 0.2, 0.5, 0.8, 1, 1.5, 3};
    for (int z = 0; z < 7; z++) {
        struct spline spline = spline_of(WIGGLY_REAL, 1, zeta[z], 0);
        struct settling settling = settle_alone(&spline, 1.0 / 24);
        double expected = textbook_real(2 * acos(-1.0), zeta[z]);
        assert_int_equal(settling.kind, SETTLE_ALONE);
        assert_near(settling.seconds, expected, 0.05 * expected);
    }
}

/// Poles alike: |x| = e^{−ζωt} |cos(βω t)|.
TEST(test_complex_mode)
{
    static const double cases[][3] = {{1, 0.1, 0}, {1, 0.1, 0.1}, {0.5, 0.05, 0.2}, {3, 0.3, 0.1}, {2, 0.9, 0.1}};
    for (int c = 0; c < 5; c++) {
        double omega = 2 * acos(-1.0) * cases[c][0], zeta = cases[c][1], beta = cases[c][2], expected = 0;
        for (double t = 0; t < 40; t += 1e-4) {
            if (exp(-zeta * omega * t) * fabs(cos(beta * omega * t)) > 0.05) expected = t;
        }
        struct spline spline = spline_of(WIGGLY_COMPLEX, cases[c][0], zeta, beta);
        spline.parameter[PARAMETER_PASSIVE].value = WIGGLY_FILTER;
        struct settling settling = settle_alone(&spline, 1.0 / 24);
        assert_int_equal(settling.kind, SETTLE_ALONE);
        assert_near(settling.seconds, expected, 0.05 * expected);
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
TEST(test_is_measured_from_the_motion)
{
    const double expected = log(20) / (0.1 * 2 * acos(-1.0));
    struct settling seen = settling_of(WIGGLY_OSCILLATOR, WIGGLY_COMPLEX, 240);
    assert_int_equal(seen.kind, SETTLE_SEEN);
    assert_near(seen.seconds, expected, 1.01 / 24);
    struct settling filter = settling_of(WIGGLY_FILTER, WIGGLY_COMPLEX, 240);
    assert_int_equal(filter.kind, SETTLE_SEEN);
    assert_true(filter.seconds > 1.2 * expected);
    struct settling real = settling_of(WIGGLY_OSCILLATOR, WIGGLY_REAL, 240);
    assert_int_equal(real.kind, SETTLE_SEEN);
    assert_near(real.seconds, expected, 0.5);
    struct settling cut = settling_of(WIGGLY_OSCILLATOR, WIGGLY_COMPLEX, 80);
    assert_int_equal(cut.kind, SETTLE_LEFT);
    assert_near(cut.left, exp(-0.1 * 2 * acos(-1.0) * 50 / 24), 1e-6);
}

TEST(test_what_has_no_number)
{
    struct spline spline = spline_of(WIGGLY_CUBIC, 1, 0.1, 0.1);
    assert_int_equal(settle_alone(&spline, 1.0 / 24).kind, SETTLE_CUBIC);
    spline = spline_of(WIGGLY_COMPLEX, 0, 0.1, 0.1);
    assert_int_equal(settle_alone(&spline, 1.0 / 24).kind, SETTLE_CUBIC);
    spline = spline_of(WIGGLY_COMPLEX, 1, 0, 0.1);
    assert_int_equal(settle_alone(&spline, 1.0 / 24).kind, SETTLE_NEVER);
    spline = spline_of(WIGGLY_COMPLEX, 0.01, 0.001, 0.1);
    assert_int_equal(settle_alone(&spline, 1.0 / 24).kind, SETTLE_LATE);
    spline = spline_of(WIGGLY_COMPLEX, 1, 0.1, 0.1);
    spline.parameter[PARAMETER_DAMPING].track = 0;
    assert_int_equal(settle_alone(&spline, 1.0 / 24).kind, SETTLE_UNKNOWN);
    spline = spline_of(WIGGLY_REAL, 1, 0.01, 0); // so finely sampled that nobody would wait for the sum
    struct settling fine = settle_alone(&spline, 1e-6);
    assert_int_equal(fine.kind, SETTLE_ALONE);
    assert_near(fine.seconds, log(20) / (0.01 * 2 * acos(-1.0)), 1e-9);
}
