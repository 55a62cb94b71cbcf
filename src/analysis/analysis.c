/// The whole analysis of one motion: G, its poles or principal components, their shapes.
#include "analysis/analysis.h"
#include "analysis/basis.h"
#include "analysis/poles.h"
#include "analysis/slabs.h"
#include "analysis/spectrum.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double cancelling = 2;     ///< times the motion's power: a larger component only cancels another
static const double fast_from = 0.8;    ///< of half the frame rate
static const double least_gain = 0.002; ///< share of the motion's power that a steady pole must explain
/// The same after a drive, when much of the motion may have died away.
static const double least_gain_afterwards = 0.0002;

/// An analysis in progress. Nothing here is per vertex.
struct work {
    const struct lapack *lapack;
    const struct motion *motion;
    const struct analysis_plan *plan;
    double *gram; ///< of the motion; from find_poles() on about its middle
    double *free; ///< of the undriven frames, if some are driven
    double power; ///< trace of `gram`
    struct pole poles[SUBSPACE_POLES_MAX];
    int pole_count;
    double *middle;  ///< see middle_create(); NULL by CPCA, which has the mean
    double *weights; ///< rows over the frames: Re Ñ and Im Ñ of each component
};

static double trace(const double *gram, int frames)
{
    double sum = 0;
    for (size_t t = 0; t < (size_t)frames; t++) sum += gram[t * (size_t)(frames + 1)];
    return sum;
}

/// Share of the power above `fast_from` of half the frame rate, in the discrete Fourier transform, from the sums g_d of G's diagonals.
static double fast_share(const double *gram, int frames)
{
    size_t n = (size_t)frames;
    double share = 0, power = trace(gram, frames);
    for (size_t d = 0; d < n; d++) {
        double along = 0, kernel = 0;
        for (size_t t = 0; t + d < n; t++) along += gram[(t + d) * n + t];
        for (size_t k = (size_t)ceil(fast_from * frames / 2); k <= n / 2; k++)
            kernel += (2 * k == n ? 1 : 2) * cos(2 * M_PI * (double)(k * d % n) / frames);
        share += (d == 0 ? 1 : 2) * along * kernel / frames;
    }
    return fmax(share / power, 0);
}

static bool fail_frames(struct error *error, const struct motion *motion)
{
    return fail(error, ERROR_ENVIRONMENT, "%s: not enough memory for %d frames", motion->path, motion->frames);
}

/// G of the frames from the plan's first on.
static const double *cut_gram(struct work *w)
{
    size_t first = (size_t)w->plan->first, n = (size_t)w->motion->frames, left = n - first;
    if (first == 0) return w->gram;
    w->free = need(left * left, sizeof *w->free);
    for (size_t t = 0; t < left; t++)
        memcpy(w->free + t * left, w->gram + (t + first) * n + first, left * sizeof *w->free);
    return w->free;
}

/// Finds the poles of the undriven frames, and removes from G the position that vertices swing about; that by CPCA is the mean.
static bool find_poles(struct work *w, struct basis *basis, struct error *error)
{
    int first = w->plan->first, frames = w->motion->frames - first;
    const double *gram = cut_gram(w);
    const double least = first > 0 ? least_gain_afterwards : least_gain;
    w->power = trace(gram, frames);
    if (!(w->power > 0)) return fail(error, ERROR_INPUT, "%s: expected a motion, but nothing moves", w->motion->path);
    double *ones = need((size_t)frames, sizeof *ones);
    for (int t = 0; t < frames; t++) ones[t] = 1;
    basis_append(basis, ones);
    free(ones);
    const int found = subspace_poles(w->lapack, gram, frames, w->poles);
    if (found < 0) return fail_frames(error, w->motion);
    w->pole_count = exponentials_choose(w->poles, found, TIME_SERIES_MAX, least, gram, basis);
    if (w->plan->method == ANALYSIS_POLES) {
        w->middle = middle_create(basis, first);
        middle_remove(w->middle, w->motion->frames, w->gram);
    }
    w->power = trace(w->gram, w->motion->frames);
    return true;
}

