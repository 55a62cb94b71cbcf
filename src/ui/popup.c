/// Popups over a panel, and the widgets that open them.
#include "ui/widgets_internal.h"
#include <math.h>
#include <stdio.h>

enum { POPUP_PAD = 4, MAX_ROWS = 10 }; ///< padding; visible rows

void ui_popup_open(struct ui *ui, const char *name, int which, struct rect anchor)
{
    bool by_key = ui->event && ui->event->kind == EVENT_KEY;
    ui->popup = (struct ui_popup){
        .id = ui_hash(name), .which = which, .anchor = anchor, .opener = by_key ? ui->focus : 0, .fresh = true};
    ui->held = 0;
    ui->typing = 0;
}

void ui_popup_close(struct ui *ui)
{
    ui->focus = ui->popup.opener;
    if (ui->focus) ui_keep(ui, ui->focus);
    ui->popup.id = 0;
}

bool ui_popup_is_open(const struct ui *ui, const char *name) { return ui->popup.id == ui_hash(name); }

void ui_popup_begin(struct ui *ui, float width, float height)
{
    // Below the anchor, or above if there is more room; inside the panel or `room`.
    const bool is_beside = ui->popup.room.w > 0;
    const struct rect anchor = ui->popup.anchor, area = is_beside ? ui->popup.room : ui->area;
    const float below = area.y + area.h - (anchor.y + anchor.h), above = anchor.y - area.y;
    height += 2 * POPUP_PAD;
    const bool up = height > below && above > below;
    height = fminf(height, up ? above : below);
    const float x = fmaxf(fminf(anchor.x, area.x + area.w - width - POPUP_PAD), area.x);
    const struct rect box = {x, up ? anchor.y - height : anchor.y + anchor.h, width, height};
    ui->blocked = false;
    ui->popup.built = true;
    ui->stop_count = 0; // Tab stays in the popup
    if (is_beside) ui->clip = ui->popup.room;
    if (is_beside && ui->pass == UI_PASS_DRAW) drawlist_set_clip(ui->list, ui->popup.room);
    if (ui->pass == UI_PASS_DRAW) {
        drawlist_rounded(ui->list, rect_inset(box, -1), UI_RADIUS + 2, theme()->veil);
        drawlist_rounded(ui->list, box, UI_RADIUS + 1, theme()->raised);
        ui_outline(ui, box, UI_RADIUS + 1, false);
    }
    ui_scroll_begin(ui, &ui->popup.scroll, rect_inset(box, POPUP_PAD));
}

void ui_popup_end(struct ui *ui)
{
    struct rect box = ui->scroll_area;
    ui_scroll_end(ui);
    if (ui->pass != UI_PASS_EVENT || ui->popup.id == 0) return;
    if (ui->popup.fresh) {
        ui->focus = ui->popup.focus ? ui->popup.focus : ui->stop_count > 0 ? ui->stop[0].id : 0;
        return;
    }
    if (ui->used) return;
    const struct event *event = ui->event;
    bool press = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS;
    if (press) ui->used = true; // a press beside the popup's widgets is used up
    if (press && !rect_contains(box, event->x, event->y)) ui_popup_close(ui);
    if (event->kind == EVENT_WHEEL || event->kind == EVENT_TEXT) ui->used = true;
    if (event->kind != EVENT_KEY) return;
    if (event->mods & (MOD_CTRL | MOD_ALT | MOD_SUPER)) {
        ui_popup_close(ui); // the editor handles the key
        return;
    }
    ui->used = true;
    if (event->action == ACTION_RELEASE) return;
    if (event->key == KEY_ESCAPE) ui_popup_close(ui);
    if (event->key == KEY_UP || event->key == KEY_LEFT) ui_move_focus(ui, -1);
    if (event->key == KEY_DOWN || event->key == KEY_RIGHT) ui_move_focus(ui, 1);
    if (event->key == KEY_TAB) ui_move_focus(ui, event->mods & MOD_SHIFT ? -1 : 1);
}

void ui_dropdown(struct ui *ui, struct rect r, const char *name, int which, const char *text, uint32_t color)
{
    struct rect field = ui_field_of(r);
    char full[96]; // several may open the same popup
    snprintf(full, sizeof full, "%s.%d", name, which);
    uint32_t id = ui_id(ui, full);
    if (ui_clicked(ui, id, field))
        ui_popup_open(ui, name, which, field); // a second press counts as outside, which closes it
    if (ui->pass != UI_PASS_DRAW) return;
    bool hot = ui_hovered(ui, field) || (ui_popup_is_open(ui, name) && ui->popup.which == which);
    drawlist_rounded(ui->list, field, UI_RADIUS, theme()->raised);
    ui_outline(ui, field, UI_RADIUS, hot);
    float left = field.x + UI_GAP, x = field.x + field.w - 14, y = field.y + field.h / 2;
    if (color) {
        drawlist_rounded(ui->list, (struct rect){left, y - 4, 8, 8}, 3, color);
        left += 14;
    }
    ui_label(ui, (struct rect){left, field.y, x - 4 - left, field.h}, text, theme()->text);
    const float arrow[6] = {x - 1, y - 2, x + 7, y - 2, x + 3, y + 2};
    drawlist_convex(ui->list, arrow, 3, hot ? theme()->text : theme()->text_dim);
    ui_focus_ring(ui, id, field);
}

