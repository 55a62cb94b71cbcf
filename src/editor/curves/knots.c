/// Edits knots on the curves and the dope sheet: drags of knots and slopes, scaling, and the sheet's rows.
#include "editor/core/core.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Drags. Each step starts again from the original knots. Ripple moves the later knots too.

static const double SLOPE_RESOLUTION = 1e-3; ///< of the visible values, a second
static const double LENGTH_SLACK = 8;        ///< pixels; a longer pull also changes the stiffness

static void collect_knots(const struct curves *curves, struct core *core)
{
    core_collect(core, curves->knot_drag.ripple);
    core->input.drag.label = core->step.originals.count == 1 ? "Move knot" : "Move knots";
}

/// Moves knots in time; selected ones also in value, measured in values of the active spline.
struct moving {
    const struct curves *curves;
    double frames, up, resolution;
};

static struct knot moved_knot(const struct core *core, const void *how, const struct original *original)
{
    const struct moving *moving = how;
    const double scale = normal_map(moving->curves, core, original->spline).scale;
    struct knot knot = original->knot;
    knot.frame += moving->frames;
    if (moving->up != 0 && !knot.still && selection_has(&core->focus.selection, knot.id))
        knot.value = core_round(knot.value + moving->up / scale, moving->resolution / scale);
    return knot;
}

/// The held knot snaps to whole frames, and all knots stay in range.
static void apply_knots(void *of, struct core *core)
{
    struct curves *curves = of;
    const struct drag *drag = &core->input.drag;
    const struct originals *originals = &core->step.originals;
    const struct document *document = core->document;
    const double pixels = curves_pixels_per_value(core);
    char why[STOPPED_SIZE] = "";
    if (originals->count == 0) return;
    const struct original *held = &originals->list[0];
    for (int i = 0; i < originals->count; i++) {
        if (originals->list[i].knot.id == drag->knot) held = &originals->list[i];
    }
    double frames = drag->lock_y ? 0 : drag->moved_x / curves_pixels_per_frame(core);
    if (drag->snap) frames = fabs(frames) < 0.5 ? 0 : round(held->knot.frame + frames) - held->knot.frame;

    // To the left a spline's first original may go to the first frame or, with ripple, just after the unmoved knot before it.
    double least = -INFINITY, most = INFINITY;
    for (int i = 0; i < originals->count && !drag->lock_y; i++) {
        const struct original *original = &originals->list[i];
        const struct spline *spline = document->splines[original->spline];
        const int sample = document_sample(document, original->knot.frame);
        const int before = spline_lower_bound(document, spline, sample) - 1;
        double left = document->first_frame - original->knot.frame;
        if (curves->knot_drag.ripple && before >= 0)
            left = document_frame(document, document_sample(document, spline->knots[before].frame) + 1) -
                   document_frame(document, sample);
        if (i == 0 || originals->list[i - 1].spline != original->spline) least = fmax(least, left);
        most =
            fmin(most, document_frame(document, document_last_knot_sample(document, spline)) - original->knot.frame);
    }
    if (frames < least || frames > most) snprintf(why, STOPPED_SIZE, "a knot would leave the range");
    if (curves->knot_drag.ripple && frames > most)
        snprintf(why, STOPPED_SIZE, "the last knot has reached the end of the range. Extend the range to make room");

    const double up = drag->lock_x ? 0 : -drag->moved_y / pixels;
    struct moving moving = {curves, fmax(fmin(frames, most), least), up, 0.01 / pixels};
    if (originals_room(core, moved_knot, &moving, why) != ROOM_FREE) moving.frames = curves->knot_drag.free_frames;
    curves->knot_drag.free_frames = moving.frames;
    if (!originals_put(core, moved_knot, &moving, why)) drag_restart(core);
    drag_say_stopped(core, why);
}

/// Turns the held end of the handle towards the pointer. Its length sets the stiffness.
static void apply_slope(void *of, struct core *core)
{
    const struct curves *curves = of;
    const struct drag *drag = &core->input.drag;
    const struct spline *spline = core_active_spline(core);
    const struct knot *knot = &spline->knots[spline_find_id(spline, drag->knot)];
    float end[2];
    curves_handle(core, knot, curves->knot_drag.handle, end);
    double x = curves_knot_x(core, knot);
    double across = end[0] + drag->moved_x - x;
    double down = end[1] + drag->moved_y - curves_y(core, knot->value);
    across = curves->knot_drag.handle ? fmax(across, 2) : fmin(across, -2);
    double seconds = across / curves_pixels_per_frame(core) / core->document->fps;
    struct knot turned = *knot;
    turned.slope = core_round(-down / curves_pixels_per_value(core) / seconds, SLOPE_RESOLUTION * plot_height(core));
    double length = handle_length(knot->stiffness), longer = maths_hypot(across, down) - length;
    if (fabs(longer) > LENGTH_SLACK) {
        turned.stiffness = handle_stiffness(length + longer - copysign(LENGTH_SLACK, longer));
    }
    core_put_knot(core, core->focus.active, &turned);
}

