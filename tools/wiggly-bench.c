/// wiggly-bench [--json FILE] [--large]: compares the solver with LAPACKE on the same systems in the same run.
#include "base/embedded.h"
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
#include "base/progress.h"
#include "bench/bench.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

enum { COMPLEX = 1 << WIGGLY_COMPLEX, REAL = 1 << WIGGLY_REAL, CUBIC = 1 << WIGGLY_CUBIC };
enum { ALL = COMPLEX | REAL | CUBIC, LENGTHS = 4 };

static const struct {
    const char *name;
    enum bench_kind kind;
    int modes;
    int samples[LENGTHS];
    bool values_only; ///< only knots' values change between runs
} plan[] = {
    {"single", BENCH_SINGLE, ALL, {240, 1000, 10000, 100000}, false},
    {"resolve", BENCH_SINGLE, COMPLEX, {240, 1000, 10000, 100000}, true},
    {"irregular", BENCH_IRREGULAR, COMPLEX, {240, 1000, 100000}, false},
    {"irregular", BENCH_IRREGULAR, REAL | CUBIC, {240}, false},
    {"rest", BENCH_REST, ALL, {240}, false},
    {"equilibrium", BENCH_EQUILIBRIUM, ALL, {240}, false},
    {"slopes", BENCH_SLOPES, ALL, {240}, false},
    {"last", BENCH_ENDS, ALL, {240}, false},
    {"last-slope", BENCH_END_SLOPES, ALL, {240}, false},
    {"loop", BENCH_LOOP, COMPLEX, {240, 1000, 100000}, false},
    {"loop", BENCH_LOOP, REAL | CUBIC, {240}, false},
    {"resolve-loop", BENCH_LOOP, ALL, {240}, true},
    {"track", BENCH_TRACK, COMPLEX, {240, 1000, 100000}, false},
    {"track", BENCH_TRACK, REAL, {240}, false},
    {"short", BENCH_SHORT, COMPLEX | REAL, {240}, false},
    {"limits", BENCH_LIMITS, COMPLEX, {240, 1000}, false},
    {"limits", BENCH_LIMITS, REAL | CUBIC, {240}, false},
    {"variation", BENCH_VARIATION, COMPLEX, {240, 1000}, false},
    {"variation", BENCH_VARIATION, REAL, {240}, false},
    {"wind-up", BENCH_WIND_UP, COMPLEX, {240, 1000}, false},
    {"resolve-wind-up", BENCH_WIND_UP, COMPLEX, {240, 1000}, true},
    {"wind-up-track", BENCH_WIND_UP_TRACK, COMPLEX, {240, 1000}, false},
};

static void run_plans(struct bench *bench)
{
    for (size_t n = 0; n < sizeof plan / sizeof *plan; n++) {
        for (wiggly_mode mode = WIGGLY_COMPLEX; mode <= WIGGLY_CUBIC; mode++) {
            for (int l = 0; l < LENGTHS && plan[n].modes >> mode & 1 && plan[n].samples[l]; l++) {
                struct bench_input input;
                struct bench_result result = bench_blank(mode, plan[n].samples[l]);
                snprintf(result.name, sizeof result.name, "%s/%s/%d", plan[n].name, result.mode, result.samples);
                bench_input_create(&input, plan[n].kind, mode, result.samples);
                bench_case(bench, &input.desc, plan[n].values_only, &result);
                bench_report(bench, &result);
                bench_input_destroy(&input);
            }
        }
    }
}

static void expect(const struct bench_result *result, wiggly_status status)
{
    if (status != WIGGLY_OK) bench_stop("%s: %s", result->name, wiggly_status_text(status));
}

/// A loop of 10,000,000 samples: the time of its total curve, and the memory. Must run before everything else.
static void run_large(struct bench *bench)
{
    enum { SAMPLES = 10000000, RUNS = 3 };
    struct bench_input input;
    wiggly_solver *solver = NULL;
    struct rusage usage;
    wiggly_curve curve = {.size = sizeof curve, .total = need_zeroed(SAMPLES, sizeof(double))};
    struct bench_result result = bench_blank(WIGGLY_COMPLEX, SAMPLES);
    snprintf(result.name, sizeof result.name, "loop/complex/%d", SAMPLES);
    bench_input_create(&input, BENCH_LOOP, WIGGLY_COMPLEX, SAMPLES);
    expect(&result, wiggly_create(SAMPLES, input.desc.knot_count, &solver));
    for (int run = 0; run < RUNS; run++) {
        bench_forget(solver);
        double start = clock_now();
        expect(&result, wiggly_solve(solver, &input.desc, &curve));
        bench->times[run] = clock_now() - start;
    }
    bench_sum_up(bench, RUNS, SAMPLES, &result);
    result.error = curve.error;
    if (getrusage(RUSAGE_SELF, &usage) == 0) result.peak_mb = (double)usage.ru_maxrss / 1024;
    bench_report(bench, &result);
    wiggly_destroy(solver);
    bench_input_destroy(&input);
    free(curve.total);
}

static void name_cpu(char *name, size_t size)
{
    char line[256];
    snprintf(name, size, "unknown");
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        char *colon = strncmp(line, "model name", 10) == 0 ? strchr(line, ':') : NULL;
        if (!colon) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, size, "%s", colon + 2);
        break;
    }
    if (file) fclose(file);
}

static void write_json(const char *path, const struct bench *bench, const char *cpu, const char *date,
                       const char *cases)
{
    struct file_output out;
    struct error error = {0};
    if (!file_output_open(&out, path, &error)) bench_stop("%s", error.text);
    fprintf(out.stream,
            "{\n  \"machine\": \"%s\",\n  \"compiler\": \"%s\",\n  \"flags\": \"%s\",\n  \"commit\": \"%s\",\n"
            "  \"date\": \"%s\",\n  \"lapack\": \"%s\",\n  \"cases\": [\n%s\n  ]\n}\n",
            cpu, build_compiler, build_flags, build_commit, date, bench->blas, cases);
    if (!file_output_commit(&out, &error)) bench_stop("%s", error.text);
}

int main(int argc, char **argv)
{
    static struct bench bench;
    const char *json = NULL;
    bool large = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--large") == 0) {
            large = true;
        } else if (strcmp(argv[i], "--json") == 0 && i + 1 < argc) {
            json = argv[++i];
        } else {
            fprintf(stderr, "Usage: wiggly-bench [--json FILE] [--large]\n");
            return ERROR_USAGE;
        }
    }
    char *cases = NULL, cpu[128], date[32];
    size_t size = 0;
    bench_open(&bench);
    bench.json = open_memstream(&cases, &size);
    if (!bench.json) need_failed();
    if (large) run_large(&bench);
    run_plans(&bench);
    bench_batches(&bench);
    bench_pins(&bench);
    bench_scenes(&bench);
    fclose(bench.json);
    lapack_unload(&bench.lapack);
    name_cpu(cpu, sizeof cpu);
    time_t seconds = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&seconds));
    printf("\n%s; %s %s; commit %s; %s\nLAPACKE: %s\n", cpu, build_compiler, build_flags, build_commit, date,
           bench.blas);
    if (json) write_json(json, &bench, cpu, date, cases);
    free(cases);
    return 0;
}
