// Many splines over threads: the same bits as one at a time, statuses each its own; and what happens when memory runs out.
#include "near.h"

#include <stdlib.h>
#include <string.h>

/// Allocations that are still granted; counts down.
static long granted = -1;

static void *failing_calloc(size_t count, size_t size) { return granted-- == 0 ? NULL : calloc(count, size); }

#define calloc failing_calloc
#include "spline/batch.c"
#include "spline/solver.c"
#undef calloc

#include "curve.h"

enum { SPLINES = 300, SAMPLES = 130, KNOTS = 9 };

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/// Splines of every mode and start, some with the same parameters as the one before, some wrong.
static void make_splines(wiggly_desc *desc, wiggly_knot (*knots)[KNOTS])
{
    uint64_t seed = 11;
    for (int i = 0; i < SPLINES; i++) {
        desc[i] = wiggly_default_desc();
        desc[i].samples = i % 10 == 9 ? 60 : SAMPLES;
        desc[i].mode = (wiggly_mode)(i % 3);
        desc[i].start = (wiggly_start)(i / 3 % 3);
        desc[i].frequency.value = i % 7 < 5 ? 1.5 : 3 * uniform(&seed);
        desc[i].damping.value = i % 7 < 5 ? 0.1 : uniform(&seed);
        desc[i].knots = knots[i];
        desc[i].knot_count = i % KNOTS;
        for (int k = 0; k < desc[i].knot_count; k++) {
            int room = desc[i].samples / KNOTS;
            knots[i][k] = (wiggly_knot){.sample = room * k + (int)(uniform(&seed) * room), .value = uniform(&seed)};
            knots[i][k].has_slope = uniform(&seed) < 0.2;
            knots[i][k].stiffness = 100;
        }
    }
    knots[40][1].sample = knots[40][0].sample; // two knots on one sample
    desc[77].calm = 7;
}

static void a_batch_is_the_same_to_the_bit(void **state)
{
    (void)state;
    static wiggly_desc desc[SPLINES];
    static wiggly_knot knots[SPLINES][KNOTS];
    static wiggly_curve curve[SPLINES];
    static wiggly_status status[SPLINES];
    make_splines(desc, knots);
    for (int threads = 1; threads <= 3; threads++) {
        wiggly_batch *batch = NULL;
        assert_int_equal(wiggly_batch_create(SAMPLES, KNOTS, threads, &batch), WIGGLY_OK);
        for (int i = 0; i < SPLINES; i++) curve[i] = curve_create(SAMPLES);
        for (int i = 0; i < SPLINES; i += 5) curve[i].omega = curve[i].y = curve[i].re = NULL; // not asked for
        assert_int_equal(wiggly_batch_solve(batch, desc, curve, status, SPLINES), WIGGLY_ERROR_KNOT);
        for (int i = 0; i < SPLINES; i++) {
            wiggly_solver *solver = NULL;
            wiggly_curve one = curve_create(SAMPLES);
            assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
            assert_int_equal(wiggly_solve(solver, &desc[i], &one), status[i]);
            assert_memory_equal(one.total, curve[i].total, SAMPLES * sizeof(double));
            assert_memory_equal(one.im, curve[i].im, SAMPLES * sizeof(double));
            curve_destroy(&one);
            wiggly_destroy(solver);
        }
        assert_int_equal(status[40], WIGGLY_ERROR_KNOT);
        assert_int_equal(status[77], WIGGLY_ERROR_NUMBER);
        wiggly_batch_destroy(batch);
        for (int i = 0; i < SPLINES; i++) curve_destroy(&curve[i]);
    }
}

static void empty_and_wrong_calls(void **state)
{
    (void)state;
    wiggly_batch *batch = NULL;
    assert_int_equal(wiggly_batch_create(0, 1, 1, &batch), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_batch_create(10, 1, 0, &batch), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_batch_create(10, 1, 2, NULL), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_batch_create(10, 1, 2, &batch), WIGGLY_OK);
    assert_int_equal(wiggly_batch_solve(batch, NULL, NULL, NULL, 0), WIGGLY_OK);
    assert_int_equal(wiggly_batch_solve(batch, NULL, NULL, NULL, 3), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_batch_solve(NULL, NULL, NULL, NULL, 0), WIGGLY_ERROR_ARGUMENT);
    wiggly_batch_destroy(batch);
    wiggly_batch_destroy(NULL);
    wiggly_destroy(NULL);
}

/// The k-th allocation fails, for every k until none does: a status, and (under the sanitizers) no leak.
static void running_out_of_memory_is_said(void **state)
{
    (void)state;
    int failures = 0;
    for (long k = 0; k < 100; k++) {
        wiggly_batch *batch = NULL;
        granted = k;
        wiggly_status created = wiggly_batch_create(50, 4, 3, &batch);
        if (created == WIGGLY_OK) {
            wiggly_desc desc = wiggly_default_desc();
            wiggly_curve curve = {0};
            desc.samples = 50;
            granted = 0; // solving allocates nothing
            assert_int_equal(wiggly_batch_solve(batch, &desc, &curve, NULL, 1), WIGGLY_OK);
            assert_int_equal(granted, 0);
            wiggly_batch_destroy(batch);
            break;
        }
        assert_int_equal(created, WIGGLY_ERROR_MEMORY);
        assert_null(batch);
        failures++;
    }
    granted = -1;
    assert_int_equal(failures, 4); // the batch, and a solver for each thread
    wiggly_solver *solver = NULL;
    granted = 0;
    assert_int_equal(wiggly_create(50, 4, &solver), WIGGLY_ERROR_MEMORY);
    granted = -1;
    assert_null(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_batch_is_the_same_to_the_bit),
        cmocka_unit_test(empty_and_wrong_calls),
        cmocka_unit_test(running_out_of_memory_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
