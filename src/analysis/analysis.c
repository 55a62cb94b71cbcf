/// The whole analysis of one motion: G, its poles or principal components, their shapes and splines.
#include "analysis/analysis.h"
#include "base/need.h"
#include "maths/maths.h"
#include "maths/symmetric.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- components: the gauge, frequency, damping and lags

static const double tail_share = 0.05; ///< share of the motion beyond each end of the range of lags

double component_error(const struct component *c, const double complex *series)
{
    const struct series_metric *m = &c->metric;
    double left = m->power;
    for (int t = 0; t < c->frames; t++) {
        double complex x = series[t];
        left += (creal(x * conj(x)) * m->norm + creal(x * x * m->square)) / 2 - 2 * creal(x * m->pull[t]);
    }
    return sqrt(fmax(left, 0) / m->power);
}

/// Ñ ← g Ñ and R ← R / g, so A ← |g|² A and B ← g² B.
static void change_gauge(struct component *c, double complex g)
{
    for (int n = 0; n < 3 * c->vertices; n++) {
        c->shape[n / 3][n % 3] *= g;
        if (!c->lift) continue;
        c->lift[n / 3][n % 3] *= creal(g * conj(g));
        c->bend[n / 3][n % 3] *= g * g;
    }
    for (int t = 0; t < c->frames; t++) {
        c->series[t] /= g;
        c->metric.pull[t] *= g;
    }
    c->metric.norm *= creal(g * conj(g));
    c->metric.square *= g * g;
}

static double complex component_along(const struct component *c, int vertex)
{
    const double complex *n = c->shape[vertex];
    return n[0] * c->direction[0] + n[1] * c->direction[1] + n[2] * c->direction[2];
}

/// Turns Ñ, and R the other way, so that Σ (ñ·d)² is real and positive and Re Σ ñ·d ≥ 0. `direction` is d, of any length; NULL
/// means the direction with the most motion, its largest number positive.
static void component_turn(struct component *c, const double direction[3])
{
    double length =
        direction ? sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]) : 0;
    double complex squares = 0, sum = 0;
    if (length > 0) {
        for (int i = 0; i < 3; i++) c->direction[i] = direction[i] / length;
    } else {
        // The direction with the most motion: the largest eigenvector of Re Σ ñ ñᴴ.
        double moment[9] = {0}, values[3], vectors[9], largest = 0;
        for (int v = 0; v < c->vertices; v++) {
            for (int n = 0; n < 9; n++) moment[n] += creal(c->shape[v][n / 3] * conj(c->shape[v][n % 3]));
        }
        symmetric_eigen(3, moment, values, vectors);
        const double *d = vectors + 6;
        for (int i = 0; i < 3; i++) largest = fabs(d[i]) > fabs(largest) ? d[i] : largest;
        for (int i = 0; i < 3; i++) c->direction[i] = copysign(1, largest) * d[i];
    }
    for (int v = 0; v < c->vertices; v++) {
        double complex n = component_along(c, v);
        squares += n * n;
        sum += n;
    }
    double complex turn = cexp(-I * carg(squares) / 2);
    if (creal(sum * turn) < 0) turn = -turn;
    change_gauge(c, turn);
}

/// Weighted sums for the slopes of lines fitted to two sequences over the same frames.
struct slopes {
    double weight, t, tt, y[2], ty[2];
};

static double slope(const struct slopes *s, int i)
{
    double spread = s->weight * s->tt - s->t * s->t;
    return spread > 0 ? (s->weight * s->ty[i] - s->t * s->y[i]) / spread : 0;
}

void component_fit(struct component *c, double fps)
{
    struct slopes sums = {0};
    double phase = carg(c->series[0]);
    for (int t = 0; t < c->frames; t++) {
        double size = cabs(c->series[t]);
        if (t > 0) phase += carg(c->series[t] * conj(c->series[t - 1]));
        if (!(size > 0)) continue;
        const double weight = size * size, time = t / fps, y[2] = {log(size), phase};
        sums.weight += weight;
        sums.t += weight * time;
        sums.tt += weight * time * time;
        for (int i = 0; i < 2; i++) {
            sums.y[i] += weight * y[i];
            sums.ty[i] += weight * time * y[i];
        }
    }
    double decay = fmax(-slope(&sums, 0), 0), turning = fabs(slope(&sums, 1)), natural = hypot(decay, turning);
    c->frequency = natural / (2 * M_PI);
    c->damping = natural > 0 ? decay / natural : 0;
}

struct share {
    double lag, weight;
};

