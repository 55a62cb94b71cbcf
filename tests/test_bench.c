/// The benchmark's own check: every kind of spline against LAPACK's banded solver, and what the table's figures have to be.
#include "near.h"

#include "timing/bench.h"
#include <math.h>
#include <string.h>

enum { SAMPLES = 200 };

static const wiggly_knot knots[] = {
    {.sample = 0, .value = 1}, {.sample = 60, .value = -0.5}, {.sample = 150, .value = 2}};

static wiggly_desc describe(wiggly_mode mode, wiggly_start start)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES;
    desc.step = 1.0 / 30;
    desc.mode = mode;
    desc.start = start;
    desc.frequency.value = 1;
    desc.damping.value = 0.1;
    desc.bandwidth.value = 0.1;
    desc.knots = knots;
    desc.knot_count = sizeof knots / sizeof *knots;
    return desc;
}

static struct bench *open_bench(struct bench_machine *machine)
{
    struct error error = {0};
    struct bench *bench = bench_open(machine, WIGGLY_CHAIN, &error);
    if (!bench) fail_msg("%s", error.text);
    return bench;
}

/// What is timed is right, and what LAPACK is timed on are the same systems: it could solve neither otherwise.
static void every_kind_agrees_with_lapack(void **state)
{
    (void)state;
    static const struct {
        wiggly_mode mode;
        wiggly_start start;
    } kinds[] = {{WIGGLY_COMPLEX, WIGGLY_FREE},
                 {WIGGLY_REAL, WIGGLY_FREE},
                 {WIGGLY_CUBIC, WIGGLY_FREE},
                 {WIGGLY_COMPLEX, WIGGLY_LOOP}};
    struct bench_machine machine;
    struct bench *bench = open_bench(&machine);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        struct error error = {0};
        struct bench_result result;
        const wiggly_desc desc = describe(kinds[k].mode, kinds[k].start);
        if (!bench_spline(bench, "one", &desc, &result, &error)) fail_msg("%s", error.text);
        assert_string_equal(result.name, "one");
        assert_int_equal(result.samples, SAMPLES);
        assert_true(result.error <= 1e-6);
        assert_true(result.ns_per_sample > 0 && result.band_ns_per_sample > 0);
        assert_true(result.p50_us <= result.p99_us && 1e3 * result.p50_us >= 0.999 * result.ns_per_sample * SAMPLES);
        if (strstr(machine.blas, "not ")) continue; // it says why there is none
        assert_true(result.dpbsv_ns_per_sample > 0);
        const bool hermitian = kinds[k].mode == WIGGLY_COMPLEX && kinds[k].start != WIGGLY_LOOP;
        assert_int_equal(result.zpbsv_ns_per_sample > 0, hermitian);
    }
    bench_close(bench);
}

static void what_cannot_be_solved_is_no_figure(void **state)
{
    (void)state;
    struct bench_machine machine;
    struct bench *bench = open_bench(&machine);
    struct error error = {0};
    struct bench_result result;
    wiggly_desc desc = describe(WIGGLY_COMPLEX, WIGGLY_FREE);
    const wiggly_knot twice[] = {{.sample = 3, .value = 1}, {.sample = 3, .value = 2}};
    desc.knots = twice;
    desc.knot_count = 2;
    assert_false(bench_spline(bench, "twice", &desc, &result, &error));
    assert_non_null(strstr(error.text, "twice"));
    bench_close(bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_agrees_with_lapack),
        cmocka_unit_test(what_cannot_be_solved_is_no_figure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
