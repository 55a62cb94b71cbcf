/// `wiggly bench`: the solver against LAPACKE, on the same systems in the same run.
#include "timing/bench.h"
#include "base/build.h"
#include "base/file.h"
#include "commands/bench_scenes.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "scene/evaluate.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/// The table as it grows, on stdout and as JSON in memory.
struct report {
    FILE *json;
    int lines;
};

/// "12.3", or "null" / "-" if not measured.
static const char *number(char *text, size_t size, double value, const char *missing)
{
    if (isnan(value)) {
        snprintf(text, size, "%s", missing);
    } else {
        snprintf(text, size, "%.4g", value);
    }
    return text;
}

static void print_json(FILE *json, const struct bench_result *r)
{
    char band[32], d[32], z[32], peak[32];
    fprintf(
        json,
        "    {\"name\": \"%s\", \"mode\": \"%s\", \"samples\": %d, \"splines\": %d, \"threads\": %d, \"lanes\": %d, "
        "\"ns_per_sample\": %.4g, \"p50_us\": %.4g, \"p99_us\": %.4g, \"band_ns_per_sample\": %s, "
        "\"lapack_dpbsv_ns_per_sample\": %s, \"lapack_zpbsv_ns_per_sample\": %s, \"error\": %.3g",
        r->name, r->mode, r->samples, r->splines, r->threads, r->lanes, r->ns_per_sample, r->p50_us, r->p99_us,
        number(band, sizeof band, r->band_ns_per_sample, "null"), number(d, sizeof d, r->dpbsv_ns_per_sample, "null"),
        number(z, sizeof z, r->zpbsv_ns_per_sample, "null"), r->error);
    if (!isnan(r->peak_mb)) fprintf(json, ", \"peak_mb\": %s", number(peak, sizeof peak, r->peak_mb, ""));
    fprintf(json, "}");
}

static void print_line(void *user, const struct bench_result *r)
{
    struct report *report = user;
    char band[32], d[32], z[32], times[32];
    if (report->lines++ == 0) {
        printf("%-26s %7s %5s %9s %10s %10s %9s %9s %9s %8s %8s\n", "case", "threads", "lanes", "ns/sample", "p50 us",
               "p99 us", "band ns", "dpbsv ns", "zpbsv ns", "dpbsv x", "error");
    } else {
        fprintf(report->json, ",\n");
    }
    printf("%-26s %7d %5d %9.2f %10.2f %10.2f %9s %9s %9s %8s %8.1e", r->name, r->threads, r->lanes, r->ns_per_sample,
           r->p50_us, r->p99_us, number(band, sizeof band, r->band_ns_per_sample, "-"),
           number(d, sizeof d, r->dpbsv_ns_per_sample, "-"), number(z, sizeof z, r->zpbsv_ns_per_sample, "-"),
           number(times, sizeof times, r->dpbsv_ns_per_sample / r->ns_per_sample, "-"), r->error);
    if (!isnan(r->peak_mb)) printf("  in %.0f MB at most", r->peak_mb);
    printf("\n");
    fflush(stdout);
    print_json(report->json, r);
}

/// All cases: the large one first, while nothing else has asked for memory, the scenes last.
static bool run_all(struct bench *bench, bool large, struct report *report, struct error *error)
{
    struct bench_result result;
    if (large) {
        if (!bench_large(bench, &result, error)) return false;
        print_line(report, &result);
    }
    if (!bench_run(bench, print_line, report, error) || !bench_scenes(bench, &result, error)) return false;
    if (result.splines > 0) print_line(report, &result);
    return true;
}

static bool write_json(const char *path, wiggly_method method, const struct bench_machine *machine, const char *date,
                       const char *cases, struct error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *json = open_memstream(&text, &size);
    if (!json) return fail(error, ERROR_ENVIRONMENT, "out of memory");
    fprintf(json,
            "{\n  \"machine\": \"%s\",\n  \"compiler\": \"%s\",\n  \"flags\": \"%s\",\n  \"commit\": \"%s\",\n"
            "  \"date\": \"%s\",\n  \"lapack\": \"%s\",\n  \"solver\": \"%s\",\n  \"cases\": [\n%s\n  ]\n}\n",
            machine->cpu, build_compiler, build_flags, build_commit, date, machine->blas, evaluation_solver(method),
            cases);
    fclose(json);
    bool good = file_write_atomic(path, text, size, error);
    free(text);
    return good;
}

static bool run(const char *path, bool large, wiggly_method method, struct error *error)
{
    char *cases = NULL, date[32];
    size_t size = 0;
    struct report report = {.json = open_memstream(&cases, &size)};
    if (!report.json) return fail(error, ERROR_ENVIRONMENT, "out of memory");
    struct bench_machine machine;
    struct bench *bench = bench_open(&machine, method, error);
    bool good = bench && run_all(bench, large, &report, error);
    bench_close(bench);
    fclose(report.json);
    time_t seconds = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&seconds));
    if (good) {
        printf("\n%s; %s %s; commit %s; %s\nsolver: %s; LAPACKE: %s\n", machine.cpu, build_compiler, build_flags,
               build_commit, date, evaluation_solver(method), machine.blas);
    }
    if (good && path) good = write_json(path, method, &machine, date, cases, error);
    free(cases);
    return good;
}

int command_bench(int argc, char **argv)
{
    const char *json = NULL;
    bool large = false;
    wiggly_method method = WIGGLY_CHAIN;
    const struct option_spec specs[] = {
        {"--json", NULL, "FILE", "also write the table as JSON", OPTION_TEXT, &json, 0, 0},
        {"--large", NULL, NULL, "also a loop of 10,000,000 samples, and the memory that it takes", OPTION_FLAG,
         &large, 0, 0},
        options_solver(&method),
    };
    const struct usage usage = {
        .command = "bench",
        .operands = "",
        .summary = "Times the solver against LAPACKE on the same systems in the same run.",
        .options = specs,
        .option_count = sizeof specs / sizeof *specs,
    };
    enum options_result result = options_parse(&usage, argc, argv, NULL);
    if (result != OPTIONS_RUN) return (int)result;
    struct error error = {0};
    if (run(json, large, method, &error)) return 0;
    fprintf(stderr, "wiggly bench: %s\n", error.text);
    return (int)error.kind;
}