static enum drag_answer knots_event(void *room, struct core *core, const struct event *event)
{
    struct knot_drag *drag = &((struct curves *)room)->knot_drag;
    bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & (MOD_CTRL | MOD_ALT));
    if (!key) return DRAG_PASSES;
    if (event->key != 'R') return drag_lock(&core->input.drag, event->key) ? DRAG_USED : DRAG_PASSES;
    drag_restart(core);
    drag->ripple = !drag->ripple; // the later knots keep their distances to the dragged ones
    drag->free_frames = 0;
    core->input.drag.stale = true;
    collect_knots(room, core);
    core_message(core, false,
                 drag->ripple ? "Ripple on: later knots move too (R turns it off)."
                              : "Ripple off: later knots stay.");
    return DRAG_USED;
}

/// A click on one of several selected knots selects it alone.
static void end_knots(void *room, struct core *core, bool keep)
{
    struct curves *curves = room;
    if (!keep) return;
    if (core->input.drag.moved) {
        core_edited(core, -1);
    } else if (curves->knot_drag.collapse) {
        selection_clear(&core->focus.selection);
        selection_set(&core->focus.selection, core->input.drag.knot, true);
    }
}

static void show_moved_knots(void *room, struct core *core) { scale_box_show(room, core, false); }

/// Shift adds or removes the knot. Without Shift a drag moves all selected knots.
static void press_knot(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_MOVE,
                                            .apply = apply_knots,
                                            .event = knots_event,
                                            .end = end_knots,
                                            .show = show_moved_knots};
    struct curves *curves = room;
    unsigned id = hover->knot;
    bool selected = selection_has(&core->focus.selection, id);
    core_turn_to(core, hover->spline);
    core->focus.limb = 0;
    if (event->clicks == 2) {
        const struct spline *spline = core->document->splines[hover->spline];
        playback_seek(core, spline->knots[spline_find_id(spline, id)].frame);
        return;
    }
    if (event->mods & MOD_SHIFT) {
        selection_set(&core->focus.selection, id, !selected);
        selected_activate(core);
        if (selected) return;
    } else if (!selected) {
        core_select_only(core, id);
    }
    drag_begin(core, &owner, curves, NULL, event);
    core->input.drag.knot = id;
    curves->knot_drag = (struct knot_drag){.collapse = selected && !(event->mods & MOD_SHIFT)};
    collect_knots(curves, core);
    core->input.drag.lock_x =
        rect_contains(core->view.layout.sheet, event->x, event->y); // the dope sheet has only time
}

bool curves_in_plot(const struct core *core, double frame, double value, float xy[2])
{
    const struct rect *plot = &core->view.layout.plot;
    xy[0] = curves_x(core, frame);
    xy[1] = curves_y(core, value);
    return xy[0] >= plot->x && xy[1] >= plot->y && xy[0] <= plot->x + plot->w && xy[1] <= plot->y + plot->h;
}

static bool find_knot(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct document *document = core->document;
    (void)room;
    return curves_in_plot(core, document_frame(document, document_sample(document, target->knot->frame)),
                          core_knot_value(core, target->spline, target->knot), xy);
}

const struct thing thing_knot = {.cursor = CURSOR_MOVE,
                                 .hint = "Drag it (X, Y: one axis, R: later ones too, Shift: fine, Ctrl: off frames)",
                                 .place = ON_KNOT,
                                 .press = press_knot,
                                 .name = "knot",
                                 .of = OF_KNOT,
                                 .numbers = 1,
                                 .find = find_knot,
                                 .missing = "that knot is not in the visible part of the curves"};

static void press_slope(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_MOVE, .apply = apply_slope, .end = end_knots};
    struct curves *curves = room;
    drag_begin(core, &owner, curves, "Change slope", event);
    core->input.drag.knot = hover->knot;
    curves->knot_drag = (struct knot_drag){.handle = hover->handle};
}

static bool find_slope(void *room, const struct core *core, const struct target *target, float xy[2])
{
    (void)room;
    curves_handle(core, target->knot, target->number[1] > 0, xy);
    return target->knot->has_slope;
}

