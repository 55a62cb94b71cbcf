/// The mouse in the curves panel: what is under it, presses and the wheel.
#include "editor/core/actions.h"
#include "editor/core/arrange.h"
#include "editor/curves/curves.h"
#include "editor/curves/warnings.h"
#include <math.h>

static const float CURVE_REACH = 7, OTHER_REACH = 7, WARNING_REACH = 9;
static const double ZOOM_STEP = 0.15; ///< of a wheel's notch, as a power of e

/// The nearest knot of one spline, where it is nearer than `reach`; returns its distance, else `reach`.
static float nearest_knot(const struct editor *editor, const struct document *document, int of, float x, float y,
                          float reach, struct hover *hover)
{
    const struct spline *spline = &document->splines[of];
    float best = reach;
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        float at = curves_x(editor, document_frame(document, document_sample(document, knot->frame)));
        float distance = hypotf(x - at, y - curves_y_of(editor, of, knot->value));
        if (distance > best) continue;
        best = distance;
        *hover = (struct hover){.kind = HOVER_KNOT, .spline = of, .knot = knot->id};
    }
    return best;
}

/// Knots of the other curves that are drawn: a press on one makes its spline the active one.
static void nearest_other_knot(const struct editor *editor, const struct document *document, float x, float y,
                               struct hover *hover)
{
    float best = OTHER_REACH;
    for (int i = 0; i < editor->cache.other_count; i++) {
        int spline = editor->cache.other_spline[i];
        if (spline < document->spline_count) best = nearest_knot(editor, document, spline, x, y, best, hover);
    }
}

static void nearest_handle(const struct editor *editor, const struct document *document, const struct spline *spline,
                           float x, float y, struct hover *hover)
{
    float best = CURVES_HIT_RADIUS;
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        if (!knot->has_slope || !selection_has(&editor->selection, knot->id)) continue;
        for (int end = 0; end < 2; end++) {
            float xy[2];
            curves_handle(editor, document, knot, end, xy);
            float distance = hypotf(x - xy[0], y - xy[1]);
            if (distance > best) continue;
            best = distance;
            *hover = (struct hover){.kind = HOVER_SLOPE, .spline = editor->active, .knot = knot->id, .handle = end};
        }
    }
}

static void nearest_warning(const struct editor *editor, float x, float y, struct hover *hover)
{
    for (int i = 0; i < editor->warnings.count; i++) {
        float xy[2];
        if (!warning_place(editor, &editor->warnings.list[i], xy) || hypotf(x - xy[0], y - xy[1]) > WARNING_REACH) {
            continue;
        }
        *hover = (struct hover){.kind = HOVER_WARNING, .handle = i};
    }
}

/// The nearest curve straight above or below, the active one first.
static void nearest_curve(const struct editor *editor, const struct editor_world *world, float x, float y,
                          struct hover *hover)
{
    double position = curves_position(world->document, curves_frame(editor, x));
    float best = CURVE_REACH;
    for (int i = 0; i < world->document->spline_count; i++) {
        int s = i == 0 ? editor->active : i <= editor->active ? i - 1 : i;
        if (!arrange_shows(editor, world->document, s)) continue;
        wiggly_value v = curves_solved(world, s, position);
        float distance = fabsf(y - curves_y_of(editor, s, v.y + v.re));
        if (distance >= best) continue;
        best = distance;
        *hover = (struct hover){.kind = HOVER_CURVE, .spline = s};
    }
}

