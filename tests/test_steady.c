/// Steady splines: the mean that the mathematics page says, on every knot, swinging out as any spline does, within limits; and where it
/// changes nothing.
#include "near.h"

#include "curve.h"
#include "textbook.h"
#include <complex.h>
#include <math.h>
#include <string.h>

enum { SAMPLES = 121, MOST_KNOTS = 5, PARTS = 5 };

static struct textbook book;
static wiggly_solver *solver;
static wiggly_curve curve, other;
static double track[SAMPLES];

struct layout {
    wiggly_desc desc;
    wiggly_knot knots[MOST_KNOTS];
};

/// Knots that suit the frequency badly.
static void make_layout(struct layout *l, wiggly_mode mode, wiggly_start start)
{
    static const struct {
        int sample;
        double value;
    } keys[MOST_KNOTS] = {{9, 1}, {22, 0.8}, {41, -0.9}, {57, -0.7}, {80, 0.6}};
    *l = (struct layout){.desc = wiggly_default_desc()};
    l->desc.samples = SAMPLES;
    l->desc.mode = mode;
    l->desc.start = start;
    l->desc.frequency.value = 1.3;
    l->desc.damping.value = 0.08;
    l->desc.steady = 1;
    l->desc.knots = l->knots;
    l->desc.knot_count = MOST_KNOTS;
    for (int k = 0; k < MOST_KNOTS; k++)
        l->knots[k] = (wiggly_knot){.sample = keys[k].sample, .value = keys[k].value};
}

static void solve(const wiggly_desc *desc, wiggly_curve *into)
{
    wiggly_status status = wiggly_solve(solver, desc, into);
    if (status != WIGGLY_OK) fail_msg("%s", wiggly_status_text(status));
}

/// E of the textbook's answer where nothing but the knots asks for anything: a quadratic of it.
static real energy_of_book(void)
{
    real sum = 0;
    for (int i = 0; i < 2 * book.count; i++) {
        for (int j = 0; j < 2 * book.count; j++) sum += book.x[i] * textbook_entry(&book, i, j) * book.x[j];
    }
    return sum;
}

/// The formula of the mathematics page, from the textbook's solutions.
static void take_mean(const wiggly_desc *desc, double *re, double *im)
{
    static double one[3][SAMPLES];
    const real omega = 2 * M_PIq * desc->frequency.value,
               easy = 0.02Q * omega * omega * omega; // the largest knot is 1
    real weights = 0;
    memset(re, 0, sizeof(double) * SAMPLES);
    memset(im, 0, sizeof(double) * SAMPLES);
    for (int part = 0; part < PARTS; part++) {
        wiggly_desc detuned = *desc;
        detuned.frequency.value *= 1 + 0.22 * desc->steady * (part - 2) / 2.0;
        assert_true(textbook_as(&detuned, WIGGLY_OK, &book, one[0], one[1], one[2]));
        real weight = 1 + powq(easy / energy_of_book(), 3.5Q);
        weights += weight;
        for (int i = 0; i < SAMPLES; i++) {
            re[i] += (double)(weight / weights) * (one[1][i] - re[i]);
            im[i] += (double)(weight / weights) * (one[2][i] - im[i]);
        }
    }
}

/// In a loop, and in real mode as far as the sample after the last knot, nothing moves by itself: there the mean is that of splines.
static void it_is_the_mean_of_the_page(void **state)
{
    (void)state;
    static double re[SAMPLES], im[SAMPLES];
    for (int kind = 0; kind < 6; kind++) {
        struct layout l;
        const bool loop = kind < 4;
        make_layout(&l, loop && kind % 2 ? WIGGLY_COMPLEX : WIGGLY_REAL, loop ? WIGGLY_LOOP : WIGGLY_FREE);
        l.desc.passive = kind % 4 < 2 ? WIGGLY_OSCILLATOR : WIGGLY_FILTER;
        l.desc.steady = kind == 5 ? 0.6 : 1;
        solve(&l.desc, &curve);
        take_mean(&l.desc, re, im);
        const int end = loop ? SAMPLES : l.knots[MOST_KNOTS - 1].sample + 2;
        for (int i = 0; i < end; i++) {
            assert_near(curve.re[i], re[i], 1e-9);
            assert_near(curve.im[i], im[i], 1e-9);
        }
        l.desc.steady = 0;
        solve(&l.desc, &other);
        double most = 0;
        for (int i = 0; i < end; i++) most = fmax(most, fabs(curve.re[i] - other.re[i]));
        assert_true(most > 0.02);
    }
}

