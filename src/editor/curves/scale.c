/// Scales the selected knots in time and value, by S and the pointer, by typed factors, or by a handle of their box.
///
/// A knot (t, v) goes to (p + a·(t − p), q + b·(v − q)) about the pivot (p, q); its slope is multiplied by b/a, so the curve's shape
/// scales too. "About the equilibrium" takes q from the knot's own spline at the knot.
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/selection.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double LEAST_REACH = 40; ///< pixels from the pivot for factor 1, so that small movements stay precise
static const double LEAST_SIDE = 8;   ///< likewise for a box dragged by its handle
static const double SLOPE_RESOLUTION = 1e-6; ///< of the visible values, a second
static const double MOST = 1e4;              ///< largest factor

/// Lowest and highest frame and drawn value of the selection.
static void measure(const struct curves *curves, const struct core *core, double frames[2], double values[2])
{
    frames[0] = values[0] = INFINITY;
    frames[1] = values[1] = -INFINITY;
    for (int i = 0; i < core->originals.count; i++) {
        const struct original *original = &core->originals.list[i];
        const struct value_map map = normal_map(curves, core, original->spline);
        const double value = map.scale * original->value + map.offset;
        frames[0] = fmin(frames[0], original->knot.frame);
        frames[1] = fmax(frames[1], original->knot.frame);
        values[0] = fmin(values[0], value);
        values[1] = fmax(values[1], value);
    }
}

/// Stores the equilibria before any edit changes them.
static void note_equilibria(struct curves *curves, struct core *core)
{
    struct scaling *scaling = &curves->scaling;
    const struct evaluation *evaluation = core->evaluation;
    double frames[2], values[2];
    measure(curves, core, frames, values);
    for (int i = 0; i < core->originals.count; i++) {
        struct original *original = &core->originals.list[i];
        const int sample = document_sample(core->document, original->knot.frame);
        original->equilibrium = evaluation_at(evaluation, original->spline, sample).y;
    }
    const double position = round(core->playback.position), middle = (frames[0] + frames[1]) / 2;
    scaling->playhead[0] = document_frame(core->document, (int)position);
    scaling->playhead[1] = evaluation_at(evaluation, core->active, position).y;
    scaling->balance[0] = middle;
    scaling->balance[1] = evaluation_at(evaluation, core->active, core_position(core->document, middle)).y;
}

/// The equilibrium, as drawn, of the knot at the held edge. That knot stays under the pointer.
static double edge_equilibrium(const struct curves *curves, const struct core *core)
{
    for (int i = 0; i < core->originals.count; i++) {
        const struct original *original = &core->originals.list[i];
        const struct value_map map = normal_map(curves, core, original->spline);
        if (map.scale * original->value + map.offset == curves->scaling.edge[1])
            return map.scale * original->equilibrium + map.offset;
    }
    return curves->scaling.balance[1];
}

static void place_pivot(struct curves *curves, const struct core *core)
{
    struct scaling *scaling = &curves->scaling;
    double frames[2], values[2];
    measure(curves, core, frames, values);
    const bool held = scaling->handle >= 0, left = held && box_column(scaling->handle) < 0,
               top = held && box_row(scaling->handle) < 0;
    const double middle[2] = {(frames[0] + frames[1]) / 2, (values[0] + values[1]) / 2};
    const double side[2] = {frames[left], values[!top]};
    scaling->edge[0] = frames[!left];
    scaling->edge[1] = values[top];
    if (held) scaling->balance[1] = edge_equilibrium(curves, core);
    const double *const places[PIVOTS] = {middle, scaling->playhead, scaling->balance, side};
    scaling->frame = places[scaling->pivot][0];
    scaling->value = places[scaling->pivot][1];
}

static enum pivot next_pivot(const struct scaling *scaling)
{
    if (scaling->handle >= 0) return scaling->pivot == PIVOT_SIDE ? PIVOT_EQUILIBRIUM : PIVOT_SIDE;
    return (scaling->pivot + 1) % PIVOT_SIDE;
}

