/// Widgets: focus, layout, scrolling and hit-testing; labels, buttons, choices, icons, popups and tooltips. What is typed or dragged is in
/// widgets_edit.c.
#include "ui/widgets.h"
#include "base/error.h"
#include "maths/maths.h"
#include "ui/widgets_internal.h"
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

// --- passes, focus and scrolling

static void begin_pass(struct ui *ui, enum ui_pass pass, struct rect area)
{
    ui->pass = pass;
    ui->area = area;
    ui->clip = area;
    ui->y = area.y;
    ui->event = NULL;
    ui->list = NULL;
    ui->find = 0;
    ui->found = 0;
    ui->used = false;
    ui->began = false;
    ui->scrolled = NULL;
    ui->stop_count = 0;
    ui->depth = 0;
    ui->popup.built = ui->popup.fresh = false;
    ui->focus_hint = ui->offered = NULL;
    ui->blocked = ui->popup.id != 0 && pass != UI_PASS_FIND;
}

void ui_begin_event(struct ui *ui, struct rect area, const struct event *event)
{
    begin_pass(ui, UI_PASS_EVENT, area);
    ui->event = event;
    ui->hint = NULL;
    if (event->kind == EVENT_POINTER || event->kind == EVENT_BUTTON || event->kind == EVENT_WHEEL) {
        ui->pointer_x = event->x;
        ui->pointer_y = event->y;
    }
    if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) ui->focus = 0;
}

void ui_begin_draw(struct ui *ui, struct rect area, struct drawlist *list)
{
    begin_pass(ui, UI_PASS_DRAW, area);
    ui->list = list;
    ui->list_clip = drawlist_push_clip(list, area);
    ui->hint = NULL;
    ui->over = UI_OVER_NOTHING;
}

void ui_begin_find(struct ui *ui, struct rect area, const char *name, const double *value)
{
    begin_pass(ui, UI_PASS_FIND, area);
    ui->find = ui_hash(name);
    ui->find_value = value ? *value : NAN;
}

/// A widget's place among the last pass's; -1: none.
static int place_of(const struct ui *ui, uint32_t id)
{
    int at = ui->stop_count - 1;
    while (at >= 0 && ui->stop[at].id != id) at--;
    return at;
}

bool ui_has_next(const struct ui *ui, int direction)
{
    const int at = place_of(ui, ui->focus), next = at + direction;
    return at < 0 ? ui->stop_count > 0 : next >= 0 && next < ui->stop_count;
}

/// Moves the focus to the next (1) or previous (-1) widget, cyclically, and scrolls to it.
static void move_focus(struct ui *ui, int direction)
{
    if (ui->stop_count == 0) return;
    int at = place_of(ui, ui->focus);
    const int count = ui->stop_count;
    at = at >= 0 ? (at + direction + count) % count : direction > 0 ? 0 : count - 1;
    ui->focus = ui->stop[at].id;
    const struct ui_stop *stop = &ui->stop[at];
    if (stop->list) ui_list_show(stop->list, stop->top, stop->rect.h);
}

void ui_keep(struct ui *ui, uint32_t id)
{
    if (ui->stop_count < UI_MAX_FOCUS) ui->stop[ui->stop_count++] = (struct ui_stop){.id = id};
}

bool ui_end(struct ui *ui)
{
    if (ui->popup.id && !ui->popup.built && ui->pass == UI_PASS_EVENT) ui_popup_close(ui); // its subject is gone
    if (ui->pass == UI_PASS_EVENT) {
        if (place_of(ui, ui->focus) < 0) ui->focus = 0;
        if (place_of(ui, ui->held) < 0) ui->held = 0;
        if (place_of(ui, ui->typing) < 0) ui->typing = 0;
    }
    const struct event *event = ui->event;
    if (event && !ui->used && event->kind == EVENT_KEY && event->action != ACTION_RELEASE) {
        if (event->key == KEY_TAB && !(event->mods & (MOD_CTRL | MOD_ALT))) {
            move_focus(ui, event->mods & MOD_SHIFT ? -1 : 1);
            ui->used = true;
        } else if (event->key == KEY_ESCAPE && ui->focus) {
            ui->focus = 0;
            ui->used = true;
        }
    }
    if (ui->pass == UI_PASS_DRAW) drawlist_set_clip(ui->list, ui->list_clip);
    ui->event = NULL;
    ui->list = NULL;
    return ui->pass == UI_PASS_FIND ? ui->found != 0 : ui->used;
}