struct hover curves_hover(const struct editor *editor, const struct editor_world *world, float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    const struct spline *spline = editor_active_spline(editor, world);
    if (rect_contains(editor->layout.ruler, x, y)) hover.kind = HOVER_RULER;
    if (rect_contains(ruler_corner(editor), x, y)) hover.kind = HOVER_UNITS;
    if (!rect_contains(editor->layout.plot, x, y) || !spline) return hover;
    bool seen = arrange_seen(editor, world) != NULL;
    if (seen) nearest_knot(editor, world->document, editor->active, x, y, CURVES_HIT_RADIUS, &hover);
    if (seen && hover.kind == HOVER_NONE) nearest_handle(editor, world->document, spline, x, y, &hover);
    if (hover.kind == HOVER_NONE) nearest_warning(editor, x, y, &hover);
    if (hover.kind == HOVER_NONE) nearest_other_knot(editor, world->document, x, y, &hover);
    if (hover.kind == HOVER_NONE) nearest_curve(editor, world, x, y, &hover);
    return hover;
}

/// A press on a knot: Shift adds or removes it, else it is dragged with all that are selected.
static void press_knot(struct editor *editor, const struct editor_world *world, const struct hover *hover,
                       const struct event *event)
{
    unsigned id = hover->knot;
    editor_activate(editor, world, hover->spline);
    bool selected = selection_has(&editor->selection, id);
    if (event->mods & MOD_SHIFT) {
        selection_set(&editor->selection, id, !selected);
        if (selected) return;
    } else if (!selected) {
        selection_clear(&editor->selection);
        selection_set(&editor->selection, id, true);
    }
    drag_begin_knots(editor, world, id, event);
    editor->drag.collapse = selected && !(event->mods & MOD_SHIFT);
}

static void press_empty(struct editor *editor, const struct editor_world *world, const struct hover *hover,
                        const struct event *event)
{
    if (event->clicks == 2 && hover->kind == HOVER_CURVE) {
        insert_on_curve(editor, world, curves_frame(editor, event->x), drag_snaps(editor, event->mods),
                        event->mods & MOD_SHIFT);
        return;
    }
    if (event->clicks == 2) {
        double value = round_value(curves_value(editor, event->y), 0.01 / curves_pixels_per_value(editor));
        insert_knot(editor, world, curves_frame(editor, event->x), value, drag_snaps(editor, event->mods));
        return;
    }
    if (hover->kind == HOVER_CURVE) editor_activate(editor, world, hover->spline);
    box_begin(editor, event);
}

static void press_ruler(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    if (event->mods & MOD_SHIFT) {
        range_begin(editor, event);
        return;
    }
    double frame = curves_frame(editor, event->x);
    drag_begin(editor, DRAG_SCRUB, event);
    playback_seek(editor, world->document, drag_snaps(editor, event->mods) ? round(frame) : frame);
}

void curves_press(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    bool pan = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && editor->space_down);
    if (pan) {
        editor->space_used = editor->space_down;
        drag_begin(editor, DRAG_PAN, event);
        return;
    }
    if (event->button != BUTTON_LEFT) return;
    struct hover hover = curves_hover(editor, world, event->x, event->y);
    switch (hover.kind) {
    case HOVER_RULER:
        press_ruler(editor, world, event);
        break;
    case HOVER_WARNING:
        warning_remedy(editor, world, &editor->warnings.list[hover.handle]);
        break;
    case HOVER_UNITS:
        ruler_toggle(editor);
        break;
    case HOVER_KNOT:
        press_knot(editor, world, &hover, event);
        break;
    case HOVER_SLOPE:
        drag_begin_slope(editor, world, hover.knot, hover.handle, event);
        break;
    default:
        if (rect_contains(editor->layout.plot, event->x, event->y)) press_empty(editor, world, &hover, event);
    }
}

void curves_wheel(struct editor *editor, const struct event *event)
{
    double notches = event->dy != 0 ? event->dy : event->dx; /* some systems turn Shift+wheel sideways */
    double factor = exp(-ZOOM_STEP * fmin(fmax(notches, -20), 20));
    double time = event->mods & MOD_SHIFT && !(event->mods & MOD_CTRL) ? 1 : factor;
    double value = event->mods & MOD_CTRL && !(event->mods & MOD_SHIFT) ? 1 : factor;
    view_zoom(editor, event->x, event->y, time, value);
}
