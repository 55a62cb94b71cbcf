/// A symmetric positive definite block-pentadiagonal matrix, cyclic for a loop, factored in place as L D Lᵀ in O(samples).
#ifndef SPLINE_PENTADIAGONAL_H
#define SPLINE_PENTADIAGONAL_H

#include <stdbool.h>

/// Unknowns of a loop's border, its last two samples, and their numbers for one row.
enum { BORDER_MAX = 4, BORDER_ROW = 2 * BORDER_MAX };

/// Blocks of (Re x, Im x); outside complex mode only the first number of each is used. Filled by system_matrix(), overwritten by the factor.
typedef struct pentadiagonal {
    int count; ///< block rows
    bool is_complex;
    bool cyclic;
    bool is_rooted;   ///< the diagonal holds roots [a b; 0 c]: times their transposes they are the inverses
    double *diagonal; ///< A_kk: (00, 01, 11)           → inverse of the pivot block, or its root
    double *below;    ///< A_{k+1,k}: 2×2 row-major       → L_{k+1,k}
    double *below2;   ///< A_{k+2,k}                      → L_{k+2,k}
    double *border;   ///< cyclic, of every row before the border BORDER_ROW numbers: 4×2 row-major → L_{border,k}
    double corner[BORDER_MAX][BORDER_MAX]; ///< → Cholesky factor of the eliminated corner
    double lost;                           ///< the largest ratio of a diagonal entry to its pivot
} pentadiagonal;

typedef enum pentadiagonal_rank {
    RANK_BROKEN, ///< a pivot is not positive: there is no factor
    RANK_WEAK,   ///< a pivot is lost in the rounding of its diagonal entry: solutions may be wrong
    RANK_FULL,
} pentadiagonal_rank;

/// Factors. cyclic needs count ≥ 3.
pentadiagonal_rank pentadiagonal_factor(pentadiagonal *matrix);

/// b ← A⁻¹ b, 2·count numbers; after a successful factor.
void pentadiagonal_solve(const pentadiagonal *matrix, double *b);

#endif
