/// A take (a long spline that is edited knot by knot and looked at through a window) against wiggly_solve(), and an edited one
/// against a fresh one, to the bit.
#include "near.h"

#include "curve.h"
#include <stdlib.h>
#include <string.h>

enum { MAX_SAMPLES = 40000, MAX_KNOTS = 2000 };

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static int below(uint64_t *seed, int count) { return (int)(uniform(seed) * count); }

struct example {
    wiggly_desc desc;
    wiggly_knot knots[MAX_KNOTS];
};

/// Knots about `gap` apart, now and then side by side, some with slopes.
static void make_example(struct example *e, uint64_t *seed, int samples, int gap)
{
    memset(e, 0, sizeof *e);
    e->desc = wiggly_default_desc();
    e->desc.samples = samples;
    e->desc.mode = (wiggly_mode)below(seed, 3);
    e->desc.start = below(seed, 3) ? WIGGLY_FREE : WIGGLY_REST;
    e->desc.frequency.value = 2 + 2 * uniform(seed);
    e->desc.damping.value = 0.3 * uniform(seed);
    e->desc.bandwidth.value = 0.2 * uniform(seed);
    e->desc.equilibrium.value = below(seed, 2) ? 0 : 0.7;
    e->desc.knots = e->knots;
    for (int i = 2 + below(seed, 20); i < samples - 2 && e->desc.knot_count < MAX_KNOTS;) {
        wiggly_knot *knot = &e->knots[e->desc.knot_count++];
        *knot = (wiggly_knot){.sample = i, .value = 2 * uniform(seed) - 1, .slope = uniform(seed), .stiffness = 100};
        bool close = below(seed, 8) == 0;
        knot->has_slope = !close && below(seed, 5) == 0 && (knot == e->knots || knot[-1].sample < i - 1);
        i += close ? 1 : 2 + below(seed, 2 * gap);
    }
}

static void compare_with_solve(wiggly_take *take, const struct example *e, uint64_t *seed)
{
    wiggly_solver *solver = NULL;
    wiggly_curve curve = curve_create(e->desc.samples);
    assert_int_equal(wiggly_create(e->desc.samples, e->desc.knot_count, &solver), WIGGLY_OK);
    assert_int_equal(wiggly_solve(solver, &e->desc, &curve), WIGGLY_OK);
    static double total[MAX_SAMPLES], im[MAX_SAMPLES], low[100], high[100];
    for (int n = 0; n < 6; n++) {
        int count = n == 0 ? e->desc.samples : 1 + below(seed, e->desc.samples < 3000 ? e->desc.samples : 3000);
        int from = below(seed, e->desc.samples - count + 1), columns = 1 + below(seed, count < 100 ? count : 100);
        assert_int_equal(wiggly_take_read(take, from, count, total, im), WIGGLY_OK);
        for (int i = 0; i < count; i++) {
            assert_near(total[i], curve.total[from + i], 1e-9);
            assert_near(im[i], curve.im[from + i], 1e-9);
        }
        assert_int_equal(wiggly_take_range(take, from, count, columns, low, high), WIGGLY_OK);
        for (int i = 0; i < count; i++) {
            int column = (int)((long long)i * columns / count);
            assert_true(low[column] <= total[i] + 1e-15 && high[column] >= total[i] - 1e-15);
        }
    }
    for (int k = 0; k < e->desc.knot_count; k++) {
        double value;
        assert_int_equal(wiggly_take_read(take, e->knots[k].sample, 1, &value, NULL), WIGGLY_OK);
        assert_true(value == e->knots[k].value);
    }
    curve_destroy(&curve);
    wiggly_destroy(solver);
}