/// Every way to ask: mode, start, what moves by itself, a moving equilibrium, tracks, a slope at the last knot.
static void make_any(struct layout *l, int kind)
{
    make_layout(l, kind % 2 ? WIGGLY_COMPLEX : WIGGLY_REAL, (wiggly_start)(kind / 2 % 3));
    l->desc.passive = (wiggly_passive)(kind / 6 % 2);
    const int variant = kind / 12;
    for (int i = 0; i < SAMPLES; i++) track[i] = variant == 1 ? 0.3 * sin(0.11 * i) : 1.3 + 0.4 * sin(0.05 * i);
    if (variant == 1) l->desc.equilibrium.track = track;
    if (variant == 2) l->desc.frequency.track = track;
    if (variant == 3) {
        l->knots[MOST_KNOTS - 1].has_slope = true;
        l->knots[MOST_KNOTS - 1].slope = 1.5, l->knots[MOST_KNOTS - 1].stiffness = 1000;
    }
}

enum { KINDS = 12 * 4 };

static void it_goes_through_every_knot(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        struct layout l;
        make_any(&l, kind);
        solve(&l.desc, &curve);
        for (int k = 0; k < MOST_KNOTS; k++) {
            const int at = l.knots[k].sample;
            assert_true(curve.total[at] == l.knots[k].value);
            assert_near(curve.y[at] + curve.re[at], l.knots[k].value, 1e-14);
        }
    }
}

/// One pole in complex mode, two in the others: those of the frequency as it is written.
static void it_swings_out_at_its_own_frequency(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        struct layout l;
        make_any(&l, kind);
        const wiggly_desc *desc = &l.desc;
        if (desc->start == WIGGLY_LOOP || desc->frequency.track || desc->equilibrium.track) continue;
        solve(desc, &curve);
        const wiggly_poles at = wiggly_poles_at(desc, 0);
        const bool one = desc->mode == WIGGLY_COMPLEX && desc->passive == WIGGLY_OSCILLATOR;
        for (int i = l.knots[MOST_KNOTS - 1].sample + (one ? 0 : 1); i + 1 < SAMPLES; i++) {
            double _Complex x[3], s[2], next;
            for (int k = 0; k < 3; k++) x[k] = curve.re[i + k - 1] + 1.0i * curve.im[i + k - 1];
            for (int k = 0; k < 2; k++) s[k] = at.z[k][0] + 1.0i * at.z[k][1];
            next = one ? cexp((at.s[0][0] + 0.5i * (at.s[0][1] + at.s[1][1])) * desc->step) * x[1]
                       : (s[0] + s[1]) * x[1] - s[0] * s[1] * x[0];
            assert_near(creal(x[2]), creal(next), 1e-8);
            assert_near(cimag(x[2]), cimag(next), 1e-8);
        }
    }
}

/// u is that of the description: what a knot asks for beyond it is all that is steadied.
static void an_equilibrium_that_asks_for_nothing_else_is_answered_as_ever(void **state)
{
    (void)state;
    struct layout l;
    make_layout(&l, WIGGLY_COMPLEX, WIGGLY_FREE);
    for (int i = 0; i < SAMPLES; i++) track[i] = i < 30 ? 0 : 1;
    l.desc.equilibrium.track = track;
    l.desc.knot_count = 0;
    l.desc.steady = 0;
    solve(&l.desc, &curve);
    for (int k = 0; k < MOST_KNOTS; k++) l.knots[k].value = curve.total[l.knots[k].sample];
    l.desc.knot_count = MOST_KNOTS;
    l.desc.steady = 1;
    solve(&l.desc, &other);
    for (int i = 0; i < SAMPLES; i++) assert_near(other.total[i], curve.total[i], 1e-12);
}