/// handle(sway,2,1): a slope handle's end, 0 before and 1 after the knot.
const struct thing thing_slope = {.cursor = CURSOR_MOVE,
                                  .hint = "Drag to turn the slope, pull to make it firmer; T removes it",
                                  .place = ON_KNOT,
                                  .press = press_slope,
                                  .name = "handle",
                                  .of = OF_KNOT,
                                  .numbers = 2,
                                  .find = find_slope,
                                  .missing = "that knot has no slope"};

static const double GHOST_SECONDS = 1.2;

/// Kinds of nudges for core_merge_key().
enum nudge_kind { NUDGE_FRAMES = 1, NUDGE_VALUE };

void curves_nudge(const struct curves *curves, struct core *core, double frames, double hundredths)
{
    const double up = 0.01 * hundredths * plot_height(core);
    struct moving moving = {curves, frames, up, 0.01 * fabs(up)};
    enum room room = ROOM_FREE;
    char why[STOPPED_SIZE] = "";
    core_collect(core, false);
    // jump over knots in the way
    while (frames != 0 && (room = originals_room(core, moved_knot, &moving, why)) == ROOM_OCCUPIED)
        moving.frames += frames;
    if (room == ROOM_OUTSIDE) moving.frames = 0;
    if (room == ROOM_OUTSIDE) core_stopped(core, why);
    if (core->step.originals.count == 0 || (moving.frames == 0 && up == 0)) return;
    if (room == ROOM_FREE) why[0] = 0;
    if (!core_step(core, "Nudge knots", core_merge_key(core, frames != 0 ? NUDGE_FRAMES : NUDGE_VALUE))) return;
    originals_put(core, moved_knot, &moving, why);
    if (*why) core_stopped(core, why);
    core->step.nudged_seconds = GHOST_SECONDS;
    core_edited(core, -1);
}

// Scales the selected knots in time and value, by S and the pointer, by typed factors, or by a handle of their box.
//
// A knot (t, v) goes to (p + a·(t − p), q + b·(v − q)) about the pivot (p, q); its slope is multiplied by b/a, so the curve's shape
// scales too. "About the equilibrium" takes q from the knot's own spline at the knot.

/// Handles in three rows of three, from the upper left; the middle is none.
enum { BOX_HANDLES = 9, BOX_MIDDLE = 4 };

/// -1 left or top, 0 middle, 1 right or bottom.
static int box_column(int handle) { return handle % 3 - 1; }

static int box_row(int handle) { return handle / 3 - 1; }

static bool box_corner(int handle) { return box_column(handle) && box_row(handle); }

static const double LEAST_REACH = 40;  ///< pixels from the pivot for factor 1, so that small movements stay precise
static const double LEAST_SIDE = 8;    ///< likewise for a box dragged by its handle
static const double FINE_SLOPE = 1e-6; ///< resolution of a scaled slope, of the visible values a second
static const double MOST = 1e4;        ///< largest factor

/// Lowest and highest frame and drawn value of the selection.
static void measure_selection(const struct curves *curves, const struct core *core, double frames[2],
                              double values[2])
{
    frames[0] = values[0] = INFINITY;
    frames[1] = values[1] = -INFINITY;
    for (int i = 0; i < core->step.originals.count; i++) {
        const struct original *original = &core->step.originals.list[i];
        const struct value_map map = normal_map(curves, core, original->spline);
        const double value = map.scale * original->value + map.offset;
        frames[0] = fmin(frames[0], original->knot.frame);
        frames[1] = fmax(frames[1], original->knot.frame);
        values[0] = fmin(values[0], value);
        values[1] = fmax(values[1], value);
    }
}

