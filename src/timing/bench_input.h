/// The splines that the benchmark solves.
#ifndef TIMING_BENCH_INPUT_H
#define TIMING_BENCH_INPUT_H

#include <wiggly/wiggly.h>

enum bench_kind {
    BENCH_SINGLE,      ///< knots at one distance: stretches between them are alike
    BENCH_IRREGULAR,   ///< knots as people set them; and so all others
    BENCH_REST,        ///< from rest
    BENCH_EQUILIBRIUM, ///< the equilibrium moves
    BENCH_SLOPES,      ///< every other knot has a slope
    BENCH_ENDS,        ///< knots on the first and the last sample
    BENCH_END_SLOPES,  ///< these with slopes
    BENCH_LOOP,
    BENCH_TRACK,   ///< the frequency moves
    BENCH_SHORT_1, ///< one period in all
    BENCH_SHORT_2,
    BENCH_SHORT_4,
    BENCH_SHORT_8,
    BENCH_LIMITS,    ///< the curve stays within 1.02 of the largest knot
    BENCH_STEADY,    ///< the mean of five
    BENCH_VARIATION, ///< another motion through the same knots
    BENCH_EDIT,      ///< like single, of fewer knots
};

/// A description with memory of its own; knots[middle] may be changed.
struct bench_input {
    wiggly_desc desc;
    wiggly_knot *knots;
    double *track; ///< or NULL
};

/// false: out of memory.
bool bench_input_create(struct bench_input *input, enum bench_kind kind, wiggly_mode mode, int samples);

/// A copy, tracks shared.
bool bench_input_copy(struct bench_input *input, const wiggly_desc *desc);

void bench_input_destroy(struct bench_input *input);

#endif
