/// Motion with a direction: what an edit leaves alone, to the bit, and knots where the motion settles. Variations: other motions of the same
/// material through the same knots. And the frequency that explains knots: known oscillations are found again.
#include "near.h"

#include "uniform.h"
#include <wiggly/more.h>

enum { SAMPLES = 400, LONG = 20001 };

struct solved {
    double total[SAMPLES], im[SAMPLES];
};

static wiggly_solver *solver;

static int set_up(__attribute__((unused)) void **state) { return (int)wiggly_create(LONG, LONG, &solver); }

static int tear_down(__attribute__((unused)) void **state)
{
    wiggly_destroy(solver);
    return 0;
}

static void solve_by(wiggly_solver *by, const wiggly_desc *desc, struct solved *s)
{
    wiggly_curve curve = {.size = sizeof curve, .total = s->total, .im = s->im};
    memset(s, 0, sizeof *s);
    assert_int_equal(wiggly_solve(by, desc, &curve), WIGGLY_OK);
}

static void solve(const wiggly_desc *desc, struct solved *s) { solve_by(solver, desc, s); }

static double apart(const double *a, const double *b, int from, int to)
{
    double most = 0;
    for (int i = from; i < to; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

// --- wind-up ---------------------------------------------------------------------------------------------------------

enum { KNOTS = 6, ROUNDS = 200, WOUND = 241 };

struct layout {
    wiggly_desc desc;
    wiggly_knot knots[KNOTS];
    double track[WOUND];
};

/// Random knots; some are poses, some still, some have slopes.
static void make(struct layout *l, uint64_t seed)
{
    for (int i = 0; i < 8; i++) uniform(&seed);
    l->desc = wiggly_default_desc();
    l->desc.samples = WOUND, l->desc.knots = l->knots, l->desc.knot_count = KNOTS;
    l->desc.frequency.value = 0.3 + 3 * uniform(&seed);
    l->desc.damping.value = 0.3 * uniform(&seed);
    l->desc.wind_up = 0.2 + uniform(&seed);
    if (uniform(&seed) < 0.3) l->desc.frequency.track = l->track;
    for (int i = 0; i < WOUND; i++) l->track[i] = 1 + 0.5 * sin(i * 0.05);
    for (int k = 0; k < KNOTS; k++) {
        const double what = uniform(&seed);
        l->knots[k] = (wiggly_knot){.sample = 8 + 38 * k + (int)(20 * uniform(&seed)),
                                    .value = 2 * uniform(&seed) - 1,
                                    .phase = uniform(&seed) - 0.5,
                                    .slope = 4 * uniform(&seed) - 2,
                                    .has_phase = what<0.25, .has_slope = what> 0.8};
        if (what > 0.4 && what < 0.5) l->knots[k] = (wiggly_knot){.sample = l->knots[k].sample, .still = true};
    }
    l->knots[0].has_slope = false; // how much it says depends on the knot after it
}

/// An edit of a knot changes nothing up to the knot before it, and behind the next pose or still knot nothing; what the solver keeps
/// makes no difference.
TEST(an_edit_changes_nothing_before_its_gap)
{
    static struct layout l;
    static struct solved before, after, fresh;
    int cuts = 0;
    for (int round = 0; round < ROUNDS; round++) {
        const int k = 1 + round % (KNOTS - 1);
        int first = WOUND, last = -1, cut = WOUND;
        wiggly_solver *other;
        make(&l, (uint64_t)round);
        for (int n = KNOTS - 1; n > k; n--) cut = l.knots[n].has_phase || l.knots[n].still ? l.knots[n].sample : cut;
        const int sample = l.knots[k].sample;
        solve(&l.desc, &before);
        if (l.knots[k].still) l.knots[k] = (wiggly_knot){.sample = sample};
        l.knots[k].value += 0.5;
        l.knots[k].sample += round % 2;
        solve(&l.desc, &after);
        assert_int_equal(wiggly_create(WOUND, KNOTS, &other), WIGGLY_OK);
        solve_by(other, &l.desc, &fresh);
        wiggly_destroy(other);
        assert_memory_equal(&after, &fresh, sizeof after);
        for (int i = 0; i < WOUND; i++) {
            if (before.total[i] == after.total[i] && before.im[i] == after.im[i]) continue;
            if (i < first) first = i;
            last = i;
        }
        if (first <= l.knots[k - 1].sample || last < sample || last >= cut)
            fail_msg("round %d: knot %d at %d changes %d to %d, the next pose is at %d", round, k, sample, first,
                     last, cut);
        cuts += cut < WOUND;
    }
    assert_true(cuts > ROUNDS / 4);
}

/// It settles where the last settling knot is, after it has overshot.
TEST(the_motion_stays_where_it_settles)
{
    static const wiggly_knot knots[] = {{.sample = 0}, {.sample = 36, .value = 60, .settles = true}};
    static struct solved s;
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = WOUND, desc.knots = knots, desc.knot_count = 2;
    desc.frequency.value = 1.5, desc.damping.value = 0.15, desc.wind_up = 0.5;
    solve(&desc, &s);
    double most = 0;
    for (int i = 0; i < WOUND; i++) most = fmax(most, s.total[i]);
    assert_true(most > 66 && most < 120);
    assert_near(s.total[WOUND - 1], 60, 0.5);
    assert_near(s.total[20], 0, 1e-9); // the wind-up has not begun
}

/// Long gaps keep their digits: undamped, and where the frequency is 0, next to a solve with half the samples.
TEST(long_gaps_keep_their_digits)
{
    static double total[2][LONG];
    for (int n = 0; n < 4; n++) {
        const int by = 1 + n % 2;
        const wiggly_knot knots[] = {{.sample = 0, .value = 0.4},
                                     {.sample = 2000 * by, .value = 1, .has_phase = true},
                                     {.sample = 9000 * by, .value = -0.5, .has_phase = true}};
        wiggly_curve curve = {.size = sizeof curve, .total = total[n % 2]};
        wiggly_desc desc = wiggly_default_desc();
        desc.samples = 10000 * by + 1, desc.step = 1e-3 / by;
        desc.frequency.value = n / 2, desc.wind_up = 100;
        desc.knots = knots, desc.knot_count = 3;
        assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
        assert_true(curve.error < 1e-10);
        for (int i = 0; by == 2 && i <= 10000; i += 100) assert_near(total[0][i], total[1][2 * i], 1e-5);
    }
}

// --- variations ------------------------------------------------------------------------------------------------------

enum { VARIED = 241, SEEDS = 400 };

static wiggly_desc varied(int seed, double amount)
{
    static const wiggly_knot keys[] = {
        {.sample = 10, .value = 0},
        {.sample = 40, .value = 1},
        {.sample = 70, .value = -0.5, .has_slope = true, .slope = 2, .stiffness = 1000},
        {.sample = 110, .value = 0.2}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = VARIED, desc.knots = keys, desc.knot_count = 4;
    desc.frequency.value = 1.3, desc.damping.value = 0.1;
    desc.variation = amount, desc.variation_seed = seed;
    return desc;
}

TEST(a_variation_is_another_motion)
{
    for (int n = 0; n < 6; n++) {
        static struct solved plain, one, other, band;
        wiggly_desc desc = varied(7, 0.3);
        desc.mode = (wiggly_mode)(n / 3), desc.start = (wiggly_start)(n % 3);
        solve(&desc, &one);
        wiggly_set_method(solver, WIGGLY_BAND);
        solve(&desc, &band);
        wiggly_set_method(solver, WIGGLY_CHAIN);
        desc.variation_seed = 8;
        solve(&desc, &other);
        desc.variation = 0;
        solve(&desc, &plain);
        assert_true(apart(one.total, band.total, 0, VARIED) < 1e-8 && apart(one.im, band.im, 0, VARIED) < 1e-8);
        assert_true(apart(one.total, plain.total, 10, 110) > 0.02);
        assert_true(apart(one.total, plain.total, 0, VARIED) < 1.5);
        assert_true(apart(one.total, other.total, 10, 110) > 0.02);
        assert_near((one.total[71] - one.total[69]) * 12, 2, 0.15);
    }
}

/// A scene looks as it did: Re x and Im x of some sample, in every mode and start.
TEST(a_variation_is_the_same_for_ever)
{
    static const double expected[6][2] = {{-0.256170755153, 0.044103110188},
                                          {-0.270387053604, 0.077533251740},
                                          {-0.241271760332, 0.051044856802},
                                          {0.147819858296, 0},
                                          {0.147916637111, 0},
                                          {0.147642737358, 0}};
    for (int n = 0; n < 6; n++) {
        static struct solved s;
        wiggly_desc desc = varied(7, 0.3);
        desc.mode = (wiggly_mode)(n / 3), desc.start = (wiggly_start)(n % 3);
        solve(&desc, &s);
        if (fabs(s.total[90] - expected[n][0]) > 1e-9 || fabs(s.im[90] - expected[n][1]) > 1e-9)
            fail_msg("mode %d, start %d: {%.12f, %.12f}", n / 3, n % 3, s.total[90], s.im[90]);
    }
}

TEST(the_seam_of_a_varied_loop_bends_as_the_rest)
{
    static struct solved s;
    wiggly_desc desc = varied(3, 0.5);
    desc.start = WIGGLY_LOOP;
    solve(&desc, &s);
    double bend = 0;
    for (int i = 1; i < VARIED - 1; i++) {
        if (i < 60 || i > 80) bend = fmax(bend, fabs(s.total[i + 1] - 2 * s.total[i] + s.total[i - 1]));
    }
    assert_true(fabs(s.total[1] - 2 * s.total[0] + s.total[VARIED - 2]) < 1.5 * bend);
}

TEST(a_variation_settles_after_the_last_knot)
{
    static struct solved s;
    for (int seed = 0; seed < 20; seed++) {
        wiggly_desc desc = varied(seed, 1);
        desc.samples = SAMPLES;
        solve(&desc, &s);
        for (int i = 360; i < SAMPLES; i++) assert_near(s.total[i], 0, 0.01); // ten seconds on, e^−8.5 of the swing
        assert_near(s.total[111] - s.total[110], s.total[110] - s.total[109], 0.35); // no kink where the noise ends
    }
}

/// Without knots it is the noise itself: of the spread that was asked for, whatever the rate.
TEST(the_noise_is_as_wide_as_asked)
{
    static struct solved s;
    static double fine[4 * VARIED];
    double sum = 0, worst = 0;
    long count = 0;
    for (int seed = 0; seed < SEEDS; seed++) {
        wiggly_desc desc = varied(seed, 0.5);
        desc.knot_count = 0;
        solve(&desc, &s);
        for (int i = 0; i < VARIED; i += 8, count++) sum += s.total[i] * s.total[i];
        if (seed > 20) continue;
        wiggly_curve curve = {.size = sizeof curve, .total = fine};
        desc.samples = 961, desc.step /= 4;
        assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
        for (int i = 0; i < VARIED; i++) worst = fmax(worst, fabs(fine[4 * i] - s.total[i]));
    }
    assert_true(worst < 0.2);
    assert_near(sqrt(sum / (double)count), 0.5, 0.05);
}

/// With calm 1 the plain spline is the mean of all variations.
TEST(the_mean_of_variations_is_the_spline)
{
    static struct solved s, plain;
    double mean[VARIED] = {0};
    wiggly_desc desc = varied(0, 0);
    solve(&desc, &plain);
    for (int seed = 0; seed < SEEDS; seed++) {
        desc = varied(seed, 1);
        solve(&desc, &s);
        for (int i = 0; i < VARIED; i++) mean[i] += s.total[i] / SEEDS;
    }
    assert_true(apart(mean, plain.total, 0, VARIED) < 0.2);
}

// --- the frequency that explains knots -------------------------------------------------------------------------------

enum { PLANTED = 200, MOST = 8 };

/// Knots within a frame of the extrema of a damped oscillation, 24 frames a second.
static double plant(int seed, wiggly_mode mode, wiggly_knot knots[MOST], wiggly_desc *desc)
{
    static const double tau = 6.283185307179586;
    uint64_t state = (uint64_t)seed * 2654435761u + 99;
    for (int i = 0; i < 8; i++) uniform(&state);
    const double f = 0.5 + 1.5 * uniform(&state), damping = 0.15 * uniform(&state),
                 root = sqrt(1 - damping * damping);
    *desc = wiggly_default_desc();
    desc->samples = 400, desc->mode = mode, desc->knots = knots;
    desc->knot_count = 5 + (int)(4 * uniform(&state));
    for (int i = 0; i < desc->knot_count; i++) {
        int frame = (int)lround(5 + i * 12 / (f * root)) + (int)(3 * uniform(&state)) - 1;
        if (i > 0 && frame <= knots[i - 1].sample) frame = knots[i - 1].sample + 1;
        const double t = (frame - 5) / 24.0;
        knots[i] = (wiggly_knot){.sample = frame, .value = exp(-damping * tau * f * t) * cos(tau * f * root * t)};
    }
    return f;
}

TEST(known_oscillations_are_found_again)
{
    for (int mode = WIGGLY_COMPLEX; mode <= WIGGLY_REAL; mode++) {
        int good = 0;
        double off = 0;
        for (int seed = 0; seed < PLANTED; seed++) {
            wiggly_knot knots[MOST];
            wiggly_desc desc;
            const double f = plant(seed, (wiggly_mode)mode, knots, &desc);
            wiggly_explanation best[2];
            const int count = wiggly_explain(&desc, best);
            assert_true(count >= 1 && (count < 2 || best[0].cost <= best[1].cost));
            good += fabs(best[0].frequency / f - 1) < 0.05;
            off += log(best[0].frequency / f) + best[0].damping + best[0].cost;
        }
        // The search is the same everywhere: write another number here if another one is meant.
        if (fabs(off - (mode == WIGGLY_REAL ? -2244.611910 : -2908.472063)) > 1e-5)
            fail_msg("mode %d: the sum of what is found is %.6f", mode, off);
        if (good < 0.9 * PLANTED) fail_msg("mode %d: %d of %d within 5 %%", mode, good, PLANTED);
    }
}

/// Neither the order of knots, nor their scale, nor the rate, nor when they begin, nor what they swing about.
TEST(only_the_shape_counts)
{
    static const double scales[] = {1, 1e200, 1e298, 1e-200};
    wiggly_knot knots[MOST], other[MOST];
    wiggly_desc desc;
    wiggly_explanation best[2], again[2];
    plant(3, WIGGLY_COMPLEX, knots, &desc);
    wiggly_explain(&desc, best);
    desc.knots = other, desc.samples *= 4, desc.step /= 2;
    for (int size = 0; size < 4; size++) {
        for (int i = 0; i < desc.knot_count; i++) {
            other[i] = knots[desc.knot_count - 1 - i];
            other[i].value = scales[size] * (20 + 7 * other[i].value);
            other[i].sample = 4 * other[i].sample + 800;
        }
        desc.equilibrium.value = scales[size] * 20;
        assert_true(wiggly_explain(&desc, again) >= 1);
        assert_near(again[0].frequency, best[0].frequency / 2, 1e-9);
        assert_near(again[0].damping, best[0].damping, 1e-9);
    }
}

TEST(what_cannot_be_told_is_not)
{
    static wiggly_knot many[2000];
    wiggly_knot knots[MOST];
    wiggly_desc desc;
    wiggly_explanation best[2];
    plant(3, WIGGLY_COMPLEX, knots, &desc);
    desc.knot_count = WIGGLY_FEWEST_EXPLAINED - 1;
    assert_int_equal(wiggly_explain(&desc, best), 0);
    desc.knot_count = 5;
    for (int i = 0; i < 5; i++) knots[i].value = 0;
    assert_int_equal(wiggly_explain(&desc, best), 0);
    for (int i = 0; i < 2000; i++) many[i] = (wiggly_knot){.sample = 6 * i, .value = i % 2 ? 1 : -1};
    desc.samples = 12000, desc.knots = many, desc.knot_count = 2000;
    assert_true(wiggly_explain(&desc, best) >= 1);
    assert_near(best[0].frequency, 2, 0.02);
}

/// What wiggly_solve() would refuse: nothing is read outside the equilibrium's track, nor where there are no knots.
TEST(what_is_not_valid_has_no_frequency)
{
    for (int i = 0; i < 8; i++) {
        wiggly_knot knots[MOST];
        wiggly_desc desc;
        wiggly_explanation best[2];
        plant(3, WIGGLY_COMPLEX, knots, &desc);
        double *track = calloc((size_t)desc.samples, sizeof *track);
        desc.equilibrium.track = track;
        assert_true(wiggly_explain(&desc, best) >= 1);
        if (i == 0) knots[2].sample = 1000000;
        if (i == 1) knots[2].sample = -1;
        if (i == 2) desc.knots = NULL;
        if (i == 3) knots[2].value = NAN;
        if (i == 4) track[7] = INFINITY;
        if (i == 5) knots[2].sample = knots[1].sample;
        if (i == 6) desc.step = -1;
        if (i == 7) desc.knot_count = -1;
        if (wiggly_explain(&desc, best) != 0) fail_msg("case %d", i);
        free(track);
    }
}

TESTS_BETWEEN(set_up, tear_down)
