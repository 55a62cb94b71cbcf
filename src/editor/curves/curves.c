/// The curves panel: its life, hover, presses, box selection, and the active spline's limits.
#include "base/need.h"
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "ui/theme.h"
#include <math.h>
#include <stdlib.h>

struct curves *curves_create(void)
{
    struct curves *curves = need_zeroed(1, sizeof *curves);
    curves->view = (struct view){0, 120, -1, 1};
    return curves;
}

void curves_destroy(struct curves *curves)
{
    free(curves->before_box.bits);
    free(curves);
}

void curves_open(struct curves *curves)
{
    curves->cache.key = 0;
    curves->cache.range_count = 0;
    curves->following = (struct following){0};
    curves->warnings = (struct warnings){0};
}

bool curves_wants_frames(const struct curves *curves) { return curves->following.moves; }

static const float CURVE_REACH = 7, OTHER_REACH = 7, WARNING_REACH = 9, LIMIT_REACH = 5; ///< pixels
static const double ZOOM_STEP = 0.15; ///< exponent of e per notch of the wheel

float nearest_knot(const struct curves *curves, const struct core *core, int of, float row, float x, float y,
                   float reach, struct hover *hover)
{
    static const char still[] =
        "Comes to rest at the equilibrium; Shift+P gives it a value. Drag it in time (Ctrl: off frames)";
    const struct spline *spline = core->document->splines[of];
    float best = reach;
    for (int k = curves_knot_from(curves, core, spline, x - reach); k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        float at = curves_knot_x(curves, core, knot);
        if (at > x + reach) break;
        if (is_nearest(maths_hypotf(x - at, isnan(row) ? y - curves_knot_y(curves, core, of, knot) : 0), &best))
            *hover = (struct hover){
                .thing = &thing_knot, .hint = knot->still ? still : NULL, .spline = of, .knot = knot->id};
    }
    return best;
}

/// A press that did not move deselects; `keep` false restores the former selection.
static void end(void *room, struct core *core, bool keep)
{
    const struct curves *curves = room;
    if (!keep) selection_copy(&core->selection, &curves->before_box);
    if (keep && !core->drag.moved && curves->knot_drag.box == BOX_REPLACE) selection_clear(&core->selection);
    if (keep) selected_settle(core);
}

static enum parameter limit_of(int handle) { return handle ? PARAMETER_HIGH : PARAMETER_LOW; }

struct hover curves_hover(const struct curves *curves, const struct core *core, float x, float y)
{
    struct hover hover = ruler_pins_hover(curves, core, x, y);
    const struct spline *spline = core_active_spline(core);
    if (hover.thing) return hover;
    if (rect_contains(core->layout.ruler, x, y)) hover.thing = &thing_ruler;
    if (rect_contains(ruler_corner(core), x, y)) hover.thing = &thing_units;
    if (rect_contains(sheet_switch(core), x, y)) hover.thing = &thing_sheet;
    if (rect_contains(sheet_area(core), x, y)) return sheet_hover(curves, core, x, y);
    if (!rect_contains(core->layout.plot, x, y) || !spline) return hover;
    const bool seen = spline_list_seen(core) != NULL;
    float best = core_reach(core, CURVES_HIT_RADIUS), xy[2];
    if (seen) nearest_knot(curves, core, core->active, NAN, x, y, best, &hover);
    if (hover.thing) return hover;
    for (int k = 0; k < spline->knot_count && seen; k++) {
        const struct knot *knot = &spline->knots[k];
        if (!knot->has_slope || !selection_has(&core->selection, knot->id)) continue;
        for (int end = 0; end < 2; end++) {
            curves_handle(curves, core, knot, end, xy);
            if (is_nearest(maths_hypotf(x - xy[0], y - xy[1]), &best))
                hover =
                    (struct hover){.thing = &thing_slope, .spline = core->active, .knot = knot->id, .handle = end};
        }
    }
    if (hover.thing) return hover;
    for (int i = 0; i < curves->warnings.count; i++) {
        if (warning_place(curves, core, &curves->warnings.list[i], xy) &&
            maths_hypotf(x - xy[0], y - xy[1]) <= WARNING_REACH)
            hover = (struct hover){.thing = &thing_warning, .handle = i};
    }
    if (hover.thing) return hover;
    best = OTHER_REACH;
    for (int i = 0; i < curves->cache.other_count; i++) {
        const int other = curves_other(curves, core->document, i);
        if (other >= 0) best = nearest_knot(curves, core, other, NAN, x, y, best, &hover);
    }
    if (!hover.thing) scale_box_hover(curves, core, x, y, &hover);
    if (hover.thing) return hover;
    best = LIMIT_REACH;
    for (int i = 0; i < 2 && seen; i++) {
        const double value = spline->parameter[limit_of(i)].value;
        if (is_nearest(isfinite(value) ? fabsf(y - curves_y(curves, core, value)) : INFINITY, &best))
            hover = (struct hover){.thing = &thing_limit, .spline = core->active, .handle = i};
    }
    if (hover.thing) return hover;
    // The nearest curve directly above or below, the active one first.
    const double position = core_position(core->document, curves_frame(curves, core, x));
    best = CURVE_REACH;
    for (int i = 0; i < core->document->spline_count; i++) {
        const int s = i == 0 ? core->active : i <= core->active ? i - 1 : i;
        if (!spline_list_shows(core, s)) continue;
        const wiggly_value v = evaluation_at(core->evaluation, s, position);
        const float distance = fabsf(y - curves_y_of(curves, core, s, v.y + v.re));
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){.thing = s == core->active ? &thing_active_curve : &thing_curve, .spline = s};
    }
    return hover;
}

