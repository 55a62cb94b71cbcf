/// What a tail follows a dragged body by: the solver's own oscillator or filter, whatever the frame rate, and it comes to rest.
#include "curve.h"

#include "rig/swing.h"
#include "spline_of.h"

static const double turn = 6.283185307179586;

static struct swing_filter filter_of(const struct spline *spline)
{
    struct swing_filter filter;
    double parameter[PARAMETER_COUNT];
    for (int p = 0; p < PARAMETER_COUNT; p++) parameter[p] = spline->parameter[p].value;
    assert_true(swing_filter(spline, parameter, &filter));
    return filter;
}

/// Half a metre in half a second, from rest to rest.
static double base_at(double t)
{
    double u = fmin(fmax(t / 0.5, 0), 1);
    return 0.5 * u * u * (3 - 2 * u);
}

/// Follows base_at(), looked at `rate` times a second, for 3 s.
static struct swing shaken(const struct swing_filter *filter, double rate)
{
    struct swing swing = {{0}, {0}};
    double velocity = 0;
    for (int i = 0; i < (int)lround(3 * rate); i++) {
        double next = (base_at((i + 1) / rate) - base_at(i / rate)) * rate;
        swing_step(&swing, filter, next - velocity, 1 / rate);
        velocity = next;
    }
    return swing;
}

enum { RATE = 960, SAMPLES = 3 * RATE + 1 };

static double y[SAMPLES], re[SAMPLES], im[SAMPLES], total[SAMPLES], omega[SAMPLES], track[SAMPLES];

/// The forward response of Figure 5: from rest, no knots, the base's motion as equilibrium.
static wiggly_value solved(const struct spline *spline)
{
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = {.size = sizeof curve, .total = total, .y = y, .re = re, .im = im, .omega = omega};
    for (int i = 0; i < SAMPLES; i++) track[i] = base_at((double)i / RATE);
    desc.samples = SAMPLES;
    desc.step = 1.0 / RATE;
    desc.mode = spline_mode(spline);
    desc.passive = (wiggly_passive)spline->parameter[PARAMETER_PASSIVE].value;
    desc.start = WIGGLY_REST;
    desc.frequency.value = spline->parameter[PARAMETER_FREQUENCY].value;
    desc.damping.value = spline->parameter[PARAMETER_DAMPING].value;
    desc.bandwidth.value = spline->parameter[PARAMETER_BANDWIDTH].value;
    desc.equilibrium.track = track;
    curve_solve(&curve, &desc);
    return (wiggly_value){y[SAMPLES - 1], re[SAMPLES - 1], im[SAMPLES - 1]};
}

TEST(test_is_what_the_solver_says)
{
    struct spline splines[] = {spline_of(WIGGLY_COMPLEX, 1, 0.08, 0.08), spline_of(WIGGLY_COMPLEX, 2, 0.2, 0),
                               spline_of(WIGGLY_REAL, 1.5, 0.1, 0), spline_of(WIGGLY_REAL, 1, 1, 0),
                               spline_of(WIGGLY_REAL, 1, 3, 0)};
    for (size_t s = 0; s < 2 * (sizeof splines / sizeof splines[0]); s++) {
        struct spline *spline = &splines[s / 2];
        spline->parameter[PARAMETER_PASSIVE].value = s % 2 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
        struct swing_filter filter = filter_of(spline);
        struct swing swing = shaken(&filter, RATE);
        wiggly_value value = solved(spline);
        double size = 0.5 * filter.peak;
        assert_near(swing.x[0], value.re, 2e-3 * size);
        assert_near(swing.x[1], value.im, 2e-3 * size);
    }
}

/// Told of the same base at the same times, it is the solved curve, to the last digits.
TEST(test_has_the_digits_of_the_solver)
{
    const struct spline splines[] = {spline_of(WIGGLY_COMPLEX, 1, 0.08, 0.08), spline_of(WIGGLY_COMPLEX, 2, 0.2, 0),
                                     spline_of(WIGGLY_REAL, 1.5, 0.1, 0), spline_of(WIGGLY_REAL, 1, 3, 0)};
    for (size_t s = 0; s < sizeof splines / sizeof splines[0]; s++) {
        struct swing_filter filter = filter_of(&splines[s]);
        struct swing swing = {{0}, {0}};
        solved(&splines[s]);
        for (int i = 0; i + 1 < SAMPLES; i++) {
            double here = y[i] + swing.x[0], before = y[i > 0 ? i - 1 : 0], step = 1.0 / RATE;
            assert_near(total[i], here, 1e-13);
            swing_step(&swing, &filter, ((y[i + 1] - y[i]) - (y[i] - before)) / step, step);
        }
    }
}

