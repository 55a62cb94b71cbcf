/// The slots of recovery files, locked by running programs, the thread that writes them, and the rescue when the program must end.
#include "app/personal.h"
#include "app/state.h"
#include "base/file.h"
#include "base/need.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/// Never deletes the lock file: otherwise two programs could lock two files of the same name.
static bool claim_slot(const char *folder, int n, struct recovery_slot *slot)
{
    char lock[PATH_LIMIT + 16];
    int length = snprintf(slot->path, sizeof slot->path, "%s/recovery-%d", folder, n);
    if (length >= (int)sizeof slot->path) {
        errno = ENAMETOOLONG;
        return false;
    }
    snprintf(lock, sizeof lock, "%s.lock", slot->path);
    slot->lock = open(lock, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (slot->lock < 0) return false;
    if (flock(slot->lock, LOCK_EX | LOCK_NB) == 0) return true;
    int cause = errno;
    close(slot->lock);
    errno = cause;
    return false;
}

bool recovery_claim(const char *folder, struct recovery_slot *slot, struct error *error)
{
    for (int n = 1; n <= RECOVERY_SLOTS; n++) {
        if (claim_slot(folder, n, slot)) {
            if (access(slot->path, F_OK) != 0) return true;
            recovery_release(slot);
        } else if (errno != EWOULDBLOCK) {
            return fail(error, ERROR_ENVIRONMENT, "%s: cannot write a recovery file there: %s", folder,
                        strerror(errno));
        }
    }
    return fail(error, ERROR_ENVIRONMENT, "%s: there are %d recovery files already: recover or discard some", folder,
                RECOVERY_SLOTS);
}

void recovery_release(struct recovery_slot *slot)
{
    if (slot->lock >= 0) close(slot->lock);
    slot->lock = -1;
}

bool recovery_find(const char *folder, const char *of, struct recovery_entry *entry, int *count)
{
    struct timespec newest = {0};
    int found = 0;
    for (int n = 1; n <= RECOVERY_SLOTS; n++) {
        struct recovery_slot slot;
        struct stat status;
        char path[PATH_LIMIT];
        snprintf(path, sizeof path, "%s/recovery-%d", folder, n);
        if (stat(path, &status) != 0) continue;
        if (of) {
            const struct scene_origin origin = scene_read_origin(path);
            char kept[PATH_LIMIT], wanted[PATH_LIMIT];
            if (!origin.path[0] || !path_resolve(NULL, origin.path, kept) || !path_resolve(NULL, of, wanted) ||
                strcmp(kept, wanted) != 0)
                continue;
        }
        if (!claim_slot(folder, n, &slot)) continue;
        bool newer = found++ == 0 || status.st_mtim.tv_sec > newest.tv_sec ||
                     (status.st_mtim.tv_sec == newest.tv_sec && status.st_mtim.tv_nsec > newest.tv_nsec);
        if (newer && found > 1) recovery_release(&entry->slot);
        if (newer) {
            newest = status.st_mtim;
            entry->slot = slot;
        } else {
            recovery_release(&slot);
        }
    }
    if (count) *count = found;
    if (found == 0) return false;
    entry->time = newest.tv_sec;
    entry->origin = scene_read_origin(entry->slot.path);
    return true;
}

static const double INTERVAL = 1; ///< least seconds between the starts of two writes

static struct scene_origin origin_of(const struct autosave_work *work)
{
    struct scene_origin origin = {.content = work->content};
    snprintf(origin.path, sizeof origin.path, "%s", work->path);
    return origin;
}

static int write_document(void *user)
{
    struct autosave *autosave = user;
    autosave->error = (struct error){0};
    scene_save_for(autosave->document, autosave->slot.path, &autosave->origin, &autosave->error);
    atomic_store(&autosave->ended, true);
    return 0;
}

struct autosave *autosave_open(const struct recovery_slot *slot)
{
    struct autosave *autosave = need_zeroed(1, sizeof *autosave);
    autosave->slot = *slot;
    autosave->begun = -INFINITY;
    return autosave;
}

static bool is_busy(struct autosave *autosave) { return autosave->document && !atomic_load(&autosave->ended); }

static void wait_for_write(struct autosave *autosave)
{
    while (is_busy(autosave)) thrd_sleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

/// Joins the last write's thread and frees its document.
static void finish_write(struct autosave *autosave)
{
    if (autosave->threaded) thrd_join(autosave->thread, NULL);
    document_destroy(autosave->document);
    autosave->document = NULL;
    autosave->threaded = false;
}

bool autosave_is_behind(struct autosave *autosave, const struct autosave_work *work)
{
    return !work->saved && work->revision != autosave->revision;
}

bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error)
{
    if (is_busy(autosave)) return true;

    // Only the first of several failures is reported. The next interval tries again.
    bool is_news = false;
    if (autosave->document) {
        const bool failed = autosave->error.kind != ERROR_NONE;
        is_news = failed && !autosave->complained;
        finish_write(autosave);
        autosave->complained = failed;
        if (failed) autosave->revision = 0;
        if (is_news) fail(error, ERROR_ENVIRONMENT, "Unsaved work has no recovery file: %s", autosave->error.text);
    }
    if (work->saved) {
        if (autosave->has_file) unlink(autosave->slot.path);
        autosave->has_file = false;
        autosave->revision = 0;
    } else if (autosave_is_behind(autosave, work) && now - autosave->begun >= INTERVAL) {
        autosave->document = document_copy(work->document);
        autosave->origin = origin_of(work);
        autosave->revision = work->revision;
        autosave->begun = now;
        autosave->has_file = true;
        atomic_store(&autosave->ended, false);
        autosave->threaded = thrd_create(&autosave->thread, write_document, autosave) == thrd_success;
        if (!autosave->threaded) write_document(autosave); // a late frame is better than lost work
    }
    return !is_news;
}

bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error)
{
    const struct scene_origin origin = origin_of(work);
    wait_for_write(autosave);
    autosave->has_file = true;
    return scene_save_for(work->document, autosave->slot.path, &origin, error);
}

