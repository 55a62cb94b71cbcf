/// The curves panel: its beginning and end, what is under the pointer, presses and the wheel.
#include "editor/curves/curves.h"
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/knots.h"
#include "editor/core/picked.h"
#include "editor/core/pins.h"
#include "editor/core/playback.h"
#include "editor/core/selection.h"
#include "editor/curves/gestures.h"
#include "editor/curves/show.h"
#include "editor/curves/view.h"
#include "editor/curves/warnings.h"
#include <math.h>
#include <stdlib.h>

struct curves *curves_create(void)
{
    struct curves *curves = calloc(1, sizeof *curves);
    if (curves) curves->view = (struct view){0, 120, -1, 1};
    return curves;
}

void curves_destroy(struct curves *curves)
{
    if (!curves) return;
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

bool curves_reserve(struct curves *curves, const struct core *core)
{
    unsigned ids = core->selection.capacity;
    return curves->before_box.capacity >= ids || selection_reserve(&curves->before_box, ids);
}

bool curves_wants_frames(const struct curves *curves) { return follow_moves(curves); }

static const float CURVE_REACH = 7, OTHER_REACH = 7, WARNING_REACH = 9;
static const double ZOOM_STEP = 0.15; ///< of a wheel's notch, as a power of e

/// The nearest knot of one spline, where it is nearer than `reach`; returns its distance, else `reach`.
static float nearest_knot(const struct curves *curves, const struct core *core, const struct document *document,
                          int of, float x, float y, float reach, struct hover *hover)
{
    const struct spline *spline = &document->splines[of];
    float best = reach;
    for (int k = curves_knot_from(curves, core, document, spline, x - reach); k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        float at = curves_knot_x(curves, core, document, knot);
        if (at > x + reach) break;
        float distance = hypotf(x - at, y - curves_y_of(curves, core, of, knot->value));
        if (distance > best) continue;
        best = distance;
        *hover = (struct hover){.kind = HOVER_KNOT, .spline = of, .knot = knot->id, .place = k};
    }
    return best;
}

/// Knots of the other curves that are drawn: a press on one makes its spline the active one.
static void nearest_other_knot(const struct curves *curves, const struct core *core, const struct document *document,
                               float x, float y, struct hover *hover)
{
    float best = OTHER_REACH;
    for (int i = 0; i < curves->cache.other_count; i++) {
        const int spline = curves_other(curves, document, i);
        if (spline >= 0) best = nearest_knot(curves, core, document, spline, x, y, best, hover);
    }
}

static void nearest_handle(const struct curves *curves, const struct core *core, const struct document *document,
                           const struct spline *spline, float x, float y, struct hover *hover)
{
    float best = CURVES_HIT_RADIUS;
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        if (!knot->has_slope || !selection_has(&core->selection, knot->id)) continue;
        for (int end = 0; end < 2; end++) {
            float xy[2];
            curves_handle(curves, core, document, knot, end, xy);
            float distance = hypotf(x - xy[0], y - xy[1]);
            if (distance > best) continue;
            best = distance;
            *hover = (struct hover){.kind = HOVER_SLOPE, .spline = core->active, .knot = knot->id, .handle = end};
        }
    }
}

static void nearest_warning(const struct curves *curves, const struct core *core, float x, float y,
                            struct hover *hover)
{
    for (int i = 0; i < curves->warnings.count; i++) {
        float xy[2];
        if (!warning_place(curves, core, &curves->warnings.list[i], xy) ||
            hypotf(x - xy[0], y - xy[1]) > WARNING_REACH) {
            continue;
        }
        *hover = (struct hover){.kind = HOVER_WARNING, .handle = i};
    }
}

/// The nearest curve straight above or below, the active one first.
static void nearest_curve(const struct curves *curves, const struct core *core, const struct editor_world *world,
                          float x, float y, struct hover *hover)
{
    double position = core_position(world->document, curves_frame(curves, core, x));
    float best = CURVE_REACH;
    for (int i = 0; i < world->document->spline_count; i++) {
        int s = i == 0 ? core->active : i <= core->active ? i - 1 : i;
        if (!arrange_shows(core, world->document, s)) continue;
        wiggly_value v = evaluation_at(world->evaluation, s, position);
        float distance = fabsf(y - curves_y_of(curves, core, s, v.y + v.re));
        if (distance >= best) continue;
        best = distance;
        *hover = (struct hover){.kind = HOVER_CURVE, .spline = s};
    }
}

struct hover curves_hover(const struct curves *curves, const struct core *core, const struct editor_world *world,
                          float x, float y)
{
    struct hover hover = ruler_pins_hover(curves, core, world->document, x, y);
    const struct spline *spline = core_active_spline(core, world);
    if (hover.kind == HOVER_PIN) return hover;
    if (rect_contains(core->layout.ruler, x, y)) hover.kind = HOVER_RULER;
    if (rect_contains(ruler_corner(core), x, y)) hover.kind = HOVER_UNITS;
    if (rect_contains(sheet_switch(core), x, y)) hover.kind = HOVER_SHEET;
    if (rect_contains(sheet_area(core), x, y)) return sheet_hover(curves, core, world->document, x, y);
    if (!rect_contains(core->layout.plot, x, y) || !spline) return hover;
    bool seen = arrange_seen(core, world) != NULL;
    if (seen) nearest_knot(curves, core, world->document, core->active, x, y, CURVES_HIT_RADIUS, &hover);
    if (seen && hover.kind == HOVER_NONE) nearest_handle(curves, core, world->document, spline, x, y, &hover);
    if (hover.kind == HOVER_NONE) nearest_warning(curves, core, x, y, &hover);
    if (hover.kind == HOVER_NONE) nearest_other_knot(curves, core, world->document, x, y, &hover);
    if (hover.kind == HOVER_NONE) scale_box_hover(curves, core, world->document, x, y, &hover);
    if (hover.kind == HOVER_NONE && seen) limits_hover(curves, core, spline, y, &hover);
    if (hover.kind == HOVER_NONE) nearest_curve(curves, core, world, x, y, &hover);
    return hover;
}