static void place_pivot(struct curves *curves, const struct core *core)
{
    struct scaling *scaling = &curves->scaling;
    double frames[2], values[2];
    measure_selection(curves, core, frames, values);
    const bool held = scaling->handle >= 0, left = held && box_column(scaling->handle) < 0,
               top = held && box_row(scaling->handle) < 0;
    const double middle[2] = {(frames[0] + frames[1]) / 2, (values[0] + values[1]) / 2};
    const double side[2] = {frames[left], values[!top]};
    scaling->edge[0] = frames[!left];
    scaling->edge[1] = values[top];
    // The knot at the held edge stays under the pointer.
    for (int i = 0; held && i < core->step.originals.count; i++) {
        const struct original *original = &core->step.originals.list[i];
        const struct value_map map = normal_map(curves, core, original->spline);
        if (map.scale * original->value + map.offset != scaling->edge[1]) continue;
        scaling->balance[1] = map.scale * original->equilibrium + map.offset;
        break;
    }
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

static void say_scale(struct curves *curves, const struct core *core)
{
    struct scaling *scaling = &curves->scaling;
    const struct drag *drag = &core->input.drag;
    const char *keys = scaling->handle < 0 ? "X, Y;  Enter, Esc" : box_corner(scaling->handle) ? "X, Y;  Esc" : "Esc";
    char time[128] = "", value[128] = "";
    const char *why_time = scaling->stopped[0], *why_value = scaling->stopped[1];
    if (!drag->lock_y)
        snprintf(time, sizeof time, *why_time ? "time × %.3g (%s)" : "time × %.3g", scaling->by.time, why_time);
    if (!drag->lock_x)
        snprintf(value, sizeof value, *why_value ? "value × %.3g (%s)" : "value × %.3g", scaling->by.value,
                 why_value);
    snprintf(scaling->sentence, sizeof scaling->sentence, "%s%sScale %s%s%s about the %s.  P: the %s;  %s",
             scaling->typed, scaling->typed[0] ? "_   " : "", time, *time && *value ? ", " : "", value,
             pivot_name(scaling, scaling->pivot), pivot_name(scaling, next_pivot(scaling)), keys);
}

/// Distance of the pointer from the pivot relative to its distance at the start, along one axis.
static double axis_factor(double pivot, double start, double now)
{
    double reach = start - pivot;
    if (fabs(reach) < LEAST_REACH) reach = reach < 0 ? -LEAST_REACH : LEAST_REACH;
    return 1 + (now - start) / reach;
}

/// The factor that keeps an edge of the box under the pointer. Distances are pixels from the pivot.
static double edge_factor(double reach, double by, int direction)
{
    return 1 + by / (fabs(reach) < LEAST_SIDE ? direction * LEAST_REACH : reach);
}

static struct knot scaled_knot(const struct core *core, const void *how, const struct original *original)
{
    const struct curves *curves = how;
    const struct scaling *scaling = &curves->scaling;
    const struct factors by = scaling->by;
    const double steeper = by.value / by.time;
    const double frame = scaling->frame + by.time * (original->knot.frame - scaling->frame);
    struct knot to = original->knot;
    if (by.time != 1) to.frame = core->input.drag.snap ? round(frame) : frame;
    if (by.value != 1 && !to.still) {
        const struct value_map map = normal_map(curves, core, original->spline);
        const double drawn = (scaling->value - map.offset) / map.scale;
        const double pivot = scaling->pivot == PIVOT_EQUILIBRIUM ? original->equilibrium : drawn;
        const double resolution = 0.01 / curves_pixels_per_value(core) / map.scale;
        to.value = core_round(pivot + by.value * (original->value - pivot), resolution);
    }
    to.phase *= by.time < 0 ? -by.value : by.value; // time runs backwards, so the swing does
    if (steeper != 1) to.slope = core_round(original->knot.slope * steeper, FINE_SLOPE * plot_height(core));
    return to;
}

static void scale_knots(void *room, struct core *core)
{
    struct curves *curves = room;
    struct scaling *scaling = &curves->scaling;
    const struct drag *drag = &core->input.drag;
    const struct originals *originals = &core->step.originals;
    const double x = curves_x(core, scaling->frame), y = curves_y(core, scaling->value);
    struct factors by;
    if (scaling->handle >= 0) {
        const int column = box_column(scaling->handle), row = box_row(scaling->handle);
        const double across = curves_x(core, scaling->edge[0]) - (float)x;
        const double down = curves_y(core, scaling->edge[1]) - (float)y;
        by = (struct factors){column ? edge_factor(across, drag->moved_x, column) : 1,
                              row ? edge_factor(down, drag->moved_y, row) : 1};
    } else {
        const double to_x = drag->start_x + drag->moved_x, to_y = drag->start_y + drag->moved_y;
        const double before = maths_hypot(drag->start_x - x, drag->start_y - y);
        double factor = 1 + (maths_hypot(to_x - x, to_y - y) - before) / fmax(before, LEAST_REACH);
        if (drag->lock_x) factor = axis_factor(x, drag->start_x, to_x);
        if (drag->lock_y) factor = axis_factor(y, drag->start_y, to_y);
        by = (struct factors){factor, factor};
    }

    // One typed factor scales both axes; two scale time and value.
    char *end, *second_end;
    const double first = strtod(scaling->typed, &end), second = strtod(end, &second_end);
    if (end != scaling->typed) by = (struct factors){first, second_end != end ? second : first};
    const double free_time = scaling->by.time;
    scaling->by.time = drag->lock_y ? 1 : fmin(fmax(by.time, -MOST), MOST);
    scaling->by.value = drag->lock_x ? 1 : fmin(fmax(by.value, -MOST), MOST);

    // Time stops at its last free factor; values may still change, unless all knots are on the pivot.
    scaling->stopped[0][0] = scaling->stopped[1][0] = 0;
    if (originals_room(core, scaled_knot, curves, scaling->stopped[0]) != ROOM_FREE) scaling->by.time = free_time;
    bool changes = scaling->by.value == 1 || scaling->by.time != 1;
    for (int i = 0; i < originals->count && !changes; i++)
        changes = !originals->list[i].knot.still &&
                  scaled_knot(core, curves, &originals->list[i]).value != originals->list[i].value;
    if (!changes)
        snprintf(scaling->stopped[1], STOPPED_SIZE, "all are on the %s", pivot_name(scaling, scaling->pivot));
    if (!originals_put(core, scaled_knot, curves, scaling->stopped[1])) drag_restart(core);
    say_scale(curves, core);
}

/// Keys and clicks while scaling: axes, pivot, typed factors, the end.
static enum drag_answer scale_event(void *room, struct core *core, const struct event *event)
{
    struct curves *curves = room;
    struct scaling *scaling = &curves->scaling;
    const size_t length = strlen(scaling->typed);
    const char *space = strchr(scaling->typed, ' '), *number = space ? space + 1 : scaling->typed;
    const uint32_t c = event->codepoint;
    const bool press = event->action != ACTION_RELEASE;
    const bool sign = c == '-' && !*number, point = (c == '.' || c == ',') && !strchr(number, '.');
    const bool digit = c >= '0' && c <= '9', next = c == ' ' && !space && *number;
    if (event->kind == EVENT_WHEEL) return DRAG_USED; // the factor is measured in pixels: no zooming meanwhile
    if (event->kind == EVENT_BUTTON && scaling->handle < 0)
        return !press ? DRAG_USED : event->button == BUTTON_LEFT ? DRAG_KEEP : DRAG_TAKE_BACK;
    if (event->kind ==
        EVENT_TEXT) { // characters, because keyboard layouts differ; a space comes before a second factor
        if (!(digit || sign || point || next) || length + 1 >= sizeof scaling->typed) return DRAG_USED;
        scaling->typed[length] = (char)(c == ',' ? '.' : c);
        scaling->typed[length + 1] = 0;
    } else if (event->kind != EVENT_KEY || !press) {
        return DRAG_PASSES; // of a key that was held before, the release is somebody else's
    } else if (event->key == KEY_ESCAPE || event->key == KEY_ENTER) {
        return event->key == KEY_ENTER ? DRAG_KEEP : DRAG_TAKE_BACK;
    } else if (event->key == 'P') {
        drag_restart(core);
        scaling->pivot = next_pivot(scaling);
        place_pivot(curves, core);
    } else if (event->key == KEY_BACKSPACE) {
        if (length > 0) scaling->typed[length - 1] = 0;
    } else if ((scaling->handle >= 0 && !box_corner(scaling->handle)) || !drag_lock(&core->input.drag, event->key)) {
        return DRAG_USED;
    }
    drag_start_moving(core);
    core->input.drag.stale = true;
    return DRAG_USED;
}

enum { TAG_PAD = 8, LINE = 16, MARGIN = 4, MOST_LINES = 4 };

static const float BESIDE = 16, BELOW = 20; ///< pixels from the pointer

static void scale_show(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct scaling *scaling = &curves->scaling;
    const struct drag *drag = &core->input.drag;
    const struct rect clip = drawlist_push_clip(&core->list, core->view.layout.plot);
    scale_box_show(curves, core, true);
    const float pivot_x = curves_x(core, scaling->frame), pivot_y = curves_y(core, scaling->value);
    const float arm = 7, across[] = {pivot_x - arm, pivot_y, pivot_x + arm, pivot_y},
                down[] = {pivot_x, pivot_y - arm, pivot_x, pivot_y + arm};
    const float line[] = {pivot_x, pivot_y, drag->x, drag->y};
    const bool pointed = scaling->handle < 0 && !scaling->typed[0];
    if (pointed) drawlist_dashed(&core->list, line, 2, 1, 3, 4, theme_fade(theme()->playhead, 0.5f));
    if (!drag->lock_y) drawlist_line(&core->list, across, 2, 1.5f, theme()->playhead);
    if (!drag->lock_x) drawlist_line(&core->list, down, 2, 1.5f, theme()->playhead);
    drawlist_set_clip(&core->list, clip);

    // The factors beside the pointer, and what stopped each on a second line.
    char factor[2][STOPPED_SIZE];
    const char *text[MOST_LINES];
    uint32_t color[MOST_LINES];
    int count = 0;
    float width = 0;
    snprintf(factor[0], STOPPED_SIZE, "time × %.3g", scaling->by.time);
    snprintf(factor[1], STOPPED_SIZE, "value × %.3g", scaling->by.value);
    for (int i = 0; i < MOST_LINES; i++) {
        if (i < 2 ? drag->lock_y : drag->lock_x) continue;
        if (i % 2 && !scaling->stopped[i / 2][0]) continue;
        color[count] = i % 2 ? theme()->warning : theme()->text;
        text[count] = i % 2 ? scaling->stopped[i / 2] : factor[i / 2];
        width = fmaxf(width, ceilf(font_width(FONT_LABEL, THEME_TEXT_SMALL, text[count])));
        count++;
    }
    const struct rect panel = core->view.layout.curves;
    const float w = width + 2 * TAG_PAD, h = (float)(count * LINE + TAG_PAD);
    const float right = panel.x + panel.w - MARGIN - w, bottom = panel.y + panel.h - MARGIN - h;
    const struct rect box = {roundf(fmaxf(panel.x + MARGIN, fminf(drag->x + BESIDE, right))),
                             roundf(drag->y + BELOW <= bottom ? drag->y + BELOW : drag->y - BELOW - h), w, h};
    drawlist_rounded(&core->list, box, 4, theme()->raised);
    drawlist_rounded_line(&core->list, box, 4, 1, theme()->control);
    for (int i = 0; i < count; i++)
        drawlist_text(&core->list, box.x + TAG_PAD, box.y + (float)((i + 1) * LINE), FONT_LABEL, THEME_TEXT_SMALL,
                      color[i], text[i]);
}

/// Started by S (a click or Enter ends it) or by pressing a handle of the selection box.
static const struct drag_owner scale_owner = {
    .cursor = CURSOR_MOVE, .apply = scale_knots, .event = scale_event, .end = end_knots, .show = scale_show};

/// Scales the collected knots. `handle`: of the selection box, or -1 for S.
static void begin_scale(struct curves *curves, struct core *core, const struct event *event, enum pivot pivot,
                        int handle)
{
    struct scaling *scaling = &curves->scaling;
    const struct evaluation *evaluation = core->evaluation;
    double frames[2], values[2];
    drag_begin(core, &scale_owner, curves, "Scale knots", event);
    core->input.drag.lock_x = handle >= 0 && box_row(handle) == 0;
    core->input.drag.lock_y = handle >= 0 ? box_column(handle) == 0 : pivot == PIVOT_EQUILIBRIUM;
    *scaling = (struct scaling){.pivot = pivot, .handle = handle, .by = {1, 1}};
    curves->knot_drag = (struct knot_drag){0};
    core->message.text[0] = 0;
    core->input.hover =
        (struct hover){.thing = handle >= 0 ? &thing_box : NULL, .spline = core->focus.active, .handle = handle};

    // The equilibria before any edit changes them.
    measure_selection(curves, core, frames, values);
    for (int i = 0; i < core->step.originals.count; i++) {
        struct original *original = &core->step.originals.list[i];
        const int sample = document_sample(core->document, original->knot.frame);
        original->equilibrium = evaluation_at(evaluation, original->spline, sample).y;
    }
    const double position = round(core->view.playback.position), middle = (frames[0] + frames[1]) / 2;
    scaling->playhead[0] = document_frame(core->document, (int)position);
    scaling->playhead[1] = evaluation_at(evaluation, core->focus.active, position).y;
    scaling->balance[0] = middle;
    scaling->balance[1] = evaluation_at(evaluation, core->focus.active, core_position(core->document, middle)).y;
    place_pivot(curves, core);
    core->input.drag.hint = scaling->sentence;
    say_scale(curves, core);
}

void curves_scale(struct curves *curves, struct core *core, int about_equilibrium)
{
    core_collect(core, false);
    if (core->step.originals.count == 0) {
        core_message(core, false, "Select the knots to scale first.");
        return;
    }
    const struct event event = {.button = BUTTON_LEFT, .x = core->input.pointer_x, .y = core->input.pointer_y};
    const enum pivot pivot = core->step.originals.count == 1 ? PIVOT_PLAYHEAD : PIVOT_MIDDLE;
    begin_scale(curves, core, &event, about_equilibrium ? PIVOT_EQUILIBRIUM : pivot, -1);
}

/// Starts scaling by a handle: about the opposite side or, with Alt, about the equilibrium.
static void press_box(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    core_collect(core, false);
    begin_scale(room, core, event, event->mods & MOD_ALT ? PIVOT_EQUILIBRIUM : PIVOT_SIDE, hover->handle);
}

static const float BOX_PAD = 12;     ///< from the outermost knots: outside their own targets
static const float HANDLE_REACH = 7; ///< pixels at which a handle is hit
static const float HANDLE = 6;       ///< size in pixels
static const float INSIDE = 4;       ///< pixels from the plot's edge, so that handles stay reachable
static const float LEAST = 2;        ///< pixels; knots closer than this cannot be scaled apart

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
        const float x = curves_knot_x(core, knot);
        const float y = curves_knot_y(curves, core, at.spline, knot);
        left = fminf(left, x);
        right = fmaxf(right, x);
        top = fminf(top, y);
        bottom = fmaxf(bottom, y);
    }
    if (count < 2) return false;
    const struct rect whole = {left - BOX_PAD, top - BOX_PAD, right - left + 2 * BOX_PAD, bottom - top + 2 * BOX_PAD};
    *box = (struct knot_box){rect_intersect(whole, rect_inset(core->view.layout.plot, INSIDE)), right - left >= LEAST,
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
    const bool exists = abs(column) <= 1 && abs(row) <= 1 && find_knot_box(room, core, &box);
    return exists && handle_place(&box, 3 * (row + 1) + column + 1, xy);
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
    float best = HANDLE_REACH, xy[2];
    if (!find_knot_box(curves, core, &box)) return;
    for (int i = 0; i < BOX_HANDLES; i++) {
        if (!handle_place(&box, i, xy)) continue;
        if (is_nearest(maths_hypotf(x - xy[0], y - xy[1]), &best))
            *hover = (struct hover){.thing = &thing_box, .spline = core->focus.active, .handle = i};
    }
}

