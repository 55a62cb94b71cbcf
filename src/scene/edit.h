/// Edit operations: the only way to change a document, each with its inverse, kept in a history of steps.
///
/// A step is what one undo takes back: one or more edits that belong together. A drag re-applies its step each frame:
/// history_restart() takes the edits of the running step back, then new ones are applied from the same original
/// state.
#ifndef SCENE_EDIT_H
#define SCENE_EDIT_H

#include "scene/document.h"
#include <stddef.h>

enum edit_kind {
    EDIT_KNOT_INSERT, ///< spline, knot (id 0: a new one is given)
    EDIT_KNOT_REMOVE, ///< spline, knot.id
    EDIT_KNOT_SET,    ///< spline, knot (found by id; frame, value, slope, has_slope, stiffness are replaced)
    EDIT_PARAMETER, ///< spline, parameter, param. The mode converts ω = √k, ζ = γ/2√k and clamps, so that what is saved loads
    EDIT_SPRING,      ///< spline, flag: whether spring and friction are in use (real mode only)
    EDIT_SPLINE_ADD,  ///< spline: its place in the list, text (NULL: a free name), knot where `flag`: its first. f 1,
                      ///< ζ 0.1, β 0.1
    EDIT_SPLINE_COPY, ///< spline: a copy behind it, under a free name, with knots of its own ids
    EDIT_SPLINE_REMOVE, ///< spline; refused where something follows it
    EDIT_SPLINE_MOVE,   ///< spline, to: its new place in the list
    EDIT_SPLINE_NAME,   ///< spline, text: not empty, and no other's name
    EDIT_SPLINE_COLOR,  ///< spline, color: 0xRRGGBB, or -1
    EDIT_DOCUMENT, ///< document: another whole one in place of this, the history's from here on (also on failure)
    EDIT_FPS, ///< number; flag: knots and range keep their seconds, not their frames. Slopes are per second anyway
    EDIT_SUBSTEPS, ///< substeps
    EDIT_RANGE,    ///< first, last: the scene's frames; fit: what becomes of knots that would lie outside
    EDIT_ANGLES,   ///< rig, channel (-1: rest), angle: which, angles
    EDIT_AXIS,     ///< rig, channel, axis
    EDIT_PART,     ///< rig, channel, of
    EDIT_FEED,     ///< rig, channel, spline: the spline that the channel bends by
    EDIT_POSITION, ///< rig, coordinate, param: metres, or a spline to follow
    EDIT_LENGTH,   ///< rig, number: metres, above 0
    EDIT_JOINTS,   ///< rig, to: how many; the tail keeps its shape
    EDIT_TAIL_ADD, ///< rig: a copy of it beside it; where that is no tail, a plain one bent by `spline` (-1: by nothing)
    EDIT_TAIL_REMOVE,    ///< rig
    EDIT_TAIL_NAME,      ///< rig, text: not empty, and no other rig's
    EDIT_CHANNEL_ADD,    ///< rig, spline, axis, of: one more, the last
    EDIT_CHANNEL_REMOVE, ///< rig, channel
    EDIT_DRIVE,          ///< rig, channel: which drive, drive: replaces spline, amplitude and lag
    EDIT_DRIVE_ADD,      ///< rig, drive (its name is copied)
    EDIT_DRIVE_REMOVE,   ///< rig, channel: which drive
    EDIT_PAINT_NEW, ///< rig, coordinates, vertices (of its model): paint that changes nothing in place of what is there
    EDIT_PAINT,     ///< rig, dab. All dabs of a step on one coordinate make one change of what they touch
};

enum range_fit {
    RANGE_REFUSE,
    RANGE_MOVE, ///< to the nearest free samples inside, in their order
    RANGE_TRIM, ///< they go
};

enum angle_kind { ANGLE_REST, ANGLE_LAG, ANGLE_GAIN };

struct edit {
    enum edit_kind kind;
    int spline;
    struct knot knot;
    enum parameter parameter;
    struct param param;
    bool flag;
    const char *text; ///< read during the call only
    int to, color;
    struct document *document;
    int substeps, first, last;
    enum range_fit fit;
    int rig; ///< index of a rig of the kind that the edit is of
    int channel;
    enum angle_kind angle;
    enum axis axis;
    enum channel_part of;
    int coordinate; ///< 0 … 2: x, y, z
    double number;
    struct drive drive;
    int coordinates, vertices;
    const struct dab *dab;       ///< read during the call only
    const struct angles *angles; ///< read during the call only
};

/// Undo and redo of one document. Opaque.
struct history;

struct history *history_create(void);
void history_destroy(struct history *history);
/// Forgets everything (a new document was opened).
void history_clear(struct history *history);

/// Opens a step called `label` ("Move knot"; a string constant). Where `merge` is not 0 and equals that of the last
/// step on the stack, and nothing was undone since, the edits join that step (runs of the same nudge on the same
/// selection).
void history_begin(struct history *history, const char *label, uint64_t merge);
/// Applies an edit inside the open step. false with a sentence where it is not possible: occupied sample, outside the
/// range, not finite, track cycle, knot not found …; the document is then as before this edit.
bool history_apply(struct history *history, struct document *document, const struct edit *edit, struct error *error);
/// Takes back the edits of the open step; the step stays open (next frame of a drag, or Esc before history_end()).
void history_restart(struct history *history, struct document *document);
/// Closes the step; an empty one leaves no trace.
void history_end(struct history *history);
/// Whether a step is open.
bool history_is_open(const struct history *history);

/// Takes the last step back or does it again; false where there is none. A step must not be open.
bool history_undo(struct history *history, struct document *document);
bool history_redo(struct history *history, struct document *document);
/// Label of what undo / redo would do next, or NULL.
const char *history_undo_label(const struct history *history);
const char *history_redo_label(const struct history *history);

/// The steps from the oldest kept one on: how many there are, how many of them are not undone, their labels.
size_t history_count(const struct history *history);
size_t history_done(const struct history *history);
const char *history_label(const struct history *history, size_t step);
/// Whether the document was saved as it is after the first `done` steps.
bool history_step_is_saved(const struct history *history, size_t done);
/// Undoes or does again until `done` steps are done; false where nothing changes. A step must not be open.
bool history_jump(struct history *history, struct document *document, size_t done);
/// Older steps that were dropped, and bytes that the others take. The limit (128 MiB; with what the arrays have in
/// reserve, at most 256) is kept by dropping the oldest; the newest step stays, however large.
size_t history_dropped(const struct history *history);
size_t history_bytes(const struct history *history);
void history_set_limit(struct history *history, size_t bytes);

/// Changes with every apply, undo and redo and never repeats: "has the document changed since".
uint64_t history_revision(const struct history *history);
/// Marks the present state as saved; history_is_saved() is true again whenever undo or redo comes back to it.
void history_mark_saved(struct history *history);
/// No state of the history is a saved one (the document was recovered).
void history_mark_unsaved(struct history *history);
bool history_is_saved(const struct history *history);

/// Splines whose solution the edits since the last call may have changed, as flags; followers of tracks are not
/// included. Clears the flags. `count` flags are written; the scene's range marks all.
void history_take_dirty(struct history *history, const struct document *document, bool *dirty, int count);

#endif
