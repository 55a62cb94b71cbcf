/// Drags of knots and of their slopes: edits made anew from the originals at every step. With ripple the later knots move along.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/playback.h"
#include "editor/core/selection.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/show.h"
#include "editor/curves/view.h"
#include <assert.h>
#include <math.h>

static const double SLOPE_RESOLUTION = 1e-3; ///< of the visible values, a second
static const double LENGTH_SLACK = 8; ///< pixels by which a handle may be pulled before it says more than a slope

/// Whether a knot, as it was before the drag, moves with it.
static bool moves_along(const struct curves *curves, const struct core *core, const struct knot *knot)
{
    const struct knot_drag *drag = &curves->knot_drag;
    return selection_has(&core->selection, knot->id) || (drag->ripple && knot->frame >= drag->ripple_from);
}

/// Copies all knots that move: the edits of the drag start from them.
static void collect(struct curves *curves, struct core *core, const struct spline *spline)
{
    struct originals *originals = &core->originals;
    originals->count = 0;
    for (int k = 0; k < spline->knot_count && originals->count < originals->capacity; k++) {
        if (moves_along(curves, core, &spline->knots[k])) originals->knot[originals->count++] = spline->knots[k];
    }
    core->drag.label = originals->count == 1 ? "Move knot" : "Move knots";
}

/// R: the later knots keep their distances to the dragged ones.
static void toggle_ripple(struct curves *curves, struct core *core, const struct editor_world *world)
{
    struct knot_drag *drag = &curves->knot_drag;
    const struct spline *spline = core_active_spline(core, world);
    assert(spline && core->originals.count > 0);
    if (core->drag.moved) history_restart(world->history, world->document);
    drag->ripple = !drag->ripple;
    drag->ripple_from = core->originals.knot[0].frame;
    drag->free_frames = 0;
    core->drag.stale = true;
    collect(curves, core, spline);
    core_message(core, false,
                 drag->ripple ? "Ripple on: later knots move too (R turns it off)."
                              : "Ripple off: later knots stay.");
}

/// The furthest shift to the left, in frames: to the first frame, or with ripple to just after the knot that stays.
static double least_frames(const struct curves *curves, const struct core *core, const struct document *document,
                           const struct spline *spline)
{
    const struct knot *first = &core->originals.knot[0];
    int sample = document_sample(document, first->frame);
    int before = spline_lower_bound(document, spline, sample) - 1;
    if (!curves->knot_drag.ripple || before < 0) return document->first_frame - first->frame;
    int least = document_sample(document, spline->knots[before].frame) + 1;
    return document_frame(document, least) - document_frame(document, sample);
}

void drag_begin_knots(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      const struct event *event)
{
    const struct spline *spline = core_active_spline(core, world);
    assert(spline);
    drag_begin(core, DRAG_KNOTS, NULL, event);
    curves->knot_drag = (struct knot_drag){.knot = knot};
    collect(curves, core, spline);
}

void drag_begin_slope(struct curves *curves, struct core *core, const struct editor_world *world, unsigned knot,
                      int handle, const struct event *event)
{
    const struct spline *spline = core_active_spline(core, world);
    assert(spline && core->originals.capacity > 0);
    drag_begin(core, DRAG_SLOPE, "Change slope", event);
    curves->knot_drag = (struct knot_drag){.knot = knot, .handle = handle};
    core->originals.knot[0] = spline->knots[spline_find_id(spline, knot)];
    core->originals.count = 1;
}

/// The shift in frames that the pointer asks for: whole frames for the knot that is held, inside the range for all.
static double wanted_frames(const struct curves *curves, struct core *core, const struct document *document,
                            const struct spline *spline)
{
    const struct drag *drag = &core->drag;
    const struct originals *originals = &core->originals;
    if (drag->lock_y) return 0;
    double frames = drag->moved_x / curves_pixels_per_frame(curves, core);
    const struct knot *first = &originals->knot[0], *last = &originals->knot[originals->count - 1], *held = first;
    for (int k = 0; k < originals->count; k++) {
        if (originals->knot[k].id == curves->knot_drag.knot) held = &originals->knot[k];
    }
    if (drag->snap) frames = fabs(frames) < 0.5 ? 0 : round(held->frame + frames) - held->frame;
    double end = document_frame(document, document_last_knot_sample(document, spline));
    double most = end - last->frame, least = least_frames(curves, core, document, spline);
    if (curves->knot_drag.ripple && frames > most) {
        core_message(core, false, "The last knot has reached the end of the range. Extend the range to make room.");
    }
    return fmax(fmin(frames, most), least);
}

/// Whether no knot that stays is on a sample to which one would move.
static bool is_free(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct spline *spline, double frames)
{
    for (int k = 0; k < core->originals.count; k++) {
        int at =
            spline_find_knot(document, spline, document_sample(document, core->originals.knot[k].frame + frames));
        if (at >= 0 && !moves_along(curves, core, &spline->knots[at])) return false;
    }
    return true;
}