void scale_box_show(const struct curves *curves, struct core *core, bool handles)
{
    struct knot_box box;
    if (!find_knot_box(curves, core, &box)) return;
    drawlist_rounded_line(&core->list, rect_inset(box.area, -0.5f), 0, 1, theme_fade(theme()->playhead, 0.3f));
    for (int i = 0; i < BOX_HANDLES && handles; i++) {
        float xy[2];
        if (!handle_place(&box, i, xy)) continue;
        const bool hot = core->input.hover.thing == &thing_box && core->input.hover.handle == i;
        const float size = hot ? HANDLE + 3 : HANDLE;
        const struct rect r = {roundf(xy[0] - size / 2), roundf(xy[1] - size / 2), size, size};
        drawlist_rounded(&core->list, r, 1.5f, hot ? theme()->playhead : theme()->panel);
        drawlist_rounded_line(&core->list, r, 1.5f, 1, theme_fade(theme()->playhead, hot ? 1 : 0.75f));
    }
}

// The dope sheet (F7): one row per spline between ruler and curves. Its knots are marks you drag in time.

enum { ROW = 16, SHEET_PAD = 3 }; ///< pixels; padding above and below

static const float LEAST_PLOT = 90; ///< least height of the curves, in pixels
static const float MARK_REACH = 7;  ///< pixels at which a mark is hit

