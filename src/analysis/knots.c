/// A spline's curve is linear in its knots' values: x = Σ_i v_i φ_i, where φ_i is the curve with knot i at 1 and the others at
/// 0. So for given frames, frequency, damping and bandwidth the best values are linear least squares on the motion itself,
///
///     Σ_t |s_t − Re(x_t Ñ)|² = power − 2 bᵀv + vᵀA v        b_i = Σ_t Re(φ_i s_t·Ñ),  A_ij = Σ_t Re(φ_i φ̄_j |Ñ|² + φ_i φ_j Ñ·Ñ) / 2
///
/// in microseconds. The rest is search, in a fixed order: add one knot after the other where it helps most, then move every frame
/// and parameter in turn by shrinking steps.
#include "analysis/component.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double near_enough = 1.02;     ///< times the component's own error: no more knots needed
static const double close_enough = 1.05;    ///< likewise: no other kind of spline needed
static const double worth = 1e-4;           ///< a relative change of the error that counts
static const double simpler = 0.97;         ///< slopes, or real mode without lags, must reduce the error to this
static const double slope_stiffness = 1000; ///< the format's default

enum { CANDIDATES = 48, HALVINGS = 5, SWEEPS = 4, EXCHANGES = 3, UNKNOWNS = 2 * KNOTS_MOST };

struct search {
    const struct component *component;
    double fps;
    wiggly_solver *solver;
    double complex *response; ///< φ, UNKNOWNS × frames
    double *re, *im;
};

/// x for these knots; false if the solver fails.
static bool solve(const struct search *s, const struct knots *k, double complex *series)
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
    desc.damping.value = k->damping;
    desc.bandwidth.value = k->bandwidth;
    desc.knots = knots;
    desc.knot_count = k->count;
    if (wiggly_solve(s->solver, &desc, &curve) >= WIGGLY_ERROR_ARGUMENT) return false;
    for (int t = 0; t < desc.samples; t++) series[t] = s->re[t] + I * s->im[t];
    return true;
}

/// φ of value i or, from `count` on, of slope i − count, scaled so that both are about as large.
static bool respond(const struct search *s, const struct knots *k, int unknown, double complex *series)
{
    struct knots unit = *k;
    memset(unit.value, 0, sizeof unit.value);
    memset(unit.slope, 0, sizeof unit.slope);
    if (unknown < k->count)
        unit.value[unknown] = 1;
    else
        unit.slope[unknown - k->count] = 2 * M_PI * k->frequency;
    return solve(s, &unit, series);
}

/// Solves A v = b by Cholesky; an unknown without effect gets 0. Returns bᵀv.
static double solve_unknowns(double a[UNKNOWNS][UNKNOWNS], const double *b, int count, double *v)
{
    double gain = 0;
    for (int j = 0; j < count; j++) {
        double whole = a[j][j];
        for (int k = 0; k < j; k++) a[j][j] -= a[j][k] * a[j][k];
        a[j][j] = a[j][j] > 1e-10 * whole ? sqrt(a[j][j]) : HUGE_VAL;
        for (int i = j + 1; i < count; i++) {
            for (int k = 0; k < j; k++) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] /= a[j][j];
        }
    }
    for (int i = 0; i < count; i++) {
        v[i] = b[i];
        for (int k = 0; k < i; k++) v[i] -= a[i][k] * v[k];
        v[i] /= a[i][i];
    }
    for (int i = count - 1; i >= 0; i--) {
        for (int k = i + 1; k < count; k++) v[i] -= a[k][i] * v[k];
        v[i] /= a[i][i];
    }
    for (int i = 0; i < count; i++) gain += b[i] * v[i];
    return gain;
}

/// Finds the best values and slopes, and their error; infinite if the solver fails.
static double evaluate(const struct search *s, struct knots *k)
{
    const struct series_metric *m = &s->component->metric;
    double a[UNKNOWNS][UNKNOWNS] = {{0}}, b[UNKNOWNS] = {0}, v[UNKNOWNS];
    int n = s->component->frames, unknowns = k->sloped ? 2 * k->count : k->count;
    k->error = HUGE_VAL;
    for (int i = 0; i < unknowns; i++) {
        double complex *x = s->response + (size_t)i * (size_t)n;
        if (!respond(s, k, i, x)) return k->error;
        for (int t = 0; t < n; t++) b[i] += creal(x[t] * m->pull[t]);
        for (int j = 0; j <= i; j++) {
            const double complex *y = s->response + (size_t)j * (size_t)n;
            for (int t = 0; t < n; t++)
                a[i][j] += (creal(x[t] * conj(y[t])) * m->norm + creal(x[t] * y[t] * m->square)) / 2;
        }
    }
    double left = m->power - solve_unknowns(a, b, unknowns, v);
    for (int i = 0; i < k->count; i++) {
        k->value[i] = v[i];
        k->slope[i] = k->sloped ? v[k->count + i] * 2 * M_PI * k->frequency : 0;
    }
    return k->error = sqrt(fmax(left, 0) / m->power);
}

/// Keeps a change that reduces the error.
static bool keep_better(const struct search *s, struct knots *k, struct knots *changed)
{
    if (!(evaluate(s, changed) < k->error * (1 - worth))) return false;
    *k = *changed;
    return true;
}

