/// Focus, layout, scrolling and hit-testing of widgets.
#include "ui/widgets.h"
#include "ui/widgets_internal.h"
#include <assert.h>
#include <math.h>

static void begin(struct ui *ui, enum ui_pass pass, struct rect area)
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
    ui->scroll = NULL;
    ui->stop_count = 0;
    ui->depth = 0;
    ui->popup.built = ui->popup.fresh = false;
    ui->focus_hint = ui->offered = NULL;
    ui->blocked = ui->popup.id != 0 && pass != UI_PASS_FIND;
}

void ui_begin_event(struct ui *ui, struct rect area, const struct event *event)
{
    begin(ui, UI_PASS_EVENT, area);
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
    begin(ui, UI_PASS_DRAW, area);
    ui->list = list;
    ui->list_clip = drawlist_push_clip(list, area);
    ui->hint = NULL;
    ui->over = UI_OVER_NOTHING;
}

void ui_begin_find(struct ui *ui, struct rect area, const char *name, const double *value)
{
    begin(ui, UI_PASS_FIND, area);
    ui->find = ui_hash(name);
    ui->find_has_value = value != NULL;
    ui->find_value = value ? *value : 0;
}

/// Scrolls just far enough to show `r`.
static void reveal(struct ui *ui, struct rect r)
{
    if (!ui->scroll) return;
    float above = ui->scroll_area.y - r.y;
    float below = r.y + r.h - (ui->scroll_area.y + ui->scroll_area.h);
    if (above > 0) {
        ui->scroll->offset = fmaxf(0, ui->scroll->offset - above);
    } else if (below > 0) {
        ui->scroll->offset += below;
    }
}

void ui_move_focus(struct ui *ui, int direction)
{
    if (ui->stop_count == 0) return;
    int at = -1;
    for (int i = 0; i < ui->stop_count; i++) {
        if (ui->stop[i].id == ui->focus) at = i;
    }
    if (at < 0) {
        at = direction > 0 ? 0 : ui->stop_count - 1;
    } else {
        at = (at + direction + ui->stop_count) % ui->stop_count;
    }
    ui->focus = ui->stop[at].id;
    reveal(ui, ui->stop[at].rect);
}

void ui_keep(struct ui *ui, uint32_t id)
{
    if (ui->stop_count < UI_MAX_FOCUS) ui->stop[ui->stop_count++] = (struct ui_stop){.id = id};
}

static bool is_shown(const struct ui *ui, uint32_t id)
{
    for (int i = 0; i < ui->stop_count; i++) {
        if (ui->stop[i].id == id) return true;
    }
    return false;
}

bool ui_end(struct ui *ui)
{
    if (ui->popup.id && !ui->popup.built && ui->pass == UI_PASS_EVENT) ui_popup_close(ui); // its subject is gone
    if (ui->pass == UI_PASS_EVENT) {
        if (!is_shown(ui, ui->focus)) ui->focus = 0;
        if (!is_shown(ui, ui->held)) ui->held = 0;
        if (!is_shown(ui, ui->typing)) ui->typing = 0;
    }
    const struct event *event = ui->event;
    if (event && !ui->used && event->kind == EVENT_KEY && event->action != ACTION_RELEASE) {
        if (event->key == KEY_TAB && !(event->mods & (MOD_CTRL | MOD_ALT))) {
            ui_move_focus(ui, event->mods & MOD_SHIFT ? -1 : 1);
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

bool ui_is_typing_key(const struct ui *ui, const struct event *event)
{
    if (!ui->typing) return false;
    if (event->kind == EVENT_TEXT) return true;
    if (event->kind != EVENT_KEY) return false;
    if (event->mods & MOD_CTRL) return ui_selects_all(event);
    return event->key < KEY_F1 || event->key > KEY_F12;
}

struct rect ui_row(struct ui *ui, float height)
{
    struct rect r = {ui->area.x + UI_PAD, ui->y, ui->area.w - 2 * UI_PAD, height};
    ui->y += height;
    return r;
}

void ui_space(struct ui *ui, float height) { ui->y += height; }

void ui_scroll_begin(struct ui *ui, struct ui_scroll *scroll, struct rect view)
{
    scroll->offset = roundf(fmaxf(0, fminf(scroll->offset, scroll->content - view.h)));
    ui->scroll = scroll;
    ui->scroll_area = view;
    ui->scroll_clip = ui->clip;
    ui->clip = rect_intersect(ui->clip, view);
    ui->y = view.y - scroll->offset;
    if (ui->pass == UI_PASS_DRAW) drawlist_push_clip(ui->list, view);
}

void ui_scroll_end(struct ui *ui)
{
    struct rect view = ui->scroll_area;
    struct ui_scroll *scroll = ui->scroll;
    scroll->content = ui->y + scroll->offset - view.y;
    float room = fmaxf(0, scroll->content - view.h);
    const uint32_t held = ui_hash("scroll");
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
    if (by != 0) scroll->offset = fmaxf(0, fminf(room, scroll->offset + by));
    if (ui->pass == UI_PASS_DRAW) {
        if (room > 0) {
            float length = view.h * view.h / scroll->content;
            float top = view.y + (view.h - length) * fminf(1, scroll->offset / room);
            drawlist_rounded(ui->list, (struct rect){view.x + view.w - 6, top + 2, 4, length - 4}, 2,
                             theme()->control);
        }
        drawlist_set_clip(ui->list, ui->scroll_clip);
    }
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
    if (ui->focus && is_shown(ui, ui->focus)) hint_focus(ui, r, text);
}

void ui_register(struct ui *ui, uint32_t id, struct rect r)
{
    if (id == ui->focus) {
        ui->focus_rect = r;
        hint_focus(ui, ui->offered_rect, ui->offered);
    }
    if (ui->pass == UI_PASS_EVENT && !ui->blocked && is_shown(ui, id)) ui->twice = (struct ui_stop){id, r};
    if ((!ui->blocked || ui->pass == UI_PASS_DRAW) && ui->stop_count < UI_MAX_FOCUS)
        ui->stop[ui->stop_count++] = (struct ui_stop){id, r};
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

bool ui_activated(struct ui *ui, uint32_t id)
{
    if (!ui_focused_key(ui, id)) return false;
    if (ui->event->key != KEY_ENTER && ui->event->key != KEY_SPACE) return false;
    ui->used = true;
    return true;
}

bool ui_clicked(struct ui *ui, uint32_t id, struct rect r)
{
    ui_register(ui, id, r);
    return ui_pressed(ui, r, BUTTON_LEFT) || ui_activated(ui, id);
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
