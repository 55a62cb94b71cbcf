/// A host that traps on floating-point exceptions, rounds another way or drops tiny numbers: no trap, the same bits, and its own state back.
#include "near.h"

#include "curve.h"
#include <fenv.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

enum { SAMPLES = 90, ARRAYS = 5 };

/// What the library fills, of every kind of spline.
typedef struct results {
    double rows[2 * 27 * 8][ARRAYS * SAMPLES];
    wiggly_explanation best[2];
    wiggly_poles poles;
} results;

/// Undamped poles, ones as good as infinite and as fast as the samples, a wind-up, limits, tracks.
static void solve_all(results *to)
{
    static const double frequency[] = {0, 1.5, 1e-6, 200, 1.5, 8, 1e4, 1.5},
                        damping[] = {0, 0, 0.1, 1, 50, 0.1, 1e6, 0.3};
    const wiggly_knot knots[] = {{.sample = 0, .value = 1e-160},
                                 {.sample = 24, .value = 1, .has_slope = true, .slope = 2},
                                 {.sample = 40, .settles = true, .value = -0.4},
                                 {.sample = 70, .value = 0.2, .has_phase = true}};
    double wave[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) wave[i] = 0.3 * sin(0.05 * i);
    wiggly_solver *solver;
    wiggly_batch *batch;
    wiggly_group *group;
    assert_int_equal(wiggly_create(SAMPLES, 4 + SAMPLES, &solver), WIGGLY_OK);
    assert_int_equal(wiggly_batch_create(SAMPLES, 4 + SAMPLES, 2, &batch), WIGGLY_OK);
    assert_int_equal(wiggly_group_create(SAMPLES, 4, 1, 1, &group), WIGGLY_OK);
    for (int n = 0; n < 2 * 27 * 8; n++) {
        wiggly_desc desc = {
            .size = sizeof desc, .knots = knots, .knot_count = 4, .samples = SAMPLES, .has_calm = true};
        desc.mode = (wiggly_mode)(n % 3), desc.start = (wiggly_start)(n / 3 % 3);
        desc.passive = (wiggly_passive)(n % 2), desc.calm = n % 4 ? 1 : 0;
        desc.frequency.value = frequency[n / 54], desc.damping.value = damping[n / 54], desc.bandwidth.value = 0.1;
        if (n / 9 % 3 == 1) desc.wind_up = 0.5, desc.equilibrium.track = wave;
        if (n / 9 % 3 == 2) desc.has_high = true, desc.high = 1;
        wiggly_curve curve = curve_in(to->rows[n], SAMPLES);
        wiggly_value rate;
        const double times[] = {1.3, NAN, INFINITY, -1};
        wiggly_evaluate_at(&(wiggly_curve){.size = sizeof curve}, 1.3, &rate);
        assert_true(wiggly_solve(solver, &desc, &curve) < WIGGLY_ERROR_ARGUMENT);
        for (int t = 0; t < 4; t++) wiggly_evaluate_at(&curve, times[t], &rate);
        if (n % 8 == 0) assert_true(wiggly_batch_solve(batch, &desc, &curve, NULL, 1) < WIGGLY_ERROR_ARGUMENT);
        if (n == 54) {
            const wiggly_pull pull = {.c = {{1}}};
            wiggly_pin pin = {.sample = 50, .pulls = &pull, .pull_count = 1, .to = {0.3}};
            assert_true(wiggly_group_solve(group, &desc, &(double){1}, &curve, 1, &pin, 1) < WIGGLY_ERROR_ARGUMENT);
            wiggly_explain(&desc, to->best);
            to->poles = wiggly_poles_at(&desc, 3);
        }
    }
    wiggly_group_destroy(group);
    wiggly_batch_destroy(batch);
    wiggly_destroy(solver);
}

static results expected, found;

TEST(traps_of_a_host_are_not_hit)
{
#ifdef FE_NOMASK_ENV
    const int traps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
    solve_all(&expected);
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(traps);
    solve_all(&found);
    assert_int_equal(fegetexcept(), traps);
    fedisableexcept(traps);
    assert_memory_equal(&found, &expected, sizeof found);
#else
    skip();
#endif
}

TEST(rounding_and_tiny_numbers_of_a_host_change_no_bit)
{
    const wiggly_knot knots[] = {{.sample = 0, .value = 3e-310}, {.sample = 30, .value = 1}};
    const wiggly_desc desc = {.size = sizeof desc,
                              .knots = knots,
                              .knot_count = 2,
                              .samples = SAMPLES,
                              .frequency.value = 1.3,
                              .damping.value = 0.1};
    double row[2][ARRAYS * SAMPLES];
    wiggly_curve curve = curve_in(row[0], SAMPLES);
    curve_solve(&curve, &desc);
    fesetround(FE_UPWARD);
#ifdef __SSE2__
    _mm_setcsr(_mm_getcsr() | 0x8040); // flushes to zero, and takes denormals as zeroes
#endif
    curve = curve_in(row[1], SAMPLES);
    curve_solve(&curve, &desc);
    const int rounding = fegetround();
    fesetenv(FE_DFL_ENV);
    assert_int_equal(rounding, FE_UPWARD);
    assert_memory_equal(row[1], row[0], sizeof *row);
}
