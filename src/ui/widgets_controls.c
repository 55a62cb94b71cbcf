/// Labels, buttons, toggles, choices and sections.
#include "ui/widgets_internal.h"
#include <math.h>
#include <stdio.h>

struct rect ui_field_of(struct rect row) { return (struct rect){row.x, row.y + 2, row.w, row.h - 4}; }

float ui_baseline(struct rect r, enum font font, float size)
{
    return roundf(r.y + (r.h + font_cap_height(font, size)) / 2);
}

void ui_focus_ring(struct ui *ui, uint32_t id, struct rect r)
{
    if (ui->focus == id) drawlist_rounded_line(ui->list, rect_inset(r, -1), UI_RADIUS + 1, 1.5f, theme()->accent);
}

void ui_outline(struct ui *ui, struct rect r, float radius, bool hot)
{
    drawlist_rounded_line(ui->list, r, radius, 1, hot ? theme()->text_dim : theme()->control);
}

static void paint_label(struct ui *ui, struct rect r, enum font font, const char *text, uint32_t color)
{
    float y = ui_baseline(r, font, THEME_TEXT_NORMAL);
    drawlist_text_fit(ui->list, r.x, y, r.w, font, THEME_TEXT_NORMAL, color, text);
}

void ui_label(struct ui *ui, struct rect r, const char *text, uint32_t color)
{
    if (ui->pass == UI_PASS_DRAW) paint_label(ui, r, FONT_LABEL, text, color);
}

static void paint_right(struct ui *ui, struct rect r, enum font font, float size, const char *text, uint32_t color)
{
    float w = fminf(r.w, font_width(font, size, text));
    drawlist_text_fit(ui->list, r.x + r.w - w, ui_baseline(r, font, size), w, font, size, color, text);
}

void ui_label_right(struct ui *ui, struct rect r, const char *text, uint32_t color)
{
    if (ui->pass == UI_PASS_DRAW) paint_right(ui, r, FONT_LABEL, THEME_TEXT_NORMAL, text, color);
}

void ui_number_text(struct ui *ui, struct rect r, const char *text, uint32_t color)
{
    paint_right(ui, r, FONT_NUMBER, THEME_TEXT_SMALL, text, color);
}

void ui_paragraph(struct ui *ui, const char *text, uint32_t color)
{
    enum { LINE = 16, MAX_LINES = 4 };
    for (int line = 0; line < MAX_LINES && *text; line++) {
        struct rect r = ui_row(ui, LINE);
        const char *start = text;
        const size_t length = font_take_line(THEME_TEXT_SMALL, r.w, &text);
        if (ui->pass != UI_PASS_DRAW) continue;
        char part[257];
        snprintf(part, sizeof part, "%.*s", (int)length, start);
        float y = ui_baseline(r, FONT_LABEL, THEME_TEXT_SMALL);
        drawlist_text_fit(ui->list, r.x, y, r.w, FONT_LABEL, THEME_TEXT_SMALL, color,
                          line == MAX_LINES - 1 ? start : part);
    }
}

bool ui_section(struct ui *ui, const char *name, const char *title, bool *closed)
{
    ui_space(ui, 4);
    struct rect line = {ui->area.x, ui->y, ui->area.w, 1};
    struct rect r = ui_row(ui, UI_ROW);
    uint32_t id = ui_id(ui, name);
    bool first = ui->stop_count == 0;
    ui_hint(ui, r, *closed ? "Open this section" : "Close this section");
    if (ui_clicked(ui, id, r)) *closed = !*closed;
    if (ui->pass == UI_PASS_DRAW) {
        if (!first) drawlist_rect(ui->list, line, theme()->border);
        uint32_t color = ui_hovered(ui, r) ? theme()->text : theme()->text_dim;
        const float x = r.x, y = r.y + r.h / 2; // a triangle
        const float right[6] = {x + 1, y - 4, x + 5, y, x + 1, y + 4};
        const float down[6] = {x - 1, y - 2, x + 7, y - 2, x + 3, y + 2};
        drawlist_convex(ui->list, *closed ? right : down, 3, color);
        paint_label(ui, (struct rect){r.x + 14, r.y, r.w - 14, r.h}, FONT_LABEL_BOLD, title, color);
        ui_focus_ring(ui, id, (struct rect){r.x - 4, r.y + 3, r.w + 8, r.h - 6});
    }
    return !*closed;
}

