/// Recovery files keep unsaved work when the program dies. Each running program has a slot n in a folder: the file recovery-n and its lock
/// recovery-n.lock. The system releases the lock when the process ends, so an unlocked file was left behind and can be offered. It is an
/// ordinary scene file that names its document (struct scene_origin); scene_save_for() writes it.
#ifndef APP_RECOVERY_H
#define APP_RECOVERY_H

#include "base/error.h"
#include "base/file.h"
#include "scene/load.h"
#include <time.h>

enum { RECOVERY_SLOTS = 64 };

struct recovery_slot {
    int lock; ///< file descriptor
    char path[PATH_LIMIT];
};

/// Takes a free slot without a file. false with an error if there is none or the folder is not writable.
bool recovery_claim(const char *folder, struct recovery_slot *slot, struct error *error);

/// Releases the slot. Its file, if any, stays for the next start.
void recovery_release(struct recovery_slot *slot);

/// A recovery file left behind.
struct recovery_entry {
    struct recovery_slot slot;
    time_t time; ///< last write
    struct scene_origin origin;
};

/// Locks the slot of the newest file left behind, of the document `of` unless NULL; the caller releases it. `count` (may be NULL): number
/// of such files. false if there is none.
bool recovery_find(const char *folder, const char *of, struct recovery_entry *entry, int *count);

void recovery_remove(const struct recovery_slot *slot);

/// Autosave: a recovery file holds unsaved work at most two seconds after an edit. A thread writes a copy of the document that shares
/// splines and rigs with it, so no frame waits for the disk.
struct autosave;

struct autosave_work {
    const struct document *document;
    const char *path;  ///< of the document's file, or ""
    uint64_t content;  ///< hash of the scene file when last read or written; 0: unknown
    uint64_t revision; ///< changes with the document
    bool saved;        ///< nothing to lose
};

/// Takes ownership of the slot.
struct autosave *autosave_open(const struct recovery_slot *slot);

/// Call once per frame; `now` in seconds. Starts a write if the work changed and the last write began a second ago. Deletes the file once
/// the work is saved. false with an error, once, if writing failed.
bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error);

/// Whether unsaved work is not yet being written: then keep calling autosave_update() at frame rate.
bool autosave_is_behind(struct autosave *autosave, const struct autosave_work *work);

/// Whether the last write failed: the recovery file is missing or old.
bool autosave_fails(const struct autosave *autosave);

/// Writes the work in the calling thread, and returns when it is on disk.
bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error);

/// Moves to another slot and its file; deletes the old file and releases its slot.
void autosave_move(struct autosave *autosave, const struct recovery_slot *slot);

const char *autosave_path(const struct autosave *autosave);

/// Waits for the thread and releases the slot; deletes the file unless `keep`.
void autosave_close(struct autosave *autosave, bool keep);

#endif
