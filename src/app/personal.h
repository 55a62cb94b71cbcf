/// What belongs to the user, not to a document: recovery files, autosave and settings.
#ifndef APP_PERSONAL_H
#define APP_PERSONAL_H

#include "base/error.h"
#include "base/file.h"
#include "editor/editor.h"
#include "scene/load.h"
#include <stdatomic.h>
#include <threads.h>
#include <time.h>

// --- recovery files
//
// They keep unsaved work when the program dies. Each running program has a slot n in a folder: the file recovery-n and its lock
// recovery-n.lock. The system releases the lock when the process ends, so an unlocked file was left behind and can be offered. It is an
// ordinary scene file that names its document (struct scene_origin); scene_save_for() writes it.

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

// --- autosave

/// A recovery file holds unsaved work at most two seconds after an edit. A thread writes a copy of the document that shares
/// splines and rigs with it, so no frame waits for the disk.
struct autosave {
    struct recovery_slot slot;
    uint64_t revision; ///< of the last write
    double begun;      ///< time of its start
    bool has_file, complained;

    struct document
        *document; ///< of an unreported write, else NULL; owned by the thread until `ended`, like the next two
    struct scene_origin origin;
    struct error error;
    thrd_t thread;
    bool threaded; ///< must be joined
    atomic_bool ended;
};

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

/// Writes the work in the calling thread, and returns when it is on disk.
bool autosave_flush(struct autosave *autosave, const struct autosave_work *work, struct error *error);

/// Moves to another slot and its file; deletes the old file and releases its slot.
void autosave_move(struct autosave *autosave, const struct recovery_slot *slot);

/// Waits for the thread and releases the slot; deletes the file unless `keep`.
void autosave_close(struct autosave *autosave, bool keep);

// --- settings kept between runs: a small JSON file
//
//     {"theme": "dark", "stage_share": 0.4, "more": true, "recent": ["/home/me/walk.json"]}
//
// Recent files are listed newest first. Unknown keys are kept, so that an older program does not lose a newer one's settings.

struct settings;

/// Reads the settings; a missing file is empty. If the file is broken or unreadable, `error` is set (else ERROR_NONE) and defaults apply.
struct settings *settings_load(const char *path, struct error *error);

/// Reads them for a change; NULL with an error if that would lose a broken file. Other programs wait for settings_free(), at most five
/// seconds.
struct settings *settings_open(const char *path, struct error *error);
void settings_free(struct settings *settings);

/// The value of a key: a string or NULL; a number or `fallback`; true or false, or `fallback`.
const char *settings_get(const struct settings *settings, const char *key);
double settings_number(const struct settings *settings, const char *key, double fallback);
bool settings_flag(const struct settings *settings, const char *key, bool fallback);

void settings_set(struct settings *settings, const char *key, const char *value);
void settings_set_number(struct settings *settings, const char *key, double value);
void settings_set_flag(struct settings *settings, const char *key, bool value);

/// Writes atomically.
bool settings_save(const struct settings *settings, const char *path, struct error *error);

/// Moves a file to the front of the recent files, at most DIALOG_MAX_RECENT, by absolute path.
void recent_note(struct settings *settings, const char *path);

/// Writes the recent files, newest first, with missing ones marked; returns how many.
int recent_list(const struct settings *settings, struct dialog_recent *files, int most);

/// Reads the last export's path and scene, and the choices that suit any scene. Missing ones keep a new dialog's defaults. `scene`: path of
/// the open file, or "".
void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory);
void export_memory_write(struct settings *settings, const struct request *request, const char *scene);

#endif