/// Moves all originals; from the far end on, so that they do not run into each other.
static bool move_knots(const struct curves *curves, const struct core *core, const struct editor_world *world,
                       double frames, double value)
{
    const struct spline *spline = core_active_spline(core, world);
    double resolution = 0.01 / curves_pixels_per_value(curves, core);
    for (int i = 0; i < core->originals.count; i++) {
        const struct knot *original = &core->originals.knot[frames > 0 ? core->originals.count - 1 - i : i];
        struct edit edit = core_edit_of(EDIT_KNOT_SET, core->active);
        edit.knot = *original;
        edit.knot.frame += frames;
        if (value != 0 && selection_has(&core->selection, original->id)) {
            const double moved = core_round(original->value + value, resolution);
            edit.knot.value =
                fmin(fmax(moved, spline->parameter[PARAMETER_LOW].value), spline->parameter[PARAMETER_HIGH].value);
        }
        if (!history_apply(world->history, world->document, &edit, NULL)) return false;
    }
    return true;
}

static void apply_knots(struct curves *curves, struct core *core, const struct editor_world *world)
{
    struct drag *drag = &core->drag;
    const struct spline *spline = core_active_spline(core, world);
    history_restart(world->history, world->document);
    if (!spline || core->originals.count == 0) return;
    double frames = wanted_frames(curves, core, world->document, spline);
    double value = drag->lock_x ? 0 : -drag->moved_y / curves_pixels_per_value(curves, core);
    if (!is_free(curves, core, world->document, spline, frames)) frames = curves->knot_drag.free_frames;
    if (!move_knots(curves, core, world, frames, value)) {
        history_restart(world->history, world->document);
        frames = curves->knot_drag.free_frames;
        move_knots(curves, core, world, frames, value);
    }
    curves->knot_drag.free_frames = frames;
}

/// The slope that lets the held end of the handle point at the pointer; pulled out or pushed in, also the stiffness.
static void apply_slope(const struct curves *curves, struct core *core, const struct editor_world *world)
{
    const struct drag *drag = &core->drag;
    const struct knot *knot = &core->originals.knot[0];
    float end[2];
    curves_handle(curves, core, world->document, knot, curves->knot_drag.handle, end);
    double x = curves_knot_x(curves, core, world->document, knot);
    double across = end[0] + drag->moved_x - x;
    double down = end[1] + drag->moved_y - curves_y(curves, core, knot->value);
    across = curves->knot_drag.handle ? fmax(across, 2) : fmin(across, -2);
    double seconds = across / curves_pixels_per_frame(curves, core) / world->document->fps;
    struct edit edit = core_edit_of(EDIT_KNOT_SET, core->active);
    edit.knot = *knot;
    edit.knot.slope =
        core_round(-down / curves_pixels_per_value(curves, core) / seconds, SLOPE_RESOLUTION * core->visible);
    double length = handle_length(knot->stiffness), longer = hypot(across, down) - length;
    if (fabs(longer) > LENGTH_SLACK) {
        edit.knot.stiffness = handle_stiffness(length + longer - copysign(LENGTH_SLACK, longer));
    }
    history_restart(world->history, world->document);
    core_edit(core, world, &edit);
}

/// The click on a knot that was selected already selects it alone.
static void end_click(const struct curves *curves, struct core *core)
{
    if (!curves->knot_drag.collapse) return;
    selection_clear(&core->selection);
    selection_set(&core->selection, curves->knot_drag.knot, true);
}

void curves_drag_apply(struct curves *curves, struct core *core, const struct editor_world *world)
{
    struct drag *drag = &core->drag;
    if (!drag->stale || !drag->moved) return;
    drag->stale = false;
    if (drag->kind == DRAG_KNOTS) apply_knots(curves, core, world);
    if (drag->kind == DRAG_SLOPE) apply_slope(curves, core, world);
    if (drag->kind == DRAG_SCALE) scale_apply(curves, core, world);
    if (drag->kind == DRAG_LIMIT) limits_apply(curves, core, world);
    if (drag->kind == DRAG_PIN_TIME) ruler_pins_apply(curves, core, world);
}

void curves_drag_move(struct curves *curves, struct core *core, const struct editor_world *world,
                      const struct event *event)
{
    const struct drag *drag = &core->drag;
    double frame = curves_frame(curves, core, event->x);
    if (drag->kind == DRAG_PAN) curves_pan(curves, core, drag->moved_x, drag->moved_y);
    if (drag->kind == DRAG_SCRUB) playback_seek(core, world->document, drag->snap ? round(frame) : frame);
    if (drag->kind == DRAG_RANGE) range_drag(curves, core, world->document, event->x);
    if (drag->kind == DRAG_BOX) box_update(curves, core, world);
}

enum drag_answer curves_drag_event(struct curves *curves, struct core *core, const struct editor_world *world,
                                   const struct event *event)
{
    struct drag *drag = &core->drag;
    if (drag->kind == DRAG_SCALE) return scale_event(curves, core, world, event);
    bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & (MOD_CTRL | MOD_ALT));
    if (drag->kind != DRAG_KNOTS || !key) return DRAG_PASSES;
    if (event->key == 'R') toggle_ripple(curves, core, world);
    return event->key == 'R' || drag_lock(drag, event->key) ? DRAG_USED : DRAG_PASSES;
}

void curves_drag_end(struct curves *curves, struct core *core, const struct editor_world *world, bool keep)
{
    const struct drag *drag = &core->drag;
    if (keep) curves_drag_apply(curves, core, world);
    if (drag->kind == DRAG_KNOTS && !drag->moved && keep) end_click(curves, core);
    if (drag->kind == DRAG_RANGE) range_end(core, keep);
    if (drag->kind == DRAG_BOX) box_end(curves, core, keep);
}
