/// A spline's curve is linear in its knots' values: x = Σ_i v_i φ_i, where φ_i is the curve with knot i at 1 and the others at 0. So for given frames,
/// frequency, damping and bandwidth the best values are linear least squares on the motion itself,
///
///     Σ_t |s_t − Re(x_t Ñ)|² = power − 2 bᵀv + vᵀA v        b_i = Σ_t Re(φ_i s_t·Ñ),  A_ij = Σ_t Re(φ_i φ̄_j |Ñ|² + φ_i φ_j Ñ·Ñ) / 2
///
/// and the solver answers in microseconds. The rest is search: one knot after the other where it helps most, then every frame and parameter in
/// turn by shorter and shorter steps, all in a fixed order.
#include "analysis/knots.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double near_enough = 1.02; ///< times the component's own error: no further knot
static const double worth = 1e-4;       ///< relative change of the error that counts
static const double simpler = 0.97;     ///< real mode must be that much better than complex, which knows the lags

enum { CANDIDATES = 48, HALVINGS = 5, SWEEPS = 4 };

struct search {
    const struct component *component;
    double fps;
    wiggly_solver *solver;
    double complex *response; ///< φ, KNOTS_MOST × frames
    double *re, *im;
};

/// x with the given values; false where the solver gives up.
static bool solve(const struct search *s, const struct knots *k, const double *values, double complex *course)
{
    wiggly_knot knots[KNOTS_MOST];
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = {.re = s->re, .im = s->im};
    for (int i = 0; i < k->count; i++) knots[i] = (wiggly_knot){.sample = k->frame[i], .value = values[i]};
    desc.samples = s->component->frames;
    desc.step = 1 / s->fps;
    desc.mode = k->mode;
    desc.frequency.value = k->frequency;
    desc.damping.value = k->damping;
    desc.bandwidth.value = k->bandwidth;
    desc.knots = knots;
    desc.knot_count = k->count;
    if (wiggly_solve(s->solver, &desc, &curve) != WIGGLY_OK) return false;
    for (int t = 0; t < desc.samples; t++) course[t] = s->re[t] + I * s->im[t];
    return true;
}

