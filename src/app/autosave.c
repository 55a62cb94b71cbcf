/// Writes unsaved work to the recovery file: a thread prints a copy, which shares splines and rigs with the document, and writes it, so that
/// no frame waits for the disk.
#include "app/autosave.h"
#include "base/need.h"
#include "scene/load.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

static const double INTERVAL = 1; ///< seconds from one copy to the next

enum job { JOB_NONE, JOB_WRITE, JOB_REMOVE, JOB_END };

/// How the last write went; OUTCOME_NONE once that is known.
enum outcome { OUTCOME_NONE, OUTCOME_KEPT, OUTCOME_FAILED };

struct autosave {
    struct recovery_slot slot;
    struct document *document; ///< the frame's while the job is JOB_NONE, the thread's while it is another
    char original[PATH_LIMIT]; ///< the path of the document's own file; likewise
    struct file_stamp stamp;   ///< of that; likewise
    uint64_t revision;         ///< of the last copy
    double taken;              ///< when it was begun
    bool has_file, complained;

    char *text; ///< the thread's
    size_t capacity;
    thrd_t thread;
    mtx_t lock;
    cnd_t given, done;
    enum job job;
    enum outcome outcome;
    struct error error; ///< of a failure
};

/// The thread's part.
static bool write_work(struct autosave *autosave, struct error *error)
{
    size_t size;
    scene_print_into(autosave->document, RECOVERY_FOLDER, &autosave->text, &autosave->capacity, &size);
    scene_print_paint(autosave->document, &autosave->text, &autosave->capacity, &size);
    return recovery_write(&autosave->slot, autosave->original, &autosave->stamp, autosave->text, size, error);
}

static int run(void *user)
{
    struct autosave *autosave = user;
    for (;;) {
        mtx_lock(&autosave->lock);
        while (autosave->job == JOB_NONE) cnd_wait(&autosave->given, &autosave->lock);
        enum job job = autosave->job;
        mtx_unlock(&autosave->lock);
        if (job == JOB_END) return 0;
        struct error error = {0};
        enum outcome outcome = OUTCOME_NONE;
        if (job == JOB_WRITE) {
            outcome = write_work(autosave, &error) ? OUTCOME_KEPT : OUTCOME_FAILED;
        } else {
            recovery_remove(&autosave->slot);
        }
        mtx_lock(&autosave->lock);
        autosave->outcome = outcome;
        autosave->error = error;
        autosave->job = JOB_NONE;
        cnd_signal(&autosave->done);
        mtx_unlock(&autosave->lock);
    }
}

struct autosave *autosave_open(const struct recovery_slot *slot, struct error *error)
{
    struct autosave *autosave = need_zeroed(1, sizeof *autosave);
    autosave->slot = *slot;
    autosave->taken = -INFINITY;
    mtx_init(&autosave->lock, mtx_plain);
    cnd_init(&autosave->given);
    cnd_init(&autosave->done);
    if (thrd_create(&autosave->thread, run, autosave) == thrd_success) return autosave;
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

static void copy_work(struct autosave *autosave, const struct autosave_work *work)
{
    autosave->revision = work->revision;
    snprintf(autosave->original, sizeof autosave->original, "%s", work->path);
    autosave->stamp = work->stamp;
    struct document *copy = document_copy_apart(work->document);
    document_destroy(autosave->document);
    autosave->document = copy;
}

/// What came of the last write: only the first failure in a row is told; the next interval tries again.
static bool report(struct autosave *autosave, struct error *error)
{
    const enum outcome outcome = autosave->outcome;
    const bool is_news = outcome == OUTCOME_FAILED && !autosave->complained;
    autosave->outcome = OUTCOME_NONE;
    if (outcome == OUTCOME_FAILED) autosave->revision = 0;
    if (outcome != OUTCOME_NONE) autosave->complained = outcome == OUTCOME_FAILED;
    return !is_news || fail(error, ERROR_ENVIRONMENT, "Unsaved work has no recovery file: %s", autosave->error.text);
}

bool autosave_is_behind(struct autosave *autosave, const struct autosave_work *work)
{
    return !work->saved && work->revision != autosave->revision;
}

bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error)
{
    if (is_busy(autosave)) return true;
    document_destroy(autosave->document); // the thread is through with it
    autosave->document = NULL;
    bool good = report(autosave, error);
    if (work->saved) {
        if (autosave->has_file) give(autosave, JOB_REMOVE);
        autosave->revision = 0;
    } else if (autosave_is_behind(autosave, work) && now - autosave->taken >= INTERVAL) {
        autosave->taken = now;
        copy_work(autosave, work);
        give(autosave, JOB_WRITE);
    }
    return good;
}

bool autosave_fails(const struct autosave *autosave) { return autosave->complained; }

bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error)
{
    if (!thrd_equal(thrd_current(), autosave->thread)) wait_for_thread(autosave);
    copy_work(autosave, work);
    const bool kept = autosave->has_file = write_work(autosave, &autosave->error);
    autosave->outcome = kept ? OUTCOME_KEPT : OUTCOME_FAILED;
    if (!kept) *error = autosave->error;
    return kept;
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
    document_destroy(autosave->document);
    free(autosave->text);
    free(autosave);
}