/// A press on a knot: Shift adds or removes it, else it is dragged with all that are selected.
static void press_knot(struct curves *curves, struct core *core, const struct editor_world *world,
                       const struct hover *hover, const struct event *event)
{
    unsigned id = hover->knot;
    bool selected = selection_has(&core->selection, id);
    core_turn_to(core, world, hover->spline);
    if (event->clicks == 2) {
        const struct spline *spline = &world->document->splines[hover->spline];
        playback_seek(core, world->document, spline->knots[spline_find_id(spline, id)].frame);
        return;
    }
    if (event->mods & MOD_SHIFT) {
        selection_set(&core->selection, id, !selected);
        picked_settle(core, world);
        if (selected) return;
    } else if (!selected) {
        selection_clear(&core->selection);
        selection_set(&core->selection, id, true);
    }
    drag_begin_knots(curves, core, world, id, event);
    core->drag.lock_x = rect_contains(core->layout.sheet, event->x, event->y); // marks are dragged in time alone
    curves->knot_drag.collapse = selected && !(event->mods & MOD_SHIFT);
}

static void press_empty(struct curves *curves, struct core *core, const struct editor_world *world,
                        const struct hover *hover, const struct event *event)
{
    if (event->clicks == 2 && hover->kind == HOVER_CURVE) {
        core_insert_on_curve(core, world, curves_frame(curves, core, event->x), drag_snaps(core, event->mods),
                             event->mods & MOD_SHIFT);
        return;
    }
    if (event->clicks == 2) {
        double value = core_round(curves_value(curves, core, event->y), 0.01 / curves_pixels_per_value(curves, core));
        core_insert_knot(core, world, curves_frame(curves, core, event->x), value, drag_snaps(core, event->mods));
        return;
    }
    const bool keeps = event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT);
    if (hover->kind == HOVER_CURVE && !keeps) core_activate(core, world, hover->spline);
    box_begin(curves, core, event);
}

static void scrub(void *room, struct core *core, const struct editor_world *world)
{
    const double frame = curves_frame(room, core, core->drag.x);
    playback_seek(core, world->document, core->drag.snap ? round(frame) : frame);
}

static void pan(void *room, struct core *core, const struct editor_world *world)
{
    (void)world;
    curves_pan(room, core, core->drag.moved_x, core->drag.moved_y);
}

static void press_ruler(struct curves *curves, struct core *core, const struct editor_world *world,
                        const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_HORIZONTAL, .move = scrub};
    if (event->mods & MOD_SHIFT) {
        range_begin(curves, core, event);
        return;
    }
    double frame = curves_frame(curves, core, event->x);
    drag_begin(core, &owner, curves, NULL, event);
    playback_seek(core, world->document, drag_snaps(core, event->mods) ? round(frame) : frame);
}

void curves_press(struct curves *curves, struct core *core, const struct editor_world *world,
                  const struct event *event)
{
    static const struct drag_owner panning = {.cursor = CURSOR_MOVE, .move = pan};
    const bool pans = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && core->space_down);
    if (pans) {
        core->space_used = core->space_down;
        drag_begin(core, &panning, curves, NULL, event);
        return;
    }
    if (event->button != BUTTON_LEFT) return;
    struct hover hover = curves_hover(curves, core, world, event->x, event->y);
    if (hover.kind != HOVER_PIN && hover.kind != HOVER_RULER) pins_clear(core);
    switch (hover.kind) {
    case HOVER_PIN:
        ruler_pins_begin(curves, core, world, &hover, event);
        break;
    case HOVER_RULER:
        press_ruler(curves, core, world, event);
        break;
    case HOVER_WARNING:
        warning_remedy(curves, core, world, &curves->warnings.list[hover.handle]);
        break;
    case HOVER_UNITS:
        curves_toggle_units(curves, core);
        break;
    case HOVER_SHEET:
        curves_toggle_sheet(curves, core);
        break;
    case HOVER_ROW:
        sheet_press_row(curves, core, world, hover.spline, event);
        break;
    case HOVER_KNOT:
        press_knot(curves, core, world, &hover, event);
        break;
    case HOVER_BOX:
        scale_begin_handle(curves, core, world, hover.handle, event);
        break;
    case HOVER_LIMIT:
        limits_begin_drag(curves, core, world, hover.handle, event);
        break;
    case HOVER_SLOPE:
        drag_begin_slope(curves, core, world, hover.knot, hover.handle, event);
        break;
    default:
        if (rect_contains(core->layout.plot, event->x, event->y)) press_empty(curves, core, world, &hover, event);
    }
}

void curves_wheel(struct curves *curves, struct core *core, const struct event *event)
{
    if (sheet_wheel(curves, core, event)) return;
    double notches = event->dy != 0 ? event->dy : event->dx; /* some systems turn Shift+wheel sideways */
    double factor = exp(-ZOOM_STEP * fmin(fmax(notches, -20), 20));
    double time = event->mods & MOD_SHIFT && !(event->mods & MOD_CTRL) ? 1 : factor;
    double value = event->mods & MOD_CTRL && !(event->mods & MOD_SHIFT) ? 1 : factor;
    if (rect_contains(sheet_area(core), event->x, event->y)) value = 1; // which has only time
    curves_zoom(curves, core, event->x, event->y, time, value);
}