static void compare_with_fresh(wiggly_take *take, const struct example *e)
{
    wiggly_take *fresh = NULL;
    assert_int_equal(wiggly_take_create(&e->desc, &fresh), WIGGLY_OK);
    static double edited[2][MAX_SAMPLES], made[2][MAX_SAMPLES];
    wiggly_take_read(take, 0, e->desc.samples, edited[0], edited[1]);
    wiggly_take_read(fresh, 0, e->desc.samples, made[0], made[1]);
    assert_memory_equal(edited[0], made[0], sizeof(double) * (size_t)e->desc.samples);
    assert_memory_equal(edited[1], made[1], sizeof(double) * (size_t)e->desc.samples);
    wiggly_take_destroy(fresh);
}

/// Moves a knot somewhere between its neighbours, or changes its slope.
static void edit_knot(wiggly_take *take, struct example *e, uint64_t *seed)
{
    int k = below(seed, e->desc.knot_count);
    wiggly_knot knot = e->knots[k];
    int low = k > 0 ? e->knots[k - 1].sample + 1 : 2;
    int high = k + 1 < e->desc.knot_count ? e->knots[k + 1].sample - 1 : e->desc.samples - 3;
    knot.value += 0.1;
    if (below(seed, 2)) knot.sample = low + below(seed, high - low + 1);
    if (below(seed, 4) == 0) knot.has_slope = !knot.has_slope;
    wiggly_status status = wiggly_take_set_knot(take, k, knot);
    if (status == WIGGLY_OK) {
        e->knots[k] = knot;
    } else { // a slope beside another knot is not for a take
        assert_int_equal(status, WIGGLY_ERROR_ARGUMENT);
    }
}

static void takes_agree_with_solve_and_with_fresh_ones(void **state)
{
    (void)state;
    static const int sizes[][2] = {{200, 12}, {800, 100}, {3000, 7}, {9000, 24}, {40000, 50}};
    uint64_t seed = 3;
    for (int n = 0; n < 60; n++) {
        struct example e;
        const int *size = sizes[n % 5];
        make_example(&e, &seed, size[0], size[1]);
        wiggly_take *take = NULL;
        assert_int_equal(wiggly_take_create(&e.desc, &take), WIGGLY_OK);
        compare_with_solve(take, &e, &seed);
        for (int edits = 0; edits < 40; edits++) edit_knot(take, &e, &seed);
        compare_with_fresh(take, &e);
        compare_with_solve(take, &e, &seed);
        wiggly_take_destroy(take);
    }
}

/// Keys that come one by one, from two on: after each the take is the same as a fresh one, and reads as one.
static void keys_are_appended_one_by_one(void **state)
{
    (void)state;
    static struct example e;
    static double total[4000], im[4000], fresh_total[4000], fresh_im[4000];
    for (uint64_t seed = 1; seed <= 12; seed++) {
        uint64_t random = seed;
        make_example(&e, &random, 4000, 4);
        int all = e.desc.knot_count, start = 2;
        while (start < 10 && e.knots[start].sample == e.knots[start - 1].sample + 1) start++;
        size_t size = wiggly_take_memsize(e.desc.samples, all);
        void *memory = malloc(size);
        wiggly_take *take = NULL;
        wiggly_desc desc = e.desc;
        desc.knot_count = start;
        assert_int_equal(wiggly_take_create_at(memory, size, &desc, &take), WIGGLY_OK);
        for (int k = start; k < all; k++) {
            assert_int_equal(wiggly_take_append(take, e.knots[k]), WIGGLY_OK);
            desc.knot_count = k + 1;
            if (k > 70 && k % 97 != 0 && k + 1 < all) continue;
            wiggly_take *fresh = NULL;
            assert_int_equal(wiggly_take_create(&desc, &fresh), WIGGLY_OK);
            wiggly_status said = wiggly_take_read(fresh, 0, 4000, fresh_total, fresh_im);
            assert_int_equal(wiggly_take_read(take, 0, 4000, total, im), said);
            assert_memory_equal(total, fresh_total, sizeof total);
            assert_memory_equal(im, fresh_im, sizeof im);
            wiggly_take_destroy(fresh);
        }
        assert_int_equal(wiggly_take_append(take, (wiggly_knot){.sample = 3999}), WIGGLY_ERROR_CAPACITY);
        free(memory);
    }
}

