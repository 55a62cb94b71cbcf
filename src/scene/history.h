/// Undo history: earlier documents, the steps between them, and which one is current.
///
/// A step is a group of edits that one undo reverts. The open step edits the current document; data shared with the history is never changed. A
/// drag repeats its edits in every frame: history_restart() goes back to the start of the step.
#ifndef SCENE_HISTORY_H
#define SCENE_HISTORY_H

#include "scene/document.h"
#include <stddef.h>

/// Undo and redo of one document. Opaque.
struct history;

/// `document` must outlive the history; history_undo() and others change it. NULL: call history_clear() first.
struct history *history_create(struct document *document);
/// NULL is fine.
void history_destroy(struct history *history);
/// Forgets everything, for a new document.
void history_clear(struct history *history, struct document *document);

/// Opens a step called `label` ("Move knot"; a string constant). If `merge` is not 0 and equals the last step's, and nothing was
/// undone since, the edits join that step, as for repeated nudges of one selection.
void history_begin(struct history *history, const char *label, uint64_t merge);
/// Reverts the edits of the open step, which stays open: for the next frame of a drag, or for Esc before history_end().
void history_restart(struct history *history);
/// Closes the step. A step without changes is dropped; then it returns false.
bool history_end(struct history *history);
/// Gives the last step what the user saw as it began and ended, both freed by free(). A joined step keeps its first beginning.
void history_see(struct history *history, void *began, void *ended);
/// As the last undone step began, or as the last done one ended; NULL: nothing is known.
const void *history_seen(const struct history *history, bool undone);
/// Whether a step is open.
bool history_is_open(const struct history *history);
/// The document as it was before the open step, or is if none is open.
const struct document *history_before(const struct history *history);

/// Undoes the last step, or redoes the next; false if there is none. No step may be open.
bool history_undo(struct history *history);
bool history_redo(struct history *history);

/// The steps, oldest first: how many there are, how many are not undone, their labels; NULL: there is no such step.
size_t history_count(const struct history *history);
size_t history_done(const struct history *history);
const char *history_label(const struct history *history, size_t step);
/// Whether the state after the first `done` steps is the saved one.
bool history_step_is_saved(const struct history *history, size_t done);
/// Undoes or redoes until `done` steps are done; false if nothing changes. No step may be open.
bool history_jump(struct history *history, size_t done);
/// Steps that were dropped, and bytes that the rest replaced. Above the limit (128 MiB) the oldest are dropped; the newest stays,
/// however large.
size_t history_dropped(const struct history *history);
size_t history_bytes(const struct history *history);
void history_set_limit(struct history *history, size_t bytes);

/// Changes with every edit, undo and redo and never repeats; tells whether the document has changed.
uint64_t history_revision(const struct history *history);
/// Marks the current state as saved; history_is_saved() is true whenever undo or redo returns to it.
void history_mark_saved(struct history *history);
/// Marks no state as saved, as for a recovered document.
void history_mark_unsaved(struct history *history);
bool history_is_saved(const struct history *history);

/// Adds a change that is not an edit, such as paint read from its file, to the current state. No step may be open.
void history_amend(struct history *history);
/// Sets the path of the document's own file; undo and redo keep it.
void history_set_path(struct history *history, const char *path);

#endif
