/// A thread with one job at a time.
#include "scene/worker.h"
#include "scene/storage.h"
#include "spline/stop.h"
#include <math.h>
#include <stdlib.h>
#include <threads.h>
#include <time.h>

struct worker {
    thrd_t thread;
    mtx_t lock;
    cnd_t given, done;
    struct job job;
    bool has_job;    ///< used by the main thread only, like given_at
    double given_at; ///< seconds
    solver_stop halt;
    bool is_working; ///< under the lock, like stop
    bool stop;
};

static void work(struct job *job, solver_stop *stop)
{
    if (job->kind == WORK_TAKE) {
        wiggly_take_destroy(job->take);
        job->take = NULL;
        job->status = wiggly_take_create(&job->desc, &job->take);
        return;
    }
    solver_watch(job->solver, stop);
    job->status = wiggly_solve(job->solver, &job->desc, &job->curve);
    solver_watch(job->solver, NULL);
    job->stopped = stop->noticed;
    if (job->stopped) return;
    if (job->status >= WIGGLY_ERROR_ARGUMENT) storage_flatten(&job->curve, &job->desc);
    extremes_update(&job->extremes, job->curve.total, job->desc.samples, 0, job->desc.samples);
}

static int run(void *user)
{
    struct worker *worker = user;
    mtx_lock(&worker->lock);
    for (;;) {
        while (!worker->is_working && !worker->stop) cnd_wait(&worker->given, &worker->lock);
        if (!worker->is_working) break;
        mtx_unlock(&worker->lock);
        work(&worker->job, &worker->halt);
        mtx_lock(&worker->lock);
        worker->is_working = false;
        cnd_signal(&worker->done);
    }
    mtx_unlock(&worker->lock);
    return 0;
}

struct worker *worker_create(void)
{
    struct worker *worker = calloc(1, sizeof *worker);
    if (!worker) return NULL;
    mtx_init(&worker->lock, mtx_plain);
    cnd_init(&worker->given);
    cnd_init(&worker->done);
    if (thrd_create(&worker->thread, run, worker) == thrd_success) return worker;
    free(worker);
    return NULL;
}

void worker_destroy(struct worker *worker)
{
    if (!worker) return;
    worker_stop(worker);
    mtx_lock(&worker->lock);
    worker->stop = true;
    cnd_signal(&worker->given);
    mtx_unlock(&worker->lock);
    thrd_join(worker->thread, NULL);
    cnd_destroy(&worker->given);
    cnd_destroy(&worker->done);
    mtx_destroy(&worker->lock);
    free(worker);
}

static double now(void)
{
    struct timespec time;
    timespec_get(&time, TIME_UTC);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void worker_give(struct worker *worker, const struct job *job)
{
    mtx_lock(&worker->lock);
    worker->given_at = now();
    worker->halt.noticed = false;
    atomic_store(&worker->halt.wanted, false);
    worker->job = *job;
    worker->has_job = worker->is_working = true;
    cnd_signal(&worker->given);
    mtx_unlock(&worker->lock);
}

bool worker_has_job(const struct worker *worker) { return worker->has_job; }

double worker_seconds(const struct worker *worker) { return now() - worker->given_at; }

void worker_stop(struct worker *worker) { atomic_store(&worker->halt.wanted, true); }

static struct timespec seconds_from_now(double seconds)
{
    double then = now() + seconds;
    return (struct timespec){.tv_sec = (time_t)floor(then), .tv_nsec = (long)((then - floor(then)) * 1e9)};
}

bool worker_collect(struct worker *worker, double seconds, struct job *job)
{
    if (!worker->has_job) return false;
    mtx_lock(&worker->lock);
    if (isinf(seconds)) {
        while (worker->is_working) cnd_wait(&worker->done, &worker->lock);
    } else if (seconds > 0) {
        struct timespec deadline = seconds_from_now(seconds);
        while (worker->is_working && cnd_timedwait(&worker->done, &worker->lock, &deadline) == thrd_success) continue;
    }
    bool finished = !worker->is_working;
    if (finished) *job = worker->job;
    mtx_unlock(&worker->lock);
    worker->has_job = !finished;
    return finished;
}
