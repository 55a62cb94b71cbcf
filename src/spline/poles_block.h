/// The filter at many samples at once, for parameters that vary.
#ifndef SPLINE_POLES_BLOCK_H
#define SPLINE_POLES_BLOCK_H

#include "spline/poles.h"

enum { POLES_BLOCK = 64 };

typedef struct poles_block {
    double natural[POLES_BLOCK], centre[POLES_BLOCK]; ///< rad/s
    double exponent[POLES_BLOCK];                     ///< poles_weight_exponent()
    double m_re[POLES_BLOCK], m_im[POLES_BLOCK], p_re[POLES_BLOCK], p_im[POLES_BLOCK];
} poles_block;

/// Fills `count` ≤ POLES_BLOCK samples from `from` on, as poles_at() and poles_coefficients() would to the last
/// digits.
void poles_block_fill(const wiggly_desc *desc, int from, int count, double floor, poles_block *block);

/// The centres of any number of samples.
void poles_block_centres(const wiggly_desc *desc, int from, int count, double floor, double *centre);

/// out ← eˣ for |x| ≤ 700.
void poles_block_exp(const double *x, int count, double *out);

#endif