float ui_text_width(const char *text) { return font_width(FONT_LABEL, THEME_TEXT_NORMAL, text); }

static void paint_centred(struct ui *ui, struct rect r, const char *text, uint32_t color)
{
    float w = fminf(r.w - 4, ui_text_width(text));
    paint_label(ui, (struct rect){roundf(r.x + (r.w - w) / 2), r.y, w, r.h}, FONT_LABEL, text, color);
}

bool ui_button(struct ui *ui, struct rect r, const char *name, const char *label, bool primary)
{
    struct rect field = ui_field_of(r);
    uint32_t id = ui_id(ui, name);
    bool pressed = ui_clicked(ui, id, field);
    if (ui->pass == UI_PASS_DRAW) {
        bool hot = ui_hovered(ui, field);
        uint32_t fill = primary ? theme()->accent : hot ? theme()->hover : theme()->fill;
        drawlist_rounded(ui->list, field, UI_RADIUS, fill);
        if (!primary) ui_outline(ui, field, UI_RADIUS, hot);
        paint_centred(ui, field, label, primary ? theme()->panel : theme()->text);
        ui_focus_ring(ui, id, rect_inset(field, primary ? -2 : 0));
    }
    return pressed;
}

bool ui_toggle(struct ui *ui, struct rect r, const char *name, bool *on)
{
    struct rect box = {r.x, r.y + (r.h - 16) / 2, 28, 16};
    uint32_t id = ui_id(ui, name);
    bool pressed = ui_clicked(ui, id, box);
    if (pressed) *on = !*on;
    if (ui->pass == UI_PASS_DRAW) {
        uint32_t fill = *on ? theme()->accent : ui_hovered(ui, box) ? theme()->hover : theme()->fill;
        drawlist_rounded(ui->list, box, 8, fill);
        if (!*on) ui_outline(ui, box, 8, ui_hovered(ui, box));
        struct rect knob = {box.x + (*on ? 14.0f : 2.0f), box.y + 2, 12, 12};
        drawlist_rounded(ui->list, knob, 6, *on ? theme()->panel : theme()->text_dim);
        ui_focus_ring(ui, id, rect_inset(box, -1));
    }
    return pressed;
}

static void paint_row(struct ui *ui, uint32_t id, struct rect r, bool selected, bool lit)
{
    const struct rect back = {r.x - 4, r.y + 1, r.w + 8, r.h - 2};
    if (selected || lit) drawlist_rounded(ui->list, back, UI_RADIUS, selected ? theme()->fill : theme()->raised);
    if (selected) drawlist_rect(ui->list, (struct rect){back.x, back.y + 4, 2, back.h - 8}, theme()->accent);
    ui_focus_ring(ui, id, rect_inset(back, 1));
}

bool ui_list_row(struct ui *ui, struct rect r, const char *name, const char *text, uint32_t color, bool selected)
{
    uint32_t id = ui_id(ui, name);
    bool pressed = ui_clicked(ui, id, r);
    if (ui->pass == UI_PASS_DRAW) {
        const bool hot = ui_hovered(ui, r);
        float left = r.x + 6;
        paint_row(ui, id, r, selected, hot);
        if (color) {
            drawlist_rounded(ui->list, (struct rect){left, r.y + (r.h - 10) / 2, 10, 10}, 3, color);
            left += 18;
        }
        struct rect label = {left, r.y, r.x + r.w - left, r.h};
        paint_label(ui, label, FONT_LABEL, text, selected || hot ? theme()->text : theme()->text_dim);
    }
    return pressed;
}