void autosave_move(struct autosave *autosave, const struct recovery_slot *slot)
{
    wait_for_write(autosave);
    unlink(autosave->slot.path);
    recovery_release(&autosave->slot);
    autosave->slot = *slot;
    autosave->has_file = true;
}

void autosave_close(struct autosave *autosave, bool keep)
{
    if (!autosave) return;
    wait_for_write(autosave);
    finish_write(autosave);
    if (!keep) unlink(autosave->slot.path);
    recovery_release(&autosave->slot);
    free(autosave);
}

// --- the rescue

void app_rescue(struct app *app, struct error *error)
{
    char path[PATH_LIMIT];
    struct error trouble[2] = {0}, why = *error;
    if (app->replay || !app->work.document || history_is_saved(app->work.history))
        return; // a replay can be played again
    const char *kept = personal_rescue(app), *home = getenv("HOME");

    // Else to a new folder in the home folder, or in the temporary one, where nobody can have planted a link. The first failure counts.
    const char *const folders[] = {home ? home : "", "/tmp"};
    bool written = false;
    for (int i = 0; !kept && i < 2; i++) {
        snprintf(path, sizeof path, "%s/wiggly-recovered-XXXXXX", folders[i]);
        if (!mkdtemp(path)) {
            fail(&trouble[i], ERROR_ENVIRONMENT, "%s: %s", folders[i], strerror(errno));
            continue;
        }
        const size_t length = strlen(path);
        snprintf(path + length, sizeof path - length, "/untitled.json");
        written = scene_save(app->work.document, path, &trouble[i]);
        if (written) break;
        path[length] = '\0';
        rmdir(path);
    }
    if (kept) {
        fail(error, why.kind, "%s; the unsaved scene is safe in %s, and the next start offers to recover it",
             why.text, kept);
    } else if (written) {
        fail(error, why.kind, "%s; the unsaved scene is in %s: open it to continue", why.text, path);
    } else {
        fail(error, why.kind, "%s; the unsaved scene is lost: %s", why.text, trouble[0].text);
    }
}