void ui_release(struct ui *ui)
{
    ui->focus = 0;
    ui->held = 0;
    ui->typing = 0;
    ui->popup.id = 0;
    ui->hint = NULL;
    ui->complaint[0] = '\0';
}

struct rect ui_row(struct ui *ui, float height)
{
    struct rect r = {ui->area.x + UI_PAD, ui->y, ui->area.w - 2 * UI_PAD, height};
    ui->y += height;
    return r;
}

void ui_space(struct ui *ui, float height) { ui->y += height; }

void ui_list_fit(struct ui_list *list, float view, float content)
{
    list->view = view;
    list->content = content;
    ui_list_scroll(list, 0);
}

bool ui_list_scroll(struct ui_list *list, float by)
{
    const float before = list->offset;
    list->offset = fmaxf(0, fminf(list->content - list->view, before + by));
    return list->offset != before;
}

void ui_list_show(struct ui_list *list, float top, float height)
{
    list->offset = fminf(fmaxf(list->offset, top + height - list->view), top);
}

void ui_list_bar(const struct ui_list *list, struct drawlist *drawn, struct rect track, float gap)
{
    const float room = list->content - list->view;
    if (room <= 0) return;
    const float length = track.h * list->view / list->content;
    const float top = track.y + (track.h - length) * fminf(1, list->offset / room);
    const struct rect bar = {track.x, top + gap, track.w, length - 2 * gap};
    drawlist_rounded(drawn, bar, track.w / 2, theme()->control);
}

void ui_list_begin(struct ui *ui, struct ui_list *list, struct rect view)
{
    ui_list_fit(list, view.h, list->content);
    list->offset = roundf(list->offset);
    ui->scrolled = list;
    ui->scroll_area = view;
    ui->scroll_clip = ui->clip;
    ui->clip = rect_intersect(ui->clip, view);
    ui->y = view.y - list->offset;
    if (ui->pass == UI_PASS_DRAW) drawlist_push_clip(ui->list, view);
}

void ui_list_end(struct ui *ui)
{
    struct rect view = ui->scroll_area;
    struct ui_list *list = ui->scrolled;
    list->content = ui->y + list->offset - view.y;
    const uint32_t held = ui_id(ui, "scroll");
    const struct event *event = ui->event;
    float by = 0; // the event scrolls: the wheel, or a drag beside the widgets
    if (ui_pressed(ui, view, BUTTON_LEFT)) ui_hold(ui, held);
    if (ui->pass == UI_PASS_EVENT && ui->held == held && !ui->blocked) {
        if (event->kind == EVENT_POINTER) by = ui->press_y - event->y;
        ui_keep(ui, held);
        ui_held_change(ui);
        ui->press_y -= by;
    } else if (ui->pass == UI_PASS_EVENT && event->kind == EVENT_WHEEL && !ui->used && ui_hovered(ui, view)) {
        ui->used = true;
        by = -2 * UI_ROW * event->dy;
    }
    if (by != 0) ui_list_scroll(list, by);
    if (ui->pass == UI_PASS_DRAW) {
        ui_list_bar(list, ui->list, (struct rect){view.x + view.w - 6, view.y, 4, view.h}, 2);
        drawlist_set_clip(ui->list, ui->scroll_clip);
    }
    ui->scrolled = NULL;
    ui->clip = ui->scroll_clip;
    ui->y = view.y + view.h;
}