static void create_components(struct analysis *a, const struct work *w, int count)
{
    int frames = w->motion->frames, vertices = w->motion->vertices;
    a->components = pool_take(&a->pool, (size_t)count, sizeof *a->components);
    a->count = count;
    for (int k = 0; k < count; k++) {
        struct component *c = &a->components[k];
        c->frames = frames;
        c->vertices = vertices;
        c->series = pool_take(&a->pool, (size_t)frames, sizeof *c->series);
        c->shape = pool_take(&a->pool, (size_t)vertices, sizeof *c->shape);
        c->metric.pull = pool_take(&a->pool, (size_t)frames, sizeof *c->metric.pull);
    }
}

/// One component per principal component of the analytic signal.
static bool find_principal(struct analysis *a, struct work *w)
{
    int frames = w->motion->frames, count = w->plan->modes < frames ? w->plan->modes : frames;
    struct spectrum spectrum;
    create_components(a, w, count);
    if (!spectrum_create(&spectrum, w->lapack, w->gram, frames)) return false;
    for (int k = 0; k < count; k++) {
        struct component *c = &a->components[k];
        for (int t = 0; t < frames; t++) c->series[t] = spectrum.vectors[(size_t)k * (size_t)frames + (size_t)t];
        c->explained = spectrum.values[k] / spectrum.total;
        spectrum_weights(&spectrum, k, w->weights + 2 * (size_t)k * (size_t)frames);
    }
    spectrum_free(&spectrum);
    return true;
}

/// The last component so large that others must cancel it; -1: none.
static int find_cancelled(const struct time_series *series, double power)
{
    int k = series->count - 1;
    while (k >= 0 && series->part[k] <= cancelling * power) k--;
    return k;
}

/// Fits time series to the first poles, dropping those that others cancel.
static void find_series(struct analysis *a, struct work *w, struct time_series *series)
{
    for (;;) {
        int count = w->pole_count < w->plan->modes ? w->pole_count : w->plan->modes;
        double complex z[TIME_SERIES_MAX];
        for (int k = 0; k < count; k++) z[k] = w->poles[k].z;
        time_series_create(series, w->lapack, w->gram, w->motion->frames, w->plan->first, z, count);
        int cancelled = find_cancelled(series, w->power);
        if (cancelled < 0 || count == 1) return;
        time_series_free(series);
        for (int k = cancelled; k + 1 < w->pole_count; k++) w->poles[k] = w->poles[k + 1];
        w->pole_count--;
        a->cancelled++;
    }
}

/// One component per pole.
static void find_swinging(struct analysis *a, struct work *w)
{
    struct time_series series;
    find_series(a, w, &series);
    int frames = w->motion->frames, count = series.count;
    create_components(a, w, count);
    const double complex *z = series.pole;
    for (int k = 0; k < count; k++) {
        struct component *c = &a->components[k];
        const double *row = series.rows + 2 * (size_t)k * (size_t)frames;
        double complex s = clog(z[k]) * w->plan->fps;
        for (int t = 0; t < frames; t++) c->series[t] = row[t] - I * row[frames + t];
        c->frequency = cabs(s) / (2 * M_PI);
        c->damping = fmax(-creal(s) / cabs(s), 0);
    }
    for (size_t i = 0; i < 2 * (size_t)count * (size_t)frames; i++) w->weights[i] = series.weights[i];
    time_series_free(&series);
}

