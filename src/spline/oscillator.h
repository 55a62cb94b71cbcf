/// The free motion of a damped oscillator over a time, in closed form: q'' + 2d q' + k q = 0, for any damping.
#ifndef SPLINE_OSCILLATOR_H
#define SPLINE_OSCILLATOR_H

#include "maths/maths.h"

#include <math.h>

/// d = ζω_n and k = ω_n².
typedef struct oscillator {
    double d, k;
} oscillator;

/// The step for any state: [q q'] ← m [q q'].
typedef struct step_matrix {
    double q_q, q_v, v_q, v_v;
} step_matrix;

/// A step over h seconds.
static inline step_matrix oscillator_step(oscillator o, double h)
{
    double r2 = (o.d - sqrt(o.k)) * (o.d + sqrt(o.k)), r = sqrt(fabs(r2)), c, s; // s: sinh(rh)/r times e^{−dh}
    double decay = maths_exp(-o.d * h);
    if (r2 > 0) {
        double slow = maths_exp((r - o.d) * h), fast = maths_exp(-(r + o.d) * h);
        c = 0.5 * (slow + fast);
        s = r * h < 1e-3 ? decay * h * (1 + r2 * h * h / 6) : 0.5 * (slow - fast) / r;
    } else {
        const maths_point turn = maths_turn(r * h);
        c = decay * turn.cos;
        s = decay * (r * h < 1e-3 ? h * (1 + r2 * h * h / 6) : turn.sin / r);
    }
    return (step_matrix){c + o.d * s, s, -o.k * s, c - o.d * s};
}

/// The factor of q' + d q that gives the imaginary part of an oscillation on one side of the axis. It fades out where it would diverge: if ω_d
/// is slow over `seconds`, or a small share of ω_n.
static inline double oscillator_turn(oscillator o, double seconds)
{
    double omega2 = fmax(0, o.k - o.d * o.d);
    if (!(omega2 > 0)) return 0;
    double phase2 = omega2 * seconds * seconds, phase4 = phase2 * phase2, turns = phase4 * phase4;
    double part = omega2 / o.k, ratio = part * part * (part * part);
    return -ratio / (ratio + 1e-8) / (1 + 1 / turns) / sqrt(omega2);
}

#endif