static const char *pivot_name(const struct scaling *scaling, enum pivot pivot)
{
    static const char *const names[PIVOTS] = {"middle", "playhead", "equilibrium", "other side"};
    const bool time_only = scaling->handle >= 0 && box_row(scaling->handle) == 0;
    return time_only && pivot == PIVOT_EQUILIBRIUM ? names[PIVOT_MIDDLE] : names[pivot];
}

/// "time × 1.2 (what stopped it)"
static void say_factor(char out[128], const char *what, double factor, const char *stopped)
{
    snprintf(out, 128, *stopped ? "%s × %.3g (%s)" : "%s × %.3g", what, factor, stopped);
}

static void say(struct curves *curves, const struct core *core)
{
    struct scaling *scaling = &curves->scaling;
    const struct drag *drag = &core->drag;
    const char *keys = scaling->handle < 0 ? "X, Y;  Enter, Esc" : box_corner(scaling->handle) ? "X, Y;  Esc" : "Esc";
    char time[128] = "", value[128] = "";
    if (!drag->lock_y) say_factor(time, "time", scaling->by.time, scaling->stopped[0]);
    if (!drag->lock_x) say_factor(value, "value", scaling->by.value, scaling->stopped[1]);
    snprintf(scaling->sentence, sizeof scaling->sentence, "%s%sScale %s%s%s about the %s.  P: the %s;  %s",
             scaling->typed, scaling->typed[0] ? "_   " : "", time, *time && *value ? ", " : "", value,
             pivot_name(scaling, scaling->pivot), pivot_name(scaling, next_pivot(scaling)), keys);
}

/// Distance of the pointer from the pivot relative to its distance at the start, along one axis.
static double along(double pivot, double start, double now)
{
    double reach = start - pivot;
    if (fabs(reach) < LEAST_REACH) reach = reach < 0 ? -LEAST_REACH : LEAST_REACH;
    return 1 + (now - start) / reach;
}

static double clamped(double factor) { return fmin(fmax(factor, -MOST), MOST); }

static void end(void *room, struct core *core, bool keep)
{
    (void)room;
    if (keep && core->drag.moved) core_edited(core, -1);
}

/// One typed factor scales both axes; two scale time and value.
static void read_typed(const char *typed, struct factors *by)
{
    char *end;
    double first = strtod(typed, &end);
    if (end == typed) return;
    *by = (struct factors){first, first};
    const char *rest = end;
    double second = strtod(rest, &end);
    if (end != rest) by->value = second;
}

/// The factor that keeps an edge of the box under the pointer. Distances are pixels from the pivot.
static double pulled(double reach, double by, int direction)
{
    return 1 + by / (fabs(reach) < LEAST_SIDE ? direction * LEAST_REACH : reach);
}

static struct factors pulled_box(const struct curves *curves, const struct core *core)
{
    const struct drag *drag = &core->drag;
    const struct scaling *scaling = &curves->scaling;
    const int column = box_column(scaling->handle), row = box_row(scaling->handle);
    const double across = curves_x(curves, core, scaling->edge[0]) - curves_x(curves, core, scaling->frame);
    const double down = curves_y(curves, core, scaling->edge[1]) - curves_y(curves, core, scaling->value);
    return (struct factors){column ? pulled(across, drag->moved_x, column) : 1,
                            row ? pulled(down, drag->moved_y, row) : 1};
}

/// Factors from the pointer after S.
static struct factors pulled_freely(const struct curves *curves, const struct core *core)
{
    const struct drag *drag = &core->drag;
    const struct scaling *scaling = &curves->scaling;
    double x = curves_x(curves, core, scaling->frame), y = curves_y(curves, core, scaling->value);
    double to_x = drag->start_x + drag->moved_x, to_y = drag->start_y + drag->moved_y;
    double before = fmax(maths_hypot(drag->start_x - x, drag->start_y - y), LEAST_REACH);
    double factor =
        1 + (maths_hypot(to_x - x, to_y - y) - maths_hypot(drag->start_x - x, drag->start_y - y)) / before;
    if (drag->lock_x) factor = along(x, drag->start_x, to_x);
    if (drag->lock_y) factor = along(y, drag->start_y, to_y);
    return (struct factors){factor, factor};
}

