/// Recovery files: unsaved work that outlives the program. Each running program has a slot.
///
/// Slot n of a folder is the file recovery-n and its lock recovery-n.lock, which its program holds while it runs: the
/// lock ends with the process, however that ends. A file whose lock is free was left behind and can be offered. It is a scene file like
/// any other, and says whose work it is (struct scene_origin).
#ifndef APP_RECOVERY_H
#define APP_RECOVERY_H

#include "base/error.h"
#include "base/file.h"
#include "scene/load.h"
#include <time.h>

enum { RECOVERY_SLOTS = 64 };

struct recovery_slot {
    int lock; ///< descriptor
    char path[PATH_LIMIT];
};

/// Takes a free slot without a file. false with a sentence if there is none or the folder cannot be written.
bool recovery_claim(const char *folder, struct recovery_slot *slot, struct error *error);

/// Gives the slot back; its file, if any, is for the next start to find.
void recovery_release(struct recovery_slot *slot);

/// A file that was left behind.
struct recovery_entry {
    struct recovery_slot slot;
    time_t time; ///< when it was written
    struct scene_origin origin;
};

/// Claims the slot with the newest file left behind, of the document's file `of` where that is not NULL; the caller releases it.
/// `count` (may be NULL) says how many such files there are. false if there is none.
bool recovery_find(const char *folder, const char *of, struct recovery_entry *entry, int *count);

/// Writes a document into a slot's file, whole or not at all. scene_load() reads it.
bool recovery_write(const struct recovery_slot *slot, const struct document *document,
                    const struct scene_origin *origin, struct error *error);

void recovery_remove(const struct recovery_slot *slot);

#endif