static void what_is_no_take_is_refused(void **state)
{
    (void)state;
    struct example e;
    uint64_t seed = 5;
    double track[800] = {0}, out[800];
    wiggly_take *take = NULL;
    make_example(&e, &seed, 800, 40);
    wiggly_desc desc = e.desc;
    desc.start = WIGGLY_LOOP;
    assert_int_equal(wiggly_take_create(&desc, &take), WIGGLY_ERROR_ARGUMENT);
    desc = e.desc;
    desc.mode = WIGGLY_COMPLEX;
    desc.frequency.track = track;
    assert_int_equal(wiggly_take_create(&desc, &take), WIGGLY_ERROR_ARGUMENT);
    desc = e.desc;
    desc.knot_count = 0;
    assert_int_equal(wiggly_take_create(&desc, &take), WIGGLY_ERROR_ARGUMENT);
    desc = e.desc;
    desc.calm = 2;
    assert_int_equal(wiggly_take_create(&desc, &take), WIGGLY_ERROR_NUMBER);
    assert_null(take);
    assert_int_equal(wiggly_take_create(&e.desc, &take), WIGGLY_OK);
    wiggly_knot knot = e.knots[3];
    knot.sample = e.knots[4].sample;
    assert_int_equal(wiggly_take_set_knot(take, 3, knot), WIGGLY_ERROR_KNOT);
    knot = e.knots[3];
    knot.value = NAN;
    assert_int_equal(wiggly_take_set_knot(take, 3, knot), WIGGLY_ERROR_NUMBER);
    assert_int_equal(wiggly_take_set_knot(take, e.desc.knot_count, e.knots[0]), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_take_read(take, 790, 11, out, NULL), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_take_read(take, -1, 1, out, NULL), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_take_range(take, 0, 10, 11, out, out), WIGGLY_ERROR_ARGUMENT);
    compare_with_fresh(take, &e);
    wiggly_take_destroy(take);
    wiggly_take_destroy(NULL);
}

/// As good as one of its own memory; the bytes after it are left alone.
static void a_take_fits_the_callers_memory(void **state)
{
    (void)state;
    static const int sizes[][2] = {{200, 12}, {3000, 7}, {9000, 24}};
    uint64_t seed = 9;
    for (int n = 0; n < 9; n++) {
        struct example e;
        make_example(&e, &seed, sizes[n % 3][0], sizes[n % 3][1]);
        size_t size = wiggly_take_memsize(e.desc.samples, e.desc.knot_count);
        unsigned char *memory = malloc(size + 8);
        memset(memory, 0xa5, size + 8);
        wiggly_take *take = NULL;
        assert_int_equal(wiggly_take_create_at(memory, size - 1, &e.desc, &take), WIGGLY_ERROR_MEMORY);
        assert_int_equal(wiggly_take_create_at(memory + 1, size, &e.desc, &take), WIGGLY_ERROR_ARGUMENT);
        assert_int_equal(wiggly_take_create_at(memory, size, &e.desc, &take), WIGGLY_OK);
        for (int edits = 0; edits < 40; edits++) edit_knot(take, &e, &seed);
        compare_with_fresh(take, &e);
        compare_with_solve(take, &e, &seed);
        wiggly_take_destroy(take);
        for (size_t i = size; i < size + 8; i++) assert_int_equal(memory[i], 0xa5);
        free(memory);
    }
    assert_int_equal(wiggly_take_memsize(0, 1), 0);
    assert_int_equal(wiggly_take_memsize(10, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(takes_agree_with_solve_and_with_fresh_ones),
        cmocka_unit_test(keys_are_appended_one_by_one),
        cmocka_unit_test(what_is_no_take_is_refused),
        cmocka_unit_test(a_take_fits_the_callers_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
