/// Minimises E by iterative refinement.
//
// min E by iterative refinement: the squared matrix is factored once in double (on a long domain the un-squared rows are, at twice
// the cost and with the square root of the condition), the gradient is evaluated through the
// un-squared rows in double-double, and A δ = gradient is solved until δ says that x is right to its last digits. With
// contraction ρ = |δ_n| / |δ_{n−1}| (about condition × ε) the error left is at most |δ_n| ρ / (1 − ρ).
#include "spline/orthogonal.h"
#include "spline/solver.h"
#include <math.h>

enum { MAX_SWEEPS = 16 };

static double largest_modulus(const double *x, int count, bool is_complex)
{
    double largest = 0;
    for (int k = 0; k < count; k++) {
        double size = is_complex ? hypot(x[2 * k], x[2 * k + 1]) : fabs(x[k]);
        if (!(size <= largest)) largest = size; // takes NaN too
    }
    return largest;
}

minimum solver_minimise(wiggly_solver *solver)
{
    system_rows *rows = &solver->rows;
    minimum result = {0};
    bool is_long = rows->count > solver->longest_squared;
    if (!is_long) system_matrix(rows, &solver->matrix);
    pentadiagonal_rank rank =
        is_long ? orthogonal_factor(rows, &solver->matrix, solver->stop) : pentadiagonal_factor(&solver->matrix);
    if (rank == RANK_BROKEN) return result;
    result.weak = rank == RANK_WEAK;
    int unknowns = rows->count * (rows->is_complex ? 2 : 1);
    double before = INFINITY;
    while (result.sweeps < MAX_SWEEPS) {
        if (solver_must_stop(solver->stop)) return result;
        system_gradient(rows);
        if (is_long) {
            orthogonal_solve(&solver->matrix, rows->gradient);
        } else {
            pentadiagonal_solve(&solver->matrix, rows->gradient);
        }
        double change = largest_modulus(rows->gradient, rows->count, rows->is_complex);
        if (!(change < INFINITY)) return result;
        if (change > 0.5 * before) { // at the last digit, or not converging: x stays as it was
            result.error = fmax(change, before);
            break;
        }
        for (int i = 0; i < unknowns; i++) rows->x[i] += rows->gradient[i];
        result.sweeps++;
        result.largest = largest_modulus(rows->x, rows->count, rows->is_complex);
        double contraction = before < INFINITY ? change / before : 0.5;
        result.error = change * contraction / (1 - contraction);
        before = change;
        if (result.error <= 1e-15 * result.largest) break;
    }
    result.solved = result.largest < INFINITY;
    if (result.error > 1e-6 * result.largest) result.weak = true; // it never settled
    return result;
}

void solver_run_forward(wiggly_solver *solver)
{
    system_rows *rows = &solver->rows;
    int width = rows->is_complex ? 2 : 1;
    // x is a double sum of small steps: extended precision keeps the rounding of N² additions below the last digit of x.
    long double x_re = rows->x[width], x_im = 0, step_re = x_re, step_im = 0;
    for (int i = 1; i < rows->count - 1; i++) {
        coefficients at = rows->at[i];
        long double before_re = x_re - step_re, before_im = x_im - step_im;
        long double re = step_re + (at.m.re * step_re - at.m.im * step_im) -
                         (at.p.re * before_re - at.p.im * before_im) - rows->drive[i].re;
        long double im = step_im + (at.m.re * step_im + at.m.im * step_re) -
                         (at.p.re * before_im + at.p.im * before_re) - rows->drive[i].im;
        step_re = re, step_im = im;
        x_re += step_re, x_im += step_im;
        rows->x[width * (i + 1)] = (double)x_re;
        if (rows->is_complex) rows->x[width * (i + 1) + 1] = (double)x_im;
    }
}
