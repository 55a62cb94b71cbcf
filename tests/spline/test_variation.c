/// Variations: other motions of the same material through the same knots.
#include "near.h"

#include <wiggly/more.h>

enum { MOST = 2000, SEEDS = 400 };

static const wiggly_knot keys[] = {{.sample = 10, .value = 0},
                                   {.sample = 40, .value = 1},
                                   {.sample = 70, .value = -0.5, .has_slope = true, .slope = 2, .stiffness = 1000},
                                   {.sample = 110, .value = 0.2}};
enum { KEYS = sizeof keys / sizeof *keys };

struct solved {
    double total[MOST], re[MOST], im[MOST], y[MOST], omega[MOST];
    wiggly_curve curve;
};

static wiggly_desc varied(int seed, double amount)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = 241, desc.frequency.value = 1.3, desc.damping.value = 0.1;
    desc.knots = keys, desc.knot_count = KEYS;
    desc.variation = amount, desc.variation_seed = seed;
    return desc;
}

static wiggly_curve rows_of(struct solved *s)
{
    return (wiggly_curve){
        .size = sizeof(wiggly_curve), .total = s->total, .re = s->re, .im = s->im, .y = s->y, .omega = s->omega};
}

static struct solved *solve(struct solved *s, const wiggly_desc *desc, wiggly_method method)
{
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(desc->samples, 64 + desc->samples, &solver), WIGGLY_OK);
    wiggly_set_method(solver, method);
    s->curve = rows_of(s);
    assert_int_equal(wiggly_solve(solver, desc, &s->curve), WIGGLY_OK);
    wiggly_destroy(solver);
    return s;
}

static double apart(const double *a, const double *b, int from, int to)
{
    double most = 0;
    for (int i = from; i < to; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

TEST(it_is_another_motion)
{
    static const wiggly_start starts[] = {WIGGLY_FREE, WIGGLY_REST, WIGGLY_LOOP};
    for (int mode = WIGGLY_COMPLEX; mode <= WIGGLY_REAL; mode++) {
        for (int s = 0; s < 3; s++) {
            struct solved plain, one, other, band;
            wiggly_desc desc = varied(7, 0.3);
            desc.mode = (wiggly_mode)mode, desc.start = starts[s];
            solve(&one, &desc, WIGGLY_CHAIN), solve(&band, &desc, WIGGLY_BAND);
            desc.variation_seed = 8;
            solve(&other, &desc, WIGGLY_CHAIN);
            desc.variation = 0;
            solve(&plain, &desc, WIGGLY_CHAIN);
            assert_true(apart(one.total, band.total, 0, 241) < 1e-8);
            assert_true(apart(one.im, band.im, 0, 241) < 1e-8);
            assert_true(apart(one.total, plain.total, 10, 110) > 0.02);
            assert_true(apart(one.total, plain.total, 0, 241) < 1.5);
            assert_true(apart(one.total, other.total, 10, 110) > 0.02);
            assert_near((one.total[71] - one.total[69]) * 12, 2, 0.15);
        }
    }
}

TEST(the_seam_of_a_loop_bends_as_the_rest)
{
    struct solved s;
    wiggly_desc desc = varied(3, 0.5);
    desc.start = WIGGLY_LOOP;
    solve(&s, &desc, WIGGLY_CHAIN);
    double bend = 0, seam = 0;
    for (int i = 1; i < 240; i++) {
        const double here = fabs(s.total[i + 1] - 2 * s.total[i] + s.total[i - 1]);
        if (i < 60 || i > 80) bend = fmax(bend, here);
    }
    seam = fabs(s.total[1] - 2 * s.total[0] + s.total[239]);
    assert_true(seam < 1.5 * bend);
}

TEST(it_settles_after_the_last_knot)
{
    struct solved s;
    for (int seed = 0; seed < 20; seed++) {
        wiggly_desc desc = varied(seed, 1);
        desc.samples = 400;
        solve(&s, &desc, WIGGLY_CHAIN);
        double late = 0;
        for (int i = 360; i < 400; i++) late = fmax(late, fabs(s.total[i]));
        assert_true(late < 0.01); // ten seconds on, e^−8.5 of the swing
        const double before = s.total[110] - s.total[109], after = s.total[111] - s.total[110];
        assert_true(fabs(after - before) < 0.35); // no kink where the noise ends
    }
}

/// Without knots it is the noise itself: of the spread that was asked for, whatever the rate.
TEST(the_noise_is_as_wide_as_asked)
{
    static struct solved s, fine;
    double sum = 0, worst = 0;
    long count = 0;
    for (int seed = 0; seed < SEEDS; seed++) {
        wiggly_desc desc = varied(seed, 0.5);
        desc.knot_count = 0;
        solve(&s, &desc, WIGGLY_CHAIN);
        for (int i = 0; i < 241; i += 8, count++) sum += s.total[i] * s.total[i];
        if (seed > 20) continue;
        desc.samples = 961, desc.step /= 4;
        solve(&fine, &desc, WIGGLY_CHAIN);
        double off = 0;
        for (int i = 0; i < 241; i++) off = fmax(off, fabs(fine.total[4 * i] - s.total[i]));
        worst = fmax(worst, off);
    }
    print_message("spread %.3f, asked for 0.5; at four times the rate %.3f apart\n", sqrt(sum / (double)count),
                  worst);
    assert_true(worst < 0.2);
    assert_near(sqrt(sum / (double)count), 0.5, 0.05);
}

/// With calm 1 the plain spline is the mean of all variations.
TEST(their_mean_is_the_spline)
{
    static struct solved s, plain;
    static double mean[241];
    wiggly_desc desc = varied(0, 0);
    memset(mean, 0, sizeof mean);
    solve(&plain, &desc, WIGGLY_CHAIN);
    for (int seed = 0; seed < SEEDS; seed++) {
        desc = varied(seed, 1);
        solve(&s, &desc, WIGGLY_CHAIN);
        for (int i = 0; i < 241; i++) mean[i] += s.total[i] / SEEDS;
    }
    assert_true(apart(mean, plain.total, 0, 241) < 0.2);
}
