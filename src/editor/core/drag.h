/// A drag of the pointer: what all kinds have in common. What a kind does is in the room that begins it.
#ifndef EDITOR_CORE_DRAG_H
#define EDITOR_CORE_DRAG_H

#include "editor/core/state.h"

/// What an event means to a running drag.
enum drag_answer { DRAG_PASSES, DRAG_USED, DRAG_KEEP, DRAG_TAKE_BACK };

/// Whether knots go to whole frames: Ctrl turns around what the panel is set to.
bool drag_snaps(const struct core *core, unsigned mods);
/// Snapping to frames on, off; Ctrl means the other.
void drag_toggle_snap(struct core *core, const struct editor_world *world, int unused);
/// Whether dragging a body sets knots, on, off.
void drag_toggle_auto_key(struct core *core, const struct editor_world *world, int unused);
/// Starts a drag at a press; its history step, called `label` (NULL: it edits nothing), is opened only once the pointer has moved.
void drag_begin(struct core *core, enum drag_kind kind, const char *label, const struct event *event);
/// The pointer left the place of the press: this is a drag, not a click. Opens its history step.
void drag_start_moving(struct core *core, const struct editor_world *world);
/// Takes the pointer's way over; true where this is a drag, and no click.
bool drag_move(struct core *core, const struct editor_world *world, const struct event *event);
/// X and Y: only the frame, only the value may change. false for other keys.
bool drag_lock(struct drag *drag, int key);
/// The status line says what stops a drag for as long as that does; "": nothing.
void drag_say_stopped(struct core *core, const char *why);
/// What the buttons and Esc mean to all drags.
enum drag_answer drag_event(const struct drag *drag, const struct event *event);
/// Ends it and its step; `keep` false takes the edits back.
void drag_end(struct core *core, const struct editor_world *world, bool keep);

#endif
