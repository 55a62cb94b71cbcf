/// A drag of the pointer: distance, undo step, and calls to its owner.
#include "editor/core/core.h"
#include "maths/maths.h"

static const float CLICK_REACH = 3; ///< pixels a click may move
static const double FINE = 0.1;     ///< of the pointer's movement, with Shift

bool drag_snaps(const struct core *core, unsigned mods) { return core->view.on[SWITCH_SNAP] != !!(mods & MOD_CTRL); }

void drag_begin(struct core *core, const struct drag_owner *owner, void *room, const char *label,
                const struct event *event)
{
    core->input.drag = (struct drag){.owner = owner,
                                     .room = room,
                                     .label = label,
                                     .button = event->button,
                                     .x = event->x,
                                     .y = event->y,
                                     .start_x = event->x,
                                     .start_y = event->y,
                                     .snap = drag_snaps(core, event->mods)};
}

void drag_start_moving(struct core *core)
{
    struct drag *drag = &core->input.drag;
    if (drag->moved) return;
    drag->moved = true;
    if (drag->label && core_step(core, drag->label, 0)) core->step.ends = false;
}

void drag_restart(const struct core *core)
{
    if (core->input.drag.moved && core->input.drag.label) history_restart(core->history);
}

bool drag_event(struct core *core, const struct event *event)
{
    struct drag *drag = &core->input.drag;
    enum drag_answer answer = DRAG_PASSES;
    if (!drag->owner) return false;
    if (event->kind == EVENT_POINTER) { // adds up its movement; below CLICK_REACH the press stays a click
        const float dx = event->x - drag->x, dy = event->y - drag->y;
        const double fine = event->mods & MOD_SHIFT && drag->label ? FINE : 1;
        if (drag->moved && !drag->label) drag->moved_x = drag->moved_y = 0;
        drag->x = event->x;
        drag->y = event->y;
        drag->moved_x += dx * fine;
        drag->moved_y += dy * fine;
        drag->snap = drag_snaps(core, event->mods);
        drag->stale = true;
        const float away = maths_hypotf(event->x - drag->start_x, event->y - drag->start_y);
        if (!drag->moved && away < CLICK_REACH) return true;
        drag_start_moving(core);
        if (drag->owner->move) drag->owner->move(drag->room, core);
        return true;
    }
    if (drag->owner->event) answer = drag->owner->event(drag->room, core, event);
    if (answer == DRAG_PASSES && event->kind == EVENT_BUTTON) {
        answer = event->action == ACTION_RELEASE && event->button == drag->button ? DRAG_KEEP : DRAG_USED;
    } else if (answer == DRAG_PASSES && event->kind == EVENT_KEY) {
        answer = event->action == ACTION_PRESS && event->key == KEY_ESCAPE ? DRAG_TAKE_BACK : DRAG_PASSES;
    }
    if (answer == DRAG_KEEP || answer == DRAG_TAKE_BACK) drag_end(core, answer == DRAG_KEEP);
    return answer != DRAG_PASSES;
}

void drag_apply(struct core *core, double dt)
{
    struct drag *drag = &core->input.drag;
    const struct drag_owner *owner = drag->owner;
    if (!owner || !owner->apply || !drag->moved || !(drag->stale || owner->goes_on)) return;
    drag->stale = false;
    drag->dt = dt;
    if (!owner->goes_on) drag_restart(core);
    core->step.error = (struct error){0};
    owner->apply(drag->room, core);
    if (history_is_open(core->history)) core_keep_following(core);
    if (history_is_open(core->history)) core_settle(core);
}

void drag_end(struct core *core, bool keep)
{
    struct drag *drag = &core->input.drag;
    if (!drag->owner) return;
    drag->stale = true; // Alt may have been pressed or let go since
    if (keep && !drag->owner->goes_on) drag_apply(core, 0);
    if (drag->owner->end) drag->owner->end(drag->room, core, keep);
    if (drag->moved && drag->label) {
        if (keep) core_keep_following(core);
        if (!keep) drag_restart(core);
        if (!keep) selection_drop_from(&core->focus.selection, core->document->next_id);
        if (!keep && core->focus.pin >= core->document->next_id) core->focus.pin = 0;
        core_end(core);
        core_settle(core); // dragging a body may have added the first splines
    }
    *drag = (struct drag){0};
}

void drag_show(const void *room, struct core *core)
{
    const struct drag_owner *owner = core->input.drag.owner;
    if (owner && owner->show && core->input.drag.room == room) owner->show(core->input.drag.room, core);
}

bool drag_lock(struct drag *drag, int key)
{
    if (key != 'X' && key != 'Y') return false;
    drag->lock_x = key == 'X' && !drag->lock_x;
    drag->lock_y = key == 'Y' && !drag->lock_y;
    drag->stale = true;
    return true;
}

bool drag_lock_axis(struct drag *drag, int *axis, int key)
{
    if (key != 'X' && key != 'Y' && key != 'Z') return false;
    *axis = *axis == key - 'X' ? -1 : key - 'X';
    drag->stale = true;
    return true;
}

void drag_say_stopped(struct core *core, const char *why)
{
    if (*why) {
        core_stopped(core, why);
    } else if (core->input.drag.stopped) {
        core->message.text[0] = 0;
    }
    core->input.drag.stopped = *why;
}
