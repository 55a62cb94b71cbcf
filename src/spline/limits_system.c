/// The matrix of a limited spline with what is behind its last knot, for guesses: one band.
//
// Let d be what limits change. Up to the last knot L its energy is that of the spline's rows. Behind it e changes by d less what
// the motion by itself changes, φ v, where Im w_L changes by v:
//
//     row i of the tail: d_{i+1} − a_i d_i − b_i d_{i−1} − c_i v, c_i = φ_{i+1} − a_i φ_i − b_i φ_{i−1}        (d₀ = φ₀ = 0)
//
// With constant poles no c_i but c₀ is more than rounding. v is handed on from block to block, as their second number, by a stiff spring.
#include "spline/limits.h"
#include <string.h>

static const double stiff = 1e6; ///< of the first row, that spring

/// −a and −b of a row.
static double on_own(const coefficients *at) { return -2 - at->m.re; }
static double on_before(const coefficients *at) { return 1 + at->m.re + at->p.re; }

/// The tail's rows, to where they stand behind `body` blocks, c_i among the drives.
static void set_tail(limits_work *w, int body)
{
    system_rows *rows = &w->solver->rows;
    const int count = w->tail.to - w->tail.begin;
    limits_set_tail_rows(w);
    memmove(rows->at + body, rows->at, sizeof *rows->at * (size_t)count);
    memmove(rows->jet_weight + body, rows->jet_weight, sizeof *rows->jet_weight * (size_t)count);
    const double *turned = w->solver->limits.free[1] + w->tail.begin; // φ
    for (int i = 0; i < count; i++) {
        const coefficients *at = &rows->at[body + i];
        rows->jet_weight[body + i] *= w->p->unit / w->tail.p.unit;
        rows->drive[body + i].re =
            turned[i + 1] + on_own(at) * turned[i] + (i > 0 ? on_before(at) * turned[i - 1] : 0);
    }
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
    if (alone) {
        set_rest(&w->solver->rows);
    } else {
        problem_set_rows(w->solver, w->p);
    }
}

static void add_tail(const limits_work *w)
{
    const system_rows *rows = &w->solver->rows;
    pentadiagonal *m = &w->solver->matrix;
    const int last = rows->count - 1, count = w->tail.to - w->tail.begin;
    const coefficients *at = rows->at + last + 1;
    const double *weight = rows->jet_weight + last + 1, spring = stiff * weight[0];
    const cplx *turn = rows->drive + last + 1; // c
    m->count += count;
    if (!(rows->fixed[last] & FIXED_IM)) {
        m->diagonal[3 * last + 2] += weight[0] * (turn[0].re * turn[0].re) + spring;
        m->below[4 * last + 1] = -weight[0] * turn[0].re, m->below[4 * last + 3] = -spring;
    }
    memset(m->below + 4 * (last + 1), 0, sizeof *m->below * 4 * (size_t)count);
    memset(m->below2 + 4 * (last + 1), 0, sizeof *m->below2 * 4 * (size_t)count);
    for (int i = 1; i <= count; i++) {
        double *diagonal = m->diagonal + 3 * (last + i), *below = m->below + 4 * (last + i);
        diagonal[0] = weight[i - 1], diagonal[1] = 0, diagonal[2] = spring;
        if (i < count) {
            const double own = on_own(&at[i]), c = turn[i].re;
            diagonal[0] += weight[i] * (own * own), diagonal[1] -= weight[i] * (own * c);
            diagonal[2] += weight[i] * (c * c) + spring;
            below[0] += weight[i] * own, below[1] -= weight[i] * c, below[3] = -spring;
        }
        if (i + 1 < count) {
            const double own = on_own(&at[i + 1]), before = on_before(&at[i + 1]);
            diagonal[0] += weight[i + 1] * (before * before);
            below[0] += weight[i + 1] * (own * before), below[2] -= weight[i + 1] * (turn[i + 1].re * before);
            m->below2[4 * (last + i)] = weight[i + 1] * before;
        }
    }
}

void limits_set_matrix(const limits_work *w)
{
    system_matrix(&w->solver->rows, &w->solver->matrix);
    if (limits_has_tail(w)) add_tail(w);
}
