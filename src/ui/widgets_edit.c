/// Widgets whose value is typed or dragged: lines of text, numbers, and handles.
#include "base/error.h"
#include "base/names.h"
#include "maths/maths.h"
#include "ui/widgets_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- text

void ui_text_set(struct ui_text *text, const char *utf8)
{
    snprintf(text->bytes, sizeof text->bytes, "%s", utf8);
    text->length = (int)strlen(text->bytes);
    text->caret = text->length;
    text->all = false;
}

static bool is_continuation(char byte) { return ((unsigned char)byte & 0xC0) == 0x80; }

static int place_before(const struct ui_text *text, int at)
{
    if (at == 0) return 0;
    const char *start = text->bytes, *byte = start + at - 1;
    while (byte > start && is_continuation(*byte)) byte--;
    return (int)(byte - start);
}

static int place_after(const struct ui_text *text, int at)
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

/// Ctrl+A.
static bool selects_all(const struct event *event)
{
    return event->kind == EVENT_KEY && event->action != ACTION_RELEASE && event->key == 'A' &&
           event->mods == MOD_CTRL;
}

bool ui_text_event(struct ui_text *text, const struct event *event, bool *changed)
{
    const int length = text->length;
    bool edited = false, used = true;
    if (event->kind == EVENT_TEXT) {
        const uint32_t c = event->codepoint;
        const bool typed = c >= 0x20 && c != 0x7F && c <= 0x10FFFF;
        char bytes[4];
        const int n = typed ? utf8_encode(c, bytes) : 0;
        if (typed && text->all) erase(text, 0, length);
        text->all &= !typed;
        edited = typed && text->length + n < UI_TEXT_SIZE;
        if (edited) {
            char *caret = text->bytes + text->caret;
            memmove(caret + n, caret, (size_t)(text->length - text->caret) + 1);
            memcpy(caret, bytes, (size_t)n);
            text->length += n;
            text->caret += n;
        }
    } else if (selects_all(event)) {
        text->all = text->length > 0;
    } else if (event->kind == EVENT_KEY && event->action != ACTION_RELEASE && !(event->mods & MOD_CTRL)) {
        const bool all = text->all;
        text->all = false;
        switch (event->key) {
        case KEY_BACKSPACE:
            erase(text, all ? 0 : place_before(text, text->caret), all ? length : text->caret);
            edited = text->length != length;
            break;
        case KEY_DELETE:
            erase(text, all ? 0 : text->caret, all ? length : place_after(text, text->caret));
            edited = text->length != length;
            break;
        case KEY_LEFT:
            text->caret = all ? 0 : place_before(text, text->caret);
            break;
        case KEY_RIGHT:
            text->caret = all ? length : place_after(text, text->caret);
            break;
        case KEY_HOME:
            text->caret = 0;
            break;
        case KEY_END:
            text->caret = length;
            break;
        default:
            text->all = all;
            used = false;
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

/// Draws the typed line and its caret.
static void paint_text(struct ui *ui, struct rect r, const struct ui_text *text, enum font font, float size,
                       bool focused)
{
    int from = 0;
    while (from < text->caret && width_between(text, from, text->caret, font, size) > r.w - 2)
        from = place_after(text, from);
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
    paint_text(ui, inner, &ui->text, FONT_LABEL, THEME_TEXT_NORMAL, focused);
}

void ui_line_begin(struct ui *ui, const char *name, const char *text)
{
    ui_text_set(&ui->text, text);
    ui->text.all = true;
    ui->focus = ui->typing = ui_hash(name);
    ui_keep(ui, ui->typing);
    ui->began = true; // the press that began typing must not end it
}

void ui_line_again(struct ui *ui, const char *name)
{
    if (!ui->used) return;
    ui->focus = ui->typing = ui_hash(name);
    ui_keep(ui, ui->typing);
}

bool ui_line_is_open(const struct ui *ui, const char *name) { return ui->typing == ui_hash(name); }

/// An event's effect on the line typed in `field`: UI_LINE_DONE by a press elsewhere, Enter, or Tab, which is not used up.
static enum ui_line type_event(struct ui *ui, uint32_t id, struct rect field)
{
    const struct event *event = ui->event;
    if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) {
        if (!ui_hovered(ui, field)) return UI_LINE_DONE; // the press also goes to the widget there
        ui->used = true;
        ui->focus = id;
        ui->text.all = event->clicks == 2;
    }
    // All keys but F keys and Ctrl chords other than Ctrl+A belong to the text.
    const bool is_function = event->key >= KEY_F1 && event->key <= KEY_F12;
    const bool is_own = event->mods & MOD_CTRL ? selects_all(event) : !is_function;
    if (event->kind != EVENT_TEXT && !(event->kind == EVENT_KEY && is_own)) return UI_LINE_NONE;
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
    enum ui_line line = ui->used && !press ? UI_LINE_NONE : type_event(ui, id, field);
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

// --- sliders and number fields, which differ only in how a drag maps to a value

enum { DRAG_THRESHOLD = 2, HANDLE = 3 }; ///< pixels: a shorter drag is a click; height of a bar's handle
static const double no_limit = 1e300;    ///< larger limits mean none

static bool has_bar(const struct ui_number *number) { return number->maximum > number->minimum; }

/// The double nearest to the shown decimal, so that files hold what is shown.
static double round_decimals(double value, int decimals)
{
    char text[400];
    snprintf(text, sizeof text, "%.*f", decimals, value);
    double rounded = strtod(text, NULL);
    return rounded == 0 ? 0 : rounded; // no negative zero
}

static double limited(const struct ui_number *number, double value)
{
    return fmax(number->lowest, fmin(number->highest, value));
}

static void begin_typing(struct ui *ui, uint32_t id, double value, bool by_pointer)
{
    char text[64];
    snprintf(text, sizeof text, "%.10g", value);
    ui_text_set(&ui->text, text);
    ui->text.all = true;
    ui->typing = id;
    ui->focus = id;
    ui->typed = false;
    ui->refused = false;
    ui->by_pointer = by_pointer;
}

static void end_typing(struct ui *ui)
{
    ui->typing = 0;
    if (ui->by_pointer) ui->focus = 0;
}

/// A number; not hexadecimal, not "inf".
static bool read_number(const char **at, double *number)
{
    char *end;
    *at += strspn(*at, " ");
    *number = strtod(*at, &end);
    const size_t length = (size_t)(end - *at);
    const bool found = length > 0 && length <= strspn(*at, "+-.0123456789eE");
    *at = end;
    return found;
}

/// A number, or a sum of products; one that begins with +, * or / goes on from `value`.
static bool calculate(const char **at, double value, double *result)
{
    double sum = 0, product = value, number;
    *at += strspn(*at, " ");
    bool good = (**at && strchr("+*/", **at)) || read_number(at, &product);
    while (good) {
        *at += strspn(*at, " ");
        const char operation = **at;
        if (!operation || !strchr("+-*/", operation)) break;
        ++*at;
        good = read_number(at, &number);
        if (operation == '*') {
            product *= number;
        } else if (operation == '/') {
            product /= number;
        } else {
            sum += product;
            product = operation == '+' ? number : -number;
        }
    }
    *result = sum + product;
    return good && isfinite(*result);
}

/// Parses the typed text: "1.5", "1,5" (many keypads type a comma), "1.5 Hz", "12/24", or from the present value on "+5" and "*2". false, with
/// the reason in ui->complaint, if it is no number or out of range.
static bool take_typed(struct ui *ui, const struct ui_number *number, double *value)
{
    const char *what = number->label ? number->label : number->name, *text = ui->text.bytes;
    char copy[UI_TEXT_SIZE], range[64];
    const char *end = copy;
    double typed;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *comma = copy; (comma = strchr(comma, ','));) *comma = '.';
    const bool found = calculate(&end, *value, &typed);
    const size_t unit = number->unit ? strlen(number->unit) : 0;
    end += strspn(end, " ");
    if (unit && strncmp(end, number->unit, unit) == 0) end += unit;
    if (!found || end[strspn(end, " ")] != '\0') {
        snprintf(ui->complaint, sizeof ui->complaint, "%s: expected a number, got “%.*s”", what, name_fit(text, 40),
                 text);
        return false;
    }
    if (typed < number->lowest || typed > number->highest) {
        if (number->highest >= no_limit) {
            snprintf(range, sizeof range, "%.10g or more", number->lowest);
        } else {
            snprintf(range, sizeof range, "%.10g … %.10g", number->lowest, number->highest);
        }
        snprintf(ui->complaint, sizeof ui->complaint, "%.40s: expected %s, got %.10g", what, range, typed);
        return false;
    }
    *value = typed;
    return true;
}

static enum ui_change type_value(struct ui *ui, uint32_t id, struct rect field, const struct ui_number *number,
                                 double *value)
{
    const bool by_key = ui->event->kind == EVENT_KEY;
    const enum ui_line line = type_event(ui, id, field);
    if (line == UI_LINE_CANCEL) end_typing(ui);
    if (line != UI_LINE_DONE) return UI_NONE;
    double typed = *value;
    ui->refused = ui->typed && !take_typed(ui, number, &typed);
    if (!ui->refused || !by_key) end_typing(ui);
    ui->used |= by_key && ui->refused;
    if (!ui->used && by_key) ui->focus = id; // Tab goes on from here
    if (ui->refused || typed == *value) return UI_NONE;
    *value = typed;
    return UI_SET;
}

static enum ui_change drag_value(struct ui *ui, struct rect field, const struct ui_number *number, double *value)
{
    const struct event *event = ui->event;
    if (event->kind != EVENT_POINTER) {
        const enum ui_change change = ui_held_change(ui);
        if (change == UI_CANCEL) *value = ui->before;
        return change;
    }
    ui->used = true;
    if (!ui->moved && fabsf(event->x - ui->press_x) < DRAG_THRESHOLD) return UI_NONE;
    const bool fine = event->mods & MOD_SHIFT, bar = has_bar(number);
    const double range = number->maximum - number->minimum;
    if (!ui->moved) ui->before = *value;
    if (!ui->moved || fine != ui->fine) {
        // The mapping starts on a bar at the pointer, in a field or a fine drag at the value.
        ui->fine = fine;
        ui->anchor_x = ui->moved ? event->x : ui->press_x;
        ui->anchor_value = *value;
        if (bar && !fine) {
            double part = (ui->anchor_x - field.x) / field.w;
            ui->anchor_value = number->minimum + part * range;
        }
        ui->moved = true;
    }
    const double rate = bar ? range / field.w : number->step;
    double moved = ui->anchor_value + (event->x - ui->anchor_x) * rate * (fine ? 0.1 : 1.0);
    moved = round_decimals(moved, number->decimals + (fine ? 1 : 0));
    if (bar) moved = fmax(number->minimum, fmin(number->maximum, moved));
    *value = limited(number, moved);
    return UI_DRAG;
}

/// Restores the default, if any.
static enum ui_change reset(const struct ui_number *number, double *value)
{
    if (isnan(number->fallback) || *value == number->fallback) return UI_NONE;
    *value = number->fallback;
    return UI_SET;
}

static bool starts_number(uint32_t c) { return (c >= '0' && c <= '9') || c == '-' || c == '.' || c == ','; }

static enum ui_change step_value(struct ui *ui, uint32_t id, const struct ui_number *number, double *value)
{
    const struct event *event = ui->event;
    if (event->kind == EVENT_TEXT && ui->focus == id && starts_number(event->codepoint)) {
        begin_typing(ui, id, *value, false);
        return type_value(ui, id, (struct rect){0}, number, value);
    }
    if (!ui_focused_key(ui, id)) return UI_NONE;
    ui->used = true;
    double steps = event->mods & MOD_SHIFT ? 10 : 1;
    switch (event->key) {
    case KEY_ENTER:
        begin_typing(ui, id, *value, false);
        return UI_NONE;
    case KEY_DELETE:
        return reset(number, value);
    case KEY_LEFT:
    case KEY_DOWN:
        steps = -steps;
        break;
    case KEY_RIGHT:
    case KEY_UP:
        break;
    default:
        ui->used = starts_number((uint32_t)event->key);
        return UI_NONE;
    }
    double before = *value;
    *value = limited(number, round_decimals(before + steps * number->step, number->decimals));
    return *value == before ? UI_NONE : UI_NUDGE;
}

/// Position on the bar, 0 … 1.
static float part_of(const struct ui_number *number, double value)
{
    double part = (value - number->minimum) / (number->maximum - number->minimum);
    return (float)fmax(0, fmin(1, part));
}

/// Left side of a bar's handle, kept inside the outline.
static float handle_x(struct rect field, float at) { return field.x + fmaxf(3, fminf(at - 1, field.w - 4)); }

static void paint_bar(struct ui *ui, struct rect field, const struct ui_number *number, double value, bool hot,
                      bool held)
{
    const float at = field.w * part_of(number, value), x = handle_x(field, at);
    const uint32_t dim = held || hot ? theme()->accent : theme()->text_dim;
    const struct rect handle = {x - 0.5f, field.y + field.h - HANDLE - 1, 3, HANDLE};
    const float zero = field.w * part_of(number, 0);
    struct rect strip = {field.x + 3, field.y + field.h - 3, fmaxf(0, x - field.x - 3), 2};
    if (number->minimum < 0) {
        // A bar with 0 inside would end behind the text, so it is a strip below with a mark at 0.
        strip.x = field.x + fminf(at, zero);
        strip.w = fabsf(at - zero);
    } else {
        // Filled faintly up to the value, because text is drawn over it, with a clear strip and the handle below the text.
        const struct rect filled = {field.x, field.y, at, field.h};
        const struct rect old = drawlist_push_clip(ui->list, filled);
        const uint32_t fill = held ? theme_fade(theme()->accent, 0.35f) : hot ? theme()->hover : theme()->fill;
        drawlist_rounded(ui->list, field, UI_RADIUS, fill);
        drawlist_set_clip(ui->list, old);
    }
    drawlist_rect(ui->list, strip, dim);
    drawlist_rect(ui->list, handle, held || hot ? theme()->accent : theme()->text);
    if (number->minimum < 0)
        drawlist_rect(ui->list, (struct rect){field.x + zero - 0.5f, strip.y - 1, 1, strip.h + 1}, theme()->text_dim);
    if (!number->was || *number->was == value) return;
    const float before = handle_x(field, field.w * part_of(number, *number->was)); // a faint line across the bar
    drawlist_rect(ui->list, (struct rect){before, field.y + 2, 1.5f, field.h - 4},
                  theme_fade(theme()->playhead, 0.6f));
}

static void paint_value(struct ui *ui, struct rect r, struct rect field, uint32_t id, const struct ui_number *number,
                        double value)
{
    bool held = ui->held == id && ui->moved, typing = ui->typing == id;
    bool hot = ui_hovered(ui, field) && ui->held == 0;
    if (hot || ui->held == id) ui->over = typing ? UI_OVER_TEXT : UI_OVER_NUMBER;
    if (field.x > r.x) {
        struct rect label = {r.x, r.y, field.x - r.x - UI_GAP, r.h};
        ui_label(ui, label, number->label, hot || held || ui->focus == id ? theme()->text : theme()->text_dim);
    }
    drawlist_rounded(ui->list, field, UI_RADIUS, theme()->raised);
    const float pad = field.w < UI_LABEL ? UI_GAP / 2.0f : UI_GAP;
    struct rect inner = {field.x + pad, field.y, field.w - 2 * pad, field.h};
    if (typing) {
        paint_text(ui, inner, &ui->text, FONT_NUMBER, THEME_TEXT_SMALL, true);
        drawlist_rounded_line(ui->list, field, UI_RADIUS, 1.5f, ui->refused ? theme()->error : theme()->accent);
        return;
    }
    const char *unit = number->unit ? number->unit : "", *space = number->unit && strcmp(unit, "°") != 0 ? " " : "";
    char formatted[64];
    if (fabs(value) >= 1e6) {
        snprintf(formatted, sizeof formatted, "%.4g%s%s", value, space, unit);
    } else {
        snprintf(formatted, sizeof formatted, "%.*f%s%s", number->decimals, round_decimals(value, number->decimals),
                 space, unit);
    }
    const char *text = number->shown ? number->shown : formatted;
    if (has_bar(number)) paint_bar(ui, field, number, value, hot, held);
    if (held) {
        drawlist_rounded_line(ui->list, field, UI_RADIUS, 1, theme()->accent);
    } else {
        ui_outline(ui, field, UI_RADIUS, hot);
    }
    ui_number_text(ui, inner, text, theme()->text);
    ui_focus_ring(ui, id, field);
}

enum ui_change ui_value(struct ui *ui, struct rect r, const struct ui_number *number, double *value)
{
    uint32_t id = ui_id(ui, number->name);
    struct rect field = ui_field_of(r);
    if (number->label && r.w > UI_LABEL + UI_GAP) {
        field.x += UI_LABEL + UI_GAP;
        field.w -= UI_LABEL + UI_GAP;
    }
    ui_register(ui, id, field);
    if (number->hint) ui_hint(ui, field, number->hint);
    switch (ui->pass) {
    case UI_PASS_DRAW:
        paint_value(ui, r, field, id, number, *value);
        return UI_NONE;
    case UI_PASS_FIND:
        if (ui->found != id || !has_bar(number)) return UI_NONE;
        // The bar's handle, so that pressing there and dragging to "name,value" sets that value.
        ui->found_x = field.x + field.w * part_of(number, isnan(ui->find_value) ? *value : ui->find_value);
        ui->found_x = fminf(ui->found_x, field.x + field.w - (isnan(ui->find_value) ? 1.0f : 0.0f));
        return UI_NONE;
    case UI_PASS_EVENT:
        break;
    }
    // A press elsewhere ends typing even if another widget has used it.
    bool press = ui->event->kind == EVENT_BUTTON && ui->event->action == ACTION_PRESS;
    if (ui->typing == id && (press || !ui->used)) return type_value(ui, id, field, number, value);
    if (ui->used || ui->blocked) return UI_NONE;
    if (ui->held == id) return drag_value(ui, field, number, value);
    if (ui_pressed(ui, field, BUTTON_LEFT)) {
        if (ui->event->clicks == 2) {
            begin_typing(ui, id, *value, true);
        } else {
            ui_hold(ui, id);
        }
        return UI_NONE;
    }
    if (!isnan(number->fallback) && ui_pressed(ui, field, BUTTON_RIGHT)) return reset(number, value);
    return step_value(ui, id, number, value);
}

// --- handles that are dragged in two directions

enum { REACH = 11 }; ///< pixels around a point

static int nearest_handle(const struct ui_handle *handles, int count, float x, float y)
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

enum ui_change ui_handles(struct ui *ui, struct rect area, struct ui_handle *handles, int count, int *which)
{
    for (int i = 0; i < count; i++) {
        ui_register(ui, ui_id(ui, handles[i].name), (struct rect){handles[i].x - 1, handles[i].y - 1, 2, 2});
    }
    const int hot = ui->pass == UI_PASS_DRAW && ui_hovered(ui, area) && !ui->held
                        ? nearest_handle(handles, count, ui->pointer_x, ui->pointer_y)
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
    const struct event *event = ui->event;
    const bool is_shift = event->mods & MOD_SHIFT;
    for (*which = 0; *which < count; ++*which) {
        struct ui_handle *handle = &handles[*which];
        const uint32_t id = ui_id(ui, handle->name);
        if (ui->held == id) { // it keeps its offset from the pointer; Shift: a tenth as fast
            if (event->kind != EVENT_POINTER) return ui_held_change(ui);
            const float x = event->x - ui->press_x, y = event->y - ui->press_y, rate = is_shift ? 0.1f : 1;
            ui->used = true;
            if (!ui->moved && maths_hypotf(x, y) < DRAG_THRESHOLD) return UI_NONE;
            ui->moved = true;
            ui->press_x = event->x;
            ui->press_y = event->y;
            handle->x = ui->handle_x += rate * x;
            handle->y = ui->handle_y += rate * y;
            return UI_DRAG;
        }
        if (!ui_focused_key(ui, id)) continue;
        const int steps = is_shift ? 10 : 1;
        handle->step_x = steps * ((event->key == KEY_RIGHT) - (event->key == KEY_LEFT));
        handle->step_y = steps * ((event->key == KEY_UP) - (event->key == KEY_DOWN));
        ui->used = handle->step_x != 0 || handle->step_y != 0;
        if (ui->used) return UI_NUDGE;
    }
    const int at = nearest_handle(handles, count, event->x, event->y);
    if (at < 0 || !ui_pressed(ui, area, BUTTON_LEFT)) return UI_NONE;
    ui_hold(ui, ui_id(ui, handles[at].name));
    ui->handle_x = handles[at].x;
    ui->handle_y = handles[at].y;
    return UI_NONE;
}
