/// Fixes the gauge of a complex component and fits its frequency, damping and lags.
#include "analysis/component.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>

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

/// Ñ ← g Ñ and R ← R / g.
static void change_gauge(struct component *c, double complex g)
{
    for (int n = 0; n < 3 * c->vertices; n++) c->shape[n / 3][n % 3] *= g;
    for (int t = 0; t < c->frames; t++) {
        c->series[t] /= g;
        c->metric.pull[t] *= g;
    }
    c->metric.norm *= creal(g * conj(g));
    c->metric.square *= g * g;
}

void component_scale(struct component *c)
{
    double largest = 0;
    for (int t = 0; t < c->frames; t++) largest = fmax(largest, cabs(c->series[t]));
    if (largest > 0) change_gauge(c, largest);
}

static double complex along(const struct component *c, int vertex)
{
    const double complex *n = c->shape[vertex];
    return n[0] * c->direction[0] + n[1] * c->direction[1] + n[2] * c->direction[2];
}

/// One step of the power method, v ← M v / |M v|; false where M v is 0.
static bool power_step(double moment[3][3], double v[3])
{
    double next[3], length = 0;
    for (int i = 0; i < 3; i++) {
        next[i] = moment[i][0] * v[0] + moment[i][1] * v[1] + moment[i][2] * v[2];
        length += next[i] * next[i];
    }
    for (int i = 0; i < 3 && length > 0; i++) v[i] = next[i] / sqrt(length);
    return length > 0;
}

/// The direction with the most motion: the largest eigenvector of M = Re Σ ñ ñᴴ.
static void find_direction(const struct component *c, double direction[3])
{
    enum { STEPS = 60 };
    double moment[3][3] = {{0}}, largest = 0;
    for (int v = 0; v < c->vertices; v++) {
        for (int n = 0; n < 9; n++) moment[n / 3][n % 3] += creal(c->shape[v][n / 3] * conj(c->shape[v][n % 3]));
    }
    int axis = moment[1][1] > moment[0][0] ? 1 : 0;
    if (moment[2][2] > moment[axis][axis]) axis = 2;
    for (int i = 0; i < 3; i++) direction[i] = i == axis;
    for (int i = 0; i < STEPS && power_step(moment, direction); i++) continue;
    for (int i = 0; i < 3; i++) {
        if (fabs(direction[i]) > fabs(largest)) largest = direction[i];
    }
    for (int i = 0; i < 3; i++) direction[i] = copysign(1, largest) * direction[i];
}

static void set_direction(struct component *c, const double wanted[3])
{
    double length = wanted ? sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1] + wanted[2] * wanted[2]) : 0;
    if (!(length > 0)) {
        find_direction(c, c->direction);
        return;
    }
    for (int i = 0; i < 3; i++) c->direction[i] = wanted[i] / length;
}

void component_turn(struct component *c, const double direction[3])
{
    double complex squares = 0, sum = 0;
    set_direction(c, direction);
    for (int v = 0; v < c->vertices; v++) {
        double complex n = along(c, v);
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

static void add_point(struct slopes *s, double weight, double t, double first, double second)
{
    const double y[2] = {first, second};
    s->weight += weight;
    s->t += weight * t;
    s->tt += weight * t * t;
    for (int i = 0; i < 2; i++) {
        s->y[i] += weight * y[i];
        s->ty[i] += weight * t * y[i];
    }
}

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
        if (size > 0) add_point(&sums, size * size, t / fps, log(size), phase);
    }
    double decay = fmax(-slope(&sums, 0), 0), turning = fabs(slope(&sums, 1)), natural = hypot(decay, turning);
    c->frequency = natural / (2 * M_PI);
    c->damping = natural > 0 ? decay / natural : 0;
}

struct share {
    double lag, weight;
};

static int compare_lags(const void *a, const void *b)
{
    const struct share *x = a, *y = b;
    return (x->lag > y->lag) - (x->lag < y->lag);
}

void component_lags(struct component *c)
{
    struct share *shares = need((size_t)c->vertices, sizeof *shares);
    double total = 0, sum = 0;
    c->reach = 0;
    for (int v = 0; v < c->vertices; v++) {
        double complex n = along(c, v);
        double size = 0;
        for (int k = 0; k < 3; k++) size += creal(c->shape[v][k] * conj(c->shape[v][k]));
        c->reach = fmax(c->reach, sqrt(size));
        shares[v] = (struct share){-carg(n) * 180 / M_PI, creal(n * conj(n))};
        total += shares[v].weight;
    }
    qsort(shares, (size_t)c->vertices, sizeof *shares, compare_lags);
    c->first_lag = c->last_lag = 0;
    for (int v = 0; v < c->vertices; v++) {
        if (sum <= tail_share * total) c->first_lag = shares[v].lag;
        if (sum < (1 - tail_share) * total) c->last_lag = shares[v].lag;
        sum += shares[v].weight;
    }
    free(shares);
}