void ui_push(struct ui *ui, uint32_t number)
{
    assert(ui->depth + 1 < UI_MAX_SCOPES);
    const uint32_t outer = ui->scope[ui->depth++];
    ui->scope[ui->depth] = (outer + number + 1) * 2654435761u; // odd, so that no two siblings are alike
}

void ui_pop(struct ui *ui) { ui->depth--; }

uint32_t ui_hash(const char *name)
{
    uint32_t hash = 2166136261u; // FNV-1a; 0 stands for no widget
    for (; *name; name++) hash = (hash ^ (unsigned char)*name) * 16777619u;
    return hash ? hash : 1;
}

uint32_t ui_id(const struct ui *ui, const char *name) { return ui_hash(name) ^ ui->scope[ui->depth]; }

bool ui_hovered(const struct ui *ui, struct rect r)
{
    return !ui->blocked && rect_contains(r, ui->pointer_x, ui->pointer_y) &&
           rect_contains(ui->clip, ui->pointer_x, ui->pointer_y);
}

/// A hint may come before or after its widget.
static void hint_focus(struct ui *ui, struct rect r, const char *text)
{
    const struct rect *focus = &ui->focus_rect;
    if (text && rect_contains(r, focus->x + focus->w / 2, focus->y + focus->h / 2)) ui->focus_hint = text;
}

void ui_hint(struct ui *ui, struct rect r, const char *text)
{
    if (!text) return;
    if (ui_hovered(ui, r)) ui->hint = text;
    ui->offered = text;
    ui->offered_rect = r;
    if (ui->focus && place_of(ui, ui->focus) >= 0) hint_focus(ui, r, text);
}

void ui_register(struct ui *ui, uint32_t id, struct rect r)
{
    if (id == ui->focus) {
        ui->focus_rect = r;
        hint_focus(ui, ui->offered_rect, ui->offered);
    }
    const struct ui_stop stop = {id, r, ui->scrolled,
                                 ui->scrolled ? r.y - ui->scroll_area.y + ui->scrolled->offset : 0};
    if (ui->pass == UI_PASS_EVENT && !ui->blocked && place_of(ui, id) >= 0) ui->twice = stop;
    if ((!ui->blocked || ui->pass == UI_PASS_DRAW) && ui->stop_count < UI_MAX_FOCUS)
        ui->stop[ui->stop_count++] = stop;
    if (ui->pass == UI_PASS_FIND && (ui->find == id || ui->find == (id ^ ui->scope[ui->depth])) && !ui->found) {
        ui->found_x = r.x + r.w / 2;
        ui->found_y = r.y + r.h / 2;
        ui->found = rect_contains(ui->clip, ui->found_x, ui->found_y) ? id : 0;
    }
}

bool ui_pressed(struct ui *ui, struct rect r, enum event_button button)
{
    if (ui->pass != UI_PASS_EVENT || ui->used || ui->held) return false; // a held widget keeps the pointer
    const struct event *event = ui->event;
    if (event->kind != EVENT_BUTTON || event->action != ACTION_PRESS || event->button != button) return false;
    if (!ui_hovered(ui, r)) return false;
    ui->used = true;
    return true;
}

bool ui_focused_key(const struct ui *ui, uint32_t id)
{
    return ui->pass == UI_PASS_EVENT && !ui->used && !ui->blocked && ui->focus == id &&
           ui->event->kind == EVENT_KEY && ui->event->action != ACTION_RELEASE &&
           !(ui->event->mods & (MOD_CTRL | MOD_ALT | MOD_SUPER));
}

/// Enter or Space on the focused widget; used up.
static bool activated(struct ui *ui, uint32_t id)
{
    if (!ui_focused_key(ui, id)) return false;
    if (ui->event->key != KEY_ENTER && ui->event->key != KEY_SPACE) return false;
    ui->used = true;
    return true;
}

