/// Many splines over threads: the same bits as one at a time, statuses each its own; and what happens when memory runs out.
#include "near.h"

/// Allocations that are still granted; counts down.
static long granted = -1;

static void *failing_calloc(size_t count, size_t size) { return granted-- == 0 ? NULL : calloc(count, size); }

#define calloc failing_calloc
#include "spline/batch.c"
#include "spline/solver.c"
#undef calloc

#include "curve.h"
#include "uniform.h"

enum { SPLINES = 300, SAMPLES = 130, KNOTS = 9 };

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

TEST(a_batch_is_the_same_to_the_bit)
{
    static wiggly_desc desc[SPLINES];
    static wiggly_knot knots[SPLINES][KNOTS];
    static wiggly_curve curve[SPLINES];
    static wiggly_status status[SPLINES];
    static float floats[SPLINES][SAMPLES];
    make_splines(desc, knots);
    for (int threads = 1; threads <= 3; threads++) {
        wiggly_batch *batch = NULL;
        assert_int_equal(wiggly_batch_create(SAMPLES, KNOTS, threads, &batch), WIGGLY_OK);
        for (int i = 0; i < SPLINES; i++) curve[i] = curve_create(SAMPLES);
        for (int i = 0; i < SPLINES; i += 5) curve[i].omega = curve[i].y = curve[i].re = NULL; // not asked for
        for (int i = 0; i < SPLINES; i++) curve[i].floats = floats[i];
        assert_int_equal(wiggly_batch_solve(batch, desc, curve, status, SPLINES), WIGGLY_ERROR_KNOT_TWICE);
        for (int i = 0; i < SPLINES; i++) {
            wiggly_solver *solver = NULL;
            wiggly_curve one = curve_create(SAMPLES);
            assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
            assert_int_equal(wiggly_solve(solver, &desc[i], &one), status[i]);
            assert_memory_equal(one.total, curve[i].total, SAMPLES * sizeof(double));
            assert_memory_equal(one.im, curve[i].im, SAMPLES * sizeof(double));
            if (status[i] < WIGGLY_ERROR_ARGUMENT) assert_true(floats[i][50] == (float)one.total[50]);
            curve_destroy(&one);
            wiggly_destroy(solver);
        }
        assert_int_equal(status[40], WIGGLY_ERROR_KNOT_TWICE);
        assert_int_equal(curve[40].knot, 1);
        assert_int_equal(status[77], WIGGLY_ERROR_NUMBER);
        wiggly_batch_destroy(batch);
        for (int i = 0; i < SPLINES; i++) curve_destroy(&curve[i]);
    }
}

/// Splines of one filter and start, all else different: a solver keeps what it can from one to the next.
typedef struct company {
    const char *what;
    wiggly_mode mode;
    wiggly_start start;
    wiggly_passive passive;
    double frequency, damping, calm; ///< 0: 1.5, 0.1, 1
    bool undamped;
    int count;
    int grid; ///< knots only on multiples of this; 0: anywhere
    bool pairs_only;
    bool moves; ///< equilibria that move, each another way
} company;

static const company companies[] = {
    {.what = "complex", .start = WIGGLY_FREE, .count = 37},
    {.what = "complex from rest", .start = WIGGLY_REST, .frequency = 2.5, .damping = 0.3, .count = 21},
    {.what = "few", .calm = 0.5, .count = 3},
    {.what = "real", .mode = WIGGLY_REAL, .count = 37},
    {.what = "real from rest", .mode = WIGGLY_REAL, .start = WIGGLY_REST, .damping = 2, .count = 19},
    {.what = "cubic", .mode = WIGGLY_CUBIC, .count = 37},
    {.what = "pivots that lose digits", .undamped = true, .calm = 0.001, .count = 29, .grid = 8},
    {.what = "more lengths than there is room for", .count = SAMPLES - 1, .pairs_only = true},
    {.what = "filters", .passive = WIGGLY_FILTER, .count = 37},
    {.what = "filters from rest", .passive = WIGGLY_FILTER, .start = WIGGLY_REST, .damping = 0.3, .count = 21},
    {.what = "loops", .start = WIGGLY_LOOP, .count = 21},
    {.what = "moving equilibria", .count = 21, .moves = true},
    {.what = "cubics on moving equilibria", .mode = WIGGLY_CUBIC, .count = 21, .moves = true},
};

