/// Solves a spline as in a textbook: every row of the energy from docs/mathematics.md, squared into a banded matrix in quadruple precision,
/// plain L D Lᵀ. Slow, and independent of src/spline.
#ifndef TESTS_TEXTBOOK_H
#define TESTS_TEXTBOOK_H

#include <stdbool.h>
#include <wiggly/more.h>

// gcc's libquadmath. clang finds the library but has no header.
#ifndef __clang__
#include <quadmath.h>
#else
#define M_PIq 3.141592653589793238462643383279502884Q
typedef _Complex float __attribute__((mode(TC))) __complex128;
__complex128 cexpq(__complex128), conjq(__complex128);
__float128 cabsq(__complex128), cimagq(__complex128), crealq(__complex128);
__float128 cosq(__float128), coshq(__float128), expm1q(__float128), expq(__float128), fabsq(__float128);
__float128 floorq(__float128), sinhq(__float128), sinq(__float128), sqrtq(__float128);
__float128 fmaxq(__float128, __float128), fminq(__float128, __float128), powq(__float128, __float128);
#endif

typedef __float128 real;
typedef __complex128 number;

enum { TEXTBOOK_MAX = 100000, TEXTBOOK_BAND = 10 }; ///< samples; entries per matrix row up to the diagonal

/// A sample's poles, and its oscillator q″ + 2d q′ + k q = 0.
struct textbook_poles {
    number s[2];     ///< of the filter
    number p;        ///< of the oscillator alone: −d + jω_d (complex mode)
    real natural;    ///< ω_n
    real d, k, turn; ///< turn: ω_d
};

/// Poles at a sample, with a damping ratio of at least `floor`.
struct textbook_poles textbook_poles_at(const wiggly_desc *desc, int sample, real floor);

/// The speed by two poles: w′ = P w(0) + Q w(h), forward or (h < 0) backward.
struct textbook_speed {
    number P, Q;
};
struct textbook_speed textbook_speed_of(const struct textbook_poles *at, real h);

/// A problem and its solution x = u + w. The unknowns are Re w_k at 2k and Im w_k at 2k + 1, k from 0 at sample `first`.
struct textbook {
    double
        pivot; ///< least pivot of the system, as a part of its diagonal entry; of a swing in a loop, its determinant too
    double growth;     ///< max |w| relative to the input; 0 if that is 0
    bool open;         ///< nothing determines the start (in a loop: the damping), so it may be singular
    bool solved;       ///< by its matrix
    bool swing_calmed; ///< an undamped loop has almost no swing of its own: u is that of calm 0.05

    bool winds_up, settles;              ///< its motion has a direction; knots move the equilibrium
    bool is_complex, loop, rest, filter; ///< filter: the paper's filter moves by itself
    real h, calm;
    int samples, first, count; ///< domain: samples first … first + count − 1
    int earliest, last;        ///< samples of knots; −1 without knots
    int first_still;           ///< sample of the first still knot, or −1
    bool still[TEXTBOOK_MAX];  ///< per sample: has a still knot
    bool tied;                 ///< the motion after the last knot is known: the unknown there is tie·w + tie_rest
    number tie;
    real tie_rest;
    struct textbook_poles at[TEXTBOOK_MAX], swing[TEXTBOOK_MAX]; ///< of the rows; of u
    real y[TEXTBOOK_MAX], speed[TEXTBOOK_MAX];                   ///< equilibrium; (y + Re u)′
    real offset_speed[TEXTBOOK_MAX];                             ///< of what settling knots add to y
    number u[TEXTBOOK_MAX];

    int size; ///< unknowns of the system
    bool folded; ///< its samples lie as 0, P − 1, 1, P − 2 …, so that neighbours across a loop's seam are close, too
    real band[2 * TEXTBOOK_MAX][TEXTBOOK_BAND]; ///< places i and i − n at [i][n]; read with textbook_entry()
    real right[2 * TEXTBOOK_MAX], x[2 * TEXTBOOK_MAX];
    bool fixed[2 * TEXTBOOK_MAX], used[2 * TEXTBOOK_MAX];
};

/// The exact curve of a valid description: total, Re x, Im x of samples 0 … N − 1. `status` selects the problem: WIGGLY_OK as given,
/// WIGGLY_CALMED with calm 0.05 instead of 0, WIGGLY_LEVELLED also with slope 0 at the earliest knot. Returns false if it is singular: a
/// pivot of 1e-28 or less.
bool textbook_as(const wiggly_desc *desc, wiggly_status status, struct textbook *book, double *total, double *re,
                 double *im);

/// The same by the last rule of Constraints: as given, else calmed, else levelled. `status` receives which; if none works, it is
/// WIGGLY_SINGULAR and the result false.
bool textbook_curve(const wiggly_desc *desc, struct textbook *book, wiggly_status *status, double *total, double *re,
                    double *im);

/// Size of the inverse relative to the diagonal's, from four right-hand sides: of the book that was solved last. 0 if it needed no matrix.
double textbook_inverse(const struct textbook *book);

/// A matrix entry by the numbers of its unknowns.
real textbook_entry(const struct textbook *book, int row, int column);

/// The curve of a solved book's unknowns x.
void textbook_fill(struct textbook *book, double *total, double *re, double *im);

/// For e at `count` samples from the last knot on, where e is 0: −½ of its energy's gradient by a later sample, and Im e there.
real textbook_tail_pull(const struct textbook *book, const real *e, int count, int sample);
real textbook_tail_im(const struct textbook *book, const real *e, int count, int sample);

#endif