static struct factors wanted(const struct curves *curves, const struct core *core)
{
    const struct drag *drag = &core->drag;
    const struct scaling *scaling = &curves->scaling;
    struct factors by = scaling->handle >= 0 ? pulled_box(curves, core) : pulled_freely(curves, core);
    read_typed(scaling->typed, &by);
    return (struct factors){drag->lock_y ? 1 : clamped(by.time), drag->lock_x ? 1 : clamped(by.value)};
}

static double scaled_value(const struct curves *curves, const struct core *core, const struct original *original,
                           double factor)
{
    const struct scaling *scaling = &curves->scaling;
    const struct value_map map = normal_map(curves, core, original->spline);
    const double drawn = (scaling->value - map.offset) / map.scale;
    const double pivot = scaling->pivot == PIVOT_EQUILIBRIUM ? original->equilibrium : drawn;
    const double resolution = 0.01 / curves_pixels_per_value(curves, core) / map.scale;
    return core_round(pivot + factor * (original->value - pivot), resolution);
}

struct scale {
    const struct curves *curves;
    const struct core *core;
};

static struct knot scaled(const void *how, const struct original *original)
{
    const struct curves *curves = ((const struct scale *)how)->curves;
    const struct core *core = ((const struct scale *)how)->core;
    const struct factors by = curves->scaling.by;
    const double pivot = curves->scaling.frame, steeper = by.value / by.time;
    const double frame = pivot + by.time * (original->knot.frame - pivot);
    struct knot to = original->knot;
    if (by.time != 1) to.frame = core->drag.snap ? round(frame) : frame;
    if (by.value != 1 && !to.still) to.value = scaled_value(curves, core, original, by.value);
    to.phase *= by.time < 0 ? -by.value : by.value; // time runs backwards, so the swing does
    if (steeper != 1) to.slope = core_round(original->knot.slope * steeper, SLOPE_RESOLUTION * core->visible);
    return to;
}

static bool changes_values(const struct core *core, const struct scale *scale)
{
    bool changes = false;
    for (int i = 0; i < core->originals.count && !changes; i++)
        changes = !core->originals.list[i].knot.still &&
                  scaled(scale, &core->originals.list[i]).value != core->originals.list[i].value;
    return changes;
}

static void apply(void *room, struct core *core)
{
    struct curves *curves = room;
    struct scaling *scaling = &curves->scaling;
    const struct scale scale = {curves, core};
    scaling->by = wanted(curves, core);
    scaling->stopped[0][0] = scaling->stopped[1][0] = 0;
    if (originals_room(core, scaled, &scale, scaling->stopped[0]) != ROOM_FREE) scaling->by.time = scaling->free_time;
    scaling->free_time = scaling->by.time;
    if (scaling->by.value != 1 && scaling->by.time == 1 && !changes_values(core, &scale))
        snprintf(scaling->stopped[1], STOPPED_SIZE, "all are on the %s", pivot_name(scaling, scaling->pivot));
    if (!originals_put(core, scaled, &scale, scaling->stopped[1])) drag_restart(core);
    say(curves, core);
}

/// Accepts digits, sign, point, and a space before a second factor. Characters, because keyboard layouts differ.
static bool type(struct scaling *scaling, uint32_t c)
{
    size_t length = strlen(scaling->typed);
    bool digit = c >= '0' && c <= '9';
    const char *space = strchr(scaling->typed, ' '), *number = space ? space + 1 : scaling->typed;
    bool sign = c == '-' && !*number, point = (c == '.' || c == ',') && !strchr(number, '.');
    bool next = c == ' ' && !space && *number;
    if (!(digit || sign || point || next) || length + 1 >= sizeof scaling->typed) return false;
    scaling->typed[length] = (char)(c == ',' ? '.' : c);
    scaling->typed[length + 1] = 0;
    return true;
}

