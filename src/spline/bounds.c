/// Finds which bounds of a group push, on the small dense system of its pins.
#include "spline/pin_group.h"
#include "spline/symmetric.h"
#include <float.h>
#include <math.h>
#include <string.h>

/// Smallest share of a bound's own response that the pins may leave; below, no digit is right.
static const double lost = 64 * DBL_EPSILON;

static double *reduced_row(const wiggly_group *g, int i)
{
    return g->reduced + g->rows.count * (g->rows.fixed + i) + g->rows.fixed;
}

/// The conditions of the search are the bounds; where λ holds the pins, they are S' λ ≥ want'.
static bool begin(void *user)
{
    wiggly_group *g = user;
    for (int i = 0; i < g->search.count; i++) {
        g->search.value[i] = -g->want[g->rows.fixed + i];
        g->search.is_open[i] = reduced_row(g, i)[i] > 0;
    }
    g->search.limit[0].at = 0;
    return true;
}

/// With stiffness D and its root E, (S'⁻¹ + D)⁻¹ = S' − S' E (1 + E S' E)⁻¹ E S'.
static bool factor(void *user, const double *stiffness)
{
    wiggly_group *g = user;
    const int m = g->search.count;
    for (int i = 0; i < m; i++) {
        const double *row = reduced_row(g, i);
        g->root[i] = sqrt(stiffness[i]);
        for (int j = 0; j <= i; j++) g->square[m * i + j] = (i == j) + g->root[i] * row[j] * g->root[j];
    }
    symmetric_reduce(m, m, g->square);
    return true;
}

static void solve(void *user, double *force)
{
    const wiggly_group *g = user;
    const int m = g->search.count, n = g->rows.count;
    symmetric_multiply(m, n, reduced_row(g, 0), force, g->product);
    memcpy(force, g->product, sizeof *force * (size_t)m);
    for (int i = 0; i < m; i++) g->product[i] *= g->root[i];
    symmetric_solve(m, g->square, g->product);
    for (int i = 0; i < m; i++) g->product[i] *= g->root[i];
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++)
            force[i] -= (i >= j ? reduced_row(g, i)[j] : reduced_row(g, j)[i]) * g->product[j];
    }
}

/// λ with the pushing bounds as equalities. It is right if none of them pulls and no other bound is violated; else, as nearly equal bounds are
/// hard to tell apart, the worst of these is exchanged.
static bool finish(void *user)
{
    wiggly_group *g = user;
    const int m = g->search.count, n = g->rows.count;
    double *lambda = g->lambda + g->rows.fixed;
    const double *want = g->want + g->rows.fixed;
    for (int i = 0; i < m; i++) g->presses[i] = one_sided_holds(&g->search, i) > 0;
    for (int exchanges = 0; exchanges <= m; exchanges++) {
        int count = 0, worst = -1;
        double most = g->slack;
        for (int i = 0; i < m; i++) {
            if (g->presses[i]) g->pressing[count++] = i;
        }
        for (int i = 0; i < count; i++) {
            g->product[i] = want[g->pressing[i]];
            for (int j = 0; j <= i; j++) g->square[count * i + j] = reduced_row(g, g->pressing[i])[g->pressing[j]];
        }
        symmetric_reduce(count, count, g->square);
        symmetric_solve(count, g->square, g->product);
        memset(lambda, 0, sizeof *lambda * (size_t)m);
        for (int i = 0; i < count; i++) lambda[g->pressing[i]] = g->product[i];
        symmetric_multiply(m, n, reduced_row(g, 0), lambda, g->product);
        for (int i = 0; i < m; i++) {
            const double miss = g->presses[i] ? -lambda[i] : want[i] - g->product[i];
            if (g->scale[i] > 0 && miss / g->scale[i] > most) most = miss / g->scale[i], worst = i;
        }
        if (worst < 0) {
            for (int i = 0; i < m; i++) lambda[i] = fmax(lambda[i], 0);
            return true;
        }
        g->presses[worst] = !g->presses[worst];
    }
    return false;
}

bool bounds_find_pushes(wiggly_group *g, double near_enough)
{
    const int n = g->rows.count, fixed = g->rows.fixed;
    double *a = g->reduced;
    g->slack = 0;
    for (int r = 0; r < n; r++) g->slack = fmax(g->slack, near_enough * fabs(g->want[r]));
    memcpy(a, g->system, sizeof *a * (size_t)(n * n));
    symmetric_reduce(n, fixed, a);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i && j < fixed; j++) g->want[i] -= a[n * i + j] * g->want[j];
        if (i < fixed) g->want[i] /= a[n * i + i];
    }
    for (int i = fixed; i < n; i++) { // in units of each bound's own response; 0 if the pins determine it
        const double own = a[n * i + i];
        g->scale[i - fixed] = own > lost * g->system[n * i + i] ? 1 / sqrt(own) : 0;
        g->want[i] *= g->scale[i - fixed];
    }
    for (int i = fixed; i < n; i++) {
        for (int k = fixed; k <= i; k++) a[n * i + k] *= g->scale[i - fixed] * g->scale[k - fixed];
    }
    one_sided *o = &g->search;
    o->user = g, o->begin = begin, o->factor = factor, o->solve = solve, o->finish = finish;
    o->count = n - fixed, o->limits = 1, o->limit[0].sign = 1;
    memset(g->lambda + fixed, 0, sizeof *g->lambda * (size_t)o->count);
    const bool found = one_sided_solve(o, 0);
    for (int i = fixed; i < n; i++) g->lambda[i] *= g->scale[i - fixed];
    for (int i = fixed - 1; i >= 0; i--) {
        g->lambda[i] = g->want[i];
        for (int k = i + 1; k < n; k++) g->lambda[i] -= a[n * k + i] * g->lambda[k];
        g->lambda[i] /= a[n * i + i];
    }
    return found;
}
