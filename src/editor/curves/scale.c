/// Scaling the selected knots in time and value: S, then the pointer or a typed factor; one undo step.
///
/// A knot (t, v) goes to (p + a·(t − p), q + b·(v − q)) about the pivot (p, q), its slope to slope·b/a, so that the shape
/// between the knots scales with them.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/selection.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/view.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double LEAST_REACH = 40; ///< pixels from the pivot that count as factor 1, or nothing could be aimed at
static const double SLOPE_RESOLUTION = 1e-6; ///< of the visible values, a second
static const double MOST = 1e4;              ///< factor

/// Factors of time and value.
struct factors {
    double time, value;
};

static void place_pivot(struct curves *curves, const struct core *core, const struct editor_world *world)
{
    struct scaling *scaling = &curves->scaling;
    const struct document *document = world->document;
    if (scaling->about_playhead) {
        double position = round(core->playback.position);
        scaling->frame = document_frame(document, (int)position);
        scaling->value = evaluation_at(world->evaluation, core->active, position).y;
        return;
    }
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < core->originals.count; k++) {
        low = fmin(low, core->originals.knot[k].value);
        high = fmax(high, core->originals.knot[k].value);
    }
    scaling->frame = (core->originals.knot[0].frame + core->originals.knot[core->originals.count - 1].frame) / 2;
    scaling->value = (low + high) / 2;
}

static void say(struct curves *curves, const struct core *core, struct factors by)
{
    const struct scaling *scaling = &curves->scaling;
    const struct drag *drag = &core->drag;
    char factor[48];
    snprintf(factor, sizeof factor, "%.3g", drag->lock_y ? by.value : by.time);
    if (scaling->typed[0]) snprintf(factor, sizeof factor, "%s_", scaling->typed);
    const char *axis = drag->lock_x ? " time" : drag->lock_y ? " value" : "";
    const char *pivots[] = {"middle", "playhead"};
    snprintf(curves->scaling.sentence, sizeof scaling->sentence,
             "Scale%s by %s about the %s (P: the %s).  X, Y;  Enter, Esc", axis, factor,
             pivots[scaling->about_playhead], pivots[!scaling->about_playhead]);
}

void curves_scale(struct curves *curves, struct core *core, const struct editor_world *world)
{
    const struct spline *spline = core_active_spline(core, world);
    int count = selection_count(&core->selection, spline);
    if (count == 0) {
        core_message(core, false, "Select the knots to scale first.");
        return;
    }
    const struct event event = {.button = BUTTON_LEFT, .x = core->pointer_x, .y = core->pointer_y};
    drag_begin(core, DRAG_SCALE, "Scale knots", &event);
    core_collect(core, spline);
    curves->scaling = (struct scaling){.about_playhead = count == 1, .free_time = 1};
    core->message.text[0] = 0;
    core->hover = (struct hover){.kind = HOVER_NONE};
    place_pivot(curves, core, world);
    say(curves, core, (struct factors){1, 1});
}

/// How many times further from the pivot the pointer is than when scaling began, along one axis.
static double along(double pivot, double start, double now)
{
    double reach = start - pivot;
    if (fabs(reach) < LEAST_REACH) reach = reach < 0 ? -LEAST_REACH : LEAST_REACH;
    return 1 + (now - start) / reach;
}

static double clamped(double factor) { return fmin(fmax(factor, -MOST), MOST); }

static struct factors wanted(const struct curves *curves, const struct core *core)
{
    const struct drag *drag = &core->drag;
    const struct scaling *scaling = &curves->scaling;
    double x = curves_x(curves, core, scaling->frame), y = curves_y(curves, core, scaling->value);
    double to_x = drag->start_x + drag->moved_x, to_y = drag->start_y + drag->moved_y;
    double before = fmax(hypot(drag->start_x - x, drag->start_y - y), LEAST_REACH);
    double factor = 1 + (hypot(to_x - x, to_y - y) - hypot(drag->start_x - x, drag->start_y - y)) / before;
    if (drag->lock_x) factor = along(x, drag->start_x, to_x);
    if (drag->lock_y) factor = along(y, drag->start_y, to_y);
    char *end;
    double typed = strtod(scaling->typed, &end);
    if (end != scaling->typed) factor = typed;
    factor = clamped(factor);
    return (struct factors){drag->lock_y ? 1 : factor, drag->lock_x ? 1 : factor};
}

static double scaled_frame(const struct curves *curves, const struct core *core, const struct knot *knot,
                           double factor)
{
    double frame = curves->scaling.frame + factor * (knot->frame - curves->scaling.frame);
    if (factor == 1) return knot->frame;
    return core->drag.snap ? round(frame) : frame;
}

/// Whether by that factor all knots stay inside the range, apart, and off the knots that are not scaled.
static bool is_free(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct spline *spline, double factor)
{
    int last = document_last_knot_sample(document, spline), before = 0;
    for (int k = 0; k < core->originals.count; k++) {
        int sample = document_sample(document, scaled_frame(curves, core, &core->originals.knot[k], factor));
        int at = spline_find_knot(document, spline, sample);
        bool apart = k == 0 || (factor > 0 ? sample > before : sample < before);
        if (sample < 0 || sample > last || !apart) return false;
        if (at >= 0 && !selection_has(&core->selection, spline->knots[at].id)) return false;
        before = sample;
    }
    return true;
}