/// On a curve or beside all: a click chooses, a double-click inserts a knot, a drag starts a box.
static void press_plot(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    const bool keeps = event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT);
    if (event->clicks == 2 && hover->thing) {
        core_activate(core, hover->spline);
        core_insert_on_curve(core, curves_frame(curves, core, event->x), drag_snaps(core, event->mods),
                             event->mods & MOD_SHIFT);
    } else if (event->clicks == 2) {
        double value = core_round(curves_value(curves, core, event->y), 0.01 / curves_pixels_per_value(curves, core));
        core_insert_knot(core, curves_frame(curves, core, event->x), value, drag_snaps(core, event->mods));
    } else {
        if (hover->thing && !keeps) core_choose(core, hover->spline);
        box_begin(curves, core, event);
    }
}

static bool find_curve(void *room, const struct core *core, const struct target *target, float xy[2])
{
    return curves_in_plot(room, core, target->number[0], target->number[1], xy);
}

/// curve(sway,36,1): a frame and a value.
const struct thing thing_curve = {.cursor = CURSOR_HAND,
                                  .hint = "Click to edit this spline",
                                  .press = press_plot,
                                  .name = "curve",
                                  .of = OF_SPLINE,
                                  .numbers = 2,
                                  .find = find_curve,
                                  .missing = "that is not in the visible part of the curves"};

const struct thing thing_active_curve = {
    .hint = "Double-click to insert a knot on the curve, with Shift a pose; drag to select with a box",
    .press = press_plot};

/// The corner of the ruler.
static void press_switch(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    (void)room, (void)event;
    core_flip(core, hover->thing == &thing_units ? SWITCH_SECONDS : SWITCH_SHEET);
}

const struct thing thing_units = {.cursor = CURSOR_HAND,
                                  .hint = "Click to switch between frames and seconds (U)",
                                  .is_control = true,
                                  .place = ON_TIME,
                                  .press = press_switch};

const struct thing thing_sheet = {.cursor = CURSOR_HAND,
                                  .hint = "Click to open or close the dope sheet (F7)",
                                  .is_control = true,
                                  .place = ON_TIME,
                                  .press = press_switch};

static void pan(void *room, struct core *core) { curves_pan(room, core, core->drag.moved_x, core->drag.moved_y); }

static void apply(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct limit_drag *drag = &curves->limit_drag;
    const struct spline *spline = core_active_spline(core);
    double by = -core->drag.moved_y / curves_pixels_per_value(curves, core);
    double value = core_round(drag->value + by, 0.01 / curves_pixels_per_value(curves, core));
    const double other = spline->parameter[limit_of(!drag->handle)].value;
    for (int k = 0; k < spline->knot_count; k++) {
        const double knot = spline->knots[k].value;
        if (spline->knots[k].still) continue;
        value = drag->handle ? fmax(value, knot) : fmin(value, knot);
    }
    if (drag->handle ? value <= other : value >= other) return; // the two limits must not cross, knots or not
    core_set_parameter(core, core->active, limit_of(drag->handle), value);
}

static void press_limit(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_VERTICAL, .apply = apply};
    struct curves *curves = room;
    const enum parameter limit = limit_of(hover->handle);
    drag_begin(core, &owner, curves, parameter_rows[limit].undo, event);
    core->hover = *hover;
    curves->limit_drag = (struct limit_drag){hover->handle, core_active_spline(core)->parameter[limit].value};
}

const struct thing thing_limit = {
    .cursor = CURSOR_VERTICAL, .hint = "Drag the limit; the curve stays on this side of it", .press = press_limit};

const struct thing *const curves_things[] = {&thing_knot,    &thing_mark,  &thing_slope,    &thing_curve, &thing_box,
                                             &thing_warning, &thing_ruler, &thing_pin_time, NULL};

void curves_press(struct curves *curves, struct core *core, const struct event *event)
{
    static const struct drag_owner panning = {.cursor = CURSOR_MOVE, .move = pan};
    const bool pans = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && core->space_down);
    if (pans) {
        core->space_used = core->space_down;
        drag_begin(core, &panning, curves, NULL, event);
        return;
    }
    if (event->button != BUTTON_LEFT) return;
    const struct hover hover = curves_hover(curves, core, event->x, event->y);
    if (hover.thing != &thing_pin_time && hover.thing != &thing_ruler) pins_clear(core);
    if (hover.thing) {
        hover.thing->press(curves, core, &hover, event);
    } else if (rect_contains(core->layout.plot, event->x, event->y)) {
        press_plot(curves, core, &hover, event);
    }
}

