/// Minimises E with the band: by one plain solve if that is accurate enough, else by iterative refinement.
//
// The squared matrix is factored once in double. The ratio of a pivot to its diagonal entry shows how many digits a knot-free stretch
// costs: G samples leave G⁻³, and G⁴ of the condition. If enough digits remain, one solve is the answer. Otherwise the gradient is
// evaluated through the unsquared rows in double-double, and A δ = gradient is solved until δ is in the last digits of x. With contraction
// ρ = |δ_n| / |δ_{n−1}| (about condition × ε) the error left is at most |δ_n| ρ / (1 − ρ). If the squared matrix has lost too much for that,
// the unsquared rows are factored, at four times the cost and with the square root of the condition.
//
// Refinement cannot see the rounding of the coefficients themselves. If the system amplifies it, the coefficients are changed by that much
// once; the change of x, solved with the existing factor, becomes part of the error.
#include "maths/maths.h"
#include "spline/dd.h"
#include "spline/solver.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { MAX_SWEEPS = 16 };
/// Estimated error, relative to the largest |x|, below which a plain solve needs no refinement, and refinement no factored rows. Below
/// the tolerance.
static const double enough_complex = 8e-9, enough_real = 2e-10;
static const double rounding = 2 * DBL_EPSILON; ///< of a coefficient
static const double unsettled = 1e-3;           ///< share of the largest |x|: an error this large counts as unknown
/// Amplifications: the most that the squared matrix shows reliably, and where rounding alone makes a result useless.
static const double largest_squared = 1e6, hopeless = 1e10;
static const double correctable = 1e-6; ///< the share of x that a plain solve may be off by before one correction
static const double too_much = 1e-1;    ///< beyond, the squared matrix does not help refinement

/// Bits of a magnitude; their order is that of the numbers, with NaN above all.
static inline int64_t bits_of(double x)
{
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits & INT64_MAX;
}

/// The largest magnitude; NaN if there is one.
WIDEST static double largest_modulus(const double *x, int count, bool is_complex)
{
    int64_t most = 0;
    for (int k = 0; k < count; k++) {
        const double re = x[2 * k], im = x[2 * k + 1];
        const int64_t bits = bits_of(is_complex ? re * re + im * im : re);
        most = bits > most ? bits : most;
    }
    double largest;
    memcpy(&largest, &most, sizeof largest);
    return is_complex ? sqrt(largest) : largest;
}

/// The relative effect of rounding on x: from the digits that the pivots have lost, and from the knot-free stretch of G samples, whose
/// condition is G⁴ / 31 if nothing swings back.
static double estimated_error(const system_rows *rows, const pentadiagonal *m)
{
    double g2 = rows->stretch * rows->stretch;
    return (rows->is_complex ? 40 : 16) * DBL_EPSILON * fmax(maths_exp(4.0 / 3 * maths_log(m->lost)), g2 * g2 / 31);
}

static double enough(const system_rows *rows) { return rows->is_complex ? enough_complex : enough_real; }

static factorisation factor_rows(wiggly_solver *solver)
{
    return (factorisation){.rank = orthogonal_factor(&solver->rows, &solver->matrix), .error = INFINITY};
}

factorisation solver_factor(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    factorisation f = {.rank = RANK_BROKEN, .squared = true, .error = INFINITY};
    if (rows->count <= solver->longest_squared) {
        system_matrix(rows, &solver->matrix);
        f.rank = pentadiagonal_factor(&solver->matrix);
        if (f.rank != RANK_BROKEN) f.error = estimated_error(rows, &solver->matrix);
        // If some jets weigh much more than others, the light ones are lost in it, and no correction shows that.
        if (f.error <= (rows->fast ? enough(rows) : too_much) || rows->count < 3) return f;
    }
    return factor_rows(solver);
}

static void solve(wiggly_solver *solver) { pentadiagonal_solve(&solver->matrix, solver->rows.gradient); }

/// z plus a share of it; rounding never makes a real number complex.
static cplx changed(cplx z, cplx part)
{
    if (z.im == 0) part.im = 0;
    return cplx_add(z, cplx_mul(part, z));
}

