/// Minimises E with the band, and bounds what rounding has done to the answer.
//
// The squared matrix is factored in double, and its solution corrected once by the gradient through the unsquared rows. With
// D = diag A⁻¹ every x_k is within
//
//     √D_k ( ‖δ‖ ρ / (1 − ρ)  +  ‖W^½ (ΔR x − Δd)‖  +  Σ_j √D_j (|ΔR|ᵀ W |r|)_j ),        ‖δ‖² = g A⁻¹ g of the last correction,
//
// of the minimum, by Cauchy and Schwarz in the norm of the energy. The first term is what the factor's own rounding leaves of a correction;
// ρ = 80 ε Σ D_k A_kk bounds it, in the trace. The others are what the rounding of the rows' coefficients, of the targets and of the known
// values may be, and does to x: residual.c sums them. No number here is fitted. (A factor of the rows themselves, for which ρ has a root
// inside the sum, is used where ρ would be too large; and where it still is, nothing is known.)
//
// An error e of the response u moves the targets of w, and adds itself to the total. But what of e is a free motion, w takes back: the error of
// u + w is the x that is 0 at the knots and minimises ‖W^½ R (x − e)‖, so it is within √D ‖W^½ R e‖ (forced_response.c), and outside the system
// within twice e more. The smaller of the two counts.
#include "maths/wide.h"
#include "spline/solver.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { CORRECTIONS = 4 };
/// ρ from which on the rows are factored, and from which on no bound is left.
static const double most_squared = 0.02, most = 0.5;
/// A correction this small, as a share of x, leaves the other terms as they are.
static const double settled = 1e-3;
/// Share of x at which a bound's first term asks for another correction.
static const double enough = 1e-10;

/// x + by; returns the largest magnitude of a part, NaN if there is one.
WIDEST static double add_change(double *restrict x, const double *restrict by, int count)
{
    enum { LANES = 8 };
    double sizes[LANES] = {0}, largest = 0;
    int i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (int n = 0; n < LANES; n++) {
            const double sum = x[i + n] + by[i + n], size = fabs(sum);
            x[i + n] = sum;
            sizes[n] = size > sizes[n] || size != size ? size : sizes[n];
        }
    }
    for (; i < count; i++) {
        x[i] += by[i];
        if (!(fabs(x[i]) <= largest)) largest = fabs(x[i]);
    }
    for (int n = 0; n < LANES; n++) largest = sizes[n] <= largest ? largest : sizes[n];
    return largest;
}

/// Puts a solution that the gradient's memory holds into x.
static void put_solution(const system_rows *rows)
{
    for (int k = 0; k < rows->count; k++) {
        if (!(rows->fixed[k] & FIXED_RE)) rows->x[2 * k] = rows->gradient[2 * k];
        if (rows->is_complex && !(rows->fixed[k] & FIXED_IM)) rows->x[2 * k + 1] = rows->gradient[2 * k + 1];
    }
}

/// x from the known values alone.
static void solve_first(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    band_matrix *m = &solver->band;
    if (m->by_rows) {
        memset(rows->gradient, 0, sizeof *rows->gradient * 2 * (size_t)rows->count);
        put_solution(rows);
        system_gradient(rows, NULL, NULL);
    } else {
        system_right_side(rows, m);
    }
    band_solve(m, rows->gradient, !m->has_spread);
    put_solution(rows);
}

/// Corrects x and bounds its error.
static minimum finish(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    band_matrix *m = &solver->band;
    minimum result = {0};
    if (!m->by_rows && !(m->rounding < most_squared)) {
        m->is_kept = false;
        if (!orthogonal_factor(rows, m)) return result;
        solve_first(solver);
    }
    for (int n = 0; n < CORRECTIONS; n++) {
        row_errors errors;
        system_gradient(rows, m, &errors);
        const double change = sqrt(fmax(band_solve(m, rows->gradient, false), 0)); // in the norm of the energy
        const double left = change * m->rounding / (1 - m->rounding);
        result.largest = add_change(rows->x, rows->gradient, 2 * rows->count);
        result.sweeps = n + 1;
        result.error = m->largest * (left + sqrt(errors.misses) + errors.pulls) +
                       fmin(m->largest * sqrt(errors.known) + rows->response,
                            m->largest * rows->slip + (rows->loop ? rows->noise : 2 * rows->response));
        // pins and bounds compare what splines do under pulls to the last digit
        const double small = rows->pulls ? DBL_EPSILON : settled;
        if (m->largest * change <= small * result.largest && m->largest * left <= enough * result.largest) break;
    }
    result.solved = result.largest < INFINITY;
    result.lost = !rows->fast && !(m->rounding < most); // jets of different weights cost digits, too
    if (!(m->rounding < most) || rows->unknown || !(result.error >= 0)) result.error = INFINITY;
    return result;
}

minimum solver_find(wiggly_solver *solver)
{
    if (!solver->band.is_factor) return (minimum){0};
    solve_first(solver);
    return finish(solver);
}

minimum solver_minimise(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    band_matrix *m = &solver->band;
    const bool is_kept = m->is_kept;
    system_matrix(rows, m);
    if (rows->count <= solver->longest_squared) {
        m->is_kept = is_kept && band_is_kept(m);
        if (m->is_kept) return solver_find(solver);
        system_right_side(rows, m);
        if (band_factor_solve(m, rows->gradient)) {
            put_solution(rows);
            band_keep(m);
            return finish(solver);
        }
    }
    if (!orthogonal_factor(rows, m)) return (minimum){0};
    return solver_find(solver);
}
