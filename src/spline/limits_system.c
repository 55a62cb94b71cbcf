/// The matrix of a limited spline with what is behind its last knot, for guesses: one band.
//
// Let d be what limits change. Up to the last knot L its energy is that of the spline's rows. Behind it e changes by d less what
// the motion by itself changes, by which w_L turns: Im w_L by δ. As that motion has no force but at L,
//
//     row 0: d₁ − φ δ, φ = Re w₁ of a turn by 1        row i: d_{i+1} − a_i d_i − b_i d_{i−1}, d₀ = 0
//
// which is so for constant poles; where they vary it is as near as a guess has to be.
#include "spline/limits.h"
#include <string.h>

/// The tail's rows, to where they stand behind `body` blocks.
static void set_tail(limits_work *w, int body)
{
    system_rows *rows = &w->solver->rows;
    const size_t count = (size_t)(w->tail.to - w->tail.begin);
    limits_set_tail_rows(w);
    memmove(rows->at + body, rows->at, sizeof *rows->at * count);
    memmove(rows->jet_weight + body, rows->jet_weight, sizeof *rows->jet_weight * count);
    for (size_t i = 0; i < count; i++) rows->jet_weight[(size_t)body + i] *= w->p->unit / w->tail.p.unit;
}

/// In place of the rows up to the last knot where there is none: one sample at rest.
static void set_rest(system_rows *rows)
{
    rows->count = 1;
    rows->is_complex = true, rows->loop = false;
    rows->jet_to = -1;
    rows->slope_count = 0;
    rows->start = (start_cost){0};
    rows->fixed[0] = FIXED_RE | FIXED_IM;
}

void limits_set_system(limits_work *w)
{
    const bool alone = w->p->latest < 0 && limits_has_tail(w);
    if (limits_has_tail(w)) set_tail(w, alone ? 1 : problem_rows(w->p));
    w->first = alone ? w->tail.begin : w->p->first;
    w->turn = alone || !limits_has_tail(w) ? 0 : w->solver->limits.free[1][w->tail.from];
    if (alone) {
        set_rest(&w->solver->rows);
    } else {
        problem_set_rows(w->solver, w->p);
    }
}

/// −a and −b of a row.
static double on_own(const coefficients *at) { return -2 - at->m.re; }
static double on_before(const coefficients *at) { return 1 + at->m.re + at->p.re; }

static void add_tail(const limits_work *w)
{
    const system_rows *rows = &w->solver->rows;
    pentadiagonal *m = &w->solver->matrix;
    const int last = rows->count - 1, count = w->tail.to - w->tail.begin;
    const coefficients *at = rows->at + last + 1;
    const double *weight = rows->jet_weight + last + 1;
    m->count += count;
    m->diagonal[3 * last + 2] += weight[0] * (w->turn * w->turn);
    m->below[4 * last + 1] -= weight[0] * w->turn;
    memset(m->below + 4 * (last + 1), 0, sizeof *m->below * 4 * (size_t)count);
    memset(m->below2 + 4 * (last + 1), 0, sizeof *m->below2 * 4 * (size_t)count);
    for (int i = 1; i <= count; i++) {
        double *diagonal = m->diagonal + 3 * (last + i), *below = m->below + 4 * (last + i);
        diagonal[0] = weight[i - 1], diagonal[1] = 0, diagonal[2] = 1;
        if (i < count) {
            const double own = on_own(&at[i]);
            diagonal[0] += weight[i] * (own * own);
            below[0] += weight[i] * own;
        }
        if (i + 1 < count) {
            const double own = on_own(&at[i + 1]), before = on_before(&at[i + 1]);
            diagonal[0] += weight[i + 1] * (before * before);
            below[0] += weight[i + 1] * (own * before);
            m->below2[4 * (last + i)] = weight[i + 1] * before;
        }
    }
}

void limits_set_matrix(const limits_work *w)
{
    system_matrix(&w->solver->rows, &w->solver->matrix);
    if (limits_has_tail(w)) add_tail(w);
}