/// Knots of spline i: from none on, in twos side by side now and then, some with slopes.
static int make_knots(const company *c, int i, uint64_t *seed, wiggly_knot *knots)
{
    if (c->pairs_only) {
        knots[0] = (wiggly_knot){.value = 1};
        knots[1] = (wiggly_knot){.sample = i + 1, .value = uniform(seed)};
        return 2;
    }
    int count = 0, room = SAMPLES / KNOTS;
    for (int k = 0; k < i % (KNOTS + 1); k++) {
        int sample = room * k + (int)(uniform(seed) * (room - 1));
        bool beside = c->grid == 0 && k > 0 && uniform(seed) < 0.2;
        if (beside) sample = knots[count - 1].sample + 1;
        if (c->grid > 0) sample -= sample % c->grid;
        if (count > 0 && sample <= knots[count - 1].sample) continue;
        knots[count] = (wiggly_knot){.sample = sample, .value = uniform(seed) - 0.5, .stiffness = 100, .slope = 2};
        knots[count].has_slope = uniform(seed) < 0.2;
        count++;
    }
    return count;
}

static void assert_same_curve(const wiggly_curve *one, const wiggly_curve *many)
{
    const size_t size = SAMPLES * sizeof(double);
    assert_memory_equal(one->total, many->total, size);
    assert_memory_equal(one->y, many->y, size);
    assert_memory_equal(one->re, many->re, size);
    assert_memory_equal(one->im, many->im, size);
    assert_memory_equal(one->omega, many->omega, size);
    assert_true(one->samples == many->samples && one->step == many->step && one->first == many->first);
    assert_true(one->mode == many->mode && one->start == many->start);
    assert_true(one->error == many->error && one->refinements == many->refinements);
}

static int check_company(const company *c, int threads)
{
    static wiggly_knot knots[SAMPLES][KNOTS];
    static double equilibria[SAMPLES][SAMPLES];
    wiggly_desc desc[SAMPLES];
    wiggly_curve curve[SAMPLES];
    wiggly_status status[SAMPLES];
    wiggly_batch *batch = NULL;
    wiggly_solver *solver = NULL;
    uint64_t seed = 5;
    int refined = 0;
    assert_int_equal(wiggly_batch_create(SAMPLES, KNOTS, threads, &batch), WIGGLY_OK);
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
    for (int i = 0; i < c->count; i++) {
        desc[i] = wiggly_default_desc();
        desc[i].samples = SAMPLES;
        desc[i].mode = c->mode, desc[i].start = c->start;
        desc[i].calm = c->calm > 0 ? c->calm : 1;
        desc[i].frequency.value = c->frequency > 0 ? c->frequency : 1.5;
        desc[i].damping.value = c->undamped ? 0 : c->damping > 0 ? c->damping : 0.1;
        desc[i].bandwidth.value = desc[i].damping.value;
        desc[i].equilibrium.value = 0.25 * i;
        desc[i].passive = c->passive;
        for (int k = 0; k < SAMPLES; k++) equilibria[i][k] = sin(0.01 * k * (1 + i));
        if (c->moves) desc[i].equilibrium.track = equilibria[i];
        desc[i].knots = knots[i];
        desc[i].knot_count = make_knots(c, i, &seed, knots[i]);
        curve[i] = curve_create(SAMPLES);
    }
    for (int round = 0; round < 2; round++) { // the second time with tables that are kept
        wiggly_batch_solve(batch, desc, curve, status, c->count);
        for (int i = 0; i < c->count; i++) {
            wiggly_curve one = curve_create(SAMPLES);
            assert_int_equal(wiggly_solve(solver, &desc[i], &one), status[i]);
            assert_same_curve(&one, &curve[i]);
            refined += one.error > 0;
            curve_destroy(&one);
        }
    }
    for (int i = 0; i < c->count; i++) curve_destroy(&curve[i]);
    wiggly_destroy(solver);
    wiggly_batch_destroy(batch);
    return refined;
}

TEST(every_kind_is_the_same_to_the_bit)
{
    for (size_t c = 0; c < sizeof companies / sizeof *companies; c++) {
        for (int threads = 1; threads <= 2; threads++) {
            print_message("%s, %d threads\n", companies[c].what, threads);
            int refined = check_company(&companies[c], threads);
            assert_true(companies[c].grid == 0 || refined > 0);
        }
    }
}

