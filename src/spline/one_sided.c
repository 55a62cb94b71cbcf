/// The active set of Lawson and Hanson: take in the row that is missed most, and on the way to where all taken in are met let go what
/// would have to be pulled, the first one first.
//
// ½ λᵀSλ − wantᵀλ falls with every row that is taken in, so no set comes twice and it ends. The rows that hold are factored in
// the order in which they came: one more is one row of the factor more.
#include "spline/one_sided.h"
#include "spline/symmetric.h"
#include <math.h>
#include <string.h>

enum { ROUNDS_A_ROW = 4 };

static double entry(int n, const double *s, int i, int j) { return i >= j ? s[n * i + j] : s[n * j + i]; }

/// Rows of the factor from `from` on.
static void factor(one_sided *w, int n, const double *s, int from)
{
    for (int i = from; i < w->count; i++) {
        for (int j = 0; j <= i; j++) w->factor[n * i + j] = entry(n, s, w->active[i], w->active[j]);
        symmetric_factor_row(n, w->factor, i);
    }
}

static void take_in(one_sided *w, int n, const double *s, int row)
{
    w->is_active[row] = true;
    w->active[w->count++] = row;
    factor(w, n, s, w->count - 1);
}

/// Lets go the last one taken in.
static void lose(one_sided *w)
{
    const int row = w->active[--w->count];
    w->is_active[row] = false;
    w->is_lost[row] = true;
}

static void let_go(one_sided *w, int n, const double *s, int at)
{
    w->is_active[w->active[at]] = false;
    w->count--;
    memmove(w->active + at, w->active + at + 1, sizeof *w->active * (size_t)(w->count - at));
    factor(w, n, s, at);
}

/// Where the active rows would all be met.
static void aim(one_sided *w, int n, const double *want)
{
    for (int i = 0; i < w->count; i++) w->now[i] = want[w->active[i]];
    symmetric_solve_part(n, w->count, w->factor, w->now);
}

/// Goes there as far as no row has to be pulled; false, with the one that would, where that is not all the way.
static bool go(const one_sided *w, int fixed, double *lambda, int *blocking)
{
    double way = 1;
    *blocking = -1;
    for (int i = 0; i < w->count; i++) {
        const double from = lambda[w->active[i]], to = w->now[i];
        const double part = from > 0 ? from / (from - to) : 0;
        if (w->active[i] < fixed || to > 0 || part >= way) continue;
        way = part;
        *blocking = i;
    }
    for (int i = 0; i < w->count; i++) lambda[w->active[i]] += way * (w->now[i] - lambda[w->active[i]]);
    if (*blocking < 0) return true;
    lambda[w->active[*blocking]] = 0;
    return false;
}

/// The row that is missed most, -1: none.
static int find_missed(const one_sided *w, int n, int fixed, const double *s, const double *want, double slack,
                       const double *lambda)
{
    int at = -1;
    for (int r = fixed; r < n; r++) {
        if (w->is_active[r] || w->is_lost[r]) continue;
        double miss = want[r];
        for (int i = 0; i < w->count; i++) miss -= entry(n, s, r, w->active[i]) * lambda[w->active[i]];
        if (miss > slack) slack = miss, at = r;
    }
    return at;
}

void one_sided_solve(one_sided *w, int n, int fixed, const double *s, const double *want, double slack,
                     double *lambda)
{
    w->count = 0;
    memset(w->is_active, 0, sizeof *w->is_active * (size_t)n);
    memset(w->is_lost, 0, sizeof *w->is_lost * (size_t)n);
    for (int r = 0; r < n; r++) {
        if (r >= fixed && !(lambda[r] > 0)) continue;
        take_in(w, n, s, r);
        if (r >= fixed && isinf(w->factor[n * (w->count - 1) + w->count - 1])) lambda[r] = 0, lose(w);
    }
    for (int round = 0, row = -1; round < ROUNDS_A_ROW * n; round++) {
        int blocking;
        for (aim(w, n, want); !go(w, fixed, lambda, &blocking); aim(w, n, want)) {
            w->is_lost[w->active[blocking]] = w->active[blocking] == row; // rounding alone takes it in
            let_go(w, n, s, blocking);
        }
        row = find_missed(w, n, fixed, s, want, slack, lambda);
        if (row < 0) return;
        take_in(w, n, s, row);
        if (isinf(w->factor[n * (w->count - 1) + w->count - 1])) lose(w);
    }
}
