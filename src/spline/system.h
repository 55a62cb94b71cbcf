/// The least-squares problem of one spline: its rows, before squaring (docs/mathematics.md, Energy, times h³).
///
/// Unknowns are x_0 … x_{M−1}, M = `count`, sample k of the system being sample first + k of the spline; in a loop indices
/// are taken modulo M. Rows, each with the weight by which its square enters E·h³:
///     jet     w_i     r_i = x_{i+1} − a_i x_i − b_i x_{i−1} + f_i        i = jet_from … jet_to                (eq. 25)
///     slope   w       Re(here x_j + ahead (x_{j+1} − x_j) + behind (x_j − x_{j−1})) − target                  (eq. 9)
///     start   w       on_x x_0 + on_e (x_1 − x_0), twice
///     im      w_k     Im x_k                                              complex mode
/// Outside a loop x_{−1} is 0 and x_M is (1 + tail) x_{M−1}. Fixed unknowns keep the value in x: Re x at knots, both parts at poses and at
/// rest, every Im x outside complex mode. A still knot has two jet rows, r_i with x_i for x_{i+1} and with x_i for x_{i−1}, if there are samples
/// on that side, so that its two sides are independent.
#ifndef SPLINE_SYSTEM_H
#define SPLINE_SYSTEM_H

#include "spline/poles.h"
#include <stdbool.h>
#include <stddef.h>

// --- the symmetric positive definite band A = Rᵀ W R of the rows, block-pentadiagonal and for a loop cyclic, factored as L D Lᵀ (band.c)

/// Two numbers, one for each lane of the band. Plain multiplications and additions: the same bits with and without vector registers.
typedef double twin __attribute__((vector_size(16), aligned(8), may_alias));
static inline twin both(double a) { return (twin){a, a}; }

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

// --- the rows

typedef struct slope_row {
    int sample;
    cplx here, ahead, behind;
    double weight, target;
    speed_loss loss;     ///< of its coefficients
    double target_error; ///< rounding of the target
} slope_row;

/// Pulls on x of one spline, by sample. They fix nothing, but for where a spline starts and ends, samples from the first to the last pin count
/// as knots (pins.c).
typedef struct system_pulls {
    int count;
    int earliest, latest; ///< samples of pins, -1: none
    int *sample;          ///< of the spline
    cplx *pull;           ///< on Re x and Im x: added to −½ ∇(E·h³)
} system_pulls;

typedef struct system_rows {
    int count; ///< M
    bool loop, is_complex;
    bool is_constant;     ///< all rows have the coefficients `own`, weight 1 and the imaginary weight `own_im`
    bool fast;            ///< some coefficients have a rest
    bool driven;          ///< some f_i is not 0
    bool unknown;         ///< a weight is beyond what the rows can hold: no bound is right
    int jet_from, jet_to; ///< a loop has a jet at every sample
    coefficients own;
    double own_im;
    coefficient_loss own_loss;            ///< rounding of m and p
    double *m_re, *m_im, *p_re, *p_im;    ///< of each row
    coefficient_rest *rest;               ///< of each row, if `fast`
    double *loss_m, *loss_p, *jet_weight; ///< of each row
    double *im_weight;
    cplx *drive;          ///< f_i
    double drive_error;   ///< Σ w (rounding of f)²
    double noise;         ///< rounding of known values
    double response;      ///< what the response's error may be, and with it that of known values
    double slip;          ///< what that error's misses of the rows may be: ‖W^½ R e‖
    unsigned char *fixed; ///< marks of each sample
    slope_row *slopes;    ///< by sample
    int slope_count;
    start_cost start;          ///< times calm; weights 0 if it is free
    const system_pulls *pulls; ///< or NULL
    int first;                 ///< the spline's sample of row 0, from which pulls are counted
    cplx tail;                 ///< x_M / x_{M−1} − 1, for the free motion after the last sample
    double tail_loss;          ///< rounding of that
    double *x;                 ///< 2M: re, im
    double *gradient;          ///< like x
    double *jet;               ///< scratch, 2M
} system_rows;

/// A row's coefficients on the samples j − 1, j and j + 1: `at` are their numbers, -1 if there is none.
typedef struct stencil {
    int at[3];
    cplx c[3];
} stencil;

/// A slope row as coefficients; a sample after the last is expressed by the last.
stencil system_slope_stencil(const system_rows *rows, const slope_row *slope);

/// A jet row, with its weight and its coefficients −a and −b on its own sample and the one before.
typedef struct jet_row {
    double weight;
    cplx own, before;
} jet_row;

jet_row system_jet(const system_rows *rows, int i);

/// The sample that comes `by` samples after k; a loop goes round. -1: there is none.
static inline int system_beside(const system_rows *rows, int k, int by)
{
    const int n = rows->count, at = k + by;
    if (at >= 0 && at < n) return at;
    return rows->loop ? (at + n) % n : -1;
}

/// A start's row on x_0 and x_1: the coefficient on x_0.
static inline cplx system_start_on_x(const system_rows *rows, const struct start_row *row)
{
    if (rows->count > 1) return cplx_sub(row->on_x, row->on_e);
    return cplx_add(row->on_x, cplx_mul(row->on_e, rows->tail));
}

/// A row's m and p.
static inline coefficients system_coefficients(const system_rows *rows, int i)
{
    if (rows->is_constant) return rows->own;
    coefficients c = {.m = {rows->m_re[i], rows->m_im[i]}, .p = {rows->p_re[i], rows->p_im[i]}};
    if (rows->fast) c.rest = rows->rest[i];
    return c;
}

/// What rounding does to the rows at x: see minimise.c.
typedef struct row_errors {
    double misses; ///< ‖W^½ (ΔR x − Δd)‖²
    double known;  ///< the same of the response's error in the known values
    double pulls;  ///< Σ_j √D_j (|ΔR|ᵀ W |r|)_j
} row_errors;

/// gradient = −½ ∇(E·h³) at x through the unsquared rows; `errors` as to the matrix's spread, or NULL. At a fixed unknown it is the opposite of
/// the force that holds it.
void system_gradient(const system_rows *rows, const band_matrix *matrix, row_errors *errors);

/// Sets all known values, targets and drives to 0: the solution is then the response to pulls.
void system_forget_known(system_rows *rows);

/// The squared matrix Rᵀ W R, ready to be factored.
void system_matrix(const system_rows *rows, band_matrix *matrix);

/// The same factor as band_factor() of that, but by rotations from the rows themselves, so that the condition is not squared. What is known
/// has no part in it: its pull is in the gradient. False: the rows do not determine all unknowns.
bool orthogonal_factor(const system_rows *rows, band_matrix *matrix);

#endif
