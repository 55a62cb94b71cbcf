/// The band of long domains, and of short ones beside the chain: what one plain solve leaves, or the refinement of the squared matrix, against the factored rows
/// themselves; and an estimate of the error that is no smaller than it.
#include "near.h"

#include "curve.h"
#include "spline/solver.h"

enum { SAMPLES = 2000 };

typedef struct pair {
    wiggly_solver *solver;
    wiggly_curve usual, rows;
} pair;

static int create(void **state)
{
    pair *p = calloc(1, sizeof *p);
    if (!p || wiggly_create(SAMPLES, SAMPLES, &p->solver) != WIGGLY_OK) return -1;
    p->usual = curve_create(SAMPLES);
    p->rows = curve_create(SAMPLES);
    *state = p;
    return 0;
}

static int destroy(void **state)
{
    pair *p = *state;
    curve_destroy(&p->usual);
    curve_destroy(&p->rows);
    wiggly_destroy(p->solver);
    free(p);
    return 0;
}

/// Solves both ways: as ever, and with no matrix squared.
static void compare(pair *p, const wiggly_desc *desc)
{
    int usual = p->solver->longest_squared;
    wiggly_set_method(p->solver, WIGGLY_BAND);
    wiggly_status said = wiggly_solve(p->solver, desc, &p->usual);
    p->solver->longest_squared = 2;
    const wiggly_status of_rows = wiggly_solve(p->solver, desc, &p->rows);
    assert_true(of_rows == WIGGLY_OK || (said == WIGGLY_INEXACT && p->rows.error < 1e-6));
    p->solver->longest_squared = usual;
    double size = 0, worst = 0;
    for (int i = 0; i < desc->samples; i++) {
        size = fmax(size, fabs(p->rows.total[i]));
        worst = fmax(worst, fabs(p->usual.total[i] - p->rows.total[i]));
        worst = fmax(worst, fabs(p->usual.im[i] - p->rows.im[i]));
    }
    double error = worst / size;
    if (said == WIGGLY_OK && !(error <= 1e-8))
        fail_msg("said OK, and is off by %g (estimate %g)", error, p->usual.error);
    if (!(error <= 10 * fmax(p->usual.error, 1e-12))) fail_msg("off by %g, estimate %g", error, p->usual.error);
}

/// Two poles near each other and undamped: in the frame that turns with them a gap bends as a cubic's, though it swings, and no pivot shows it.
TEST(undamped_bands_over_long_gaps)
{
    static const wiggly_knot
        nodes[] = {{.sample = 16, .value = -0.41},
                   {.sample = 116, .value = 1.13},
                   {.sample = 216, .value = -1.23},
                   {.sample = 316, .value = -0.3, .has_slope = true, .slope = -1.4, .stiffness = 76}},
        poses[] = {{.sample = 0, .has_phase = true}, {.sample = 1200, .value = 1, .has_phase = true, .phase = 0.3}};
    static double pace[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) pace[i] = 1.2 + 0.3 * sin(0.002 * i);
    for (int kind = 0; kind < 8; kind++) {
        wiggly_desc desc = wiggly_default_desc();
        desc.samples = kind % 2 ? 1241 : 317;
        desc.step = 1.0 / 60;
        desc.knots = kind % 2 ? poses : nodes, desc.knot_count = kind % 2 ? 2 : 4;
        desc.frequency.value = 1.2;
        if (kind / 2 % 2) desc.frequency.track = pace;
        desc.damping.value = kind / 4 * 1e-3;
        desc.bandwidth.value = kind % 2 ? 0.02 : 0;
        desc.calm = kind % 2 ? 1 : 0.13;
        compare(*state, &desc);
    }
}

/// A frequency that rises from 0, and knots hundreds of samples apart: the worst that a knot-free stretch can be.
TEST(a_track_from_0_over_long_gaps)
{
    static double rising[SAMPLES];
    const wiggly_knot knots[] = {{.sample = 0, .value = 0.5, .has_slope = true, .stiffness = 1000},
                                 {.sample = 200, .value = 1},
                                 {.sample = 600, .value = 0}};
    for (int i = 0; i < 961; i++) rising[i] = 5.0 * i / 960;
    for (int mode = WIGGLY_COMPLEX; mode <= WIGGLY_REAL; mode++) {
        for (int passive = WIGGLY_OSCILLATOR; passive <= WIGGLY_FILTER; passive++) {
            wiggly_desc desc = wiggly_default_desc();
            desc.samples = 961;
            desc.mode = (wiggly_mode)mode;
            desc.passive = (wiggly_passive)passive;
            desc.frequency.track = rising;
            desc.damping.value = 0.1;
            desc.knots = knots;
            desc.knot_count = 3;
            compare(*state, &desc);
        }
    }
}

