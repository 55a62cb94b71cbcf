/// Drags of knots and slopes. Each step starts again from the original knots. Ripple moves the later knots too.
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>

static const double SLOPE_RESOLUTION = 1e-3; ///< of the visible values, a second
static const double LENGTH_SLACK = 8;        ///< pixels; a longer pull also changes the stiffness

static void collect(const struct curves *curves, struct core *core)
{
    core_collect(core, curves->knot_drag.ripple);
    core->drag.label = core->originals.count == 1 ? "Move knot" : "Move knots";
}

/// R: the later knots keep their distances to the dragged ones.
static void toggle_ripple(struct curves *curves, struct core *core)
{
    struct knot_drag *drag = &curves->knot_drag;
    drag_restart(core);
    drag->ripple = !drag->ripple;
    drag->free_frames = 0;
    core->drag.stale = true;
    collect(curves, core);
    core_message(core, false,
                 drag->ripple ? "Ripple on: later knots move too (R turns it off)."
                              : "Ripple off: later knots stay.");
}

/// How far left a spline's first original may go, in frames: to the first frame or, with ripple, just after the unmoved knot before it.
static double least_frames(const struct curves *curves, const struct document *document, const struct original *first)
{
    const struct spline *spline = document->splines[first->spline];
    int sample = document_sample(document, first->knot.frame);
    int before = spline_lower_bound(document, spline, sample) - 1;
    if (!curves->knot_drag.ripple || before < 0) return document->first_frame - first->knot.frame;
    int least = document_sample(document, spline->knots[before].frame) + 1;
    return document_frame(document, least) - document_frame(document, sample);
}

/// The range of shifts, in frames, that keeps all originals inside the scene's range.
static void shift_limits(const struct curves *curves, const struct originals *originals,
                         const struct document *document, double *least, double *most)
{
    *least = -INFINITY;
    *most = INFINITY;
    for (int i = 0; i < originals->count; i++) {
        const struct original *original = &originals->list[i];
        const struct spline *spline = document->splines[original->spline];
        const bool is_first = i == 0 || originals->list[i - 1].spline != original->spline;
        const double end = document_frame(document, document_last_knot_sample(document, spline));
        if (is_first) *least = fmax(*least, least_frames(curves, document, original));
        *most = fmin(*most, end - original->knot.frame);
    }
}

/// The pointer's shift in frames: the held knot snaps to whole frames and all knots stay in range. `why` says what stopped it.
static double wanted_frames(const struct curves *curves, const struct core *core, char why[STOPPED_SIZE])
{
    const struct drag *drag = &core->drag;
    const struct originals *originals = &core->originals;
    if (drag->lock_y) return 0;
    double frames = drag->moved_x / curves_pixels_per_frame(curves, core), least, most;
    const struct original *held = &originals->list[0];
    for (int i = 0; i < originals->count; i++) {
        if (originals->list[i].knot.id == drag->knot) held = &originals->list[i];
    }
    if (drag->snap) frames = fabs(frames) < 0.5 ? 0 : round(held->knot.frame + frames) - held->knot.frame;
    shift_limits(curves, originals, core->document, &least, &most);
    if (frames < least || frames > most) snprintf(why, STOPPED_SIZE, "a knot would leave the range");
    if (curves->knot_drag.ripple && frames > most)
        snprintf(why, STOPPED_SIZE, "the last knot has reached the end of the range. Extend the range to make room");
    return fmax(fmin(frames, most), least);
}

/// Moves knots in time; selected ones also in value, measured in values of the active spline.
struct moving {
    const struct curves *curves;
    const struct core *core;
    double frames, up, resolution;
};

static struct knot moved(const void *how, const struct original *original)
{
    const struct moving *moving = how;
    const double scale = normal_map(moving->curves, moving->core, original->spline).scale;
    struct knot knot = original->knot;
    knot.frame += moving->frames;
    if (moving->up != 0 && !knot.still && selection_has(&moving->core->selection, knot.id))
        knot.value = core_round(knot.value + moving->up / scale, moving->resolution / scale);
    return knot;
}

static void apply_knots(void *of, struct core *core)
{
    struct curves *curves = of;
    const double pixels = curves_pixels_per_value(curves, core);
    char why[STOPPED_SIZE] = "";
    if (core->originals.count == 0) return;
    struct moving moving = {curves, core, wanted_frames(curves, core, why),
                            core->drag.lock_x ? 0 : -core->drag.moved_y / pixels, 0.01 / pixels};
    if (originals_room(core, moved, &moving, why) != ROOM_FREE) moving.frames = curves->knot_drag.free_frames;
    curves->knot_drag.free_frames = moving.frames;
    if (!originals_put(core, moved, &moving, why)) drag_restart(core);
    drag_say_stopped(core, why);
}

