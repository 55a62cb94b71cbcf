/// A shake, simulated to a requested accuracy. The motion is simulated twice, the second time with steps r times shorter. For a scheme of
/// second order the finer error is 1/(r² − 1) of the difference; if backward Euler calmed some steps, which is first order, 1/(r − 1).
/// While that is too large, steps get shorter. Chaotic or undamped motions may never get accurate, so the search has a budget of element-
/// steps: Newton iterations (or a hundred of conjugate gradients) times elements, which is the same on every machine. The first two
/// simulations always run.
#ifndef COMMANDS_SIMULATE_SHAKE_H
#define COMMANDS_SIMULATE_SHAKE_H

#include "simulation/soft.h"

struct shake_job {
    const char *mesh, *output; ///< for messages; output path
    struct shake shake;
    struct loads loads;
    double seconds, fps;
    double accuracy; ///< allowed relative RMS error
    double budget;   ///< element-steps
    int substeps;    ///< per frame; 0: by accuracy
    bool world;      ///< positions in the world, not relative to the base
    bool verbose;
};

/// How many frames are written.
int shake_frames(const struct shake_job *job);

/// Simulates, writes the motion and prints the cost. Of `soft` it changes only the body's scratch memory.
bool simulate_shake(const struct shake_job *job, struct soft *soft, const struct surface *surface,
                    struct error *error);

#endif
