/// A pulled spline by the band: one solve for what it does by itself and two for each pull, with the factor that is there.
#include "spline/pull.h"
#include <string.h>

static void read_pulled(const pulled *of, double *x)
{
    const system_rows *rows = &of->solver->rows;
    for (int i = 0; i < of->pulls.count; i++) {
        const double *at = rows->x + (rows->is_complex ? 2 : 1) * (of->pulls.sample[i] - of->problem.first);
        x[2 * i] = at[0];
        x[2 * i + 1] = rows->is_complex ? at[1] : 0;
    }
}

/// What the knots and the equilibrium make of x at the pulled samples.
static bool find_alone(pulled *of, factorisation *factor, double *alone)
{
    const problem *p = &of->problem;
    problem_set_rows(of->solver, p);
    *factor = solver_factor(of->solver);
    minimum found = solver_refine(of->solver, factor);
    if (!found.solved || (found.weak && p->free_end)) return false;
    read_pulled(of, alone);
    for (int i = 0; i < of->pulls.count; i++) {
        int sample = of->pulls.sample[i];
        if (p->swing.total) alone[2 * i] += p->about[sample] - p->y[sample];
        if (p->swing.im) alone[2 * i + 1] += p->swing.im[sample];
    }
    return true;
}

bool pull_respond(pulled *of, double *compliance, double *alone)
{
    const int count = of->pulls.count, width = 2 * count;
    system_rows *rows = &of->solver->rows;
    factorisation factor;
    memset(of->pulls.pull, 0, sizeof *of->pulls.pull * (size_t)count);
    if (!find_alone(of, &factor, alone)) {
        of->problem.level_slope = true; // as for a spline by itself that nothing holds
        if (!of->problem.free_end || !find_alone(of, &factor, alone)) return false;
    }
    for (int i = 0; i < width; i++) {
        double *row = compliance + width * i;
        memset(row, 0, sizeof *row * (size_t)width);
        if (i % 2 == 1 && !rows->is_complex) continue;
        system_forget_known(rows);
        of->pulls.pull[i / 2] = (cplx){i % 2 == 0, i % 2 == 1};
        bool solved = solver_refine(of->solver, &factor).solved;
        of->pulls.pull[i / 2] = (cplx){0, 0};
        if (!solved) return false;
        read_pulled(of, row);
    }
    return true;
}