static struct knot scaled(const struct curves *curves, const struct core *core, const struct knot *knot,
                          struct factors by)
{
    struct knot to = *knot;
    double visible = curves->view.value1 - curves->view.value0, steeper = by.value / by.time;
    to.frame = scaled_frame(curves, core, knot, by.time);
    if (by.value != 1) {
        double value = curves->scaling.value + by.value * (knot->value - curves->scaling.value);
        to.value = core_round(value, 0.01 / curves_pixels_per_value(curves, core));
    }
    if (steeper != 1) to.slope = core_round(knot->slope * steeper, SLOPE_RESOLUTION * visible);
    return to;
}

/// Takes the knots out and puts them in anew, so that they do not run into each other, whatever their order becomes.
static void move_all(const struct curves *curves, struct core *core, const struct editor_world *world,
                     struct factors by)
{
    for (int k = 0; k < core->originals.count && by.time != 1; k++) {
        struct edit edit = core_edit_of(EDIT_KNOT_REMOVE, core->active);
        edit.knot = core->originals.knot[k];
        core_edit(core, world, &edit);
    }
    for (int k = 0; k < core->originals.count; k++) {
        struct edit edit = core_edit_of(by.time != 1 ? EDIT_KNOT_INSERT : EDIT_KNOT_SET, core->active);
        edit.knot = scaled(curves, core, &core->originals.knot[k], by);
        if (core_edit(core, world, &edit)) continue;
        history_restart(world->history, world->document);
        return;
    }
}

void scale_apply(struct curves *curves, struct core *core, const struct editor_world *world)
{
    const struct spline *spline = core_active_spline(core, world);
    history_restart(world->history, world->document);
    if (!spline) return;
    struct factors by = wanted(curves, core);
    if (!is_free(curves, core, world->document, spline, by.time)) by.time = curves->scaling.free_time;
    curves->scaling.free_time = by.time;
    move_all(curves, core, world, by);
    say(curves, core, by);
}

void scale_show(const struct curves *curves, struct core *core)
{
    const struct scaling *scaling = &curves->scaling;
    if (core->drag.kind != DRAG_SCALE) return;
    const float x = curves_x(curves, core, scaling->frame), y = curves_y(curves, core, scaling->value), arm = 7;
    const float across[] = {x - arm, y, x + arm, y}, down[] = {x, y - arm, x, y + arm};
    const float line[] = {x, y, core->drag.x, core->drag.y};
    if (!scaling->typed[0]) drawlist_dashed(&core->list, line, 2, 1, 3, 4, theme_fade(theme()->playhead, 0.5f));
    if (!core->drag.lock_y) drawlist_line(&core->list, across, 2, 1.5f, theme()->playhead);
    if (!core->drag.lock_x) drawlist_line(&core->list, down, 2, 1.5f, theme()->playhead);
}

/// Digits, sign and point of a factor; by what is typed, because layouts have them on different keys.
static bool type(struct scaling *scaling, uint32_t c)
{
    size_t length = strlen(scaling->typed);
    bool digit = c >= '0' && c <= '9', sign = c == '-' && length == 0;
    bool point = (c == '.' || c == ',') && !strchr(scaling->typed, '.');
    if (!(digit || sign || point) || length + 1 >= sizeof scaling->typed) return false;
    scaling->typed[length] = (char)(c == ',' ? '.' : c);
    scaling->typed[length + 1] = 0;
    return true;
}

/// Deletes the last character.
static void erase(struct scaling *scaling)
{
    size_t length = strlen(scaling->typed);
    if (length > 0) scaling->typed[length - 1] = 0;
}

static void change(struct core *core, const struct editor_world *world)
{
    drag_start_moving(core, world);
    core->drag.stale = true;
}

static enum drag_answer press_key(struct curves *curves, struct core *core, const struct editor_world *world,
                                  const struct event *event)
{
    struct scaling *scaling = &curves->scaling;
    if (event->key == KEY_ESCAPE) return DRAG_TAKE_BACK;
    if (event->key == KEY_ENTER) return DRAG_KEEP;
    if (event->key == 'P') {
        if (core->drag.moved) history_restart(world->history, world->document);
        scaling->about_playhead = !scaling->about_playhead;
        place_pivot(curves, core, world);
    } else if (event->key == KEY_BACKSPACE) {
        erase(scaling);
    } else if (!drag_lock(&core->drag, event->key)) {
        return DRAG_USED;
    }
    change(core, world);
    return DRAG_USED;
}

enum drag_answer scale_event(struct curves *curves, struct core *core, const struct editor_world *world,
                             const struct event *event)
{
    bool press = event->action != ACTION_RELEASE;
    switch (event->kind) {
    case EVENT_BUTTON:
        return !press ? DRAG_USED : event->button == BUTTON_LEFT ? DRAG_KEEP : DRAG_TAKE_BACK;
    case EVENT_KEY:
        return press ? press_key(curves, core, world, event)
                     : DRAG_PASSES; /* of a key that was held before, the release is somebody else's */
    case EVENT_TEXT:
        if (type(&curves->scaling, event->codepoint)) change(core, world);
        return DRAG_USED;
    default:
        return event->kind == EVENT_WHEEL ? DRAG_USED
                                          : DRAG_PASSES; /* the factor is measured in pixels: no zooming meanwhile */
    }
}