bool ui_segments(struct ui *ui, struct rect r, const char *name, const struct ui_choice *choices, int count,
                 int *index)
{
    struct rect field = ui_field_of(r);
    uint32_t id = ui_id(ui, name);
    int before = *index, next = -1;
    float w = field.w / (float)count;
    ui_register(ui, id, field);
    for (int i = 0; i < count; i++) {
        struct rect part = {field.x + w * (float)i, field.y, w, field.h};
        if (ui_pressed(ui, part, BUTTON_LEFT)) next = i;
        char full[96];
        snprintf(full, sizeof full, "%s.%s", name, choices[i].name);
        if (ui->pass == UI_PASS_FIND && ui->find == ui_hash(full)) {
            ui->found_x = part.x + part.w / 2;
            ui->found_y = part.y + part.h / 2;
            ui->found = rect_contains(ui->clip, ui->found_x, ui->found_y) ? id : 0;
        }
    }
    if (ui_focused_key(ui, id) && (ui->event->key == KEY_LEFT || ui->event->key == KEY_RIGHT)) {
        const bool left = ui->event->key == KEY_LEFT;
        next = left ? (before > 0 ? before - 1 : 0) : before < count - 1 ? before + 1 : count - 1;
        ui->used = true;
    }
    if (ui->pass == UI_PASS_DRAW) {
        drawlist_rounded(ui->list, field, UI_RADIUS, theme()->raised);
        ui_outline(ui, field, UI_RADIUS, false);
        for (int i = 0; i < count; i++) {
            const struct rect part = {field.x + w * (float)i, field.y, w, field.h};
            const bool hot = ui_hovered(ui, part);
            if (i == before) {
                drawlist_rounded(ui->list, rect_inset(part, 1), UI_RADIUS - 1, theme()->hover);
                const struct rect mark = {part.x + 8, part.y + part.h - 3, part.w - 16, 2};
                drawlist_rect(ui->list, mark, theme()->accent);
            }
            paint_centred(ui, part, choices[i].label, i == before || hot ? theme()->text : theme()->text_dim);
        }
        ui_focus_ring(ui, id, field);
    }
    if (next < 0 || next == before) return false;
    *index = next;
    return true;
}

enum { DRAG_THRESHOLD = 4 }; ///< pixels; a shorter way is a click

bool ui_is_dragged(const struct ui *ui, const char *name) { return ui->held == ui_id(ui, name) && ui->moved; }

enum ui_row_event ui_sort_row(struct ui *ui, struct rect row, struct rect label, const char *name, const char *text,
                              bool selected)
{
    uint32_t id = ui_id(ui, name);
    ui_register(ui, id, label);
    if (ui->pass == UI_PASS_EVENT && !ui->used && !ui->blocked && ui->held == id) {
        const struct event *event = ui->event;
        const bool release =
            event->kind == EVENT_BUTTON && event->action == ACTION_RELEASE && event->button == BUTTON_LEFT;
        const bool escape = event->kind == EVENT_KEY && event->key == KEY_ESCAPE;
        if (event->kind == EVENT_POINTER) ui->moved |= fabsf(event->y - ui->press_y) >= DRAG_THRESHOLD;
        if (event->kind == EVENT_WHEEL) return UI_ROW_NONE;
        ui->used = true;
        if (release || escape) ui->held = 0;
        return release && ui->moved ? UI_ROW_DROPPED : UI_ROW_NONE;
    }
    if (ui_activated(ui, id)) return UI_ROW_PRESSED;
    if (ui_pressed(ui, label, BUTTON_LEFT)) {
        if (ui->event->clicks == 2) return UI_ROW_TWICE;
        ui_hold(ui, id);
        return UI_ROW_PRESSED;
    }
    if (ui->pass != UI_PASS_DRAW) return UI_ROW_NONE;
    const bool hot = ui_hovered(ui, row);
    paint_row(ui, id, row, selected, hot || ui_is_dragged(ui, name));
    ui_label(ui, label, text, selected || hot ? theme()->text : theme()->text_dim);
    return UI_ROW_NONE;
}
