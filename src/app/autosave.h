/// Autosave: unsaved work is in a recovery file within two seconds of an edit, and no frame waits for the disk. The text is
/// made in the frame, into memory that is kept, and handed to a thread that writes it.
#ifndef APP_AUTOSAVE_H
#define APP_AUTOSAVE_H

#include "app/recovery.h"

struct autosave;

/// What there is to be kept safe.
struct autosave_work {
    const struct document *document;
    const char *path;  ///< of the document's own file, or ""
    uint64_t revision; ///< changes with the document
    bool saved;        ///< nothing would be lost
};

/// Takes over the slot, and starts the thread. NULL with a sentence (the slot is then released).
struct autosave *autosave_open(const struct recovery_slot *slot, struct error *error);

/// Looks at the work at time `now` (seconds), often: writes it where it has changed and the last write is a second ago (a
/// large document only in a pause of a second, if one comes within half a minute), removes the file where it is saved. false with a sentence, once, where the file cannot be written.
bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error);

/// Writes the work now and returns when it is on the disk.
bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error);

/// From now on the recovery file is that of another slot, which is taken over with its file; the own one is removed and
/// released.
void autosave_move(struct autosave *autosave, const struct recovery_slot *slot);

/// Path of the recovery file.
const char *autosave_path(const struct autosave *autosave);

/// Ends the thread and releases the slot; the file stays where `keep`, else it is removed.
void autosave_close(struct autosave *autosave, bool keep);

#endif
