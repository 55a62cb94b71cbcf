#include "app/autosave.h"
#include "scene/load.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>
#include <time.h>

static const double INTERVAL = 1;    ///< seconds from one snapshot to the next
static const double COST_SHARE = 20; ///< a snapshot that takes long is made so many times more seldom than it takes

enum job { JOB_NONE, JOB_WRITE, JOB_REMOVE, JOB_END };

/// A document's text, and the path of its own file.
struct snapshot {
    char *text;
    size_t capacity, size;
    char path[RECOVERY_PATH];
};

struct autosave {
    struct recovery_slot slot;
    struct snapshot snapshot; ///< the frame's while the job is JOB_NONE, the thread's while it is another
    uint64_t revision;        ///< of the last snapshot
    double next;              ///< time of the next one at the earliest
    bool has_file, complained;

    thrd_t thread;
    mtx_t lock;
    cnd_t given, done;
    enum job job;
    bool failed; ///< the last write, with `error`
    struct error error;
};

static int run(void *user)
{
    struct autosave *autosave = user;
    const struct snapshot *snapshot = &autosave->snapshot;
    for (;;) {
        mtx_lock(&autosave->lock);
        while (autosave->job == JOB_NONE) cnd_wait(&autosave->given, &autosave->lock);
        enum job job = autosave->job;
        mtx_unlock(&autosave->lock);
        if (job == JOB_END) return 0;
        struct error error = {0};
        bool good = true;
        if (job == JOB_WRITE) {
            good = recovery_write(&autosave->slot, snapshot->path, snapshot->text, snapshot->size, &error);
        } else {
            recovery_remove(&autosave->slot);
        }
        mtx_lock(&autosave->lock);
        autosave->failed = !good;
        autosave->error = error;
        autosave->job = JOB_NONE;
        cnd_signal(&autosave->done);
        mtx_unlock(&autosave->lock);
    }
}

struct autosave *autosave_open(const struct recovery_slot *slot, struct error *error)
{
    struct autosave *autosave = calloc(1, sizeof *autosave);
    if (autosave) {
        autosave->slot = *slot;
        mtx_init(&autosave->lock, mtx_plain);
        cnd_init(&autosave->given);
        cnd_init(&autosave->done);
        if (thrd_create(&autosave->thread, run, autosave) == thrd_success) return autosave;
    }
    free(autosave);
    struct recovery_slot unused = *slot;
    recovery_release(&unused);
    fail(error, ERROR_ENVIRONMENT, "autosave is off: its thread cannot be started");
    return NULL;
}

static void give(struct autosave *autosave, enum job job)
{
    mtx_lock(&autosave->lock);
    autosave->job = job;
    cnd_signal(&autosave->given);
    mtx_unlock(&autosave->lock);
    autosave->has_file = job == JOB_WRITE;
}

static void wait_for_thread(struct autosave *autosave)
{
    mtx_lock(&autosave->lock);
    while (autosave->job != JOB_NONE) cnd_wait(&autosave->done, &autosave->lock);
    mtx_unlock(&autosave->lock);
}

static bool is_busy(struct autosave *autosave)
{
    mtx_lock(&autosave->lock);
    bool busy = autosave->job != JOB_NONE;
    mtx_unlock(&autosave->lock);
    return busy;
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Makes the text; returns the seconds that took, NAN where memory is short.
static double take_snapshot(struct autosave *autosave, const struct autosave_work *work)
{
    struct snapshot *snapshot = &autosave->snapshot;
    double start = seconds_now();
    autosave->revision = work->revision;
    snprintf(snapshot->path, sizeof snapshot->path, "%s", work->path);
    bool good =
        scene_print_into(work->document, RECOVERY_FOLDER, &snapshot->text, &snapshot->capacity, &snapshot->size);
    return good ? seconds_now() - start : NAN;
}

/// Passes the thread's complaint on, the first one of a run of them; the next interval tries again.
static bool report(struct autosave *autosave, struct error *error)
{
    bool news = autosave->failed && !autosave->complained;
    autosave->complained = autosave->failed;
    if (autosave->failed) autosave->revision = 0;
    return !news || fail(error, ERROR_ENVIRONMENT, "Unsaved work is not kept safe: %s", autosave->error.text);
}

bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error)
{
    if (is_busy(autosave)) return true;
    bool good = report(autosave, error);
    if (work->saved) {
        if (autosave->has_file) give(autosave, JOB_REMOVE);
        autosave->revision = 0;
    } else if (work->revision != autosave->revision && now >= autosave->next) {
        double cost = take_snapshot(autosave, work);
        autosave->next = now + fmax(INTERVAL, COST_SHARE * cost); // fmax() passes a NAN by
        if (!isnan(cost)) give(autosave, JOB_WRITE);
    }
    return good;
}

bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error)
{
    wait_for_thread(autosave);
    if (isnan(take_snapshot(autosave, work))) return fail(error, ERROR_ENVIRONMENT, "out of memory");
    give(autosave, JOB_WRITE);
    wait_for_thread(autosave);
    if (autosave->failed) *error = autosave->error;
    return !autosave->failed;
}

void autosave_move(struct autosave *autosave, const struct recovery_slot *slot)
{
    wait_for_thread(autosave);
    recovery_remove(&autosave->slot);
    recovery_release(&autosave->slot);
    autosave->slot = *slot;
    autosave->has_file = true;
}

const char *autosave_path(const struct autosave *autosave) { return autosave->slot.path; }

void autosave_close(struct autosave *autosave, bool keep)
{
    if (!autosave) return;
    wait_for_thread(autosave);
    give(autosave, JOB_END);
    thrd_join(autosave->thread, NULL);
    if (!keep) recovery_remove(&autosave->slot);
    recovery_release(&autosave->slot);
    mtx_destroy(&autosave->lock);
    cnd_destroy(&autosave->given);
    cnd_destroy(&autosave->done);
    free(autosave->snapshot.text);
    free(autosave);
}
