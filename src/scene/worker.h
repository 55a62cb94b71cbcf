/// A thread that solves one spline, or condenses it into a take, while the frames go on. One job at a time.
#ifndef SCENE_WORKER_H
#define SCENE_WORKER_H

#include "scene/extremes.h"
#include <wiggly/wiggly.h>

enum work { WORK_NONE, WORK_SOLVE, WORK_TAKE };

/// All that a job reads and writes is left alone by others until it is collected.
struct job {
    enum work kind;
    wiggly_desc desc;
    wiggly_solver *solver;    ///< WORK_SOLVE
    wiggly_curve curve;       ///< of all five rows, filled; level where the solver refuses
    struct extremes extremes; ///< of the total, filled
    wiggly_take *take;        ///< WORK_TAKE: an old one to be freed, then the new one or NULL
    wiggly_status status;
    bool stopped; ///< given up by worker_stop(): the curve is good for nothing
};

/// NULL where the thread cannot be had.
struct worker *worker_create(void);

/// Stops and waits for a job that is under way; what it made is freed by nobody. NULL is fine.
void worker_destroy(struct worker *worker);

/// Gives a job to a worker that has none.
void worker_give(struct worker *worker, const struct job *job);

/// Whether a job was given and not collected.
bool worker_has_job(const struct worker *worker);

/// Seconds since the job was given.
double worker_seconds(const struct worker *worker);

/// Has the job end as soon as it can.
void worker_stop(struct worker *worker);

/// Takes the finished job back. false where there is none after `seconds` of waiting (INFINITY: as long as it takes).
bool worker_collect(struct worker *worker, double seconds, struct job *job);

#endif
