/// The whole analysis of one motion: covariance, eigenproblem, coordinates.
#include "analysis/analysis.h"
#include "analysis/slabs.h"
#include "analysis/spectrum.h"
#include <stdlib.h>

static bool create_components(struct analysis *a, const struct motion *motion, int count)
{
    a->components = calloc((size_t)count, sizeof *a->components);
    if (!a->components) return false;
    a->count = count;
    for (int k = 0; k < count; k++) {
        struct component *c = &a->components[k];
        c->frames = motion->frames;
        c->vertices = motion->vertices;
        c->course = malloc((size_t)motion->frames * sizeof *c->course);
        c->shape = malloc((size_t)motion->vertices * sizeof *c->shape);
        if (!c->course || !c->shape) return false;
    }
    return true;
}

/// Ñ_k = u_kᴴ S̃ for every component, by one more pass over the motion.
static bool form_shapes(struct analysis *a, const struct lapack *lapack, const struct motion *motion,
                        const struct spectrum *spectrum, struct error *error)
{
    size_t frames = (size_t)motion->frames, columns = 3 * (size_t)motion->vertices, count = (size_t)a->count;
    double *weights = malloc(2 * count * frames * sizeof *weights);
    double *combined = malloc(2 * count * columns * sizeof *combined);
    bool done = weights && combined ? true : fail_no_memory(error, motion->path);
    for (size_t k = 0; done && k < count; k++) spectrum_weights(spectrum, (int)k, weights + 2 * k * frames);
    done = done && slabs_combine(lapack, motion, weights, 2 * a->count, combined, error);
    for (size_t k = 0; done && k < count; k++) {
        const double *re = combined + 2 * k * columns, *im = re + columns;
        for (size_t n = 0; n < columns; n++) a->components[k].shape[n / 3][n % 3] = re[n] + I * im[n];
    }
    free(weights);
    free(combined);
    return done;
}

static bool finish(struct analysis *a, const struct motion *motion, const struct spectrum *spectrum, double fps,
                   const double direction[3], struct error *error)
{
    for (int k = 0; k < a->count; k++) {
        struct component *c = &a->components[k];
        for (int t = 0; t < c->frames; t++)
            c->course[t] = spectrum->vectors[(size_t)k * (size_t)c->frames + (size_t)t];
        c->explained = spectrum->values[k] / spectrum->total;
        component_scale(c);
        component_turn(c, direction);
        component_fit(c, fps);
        if (!component_lags(c)) return fail_no_memory(error, motion->path);
    }
    return true;
}

static bool make_spectrum(const struct lapack *lapack, const struct motion *motion, double *means,
                          struct spectrum *spectrum, struct error *error)
{
    size_t n = (size_t)motion->frames;
    double *gram = malloc(n * n * sizeof *gram);
    if (!gram) return fail_no_memory(error, motion->path);
    bool done = slabs_gram(lapack, motion, gram, means, error) &&
                spectrum_create(spectrum, lapack, gram, motion->frames, motion->path, error);
    free(gram);
    return done;
}

bool analysis_create(struct analysis *a, const struct lapack *lapack, const struct motion *motion, double fps,
                     int modes, const double direction[3], struct error *error)
{
    struct spectrum spectrum;
    *a = (struct analysis){0};
    if (motion->frames < ANALYSIS_FRAMES_MIN || motion->frames > ANALYSIS_FRAMES_MAX)
        return fail(error, ERROR_INPUT, "%s: expected %d to %d frames, got %d", motion->path, ANALYSIS_FRAMES_MIN,
                    ANALYSIS_FRAMES_MAX, motion->frames);
    a->mean = malloc((size_t)motion->vertices * sizeof *a->mean);
    if (!a->mean) return fail_no_memory(error, motion->path);
    if (!make_spectrum(lapack, motion, a->mean[0], &spectrum, error)) {
        analysis_free(a);
        return false;
    }
    a->pca1 = spectrum.pca1;
    a->pca2 = spectrum.pca2;
    bool done =
        create_components(a, motion, modes < motion->frames ? modes : motion->frames)
            ? form_shapes(a, lapack, motion, &spectrum, error) && finish(a, motion, &spectrum, fps, direction, error)
            : fail_no_memory(error, motion->path);
    spectrum_free(&spectrum);
    if (!done) analysis_free(a);
    return done;
}

void analysis_free(struct analysis *a)
{
    for (int k = 0; k < a->count; k++) {
        free(a->components[k].course);
        free(a->components[k].shape);
    }
    free(a->components);
    free(a->mean);
    *a = (struct analysis){0};
}