/// The same knots over another number of samples, one solver after the other: in a loop the last gap is another one, and behind a
/// real spline's last knot there is more to fill.
TEST(lengths_do_not_mix)
{
    static const wiggly_knot keys[] = {
        {.sample = 1, .value = 0.3}, {.sample = 6, .value = -1}, {.sample = 9, .value = 2}};
    static const int lengths[] = {11, SAMPLES, 40, 41, 12, SAMPLES};
    wiggly_solver *used = NULL, *fresh = NULL;
    wiggly_curve one = curve_create(SAMPLES), other = curve_create(SAMPLES);
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &used), WIGGLY_OK);
    for (int kind = 0; kind < 18; kind++) {
        for (size_t n = 0; n < sizeof lengths / sizeof *lengths; n++) {
            wiggly_desc desc = wiggly_default_desc();
            desc.samples = lengths[n];
            desc.mode = (wiggly_mode)(kind % 3), desc.start = (wiggly_start)(kind / 3 % 3);
            desc.passive = kind < 9 ? WIGGLY_OSCILLATOR : WIGGLY_FILTER;
            desc.frequency.value = 6, desc.damping.value = 0.1;
            desc.knots = keys, desc.knot_count = 3;
            assert_int_equal(wiggly_create(SAMPLES, KNOTS, &fresh), WIGGLY_OK);
            assert_int_equal(wiggly_solve(used, &desc, &one), wiggly_solve(fresh, &desc, &other));
            assert_memory_equal(one.total, other.total, (size_t)lengths[n] * sizeof *one.total);
            assert_memory_equal(one.im, other.im, (size_t)lengths[n] * sizeof *one.im);
            wiggly_destroy(fresh);
        }
    }
    wiggly_destroy(used);
    curve_destroy(&one);
    curve_destroy(&other);
}

TEST(empty_and_wrong_calls)
{
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

/// The bytes after it are left alone, and nothing else is allocated.
TEST(a_batch_fits_the_callers_memory)
{
    static wiggly_desc desc[SPLINES];
    static wiggly_knot knots[SPLINES][KNOTS];
    make_splines(desc, knots);
    wiggly_batch *batch = NULL;
    for (int threads = 1; threads <= 3; threads += 2) {
        size_t size = wiggly_batch_memsize(SAMPLES, KNOTS, threads);
        unsigned char *memory = malloc(size + 8);
        memset(memory, 0xa5, size + 8);
        granted = 0;
        assert_int_equal(wiggly_batch_create_at(memory, size - 1, SAMPLES, KNOTS, threads, &batch),
                         WIGGLY_ERROR_MEMORY);
        assert_int_equal(wiggly_batch_create_at(memory + 1, size, SAMPLES, KNOTS, threads, &batch),
                         WIGGLY_ERROR_ARGUMENT);
        assert_int_equal(wiggly_batch_create_at(memory, size, SAMPLES, KNOTS, threads, &batch), WIGGLY_OK);
        granted = -1;
        static wiggly_curve curve[SPLINES];
        static wiggly_status status[SPLINES];
        wiggly_solver *solver = NULL;
        wiggly_curve one = curve_create(SAMPLES);
        assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
        for (int i = 0; i < SPLINES; i++) curve[i] = curve_create(SAMPLES);
        wiggly_batch_solve(batch, desc, curve, status, SPLINES);
        for (int i = 0; i < SPLINES; i++) {
            assert_int_equal(wiggly_solve(solver, &desc[i], &one), status[i]);
            if (status[i] < WIGGLY_ERROR_ARGUMENT)
                assert_memory_equal(one.total, curve[i].total, (size_t)desc[i].samples * sizeof(double));
            curve_destroy(&curve[i]);
        }
        wiggly_destroy(solver);
        curve_destroy(&one);
        wiggly_batch_destroy(batch);
        for (size_t i = size; i < size + 8; i++) assert_int_equal(memory[i], 0xa5);
        free(memory);
    }
    assert_int_equal(wiggly_batch_memsize(0, 1, 1), 0);
    assert_int_equal(wiggly_batch_memsize(10, 1, 0), 0);
}

/// The k-th allocation fails, for every k until none does: a status, and (under the sanitizers) no leak.
TEST(running_out_of_memory_is_said)
{
    int failures = 0;
    for (long k = 0; k < 100; k++) {
        wiggly_batch *batch = NULL;
        granted = k;
        wiggly_status created = wiggly_batch_create(50, 4, 3, &batch);
        if (created == WIGGLY_OK) {
            wiggly_desc desc = wiggly_default_desc();
            wiggly_curve curve = {.size = sizeof curve};
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
    assert_int_equal(failures, 1);
    wiggly_solver *solver = NULL;
    granted = 0;
    assert_int_equal(wiggly_create(50, 4, &solver), WIGGLY_ERROR_MEMORY);
    granted = -1;
    assert_null(solver);
}