static void erase(struct scaling *scaling)
{
    size_t length = strlen(scaling->typed);
    if (length > 0) scaling->typed[length - 1] = 0;
}

static void change(struct core *core)
{
    drag_start_moving(core);
    core->drag.stale = true;
}

static enum drag_answer press_key(struct curves *curves, struct core *core, const struct event *event)
{
    struct scaling *scaling = &curves->scaling;
    if (event->key == KEY_ESCAPE) return DRAG_TAKE_BACK;
    if (event->key == KEY_ENTER) return DRAG_KEEP;
    if (event->key == 'P') {
        drag_restart(core);
        scaling->pivot = next_pivot(scaling);
        place_pivot(curves, core);
    } else if (event->key == KEY_BACKSPACE) {
        erase(scaling);
    } else if ((scaling->handle >= 0 && !box_corner(scaling->handle)) || !drag_lock(&core->drag, event->key)) {
        return DRAG_USED;
    }
    change(core);
    return DRAG_USED;
}

/// Keys and clicks while scaling: axes, pivot, typed factors, the end.
static enum drag_answer take_event(void *room, struct core *core, const struct event *event)
{
    struct curves *curves = room;
    bool press = event->action != ACTION_RELEASE;
    switch (event->kind) {
    case EVENT_BUTTON:
        if (curves->scaling.handle >= 0) return DRAG_PASSES;
        return !press ? DRAG_USED : event->button == BUTTON_LEFT ? DRAG_KEEP : DRAG_TAKE_BACK;
    case EVENT_KEY:
        return press ? press_key(curves, core, event)
                     : DRAG_PASSES; /* of a key that was held before, the release is somebody else's */
    case EVENT_TEXT:
        if (type(&curves->scaling, event->codepoint)) change(core);
        return DRAG_USED;
    default:
        return event->kind == EVENT_WHEEL ? DRAG_USED
                                          : DRAG_PASSES; /* the factor is measured in pixels: no zooming meanwhile */
    }
}

enum { TAG_PAD = 8, LINE = 16, MARGIN = 4, MOST_LINES = 4 };

/// The text beside the pointer.
struct tag {
    int count;
    struct {
        char text[STOPPED_SIZE];
        bool is_stop;
    } line[MOST_LINES];
};

/// A factor, and what stopped it on a second line.
static void add_factor(struct tag *tag, const char *what, double factor, const char *stopped)
{
    snprintf(tag->line[tag->count++].text, sizeof tag->line[0].text, "%s × %.3g", what, factor);
    if (!*stopped) return;
    tag->line[tag->count].is_stop = true;
    snprintf(tag->line[tag->count++].text, sizeof tag->line[0].text, "%s", stopped);
}

static const float BESIDE = 16, BELOW = 20; ///< pixels from the pointer

static void show_tag(struct core *core, const struct tag *tag)
{
    const struct rect panel = core->layout.curves;
    float width = 0;
    for (int i = 0; i < tag->count; i++)
        width = fmaxf(width, ceilf(font_width(FONT_LABEL, THEME_TEXT_SMALL, tag->line[i].text)));
    const float w = width + 2 * TAG_PAD, h = (float)(tag->count * LINE + TAG_PAD);
    const float right = panel.x + panel.w - MARGIN - w, bottom = panel.y + panel.h - MARGIN - h;
    const struct rect box = {roundf(fmaxf(panel.x + MARGIN, fminf(core->drag.x + BESIDE, right))),
                             roundf(core->drag.y + BELOW <= bottom ? core->drag.y + BELOW : core->drag.y - BELOW - h),
                             w, h};
    drawlist_rounded(&core->list, box, 4, theme()->raised);
    drawlist_rounded_line(&core->list, box, 4, 1, theme()->control);
    for (int i = 0; i < tag->count; i++)
        drawlist_text(&core->list, box.x + TAG_PAD, box.y + (float)((i + 1) * LINE), FONT_LABEL, THEME_TEXT_SMALL,
                      tag->line[i].is_stop ? theme()->warning : theme()->text, tag->line[i].text);
}

