/// Recovery files: unsaved work that outlives the program. Each running program has a slot.
///
/// Slot n of a folder is the file recovery-n and its lock recovery-n.lock, which its program holds while it runs: the
/// lock ends with the process, however that ends. A file whose lock is free was left behind and can be offered. It is a scene file like
/// any other, and says whose work it is (struct scene_origin). scene_save_for() writes it.
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

void recovery_remove(const struct recovery_slot *slot);

/// Autosave: unsaved work is in a recovery file within two seconds of an edit. No frame waits for the disk: a thread holds a copy of the
/// document, which shares splines and rigs with it, and writes that.
struct autosave;

/// The work to keep safe.
struct autosave_work {
    const struct document *document;
    const char *path;  ///< of the document's own file, or ""
    uint64_t content;  ///< content of the scene's file when it was read or written last; 0: unknown
    uint64_t revision; ///< changes with the document
    bool saved;        ///< nothing would be lost
};

/// Takes over the slot.
struct autosave *autosave_open(const struct recovery_slot *slot);

/// Call it once a frame, with the time `now` in seconds. Has the work written if it has changed and the last write began a second
/// ago; removes the file once the work is saved. false with a sentence, once, if the file cannot be written.
bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error);

/// Whether there is unsaved work that is not with the thread yet: then update it at the frames' rate even where none is drawn.
bool autosave_is_behind(struct autosave *autosave, const struct autosave_work *work);

/// Whether the last write failed: there is no recovery file, or an older one.
bool autosave_fails(const struct autosave *autosave);

/// Writes the work now, in the calling thread, and returns when it is on the disk. Autosave's own thread may call it.
bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error);

/// Moves to another slot, taking over its file; removes and releases the old one.
void autosave_move(struct autosave *autosave, const struct recovery_slot *slot);

/// Path of the recovery file.
const char *autosave_path(const struct autosave *autosave);

/// Waits for the thread and releases the slot; removes the file unless `keep`.
void autosave_close(struct autosave *autosave, bool keep);

#endif
