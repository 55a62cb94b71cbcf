/// A drag of the pointer. Only the panel that starts it gets its events.
#ifndef EDITOR_CORE_DRAG_H
#define EDITOR_CORE_DRAG_H

#include "editor/core/state.h"

enum drag_answer { DRAG_PASSES, DRAG_USED, DRAG_KEEP, DRAG_TAKE_BACK };

/// A drag's functions, each may be NULL. `room` is the panel that started it.
struct drag_owner {
    enum mouse_cursor cursor;
    bool goes_on; ///< apply() runs every frame and continues from its last edits

    /// Called when the pointer moves.
    void (*move)(void *room, struct core *core);
    /// Called once per frame with movement: edits the document as it was at the start.
    void (*apply)(void *room, struct core *core);
    /// For events other than the pointer's. DRAG_PASSES leaves them to the common handling.
    enum drag_answer (*event)(void *room, struct core *core, const struct event *event);
    /// Called before the undo step closes; `keep` false: before it is reverted.
    void (*end)(void *room, struct core *core, bool keep);
    /// Draws a running drag's marks.
    void (*show)(void *room, struct core *core);
};

/// Whether knots snap to frames; Ctrl inverts the panel's setting.
bool drag_snaps(const struct core *core, unsigned mods);
/// Starts a drag. Its undo step `label` (NULL: no edits) opens when the pointer moves.
void drag_begin(struct core *core, const struct drag_owner *owner, void *room, const char *label,
                const struct event *event);
/// Makes it a drag rather than a click, and opens its undo step.
void drag_start_moving(struct core *core);
/// Passes an event to the running drag; true if used.
bool drag_event(struct core *core, const struct event *event);
/// Call once per frame after its events: applies the drag's edits.
void drag_apply(struct core *core, double dt);
/// Reverts the drag's edits so far.
void drag_restart(const struct core *core);
/// Ends the running drag, if any; `keep` false reverts its edits.
void drag_end(struct core *core, bool keep);
/// Draws the running drag's marks if `room` started it.
void drag_show(const void *room, struct core *core);
/// X and Y restrict the drag to frames or values. false for other keys.
bool drag_lock(struct drag *drag, int key);
/// X, Y and Z restrict the drag to an `axis`; again, to none (−1).
bool drag_lock_axis(struct drag *drag, int *axis, int key);
/// Shows why a drag is stopped, while it is; "": it is not.
void drag_say_stopped(struct core *core, const char *why);

#endif