void component_lags(struct component *c)
{
    struct share *shares = need((size_t)c->vertices, sizeof *shares);
    double total = 0, sum = 0;
    c->reach = 0;
    for (int v = 0; v < c->vertices; v++) {
        double complex n = component_along(c, v);
        double size = 0;
        for (int k = 0; k < 3; k++) size += creal(c->shape[v][k] * conj(c->shape[v][k]));
        c->reach = fmax(c->reach, sqrt(size));
        shares[v] = (struct share){-carg(n) * 180 / M_PI, creal(n * conj(n))};
        total += shares[v].weight;
    }
    qsort(shares, (size_t)c->vertices, sizeof *shares, maths_compare);
    c->first_lag = c->last_lag = 0;
    for (int v = 0; v < c->vertices; v++) {
        if (sum <= tail_share * total) c->first_lag = shares[v].lag;
        if (sum < (1 - tail_share) * total) c->last_lag = shares[v].lag;
        sum += shares[v].weight;
    }
    free(shares);
}

// --- the analysis

static const double cancelling = 2;     ///< times the motion's power: a larger component only cancels another
static const double fast_from = 0.8;    ///< of half the frame rate
static const double least_gain = 0.002; ///< share of the motion's power that a steady pole must explain
/// The same after a drive, when much of the motion may have died away.
static const double least_gain_afterwards = 0.0002;

/// An analysis in progress. Nothing here is per vertex.
struct work {
    struct pool pool; ///< has all below
    const struct lapack *lapack;
    const struct motion *motion;
    const struct analysis_plan *plan;
    double *gram; ///< of the motion; from find_poles() on about its middle
    double *free; ///< of the undriven frames, if some are driven
    double power; ///< trace of `gram`
    struct pole poles[SUBSPACE_POLES_MAX];
    int pole_count;
    double *
        middle; ///< weights of the frames, for the position that vertices swing about; NULL by CPCA, which has the mean
    double *weights; ///< rows over the frames: Re Ñ, Im Ñ of each component; A, Re B, Im B of each; the middle's
};

static double trace(const double *gram, int frames)
{
    double sum = 0;
    for (size_t t = 0; t < (size_t)frames; t++) sum += gram[t * (size_t)(frames + 1)];
    return sum;
}

/// Share of the power above `fast_from` of half the frame rate, Σ_k c_kᵀ G c_k, in the discrete cosine transform
/// c_k,t = √(2/n) cos(π k (t + ½)/n). It continues a record by its mirror image, so that a swing that is cut at the ends makes no step.
/// From the sums of G's diagonals and antidiagonals: 2 cos a cos b = cos(a − b) + cos(a + b).
static double fast_share(const double *gram, int frames)
{
    const size_t n = (size_t)frames;
    double share = 0;
    for (size_t d = 0; d < 2 * n; d++) { // t − s = d; and t + s + 1 = d
        double sum = 0, kernel = 0;
        for (size_t t = 0; t + d < n; t++) sum += (d == 0 ? 1 : 2) * gram[(t + d) * n + t];
        for (size_t t = d > n ? d - n : 0; t < n && t < d; t++) sum += gram[t * n + (d - 1 - t)];
        for (size_t k = (size_t)ceil(fast_from * frames); k < n; k++)
            kernel += cos(M_PI * (double)(k * d % (2 * n)) / frames);
        share += sum * kernel / frames;
    }
    return fmax(share / trace(gram, frames), 0);
}

static bool fail_frames(struct error *error, const struct motion *motion)
{
    return fail(error, ERROR_ENVIRONMENT, "%s: not enough memory for %d frames", motion->path, motion->frames);
}

