/// `wiggly bench`: the solver against LAPACKE, on the same systems in the same run.
#include "timing/bench.h"
#include "base/build.h"
#include "base/file.h"
#include "commands/commands.h"
#include "commands/options.h"
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

static void print_line(void *user, const struct bench_result *r)
{
    struct report *report = user;
    char a[32], b[32], c[32];
    if (report->lines++ == 0) {
        printf("%-24s %7s %5s %10s %10s %10s %10s %10s %8s %10s\n", "case", "threads", "lanes", "ns/sample", "p50 us",
               "p99 us", "dpbsv ns", "zpbsv ns", "dpbsv x", "error");
    } else {
        fprintf(report->json, ",\n");
    }
    printf("%-24s %7d %5d %10.2f %10.2f %10.2f %10s %10s %8s %10.1e\n", r->name, r->threads, r->lanes,
           r->ns_per_sample, r->p50_us, r->p99_us, number(a, sizeof a, r->dpbsv_ns_per_sample, "-"),
           number(b, sizeof b, r->zpbsv_ns_per_sample, "-"),
           number(c, sizeof c, r->dpbsv_ns_per_sample / r->ns_per_sample, "-"), r->error);
    fflush(stdout);
    fprintf(
        report->json,
        "    {\"name\": \"%s\", \"mode\": \"%s\", \"samples\": %d, \"splines\": %d, \"threads\": %d, \"lanes\": %d, "
        "\"ns_per_sample\": %.4g, \"p50_us\": %.4g, \"p99_us\": %.4g, \"lapack_dpbsv_ns_per_sample\": %s, "
        "\"lapack_zpbsv_ns_per_sample\": %s, \"error\": %.3g}",
        r->name, r->mode, r->samples, r->splines, r->threads, r->lanes, r->ns_per_sample, r->p50_us, r->p99_us,
        number(a, sizeof a, r->dpbsv_ns_per_sample, "null"), number(b, sizeof b, r->zpbsv_ns_per_sample, "null"),
        r->error);
}

static bool run(const char *path, struct error *error)
{
    char *cases = NULL, *text = NULL, date[32];
    size_t cases_size = 0, size = 0;
    struct report report = {.json = open_memstream(&cases, &cases_size)};
    if (!report.json) return fail(error, ERROR_ENVIRONMENT, "out of memory");
    struct bench_machine machine;
    bool good = bench_run(&machine, print_line, &report, error);
    fclose(report.json);
    time_t seconds = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&seconds));
    if (good) {
        printf("\n%s; %s %s; commit %s; %s\nLAPACKE: %s\n", machine.cpu, build_compiler, build_flags, build_commit,
               date, machine.blas);
    }
    FILE *json = good && path ? open_memstream(&text, &size) : NULL;
    if (json) {
        fprintf(json,
                "{\n  \"machine\": \"%s\",\n  \"compiler\": \"%s\",\n  \"flags\": \"%s\",\n  \"commit\": \"%s\",\n"
                "  \"date\": \"%s\",\n  \"lapack\": \"%s\",\n  \"cases\": [\n%s\n  ]\n}\n",
                machine.cpu, build_compiler, build_flags, build_commit, date, machine.blas, cases);
        fclose(json);
        good = file_write_atomic(path, text, size, error);
    }
    free(text);
    free(cases);
    return good;
}

int command_bench(int argc, char **argv)
{
    const char *json = NULL;
    const struct option_spec specs[] = {
        {"--json", NULL, "FILE", "also write the table as JSON", OPTION_TEXT, &json, 0, 0},
    };
    const struct usage usage = {
        .command = "bench",
        .operands = "",
        .summary = "Times times the solver against LAPACKE on the same systems in the same run.",
        .options = specs,
        .option_count = sizeof specs / sizeof *specs,
    };
    enum options_result result = options_parse(&usage, argc, argv, NULL);
    if (result != OPTIONS_RUN) return (int)result;
    struct error error = {0};
    if (run(json, &error)) return 0;
    fprintf(stderr, "wiggly bench: %s\n", error.text);
    return (int)error.kind;
}
