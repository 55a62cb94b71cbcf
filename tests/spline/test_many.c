/// Splines of one kind on strided arrays: the same bits as one at a time, whatever the strides; errors with their knots.
#include "near.h"

#include "curve.h"
#include "uniform.h"

enum { COUNT = 150, SAMPLES = 90, KNOTS = 6, PAD = 3, OUT = 4 };

/// What a spline's knots are in, one number for each.
enum part { AT, VALUE, SLOPE, STIFFNESS, PHASE, STILL, PARTS };

static double part[PARTS][COUNT * KNOTS * PAD];
static double row[OUT][COUNT * SAMPLES * PAD];
static wiggly_status status[COUNT];
static int knot[COUNT];

/// How numbers lie: strides of knots and of samples.
static const struct layout {
    const char *what;
    ptrdiff_t knot_by_spline, knot_by_number, by_spline, by_number;
} layouts[] = {
    {"rows", KNOTS, 1, SAMPLES, 1},
    {"columns", 1, COUNT, 1, COUNT},
    {"apart", KNOTS *PAD, PAD, SAMPLES *PAD, PAD},
};

static const struct kind {
    const char *what;
    wiggly_mode mode;
    wiggly_start start;
    wiggly_passive passive;
    bool limited, moves, varies;
} kinds[] = {
    {.what = "complex"},
    {.what = "real from rest", .mode = WIGGLY_REAL, .start = WIGGLY_REST},
    {.what = "cubic", .mode = WIGGLY_CUBIC},
    {.what = "loops", .start = WIGGLY_LOOP},
    {.what = "filters", .passive = WIGGLY_FILTER},
    {.what = "limits", .limited = true},
    {.what = "moving equilibria", .moves = true},
    {.what = "limited cubics on them", .mode = WIGGLY_CUBIC, .moves = true, .limited = true},
    {.what = "variations", .varies = true},
};

static wiggly_desc describe(const struct kind *kind)
{
    static double wave[SAMPLES];
    wiggly_desc desc = {.size = sizeof desc, .samples = SAMPLES, .mode = kind->mode, .start = kind->start};
    for (int i = 0; i < SAMPLES; i++) wave[i] = 0.2 * sin(0.1 * i);
    desc.passive = kind->passive;
    desc.frequency.value = 1.3;
    desc.damping.value = desc.bandwidth.value = 0.1;
    if (kind->moves) desc.equilibrium.track = wave;
    if (kind->varies) desc.variation = 0.3;
    desc.has_low = desc.has_high = kind->limited;
    desc.low = -1.1, desc.high = 1.2;
    return desc;
}

/// Up to six knots, in any order, of every sort; some splines are wrong.
static int make_knots(int i, uint64_t *seed, wiggly_knot *knots, bool *left_out)
{
    int count = 0;
    for (int k = 0; k < KNOTS; k++) {
        const int sample = 13 * ((k + i) % KNOTS) + 1 + (int)(11 * uniform(seed));
        left_out[k] = i % 4 == 3 && k % 3 == 1;
        wiggly_knot at = {.sample = sample, .value = uniform(seed) * 2 - 1, .still = uniform(seed) < 0.1};
        at.has_slope = !at.still && uniform(seed) < 0.2, at.slope = at.has_slope ? uniform(seed) : NAN;
        at.has_phase = !at.still && uniform(seed) < 0.3, at.phase = at.has_phase ? uniform(seed) : NAN;
        at.stiffness = k % 2 ? 50 : 0;
        if (!left_out[k]) knots[count++] = at;
        if (i % 40 == 39 && k == 3) knots[count - 1].value = NAN, knots[count - 1].still = false;
        if (i % 40 == 19 && k == 5) knots[count - 1].sample = knots[count - 2].sample;
    }
    return count;
}

static void put_knots(const struct layout *l, int i, const wiggly_knot *knots, const bool *left_out)
{
    for (int k = 0, n = 0; k < KNOTS; k++) {
        const ptrdiff_t at = i * l->knot_by_spline + k * l->knot_by_number;
        const wiggly_knot *one = left_out[k] ? &(wiggly_knot){0} : &knots[n++];
        part[AT][at] = left_out[k] ? NAN : one->sample + 0.3; // rounded
        part[VALUE][at] = one->value, part[SLOPE][at] = one->slope, part[STIFFNESS][at] = one->stiffness;
        part[PHASE][at] = one->phase, part[STILL][at] = one->still;
    }
}

static wiggly_many gather(const struct layout *l)
{
    wiggly_many many = {.size = sizeof many, .count = COUNT, .knot_count = KNOTS, .status = status, .knot = knot};
    wiggly_numbers *const in[PARTS] = {&many.sample,    &many.value, &many.slope,
                                       &many.stiffness, &many.phase, &many.still};
    wiggly_rows *const out[OUT] = {&many.total, &many.y, &many.re, &many.im};
    for (int p = 0; p < PARTS; p++) *in[p] = (wiggly_numbers){part[p], l->knot_by_spline, l->knot_by_number};
    for (int p = 0; p < OUT; p++) *out[p] = (wiggly_rows){row[p], l->by_spline, l->by_number};
    return many;
}

/// Where a knot of those that are there is among all.
static int counted(const bool *left_out, int at)
{
    for (int k = 0; k < KNOTS; k++) {
        if (!left_out[k] && at-- == 0) return k;
    }
    return -1;
}

