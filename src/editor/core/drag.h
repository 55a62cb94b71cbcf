/// A drag of the pointer. The room that starts it owns it; no other gets its events.
#ifndef EDITOR_CORE_DRAG_H
#define EDITOR_CORE_DRAG_H

#include "editor/core/state.h"

/// Effect of an event on a running drag.
enum drag_answer { DRAG_PASSES, DRAG_USED, DRAG_KEEP, DRAG_TAKE_BACK };

/// Functions of a drag; each may be NULL. `room` is the panel that began it.
struct drag_owner {
    enum mouse_cursor cursor;
    bool goes_on; ///< apply() is called in every frame, and continues from the edits of the last one

    /// The pointer has moved.
    void (*move)(void *room, struct core *core);
    /// Once in a frame with movements: makes the edits, on the document as it was when the drag began.
    void (*apply)(void *room, struct core *core);
    /// Events but the pointer's; those it passes on mean the same to all drags.
    enum drag_answer (*event)(void *room, struct core *core, const struct event *event);
    /// Before its step is closed; `keep` false: before its edits are taken back.
    void (*end)(void *room, struct core *core, bool keep);
    /// Draws the marks of a running drag.
    void (*show)(void *room, struct core *core);
};

/// Whether knots snap to frames: Ctrl reverses the panel's setting.
bool drag_snaps(const struct core *core, unsigned mods);
/// Starts a drag at a press; its history step, called `label` (NULL: it edits nothing), is opened only once the pointer has moved.
void drag_begin(struct core *core, const struct drag_owner *owner, void *room, const char *label,
                const struct event *event);
/// This is a drag, not a click. Opens its history step.
void drag_start_moving(struct core *core);
/// Hands an event to the running drag; true where that uses it up.
bool drag_event(struct core *core, const struct event *event);
/// Once a frame, after its events: the running drag makes its edits.
void drag_apply(struct core *core, double dt);
/// Takes the edits back that the drag has made so far.
void drag_restart(const struct core *core);
/// Ends the running drag and its step; `keep` false takes the edits back. Nothing where none runs.
void drag_end(struct core *core, bool keep);
/// Draws the marks of the running drag, if this room began it.
void drag_show(const void *room, struct core *core);
/// X and Y: only the frame, only the value may change. false for other keys.
bool drag_lock(struct drag *drag, int key);
/// X, Y and Z: only along that `axis`, or again along all of them (−1).
bool drag_lock_axis(struct drag *drag, int *axis, int key);
/// Shows why a drag stops for as long as it does; "": it does not.
void drag_say_stopped(struct core *core, const char *why);

#endif