/// The change of x when the coefficients change by these shares.
static double change_of(wiggly_solver *solver, cplx of_m, cplx of_p, double of_others)
{
    system_rows *rows = &solver->rows;
    for (int k = 0; k < rows->count; k++) {
        coefficients *at = &rows->at[k];
        if (at->a_rest.re != 0 || at->b_rest.re != 0) {
            const cplx a = coefficients_a(at), b = coefficients_b(at);
            at->a_rest = cplx_add(at->a_rest, cplx_sub(changed(a, of_m), a));
            at->b_rest = cplx_add(at->b_rest, cplx_sub(changed(b, of_p), b));
            continue;
        }
        at->m = changed(at->m, of_m);
        at->p = changed(at->p, of_p);
    }
    for (int s = 0; s < rows->slope_count; s++) {
        rows->slopes[s].here = cplx_scale(1 + of_others, rows->slopes[s].here);
    }
    for (int i = 0; i < 2; i++) rows->start.row[i].on_x = cplx_scale(1 + of_others, rows->start.row[i].on_x);
    system_gradient(rows);
    solve(solver);
    return largest_modulus(rows->gradient, rows->count, rows->is_complex);
}

/// Changes known values, targets and drives as if the equilibrium were rounded differently, with alternating or equal signs; drives of equal
/// poles alike.
static void change_known(system_rows *rows, double sign)
{
    double now = 1, of_drive = rounding;
    for (int k = 0; k < rows->count && rows->noise > 0; k++) {
        if (rows->fixed[k] & FIXED_RE) rows->x[2 * k] += (now *= sign) * rows->noise;
        if (k > 0 && (rows->at[k].p.re != rows->at[k - 1].p.re || rows->at[k].p.im != rows->at[k - 1].p.im))
            of_drive = k * 7 % 5 < 2 ? -rounding : rounding;
        rows->at[k].g = cplx_scale(1 + of_drive, rows->at[k].g);
    }
    for (int s = 0; s < rows->slope_count; s++) rows->slopes[s].target += rows->noise;
}

/// A fixed pseudorandom sign for each unknown.
static double some_sign(const system_rows *rows, int unknown)
{
    return (rows->is_complex ? unknown : unknown / 2) * 7 % 5 < 2 ? -1 : 1;
}

/// Whether an unknown is fixed.
static bool is_known(const system_rows *rows, int unknown)
{
    return rows->fixed[unknown / 2] & (unknown % 2 ? FIXED_IM : FIXED_RE);
}

/// The change of x by the rounding of the jets' pulls, if these are much larger than everything else.
static double change_by_jets(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    for (int i = 0; i < 2 * rows->count; i++) {
        const double pull = rows->jet_weight[i / 2] * rows->x[i];
        rows->gradient[i] = is_known(rows, i) ? 0 : some_sign(rows, i) * rounding * pull;
    }
    solve(solver);
    return largest_modulus(rows->gradient, rows->count, rows->is_complex);
}

/// In a loop without knots p x balances the drives' sum; if poles vary, each drive is rounded on its own.
static double change_by_drives(const system_rows *rows)
{
    double drives = 0, first = rows->at[0].p.re;
    cplx p = {0, 0};
    bool vary = false, held = false;
    for (int k = 0; k < rows->count; k++) {
        drives += sqrt(cplx_norm(rows->drive[k]));
        p = cplx_add(p, rows->at[k].p);
        vary = vary || rows->at[k].p.re != first;
        held = held || rows->fixed[k] & FIXED_RE;
    }
    return vary && !held ? DBL_EPSILON * drives / sqrt(cplx_norm(p)) : 0;
}

/// How far x would move if the coefficients were rounded differently, in the poles' decay and in their turn, and by what the equilibrium
/// takes off the knots.
static double sensitivity(wiggly_solver *solver)
{
    const cplx none = {0, 0}, parts[2] = {{rounding, 0}, {0, rounding}};
    const double heavy = solver->rows.fast ? change_by_jets(solver) : 0;
    double change = 0;
    for (int i = 0; i < (solver->rows.is_complex ? 2 : 1); i++) { // m and p separately: together they may cancel
        change_known(&solver->rows, i ? 1 : -1);
        change += change_of(solver, parts[i], none, i ? 0 : rounding);
        change += change_of(solver, none, parts[i], 0);
    }
    if (solver->rows.loop && solver->rows.driven) change += change_by_drives(&solver->rows);
    return 48 * change + 4 * heavy;
}