/// Registers a pressable widget; true if pressed with the left button, Enter or Space.
static bool clicked(struct ui *ui, uint32_t id, struct rect r)
{
    ui_register(ui, id, r);
    return ui_pressed(ui, r, BUTTON_LEFT) || activated(ui, id);
}

void ui_hold(struct ui *ui, uint32_t id)
{
    ui->held = id;
    ui->moved = ui->fine = false;
    ui->press_x = ui->event->x;
    ui->press_y = ui->event->y;
}

enum ui_change ui_held_change(struct ui *ui)
{
    const struct event *event = ui->event;
    const bool key = event->kind == EVENT_KEY, button = event->kind == EVENT_BUTTON;
    const bool cancels = key && event->key == KEY_ESCAPE && event->action == ACTION_PRESS;
    const bool drops = button && event->button == BUTTON_LEFT && event->action == ACTION_RELEASE;
    if (key || button) ui->used = true;
    if (!cancels && !drops) return UI_NONE;
    ui->held = 0;
    return !ui->moved ? UI_NONE : drops ? UI_DROP : UI_CANCEL;
}

// --- labels, buttons, toggles, choices, sections and rows

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

float ui_text_size(enum font font) { return font == FONT_NUMBER ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL; }

void ui_paint_text(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    const float size = ui_text_size(font);
    drawlist_text_fit(list, r.x, ui_baseline(r, font, size), r.w, font, size, color, text);
}

void ui_label(struct ui *ui, struct rect r, const char *text, uint32_t color)
{
    if (ui->pass == UI_PASS_DRAW) ui_paint_text(ui->list, r, FONT_LABEL, color, text);
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
    if (clicked(ui, id, r)) *closed = !*closed;
    if (ui->pass == UI_PASS_DRAW) {
        if (!first) drawlist_rect(ui->list, line, theme()->border);
        uint32_t color = ui_hovered(ui, r) ? theme()->text : theme()->text_dim;
        const float x = r.x, y = r.y + r.h / 2; // a triangle
        const float right[6] = {x + 1, y - 4, x + 5, y, x + 1, y + 4};
        const float down[6] = {x - 1, y - 2, x + 7, y - 2, x + 3, y + 2};
        drawlist_convex(ui->list, *closed ? right : down, 3, color);
        ui_paint_text(ui->list, (struct rect){r.x + 14, r.y, r.w - 14, r.h}, FONT_LABEL_BOLD, color, title);
        ui_focus_ring(ui, id, (struct rect){r.x - 4, r.y + 3, r.w + 8, r.h - 6});
    }
    return !*closed;
}

float ui_text_width(const char *text) { return font_width(FONT_LABEL, THEME_TEXT_NORMAL, text); }

static void paint_centred(struct ui *ui, struct rect r, const char *text, uint32_t color)
{
    float w = fminf(r.w - 4, ui_text_width(text));
    ui_paint_text(ui->list, (struct rect){roundf(r.x + (r.w - w) / 2), r.y, w, r.h}, FONT_LABEL, color, text);
}

