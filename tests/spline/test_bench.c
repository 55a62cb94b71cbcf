/// The benchmark's own check: every kind of spline against LAPACK's banded solver, and what the table's figures have to be.
#include "near.h"

#include "bench/bench.h"
#include <sys/wait.h>
#include <unistd.h>

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

static struct bench bench;

/// What is timed is right, and what LAPACK is timed on are the same systems: it could solve neither otherwise.
TEST(every_kind_agrees_with_lapack)
{
    static const struct {
        wiggly_mode mode;
        wiggly_start start;
    } kinds[] = {{WIGGLY_COMPLEX, WIGGLY_FREE},
                 {WIGGLY_REAL, WIGGLY_FREE},
                 {WIGGLY_CUBIC, WIGGLY_FREE},
                 {WIGGLY_COMPLEX, WIGGLY_LOOP}};
    bench_open(&bench);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        struct bench_result result = bench_blank(kinds[k].mode, 0);
        const wiggly_desc desc = describe(kinds[k].mode, kinds[k].start);
        bench_case(&bench, &desc, false, &result);
        assert_int_equal(result.samples, SAMPLES);
        assert_true(result.error <= 1e-6);
        assert_true(result.ns_per_sample > 0 && result.band_ns_per_sample > 0);
        assert_true(result.p50_us <= result.p99_us && 1e3 * result.p50_us >= 0.999 * result.ns_per_sample * SAMPLES);
        if (strstr(bench.blas, "not ")) continue; // it says why there is none
        assert_int_equal(result.dpbsv_ns_per_sample > 0, kinds[k].start != WIGGLY_LOOP);
    }
    lapack_unload(&bench.lapack);
}

TEST(what_cannot_be_solved_is_no_figure)
{
    static char says[4096];
    int end[2], status;
    size_t length = 0;
    assert_int_equal(pipe(end), 0);
    const pid_t child = fork();
    if (child == 0) {
        const wiggly_knot twice[] = {{.sample = 3, .value = 1}, {.sample = 3, .value = 2}};
        struct bench_result result = {.name = "twice"};
        wiggly_desc desc = describe(WIGGLY_COMPLEX, WIGGLY_FREE);
        desc.knots = twice;
        desc.knot_count = 2;
        dup2(end[1], STDERR_FILENO);
        bench_case(&bench, &desc, false, &result);
        _exit(0);
    }
    close(end[1]);
    assert_true(child > 0);
    for (ssize_t got; (got = read(end[0], says + length, sizeof says - 1 - length)) > 0;) length += (size_t)got;
    close(end[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) != 0);
    assert_non_null(strstr(says, "twice"));
}