/// Two ways to the same frequencies: a number, a track of one number, spring and friction; chain and band.
static void tracks_and_springs_are_detuned_alike(void **state)
{
    (void)state;
    for (int mode = WIGGLY_COMPLEX; mode <= WIGGLY_REAL; mode++) {
        struct layout l;
        make_layout(&l, (wiggly_mode)mode, WIGGLY_FREE);
        solve(&l.desc, &curve);
        for (int i = 0; i < SAMPLES; i++) track[i] = l.desc.frequency.value;
        l.desc.frequency.track = track;
        solve(&l.desc, &other);
        for (int i = 0; i < SAMPLES; i++) assert_near(other.total[i], curve.total[i], 1e-8);
        l.desc.frequency.track = NULL;
        wiggly_set_method(solver, WIGGLY_BAND);
        solve(&l.desc, &other);
        wiggly_set_method(solver, WIGGLY_CHAIN);
        for (int i = 0; i < SAMPLES; i++) assert_near(other.total[i], curve.total[i], 1e-8);
        if (mode == WIGGLY_COMPLEX) continue;
        const double omega = 2 * 3.14159265358979323846 * l.desc.frequency.value;
        l.desc.spring_friction = true;
        l.desc.spring.value = omega * omega, l.desc.friction.value = 2 * l.desc.damping.value * omega;
        solve(&l.desc, &other);
        for (int i = 0; i < SAMPLES; i++) assert_near(other.total[i], curve.total[i], 1e-9);
    }
}

static void it_stays_within_limits(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        struct layout l;
        int touched = 0;
        make_any(&l, kind);
        if (kind / 12 == 1) continue; // the equilibrium's own motion goes beyond before the first knot
        l.desc.low = -0.95, l.desc.high = 1.02;
        solve(&l.desc, &curve);
        for (int i = 0; i < SAMPLES; i++) {
            assert_true(curve.total[i] >= l.desc.low && curve.total[i] <= l.desc.high);
            assert_near(curve.total[i], curve.y[i] + curve.re[i], 1e-9);
            touched += fabs(curve.total[i]) > 0.94;
        }
        for (int k = 0; k < MOST_KNOTS; k++) assert_true(curve.total[l.knots[k].sample] == l.knots[k].value);
        assert_true(touched > 1);
    }
}

/// Limits sort the knots, and every part must find them so.
static void the_order_of_knots_does_not_matter(void **state)
{
    (void)state;
    struct layout l;
    for (int wide = 0; wide < 2; wide++) {
        make_layout(&l, WIGGLY_COMPLEX, WIGGLY_FREE);
        l.desc.low = wide ? -50 : -0.95, l.desc.high = wide ? 50 : 1.02;
        solve(&l.desc, &curve);
        const wiggly_knot first = l.knots[0];
        l.knots[0] = l.knots[3], l.knots[3] = first;
        solve(&l.desc, &other);
        assert_memory_equal(curve.total, other.total, sizeof(double) * SAMPLES);
    }
}

/// 0, a cubic and a spline without knots are solved as ever, whatever the solver did before.
static void it_changes_no_bit_of_others(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS + 100; kind++) {
        struct layout l;
        wiggly_solver *fresh;
        make_any(&l, kind < KINDS ? kind : 1);
        l.desc.frequency.value += 0.01 * kind;
        solve(&l.desc, &curve);
        if (kind >= KINDS) l.desc.frequency.value *= 1 + 0.22; // the last part's, at times to the last bit
        l.desc.steady = 0;
        solve(&l.desc, &curve);
        assert_int_equal(wiggly_create(SAMPLES, MOST_KNOTS, &fresh), WIGGLY_OK);
        assert_int_equal(wiggly_solve(fresh, &l.desc, &other), WIGGLY_OK);
        assert_memory_equal(curve.total, other.total, sizeof(double) * SAMPLES);
        assert_memory_equal(curve.im, other.im, sizeof(double) * SAMPLES);
        l.desc.mode = WIGGLY_CUBIC;
        solve(&l.desc, &curve);
        l.desc.steady = 1;
        assert_int_equal(wiggly_solve(fresh, &l.desc, &other), WIGGLY_OK);
        assert_memory_equal(curve.total, other.total, sizeof(double) * SAMPLES);
        wiggly_destroy(fresh);
    }
}

static void bits_do_not_depend_on_the_way(void **state)
{
    (void)state;
    enum { MANY = 3 * KINDS };
    static wiggly_desc descs[MANY];
    static struct layout l[MANY];
    static double totals[MANY][SAMPLES], tracks[MANY][SAMPLES];
    static wiggly_curve curves[MANY];
    wiggly_batch *batch;
    for (int i = 0; i < MANY; i++) {
        make_any(&l[i], i % KINDS);
        memcpy(tracks[i], track, sizeof track);
        descs[i] = l[i].desc;
        descs[i].steady = i % 3 * 0.5;
        if (descs[i].equilibrium.track) descs[i].equilibrium.track = tracks[i];
        if (descs[i].frequency.track) descs[i].frequency.track = tracks[i];
        curves[i].total = totals[i];
    }
    assert_int_equal(wiggly_batch_create(SAMPLES, MOST_KNOTS, 2, &batch), WIGGLY_OK);
    assert_int_equal(wiggly_batch_solve(batch, descs, curves, NULL, MANY), WIGGLY_OK);
    wiggly_batch_destroy(batch);
    for (int i = MANY - 1; i >= 0; i--) {
        wiggly_curve only = {.total = other.total};
        solve(&descs[i], &curve);
        solve(&descs[i], &only);
        assert_memory_equal(totals[i], curve.total, sizeof totals[i]);
        assert_memory_equal(totals[i], only.total, sizeof totals[i]);
    }
}

