/// Text editing, and text fields.
#include "base/error.h"
#include "ui/widgets_internal.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

void ui_text_set(struct ui_text *text, const char *utf8)
{
    snprintf(text->bytes, sizeof text->bytes, "%s", utf8);
    text->length = (int)strlen(text->bytes);
    text->caret = text->length;
    text->all = false;
}

static bool is_continuation(char byte) { return ((unsigned char)byte & 0xC0) == 0x80; }

static int before(const struct ui_text *text, int at)
{
    if (at == 0) return 0;
    const char *start = text->bytes, *byte = start + at - 1;
    while (byte > start && is_continuation(*byte)) byte--;
    return (int)(byte - start);
}

static int after(const struct ui_text *text, int at)
{
    if (at < text->length) at++;
    while (at < text->length && is_continuation(text->bytes[at])) at++;
    return at;
}

static void erase(struct ui_text *text, int from, int to)
{
    memmove(text->bytes + from, text->bytes + to, (size_t)(text->length - to) + 1);
    text->length -= to - from;
    text->caret = from;
}

static bool insert(struct ui_text *text, uint32_t codepoint)
{
    if (codepoint < 0x20 || codepoint == 0x7F || codepoint > 0x10FFFF) return false;
    if (text->all) erase(text, 0, text->length);
    text->all = false;
    char bytes[4];
    int n = utf8_encode(codepoint, bytes);
    if (text->length + n >= UI_TEXT_SIZE) return false;
    memmove(text->bytes + text->caret + n, text->bytes + text->caret, (size_t)(text->length - text->caret) + 1);
    memcpy(text->bytes + text->caret, bytes, (size_t)n);
    text->length += n;
    text->caret += n;
    return true;
}

static bool erase_key(struct ui_text *text, int key)
{
    int length = text->length;
    if (text->all) {
        erase(text, 0, text->length);
    } else if (key == KEY_BACKSPACE) {
        erase(text, before(text, text->caret), text->caret);
    } else {
        erase(text, text->caret, after(text, text->caret));
    }
    text->all = false;
    return text->length != length;
}

static bool caret_key(struct ui_text *text, int key)
{
    switch (key) {
    case KEY_LEFT:
        text->caret = text->all ? 0 : before(text, text->caret);
        break;
    case KEY_RIGHT:
        text->caret = text->all ? text->length : after(text, text->caret);
        break;
    case KEY_HOME:
        text->caret = 0;
        break;
    case KEY_END:
        text->caret = text->length;
        break;
    default:
        return false;
    }
    text->all = false;
    return true;
}

bool ui_selects_all(const struct event *event)
{
    return event->kind == EVENT_KEY && event->action != ACTION_RELEASE && event->key == 'A' &&
           event->mods == MOD_CTRL;
}

bool ui_text_event(struct ui_text *text, const struct event *event, bool *changed)
{
    bool edited = false, used = true;
    if (event->kind == EVENT_TEXT) {
        edited = insert(text, event->codepoint);
    } else if (ui_selects_all(event)) {
        text->all = text->length > 0;
    } else if (event->kind == EVENT_KEY && event->action != ACTION_RELEASE && !(event->mods & MOD_CTRL)) {
        if (event->key == KEY_BACKSPACE || event->key == KEY_DELETE) {
            edited = erase_key(text, event->key);
        } else {
            used = caret_key(text, event->key);
        }
    } else {
        used = false;
    }
    if (changed) *changed = edited;
    return used;
}

/// Width of the bytes [from, to).
static float width_between(const struct ui_text *text, int from, int to, enum font font, float size)
{
    char part[UI_TEXT_SIZE];
    snprintf(part, sizeof part, "%.*s", to - from, text->bytes + from);
    return font_width(font, size, part);
}