void ui_swatch(struct ui *ui, struct rect r, const char *name, const char *popup, int which, uint32_t color)
{
    uint32_t id = ui_id(ui, name);
    if (ui_clicked(ui, id, r)) ui_popup_open(ui, popup, which, r);
    if (ui->pass != UI_PASS_DRAW) return;
    struct rect chip = {r.x + (r.w - 10) / 2, r.y + (r.h - 10) / 2, 10, 10};
    drawlist_rounded(ui->list, chip, 3, color);
    if (ui_hovered(ui, r)) drawlist_rounded_line(ui->list, rect_inset(chip, -2), 4, 1, theme()->text_dim);
    ui_focus_ring(ui, id, rect_inset(chip, -1));
}

bool ui_color(struct ui *ui, struct rect r, const char *name, uint32_t color, bool chosen)
{
    uint32_t id = ui_id(ui, name);
    struct rect field = rect_inset(r, 4);
    bool pressed = ui_clicked(ui, id, r);
    if (ui->pass != UI_PASS_DRAW) return pressed;
    drawlist_rounded(ui->list, field, UI_RADIUS, color);
    if (chosen || ui_hovered(ui, r)) {
        drawlist_rounded_line(ui->list, rect_inset(field, -2), UI_RADIUS + 1, 1.5f,
                              chosen ? theme()->text : theme()->control);
    }
    ui_focus_ring(ui, id, rect_inset(field, -1));
    return pressed;
}

/// Opens the scope of a row, because two may have one name: None, and a clip called none.
static uint32_t push_row(struct ui *ui, int row, const struct ui_item *item, char name[UI_NAME_SIZE])
{
    snprintf(name, UI_NAME_SIZE, "item.%s", item->name);
    ui_push(ui, (uint32_t)row);
    return ui_id(ui, name);
}

/// The least fit of a shown row.
static enum fit least_fit(const struct ui *ui, const struct ui_item *items, int count)
{
    enum fit best = FIT_NOT;
    for (int i = 0; i < count; i++) {
        const enum fit fit = ui_filter_fit(&ui->popup.filter, items[i].label);
        if (fit > best) best = fit;
    }
    return ui_filter_least(best);
}

int ui_popup_list(struct ui *ui, const char *name, const struct ui_item *items, int count, int chosen)
{
    int picked = -1;
    if (!ui_popup_is_open(ui, name)) return -1;
    const bool is_long = count > MAX_ROWS, searches = is_long || ui->popup.filter.typed[0];
    const enum fit least = least_fit(ui, items, count);
    ui_popup_begin(ui, ui->popup.anchor.w, (float)(UI_ROW * ((is_long ? MAX_ROWS : count) + searches)));
    struct rect area = ui->scroll_area;
    if (searches) { // the typed text or a hint, above the rows
        const char *typed = ui->popup.filter.typed;
        const struct rect r = {area.x + 12, ui->y, area.w - 24, UI_ROW};
        ui_label(ui, r, *typed ? typed : "Type to search", *typed ? theme()->accent : theme()->text_dim);
        ui_space(ui, UI_ROW);
    }
    for (int i = 0; i < count; i++) {
        char row[UI_NAME_SIZE];
        if (ui_filter_fit(&ui->popup.filter, items[i].label) < least) continue;
        const uint32_t id = push_row(ui, i, &items[i], row);
        if (ui->popup.fresh && i == chosen) ui->popup.focus = id;
        struct rect r = {area.x + 6, ui->y, area.w - 12, UI_ROW};
        ui_space(ui, UI_ROW);
        if (ui_list_row(ui, r, row, items[i].label, items[i].color, i == chosen)) picked = i;
        ui_pop(ui);
    }
    // Typed text changes the filter and focuses the first matching row. Space picks that row.
    const bool is_space = ui->pass == UI_PASS_EVENT && ui->event->kind == EVENT_TEXT && ui->event->codepoint == ' ';
    if (ui->pass == UI_PASS_EVENT && !ui->used && !is_space && ui_filter_event(&ui->popup.filter, ui->event)) {
        const enum fit now = least_fit(ui, items, count);
        char row[UI_NAME_SIZE];
        int i = 0;
        while (i < count && ui_filter_fit(&ui->popup.filter, items[i].label) < now) i++;
        ui->used = true;
        ui->popup.scroll.offset = 0;
        if (i < count) {
            ui->focus = push_row(ui, i, &items[i], row);
            ui_pop(ui);
            ui_keep(ui, ui->focus);
        }
    }
    ui_popup_end(ui);
    if (picked >= 0) ui_popup_close(ui);
    return picked;
}
