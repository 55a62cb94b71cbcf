/// Recovery files: unsaved work that outlives the program. Each running program has a slot.
///
/// Slot n of a folder is the file recovery-n and its lock recovery-n.lock, which its program holds while it runs: the
/// lock ends with the process, however that ends. A file whose lock is free was left behind and can be offered. It holds
///
///     wiggly-recovery 1 /home/me/walk.json      (the absolute path of the document's own file, with NUL for a line break;
///                                               nothing for an untitled one)
///     { "wiggly": 1, …                          (the document's canonical text, for a file in RECOVERY_FOLDER)
///
/// and, if its characters are painted, a NUL and their paint (scene/load.h). Where it is known what was in the document's own file, a line
/// "file SIZE HASH" precedes the text.
#ifndef APP_RECOVERY_H
#define APP_RECOVERY_H

#include "base/error.h"
#include "base/file.h"
#include "scene/document.h"
#include <stddef.h>
#include <time.h>

#define RECOVERY_FOLDER "/" /* paths in the text are relative to it: an untitled document has no folder of its own */

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
    time_t time;               ///< when it was written
    char original[PATH_LIMIT]; ///< path of the document's own file, or ""
    struct file_stamp stamp;   ///< that file as the work began with it; nothing there: unknown
};

/// Claims the slot with the newest file left behind, of the document's file `of` where that is not NULL; the caller releases it.
/// `count` (may be NULL) says how many such files there are. false if there is none.
bool recovery_find(const char *folder, const char *of, struct recovery_entry *entry, int *count);

/// The document in a file. NULL with a sentence if it is damaged.
struct document *recovery_read(const struct recovery_slot *slot, struct error *error);

/// Writes a slot's file, atomically: `text` is the document's canonical text for RECOVERY_FOLDER, with any paint; `stamp` (may be NULL)
/// the document's own file as it was when it was read or written last.
bool recovery_write(const struct recovery_slot *slot, const char *original, const struct file_stamp *stamp,
                    const char *text, size_t size, struct error *error);

void recovery_remove(const struct recovery_slot *slot);

#endif