void sheet_update(struct curves *curves, struct core *core)
{
    struct dope_sheet *sheet = &curves->sheet;
    const float room = core->view.layout.curves.h - core->view.layout.ruler.h - LEAST_PLOT - 2 * SHEET_PAD;
    int total = 0, active = 0; // how many splines are shown, and how many of them above the active one
    for (int s = 0; core->view.on[SWITCH_SHEET] && s < core->document->spline_count; s++) {
        total += spline_list_shows(core, s);
        if (s < core->focus.active) active = total;
    }
    int rows = total < SHEET_MAX_ROWS ? total : SHEET_MAX_ROWS;
    if (rows > (int)(room / ROW)) rows = (int)fmaxf(room / ROW, 0);
    if (sheet->active != core->focus.active_id) { // scroll its row into view
        sheet->list.view = (float)rows;
        if (spline_list_shows(core, core->focus.active)) ui_list_show(&sheet->list, (float)active, 1);
        sheet->active = core->focus.active_id;
    }
    sheet->rows = rows;
    ui_list_fit(&sheet->list, (float)rows, (float)total);
    for (int s = 0, row = -(int)sheet->list.offset; row < rows && s < core->document->spline_count; s++) {
        if (!spline_list_shows(core, s)) continue;
        if (row >= 0) sheet->spline[row] = s;
        row++;
    }
    const float height = rows > 0 ? (float)(rows * ROW + 2 * SHEET_PAD) : 0;
    if (core->view.layout.sheet_height == height) return;
    core->view.layout.sheet_height = height;
    core_layout(core);
}

