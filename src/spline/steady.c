/// A steady spline: the mean of the solutions whose engines go by frequencies around the description's.
//
// Where knots suit a frequency badly, a curve swings wide to get through them, and a small change of a knot changes it much. A
// neighbouring frequency may suit them well. So the solutions at PARTS of them, each for itself a spline through the knots, are taken
// together. Those that hardly have to be forced count most, by a power of their energy; where all have to be, they count alike, for a
// mean that follows the least of several large energies would jump.
//
// Only the engine is detuned. What moves by itself, u and what is behind the last knot, is of the description's own frequency: it is
// the same for all, so that the mean of the solutions swings out as any spline does, from the mean at the last knot. Where the filter's
// rows go on behind that (real mode, the paper's filter), the mean of its first two samples there is run on.
#include "spline/steady.h"
#include "spline/limits.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

enum { PARTS = 5 };

static const double spread = 0.22; ///< of the frequency, on both sides
static const double easy = 0.02;   ///< of ω³ A²: an energy that makes a part count twice
static const double faint = 1e-26; ///< of Σ |w|²: an energy that may be rounding

static double fastest_of(const problem *p)
{
    double fastest;
    poles_fastest(p->desc, p->first, p->first + p->count - 1, &fastest);
    return fastest;
}

bool steady_is_set(const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (!(desc->steady > 0) || desc->mode == WIGGLY_CUBIC || desc->knot_count == 0 || p->pulls) return false;
    return fastest_of(p) > 0;
}

/// An energy that is easy to spend on these knots, in units of energy_of().
static double easy_energy(const problem *p)
{
    const double turn = fastest_of(p) * p->desc->step;
    double farthest = 0;
    for (int k = 0; k < p->desc->knot_count; k++) {
        const wiggly_knot *knot = &p->desc->knots[k];
        farthest = fmax(farthest, fabs(knot->value - problem_about(p, knot->sample)));
    }
    return easy * turn * turn * turn * farthest * farthest;
}

/// What a part's energy is; a little more than 0 wherever it is not still.
static double energy_of(wiggly_solver *solver, const problem *part, const wiggly_curve *curve)
{
    const bool is_complex = part->desc->mode == WIGGLY_COMPLEX;
    const double *re = curve->re + part->first, *im = is_complex ? curve->im + part->first : NULL;
    problem_set_rows(solver, part);
    double sum = 0;
    for (int i = 0; i < solver->rows.count; i++) sum += re[i] * re[i] + (im ? im[i] * im[i] : 0);
    double energy = system_energy(&solver->rows, re, im) / part->unit + faint * sum;
    return limits_are_set(part->desc) ? energy + solver->limits.tail_energy : energy;
}

WIDEST static void move_towards(double *restrict mean, const double *restrict x, double part, int count)
{
    for (int i = 0; i < count; i++) mean[i] += part * (x[i] - mean[i]);
}

/// The filter run on behind the sample after the last knot.
static void run_on(wiggly_solver *solver, const problem *p, wiggly_curve *curve)
{
    system_rows *rows = &solver->rows;
    const int from = p->latest + 1 - p->first, width = p->desc->mode == WIGGLY_COMPLEX ? 2 : 1;
    double *re = curve->re + p->first, *im = curve->im + p->first;
    problem_set_rows(solver, p);
    for (int k = from - 1; k <= from; k++) {
        rows->x[width * k] = re[k];
        if (width == 2) rows->x[2 * k + 1] = im[k];
    }
    solver_run_forward(solver, from);
    for (int k = from + 1; k < rows->count; k++) {
        re[k] = rows->x[width * k];
        if (width == 2) im[k] = rows->x[2 * k + 1];
    }
}

static void add_result(minimum *all, const minimum *one)
{
    all->solved = all->solved && one->solved;
    all->unrefined = all->unrefined || one->unrefined;
    all->error = fmax(all->error, one->error);
    if (one->sweeps > all->sweeps) all->sweeps = one->sweeps;
}

wiggly_status steady_find(wiggly_solver *solver, problem *p, wiggly_curve *curve, minimum *result)
{
    const bool limited = limits_are_set(p->desc), is_complex = p->desc->mode == WIGGLY_COMPLEX;
    const steady_memory *mean = &solver->steady;
    const int from = p->first, count = p->count;
    wiggly_status status = p->status;
    const double cheap = easy_energy(p);
    double weights = 0;
    *result = (minimum){.solved = true};
    for (int i = 0; i < PARTS; i++) {
        problem part = *p;
        part.detune = 1 + p->desc->steady * spread * (2.0 * i / (PARTS - 1) - 1);
        problem_set_start(solver, &part);
        minimum one = {0};
        wiggly_status found = (limited ? limits_find : problem_find)(solver, &part, curve, &one);
        if (found >= WIGGLY_ERROR_ARGUMENT) return found;
        status = found > status ? found : status;
        add_result(result, &one);
        double ratio = cheap / energy_of(solver, &part, curve), weight = 1 + ratio * ratio * ratio * sqrt(ratio);
        if (!isfinite(weight)) weight = 1; // nothing moves, or squares do not fit a double
        weights += weight;
        if (i == 0) {
            memcpy(mean->re, curve->re + from, sizeof(double) * (size_t)count);
            if (is_complex) memcpy(mean->im, curve->im + from, sizeof(double) * (size_t)count);
        }
        move_towards(mean->re, curve->re + from, weight / weights, count);
        if (is_complex) move_towards(mean->im, curve->im + from, weight / weights, count);
    }
    memcpy(curve->re + from, mean->re, sizeof(double) * (size_t)count);
    if (is_complex) memcpy(curve->im + from, mean->im, sizeof(double) * (size_t)count);
    if (limited) {
        memset(solver->limits.held, LIMITS_FREE, (size_t)p->desc->samples);
    } else if (!p->settles && p->start != WIGGLY_LOOP && p->latest + 2 < p->desc->samples) {
        run_on(solver, p, curve);
    }
    return status;
}