bool ui_button(struct ui *ui, struct rect r, const char *name, const char *label, bool primary)
{
    struct rect field = ui_field_of(r);
    uint32_t id = ui_id(ui, name);
    bool pressed = clicked(ui, id, field);
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
    bool pressed = clicked(ui, id, box);
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
    bool pressed = clicked(ui, id, r);
    if (ui->pass == UI_PASS_DRAW) {
        const bool hot = ui_hovered(ui, r);
        float left = r.x + 6;
        paint_row(ui, id, r, selected, hot);
        if (color) {
            drawlist_rounded(ui->list, (struct rect){left, r.y + (r.h - 10) / 2, 10, 10}, 3, color);
            left += 18;
        }
        struct rect label = {left, r.y, r.x + r.w - left, r.h};
        ui_paint_text(ui->list, label, FONT_LABEL, selected || hot ? theme()->text : theme()->text_dim, text);
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

enum { SORT_THRESHOLD = 4 }; ///< pixels; a shorter way is a click

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
        if (event->kind == EVENT_POINTER) ui->moved |= fabsf(event->y - ui->press_y) >= SORT_THRESHOLD;
        if (event->kind == EVENT_WHEEL) return UI_ROW_NONE;
        ui->used = true;
        if (release || escape) ui->held = 0;
        return !release ? UI_ROW_NONE : ui->moved ? UI_ROW_DROPPED : UI_ROW_CLICKED;
    }
    if (activated(ui, id)) return UI_ROW_PRESSED;
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

// --- icons, drawn in 14 × 14 pixels around (0, 0), y down

enum { ICON_POINTS = 17 };

static const float ICON_LINE = 1.4f;

/// A line through points; an arc: middle, radii, start and end in turns clockwise from the right; a disc or ring: middle and radius.
enum shape { LINE, ARC, DOT, RING };

static const struct icon_part {
    enum ui_icon icon;
    enum shape shape;
    int count;    ///< points of a line or arc
    float at[10]; ///< coordinates
} icon_parts[] = {
    {UI_ICON_ADD, LINE, .count = 2, .at = {-5, 0, 5, 0}},
    {UI_ICON_ADD, LINE, .count = 2, .at = {0, -5, 0, 5}},
    {UI_ICON_COPY, LINE, .count = 5, .at = {-2, -2, 5, -2, 5, 5, -2, 5, -2, -2}},
    {UI_ICON_COPY, LINE, .count = 5, .at = {-2, 2, -5, 2, -5, -5, 2, -5, 2, -2}},
    {UI_ICON_DELETE, LINE, .count = 2, .at = {-5, -3.5f, 5, -3.5f}}, // a bin
    {UI_ICON_DELETE, LINE, .count = 2, .at = {-1.5f, -5.5f, 1.5f, -5.5f}},
    {UI_ICON_DELETE, LINE, .count = 4, .at = {-3.8f, -3.5f, -3.2f, 5, 3.2f, 5, 3.8f, -3.5f}},
    {UI_ICON_DELETE, LINE, .count = 2, .at = {0, -1, 0, 2.5f}},
    {UI_ICON_RIGHT, LINE, .count = 3, .at = {-2, -4, 2, 0, -2, 4}},
    {UI_ICON_DOWN, LINE, .count = 3, .at = {-4, -2, 0, 2, 4, -2}},
    {UI_ICON_EYE, ARC, .count = 9, .at = {0, 3.5f, 7, 7.5f, 0.57f, 0.93f}},
    {UI_ICON_EYE, ARC, .count = 9, .at = {0, -3.5f, 7, 7.5f, 0.07f, 0.43f}},
    {UI_ICON_EYE, DOT, .at = {0, 0, 2}},
    {UI_ICON_EYE_CLOSED, ARC, .count = 9, .at = {0, -3.5f, 7, 7.5f, 0.07f, 0.43f}},
    {UI_ICON_EYE_CLOSED, LINE, .count = 2, .at = {0, 4, 0, 6}},
    {UI_ICON_EYE_CLOSED, LINE, .count = 2, .at = {-4, 3, -5, 4.8f}},
    {UI_ICON_EYE_CLOSED, LINE, .count = 2, .at = {4, 3, 5, 4.8f}},
    {UI_ICON_LOCK, LINE, .count = 5, .at = {-4, -0.5f, 4, -0.5f, 4, 5, -4, 5, -4, -0.5f}},
    {UI_ICON_LOCK, ARC, .count = 9, .at = {0, -0.5f, 2.6f, 4.5f, 0.5f, 1}},
    {UI_ICON_UNLOCKED, LINE, .count = 5, .at = {-4, -0.5f, 4, -0.5f, 4, 5, -4, 5, -4, -0.5f}},
    {UI_ICON_UNLOCKED, ARC, .count = 9, .at = {0, -2, 2.6f, 4, 0.46f, 0.94f}},
    {UI_ICON_FOLLOW, ARC, .count = 17, .at = {-3, 0, 3.2f, 3.2f, 0.08f, 0.92f}}, // two links of a chain
    {UI_ICON_FOLLOW, ARC, .count = 17, .at = {3, 0, 3.2f, 3.2f, -0.42f, 0.42f}},
    {UI_ICON_FOLLOW, LINE, .count = 2, .at = {-2.2f, 0, 2.2f, 0}},
    {UI_ICON_UNFOLLOW, ARC, .count = 17, .at = {-3, 0, 3.2f, 3.2f, 0.08f, 0.92f}},
    {UI_ICON_UNFOLLOW, ARC, .count = 17, .at = {3, 0, 3.2f, 3.2f, -0.42f, 0.42f}},
    {UI_ICON_UNFOLLOW, LINE, .count = 2, .at = {-2.2f, 0, 2.2f, 0}},
    {UI_ICON_UNFOLLOW, LINE, .count = 2, .at = {4.5f, -5.5f, -4.5f, 5.5f}},
    {UI_ICON_PICK, RING, .at = {0, 0, 4}},
    {UI_ICON_PICK, DOT, .at = {0, 0, 1.2f}},
    {UI_ICON_PICK, LINE, .count = 2, .at = {-6.5f, 0, -3, 0}},
    {UI_ICON_PICK, LINE, .count = 2, .at = {3, 0, 6.5f, 0}},
    {UI_ICON_PICK, LINE, .count = 2, .at = {0, -6.5f, 0, -3}},
    {UI_ICON_PICK, LINE, .count = 2, .at = {0, 3, 0, 6.5f}},
    {UI_ICON_RAMP, LINE, .count = 4, .at = {-5.5f, 4, -1.5f, 1.5f, 1.5f, -2.5f, 5.5f, -4}},
    {UI_ICON_RAMP, DOT, .at = {-5, 3.7f, 1.8f}},
    {UI_ICON_RAMP, DOT, .at = {5, -3.8f, 1.8f}},
    {UI_ICON_EACH, LINE, .count = 2, .at = {-5, 5.5f, -5, 2.5f}},
    {UI_ICON_EACH, LINE, .count = 2, .at = {-2.5f, 5.5f, -2.5f, 0.5f}},
    {UI_ICON_EACH, LINE, .count = 2, .at = {0, 5.5f, 0, -1.5f}},
    {UI_ICON_EACH, LINE, .count = 2, .at = {2.5f, 5.5f, 2.5f, -3.5f}},
    {UI_ICON_EACH, LINE, .count = 2, .at = {5, 5.5f, 5, -5.5f}},
};

bool ui_icon_button(struct ui *ui, struct rect r, const char *name, enum ui_icon icon, bool lit, const char *hint)
{
    uint32_t id = ui_id(ui, name);
    bool pressed = clicked(ui, id, r);
    bool hot = ui_hovered(ui, r);
    ui_hint(ui, r, hint);
    if (ui->pass == UI_PASS_DRAW) {
        if (hot) drawlist_rounded(ui->list, r, UI_RADIUS, theme()->fill);
        uint32_t color = lit ? theme()->accent : hot || ui->focus == id ? theme()->text : theme()->text_dim;
        const float x = roundf(r.x + r.w / 2), y = roundf(r.y + r.h / 2);
        for (size_t i = 0; i < sizeof icon_parts / sizeof *icon_parts; i++) {
            const struct icon_part *part = &icon_parts[i];
            const float *at = part->at, radius = at[2] + (part->shape == RING ? ICON_LINE / 2 : 0);
            const struct rect round = {x + at[0] - radius, y + at[1] - radius, 2 * radius, 2 * radius};
            float xy[2 * ICON_POINTS];
            if (part->icon != icon) continue;
            for (int k = 0; k < part->count; k++) {
                const float angle = 6.2831853f * (at[4] + (at[5] - at[4]) * (float)k / (float)(part->count - 1));
                const bool is_arc = part->shape == ARC;
                xy[2 * k] = x + (is_arc ? at[0] + at[2] * maths_cosf(angle) : at[2 * k]);
                xy[2 * k + 1] = y + (is_arc ? at[1] + at[3] * maths_sinf(angle) : at[2 * k + 1]);
            }
            if (part->count > 0) drawlist_line(ui->list, xy, part->count, ICON_LINE, color);
            if (part->shape == DOT) drawlist_rounded(ui->list, round, radius, color);
            if (part->shape == RING) drawlist_rounded_line(ui->list, round, radius, ICON_LINE, color);
        }
        ui_focus_ring(ui, id, rect_inset(r, 1));
    }
    return pressed;
}

// --- typing filters lists

enum { FEWEST_LETTERS = 4 /* that may lie scattered */ };

enum fit ui_filter_fit(const struct ui_filter *filter, const char *text)
{
    enum fit worst = FIT_START;
    const char *word = filter->typed;
    while (*(word += strspn(word, " "))) {
        const size_t length = strcspn(word, " ");
        enum fit best = FIT_LETTERS;
        size_t found = 0;
        for (const char *at = text; *at && found < length; at++)
            found += tolower((unsigned char)*at) == tolower((unsigned char)word[found]);
        if (found < length) return FIT_NOT;
        if (length < FEWEST_LETTERS) best = FIT_NOT;
        for (const char *at = text; *at; at++) {
            if (strncasecmp(at, word, length) != 0) continue;
            const bool is_inside = at > text && (isalnum((unsigned char)at[-1]) || (unsigned char)at[-1] >= 0x80);
            const enum fit fit = at == text ? FIT_START : is_inside ? FIT_INSIDE : FIT_WORD;
            if (fit > best) best = fit;
        }
        if (best < worst) worst = best;
        word += length;
    }
    return worst;
}

enum fit ui_filter_least(enum fit best) { return best >= FIT_INSIDE ? FIT_INSIDE : FIT_LETTERS; }

bool ui_filter_event(struct ui_filter *filter, const struct event *event)
{
    size_t length = strlen(filter->typed);
    if (event->kind == EVENT_KEY && event->key == KEY_BACKSPACE && event->action != ACTION_RELEASE && length > 0) {
        while (length > 1 && ((unsigned char)filter->typed[length - 1] & 0xC0) == 0x80) length--;
        filter->typed[length - 1] = '\0';
        return true;
    }
    if (event->kind != EVENT_TEXT || event->codepoint < ' ' || event->codepoint == 0x7F) return false;
    char bytes[4];
    const int count = utf8_encode(event->codepoint, bytes);
    if ((length == 0 && bytes[0] == ' ') || length + (size_t)count >= sizeof filter->typed) return false;
    memcpy(filter->typed + length, bytes, (size_t)count);
    filter->typed[length + (size_t)count] = '\0';
    return true;
}

// --- popups over a panel, and the widgets that open them

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
    ui_list_begin(ui, &ui->popup.list, rect_inset(box, POPUP_PAD));
}

