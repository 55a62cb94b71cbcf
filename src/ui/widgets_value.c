/// Sliders and number fields, which differ only in how a drag maps to a value.
#include "base/names.h"
#include "ui/widgets_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static void format_number(const struct ui_number *number, double value, char *text, size_t size)
{
    const char *space = number->unit && strcmp(number->unit, "°") != 0 ? " " : "";
    const char *unit = number->unit ? number->unit : "";
    if (fabs(value) >= 1e6) {
        snprintf(text, size, "%.4g%s%s", value, space, unit);
    } else {
        snprintf(text, size, "%.*f%s%s", number->decimals, round_decimals(value, number->decimals), space, unit);
    }
}

/// "1.5", "1,5" (many keypads type a comma), or "1.5 Hz". Not hexadecimal, not "inf".
static bool parse_number(const struct ui_number *number, const char *typed, double *value)
{
    char copy[UI_TEXT_SIZE], *comma;
    const char *text = copy;
    snprintf(copy, sizeof copy, "%s", typed);
    if ((comma = strchr(copy, ','))) *comma = '.';
    while (*text == ' ') text++;
    size_t length = strspn(text, "+-.0123456789eE");
    char *end;
    *value = strtod(text, &end);
    if (end == text || (size_t)(end - text) > length || !isfinite(*value)) return false;
    while (*end == ' ') end++;
    size_t unit = number->unit ? strlen(number->unit) : 0;
    if (unit && strncmp(end, number->unit, unit) == 0) end += unit;
    while (*end == ' ') end++;
    return *end == '\0';
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

static void complain_range(struct ui *ui, const struct ui_number *number, const char *what, double typed)
{
    char range[64];
    if (number->highest >= no_limit) {
        snprintf(range, sizeof range, "%.10g or more", number->lowest);
    } else {
        snprintf(range, sizeof range, "%.10g … %.10g", number->lowest, number->highest);
    }
    snprintf(ui->complaint, sizeof ui->complaint, "%.40s: expected %s, got %.10g", what, range, typed);
}

/// Parses the typed text; false, with the reason in ui->complaint, if it is no number or out of range.
static bool take_typed(struct ui *ui, const struct ui_number *number, double *value)
{
    double typed;
    const char *what = number->label ? number->label : number->name;
    if (!parse_number(number, ui->text.bytes, &typed)) {
        snprintf(ui->complaint, sizeof ui->complaint, "%s: expected a number, got “%.*s”", what,
                 name_fit(ui->text.bytes, 40), ui->text.bytes);
        return false;
    }
    if (typed < number->lowest || typed > number->highest) {
        complain_range(ui, number, what, typed);
        return false;
    }
    *value = typed;
    return true;
}

static enum ui_change commit(struct ui *ui, const struct ui_number *number, bool stay, double *value)
{
    double typed = *value;
    bool good = !ui->typed || take_typed(ui, number, &typed);
    ui->refused = !good;
    if (good || !stay) end_typing(ui);
    if (!good || typed == *value) return UI_NONE;
    *value = typed;
    return UI_SET;
}

static enum ui_change typing_event(struct ui *ui, uint32_t id, struct rect field, const struct ui_number *number,
                                   double *value)
{
    const bool by_key = ui->event->kind == EVENT_KEY;
    const enum ui_line line = ui_typing_event(ui, id, field);
    if (line == UI_LINE_CANCEL) end_typing(ui);
    if (line != UI_LINE_DONE) return UI_NONE;
    const enum ui_change change = commit(ui, number, by_key, value);
    ui->used |= by_key && ui->refused;
    if (!ui->used && by_key) ui->focus = id; // Tab goes on from here
    return change;
}

/// Starts the drag's mapping at `x`: on a bar at the pointer, in a field or a fine drag at the value.
static void set_anchor(struct ui *ui, struct rect field, const struct ui_number *number, float x, double value)
{
    ui->anchor_x = x;
    ui->anchor_value = value;
    if (has_bar(number) && !ui->fine) {
        double part = (x - field.x) / field.w;
        ui->anchor_value = number->minimum + part * (number->maximum - number->minimum);
    }
}

static double dragged(const struct ui *ui, struct rect field, const struct ui_number *number, float x)
{
    bool bar = has_bar(number);
    double rate = bar ? (number->maximum - number->minimum) / field.w : number->step;
    double value = ui->anchor_value + (x - ui->anchor_x) * rate * (ui->fine ? 0.1 : 1.0);
    value = round_decimals(value, number->decimals + (ui->fine ? 1 : 0));
    if (bar) value = fmax(number->minimum, fmin(number->maximum, value));
    return limited(number, value);
}

static enum ui_change held_event(struct ui *ui, struct rect field, const struct ui_number *number, double *value)
{
    const struct event *event = ui->event;
    if (event->kind != EVENT_POINTER) {
        const enum ui_change change = ui_held_change(ui);
        if (change == UI_CANCEL) *value = ui->before;
        return change;
    }
    ui->used = true;
    if (!ui->moved && fabsf(event->x - ui->press_x) < DRAG_THRESHOLD) return UI_NONE;
    bool fine = event->mods & MOD_SHIFT;
    if (!ui->moved) ui->before = *value;
    if (!ui->moved || fine != ui->fine) {
        ui->fine = fine;
        set_anchor(ui, field, number, ui->moved ? event->x : ui->press_x, *value);
        ui->moved = true;
    }
    *value = dragged(ui, field, number, event->x);
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

static enum ui_change focused_event(struct ui *ui, uint32_t id, const struct ui_number *number, double *value)
{
    const struct event *event = ui->event;
    if (event->kind == EVENT_TEXT && ui->focus == id && starts_number(event->codepoint)) {
        begin_typing(ui, id, *value, false);
        return typing_event(ui, id, (struct rect){0}, number, value);
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

static enum ui_change idle_event(struct ui *ui, uint32_t id, struct rect field, const struct ui_number *number,
                                 double *value)
{
    if (ui_pressed(ui, field, BUTTON_LEFT)) {
        if (ui->event->clicks == 2) {
            begin_typing(ui, id, *value, true);
        } else {
            ui_hold(ui, id);
        }
        return UI_NONE;
    }
    if (!isnan(number->fallback) && ui_pressed(ui, field, BUTTON_RIGHT)) return reset(number, value);
    return focused_event(ui, id, number, value);
}

/// Position on the bar, 0 … 1.
static float part_of(const struct ui_number *number, double value)
{
    double part = (value - number->minimum) / (number->maximum - number->minimum);
    return (float)fmax(0, fmin(1, part));
}

/// Left side of a bar's handle, kept inside the outline.
static float handle_x(struct rect field, float at) { return field.x + fmaxf(3, fminf(at - 1, field.w - 4)); }

/// A bar with 0 inside would end behind the text, so it is a strip below with a mark at 0.
static void paint_strip(struct ui *ui, struct rect field, float zero, float at, bool hot)
{
    const float height = 2;
    struct rect strip = {field.x + fminf(at, zero), field.y + field.h - height - 1, fabsf(at - zero), height};
    drawlist_rect(ui->list, strip, hot ? theme()->accent : theme()->text_dim);
    float x = handle_x(field, at);
    drawlist_rect(ui->list, (struct rect){x - 0.5f, field.y + field.h - HANDLE - 1, 3, HANDLE},
                  hot ? theme()->accent : theme()->text);
    drawlist_rect(ui->list, (struct rect){field.x + zero - 0.5f, strip.y - 1, 1, height + 1}, theme()->text_dim);
}

/// Fills faintly up to the value, because text is drawn over it, with a clear strip and the handle below the text.
static void paint_bar(struct ui *ui, struct rect field, const struct ui_number *number, double value, bool hot,
                      bool held)
{
    float at = field.w * part_of(number, value);
    if (number->minimum < 0) {
        paint_strip(ui, field, field.w * part_of(number, 0), at, held || hot);
        return;
    }
    struct rect filled = {field.x, field.y, at, field.h};
    struct rect old = drawlist_push_clip(ui->list, filled);
    uint32_t fill = held ? theme_fade(theme()->accent, 0.35f) : hot ? theme()->hover : theme()->fill;
    drawlist_rounded(ui->list, field, UI_RADIUS, fill);
    drawlist_set_clip(ui->list, old);
    float x = handle_x(field, at);
    struct rect strip = {field.x + 3, field.y + field.h - 3, fmaxf(0, x - field.x - 3), 2};
    drawlist_rect(ui->list, strip, held || hot ? theme()->accent : theme()->text_dim);
    struct rect handle = {x - 0.5f, field.y + field.h - HANDLE - 1, 3, HANDLE};
    drawlist_rect(ui->list, handle, held || hot ? theme()->accent : theme()->text);
}

/// A faint line across the bar.
static void paint_was(struct ui *ui, struct rect field, const struct ui_number *number)
{
    const float x = handle_x(field, field.w * part_of(number, *number->was));
    drawlist_rect(ui->list, (struct rect){x, field.y + 2, 1.5f, field.h - 4}, theme_fade(theme()->playhead, 0.6f));
}

static void paint(struct ui *ui, struct rect r, struct rect field, uint32_t id, const struct ui_number *number,
                  double value)
{
    bool held = ui->held == id && ui->moved, typing = ui->typing == id;
    bool hot = ui_hovered(ui, field) && ui->held == 0;
    if (hot || ui->held == id) ui->over = typing ? UI_OVER_TEXT : UI_OVER_NUMBER;
    if (number->label) {
        struct rect label = {r.x, r.y, field.x - r.x - UI_GAP, r.h};
        ui_label(ui, label, number->label, hot || held || ui->focus == id ? theme()->text : theme()->text_dim);
    }
    drawlist_rounded(ui->list, field, UI_RADIUS, theme()->raised);
    struct rect inner = {field.x + UI_GAP, field.y, field.w - 2 * UI_GAP, field.h};
    if (typing) {
        ui_paint_text(ui, inner, &ui->text, FONT_NUMBER, THEME_TEXT_SMALL, true);
        drawlist_rounded_line(ui->list, field, UI_RADIUS, 1.5f, ui->refused ? theme()->error : theme()->accent);
        return;
    }
    char formatted[64];
    format_number(number, value, formatted, sizeof formatted);
    const char *text = number->shown ? number->shown : formatted;
    if (has_bar(number)) paint_bar(ui, field, number, value, hot, held);
    if (has_bar(number) && number->was && *number->was != value) paint_was(ui, field, number);
    if (held) {
        drawlist_rounded_line(ui->list, field, UI_RADIUS, 1, theme()->accent);
    } else {
        ui_outline(ui, field, UI_RADIUS, hot);
    }
    ui_number_text(ui, inner, text, theme()->text);
    ui_focus_ring(ui, id, field);
}

/// Finds a bar's handle, so that pressing there and dragging to "name,value" sets that value.
static void find_bar(struct ui *ui, struct rect field, const struct ui_number *number, double value)
{
    ui->found_x = field.x + field.w * part_of(number, ui->find_has_value ? ui->find_value : value);
    ui->found_x = fminf(ui->found_x, field.x + field.w - (ui->find_has_value ? 0.0f : 1.0f));
}

enum ui_change ui_value(struct ui *ui, struct rect r, const struct ui_number *number, double *value)
{
    uint32_t id = ui_id(ui, number->name);
    struct rect field = ui_field_of(r);
    if (number->label) {
        field.x += UI_LABEL + UI_GAP;
        field.w -= UI_LABEL + UI_GAP;
    }
    ui_register(ui, id, field);
    if (number->hint) ui_hint(ui, field, number->hint);
    switch (ui->pass) {
    case UI_PASS_DRAW:
        paint(ui, r, field, id, number, *value);
        return UI_NONE;
    case UI_PASS_FIND:
        if (ui->found == id && has_bar(number)) find_bar(ui, field, number, *value);
        return UI_NONE;
    case UI_PASS_EVENT:
        break;
    }
    // A press elsewhere ends typing even if another widget has used it.
    bool press = ui->event->kind == EVENT_BUTTON && ui->event->action == ACTION_PRESS;
    if (ui->typing == id && (press || !ui->used)) return typing_event(ui, id, field, number, value);
    if (ui->used || ui->blocked) return UI_NONE;
    if (ui->held == id) return held_event(ui, field, number, value);
    return idle_event(ui, id, field, number, value);
}