/// From the weights of Ñ: the numbers that give the error of any time series on the whole motion.
static void fill_metric(struct component *c, const struct work *w, const double *weights)
{
    size_t n = (size_t)c->frames;
    struct series_metric *m = &c->metric;
    for (size_t t = 0; t < n; t++) {
        m->pull[t] = 0;
        for (size_t s = 0; s < n; s++) m->pull[t] += w->gram[t * n + s] * (weights[s] + I * weights[n + s]);
        m->norm += creal(m->pull[t] * (weights[t] - I * weights[n + t]));
        m->square += m->pull[t] * (weights[t] + I * weights[n + t]);
    }
    m->power = w->power;
}

/// The motion of component l along Ñ_k in every frame, Re(R_l Ñ_l)·Ñ_k = (R_l Ñ_l·Ñ_k + R̄_l conj(Ñ_l)·Ñ_k) / 2. Returns Σ_t of
/// its product with the motion of component k.
static double find_overlap(const struct component *k, const struct component *l, const double *weights,
                           double complex *along)
{
    double complex plain = 0, conjugate = 0;
    double product = 0;
    for (int t = 0; t < k->frames; t++) {
        double complex w = weights[t] + I * weights[k->frames + t];
        plain += w * k->metric.pull[t];
        conjugate += conj(w) * k->metric.pull[t];
    }
    for (int t = 0; t < k->frames; t++) {
        along[t] = (l->series[t] * plain + conj(l->series[t]) * conjugate) / 2;
        product += creal(k->series[t] * along[t]);
    }
    return product;
}

/// Restricts each component's metric to its own motion, the whole minus the others': |s − Σ_l Re(R_l Ñ_l)|² over all l ≠ k.
static void share_motion(struct analysis *a, const struct work *w)
{
    size_t n = (size_t)w->motion->frames;
    double products[TIME_SERIES_MAX][TIME_SERIES_MAX], pulls[TIME_SERIES_MAX] = {0}, left = w->power;
    double complex *along = need((1 + (size_t)a->count) * n, sizeof *along);
    double complex *others = along + n;
    for (size_t i = 0; i < (size_t)a->count * n; i++) others[i] = 0;
    for (int k = 0; k < a->count; k++) {
        struct component *c = &a->components[k];
        for (size_t t = 0; t < n; t++) pulls[k] += creal(c->series[t] * c->metric.pull[t]);
        left -= 2 * pulls[k];
        for (int l = 0; l < a->count; l++) {
            products[k][l] = find_overlap(c, &a->components[l], w->weights + 2 * (size_t)l * n, along);
            for (size_t t = 0; t < n && l != k; t++) others[(size_t)k * n + t] += along[t];
            left += products[k][l];
        }
    }
    a->left = sqrt(fmax(left, 0) / w->power);
    for (int k = 0; k < a->count; k++) {
        struct component *c = &a->components[k];
        if (w->plan->method == ANALYSIS_POLES) c->explained = fmax(2 * pulls[k] - products[k][k], 0) / w->power;
        c->metric.power = left + 2 * pulls[k] + products[k][k];
        for (int l = 0; l < a->count; l++) c->metric.power -= 2 * products[k][l];
        for (size_t t = 0; t < n; t++) c->metric.pull[t] -= others[(size_t)k * n + t];
    }
    free(along);
}

/// Ñ of every component, in a second pass over the motion.
static bool form_shapes(struct analysis *a, struct work *w, struct error *error)
{
    size_t frames = (size_t)w->motion->frames, columns = 3 * (size_t)w->motion->vertices, count = (size_t)a->count;
    double *combined = need(2 * count * columns, sizeof *combined);
    for (size_t k = 0; k < count; k++) fill_metric(&a->components[k], w, w->weights + 2 * k * frames);
    share_motion(a, w);
    if (w->middle) middle_adapt(w->middle, w->motion->frames, w->weights, 2 * a->count);
    bool done = slabs_combine(w->lapack, w->motion, w->plan->base, w->weights, 2 * a->count, combined, error);
    for (size_t k = 0; done && k < count; k++) {
        const double *re = combined + 2 * k * columns, *im = re + columns;
        for (size_t n = 0; n < columns; n++) a->components[k].shape[n / 3][n % 3] = re[n] + I * im[n];
    }
    free(combined);
    return done;
}

