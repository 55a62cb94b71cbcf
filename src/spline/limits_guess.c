/// Guesses which samples a limit holds up to the last knot: the dual method of limits.c on a small matrix, what a pull on one held sample
/// does to another.
//
// The band of the system without limits is factored once; each sample that is taken in costs one solve with that factor, and the curve
// with all that pushes it another. That is as exact as the squared matrix, so that what is found is a guess: it is solved as what it is, and
// the dual method goes on from there.
#include "spline/limits.h"
#include <math.h>
#include <string.h>

enum { MOST = 48, STEPS = 4 * MOST };

static const double dependent = 1e-12; ///< of a sample's own compliance: what is left of it is rounding

typedef struct guess {
    limits_work *w;
    int count, sample[MOST];
    double side[MOST], push[MOST];
    double matrix[MOST][MOST]; ///< what a push on one moves another by, each towards the inside
    double factor[MOST][MOST]; ///< its Cholesky factor, lower
    double *moved;             ///< the total as it is pushed, by sample
    const double *alone;       ///< as it is by itself
} guess;

static int place(const guess *g, int sample)
{
    const system_rows *rows = &g->w->solver->rows;
    return (rows->is_complex ? 2 : 1) * (sample - g->w->p->first);
}

static void clear(const guess *g)
{
    const system_rows *rows = &g->w->solver->rows;
    memset(rows->gradient, 0, sizeof(double) * (size_t)((rows->is_complex ? 2 : 1) * rows->count));
}

static double excess(const guess *g, int sample, double slack)
{
    const wiggly_desc *desc = g->w->p->desc;
    const double total = g->moved[sample];
    return total > desc->high + slack ? total - desc->high : total < desc->low - slack ? total - desc->low : 0;
}

static int find_farthest(const guess *g, double slack)
{
    const limits_part *body = &g->w->body;
    double worst = 0;
    int at = -1;
    for (int i = body->from; i <= body->to; i++) {
        double by = fabs(excess(g, i, slack));
        if (by > worst && !g->w->solver->limits.held[i]) worst = by, at = i;
    }
    return at;
}

/// Rows of the Cholesky factor from one on; false where a sample can do nothing that others cannot.
static bool factor_from(guess *g, int from)
{
    for (int i = from; i < g->count; i++) {
        double *row = g->factor[i];
        for (int j = 0; j <= i; j++) {
            double sum = g->matrix[i][j];
            for (int k = 0; k < j; k++) sum -= row[k] * g->factor[j][k];
            if (i != j) {
                row[j] = sum / g->factor[j][j];
                continue;
            }
            if (!(sum > dependent * g->matrix[i][i])) return false;
            row[i] = sqrt(sum);
        }
    }
    return true;
}

/// What a push of 1 on a new sample takes off the others' for them to stay where they are; `row` is what it moves them by.
static void find_exchange(const guess *g, const double *row, double *exchange)
{
    for (int i = 0; i < g->count; i++) {
        double sum = row[i];
        for (int k = 0; k < i; k++) sum -= g->factor[i][k] * exchange[k];
        exchange[i] = sum / g->factor[i][i];
    }
    for (int i = g->count - 1; i >= 0; i--) {
        for (int k = i + 1; k < g->count; k++) exchange[i] -= g->factor[k][i] * exchange[k];
        exchange[i] /= g->factor[i][i];
    }
}

static bool let_go(guess *g, int n, double *row)
{
    const int behind = g->count - n - 1;
    g->w->solver->limits.held[g->sample[n]] = LIMITS_FREE;
    memmove(g->sample + n, g->sample + n + 1, sizeof *g->sample * (size_t)behind);
    memmove(g->side + n, g->side + n + 1, sizeof *g->side * (size_t)behind);
    memmove(g->push + n, g->push + n + 1, sizeof *g->push * (size_t)behind);
    memmove(row + n, row + n + 1, sizeof *row * (size_t)behind);
    for (int i = n; i + 1 < g->count; i++) {
        for (int j = 0; j <= i; j++) g->matrix[i][j] = g->matrix[i + 1][j < n ? j : j + 1];
    }
    g->count--;
    return factor_from(g, n);
}

/// The held sample whose push is used up first, and after how much of the new one's.
static int find_first(const guess *g, const double *exchange, double *way)
{
    int at = -1;
    for (int i = 0; i < g->count; i++) {
        if (!(exchange[i] > 0) || !(g->push[i] / exchange[i] < *way)) continue;
        *way = g->push[i] / exchange[i];
        at = i;
    }
    return at;
}

/// Takes in one sample and lets go whatever that uses up. false where rounding stands in the way.
static bool take_in(guess *g, int sample)
{
    wiggly_solver *solver = g->w->solver;
    double row[MOST], exchange[MOST], beyond = excess(g, sample, 0), side = beyond > 0 ? 1 : -1, push = 0;
    beyond = fabs(beyond);
    clear(g);
    solver->rows.gradient[place(g, sample)] = 1;
    pentadiagonal_solve(&solver->matrix, solver->rows.gradient);
    const double own = solver->rows.gradient[place(g, sample)];
    for (int i = 0; i < g->count; i++) row[i] = side * g->side[i] * solver->rows.gradient[place(g, g->sample[i])];
    for (;;) {
        find_exchange(g, row, exchange);
        double free = own;
        for (int i = 0; i < g->count; i++) free -= row[i] * exchange[i];
        if (!(free > dependent * own)) return false;
        double way = beyond / free;
        const int first = find_first(g, exchange, &way);
        for (int i = 0; i < g->count; i++) g->push[i] -= way * exchange[i];
        push += way;
        beyond -= way * free;
        if (first < 0) break;
        if (!let_go(g, first, row)) return false;
    }
    const int n = g->count++;
    memcpy(g->matrix[n], row, sizeof *row * (size_t)n);
    g->matrix[n][n] = own;
    g->sample[n] = sample, g->side[n] = side, g->push[n] = push;
    solver->limits.held[sample] = side > 0 ? LIMITS_HIGH : LIMITS_LOW;
    return factor_from(g, n);
}

static void push_all(guess *g)
{
    const wiggly_solver *solver = g->w->solver;
    const limits_part *body = &g->w->body;
    clear(g);
    for (int i = 0; i < g->count; i++) solver->rows.gradient[place(g, g->sample[i])] = -g->side[i] * g->push[i];
    pentadiagonal_solve(&solver->matrix, solver->rows.gradient);
    for (int i = body->from; i <= body->to; i++) g->moved[i] = g->alone[i] + solver->rows.gradient[place(g, i)];
}

bool limits_guess(limits_work *w, double slack)
{
    wiggly_solver *solver = w->solver;
    limits_part *body = &w->body;
    guess g = {.w = w, .moved = solver->limits.free[0], .alone = solver->limits.free[1]};
    for (int i = body->from; i <= body->to; i++)
        g.moved[i] = solver->limits.free[1][i] = problem_about(w->p, i) + w->curve->re[i];
    if (find_farthest(&g, slack) < 0) return false;
    problem_set_rows(solver, w->p);
    const factorisation factor = solver_factor(solver);
    if (!factor.squared || factor.rank != RANK_FULL) return false;
    for (int step = 0; step < STEPS && g.count < MOST; step++) {
        const int sample = find_farthest(&g, slack);
        if (sample < 0 || !take_in(&g, sample)) break;
        push_all(&g);
    }
    body->held = g.count;
    return body->held > 0;
}