static void show_pivot(const struct curves *curves, struct core *core)
{
    const struct scaling *scaling = &curves->scaling;
    const float x = curves_x(curves, core, scaling->frame), y = curves_y(curves, core, scaling->value), arm = 7;
    const float across[] = {x - arm, y, x + arm, y}, down[] = {x, y - arm, x, y + arm};
    const float line[] = {x, y, core->drag.x, core->drag.y};
    const bool pointed = scaling->handle < 0 && !scaling->typed[0];
    if (pointed) drawlist_dashed(&core->list, line, 2, 1, 3, 4, theme_fade(theme()->playhead, 0.5f));
    if (!core->drag.lock_y) drawlist_line(&core->list, across, 2, 1.5f, theme()->playhead);
    if (!core->drag.lock_x) drawlist_line(&core->list, down, 2, 1.5f, theme()->playhead);
}

static void scale_show(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct scaling *scaling = &curves->scaling;
    struct tag tag = {0};
    const struct rect clip = drawlist_push_clip(&core->list, core->layout.plot);
    scale_box_show(curves, core, true);
    show_pivot(curves, core);
    drawlist_set_clip(&core->list, clip);
    if (!core->drag.lock_y) add_factor(&tag, "time", scaling->by.time, scaling->stopped[0]);
    if (!core->drag.lock_x) add_factor(&tag, "value", scaling->by.value, scaling->stopped[1]);
    show_tag(core, &tag);
}

/// Started by S (a click or Enter ends it) or by pressing a handle of the selection box.
static const struct drag_owner owner = {
    .cursor = CURSOR_MOVE, .apply = apply, .event = take_event, .end = end, .show = scale_show};

/// `handle`: of the selection box, or -1 for S.
static void begin(struct curves *curves, struct core *core, enum pivot pivot, int handle)
{
    curves->scaling = (struct scaling){.pivot = pivot, .handle = handle, .by = {1, 1}, .free_time = 1};
    core->message.text[0] = 0;
    core->hover = (struct hover){.thing = NULL};
    note_equilibria(curves, core);
    place_pivot(curves, core);
    core->drag.hint = curves->scaling.sentence;
    say(curves, core);
}

void curves_scale(struct curves *curves, struct core *core, int about_equilibrium)
{
    core_collect(core, false);
    if (core->originals.count == 0) {
        core_message(core, false, "Select the knots to scale first.");
        return;
    }
    const struct event event = {.button = BUTTON_LEFT, .x = core->pointer_x, .y = core->pointer_y};
    drag_begin(core, &owner, curves, "Scale knots", &event);
    core->drag.lock_y = about_equilibrium;
    const enum pivot pivot = core->originals.count == 1 ? PIVOT_PLAYHEAD : PIVOT_MIDDLE;
    begin(curves, core, about_equilibrium ? PIVOT_EQUILIBRIUM : pivot, -1);
}

/// Starts scaling by a handle: about the opposite side or, with Alt, about the equilibrium.
static void press_box(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    const int handle = hover->handle;
    core_collect(core, false);
    drag_begin(core, &owner, curves, "Scale knots", event);
    core->drag.lock_x = box_row(handle) == 0;
    core->drag.lock_y = box_column(handle) == 0;
    begin(curves, core, event->mods & MOD_ALT ? PIVOT_EQUILIBRIUM : PIVOT_SIDE, handle);
    core->hover = (struct hover){.thing = &thing_box, .spline = core->active, .handle = handle};
}

static const float PAD = 12;   ///< from the outermost knots: outside their own targets
static const float REACH = 7;  ///< pixels at which a handle is hit
static const float HANDLE = 6; ///< size in pixels
static const float INSIDE = 4; ///< pixels from the plot's edge, so that handles stay reachable
static const float LEAST = 2;  ///< pixels; knots closer than this cannot be scaled apart