static void check(const struct kind *kind, const struct layout *l, wiggly_batch *batch, wiggly_solver *solver)
{
    static wiggly_knot knots[COUNT][KNOTS];
    static bool left_out[COUNT][KNOTS];
    int count[COUNT], wrong = 0;
    uint64_t seed = 3;
    wiggly_desc desc = describe(kind);
    for (int i = 0; i < COUNT; i++) {
        count[i] = make_knots(i, &seed, knots[i], left_out[i]);
        put_knots(l, i, knots[i], left_out[i]);
    }
    for (int p = 0; p < OUT; p++) memset(row[p], 0x5A, sizeof row[p]);
    const wiggly_many many = gather(l);
    wiggly_batch_solve_many(batch, &desc, &many);
    for (int i = 0; i < COUNT; i++) {
        wiggly_curve one = curve_create(SAMPLES);
        const double *const own[OUT] = {one.total, one.y, one.re, one.im};
        memset(one.total, 0x5A, 5 * SAMPLES * sizeof(double));
        desc.knots = knots[i], desc.knot_count = count[i];
        const wiggly_status expected = wiggly_solve(solver, &desc, &one);
        if (status[i] != expected)
            fail_msg("%s, %s: %d said %d, not %d", kind->what, l->what, i, status[i], expected);
        assert_int_equal(knot[i], counted(left_out[i], one.knot < 0 ? KNOTS : one.knot));
        wrong += expected >= WIGGLY_ERROR_ARGUMENT;
        for (int p = 0; p < OUT; p++) {
            for (int k = 0; k < SAMPLES; k++)
                assert_memory_equal(&row[p][i * l->by_spline + k * l->by_number], &own[p][k], sizeof(double));
        }
        curve_destroy(&one);
    }
    assert_in_range(wrong, 3, COUNT / 2);
}

TEST(many_splines_are_the_same_to_the_bit)
{
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(SAMPLES, KNOTS + SAMPLES, &solver), WIGGLY_OK);
    for (int threads = 1; threads <= 2; threads++) {
        wiggly_batch *batch;
        assert_int_equal(wiggly_batch_create(SAMPLES, KNOTS + SAMPLES, threads, &batch), WIGGLY_OK);
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            for (size_t l = 0; l < sizeof layouts / sizeof *layouts; l++)
                check(&kinds[k], &layouts[l], batch, solver);
        }
        wiggly_batch_destroy(batch);
    }
    wiggly_destroy(solver);
}

/// A stride of 0 gives all splines the same knots; what is not asked for is not filled.
TEST(knots_may_be_shared)
{
    static const double at[] = {3, 40, 70}, value[] = {0, 1, -1};
    const wiggly_desc desc = {.size = sizeof desc, .samples = SAMPLES, .frequency.value = 1};
    const wiggly_many many = {.size = sizeof many,
                              .count = 2,
                              .knot_count = 3,
                              .sample = {at, 0, 1},
                              .value = {value, 0, 1},
                              .total = {row[0], SAMPLES, 1}};
    wiggly_batch *batch;
    assert_int_equal(wiggly_batch_create(SAMPLES, 3, 1, &batch), WIGGLY_OK);
    assert_int_equal(wiggly_batch_solve_many(batch, &desc, &many), WIGGLY_OK);
    assert_memory_equal(row[0], row[0] + SAMPLES, SAMPLES * sizeof(double));
    assert_true(row[0][40] == 1 && row[0][SAMPLES + 70] == -1);
    wiggly_batch_destroy(batch);
}

TEST(wrong_arrays_are_named)
{
    const wiggly_desc good = {.size = sizeof good, .samples = SAMPLES}, unsized = {.samples = SAMPLES};
    const wiggly_numbers in = {part[AT], 0, 1};
    const struct {
        const wiggly_desc *desc;
        wiggly_many many;
        wiggly_status expected;
    } cases[] = {
        {&good, {.size = sizeof(wiggly_many)}, WIGGLY_OK},
        {&good, {.size = 0}, WIGGLY_ERROR_SIZE},
        {&unsized, {.size = sizeof(wiggly_many)}, WIGGLY_ERROR_SIZE},
        {NULL, {.size = sizeof(wiggly_many)}, WIGGLY_ERROR_ARGUMENT},
        {&good, {.size = sizeof(wiggly_many), .count = -1}, WIGGLY_ERROR_ARGUMENT},
        {&good, {.size = sizeof(wiggly_many), .count = 1, .knot_count = 1, .sample = in}, WIGGLY_ERROR_ARGUMENT},
        {&good,
         {.size = sizeof(wiggly_many), .count = 1, .knot_count = 9, .sample = in, .value = in},
         WIGGLY_ERROR_CAPACITY},
    };
    wiggly_batch *batch;
    for (int k = 0; k < 9; k++) part[AT][k] = k;
    assert_int_equal(wiggly_batch_create(SAMPLES, KNOTS, 1, &batch), WIGGLY_OK);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const wiggly_status said = wiggly_batch_solve_many(batch, cases[c].desc, &cases[c].many);
        if (said != cases[c].expected) fail_msg("case %zu: %s", c, wiggly_status_text(said));
    }
    assert_int_equal(wiggly_batch_solve_many(NULL, &good, &cases[0].many), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_batch_solve_many(batch, &good, NULL), WIGGLY_ERROR_ARGUMENT);
    wiggly_batch_destroy(batch);
}
