/// A shake, simulated in steps as fine as the accuracy that is asked for needs.
///
/// The whole motion is simulated twice, the second time in shorter steps. Both are compared: a scheme of second order whose steps are
/// r times shorter has 1/r² of the error, so of the finer motion it is 1/(r² − 1) of the difference. If that is too much, the
/// steps become shorter still. Where steps had to be calmed by backward Euler, of first order, it is 1/(r − 1).
///
/// A motion that is chaotic, or never damped, may need any number of steps. The search therefore has a budget of element-steps, iterations
/// of Newton's method (or a hundred of conjugate gradients, which take as long) times elements: the same on every machine. The first two simulations are made whatever they cost.
#ifndef COMMANDS_SIMULATE_SHAKE_H
#define COMMANDS_SIMULATE_SHAKE_H

#include "simulation/soft.h"

struct shake_job {
    const char *mesh, *output; ///< for messages; what is written
    struct shake shake;
    struct loads loads;
    double seconds, fps;
    double accuracy; ///< the error of the motion that is allowed, relative to its size (root mean squares)
    double budget;   ///< element-steps of the search for it
    int substeps;    ///< a frame; 0: as many as the accuracy needs
    bool world;      ///< written as seen from outside, not from the base
    bool verbose;
};

/// Simulates and writes the motion, and prints what it took. Changes no more of `soft` than its body's scratch.
bool simulate_shake(const struct shake_job *job, struct soft *soft, const struct surface *surface,
                    struct error *error);

#endif
