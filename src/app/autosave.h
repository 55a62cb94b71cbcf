/// Autosave: unsaved work is in a recovery file within two seconds of an edit. No frame waits for the disk: a thread holds a copy of the
/// document, which shares splines and rigs with it, and writes that.
#ifndef APP_AUTOSAVE_H
#define APP_AUTOSAVE_H

#include "app/recovery.h"

struct autosave;

/// The work to keep safe.
struct autosave_work {
    const struct document *document;
    const char *path;  ///< of the document's own file, or ""
    uint64_t content;  ///< what was in it when it was read or written last; 0: unknown
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