void curves_wheel(struct curves *curves, struct core *core, const struct event *event)
{
    if (sheet_wheel(curves, core, event)) return;
    double notches = event->dy != 0 ? event->dy : event->dx; /* some systems turn Shift+wheel sideways */
    double factor = maths_exp(-ZOOM_STEP * fmin(fmax(notches, -20), 20));
    double time = event->mods & MOD_SHIFT && !(event->mods & MOD_CTRL) ? 1 : factor;
    double value = event->mods & MOD_CTRL && !(event->mods & MOD_SHIFT) ? 1 : factor;
    if (rect_contains(sheet_area(core), event->x, event->y)) value = 1; // the dope sheet zooms time only
    curves_zoom(curves, core, event->x, event->y, time, value);
}

static struct rect box_rect(const struct drag *drag)
{
    return (struct rect){fminf(drag->start_x, drag->x), fminf(drag->start_y, drag->y), fabsf(drag->x - drag->start_x),
                         fabsf(drag->y - drag->start_y)};
}

/// Selects or deselects one spline's knots in the box: in the plot (`row` NAN), or on its row of the dope sheet.
static void take_inside(const struct curves *curves, struct core *core, int s, float row)
{
    const struct rect box = box_rect(&core->drag);
    const struct spline *spline = core->document->splines[s];
    for (int k = curves_knot_from(curves, core, spline, box.x); k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        const float x = curves_knot_x(curves, core, knot), y = curves_knot_y(curves, core, s, knot);
        if (x >= box.x + box.w) break;
        if (x >= box.x && (!isnan(row) || rect_contains(box, x, y)))
            selection_set(&core->selection, knot->id, curves->knot_drag.box != BOX_REMOVE);
    }
}

static void move(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct document *document = core->document;
    selection_copy(&core->selection, &curves->before_box);
    if (curves->knot_drag.box == BOX_REPLACE) selection_clear(&core->selection);
    for (int s = 0; curves->knot_drag.in_sheet && s < document->spline_count; s++) {
        const float row = sheet_row_in(curves, core, s, box_rect(&core->drag));
        if (!isnan(row)) take_inside(curves, core, s, row);
    }
    if (curves->knot_drag.in_sheet) return;
    if (spline_list_seen(core)) take_inside(curves, core, core->active, NAN);
    for (int i = 0; i < curves->cache.other_count; i++) {
        const int other = curves_other(curves, document, i);
        if (other >= 0) take_inside(curves, core, other, NAN);
    }
}

static void show(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct rect r = box_rect(&core->drag);
    if (!core->drag.moved) return;
    const float outline[] = {r.x, r.y, r.x + r.w, r.y, r.x + r.w, r.y + r.h, r.x, r.y + r.h, r.x, r.y};
    uint32_t color = curves->knot_drag.box == BOX_REMOVE ? theme()->error : theme()->playhead;
    struct rect clip = drawlist_push_clip(&core->list, core->layout.curves);
    drawlist_set_clip(&core->list, curves->knot_drag.in_sheet ? core->layout.sheet : core->layout.plot);
    drawlist_rect(&core->list, r, theme_fade(color, 0.08f));
    drawlist_dashed(&core->list, outline, 5, 1, 4, 3, theme_fade(color, 0.7f));
    drawlist_set_clip(&core->list, clip);
}

void box_begin(struct curves *curves, struct core *core, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_ARROW, .move = move, .end = end, .show = show};
    drag_begin(core, &owner, curves, NULL, event);
    curves->knot_drag = (struct knot_drag){0};
    bool removes = event->mods & (MOD_CTRL | MOD_ALT);
    curves->knot_drag.box = removes ? BOX_REMOVE : event->mods & MOD_SHIFT ? BOX_ADD : BOX_REPLACE;
    selection_copy(&curves->before_box, &core->selection);
}

void limits_show(const struct curves *curves, struct core *core)
{
    const struct spline *spline = spline_list_seen(core);
    const struct rect *plot = &core->layout.plot;
    if (!spline) return;
    for (int i = 0; i < 2; i++) {
        double value = spline->parameter[limit_of(i)].value;
        if (!isfinite(value)) continue;
        const bool hot = core->hover.thing == &thing_limit && core->hover.handle == i;
        float y = curves_y(curves, core, value);
        const float line[2][2] = {{plot->x, y}, {plot->x + plot->w, y}};
        drawlist_dashed(&core->list, &line[0][0], 2, hot ? 2 : 1.25f, 10, 6,
                        theme_fade(spline_list_color(core->document, core->active), hot ? 1 : 0.6f));
    }
}