/// Frames from one knot to the next. A slope right beside a neighbour would have no effect.
static int least_gap(const struct knots *k) { return k->sloped ? 3 : 1; }

static bool try_frame(const struct search *s, struct knots *k, int knot, int frame)
{
    struct knots changed = *k;
    int gap = least_gap(k), last = knot + 1 < k->count ? k->frame[knot + 1] - gap : s->component->frames - 1;
    if (frame < k->frame[knot - 1] + gap || frame > last) return false;
    changed.frame[knot] = frame;
    return keep_better(s, k, &changed);
}

/// The frequency changes by a relative step, damping and bandwidth by an absolute one.
static bool try_parameters(const struct search *s, struct knots *k, double frequency, double damping,
                           double bandwidth)
{
    struct knots changed = *k;
    changed.frequency = fmin(k->frequency * (1 + frequency), s->fps / 2 / (1 + k->bandwidth));
    changed.damping = fmin(fmax(k->damping + damping, 0), 1);
    changed.bandwidth = fmin(fmax(k->bandwidth + bandwidth, 0), 1);
    return keep_better(s, k, &changed);
}

/// Tries every frame and parameter in turn while that helps, with steps that halve. The first knot stays.
static void refine(const struct search *s, struct knots *k, int stride)
{
    double step = 0.08;
    for (int halving = 0; halving<HALVINGS; halving++, step /= 2, stride = stride> 1 ? stride / 2 : 1) {
        bool better = true;
        for (int sweep = 0; better && sweep < SWEEPS; sweep++) {
            better = false;
            for (int sign = -1; sign <= 1; sign += 2) {
                for (int knot = 1; knot < k->count; knot++)
                    better |= try_frame(s, k, knot, k->frame[knot] + sign * stride);
                better |= try_parameters(s, k, sign * step, 0, 0);
                better |= try_parameters(s, k, 0, sign * step, 0);
                if (k->mode == WIGGLY_COMPLEX) better |= try_parameters(s, k, 0, 0, sign * step);
            }
        }
    }
}

/// Adds the knot that helps most, from one frame in `stride`. False if none helps.
static bool add_knot(const struct search *s, struct knots *k, int stride)
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
static void prefer(struct knots *k, const struct knots *other)
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

/// Rounds the numbers to a thousandth of the largest, as a person would write them.
static void shorten(struct knots *k)
{
    shorten_all(k->value, k->count);
    shorten_all(k->slope, k->count);
    k->frequency = rounded(k->frequency, 1e4);
    k->damping = rounded(k->damping, 1e4);
    k->bandwidth = rounded(k->bandwidth, 1e4);
}

static void remove_knot(struct knots *k, int knot)
{
    k->count--;
    memmove(k->frame + knot, k->frame + knot + 1, (size_t)(k->count - knot) * sizeof *k->frame);
}

/// Moves each knot in turn to its best frame anywhere, where refine() looks only nearby. False if nothing is better.
static bool exchange(const struct search *s, struct knots *k, int stride)
{
    bool better = false;
    for (int knot = 1; knot < k->count; knot++) {
        struct knots changed = *k;
        remove_knot(&changed, knot);
        evaluate(s, &changed);
        if (!add_knot(s, &changed, stride)) continue;
        refine(s, &changed, stride);
        if (!(changed.error < k->error * (1 - worth))) continue;
        *k = changed;
        better = true;
    }
    return better;
}

static struct knots find(const struct search *s, wiggly_mode mode, bool sloped)
{
    const struct component *c = s->component;
    struct knots k = {.mode = mode,
                      .frequency = c->frequency,
                      .damping = c->damping,
                      .bandwidth = 0.1,
                      .count = 1,
                      .sloped = sloped};
    int stride = (c->frames + CANDIDATES - 1) / CANDIDATES;
    double floor_error = component_error(c, c->series);
    evaluate(s, &k);
    while (k.error > near_enough * floor_error && k.count < KNOTS_MOST && add_knot(s, &k, stride))
        refine(s, &k, stride);
    for (int round = 0; round < EXCHANGES && k.error > near_enough * floor_error && exchange(s, &k, stride); round++)
        continue;
    return k;
}

void knots_create(struct knots *k, const struct component *component, double fps)
{
    struct search s = {.component = component, .fps = fps};
    size_t n = (size_t)component->frames;
    double complex *series = need(n, sizeof *series);
    s.response = need(UNKNOWNS * n, sizeof *s.response);
    s.re = need(2 * n, sizeof *s.re);
    s.im = s.re + n;
    if (wiggly_create((int)n, KNOTS_MOST, &s.solver) != WIGGLY_OK) need_failed();
    *k = find(&s, WIGGLY_COMPLEX, false);
    if (k->error > close_enough * component_error(component, component->series)) {
        const struct knots sloped = find(&s, WIGGLY_COMPLEX, true), stiff = find(&s, WIGGLY_REAL, false);
        prefer(k, &sloped);
        prefer(k, &stiff);
    }
    shorten(k);
    if (!solve(&s, k, series)) need_failed();
    k->series = series;
    k->error = component_error(component, series);
    wiggly_destroy(s.solver);
    free(s.response);
    free(s.re);
}

void knots_free(struct knots *k)
{
    free(k->series);
    *k = (struct knots){0};
}
