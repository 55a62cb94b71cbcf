/// Handles that are dragged in two directions.
#include "maths/maths.h"
#include "ui/widgets_internal.h"
#include <math.h>

enum { REACH = 11, DRAG_THRESHOLD = 2 }; ///< pixels: around a point; a shorter drag is a click

static int nearest(const struct ui_handle *handles, int count, float x, float y)
{
    int best = -1;
    float least = REACH;
    for (int i = 0; i < count; i++) {
        float away = maths_hypotf(handles[i].x - x, handles[i].y - y);
        if (away < least) {
            least = away;
            best = i;
        }
    }
    return best;
}

/// The handle keeps its offset from the pointer; Shift: a tenth as fast.
static enum ui_change held_event(struct ui *ui, struct ui_handle *handle)
{
    const struct event *event = ui->event;
    if (event->kind != EVENT_POINTER) return ui_held_change(ui);
    ui->used = true;
    if (!ui->moved && maths_hypotf(event->x - ui->press_x, event->y - ui->press_y) < DRAG_THRESHOLD) return UI_NONE;
    float rate = event->mods & MOD_SHIFT ? 0.1f : 1;
    ui->moved = true;
    ui->handle_x += rate * (event->x - ui->press_x);
    ui->handle_y += rate * (event->y - ui->press_y);
    ui->press_x = event->x;
    ui->press_y = event->y;
    handle->x = ui->handle_x;
    handle->y = ui->handle_y;
    return UI_DRAG;
}

static enum ui_change focused_event(struct ui *ui, struct ui_handle *handle)
{
    if (!ui_focused_key(ui, ui_id(ui, handle->name))) return UI_NONE;
    int steps = ui->event->mods & MOD_SHIFT ? 10 : 1;
    switch (ui->event->key) {
    case KEY_LEFT:
        handle->step_x = -steps;
        break;
    case KEY_RIGHT:
        handle->step_x = steps;
        break;
    case KEY_DOWN:
        handle->step_y = -steps;
        break;
    case KEY_UP:
        handle->step_y = steps;
        break;
    default:
        return UI_NONE;
    }
    ui->used = true;
    return UI_NUDGE;
}

enum ui_change ui_handles(struct ui *ui, struct rect area, struct ui_handle *handles, int count, int *which)
{
    for (int i = 0; i < count; i++) {
        ui_register(ui, ui_id(ui, handles[i].name), (struct rect){handles[i].x - 1, handles[i].y - 1, 2, 2});
    }
    const int hot = ui->pass == UI_PASS_DRAW && ui_hovered(ui, area) && !ui->held
                        ? nearest(handles, count, ui->pointer_x, ui->pointer_y)
                        : -1;
    for (int i = 0; i < count && ui->pass == UI_PASS_DRAW; i++) {
        const uint32_t id = ui_id(ui, handles[i].name);
        const struct rect around = {handles[i].x - 8, handles[i].y - 8, 16, 16};
        const bool held = ui->held == id;
        if (held || i == hot) {
            ui->over = UI_OVER_NUMBER;
            drawlist_rounded_line(ui->list, around, 8, 1.5f, held ? theme()->accent : theme()->text_dim);
        }
        if (i == hot || ui->focus == id) ui_hint(ui, around, handles[i].hint);
        ui_focus_ring(ui, id, around);
    }
    if (ui->pass != UI_PASS_EVENT || ui->used) return UI_NONE;
    for (*which = 0; *which < count; ++*which) {
        struct ui_handle *handle = &handles[*which];
        if (ui->held == ui_id(ui, handle->name)) return held_event(ui, handle);
        enum ui_change change = focused_event(ui, handle);
        if (change != UI_NONE) return change;
    }
    const int at = nearest(handles, count, ui->event->x, ui->event->y);
    if (at < 0 || !ui_pressed(ui, area, BUTTON_LEFT)) return UI_NONE;
    ui_hold(ui, ui_id(ui, handles[at].name));
    ui->handle_x = handles[at].x;
    ui->handle_y = handles[at].y;
    return UI_NONE;
}
