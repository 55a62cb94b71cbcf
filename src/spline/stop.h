/// Ending a long solve from another thread, when nobody wants its result any more.
#ifndef SPLINE_STOP_H
#define SPLINE_STOP_H

#include <stdatomic.h>
#include <wiggly/wiggly.h>

typedef struct solver_stop {
    atomic_bool wanted; ///< set by the other thread
    bool noticed;       ///< the solve ended early: what it filled is of no use
} solver_stop;

/// Has the solver look at `stop` (NULL: at none) where it goes sample by sample, which can take seconds; the chain's 3 ns a sample are
/// not interrupted. The stop must outlive the solves, and is reset by its owner.
void solver_watch(wiggly_solver *solver, solver_stop *stop);

/// Whether the solve is to end; notes that it does.
static inline bool solver_must_stop(solver_stop *stop)
{
    if (!stop || !atomic_load_explicit(&stop->wanted, memory_order_relaxed)) return false;
    stop->noticed = true;
    return true;
}

#endif