void ui_popup_end(struct ui *ui)
{
    struct rect box = ui->scroll_area;
    ui_list_end(ui);
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
    if (event->key == KEY_UP || event->key == KEY_LEFT) move_focus(ui, -1);
    if (event->key == KEY_DOWN || event->key == KEY_RIGHT) move_focus(ui, 1);
    if (event->key == KEY_TAB) move_focus(ui, event->mods & MOD_SHIFT ? -1 : 1);
}

void ui_dropdown(struct ui *ui, struct rect r, const char *name, int which, const char *text, uint32_t color)
{
    struct rect field = ui_field_of(r);
    char full[96]; // several may open the same popup
    snprintf(full, sizeof full, "%s.%d", name, which);
    uint32_t id = ui_id(ui, full);
    if (clicked(ui, id, field))
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
    if (clicked(ui, id, r)) ui_popup_open(ui, popup, which, r);
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
    bool pressed = clicked(ui, id, r);
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
    ui_popup_begin(ui, ui->popup.anchor.w, UI_ROW * (float)((is_long ? MAX_ROWS : count) + searches));
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
        ui->popup.list.offset = 0;
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

// --- when and where tooltips appear, and how they look

enum { TIP_WIDTH = 260, TIP_LINE = 16, TIP_PAD_X = 8, TIP_PAD_Y = 5, TIP_BELOW = 6, TIP_MARGIN = 4 };

static const double TIP_WAIT = 0.5; ///< seconds the pointer must rest

void tooltip_offer(struct tooltip *tooltip, const char *text, float x, float y, struct rect at)
{
    const bool moved = x != tooltip->x || y != tooltip->y;
    const bool elsewhere = !moved && (at.x != tooltip->at.x || at.y != tooltip->at.y);
    if (text != tooltip->text || elsewhere) {
        *tooltip = (struct tooltip){.text = text, .at = at, .x = x, .y = y};
    } else if (moved && !tooltip_is_shown(tooltip)) {
        tooltip->rest = 0;
        tooltip->at = at;
    }
    tooltip->x = x;
    tooltip->y = y;
}

void tooltip_dismiss(struct tooltip *tooltip) { tooltip->spent = true; }

void tooltip_advance(struct tooltip *tooltip, double dt)
{
    if (tooltip_waits(tooltip)) tooltip->rest += dt;
}

bool tooltip_is_shown(const struct tooltip *tooltip)
{
    return tooltip->text && !tooltip->spent && tooltip->rest >= TIP_WAIT;
}

bool tooltip_waits(const struct tooltip *tooltip)
{
    return tooltip->text && !tooltip->spent && tooltip->rest < TIP_WAIT;
}

static float tip_width(struct rect window) { return fminf(TIP_WIDTH, window.w - 2 * TIP_MARGIN) - 2 * TIP_PAD_X; }

struct rect tooltip_box(const struct tooltip *tooltip, struct rect window)
{
    const float width = tip_width(window), whole = font_width(FONT_LABEL, THEME_TEXT_SMALL, tooltip->text);
    const char *rest = tooltip->text;
    int lines = 0;
    for (; *rest; lines++) font_take_line(THEME_TEXT_SMALL, width, &rest);
    const float w = fminf(ceilf(whole), width) + 2 * TIP_PAD_X, h = (float)(lines * TIP_LINE + 2 * TIP_PAD_Y);
    const struct rect *at = &tooltip->at;
    const float below = at->y + at->h + TIP_BELOW, above = at->y - TIP_BELOW - h;
    const float x = fmaxf(window.x + TIP_MARGIN, fminf(at->x, window.x + window.w - TIP_MARGIN - w));
    const float y = below + h <= window.y + window.h - TIP_MARGIN ? below : fmaxf(above, window.y + TIP_MARGIN);
    return (struct rect){roundf(x), roundf(y), w, h};
}

void tooltip_show(const struct tooltip *tooltip, struct rect window, struct drawlist *list)
{
    if (!tooltip_is_shown(tooltip)) return;
    const struct rect box = tooltip_box(tooltip, window);
    drawlist_rounded(list, rect_inset(box, -1), 5, theme()->veil);
    drawlist_rounded(list, box, 4, theme()->raised);
    drawlist_rounded_line(list, box, 4, 1, theme()->control);
    float y = box.y + TIP_PAD_Y + TIP_LINE - 4;
    const char *rest = tooltip->text;
    for (; *rest; y += TIP_LINE) {
        const char *start = rest;
        char part[257];
        const size_t length = font_take_line(THEME_TEXT_SMALL, tip_width(window), &rest);
        snprintf(part, sizeof part, "%.*s", (int)length, start);
        drawlist_text(list, box.x + TIP_PAD_X, y, FONT_LABEL, THEME_TEXT_SMALL, theme()->text, part);
    }
}
