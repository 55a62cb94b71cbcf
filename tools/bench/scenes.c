/// Times the splines of assets/scenes, including tracks.
#include "base/error.h"
#include "base/need.h"
#include "bench/bench.h"
#include "rig/import.h"
#include "scene/evaluate.h"
#include <glob.h>
#include <math.h>
#include <stdlib.h>

/// Number of results per line, averaged geometrically.
enum { FIGURES = 6 };

static double *figure_of(struct bench_result *r, int f)
{
    return (double *[FIGURES]){&r->ns_per_sample,       &r->p50_us, &r->p99_us, &r->band_ns_per_sample,
                               &r->dpbsv_ns_per_sample, &r->error}[f];
}

/// Sums of logarithms, each over the splines that have the result.
struct means {
    double sum[FIGURES], samples;
    int count[FIGURES];
};

static void time_spline(struct bench *bench, const struct opened *opened, int spline, const char *path,
                        struct means *means)
{
    const struct spline *of = opened->document->splines[spline];
    const struct evaluation *evaluation = &opened->evaluation;
    struct bench_result result = bench_blank(WIGGLY_COMPLEX, 0);
    wiggly_knot *knots = need_zeroed((size_t)of->knot_count, sizeof *knots);
    wiggly_desc desc = evaluation_describe(evaluation, opened->document, spline, knots);
    snprintf(result.name, sizeof result.name, "%.19s: %.18s", path, of->name);
    bench_case(bench, &desc, false, &result);
    for (int f = 0; f < FIGURES; f++) {
        const double value = *figure_of(&result, f);
        if (!(value > 0)) continue;
        means->sum[f] += log(value);
        means->count[f]++;
    }
    means->samples += log(desc.samples);
    free(knots);
}

void bench_scenes(struct bench *bench)
{
    struct means means = {0};
    struct bench_result result = bench_blank(WIGGLY_COMPLEX, 0);
    struct error error = {0};
    glob_t scenes = {0};
    glob("assets/scenes/*.json", 0, NULL, &scenes);
    for (size_t i = 0; i < scenes.gl_pathc; i++) {
        struct opened opened;
        if (!opened_read_splines(&opened, scenes.gl_pathv[i], &error)) bench_stop("%s", error.text);
        opened_solve(&opened, SOLVER_BY_LENGTH);
        for (int s = 0; s < opened.document->spline_count; s++) {
            if (opened.document->splines[s]->knot_count > 0 && opened.evaluation.status[s] == WIGGLY_OK)
                time_spline(bench, &opened, s, scenes.gl_pathv[i], &means);
        }
        opened_free(&opened);
    }
    globfree(&scenes);
    result.splines = means.count[0];
    if (result.splines == 0) return;
    snprintf(result.name, sizeof result.name, "scenes/mean");
    result.mode = "all";
    result.samples = (int)lrint(exp(means.samples / result.splines));
    for (int f = 0; f < FIGURES; f++)
        *figure_of(&result, f) = means.count[f] ? exp(means.sum[f] / means.count[f]) : NAN;
    bench_report(bench, &result);
}