static void finish(struct analysis *a, const struct work *w)
{
    for (int k = 0; k < a->count; k++) {
        struct component *c = &a->components[k];
        component_scale(c);
        component_turn(c, w->plan->direction);
        if (w->plan->method == ANALYSIS_CPCA) component_fit(c, w->plan->fps);
        component_lags(c);
    }
}

static bool find_components(struct analysis *a, struct work *w, struct error *error)
{
    int frames = w->motion->frames;
    double shares[ANALYSIS_MODES_MAX];
    struct basis basis;
    basis_create(&basis, frames - w->plan->first, 1 + 2 * TIME_SERIES_MAX);
    bool done = find_poles(w, &basis, error);
    basis_free(&basis);
    if (!done) return false;
    if (w->pole_count == 0 && w->plan->first > 0)
        return fail(error, ERROR_INPUT,
                    "%s: expected an oscillation in the %d frames after the drive, got none; simulate for longer, or "
                    "use --method cpca",
                    w->motion->path, frames - w->plan->first);
    if (w->plan->method == ANALYSIS_POLES && w->pole_count == 0)
        return fail(error, ERROR_INPUT, "%s: expected an oscillation, got none; --method cpca takes any motion",
                    w->motion->path);
    a->fast_share = fast_share(w->gram, frames);
    if (!spectrum_real_shares(w->lapack, w->gram, frames, ANALYSIS_MODES_MAX, shares) ||
        (w->plan->method == ANALYSIS_CPCA && !find_principal(a, w)))
        return fail_frames(error, w->motion);
    if (w->plan->method != ANALYSIS_CPCA) find_swinging(a, w);
    a->pca1 = shares[0];
    a->pca2 = shares[1];
    a->real_left = sqrt(fmax(1 - shares[a->count - 1], 0));
    if (!form_shapes(a, w, error)) return false;
    finish(a, w);
    return true;
}

bool analysis_create(struct analysis *a, const struct lapack *lapack, const struct motion *motion,
                     const struct analysis_plan *plan, struct error *error)
{
    struct work work = {.lapack = lapack, .motion = motion, .plan = plan};
    size_t n = (size_t)motion->frames;
    *a = (struct analysis){0};
    if (motion->frames < ANALYSIS_FRAMES_MIN || motion->frames > ANALYSIS_FRAMES_MAX)
        return fail(error, ERROR_INPUT, "%s: expected %d to %d frames, got %d", motion->path, ANALYSIS_FRAMES_MIN,
                    ANALYSIS_FRAMES_MAX, motion->frames);
    if (motion->frames - plan->first < ANALYSIS_FRAMES_MIN)
        return fail(error, ERROR_INPUT, "%s: expected %d frames or more after the drive stops, got %d", motion->path,
                    ANALYSIS_FRAMES_MIN, motion->frames > plan->first ? motion->frames - plan->first : 0);
    const size_t numbers = plan->method == ANALYSIS_CPCA ? 13 : 5; // per pair of frames
    if (!need_has_room(numbers * n * n * sizeof *work.gram)) return fail_frames(error, motion);
    a->mean = pool_take(&a->pool, (size_t)motion->vertices, sizeof *a->mean);
    work.gram = need(n * n, sizeof *work.gram);
    work.weights = need(2 * (size_t)plan->modes * n, sizeof *work.weights);
    bool done =
        slabs_gram(lapack, motion, plan->base, work.gram, a->mean[0], error) && find_components(a, &work, error);
    free(work.gram);
    free(work.free);
    free(work.weights);
    free(work.middle);
    if (!done) analysis_free(a);
    return done;
}

void analysis_free(struct analysis *a)
{
    pool_free(&a->pool);
    *a = (struct analysis){0};
}