static float row_y(const struct core *core, int row)
{
    return core->view.layout.sheet.y + SHEET_PAD + ((float)row + 0.5f) * ROW;
}

struct rect sheet_area(const struct core *core)
{
    const struct rect *sheet = &core->view.layout.sheet, *axis = &core->view.layout.value_axis;
    return (struct rect){axis->x, sheet->y, sheet->x + sheet->w - axis->x, sheet->h};
}

struct rect sheet_switch(const struct core *core)
{
    const struct rect corner = ruler_corner(core);
    return (struct rect){corner.x, corner.y, 13, corner.h};
}

struct hover sheet_hover(const struct curves *curves, const struct core *core, float x, float y)
{
    const int row = (int)floorf((y - core->view.layout.sheet.y - SHEET_PAD) / ROW);
    const int at = row < 0 ? 0 : row >= curves->sheet.rows ? curves->sheet.rows - 1 : row;
    const int spline = at >= 0 ? curves->sheet.spline[at] : -1;
    const int s = spline < core->document->spline_count ? spline : -1;
    struct hover hover = {.thing = s >= 0 ? &thing_row : NULL, .spline = s};
    if (s < 0 || !rect_contains(core->view.layout.sheet, x, y)) return hover;
    nearest_knot(curves, core, s, (const float[2]){x, NAN}, MARK_REACH, &hover);
    return hover;
}