/// Finds the poles of the undriven frames, and removes from G the position that vertices swing about; that by CPCA is the mean.
static bool find_poles(struct work *w, struct basis *basis, struct error *error)
{
    const int first = w->plan->first, frames = w->motion->frames - first;
    const size_t from = (size_t)first, n = (size_t)w->motion->frames, after = n - from;
    if (first > 0) {
        w->free = pool_take(&w->pool, after * after, sizeof *w->free);
        for (size_t t = 0; t < after; t++)
            memcpy(w->free + t * after, w->gram + (t + from) * n + from, after * sizeof *w->free);
    }
    const double *gram = first > 0 ? w->free : w->gram;
    const double least = first > 0 ? least_gain_afterwards : least_gain;
    w->power = trace(gram, frames);
    if (!(w->power > 0)) return fail(error, ERROR_INPUT, "%s: expected a motion, but nothing moves", w->motion->path);
    double *ones = pool_take(&w->pool, (size_t)frames, sizeof *ones);
    for (int t = 0; t < frames; t++) ones[t] = 1;
    basis_append(basis, ones);
    const int found = subspace_poles(w->lapack, gram, frames, w->poles);
    if (found < 0) return fail_frames(error, w->motion);
    w->pole_count = exponentials_choose(w->poles, found, TIME_SERIES_MAX, least, gram, basis);
    if (w->plan->method == ANALYSIS_POLES) {
        // The middle's weights are those of the ones, with which the basis begins.
        double *all = pool_take(&w->pool, (size_t)basis->count * after, sizeof *all);
        w->middle = pool_take(&w->pool, n, sizeof *w->middle);
        basis_weights(basis, all);
        memcpy(w->middle + first, all, after * sizeof *w->middle);

        // G becomes that of S′ = (1 − 1 wᵀ) S: with g = G w, G − 1 gᵀ − g 1ᵀ + (wᵀ g) 1 1ᵀ, both halves at once, so that it stays
        // symmetric.
        double *product = pool_take(&w->pool, n, sizeof *product);
        for (size_t t = 0; t < n; t++) product[t] = maths_dot(w->gram + t * n, w->middle, w->motion->frames);
        const double twice = maths_dot(w->middle, product, w->motion->frames);
        for (size_t i = 0; i < n * n; i++) w->gram[i] += twice - product[i % n] - product[i / n];
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

/// Restricts each component's metric to its own motion, the whole minus the others': |s − Σ_l Re(R_l Ñ_l)|² over all l ≠ k.
static void share_motion(struct analysis *a, const struct work *w)
{
    size_t n = (size_t)w->motion->frames;
    double products[TIME_SERIES_MAX][TIME_SERIES_MAX], pulls[TIME_SERIES_MAX] = {0}, left = w->power;
    double complex *others = need((size_t)a->count * n, sizeof *others);
    for (size_t i = 0; i < (size_t)a->count * n; i++) others[i] = 0;
    for (int k = 0; k < a->count; k++) {
        struct component *c = &a->components[k];
        for (size_t t = 0; t < n; t++) pulls[k] += creal(c->series[t] * c->metric.pull[t]);
        left -= 2 * pulls[k];
        for (int l = 0; l < a->count; l++) {
            // The motion of component l along Ñ_k in every frame, Re(R_l Ñ_l)·Ñ_k = (R_l Ñ_l·Ñ_k + R̄_l conj(Ñ_l)·Ñ_k) / 2, and
            // the sum over the frames of its product with the motion of component k.
            const double *re = w->weights + 2 * (size_t)l * n, *im = re + n;
            const double complex *series = a->components[l].series;
            double complex plain = 0, conjugate = 0;
            double product = 0;
            for (size_t t = 0; t < n; t++) {
                const double complex weight = re[t] + I * im[t];
                plain += weight * c->metric.pull[t];
                conjugate += conj(weight) * c->metric.pull[t];
            }
            for (size_t t = 0; t < n; t++) {
                const double complex along = (series[t] * plain + conj(series[t]) * conjugate) / 2;
                product += creal(c->series[t] * along);
                if (l != k) others[(size_t)k * n + t] += along;
            }
            left += products[k][l] = product;
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
    free(others);
}

// --- curves: |R|² A + Re(R² B), by least squares on what Re(R Ñ) leaves

enum { PARTS = 3 }; ///< |R|², Re R² and −Im R²

/// Of the sum of squares of |R|²: parts that go nearly alike do not cancel each other.
static const double ridge = 0.01;
static const double least_curve = 1e-3;  ///< share of the motion's power that a component's curves must explain
static const double least_part = 0.6;    ///< of what is left, times its error: the more is left, the stricter
static const double most_curve = 0.05;   ///< times explained / not explained by the component: more is others' motion
static const double more_than_noise = 2; ///< times what they would explain if that were noise

/// x ← x − Σ (along_i·x) rows_i
static void take_off(double *x, const double *along, const double *rows, int count, int frames)
{
    double sums[PARTS * TIME_SERIES_MAX + 1];
    for (int i = 0; i < count; i++) sums[i] = maths_dot(along + (size_t)i * (size_t)frames, x, frames);
    for (int i = 0; i < count; i++, rows += frames) {
        for (int t = 0; t < frames; t++) x[t] -= sums[i] * rows[t];
    }
}

/// G becomes that of S − Σ rows_i (along_i S).
static void take_off_gram(double *gram, const double *along, const double *rows, int count, int frames)
{
    const size_t n = (size_t)frames;
    for (int side = 0; side < 2; side++) {
        for (size_t t = 0; t < n; t++) take_off(gram + t * n, along, rows, count, frames);
        for (size_t t = 0; t < n; t++) {
            for (size_t s = 0; s < t; s++) {
                const double other = gram[t * n + s];
                gram[t * n + s] = gram[s * n + t];
                gram[s * n + t] = other;
            }
        }
    }
}

/// Gives components curves, each in turn if that explains enough, and the middle what is then constant of the rest; `middle` receives that one's
/// weights. Frames that do not exist, one for each part, hold the ridge: there the motion is 0.
static void find_curves(struct analysis *a, struct work *w, double *middle)
{
    const int frames = w->motion->frames, linear = 2 * a->count, most = PARTS * a->count + 1, longer = frames + most;
    const size_t n = (size_t)frames, l = (size_t)longer;
    double *gram = need(l * l + n * n + (size_t)(linear + 2 * most) * l, sizeof *gram), *left = gram + l * l;
    double *rows = left + n * n, *parts = rows + (size_t)linear * n, *fit = parts + (size_t)most * l;
    struct basis basis;
    basis_create(&basis, longer, most);

    // What is left is E S with E = 1 − Σ rows w, for the weights w of the shapes.
    for (size_t i = 0; i < (size_t)linear * n; i++) {
        const double complex x = a->components[i / n / 2].series[i % n];
        rows[i] = i / n % 2 ? -cimag(x) : creal(x);
    }
    memcpy(left, w->gram, n * n * sizeof *left);
    take_off_gram(left, w->weights, rows, linear, frames);
    for (size_t i = 0; i < l * l; i++) gram[i] = i / l < n && i % l < n ? left[i / l * n + i % l] : 0;
    for (size_t t = 0; t < l; t++) parts[t] = t < n;
    basis_append(&basis, parts);
    for (int k = 0; k < a->count; k++) {
        struct component *c = &a->components[k];
        double size = 0;
        for (size_t t = 0; t < n; t++) size += pow(cabs(c->series[t]), 4);
        for (int part = 0; part < PARTS; part++) {
            double *to = parts + (size_t)basis.count * l;
            for (size_t t = 0; t < l; t++) {
                const double complex x = t < n ? c->series[t] : 0, square = x * (part == 0 ? conj(x) : x);
                to[t] = part < 2 ? creal(square) : -cimag(square);
            }
            to[n + (size_t)basis.count] = sqrt(ridge * size);
            basis_append(&basis, to);
        }
        const double gain = basis_gain(&basis, PARTS, gram);
        const double part = fmax(least_part * a->left, more_than_noise * PARTS / frames) * a->left * a->left;
        const bool is_own = gain * (1 - c->explained) < most_curve * c->explained * w->power;
        const bool is_curved = is_own && gain > fmax(least_curve, part) * w->power;
        basis.count -= is_curved ? 0 : PARTS;
        c->lift = is_curved ? pool_take(&a->pool, (size_t)c->vertices, sizeof *c->lift) : NULL;
        c->bend = is_curved ? pool_take(&a->pool, (size_t)c->vertices, sizeof *c->bend) : NULL;
    }
    if (basis.count > 1) {
        double power = 0;
        basis_weights(&basis, fit);
        take_off_gram(gram, fit, parts, basis.count, longer);
        for (size_t t = 0; t < n; t++) power += gram[t * (l + 1)];
        a->left = sqrt(fmax(power, 0) / w->power);
        for (int i = 0; i < basis.count; i++) take_off(fit + (size_t)i * l, rows, w->weights, linear, frames);
        memcpy(middle, fit, n * sizeof *fit);
        for (int i = 0; i < PARTS * a->count; i++) {
            if (!a->components[i / PARTS].lift) continue;
            memcpy(w->weights + (size_t)(linear + i) * n, fit += l, n * sizeof *fit);
        }
    }
    pool_free(&basis.pool);
    free(gram);
}

static bool find_components(struct analysis *a, struct work *w, struct error *error)
{
    int frames = w->motion->frames;
    double shares[ANALYSIS_MODES_MAX];
    struct basis basis;
    basis_create(&basis, frames - w->plan->first, 1 + 2 * TIME_SERIES_MAX);
    bool done = find_poles(w, &basis, error);
    pool_free(&basis.pool);
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
    if (!spectrum_real_shares(w->lapack, w->gram, frames, ANALYSIS_MODES_MAX, shares))
        return fail_frames(error, w->motion);
    if (w->plan->method == ANALYSIS_POLES) {
        struct time_series series;
        int count;
        for (;;) { // without the last component so large that others must cancel it
            double complex z[TIME_SERIES_MAX];
            count = w->pole_count < w->plan->modes ? w->pole_count : w->plan->modes;
            for (int k = 0; k < count; k++) z[k] = w->poles[k].z;
            series = time_series_create(w->lapack, w->gram, frames, w->plan->first, z, count);
            int cancelled = count - 1;
            while (cancelled >= 0 && series.part[cancelled] <= cancelling * w->power) cancelled--;
            if (cancelled < 0 || count == 1) break;
            pool_free(&series.pool);
            for (int k = cancelled; k + 1 < w->pole_count; k++) w->poles[k] = w->poles[k + 1];
            w->pole_count--;
            a->cancelled++;
        }
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
        pool_free(&series.pool);
    } else { // one component per principal component of the analytic signal
        struct spectrum spectrum;
        create_components(a, w, w->plan->modes < frames ? w->plan->modes : frames);
        if (!spectrum_create(&spectrum, w->lapack, w->gram, frames)) return fail_frames(error, w->motion);
        for (int k = 0; k < a->count; k++) {
            struct component *c = &a->components[k];
            const double complex *u = spectrum.vectors + (size_t)k * (size_t)frames;
            for (int t = 0; t < frames; t++) c->series[t] = u[t];
            c->explained = spectrum.values[k] / spectrum.total;
            spectrum_weights(&spectrum, k, w->weights + 2 * (size_t)k * (size_t)frames);
        }
        pool_free(&spectrum.pool);
    }
    a->pca1 = shares[0];
    a->pca2 = shares[1];
    a->real_left = sqrt(fmax(1 - shares[a->count - 1], 0));

    // From the weights of Ñ: the numbers that give the error of any time series on the whole motion.
    const size_t n = (size_t)frames, columns = 3 * (size_t)w->motion->vertices, count = (size_t)a->count;
    for (size_t k = 0; k < count; k++) {
        struct series_metric *m = &a->components[k].metric;
        const double *re = w->weights + 2 * k * n, *im = re + n;
        for (size_t t = 0; t < n; t++) {
            m->pull[t] = 0;
            for (size_t s = 0; s < n; s++) m->pull[t] += w->gram[t * n + s] * (re[s] + I * im[s]);
            m->norm += creal(m->pull[t] * (re[t] - I * im[t]));
            m->square += m->pull[t] * (re[t] + I * im[t]);
        }
        m->power = w->power;
    }
    share_motion(a, w);
    const size_t middle = (2 + PARTS) * count; // the row of the weights
    a->straight = a->left;
    if (!w->plan->straight) find_curves(a, w, w->weights + middle * n);
    for (size_t row = 0; w->middle && row <= middle; row++) { // weights of S′ become the same weights of S
        double *to = w->weights + row * n, sum = 0;
        for (size_t t = 0; t < n; t++) sum += to[t];
        for (size_t t = 0; t < n; t++) to[t] -= sum * w->middle[t];
    }

    // Ñ of every component and the middle, in a second pass over the motion, which removes the mean.
    double *combined = need((middle + 1) * columns, sizeof *combined);
    for (size_t t = 0; t < n; t++) w->weights[middle * n + t] += w->middle ? w->middle[t] : 0;
    done = slabs_combine(w->lapack, w->motion, w->plan->base, w->weights, (int)middle + 1, combined, error);
    for (size_t i = 0; done && i < columns; i++) a->middle[i / 3][i % 3] += combined[middle * columns + i];
    a->power = w->power;
    for (size_t k = 0; done && k < count; k++) {
        struct component *c = &a->components[k];
        const double *re = combined + 2 * k * columns, *im = re + columns;
        double largest = 0;
        const double *curves = combined + (2 * count + PARTS * k) * columns;
        for (size_t i = 0; i < columns; i++) {
            c->shape[i / 3][i % 3] = re[i] + I * im[i];
            if (!c->lift) continue;
            c->lift[i / 3][i % 3] = curves[i];
            c->bend[i / 3][i % 3] = curves[columns + i] + I * curves[2 * columns + i];
        }
        for (size_t t = 0; t < n; t++) largest = fmax(largest, cabs(c->series[t]));
        if (largest > 0) change_gauge(c, largest); // max |R| = 1
        component_turn(c, w->plan->direction);
        if (w->plan->method == ANALYSIS_CPCA) component_fit(c, w->plan->fps);
        component_lags(c);
    }
    free(combined);
    return done;
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
    a->middle = pool_take(&a->pool, (size_t)motion->vertices, sizeof *a->middle);
    work.gram = pool_take(&work.pool, n * n, sizeof *work.gram);
    work.weights = pool_take(&work.pool, ((2 + PARTS) * (size_t)plan->modes + 1) * n, sizeof *work.weights);
    bool done =
        slabs_gram(lapack, motion, plan->base, work.gram, a->middle[0], error) && find_components(a, &work, error);
    pool_free(&work.pool);
    if (!done) pool_free(&a->pool);
    return done;
}

// --- splines
//
// A spline's curve is linear in its knots' values: x = Σ_i v_i φ_i, where φ_i is the curve with knot i at 1 and the others at
// 0. So for given frames, frequency, damping and bandwidth the best values are linear least squares on the motion itself,
//
//     Σ_t |s_t − Re(x_t Ñ)|² = power − 2 bᵀv + vᵀA v        b_i = Σ_t Re(φ_i s_t·Ñ),  A_ij = Σ_t Re(φ_i φ̄_j |Ñ|² + φ_i φ_j Ñ·Ñ) / 2
//
// in microseconds. The rest is search, in a fixed order: add one knot after the other where it helps most, then move every frame
// and parameter in turn by shrinking steps.

static const double near_enough = 1.02;     ///< times the component's own error: no more knots needed
static const double close_enough = 1.05;    ///< likewise: no other kind of spline needed
static const double worth = 1e-4;           ///< a relative change of the error that counts
static const double half = 0.5;             ///< of what a frequency that changes explains: then one is not enough
static const double simpler = 0.97;         ///< slopes, or real mode without lags, must reduce the error to this
static const double slope_stiffness = 1000; ///< the format's default

enum { CANDIDATES = 48, HALVINGS = 5, SWEEPS = 4, EXCHANGES = 3, UNKNOWNS = 2 * KNOTS_MOST };

struct knot_search {
    const struct component *component;
    double fps;
    wiggly_solver *solver;
    double complex *response; ///< φ, UNKNOWNS × frames
    double *re, *im, *track;  ///< the frequency of every frame
};

/// x for these knots; false if the solver fails.
static bool solve_curve(const struct knot_search *s, const struct knots *k, double complex *series)
{
    wiggly_knot knots[KNOTS_MOST];
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = {.size = sizeof curve, .re = s->re, .im = s->im};
    for (int i = 0; i < k->count; i++) {
        knots[i] = (wiggly_knot){.sample = k->frame[i],
                                 .value = k->value[i],
                                 .has_slope = k->sloped,
                                 .slope = k->slope[i],
                                 .stiffness = slope_stiffness};
    }
    desc.samples = s->component->frames;
    desc.step = 1 / s->fps;
    desc.mode = k->mode;
    desc.frequency.value = k->frequency;
    if (k->last_frequency != k->frequency) desc.frequency.track = s->track;
    for (int t = 0; desc.frequency.track && t < desc.samples; t++)
        s->track[t] = k->frequency + (k->last_frequency - k->frequency) * t / (desc.samples - 1);
    desc.damping.value = k->damping;
    desc.bandwidth.value = k->bandwidth;
    desc.knots = knots;
    desc.knot_count = k->count;
    if (wiggly_solve(s->solver, &desc, &curve) >= WIGGLY_ERROR_ARGUMENT) return false;
    for (int t = 0; t < desc.samples; t++) series[t] = s->re[t] + I * s->im[t];
    return true;
}

/// Finds the best values and slopes, and their error; infinite if the solver fails.
static double evaluate_knots(const struct knot_search *s, struct knots *k)
{
    const struct series_metric *m = &s->component->metric;
    double a[UNKNOWNS * UNKNOWNS] = {0}, b[UNKNOWNS] = {0}, v[UNKNOWNS];
    int n = s->component->frames, unknowns = k->sloped ? 2 * k->count : k->count;
    k->error = HUGE_VAL;
    for (int i = 0; i < unknowns; i++) {
        double complex *x = s->response + (size_t)i * (size_t)n;
        struct knots unit = *k; // φ of value i or, after those, of a slope, scaled so that both are about as large
        memset(unit.value, 0, sizeof unit.value);
        memset(unit.slope, 0, sizeof unit.slope);
        if (i < k->count)
            unit.value[i] = 1;
        else
            unit.slope[i - k->count] = 2 * M_PI * k->frequency;
        if (!solve_curve(s, &unit, x)) return k->error;
        for (int t = 0; t < n; t++) b[i] += creal(x[t] * m->pull[t]);
        for (int j = 0; j <= i; j++) {
            const double complex *y = s->response + (size_t)j * (size_t)n;
            for (int t = 0; t < n; t++)
                a[i * unknowns + j] += (creal(x[t] * conj(y[t])) * m->norm + creal(x[t] * y[t] * m->square)) / 2;
        }
    }

    memcpy(v, b, sizeof v);
    symmetric_reduce(unknowns, unknowns, a);
    symmetric_solve(unknowns, a, v); // an unknown without effect gets 0
    double gain = 0;
    for (int i = 0; i < unknowns; i++) gain += b[i] * v[i];
    const double left = m->power - gain;
    for (int i = 0; i < k->count; i++) {
        k->value[i] = v[i];
        k->slope[i] = k->sloped ? v[k->count + i] * 2 * M_PI * k->frequency : 0;
    }
    return k->error = sqrt(fmax(left, 0) / m->power);
}

/// Keeps a change that reduces the error.
static bool keep_better(const struct knot_search *s, struct knots *k, struct knots *changed)
{
    if (!(evaluate_knots(s, changed) < k->error * (1 - worth))) return false;
    *k = *changed;
    return true;
}

/// Frames from one knot to the next. A slope right beside a neighbour would have no effect.
static int least_gap(const struct knots *k) { return k->sloped ? 3 : 1; }

/// The frequency changes by a relative step, damping and bandwidth by an absolute one. `last` is that at the end, if it differs.
static bool try_parameters(const struct knot_search *s, struct knots *k, double frequency, double last,
                           double damping, double bandwidth)
{
    struct knots changed = *k;
    const double most = s->fps / 2 / (1 + k->bandwidth);
    const bool tracked = k->last_frequency != k->frequency;
    changed.frequency = fmin(k->frequency * (1 + frequency), most);
    changed.last_frequency = tracked ? fmin(k->last_frequency * (1 + last), most) : changed.frequency;
    changed.damping = fmin(fmax(k->damping + damping, 0), 1);
    changed.bandwidth = fmin(fmax(k->bandwidth + bandwidth, 0), 1);
    return keep_better(s, k, &changed);
}

/// Tries every frame and parameter in turn while that helps, with steps that halve. The first knot stays.
static void refine_knots(const struct knot_search *s, struct knots *k, int stride)
{
    double step = 0.08;
    for (int halving = 0; halving<HALVINGS; halving++, step /= 2, stride = stride> 1 ? stride / 2 : 1) {
        bool better = true;
        for (int sweep = 0; better && sweep < SWEEPS; sweep++) {
            better = false;
            for (int sign = -1; sign <= 1; sign += 2) {
                for (int knot = 1; knot < k->count; knot++) {
                    struct knots changed = *k;
                    const int gap = least_gap(k), frame = changed.frame[knot] += sign * stride;
                    const int last = knot + 1 < k->count ? k->frame[knot + 1] - gap : s->component->frames - 1;
                    if (frame >= k->frame[knot - 1] + gap && frame <= last) better |= keep_better(s, k, &changed);
                }
                better |= try_parameters(s, k, sign * step, 0, 0, 0);
                if (k->last_frequency != k->frequency) better |= try_parameters(s, k, 0, sign * step, 0, 0);
                better |= try_parameters(s, k, 0, 0, sign * step, 0);
                if (k->mode == WIGGLY_COMPLEX) better |= try_parameters(s, k, 0, 0, 0, sign * step);
            }
        }
    }
}

/// Adds the knot that helps most, from one frame in `stride`. False if none helps.
static bool add_best_knot(const struct knot_search *s, struct knots *k, int stride)
{
    struct knots best = *k;
    int gap = least_gap(k);
    for (int frame = 1; frame < s->component->frames; frame += stride) {
        struct knots changed = *k;
        int at = k->count; // the first knot stays at 0
        while (at > 1 && k->frame[at - 1] > frame) at--;
        if (frame < k->frame[at - 1] + gap || (at < k->count && frame > k->frame[at] - gap)) continue;
        memmove(changed.frame + at + 1, changed.frame + at, (size_t)(k->count - at) * sizeof *changed.frame);
        changed.frame[at] = frame;
        changed.count++;
        keep_better(s, &best, &changed);
    }
    bool added = best.count > k->count;
    *k = best;
    return added;
}

/// Takes the other spline if it is clearly better.
static void prefer_knots(struct knots *k, const struct knots *other)
{
    if (other->error < simpler * k->error) *k = *other;
}

static double rounded(double value, double parts) { return round(value * parts) / parts; }

static void shorten_all(double *values, int count)
{
    double largest = 0;
    for (int i = 0; i < count; i++) largest = fmax(largest, fabs(values[i]));
    for (int i = 0; i < count && largest > 0; i++) values[i] = rounded(values[i], pow(10, 3 - floor(log10(largest))));
}

/// The frequencies at the first and the last frame of a swing that gets evenly faster or slower: a parabola through its phase, which is a
/// multiple of π where s_t·Ñ, turned to where most of it is real, changes its sign. False if there are too few of these.
static bool find_sweep(const struct knot_search *s, double frequency[2])
{
    enum { POWERS = 3 };
    const struct component *c = s->component;
    const size_t n = (size_t)c->frames;
    double *at = need((2 + POWERS) * n, sizeof *at), *power = at + n, *weights = power + n;
    double rise[POWERS] = {0}, before = 0;
    double complex squares = 0;
    int count = 0;
    for (size_t t = 0; t < n; t++) squares += c->metric.pull[t] * c->metric.pull[t];
    for (size_t t = 0; t < n; t++) {
        const double value = creal(c->metric.pull[t] * cexp(-I * carg(squares) / 2));
        if (t > 0 && (value > 0) != (before > 0)) at[count++] = (double)t - value / (value - before);
        before = value;
    }
    struct basis basis;
    basis_create(&basis, count, POWERS);
    for (int k = 0; k < POWERS; k++) {
        for (int i = 0; i < count; i++) power[i] = pow(at[i], k);
        basis_append(&basis, power);
    }
    basis_weights(&basis, weights);
    for (int i = 0; i < POWERS * count; i++) rise[i / count] += weights[i] * (i % count) * M_PI;
    pool_free(&basis.pool);
    free(at);
    for (int end = 0; end < 2; end++)
        frequency[end] = (rise[1] + 2 * rise[2] * end * (double)(n - 1)) * s->fps / (2 * M_PI);
    return count > POWERS && frequency[0] > 0 && frequency[1] > 0 && frequency[0] != frequency[1];
}

/// Finds knots for a swing that begins and ends with these frequencies.
static struct knots find_knots(const struct knot_search *s, wiggly_mode mode, bool sloped, const double frequency[2])
{
    const struct component *c = s->component;
    struct knots k = {.mode = mode,
                      .frequency = frequency[0],
                      .last_frequency = frequency[1],
                      .damping = c->damping,
                      .bandwidth = 0.1,
                      .count = 1,
                      .sloped = sloped};
    int stride = (c->frames + CANDIDATES - 1) / CANDIDATES;
    double floor_error = component_error(c, c->series);
    evaluate_knots(s, &k);
    while (k.error > near_enough * floor_error && k.count < KNOTS_MOST && add_best_knot(s, &k, stride))
        refine_knots(s, &k, stride);

    // Each knot but the first is tried at every frame.
    bool better = true;
    for (int round = 0; better && round < EXCHANGES && k.error > near_enough * floor_error; round++) {
        better = false;
        for (int knot = 1; knot < k.count; knot++) {
            struct knots changed = k;
            changed.count--;
            memmove(changed.frame + knot, changed.frame + knot + 1,
                    (size_t)(changed.count - knot) * sizeof *changed.frame);
            evaluate_knots(s, &changed);
            if (!add_best_knot(s, &changed, stride)) continue;
            refine_knots(s, &changed, stride);
            if (!(changed.error < k.error * (1 - worth))) continue;
            k = changed;
            better = true;
        }
    }
    return k;
}

void knots_create(struct knots *k, const struct component *component, double fps)
{
    struct knot_search s = {.component = component, .fps = fps};
    size_t n = (size_t)component->frames;
    double complex *series = need(n, sizeof *series);
    s.response = need(UNKNOWNS * n, sizeof *s.response);
    s.re = need(3 * n, sizeof *s.re);
    s.im = s.re + n;
    s.track = s.im + n;
    if (wiggly_create((int)n, KNOTS_MOST, &s.solver) != WIGGLY_OK) need_failed();
    const double one[] = {component->frequency, component->frequency};
    double sweep[2];
    *k = find_knots(&s, WIGGLY_COMPLEX, false, one);
    if (k->error > close_enough * component_error(component, component->series)) {
        const struct knots sloped = find_knots(&s, WIGGLY_COMPLEX, true, one),
                           stiff = find_knots(&s, WIGGLY_REAL, false, one);
        prefer_knots(k, &sloped);
        prefer_knots(k, &stiff);
    }
    const double explained = 1 - k->error * k->error;
    if (explained < half && find_sweep(&s, sweep)) { // nothing explains more than all
        const struct knots swept = find_knots(&s, WIGGLY_COMPLEX, false, sweep);
        if (explained < half * (1 - swept.error * swept.error)) *k = swept;
    }

    // Rounds the numbers to a thousandth of the largest, as a person would write them.
    shorten_all(k->value, k->count);
    shorten_all(k->slope, k->count);
    k->frequency = rounded(k->frequency, 1e4);
    k->last_frequency = rounded(k->last_frequency, 1e4);
    k->damping = rounded(k->damping, 1e4);
    k->bandwidth = rounded(k->bandwidth, 1e4);
    if (!solve_curve(&s, k, series)) need_failed();
    k->series = series;
    k->error = component_error(component, series);
    wiggly_destroy(s.solver);
    free(s.response);
    free(s.re);
}