/// A frequency that rests at 0 between its waves, and one knot: what the squared matrix cannot settle is left to the rows, and a start
/// that nothing determines is calmed.
TEST(a_track_that_rests_at_0)
{
    static double waves[SAMPLES];
    static const struct {
        wiggly_mode mode;
        wiggly_passive passive;
        double calm;
        wiggly_status status;
    } cases[] = {{WIGGLY_REAL, WIGGLY_OSCILLATOR, 1e-11, WIGGLY_OK},
                 {WIGGLY_COMPLEX, WIGGLY_FILTER, 0, WIGGLY_CALMED}};
    const wiggly_knot knot = {.sample = 10, .value = 1};
    pair *p = *state;
    for (int i = 0; i < SAMPLES; i++) waves[i] = fmax(0, sin(0.01 * i));
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        wiggly_desc desc = wiggly_default_desc();
        desc.samples = 1500;
        desc.step = 1.0 / 30;
        desc.mode = cases[c].mode;
        desc.passive = cases[c].passive;
        desc.calm = cases[c].calm;
        desc.frequency.track = waves;
        desc.damping.value = 0.8;
        desc.knots = &knot;
        desc.knot_count = 1;
        assert_int_equal(wiggly_solve(p->solver, &desc, &p->usual), cases[c].status);
    }
}

TEST(gaps_of_every_length)
{
    static wiggly_knot knots[SAMPLES];
    for (int gap = 2; gap <= 800; gap *= 2) {
        for (int kind = 0; kind < 18; kind++) {
            wiggly_desc desc = wiggly_default_desc();
            desc.samples = SAMPLES;
            desc.mode = (wiggly_mode)(kind % 3);
            desc.start = (wiggly_start)(kind / 3 % 3);
            desc.frequency.value = kind < 9 ? 0.1 : 2;
            desc.damping.value = 0.1;
            desc.knots = knots;
            for (int i = 5; i < SAMPLES - 1; i += gap)
                knots[desc.knot_count++] = (wiggly_knot){.sample = i, .value = sin(0.7 * i)};
            compare(*state, &desc);
        }
    }
}

/// One to two periods in all, where the imaginary rows pull on the chain's nodes, against the factored rows: with slopes, knots side by
/// side, pairs at the end, samples that run free.
TEST(the_chain_of_one_or_two_periods)
{
    pair *p = *state;
    for (int kind = 0; kind < 240; kind++) {
        wiggly_knot knots[60];
        wiggly_desc desc = wiggly_default_desc();
        desc.samples = 100 + 3 * kind;
        desc.start = (wiggly_start)(kind % 3);
        desc.passive = (wiggly_passive)(kind / 3 % 2);
        desc.damping.value = kind % 11 < 5 ? 0 : 0.02 * (kind % 11);
        desc.bandwidth.value = kind % 7 < 3 ? 0 : 0.05 * (kind % 7);
        desc.calm = 0.05 + 0.1 * (kind % 9);
        desc.knots = knots;
        const int gap = desc.samples / (2 + kind % 20);
        for (int i = 0; i < desc.samples - 3; i += gap) {
            const bool slope = kind % 5 == 0 && desc.knot_count % 3 == 1;
            knots[desc.knot_count++] = (wiggly_knot){
                .sample = i, .value = sin(0.7 * i), .has_slope = slope, .slope = 3, .stiffness = 1 + kind};
            if (kind % 4 == 0)
                knots[desc.knot_count++] = (wiggly_knot){.sample = i + 1, .value = sin(0.7 * i) + 0.01 * (kind % 3)};
        }
        knots[desc.knot_count++] =
            (wiggly_knot){.sample = desc.samples - 1 - (desc.start == WIGGLY_LOOP), .value = 1};
        desc.frequency.value = (1.0 + (kind % 10) / 11.0) / ((desc.samples - 1) * desc.step);
        p->solver->chain.im_weight = 0;
        wiggly_set_method(p->solver, WIGGLY_CHAIN);
        assert_int_equal(wiggly_solve(p->solver, &desc, &p->usual), WIGGLY_OK);
        if (kind % 4 > 0 && desc.start != WIGGLY_LOOP) assert_true(p->solver->chain.im_weight > 0);
        const int usual = p->solver->longest_squared;
        wiggly_set_method(p->solver, WIGGLY_BAND);
        p->solver->longest_squared = 2;
        assert_int_equal(wiggly_solve(p->solver, &desc, &p->rows), WIGGLY_OK);
        p->solver->longest_squared = usual;
        double size = 0;
        for (int i = 0; i < desc.samples; i++) size = fmax(size, fabs(p->rows.total[i]));
        for (int i = 0; i < desc.samples; i++) {
            assert_near(p->usual.total[i], p->rows.total[i], 1e-9 * size);
            assert_near(p->usual.im[i], p->rows.im[i], 1e-9 * size);
        }
    }
}

TESTS_BETWEEN(create, destroy)
