/// A thread that solves a spline or condenses it into a take while frames go on. One job at a time.
#ifndef SCENE_WORKER_H
#define SCENE_WORKER_H

#include "scene/extremes.h"
#include <wiggly/wiggly.h>

enum work { WORK_NONE, WORK_SOLVE, WORK_TAKE };

/// Nobody else may touch what a job reads and writes until it is collected.
struct job {
    enum work kind;
    wiggly_desc desc;
    wiggly_solver *solver;    ///< WORK_SOLVE
    wiggly_curve curve;       ///< with all five rows; flat if the solver refuses
    struct extremes extremes; ///< of the total
    wiggly_take *take;        ///< WORK_TAKE: in: an old one to free; out: the new one or NULL
    wiggly_status status;
    bool stopped; ///< by worker_stop(): the curve is useless
};

/// NULL if no thread can be started.
struct worker *worker_create(void);

/// Stops a running job and waits for it; frees nothing that it made. NULL is fine.
void worker_destroy(struct worker *worker);

/// Gives a job to an idle worker.
void worker_give(struct worker *worker, const struct job *job);

/// Whether a job was given and not yet collected.
bool worker_has_job(const struct worker *worker);

/// Seconds since the job was given.
double worker_seconds(const struct worker *worker);

/// Asks the job to end soon.
void worker_stop(struct worker *worker);

/// Hands back the finished job; false if there is none after waiting `seconds` (INFINITY: as long as it takes).
bool worker_collect(struct worker *worker, double seconds, struct job *job);

#endif