/// The selection box inside the visible plot, and the axes along which its knots differ.
struct knot_box {
    struct rect area;
    bool wide, high;
};

/// false with fewer than two knots selected, or none visible.
static bool find_knot_box(const struct curves *curves, const struct core *core, struct knot_box *box)
{
    float left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
    int count = 0;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at); count++) {
        const struct knot *knot = knot_at(core->document, at);
        const float x = curves_knot_x(curves, core, knot);
        const float y = curves_knot_y(curves, core, at.spline, knot);
        left = fminf(left, x);
        right = fmaxf(right, x);
        top = fminf(top, y);
        bottom = fmaxf(bottom, y);
    }
    if (count < 2) return false;
    const struct rect whole = {left - PAD, top - PAD, right - left + 2 * PAD, bottom - top + 2 * PAD};
    *box = (struct knot_box){rect_intersect(whole, rect_inset(core->layout.plot, INSIDE)), right - left >= LEAST,
                             bottom - top >= LEAST};
    return box->area.w > 0 && box->area.h > 0;
}

/// false if the box has no extent along the handle's axis.
static bool handle_place(const struct knot_box *box, int handle, float xy[2])
{
    const int column = box_column(handle), row = box_row(handle);
    if (handle == BOX_MIDDLE || (column && !box->wide) || (column && row && !box->high)) return false;
    xy[0] = box->area.x + box->area.w * 0.5f * (float)(column + 1);
    xy[1] = box->area.y + box->area.h * 0.5f * (float)(row + 1);
    return true;
}

static bool find_box(void *room, const struct core *core, const struct target *target, float xy[2])
{
    struct knot_box box;
    const int column = (int)target->number[0], row = (int)target->number[1];
    const bool known = abs(column) <= 1 && abs(row) <= 1 && find_knot_box(room, core, &box);
    return known && handle_place(&box, 3 * (row + 1) + column + 1, xy);
}

/// box(1,0): a handle of the selection box, here the middle of its right edge; box(-1,-1) is the upper left corner.
const struct thing thing_box = {
    .cursor = CURSOR_MOVE,
    .hint =
        "Drag to scale the selected knots about the other side; with Alt about the equilibrium (P while you drag)",
    .place = ON_KNOT,
    .press = press_box,
    .name = "box",
    .numbers = 2,
    .find = find_box,
    .missing = "the selected knots have no such handle"};

void scale_box_hover(const struct curves *curves, const struct core *core, float x, float y, struct hover *hover)
{
    struct knot_box box;
    float best = REACH, xy[2];
    if (!find_knot_box(curves, core, &box)) return;
    for (int i = 0; i < BOX_HANDLES; i++) {
        if (!handle_place(&box, i, xy)) continue;
        if (is_nearest(maths_hypotf(x - xy[0], y - xy[1]), &best))
            *hover = (struct hover){.thing = &thing_box, .spline = core->active, .handle = i};
    }
}

static void show_handle(struct core *core, int handle, const float xy[2])
{
    const bool hot = core->hover.thing == &thing_box && core->hover.handle == handle;
    const float size = hot ? HANDLE + 3 : HANDLE;
    const struct rect r = {roundf(xy[0] - size / 2), roundf(xy[1] - size / 2), size, size};
    drawlist_rounded(&core->list, r, 1.5f, hot ? theme()->playhead : theme()->panel);
    drawlist_rounded_line(&core->list, r, 1.5f, 1, theme_fade(theme()->playhead, hot ? 1 : 0.75f));
}

void scale_box_show(const struct curves *curves, struct core *core, bool handles)
{
    struct knot_box box;
    if (!find_knot_box(curves, core, &box)) return;
    drawlist_rounded_line(&core->list, rect_inset(box.area, -0.5f), 0, 1, theme_fade(theme()->playhead, 0.3f));
    for (int i = 0; i < BOX_HANDLES && handles; i++) {
        float xy[2];
        if (handle_place(&box, i, xy)) show_handle(core, i, xy);
    }
}
