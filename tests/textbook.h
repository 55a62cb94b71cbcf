/// The spline as a textbook would solve it: every row of the energy written out from docs/mathematics.md, squared into a banded matrix
/// in quadruple precision, plain L D Lᵀ. Slow, and as independent of src/spline as can be.
#ifndef TESTS_TEXTBOOK_H
#define TESTS_TEXTBOOK_H

#include "quad_math.h"
#include <stdbool.h>
#include <wiggly/more.h>

enum { TEXTBOOK_MAX = 4096, TEXTBOOK_BAND = 10 }; ///< samples; entries of a matrix row up to its diagonal

/// One sample's poles, and its oscillator q″ + 2d q′ + k q = 0.
struct textbook_poles {
    number s[2];     ///< of the filter
    number p;        ///< of the oscillator alone: −d + jω_d (complex mode)
    real natural;    ///< ω_n
    real d, k, turn; ///< turn: ω_d
};

/// A problem and its answer x = u + w. The system's unknowns are Re w_k at 2k and Im w_k at 2k + 1, k from 0 at sample `first`.
struct textbook {
    double
        pivot; ///< least pivot of the system, as a part of its diagonal entry; of a swing in a loop, its determinant too
    double inverse;    ///< how large the inverse is beside the diagonal's, by four right-hand sides
    double growth;     ///< max |w| over the scale of what was asked; 0 where that is 0
    bool open;         ///< nothing holds the start (in a loop: the damping), so the problem may be singular
    bool swing_calmed; ///< a loop without damping has no swing of its own to speak of: u is that of calm 0.05

    bool is_complex, loop, rest, filter; ///< filter: what moves by itself is the paper's filter
    real h, calm;
    int samples, first, count; ///< the domain: samples first … first + count − 1
    int earliest, last;        ///< knots' samples; −1 without knots
    int first_still;           ///< sample of the first still knot, or −1
    bool still[TEXTBOOK_MAX];  ///< whether a sample is a still knot's
    bool tied;                 ///< the motion after the last knot is given: the unknown there is tie·w + tie_rest
    number tie;
    real tie_rest;
    struct textbook_poles at[TEXTBOOK_MAX], swing[TEXTBOOK_MAX]; ///< the rows'; those of u
    real y[TEXTBOOK_MAX], speed[TEXTBOOK_MAX];                   ///< equilibrium; (y + Re u)′
    number u[TEXTBOOK_MAX];

    real band[2 * TEXTBOOK_MAX]
             [TEXTBOOK_BAND]; ///< by textbook_place(): entry (i, i − n) at [i][n]; read with textbook_entry()
    real right[2 * TEXTBOOK_MAX], x[2 * TEXTBOOK_MAX];
    bool fixed[2 * TEXTBOOK_MAX], used[2 * TEXTBOOK_MAX];
};

/// The exact curve of a valid description: total, Re x, Im x of samples 0 … N − 1. `status` says what to solve: WIGGLY_OK as asked,
/// WIGGLY_CALMED with calm 0.05 in place of 0, WIGGLY_LEVELLED with a level slope at the earliest knot besides. false where that is
/// singular: a pivot of 1e-28 or less.
bool textbook_as(const wiggly_desc *desc, wiggly_status status, struct textbook *book, double *total, double *re,
                 double *im);

/// The same by the last rule of Constraints: as asked, else calmed, else levelled; `status` receives which (WIGGLY_SINGULAR and
/// false: none of them).
bool textbook_curve(const wiggly_desc *desc, struct textbook *book, wiggly_status *status, double *total, double *re,
                    double *im);

/// An entry of the matrix, by the numbers of its unknowns.
real textbook_entry(const struct textbook *book, int row, int column);

/// The curve that the unknowns x of a solved book stand for.
void textbook_fill(struct textbook *book, double *total, double *re, double *im);

/// Of e at `count` samples from the last knot on, where it is 0: −½ of its energy's gradient by a later sample, and Im e there.
real textbook_tail_pull(const struct textbook *book, const real *e, int count, int sample);
real textbook_tail_im(const struct textbook *book, const real *e, int count, int sample);

#endif