const struct thing thing_row = {
    .hint = "Click to edit this spline; double-click to insert a knot on its curve; drag to select with a box",
    .place = ON_TIME,
    .press = curves_press_empty};

/// The height of a spline's row; NAN: it has none.
static float row_of(const struct curves *curves, const struct core *core, int spline)
{
    for (int row = 0; row < curves->sheet.rows; row++) {
        if (curves->sheet.spline[row] == spline) return row_y(core, row);
    }
    return NAN;
}

bool sheet_row_in(const struct curves *curves, const struct core *core, int spline, struct rect box)
{
    const float y = row_of(curves, core, spline), half = ROW / 2.0f;
    return y + half > box.y && y - half < box.y + box.h;
}

static bool find_mark(void *room, const struct core *core, const struct target *target, float xy[2])
{
    xy[0] = curves_knot_x(core, target->knot);
    xy[1] = row_of(room, core, target->spline);
    return rect_contains(core->view.layout.sheet, xy[0], xy[1]);
}

/// mark(sway,2): a knot on the dope sheet.
const struct thing thing_mark = {.name = "mark",
                                 .of = OF_KNOT,
                                 .numbers = 1,
                                 .find = find_mark,
                                 .missing = "the dope sheet does not show that knot"};

void sheet_show(const struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    const struct dope_sheet *sheet = &curves->sheet;
    const struct rect *area = &core->view.layout.sheet, *axis = &core->view.layout.value_axis;
    // The triangle in the ruler's corner points down while the sheet is open.
    const struct rect r = sheet_switch(core);
    const float x = r.x + 8, y = r.y + r.h / 2, a = 3.5f;
    const float right[] = {x - a + 1, y - a, x + a, y, x - a + 1, y + a},
                down[] = {x - a, y - a + 1, x + a, y - a + 1, x, y + a};
    drawlist_convex(&core->list, core->view.on[SWITCH_SHEET] ? down : right, 3,
                    core->input.hover.thing == &thing_sheet ? theme()->text : theme()->text_dim);
    if (area->h <= 0) return;
    for (int row = 0; row < sheet->rows; row++) {
        const int s = sheet->spline[row];
        if (s >= document->spline_count) continue; // an undo in this frame removed it
        const struct spline *spline = document->splines[s];
        const bool active = s == core->focus.active,
                   hot = core->input.hover.thing == &thing_row && core->input.hover.spline == s;
        const float middle = row_y(core, row);
        const uint32_t color = spline_list_color(document, s);
        const struct rect band = {area->x, middle - ROW / 2.0f, area->w, ROW};
        if (active || hot) drawlist_rect(&core->list, band, theme_fade(theme()->text, active ? 0.07f : 0.035f));
        struct rect clip = drawlist_push_clip(&core->list, *area);
        if (spline->knot_count > 1) {
            const float from = curves_knot_x(core, &spline->knots[0]);
            const float to = curves_knot_x(core, &spline->knots[spline->knot_count - 1]);
            const struct rect line = {from, roundf(middle) - 0.5f, to - from, 1};
            drawlist_rect(&core->list, line, theme_fade(color, 0.35f));
        }
        knots_show(curves, core, s, middle);
        drawlist_set_clip(&core->list, clip);
        drawlist_text_fit(&core->list, axis->x + 4, roundf(middle + 4), axis->w - 13,
                          active ? FONT_LABEL_BOLD : FONT_LABEL, THEME_TEXT_SMALL,
                          theme_readable(color, theme()->panel, 4.5f), spline->name);
    }
    const struct rect track = {area->x - 7, area->y + SHEET_PAD, 3, area->h - 2 * SHEET_PAD};
    ui_list_bar(&sheet->list, &core->list, track, 0);
    drawlist_rect(&core->list, (struct rect){area->x, area->y + area->h - 1, area->w, 1}, theme()->border);
}