/// A tail is no rod that starts to swing later: it has most of its swing while the base still moves, the largest within half a period
/// of its stop, and dies away from there. With the filter it is the other way round: its two poles ring up together first.
TEST(test_answers_at_once_and_does_not_grow)
{
    enum { HZ = 60, STOP = HZ / 2, HALF_PERIOD = HZ / 2 };
    struct spline spline = spline_of(WIGGLY_COMPLEX, 1, 0.08, 0.1);
    for (int passive = 0; passive < 2; passive++) {
        spline.parameter[PARAMETER_PASSIVE].value = passive;
        struct swing_filter filter = filter_of(&spline);
        struct swing swing = {{0}, {0}};
        double velocity = 0, largest = 0, early = 0;
        int largest_at = 0;
        for (int i = 0; i < 4 * HZ; i++) {
            double next = (base_at((i + 1.0) / HZ) - base_at((double)i / HZ)) * HZ;
            swing_step(&swing, &filter, next - velocity, 1.0 / HZ);
            velocity = next;
            if (fabs(swing.x[0]) > largest) largest = fabs(swing.x[0]), largest_at = i;
            if (i < STOP) early = largest;
        }
        bool at_once = early > 0.5 * largest && largest_at < STOP + HALF_PERIOD;
        assert_int_equal(at_once, passive == WIGGLY_OSCILLATOR);
    }
}

/// The same way of the base, told at 30, 60 and 144 frames a second.
TEST(test_frame_rate_does_not_matter)
{
    const struct spline spline = spline_of(WIGGLY_COMPLEX, 1.2, 0.1, 0.1);
    struct swing_filter filter = filter_of(&spline);
    struct swing slow = {{0}, {0}}, fast = slow;
    swing_step(&slow, &filter, 0.7, 0.4);
    for (int i = 0; i < 100; i++) swing_step(&fast, &filter, i == 0 ? 0.7 : 0, 0.004);
    assert_near(fast.x[0], slow.x[0], 1e-13);
    assert_near(fast.x[1], slow.x[1], 1e-13);
    struct swing at30 = shaken(&filter, 30), at144 = shaken(&filter, 144);
    assert_near(at30.x[0], at144.x[0], 0.02 * 0.5 * filter.peak);
}

/// Even a spline that rings forever lets its tail come to rest, and the base's step swings it no further than `peak`.
TEST(test_comes_to_rest_within_its_peak)
{
    const struct spline splines[] = {spline_of(WIGGLY_COMPLEX, 1, 0, 0.1), spline_of(WIGGLY_COMPLEX, 3, 0.3, 0.2),
                                     spline_of(WIGGLY_REAL, 1, 0.1, 0)};
    for (size_t s = 0; s < sizeof splines / sizeof splines[0]; s++) {
        struct swing_filter filter = filter_of(&splines[s]);
        struct swing swing = {{0}, {0}};
        double largest = 0, seconds = 0;
        swing_step(&swing, &filter, 1000, 0.001); // a metre in a millisecond
        swing_step(&swing, &filter, -1000, 0.001);
        while (!swing_settled(&swing, &filter)) {
            swing_step(&swing, &filter, 0, 0.01);
            largest = fmax(largest, hypot(swing.x[0], swing.x[1]));
            seconds += 0.01;
            assert_true(seconds < 120);
        }
        assert_true(largest > 0.7 * filter.peak && largest < 1.25 * filter.peak);
    }
}

TEST(test_nothing_pulls_a_cubic_back)
{
    struct swing_filter filter;
    const double parameter[PARAMETER_COUNT] = {0};
    struct spline spline = spline_of(WIGGLY_CUBIC, 1, 0.1, 0.1);
    assert_false(swing_filter(&spline, parameter, &filter));
    spline.parameter[PARAMETER_MODE].value = WIGGLY_COMPLEX;
    assert_false(swing_filter(&spline, parameter, &filter));
}

static void find_arm(const struct tail *tail, struct swing_arm *arm)
{
    struct rig rig = {.kind = RIG_TAIL, .tail = *tail};
    struct rig *rigs[] = {&rig};
    struct document document = {.rigs = rigs, .rig_count = 1};
    assert_true(swing_arm(&(struct posing){.document = &document}, 0, arm));
}

/// A channel of the total swings its tip about as far as the base goes; one of the displacement says itself how far, and then it
/// alone hangs on the base.
TEST(test_scale_and_direction)
{
    struct channel channels[2];
    memset(channels, 0, sizeof channels);
    channels[0].gain.value[0] = 4;
    channels[1].of = PART_DISPLACEMENT;
    struct tail tail = {.joints = 40, .length = 1.6, .channels = channels, .channel_count = 1};
    const struct spline spline = spline_of(WIGGLY_COMPLEX, 1, 0.1, 0.1);
    struct swing_filter filter = filter_of(&spline);
    struct swing_arm arm;
    find_arm(&tail, &arm);
    double scale = swing_scale(&arm, &channels[0], &filter), bend = 4 * turn / 360 * scale * filter.peak, tip = 0;
    for (int n = 0; n < 40; n++) tip += bend * 1.6 * (40 - n) / 40;
    assert_near(tip, 1, 1e-12);
    assert_true(swing_hangs(channels, 1, &channels[0]));
    assert_false(swing_hangs(channels, 2, &channels[0]));
    assert_true(swing_hangs(channels, 2, &channels[1]));
    assert_near(swing_scale(&arm, &channels[1], &filter), 1, 0);
    double direction[3];
    swing_direction(&arm, AXIS_SIDE, direction);
    assert_near(direction[0], 1, 0);
    tail.rest.form = ANGLES_EACH;
    tail.rest.count = tail.joints;
    tail.rest.value[0] = 30; // lifted by 30 degrees: moving away in front of it presses it down
    find_arm(&tail, &arm);
    swing_direction(&arm, AXIS_UP, direction);
    assert_near(direction[1], cos(turn / 12), 1e-6);
    assert_near(direction[2], -sin(turn / 12), 1e-6);
}