/// Turns the held end of the handle towards the pointer. Its length sets the stiffness.
static void apply_slope(void *of, struct core *core)
{
    const struct curves *curves = of;
    const struct drag *drag = &core->drag;
    const struct knot *knot = &core->originals.list[0].knot;
    float end[2];
    curves_handle(curves, core, knot, curves->knot_drag.handle, end);
    double x = curves_knot_x(curves, core, knot);
    double across = end[0] + drag->moved_x - x;
    double down = end[1] + drag->moved_y - curves_y(curves, core, knot->value);
    across = curves->knot_drag.handle ? fmax(across, 2) : fmin(across, -2);
    double seconds = across / curves_pixels_per_frame(curves, core) / core->document->fps;
    struct knot turned = *knot;
    turned.slope =
        core_round(-down / curves_pixels_per_value(curves, core) / seconds, SLOPE_RESOLUTION * core->visible);
    double length = handle_length(knot->stiffness), longer = maths_hypot(across, down) - length;
    if (fabs(longer) > LENGTH_SLACK) {
        turned.stiffness = handle_stiffness(length + longer - copysign(LENGTH_SLACK, longer));
    }
    core_put_knot(core, core->active, &turned);
}

static enum drag_answer knots_event(void *room, struct core *core, const struct event *event)
{
    bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & (MOD_CTRL | MOD_ALT));
    if (!key) return DRAG_PASSES;
    if (event->key == 'R') toggle_ripple(room, core);
    return event->key == 'R' || drag_lock(&core->drag, event->key) ? DRAG_USED : DRAG_PASSES;
}

/// A click on one of several selected knots selects it alone.
static void end_knots(void *room, struct core *core, bool keep)
{
    struct curves *curves = room;
    if (!keep) return;
    if (core->drag.moved) {
        core_edited(core, -1);
    } else if (curves->knot_drag.collapse) {
        selection_clear(&core->selection);
        selection_set(&core->selection, core->drag.knot, true);
    }
}

static void show_knots(void *room, struct core *core) { scale_box_show(room, core, false); }

/// Shift adds or removes the knot. Without Shift a drag moves all selected knots.
static void press_knot(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {
        .cursor = CURSOR_MOVE, .apply = apply_knots, .event = knots_event, .end = end_knots, .show = show_knots};
    struct curves *curves = room;
    unsigned id = hover->knot;
    bool selected = selection_has(&core->selection, id);
    core_turn_to(core, hover->spline);
    core->limb = 0;
    if (event->clicks == 2) {
        const struct spline *spline = core->document->splines[hover->spline];
        playback_seek(core, spline->knots[spline_find_id(spline, id)].frame);
        return;
    }
    if (event->mods & MOD_SHIFT) {
        selection_set(&core->selection, id, !selected);
        selected_settle(core);
        if (selected) return;
    } else if (!selected) {
        selection_clear(&core->selection);
        selection_set(&core->selection, id, true);
    }
    drag_begin(core, &owner, curves, NULL, event);
    core->drag.knot = id;
    curves->knot_drag = (struct knot_drag){.collapse = selected && !(event->mods & MOD_SHIFT)};
    collect(curves, core);
    core->drag.lock_x = rect_contains(core->layout.sheet, event->x, event->y); // the dope sheet has only time
}

bool curves_in_plot(const struct curves *curves, const struct core *core, double frame, double value, float xy[2])
{
    const struct rect *plot = &core->layout.plot;
    xy[0] = curves_x(curves, core, frame);
    xy[1] = curves_y(curves, core, value);
    return xy[0] >= plot->x && xy[1] >= plot->y && xy[0] <= plot->x + plot->w && xy[1] <= plot->y + plot->h;
}

static bool find_knot(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct document *document = core->document;
    return curves_in_plot(room, core, document_frame(document, document_sample(document, target->knot->frame)),
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
    const struct spline *spline = core_active_spline(core);
    struct curves *curves = room;
    assert(spline);
    drag_begin(core, &owner, curves, "Change slope", event);
    core->drag.knot = hover->knot;
    curves->knot_drag = (struct knot_drag){.handle = hover->handle};
    core->originals.count = 0;
    originals_add(&core->originals, core->active, &spline->knots[spline_find_id(spline, hover->knot)]);
}

static bool find_slope(void *room, const struct core *core, const struct target *target, float xy[2])
{
    curves_handle(room, core, target->knot, target->number[1] > 0, xy);
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
    const double up = 0.01 * hundredths * core->visible;
    struct moving moving = {curves, core, frames, up, 0.01 * fabs(up)};
    enum room room = ROOM_FREE;
    char why[STOPPED_SIZE] = "";
    if (history_is_open(core->history)) return;
    core_collect(core, false);
    // jump over knots in the way
    while (frames != 0 && (room = originals_room(core, moved, &moving, why)) == ROOM_OCCUPIED)
        moving.frames += frames;
    if (room == ROOM_OUTSIDE) moving.frames = 0;
    if (room == ROOM_OUTSIDE) core_stopped(core, why);
    if (core->originals.count == 0 || (moving.frames == 0 && up == 0)) return;
    if (room == ROOM_FREE) why[0] = 0;
    core_begin(core, "Nudge knots", core_merge_key(core, frames != 0 ? NUDGE_FRAMES : NUDGE_VALUE));
    originals_put(core, moved, &moving, why);
    core_end(core, true);
    if (*why) core_stopped(core, why);
    core->nudged_seconds = GHOST_SECONDS;
    core_edited(core, -1);
}
