/// The symmetric positive definite band A = Rᵀ W R of a system's rows, block-pentadiagonal and for a loop cyclic, factored as L D Lᵀ.
#ifndef SPLINE_BAND_H
#define SPLINE_BAND_H

#include <stdbool.h>
#include <stddef.h>

/// Two numbers, one for each lane of the band. Plain multiplications and additions: the same bits with and without vector registers.
typedef double twin __attribute__((vector_size(16), aligned(8), may_alias));

/// Unknowns of the dense block in which both ends meet: three samples, and the two of a loop's seam.
enum { BAND_DENSE = 10 };

/// Numbers a sample that a factor needs at most, and of them those of a loop's seam.
enum { BAND_RECORD = 13, BAND_SEAM = 8 };

/// Sample k's part of the matrix: A_kk (00 01 11), A_{k+1,k} and A_{k+2,k} (2×2 row-major). Outside complex mode the first number of each.
typedef struct band_block {
    double d[3], e[4], f[4];
} band_block;

/// What is known of a sample.
enum {
    FIXED_RE = 1,
    FIXED_IM = 2,
    FIXED_STILL = 4, ///< at rest: two jets, and its two sides are independent
    JET_TWICE = 8,   ///< its jet counts twice
    BAND_OWN = 16,   ///< its block is its own
    BAND_BESIDE = 32 ///< its own is that of this sample or of one of the two before
};

typedef struct band_matrix {
    int count; ///< samples
    bool is_complex, cyclic;
    bool is_alike;   ///< samples without a block of their own share one
    bool is_factor;  ///< a factor, of rows if by_rows
    bool by_rows;    ///< of the rows: nothing was squared
    bool is_kept;    ///< a factor that may be of the next matrix, too
    bool has_spread; ///< `spread` and `rounding` are those of the factor
    unsigned char *marks;
    band_block alike;
    double *d, *e_re, *e_im, *f_re, *f_im; ///< if they are not alike: a real diagonal and complex couplings
    const double *im_weight;               ///< added to the diagonal of Im x; or NULL
    const double *stiffness;               ///< added to that of Re x; or NULL
    band_block *own;
    band_block kept_alike, *kept_own; ///< of the matrix that the factor is of
    unsigned char *kept_marks;
    int kept_shape;
    double *record, *seam; ///< the factor, two samples at a time
    double dense[BAND_DENSE][BAND_DENSE], dense_inverse[BAND_DENSE];
    double *
        spread; ///< of each sample D, the sum of both parts' (A⁻¹)_kk, and that of its difference to the sample before
    double largest;  ///< the largest √D
    double rounding; ///< ρ: a bound of ‖Â^{−½}(Â − A)Â^{−½}‖, for the factor Â that rounding left
} band_matrix;

/// Remembers what the factor is of, and whether the matrix is that again; of matrices that are alike.
void band_keep(band_matrix *band);
bool band_is_kept(const band_matrix *band);

/// A sample's block.
band_block band_block_at(const band_matrix *band, int k);

/// Gives a sample a block of its own, at first the usual one.
band_block *band_own(band_matrix *band, int k);

/// Factors. False: a pivot is not positive.
bool band_factor(band_matrix *band);

/// Solves in place: `x` is the right side, re, im of each sample, then the solution, 0 where a value is known. Returns b·A⁻¹b. With `spread` it
/// finds that, `largest` and `rounding` on the way.
double band_solve(band_matrix *band, double *x, bool spread);

/// band_factor() and that, with the spread.
bool band_factor_solve(band_matrix *band, double *x);

// --- the factor's storage, for those who factor the rows ---

/// Samples before a loop's seam; those that each end eliminates; the samples between.
static inline int band_interior(const band_matrix *b) { return b->cyclic ? b->count - 2 : b->count; }
static inline int band_steps(const band_matrix *b)
{
    const int n = band_interior(b);
    return n < 4 ? 0 : (n - 2) / 2;
}
static inline int band_middle(const band_matrix *b) { return band_interior(b) - 2 * band_steps(b); }

/// A row U of a triangular factor with pivot u[0]: of a sample's part, coupled to its other part, the next two samples, and the seam.
void band_put_row(band_matrix *band, int step, int lane, int part, const double *u, const double *seam);

/// The dense block's triangular factor, and the spread of a factor put so.
void band_put_dense(band_matrix *band, double u[BAND_DENSE][BAND_DENSE]);

#endif