/// The jets' and the imaginary row's part of the squared matrix's diagonal, if the domain has ends.
static double size_of(const system_rows *rows, int k, bool imaginary)
{
    double size = imaginary ? rows->im_weight[k] : 0;
    for (int i = k - 1; i <= k + 1; i++) {
        if (i < rows->jet_from || i > rows->jet_to) continue;
        const coefficients *at = &rows->at[i];
        size += rows->jet_weight[i] * (i < k ? 1 : cplx_norm(i > k ? coefficients_b(at) : coefficients_a(at)));
    }
    return size;
}

/// For a system held only by knots and jets: how many times the rows' error x's may be. If poles fade, no pivot need be small for that,
/// because each row then knows only its neighbour.
static double amplification(wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    double largest = 0;
    for (int i = 0; i < 2 * rows->count; i++) {
        rows->gradient[i] = is_known(rows, i) ? 0 : some_sign(rows, i) * sqrt(size_of(rows, i / 2, i % 2));
    }
    solve(solver);
    for (int i = 0; i < 2 * rows->count; i++)
        largest = fmax(largest, fabs(rows->gradient[i]) * sqrt(size_of(rows, i / 2, i % 2)));
    return sqrt(largest);
}

/// Corrects a plain solve once, in double. False if it had lost so many digits that this is not enough.
static bool correct(wiggly_solver *solver, minimum *result)
{
    const system_rows *rows = &solver->rows;
    system_right_side(rows);
    solve(solver);
    const double change = largest_modulus(rows->gradient, rows->count, rows->is_complex);
    if (!(change <= correctable * result->largest)) return false;
    for (int i = 0; i < 2 * rows->count; i++) rows->x[i] += rows->gradient[i];
    result->error = 4 * change * (change / result->largest);
    return true;
}

/// Refines x, starting from the known values alone. False if a number overflowed.
static bool refine(wiggly_solver *solver, const factorisation *f, minimum *result)
{
    system_rows *rows = &solver->rows;
    double before = INFINITY;
    for (result->sweeps = 0; result->sweeps < MAX_SWEEPS;) {
        if (result->sweeps == 0) {
            system_right_side(rows);
        } else {
            system_gradient(rows);
        }
        solve(solver);
        bool first = result->sweeps == 0;
        double change = first ? 0 : largest_modulus(rows->gradient, rows->count, rows->is_complex);
        if (!(change < INFINITY)) return false;
        if (change > 0.5 * before) { // at the last digit or not converging: keep x
            result->error = 4 * fmax(change, before);
            break;
        }
        for (int i = 0; i < 2 * rows->count; i++) rows->x[i] += rows->gradient[i];
        result->sweeps++;
        result->largest = largest_modulus(rows->x, rows->count, rows->is_complex);
        if (!(result->largest < INFINITY)) return false;
        if (first) change = result->largest;
        double contraction = before < INFINITY ? change / before : 0.5;
        result->error = change * contraction / (1 - contraction);
        // The first solve uses the rows' factor but a right-hand side in double. It may be all wrong, and the next one right.
        before = f->squared || result->sweeps > 1 ? change : INFINITY;
        if (result->sweeps == 1 && rows->is_held && f->error <= enough(rows) &&
            (!rows->is_tested || correct(solver, result))) {
            result->error = (rows->is_tested ? result->error : 0) + f->error * result->largest;
            result->unrefined = true;
            return true;
        }
        if (before < INFINITY && result->error <= 1e-15 * result->largest) break;
    }
    return true;
}

/// How far the rows' own factor would move x. It loses other digits than the squared matrix, whose factor is restored afterwards.
static double error_by_rows(wiggly_solver *solver, factorisation *f)
{
    const system_rows *rows = &solver->rows;
    const factorisation other = factor_rows(solver);
    double change = INFINITY;
    if (other.rank != RANK_BROKEN) {
        system_gradient(rows);
        solve(solver);
        change = largest_modulus(rows->gradient, rows->count, rows->is_complex);
    }
    *f = solver_factor(solver);
    return change;
}

