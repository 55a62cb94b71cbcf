/// Rows of a list that a drag reorders.
#include "ui/widgets_internal.h"
#include <math.h>

enum { DRAG_THRESHOLD = 4 }; ///< pixels below which a press is a click

bool ui_is_dragged(const struct ui *ui, const char *name) { return ui->held == ui_id(name) && ui->moved; }

static enum ui_row_event held_event(struct ui *ui)
{
    const struct event *event = ui->event;
    bool release = event->kind == EVENT_BUTTON && event->action == ACTION_RELEASE && event->button == BUTTON_LEFT;
    bool escape = event->kind == EVENT_KEY && event->key == KEY_ESCAPE;
    bool dropped = release && ui->moved;
    if (event->kind == EVENT_POINTER) ui->moved |= fabsf(event->y - ui->press_y) >= DRAG_THRESHOLD;
    if (event->kind == EVENT_WHEEL) return UI_ROW_NONE;
    ui->used = true;
    if (release || escape) ui->held = 0;
    return dropped ? UI_ROW_DROPPED : UI_ROW_NONE;
}

static enum ui_row_event row_event(struct ui *ui, struct rect r, uint32_t id)
{
    if (ui->pass != UI_PASS_EVENT || ui->used || ui->blocked) return UI_ROW_NONE;
    if (ui->held == id) return held_event(ui);
    if (ui_activated(ui, id)) return UI_ROW_PRESSED;
    if (!ui_pressed(ui, r, BUTTON_LEFT)) return UI_ROW_NONE;
    if (ui->event->clicks == 2) return UI_ROW_TWICE;
    ui->held = id;
    ui->moved = false;
    ui->press_y = ui->event->y;
    return UI_ROW_PRESSED;
}

enum ui_row_event ui_sort_row(struct ui *ui, struct rect row, struct rect label, const char *name, const char *text,
                              bool selected)
{
    uint32_t id = ui_id(name);
    ui_register(ui, id, label);
    enum ui_row_event event = row_event(ui, label, id);
    if (ui->pass != UI_PASS_DRAW) return event;
    bool hot = ui_hovered(ui, row), dragged = ui_is_dragged(ui, name);
    struct rect back = {row.x - 4, row.y + 1, row.w + 8, row.h - 2};
    if (selected || hot || dragged)
        drawlist_rounded(ui->list, back, UI_RADIUS, selected ? theme()->fill : theme()->raised);
    if (selected) drawlist_rect(ui->list, (struct rect){back.x, back.y + 4, 2, back.h - 8}, theme()->accent);
    ui_label(ui, label, text, selected || hot ? theme()->text : theme()->text_dim);
    ui_focus_ring(ui, id, rect_inset(back, 1));
    return event;
}