void ui_paint_text(struct ui *ui, struct rect r, const struct ui_text *text, enum font font, float size, bool focused)
{
    int from = 0;
    while (from < text->caret && width_between(text, from, text->caret, font, size) > r.w - 2)
        from = after(text, from);
    float y = ui_baseline(r, font, size);
    float caret = r.x + width_between(text, from, text->caret, font, size);
    if (focused && text->all && text->length > 0) {
        float w = fminf(r.w, width_between(text, from, text->length, font, size));
        drawlist_rect(ui->list, (struct rect){r.x, r.y + 3, w, r.h - 6}, theme_fade(theme()->accent, 0.3f));
    }
    drawlist_text_fit(ui->list, r.x, y, r.w, font, size, theme()->text, text->bytes + from);
    if (focused) drawlist_rect(ui->list, (struct rect){roundf(caret), r.y + 3, 1, r.h - 6}, theme()->accent);
}

static void paint_field(struct ui *ui, struct rect r, float pad, bool focused)
{
    if (ui_hovered(ui, r)) ui->over = UI_OVER_TEXT;
    drawlist_rounded(ui->list, r, UI_RADIUS, theme()->raised);
    if (focused) drawlist_rounded_line(ui->list, r, UI_RADIUS, 1.5f, theme()->accent);
    if (!focused) ui_outline(ui, r, UI_RADIUS, ui_hovered(ui, r));
    const struct rect inner = {r.x + pad, r.y, r.w - 2 * pad, r.h};
    ui_paint_text(ui, inner, &ui->text, FONT_LABEL, THEME_TEXT_NORMAL, focused);
}

void ui_line_begin(struct ui *ui, const char *name, const char *text)
{
    ui_text_set(&ui->text, text);
    ui->text.all = true;
    ui->focus = ui->typing = ui_hash(name);
    ui_keep(ui, ui->typing);
    ui->began = true; // the press that began typing must not end it
}

bool ui_line_is_open(const struct ui *ui, const char *name) { return ui->typing == ui_hash(name); }

enum ui_line ui_typing_event(struct ui *ui, uint32_t id, struct rect field)
{
    const struct event *event = ui->event;
    if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) {
        if (!ui_hovered(ui, field)) return UI_LINE_DONE; // the press also goes to the widget there
        ui->used = true;
        ui->focus = id;
        ui->text.all = event->clicks == 2;
    }
    if (!ui_is_typing_key(ui, event)) return UI_LINE_NONE;
    ui->used = true;
    bool press = event->kind == EVENT_KEY && event->action == ACTION_PRESS, changed;
    if (press && event->key == KEY_ESCAPE) return UI_LINE_CANCEL;
    if (press && event->key == KEY_ENTER) return UI_LINE_DONE;
    if (press && event->key == KEY_TAB) {
        ui->used = false; // ui_end() moves on from here
        return UI_LINE_DONE;
    }
    ui_text_event(&ui->text, event, &changed);
    ui->typed |= changed;
    ui->refused &= !changed;
    return UI_LINE_NONE;
}

enum ui_line ui_line(struct ui *ui, struct rect r, const char *name)
{
    uint32_t id = ui_hash(name);
    struct rect field = ui_field_of(r);
    ui_register(ui, id, field);
    if (ui->typing != id) return UI_LINE_NONE;
    if (ui->pass == UI_PASS_DRAW) paint_field(ui, field, 6, true);
    if (ui->pass != UI_PASS_EVENT || ui->blocked || ui->began) return UI_LINE_NONE;
    bool press = ui->event->kind == EVENT_BUTTON && ui->event->action == ACTION_PRESS;
    enum ui_line line = ui->used && !press ? UI_LINE_NONE : ui_typing_event(ui, id, field);
    if (line != UI_LINE_NONE) ui->typing = 0;
    return line;
}

bool ui_text_field(struct ui *ui, struct rect r, const char *name)
{
    uint32_t id = ui_id(ui, name);
    bool changed = false;
    ui_register(ui, id, r);
    if (ui_pressed(ui, r, BUTTON_LEFT)) {
        ui->focus = id;
        ui->typing = id;
        ui->text.all = ui->event->clicks == 2;
    }
    bool active = ui->focus == id;
    if (ui->pass == UI_PASS_EVENT && !ui->used && active) ui->used = ui_text_event(&ui->text, ui->event, &changed);
    if (ui->pass == UI_PASS_DRAW) paint_field(ui, r, 8, active);
    return changed;
}