/// Sets all unknowns to 0.
static void reset(const system_rows *rows)
{
    for (int i = 0; i < 2 * rows->count; i++) {
        if (!is_known(rows, i)) rows->x[i] = 0;
    }
}

minimum solver_refine(wiggly_solver *solver, factorisation *f)
{
    const system_rows *rows = &solver->rows;
    minimum result = {0};
    if (f->rank != RANK_BROKEN) result.solved = refine(solver, f, &result);
    const bool open = rows->is_open && rows->count >= 3;
    bool settled = result.solved && result.error <= enough(rows) * result.largest;
    if (open && f->squared && settled) settled = amplification(solver) <= largest_squared;
    if (f->squared && !settled && rows->count >= 3) {
        reset(rows);
        *f = factor_rows(solver);
        result = (minimum){0};
        if (f->rank == RANK_BROKEN) return result;
        result.solved = refine(solver, f, &result);
    }
    if (!result.solved) return result;
    if (f->squared && rows->unlike && rows->count >= 3) {
        result.error += fmin(4 * error_by_rows(solver, f), result.largest);
        result.unrefined = false; // more sweeps would make it worse
    }
    const bool settles = result.error <= unsettled * result.largest;
    result.weak = !rows->fast && (f->rank == RANK_WEAK || !settles); // jets of different weights cost digits, too
    if (rows->cut) result.error += result.largest;
    const double amplified = open && !f->squared ? amplification(solver) : 0;
    if (amplified > hopeless) {
        result.error += rounding * amplified * result.largest;
        result.weak = result.weak || result.error > unsettled * result.largest;
    }
    return result;
}

/// How far x would move if speeds whose coefficients are cut were seen as they are: from another side, and by any heavier row.
static double change_by_cut(wiggly_solver *solver)
{
    system_rows *rows = &solver->rows;
    const cplx cut = {rows->steep, rows->steep};
    for (int s = 0; s < rows->slope_count; s++) {
        slope_row *row = &rows->slopes[s];
        const cplx both = cplx_add(row->ahead, row->behind);
        row->here = cplx_add(cplx_scale(2, row->here), cplx_mul(cut, both));
        row->ahead = cplx_scale(2, row->ahead), row->behind = cplx_scale(2, row->behind);
    }
    for (int i = 0; i < 2; i++) {
        struct start_row *row = &rows->start.row[i];
        row->on_x = cplx_add(cplx_scale(2, row->on_x), cplx_mul(cut, row->on_e));
        row->on_e = cplx_scale(2, row->on_e);
    }
    if (rows->tail.re != 0 || rows->tail.im != 0) rows->tail = cplx_add(rows->tail, cut);
    system_gradient(rows);
    solve(solver);
    return largest_modulus(rows->gradient, rows->count, rows->is_complex);
}

minimum solver_minimise(wiggly_solver *solver)
{
    factorisation f = solver_factor(solver);
    minimum result = solver_refine(solver, &f);
    if (!result.solved) return result;
    if (!result.unrefined) result.error += sensitivity(solver);
    if (solver->rows.steep > 0) result.error += 8 * change_by_cut(solver);
    return result;
}

void solver_run_forward(wiggly_solver *solver, int from)
{
    system_rows *rows = &solver->rows;
    // x is a double sum of small steps; double-double keeps the rounding of N² additions below its last digit.
    const double *before = rows->x + 2 * (from - 1);
    dd re = dd_from(before[2]), im = dd_from(before[3]);
    dd step_re = dd_difference(before[2], before[0]), step_im = dd_difference(before[3], before[1]);
    for (int i = from; i < rows->count - 1; i++) {
        const coefficients at = rows->at[i];
        const cplx step = {step_re.hi, step_im.hi}, behind = {re.hi - step.re, im.hi - step.im};
        const cplx more = cplx_sub(cplx_sub(cplx_mul(at.m, step), cplx_mul(at.p, behind)), rows->drive[i]);
        step_re = dd_add(step_re, dd_from(more.re)), step_im = dd_add(step_im, dd_from(more.im));
        re = dd_add(re, step_re), im = dd_add(im, step_im);
        rows->x[2 * i + 2] = re.hi, rows->x[2 * i + 3] = im.hi;
    }
}
