/// Shared by the benchmark's files: memory, times, and the table on stdout and as JSON.
#include "bench/bench.h"
#include "base/error.h"
#include "base/progress.h"
#include "maths/maths.h"
#include "timing/framelog.h"
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

void bench_stop(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("wiggly-bench: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(ERROR_ENVIRONMENT);
}

void bench_open(struct bench *bench)
{
    *bench = (struct bench){0};
    lapack_load(&bench->lapack, bench->blas, sizeof bench->blas);
}

struct bench_result bench_blank(wiggly_mode mode, int samples)
{
    static const char *const names[] = {"complex", "real", "cubic"};
    return (struct bench_result){.mode = names[mode],
                                 .samples = samples,
                                 .splines = 1,
                                 .threads = 1,
                                 .band_ns_per_sample = NAN,
                                 .dpbsv_ns_per_sample = NAN,
                                 .error = NAN,
                                 .peak_mb = NAN};
}

bool bench_goes_on(int runs, double end) { return runs < MAX_RUNS && (runs < MIN_RUNS || clock_now() < end); }

void bench_sum_up(struct bench *bench, int runs, double samples, struct bench_result *result)
{
    qsort(bench->times, (size_t)runs, sizeof *bench->times, maths_compare);
    result->ns_per_sample = 1e9 * bench->times[0] / samples;
    result->p50_us = 1e6 * statistics_quantile(bench->times, runs, 0.5);
    result->p99_us = 1e6 * statistics_quantile(bench->times, runs, 0.99);
}

/// "12.3", or `missing` for NAN.
static const char *number(char text[32], const char *format, double value, const char *missing)
{
    snprintf(text, 32, isnan(value) ? missing : format, value);
    return text;
}

static void print_json(FILE *json, const struct bench_result *r)
{
    const struct {
        const char *name;
        double value;
    } figures[] = {
        {"ns_per_sample", r->ns_per_sample},
        {"p50_us", r->p50_us},
        {"p99_us", r->p99_us},
        {"band_ns_per_sample", r->band_ns_per_sample},
        {"lapack_dpbsv_ns_per_sample", r->dpbsv_ns_per_sample},
        {"error", r->error},
        {"peak_mb", r->peak_mb},
    };
    char text[32];
    fprintf(json, "    {\"name\": \"%s\", \"mode\": \"%s\", \"samples\": %d, \"splines\": %d, \"threads\": %d",
            r->name, r->mode, r->samples, r->splines, r->threads);
    for (size_t f = 0; f < sizeof figures / sizeof *figures; f++)
        fprintf(json, ", \"%s\": %s", figures[f].name, number(text, "%.4g", figures[f].value, "null"));
    fprintf(json, "}");
}

void bench_report(struct bench *bench, const struct bench_result *r)
{
    char band[32], dpbsv[32], times[32], error[32];
    const bool first = bench->lines++ == 0;
    if (first) {
        printf("ns/sample and band ns: wiggly_solve(), all included, and the same by the band; dpbsv ns: LAPACKE's "
               "factor and solve alone,\n"
               "without poles, assembly, output and any bound\n");
        printf("%-26s %7s %9s %10s %10s %9s %9s %8s %8s\n", "case", "threads", "ns/sample", "p50 us", "p99 us",
               "band ns", "dpbsv ns", "dpbsv x", "error");
    }
    printf(
        "%-26s %7d %9.2f %10.2f %10.2f %9s %9s %8s %8s", r->name, r->threads, r->ns_per_sample, r->p50_us, r->p99_us,
        number(band, "%.4g", r->band_ns_per_sample, "-"), number(dpbsv, "%.4g", r->dpbsv_ns_per_sample, "-"),
        number(times, "%.4g", r->dpbsv_ns_per_sample / r->ns_per_sample, "-"), number(error, "%.1e", r->error, "-"));
    if (!isnan(r->peak_mb)) printf("  in %.0f MB at most", r->peak_mb);
    printf("\n");
    fflush(stdout);
    if (!bench->json) return;
    if (!first) fprintf(bench->json, ",\n");
    print_json(bench->json, r);
}
