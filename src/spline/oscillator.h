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

/// What a step over h seconds takes from the state, I − the step, without cancellation where it is small.
static inline step_matrix oscillator_loss(oscillator o, double h)
{
    const double r2 = (o.d - sqrt(o.k)) * (o.d + sqrt(o.k)), r = sqrt(fabs(r2)), z = r2 * h * h;
    if (z > 1e-4 || r2 > 0.25 * o.d * o.d) {
        const double sum = o.d + r, difference = o.k / sum;
        const double slow = maths_expm1(-difference * h), fast = maths_expm1(-sum * h), s = 0.5 * (slow - fast) / r;
        return (step_matrix){0.5 * (difference * fast - sum * slow) / r, -s, o.k * s,
                             0.5 * (difference * slow - sum * fast) / r};
    }
    double s, versine; // sinh(rh)/r, 1 − cosh rh
    if (z < -1e-4) {
        const maths_point half = maths_turn(0.5 * r * h);
        s = 2 * half.sin * half.cos / r;
        versine = 2 * half.sin * half.sin;
    } else {
        s = h * (1 + 1.0 / 6 * z * (1 + 1.0 / 20 * z));
        versine = -0.5 * z * (1 + 1.0 / 12 * z * (1 + 1.0 / 30 * z));
    }
    const double grown = maths_expm1(-o.d * h), less = versine - grown * (1 - versine);
    s *= 1 + grown;
    return (step_matrix){less - o.d * s, -s, o.k * s, less + o.d * s};
}

/// A step over h seconds.
static inline step_matrix oscillator_step(oscillator o, double h)
{
    const step_matrix loss = oscillator_loss(o, h);
    return (step_matrix){1 - loss.q_q, -loss.q_v, -loss.v_q, 1 - loss.v_v};
}

/// The factor of q' + d q that gives the imaginary part of an oscillation on one side of the axis. It fades out where it would diverge: if ω_d
/// is slow over `seconds`, or a small share of ω_n.
static inline double oscillator_turn(oscillator o, double seconds)
{
    double omega2 = fmax(0, o.k - o.d * o.d);
    if (!(omega2 > 0)) return 0;
    double phase2 = omega2 * seconds * seconds, phase4 = phase2 * phase2, turns = phase4 * phase4;
    double part = omega2 / o.k, ratio = part * part * (part * part);
    return -ratio / ((ratio + 1e-8) * (1 + 1 / turns) * sqrt(omega2));
}

#endif
