/// Times the splines of the program's own scenes, tracks and all.
#include "commands/bench_scenes.h"
#include "app/assets.h"
#include "rig/opened.h"
#include "scene/evaluate.h"
#include "scene/storage.h"
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Sums of logarithms, each over the splines that have the figure.
struct mean {
    double sum;
    int count;
};

struct means {
    struct mean time, p50, p99, band, dpbsv, zpbsv, samples;
    double error; ///< the largest
};

static void add(struct mean *mean, double value)
{
    if (!(value > 0)) return;
    mean->sum += log(value);
    mean->count++;
}

static double mean_of(struct mean mean) { return mean.count ? exp(mean.sum / mean.count) : NAN; }

static void add_result(struct means *means, const struct bench_result *r)
{
    add(&means->time, r->ns_per_sample);
    add(&means->p50, r->p50_us);
    add(&means->p99, r->p99_us);
    add(&means->band, r->band_ns_per_sample);
    add(&means->dpbsv, r->dpbsv_ns_per_sample);
    add(&means->zpbsv, r->zpbsv_ns_per_sample);
    add(&means->samples, r->samples);
    means->error = fmax(means->error, r->error);
}

static bool time_spline(struct bench *bench, const struct document *document, const struct evaluation *evaluation,
                        int spline, const char *path, struct means *means, struct error *error)
{
    const struct spline *of = &document->splines[spline];
    wiggly_desc desc = storage_describe(evaluation->storage, evaluation->curves, document, spline, false);
    wiggly_knot *knots = calloc((size_t)of->knot_count, sizeof *knots);
    if (!knots) return fail(error, ERROR_ENVIRONMENT, "out of memory");
    storage_add_knots(&desc, document, spline, knots);
    char name[40];
    struct bench_result result;
    snprintf(name, sizeof name, "%.19s: %.18s", strrchr(path, '/') + 1, of->name);
    bool good = bench_spline(bench, name, &desc, &result, error);
    if (good) add_result(means, &result);
    free(knots);
    return good;
}

static bool time_scene(struct bench *bench, const char *path, struct means *means, struct error *error)
{
    struct opened opened;
    if (!opened_read_splines(&opened, path, error)) return false;
    const struct document *document = opened.document;
    bool good = opened_solve(&opened, WIGGLY_CHAIN, error);
    for (int i = 0; good && i < document->spline_count; i++) {
        if (document->splines[i].knot_count == 0 || opened.evaluation.status[i] != WIGGLY_OK) continue;
        good = time_spline(bench, document, &opened.evaluation, i, path, means, error);
    }
    opened_free(&opened);
    return good;
}

bool bench_scenes(struct bench *bench, struct bench_result *result, struct error *error)
{
    char folder[PATH_LIMIT], pattern[PATH_LIMIT + 8];
    struct means means = {0};
    glob_t scenes = {0};
    *result = (struct bench_result){.name = "scenes/mean", .mode = "all", .threads = 1, .lanes = 1, .peak_mb = NAN};
    if (!assets_folder(folder)) return true;
    snprintf(pattern, sizeof pattern, "%s/*.json", folder);
    bool good = true;
    int found = glob(pattern, 0, NULL, &scenes);
    for (size_t i = 0; found == 0 && good && i < scenes.gl_pathc; i++)
        good = time_scene(bench, scenes.gl_pathv[i], &means, error);
    globfree(&scenes);
    if (!good || means.time.count == 0) return good;
    result->splines = means.time.count;
    result->samples = (int)lrint(mean_of(means.samples));
    result->ns_per_sample = mean_of(means.time);
    result->p50_us = mean_of(means.p50);
    result->p99_us = mean_of(means.p99);
    result->band_ns_per_sample = mean_of(means.band);
    result->dpbsv_ns_per_sample = mean_of(means.dpbsv);
    result->zpbsv_ns_per_sample = mean_of(means.zpbsv);
    result->error = means.error;
    return true;
}
