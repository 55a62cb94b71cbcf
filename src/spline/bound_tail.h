/// The motion that bounds add after the last knot: from rest, on top of the free motion. Internal to src/spline.
#ifndef SPLINE_BOUND_TAIL_H
#define SPLINE_BOUND_TAIL_H

#include "spline/problem.h"

/// One spline's motion after its sample `begin`.
typedef struct bound_tail {
    wiggly_desc desc; ///< of the real oscillator, as the spline counts samples
    int begin, end;   ///< bounds may act on samples between these; end ≤ begin + 1: none
    bool is_complex;
    double weight;
} bound_tail;

/// How Re(c x) of a sample depends on e at the samples around it.
typedef struct tail_row {
    int sample;
    double on[3]; ///< samples before, at, after
} tail_row;

/// The tail of a posed spline.
bound_tail bound_tail_of(const problem *p, double weight);

static inline bool bound_tail_moves(const bound_tail *tail, int sample)
{
    return sample > tail->begin && sample < tail->end;
}

/// Re(c x) at a sample that it moves.
tail_row bound_tail_row(const bound_tail *tail, int sample, const double c[2]);

/// Adds e(sample) under that push on a row to e, which has room for all the spline's samples and is 0 elsewhere.
void bound_tail_press(const bound_tail *tail, const tail_row *row, double push, double *pressed, double *e);

/// Σ row · e.
double bound_tail_see(const bound_tail *tail, const tail_row *row, const double *e);

/// Adds e, and its imaginary part, to x of a solved curve.
void bound_tail_add(const bound_tail *tail, const double *e, wiggly_curve *curve);

#endif