/// Solves A v = b by Cholesky; a knot that does nothing gets 0. Returns bᵀv.
static double solve_values(double a[KNOTS_MOST][KNOTS_MOST], const double *b, int count, double *v)
{
    double gain = 0;
    for (int j = 0; j < count; j++) {
        double whole = a[j][j];
        for (int k = 0; k < j; k++) a[j][j] -= a[j][k] * a[j][k];
        a[j][j] = a[j][j] > 1e-12 * whole ? sqrt(a[j][j]) : HUGE_VAL;
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

/// Finds the best values and the error with them; infinite where the solver gives up.
static double evaluate(const struct search *s, struct knots *k)
{
    const struct course_metric *m = &s->component->metric;
    double a[KNOTS_MOST][KNOTS_MOST] = {{0}}, b[KNOTS_MOST] = {0};
    int n = s->component->frames;
    for (int i = 0; i < k->count; i++) {
        double unit[KNOTS_MOST] = {0};
        double complex *x = s->response + (size_t)i * (size_t)n;
        unit[i] = 1;
        if (!solve(s, k, unit, x)) return HUGE_VAL;
        for (int t = 0; t < n; t++) b[i] += creal(x[t] * m->pull[t]);
        for (int j = 0; j <= i; j++) {
            const double complex *y = s->response + (size_t)j * (size_t)n;
            for (int t = 0; t < n; t++)
                a[i][j] += (creal(x[t] * conj(y[t])) * m->norm + creal(x[t] * y[t] * m->square)) / 2;
        }
    }
    double left = m->power - solve_values(a, b, k->count, k->value);
    return k->error = sqrt(fmax(left, 0) / m->power);
}

/// Keeps a change that makes the error smaller.
static bool keep_better(const struct search *s, struct knots *k, struct knots *changed)
{
    if (!(evaluate(s, changed) < k->error * (1 - worth))) return false;
    *k = *changed;
    return true;
}

static bool try_frame(const struct search *s, struct knots *k, int knot, int frame)
{
    struct knots changed = *k;
    int last = knot + 1 < k->count ? k->frame[knot + 1] : s->component->frames;
    if (frame <= k->frame[knot - 1] || frame >= last) return false;
    changed.frame[knot] = frame;
    return keep_better(s, k, &changed);
}

/// Frequency by a relative step, damping and bandwidth by an absolute one.
static bool try_parameters(const struct search *s, struct knots *k, double frequency, double damping,
                           double bandwidth)
{
    struct knots changed = *k;
    changed.frequency = fmin(k->frequency * (1 + frequency), s->fps / 2 / (1 + k->bandwidth));
    changed.damping = fmin(fmax(k->damping + damping, 0), 1);
    changed.bandwidth = fmin(fmax(k->bandwidth + bandwidth, 0), 1);
    return keep_better(s, k, &changed);
}

/// Every frame and parameter in turn, as long as that helps, with steps that halve; the first knot stays.
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

/// Adds the knot that helps most, of one frame in `stride`. False where none does.
static bool add_knot(const struct search *s, struct knots *k, int stride)
{
    struct knots best = *k;
    for (int frame = 1; frame < s->component->frames; frame += stride) {
        struct knots changed = *k;
        int at = k->count;
        while (at > 0 && k->frame[at - 1] > frame) at--;
        if (k->frame[at - 1] == frame) continue;
        memmove(changed.frame + at + 1, changed.frame + at, (size_t)(k->count - at) * sizeof *changed.frame);
        changed.frame[at] = frame;
        changed.count++;
        keep_better(s, &best, &changed);
    }
    bool added = best.count > k->count;
    *k = best;
    return added;
}

/// The numbers as a person writes them: enough digits for a thousandth of the largest.
static void shorten(struct knots *k)
{
    double largest = 0;
    for (int i = 0; i < k->count; i++) largest = fmax(largest, fabs(k->value[i]));
    double unit = largest > 0 ? pow(10, floor(log10(largest)) - 3) : 1;
    for (int i = 0; i < k->count; i++) k->value[i] = round(k->value[i] / unit) * unit;
    k->frequency = round(k->frequency * 1e4) / 1e4;
    k->damping = round(k->damping * 1e4) / 1e4;
    k->bandwidth = round(k->bandwidth * 1e4) / 1e4;
}

static struct knots find(const struct search *s, wiggly_mode mode)
{
    const struct component *c = s->component;
    struct knots k = {.mode = mode, .frequency = c->frequency, .damping = c->damping, .bandwidth = 0.1, .count = 1};
    int stride = (c->frames + CANDIDATES - 1) / CANDIDATES;
    double floor_error = component_error(c, c->course);
    evaluate(s, &k);
    while (k.error > near_enough * floor_error && k.count < KNOTS_MOST && add_knot(s, &k, stride))
        refine(s, &k, stride);
    return k;
}

bool knots_create(struct knots *k, const struct component *component, double fps)
{
    struct search s = {.component = component, .fps = fps};
    size_t n = (size_t)component->frames;
    double complex *course = malloc(n * sizeof *course);
    s.response = malloc(KNOTS_MOST * n * sizeof *s.response);
    s.re = malloc(2 * n * sizeof *s.re);
    s.im = s.re ? s.re + n : NULL;
    bool done = course && s.response && s.re && wiggly_create((int)n, KNOTS_MOST, &s.solver) == WIGGLY_OK;
    if (done) {
        *k = find(&s, WIGGLY_COMPLEX);
        struct knots stiff = find(&s, WIGGLY_REAL);
        if (stiff.error < simpler * k->error) *k = stiff;
        shorten(k);
        done = solve(&s, k, k->value, course);
        k->course = course;
        k->error = component_error(component, course);
    }
    wiggly_destroy(s.solver);
    free(s.response);
    free(s.re);
    if (!done) free(course);
    return done;
}

void knots_free(struct knots *k)
{
    free(k->course);
    *k = (struct knots){0};
}
