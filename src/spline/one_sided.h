/// Rows that are met from one side: an active set. Internal to src/spline.
#ifndef SPLINE_ONE_SIDED_H
#define SPLINE_ONE_SIDED_H

#include <stdbool.h>

/// Room that one_sided_solve() works in.
typedef struct one_sided {
    double *factor;  ///< rows × rows
    double *now;     ///< rows, as the rest
    int *active;     ///< rows that hold, in the order in which they were taken in
    bool *is_active; ///< of each row
    bool *is_lost;   ///< of each row: those taken in before say it already
    int count;
} one_sided;

/// λ of least ½ λᵀSλ − wantᵀλ, λ_r ≥ 0 for the rows from `fixed` on; S is n × n, row-major, its lower triangle. Those of λ that are above 0
/// are where it begins. A row beyond its side by no more than `slack` counts as met.
void one_sided_solve(one_sided *work, int n, int fixed, const double *s, const double *want, double slack,
                     double *lambda);

#endif
