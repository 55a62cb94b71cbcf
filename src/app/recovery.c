/// Slots of recovery files, locked by the program that uses them.
#include "app/recovery.h"
#include "base/file.h"
#include "scene/load.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/// The lock file is never removed: that would let two programs hold two locks of one name.
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

/// Whether a slot's file has work on that document.
static bool is_of(const char *path, const char *of)
{
    const struct scene_origin origin = scene_read_origin(path);
    char kept[PATH_LIMIT], wanted[PATH_LIMIT];
    return origin.path[0] && path_resolve(NULL, origin.path, kept) && path_resolve(NULL, of, wanted) &&
           strcmp(kept, wanted) == 0;
}

bool recovery_find(const char *folder, const char *of, struct recovery_entry *entry, int *count)
{
    struct timespec newest = {0};
    int found = 0;
    for (int n = 1; n <= RECOVERY_SLOTS; n++) {
        struct recovery_slot slot;
        struct stat about;
        char path[PATH_LIMIT];
        snprintf(path, sizeof path, "%s/recovery-%d", folder, n);
        if (stat(path, &about) != 0 || (of && !is_of(path, of)) || !claim_slot(folder, n, &slot)) continue;
        bool newer = found++ == 0 || about.st_mtim.tv_sec > newest.tv_sec ||
                     (about.st_mtim.tv_sec == newest.tv_sec && about.st_mtim.tv_nsec > newest.tv_nsec);
        if (newer && found > 1) recovery_release(&entry->slot);
        if (newer) {
            newest = about.st_mtim;
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

bool recovery_write(const struct recovery_slot *slot, const struct document *document,
                    const struct scene_origin *origin, struct error *error)
{
    struct file_output output;
    char folder[PATH_LIMIT];
    size_t size;
    if (!path_folder(slot->path, folder)) return fail(error, ERROR_ENVIRONMENT, "the path is too long");
    char *text = scene_print_for(document, folder, origin, &size);
    const bool opened = file_output_open(&output, slot->path, error);
    if (opened) {
        fchmod(fileno(output.stream), 0600); // the work is nobody else's
        fwrite(text, 1, size, output.stream);
    }
    free(text);
    return opened && file_output_commit(&output, error);
}

void recovery_remove(const struct recovery_slot *slot) { unlink(slot->path); }
