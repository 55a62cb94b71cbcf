/// Autosave: unsaved work is in a recovery file within two seconds of an edit, and no frame waits for the disk. The text is
/// made in the frame, into memory that is kept, and handed to a thread that writes it.
#ifndef APP_AUTOSAVE_H
#define APP_AUTOSAVE_H

#include "app/recovery.h"

struct autosave;

/// The work to keep safe.
struct autosave_work {
    const struct document *document;
    const char *path;  ///< of the document's own file, or ""
    uint64_t revision; ///< changes with the document
    bool saved;        ///< nothing would be lost
};

/// Takes over the slot, and starts the thread. On failure NULL with a sentence; the slot is then released.
struct autosave *autosave_open(const struct recovery_slot *slot, struct error *error);

/// Call it often, with the time `now` in seconds. Writes the work if it has changed and the last write is a second ago (a
/// large document waits for a pause of a second, but at most half a minute); removes the file once the work is saved.
/// false with a sentence, once, if the file cannot be written.
bool autosave_update(struct autosave *autosave, const struct autosave_work *work, double now, struct error *error);

/// Writes the work now and returns when it is on the disk.
bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error);

/// Moves to another slot, taking over its file; removes and releases the old one.
void autosave_move(struct autosave *autosave, const struct recovery_slot *slot);

/// Path of the recovery file.
const char *autosave_path(const struct autosave *autosave);

/// Ends the thread and releases the slot; removes the file unless `keep`.
void autosave_close(struct autosave *autosave, bool keep);

#endif