/// Values whose squares no double holds, and knots that ask for nothing.
static void it_is_finite(void **state)
{
    (void)state;
    static const double sizes[] = {1e299, 1e160, 1e-170, 0};
    for (int s = 0; s < 4; s++) {
        struct layout l;
        make_layout(&l, WIGGLY_COMPLEX, WIGGLY_FREE);
        for (int k = 0; k < MOST_KNOTS; k++) l.knots[k].value *= sizes[s];
        assert_true(wiggly_solve(solver, &l.desc, &curve) <
                    WIGGLY_ERROR_ARGUMENT); // as without: the first is singular
        for (int i = 0; i < SAMPLES; i++) assert_true(fabs(curve.total[i]) <= 3 * sizes[s]);
        for (int k = 0; k < MOST_KNOTS; k++) assert_true(curve.total[l.knots[k].sample] == l.knots[k].value);
    }
}

/// Figure 4 with its third knot late: the swing between must not all but stop (0.773 without), within limits neither.
static void it_keeps_swinging(void **state)
{
    (void)state;
    static const double limits[] = {INFINITY, 1.15};
    const int samples[] = {0, 36, 115};
    wiggly_knot knots[3];
    for (int k = 0; k < 3; k++)
        knots[k] = (wiggly_knot){.sample = samples[k], .value = k > 0, .has_slope = true, .stiffness = 1000};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES;
    desc.frequency.value = 1, desc.damping.value = 0.05;
    desc.steady = 1;
    desc.knots = knots, desc.knot_count = 3;
    for (int way = 0; way < 2; way++) {
        desc.high = limits[way], desc.low = -limits[way];
        solve(&desc, &curve);
        double least = INFINITY;
        for (int i = 40; i <= 111; i++) {
            double here = curve.total[i], before = here - curve.total[i - 1], after = curve.total[i + 1] - here;
            if (before * after <= 0) least = fmin(least, fabs(here));
        }
        assert_true(least >= 0.95);
    }
}

static void takes_and_wrong_numbers_are_refused(void **state)
{
    (void)state;
    struct layout l;
    wiggly_take *take;
    make_layout(&l, WIGGLY_COMPLEX, WIGGLY_FREE);
    assert_int_equal(wiggly_take_create(&l.desc, &take), WIGGLY_ERROR_ARGUMENT);
    static const double wrong[] = {-0.1, 1.1, NAN};
    for (int i = 0; i < 3; i++) {
        l.desc.steady = wrong[i];
        assert_int_equal(wiggly_solve(solver, &l.desc, &curve), WIGGLY_ERROR_NUMBER);
    }
}

static int create(void **state)
{
    (void)state;
    curve = curve_create(SAMPLES), other = curve_create(SAMPLES);
    return (int)wiggly_create(SAMPLES, SAMPLES + MOST_KNOTS, &solver);
}

static int destroy(void **state)
{
    (void)state;
    curve_destroy(&curve), curve_destroy(&other);
    wiggly_destroy(solver);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_the_mean_of_the_page),
        cmocka_unit_test(it_goes_through_every_knot),
        cmocka_unit_test(it_swings_out_at_its_own_frequency),
        cmocka_unit_test(an_equilibrium_that_asks_for_nothing_else_is_answered_as_ever),
        cmocka_unit_test(tracks_and_springs_are_detuned_alike),
        cmocka_unit_test(it_stays_within_limits),
        cmocka_unit_test(the_order_of_knots_does_not_matter),
        cmocka_unit_test(it_changes_no_bit_of_others),
        cmocka_unit_test(bits_do_not_depend_on_the_way),
        cmocka_unit_test(it_is_finite),
        cmocka_unit_test(it_keeps_swinging),
        cmocka_unit_test(takes_and_wrong_numbers_are_refused),
    };
    return cmocka_run_group_tests(tests, create, destroy);
}
