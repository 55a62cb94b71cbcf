/// Writes unsaved work to the recovery file from a thread, so no frame waits for the disk.
#include "app/autosave.h"
#include "scene/load.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

static const double INTERVAL = 1;  ///< seconds from one snapshot to the next
static const double PAUSE = 1;     ///< without an edit, after which a frame may take longer unnoticed
static const double PATIENCE = 30; ///< for such a pause

/// With more knots than this a snapshot waits for a pause: it costs 2 µs a knot, 3 ms here.
enum { LARGE = 1500 };

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
    uint64_t seen;            ///< revision at the last look; 0 before the first
    double changed;           ///< when that was a new one
    double taken;             ///< when the last snapshot was
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
    fail(error, ERROR_ENVIRONMENT, "autosave is off: cannot start its thread");
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

/// Makes the text. false if memory is short.
static bool take_snapshot(struct autosave *autosave, const struct autosave_work *work)
{
    struct snapshot *snapshot = &autosave->snapshot;
    autosave->revision = work->revision;
    snprintf(snapshot->path, sizeof snapshot->path, "%s", work->path);
    return scene_print_into(work->document, RECOVERY_FOLDER, &snapshot->text, &snapshot->capacity, &snapshot->size) &&
           scene_print_paint(work->document, &snapshot->text, &snapshot->capacity, &snapshot->size);
}

/// Reports the thread's failure, but only the first in a row; the next interval tries again.
static bool report(struct autosave *autosave, struct error *error)
{
    bool news = autosave->failed && !autosave->complained;
    autosave->complained = autosave->failed;
    if (autosave->failed) autosave->revision = 0;
    return !news || fail(error, ERROR_ENVIRONMENT, "Unsaved work has no recovery file: %s", autosave->error.text);
}

/// A large document is written in a pause between edits, so that no drag stutters.
static bool is_time(const struct autosave *autosave, const struct autosave_work *work, double now)
{
    long knots = 0;
    for (int s = 0; s < work->document->spline_count; s++) knots += work->document->splines[s].knot_count;
    double since = now - autosave->taken;
    if (since < INTERVAL) return false;
    return knots <= LARGE || now - autosave->changed >= PAUSE || since >= PATIENCE;
}

bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error)
{
    if (is_busy(autosave)) return true;
    bool good = report(autosave, error);
    if (autosave->seen == 0) autosave->taken = now - INTERVAL;
    if (work->revision != autosave->seen) autosave->changed = now;
    autosave->seen = work->revision;
    if (work->saved) {
        if (autosave->has_file) give(autosave, JOB_REMOVE);
        autosave->revision = 0;
    } else if (work->revision != autosave->revision && is_time(autosave, work, now)) {
        autosave->taken = now;
        if (take_snapshot(autosave, work)) give(autosave, JOB_WRITE);
    }
    return good;
}

bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error)
{
    wait_for_thread(autosave);
    if (!take_snapshot(autosave, work)) return fail(error, ERROR_ENVIRONMENT, "out of memory");
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
