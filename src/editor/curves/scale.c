/// Scaling the selected knots in time and value: S, then the pointer or a typed factor; one undo step.
///
/// A knot (t, v) goes to (p + a·(t − p), q + b·(v − q)) about the pivot (p, q), its slope to slope·b/a, so that the shape
/// between the knots scales with them.
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
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

static void place_pivot(struct editor *editor, const struct editor_world *world)
{
    struct scaling *scaling = &editor->scaling;
    const struct drag *drag = &editor->drag;
    const struct document *document = world->document;
    if (scaling->about_playhead) {
        double position = round(editor->playback.position);
        scaling->frame = document_frame(document, (int)position);
        scaling->value = curves_solved(world, editor->active, position).y;
        return;
    }
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < drag->count; k++) {
        low = fmin(low, drag->originals[k].value);
        high = fmax(high, drag->originals[k].value);
    }
    scaling->frame = (drag->originals[0].frame + drag->originals[drag->count - 1].frame) / 2;
    scaling->value = (low + high) / 2;
}

static void say(struct editor *editor, struct factors by)
{
    const struct scaling *scaling = &editor->scaling;
    const struct drag *drag = &editor->drag;
    char factor[48];
    snprintf(factor, sizeof factor, "%.3g", drag->lock_y ? by.value : by.time);
    if (scaling->typed[0]) snprintf(factor, sizeof factor, "%s_", scaling->typed);
    const char *axis = drag->lock_x ? " time" : drag->lock_y ? " value" : "";
    const char *pivots[] = {"middle", "playhead"};
    snprintf(editor->scaling.sentence, sizeof scaling->sentence,
             "Scale%s by %s about the %s (P: the %s).  X, Y;  Enter, Esc", axis, factor,
             pivots[scaling->about_playhead], pivots[!scaling->about_playhead]);
}

void scale_begin(struct editor *editor, const struct editor_world *world)
{
    const struct spline *spline = editor_active_spline(editor, world);
    int count = selection_count(&editor->selection, spline);
    if (count == 0) {
        editor_message(editor, false, "Select the knots to scale first.");
        return;
    }
    const struct event event = {.button = BUTTON_LEFT, .x = editor->pointer_x, .y = editor->pointer_y};
    drag_begin(editor, DRAG_SCALE, &event);
    drag_collect(editor, spline);
    editor->scaling = (struct scaling){.about_playhead = count == 1, .free_time = 1};
    editor->message.text[0] = 0;
    editor->hover = (struct hover){.kind = HOVER_NONE};
    place_pivot(editor, world);
    say(editor, (struct factors){1, 1});
}

/// How many times further from the pivot the pointer is than when scaling began, along one axis.
static double along(double pivot, double start, double now)
{
    double reach = start - pivot;
    if (fabs(reach) < LEAST_REACH) reach = reach < 0 ? -LEAST_REACH : LEAST_REACH;
    return 1 + (now - start) / reach;
}

static double clamped(double factor) { return fmin(fmax(factor, -MOST), MOST); }

static struct factors wanted(const struct editor *editor)
{
    const struct drag *drag = &editor->drag;
    const struct scaling *scaling = &editor->scaling;
    double x = curves_x(editor, scaling->frame), y = curves_y(editor, scaling->value);
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

static double scaled_frame(const struct editor *editor, const struct knot *knot, double factor)
{
    double frame = editor->scaling.frame + factor * (knot->frame - editor->scaling.frame);
    if (factor == 1) return knot->frame;
    return editor->drag.snap ? round(frame) : frame;
}

/// Whether by that factor all knots stay inside the range, apart, and off the knots that are not scaled.
static bool is_free(const struct editor *editor, const struct document *document, const struct spline *spline,
                    double factor)
{
    const struct drag *drag = &editor->drag;
    int last = document_last_knot_sample(document, spline), before = 0;
    for (int k = 0; k < drag->count; k++) {
        int sample = document_sample(document, scaled_frame(editor, &drag->originals[k], factor));
        int at = spline_find_knot(document, spline, sample);
        bool apart = k == 0 || (factor > 0 ? sample > before : sample < before);
        if (sample < 0 || sample > last || !apart) return false;
        if (at >= 0 && !selection_has(&editor->selection, spline->knots[at].id)) return false;
        before = sample;
    }
    return true;
}

static struct knot scaled(const struct editor *editor, const struct knot *knot, struct factors by)
{
    struct knot to = *knot;
    double visible = editor->view.value1 - editor->view.value0, steeper = by.value / by.time;
    to.frame = scaled_frame(editor, knot, by.time);
    if (by.value != 1) {
        double value = editor->scaling.value + by.value * (knot->value - editor->scaling.value);
        to.value = round_value(value, 0.01 / curves_pixels_per_value(editor));
    }
    if (steeper != 1) to.slope = round_value(knot->slope * steeper, SLOPE_RESOLUTION * visible);
    return to;
}

/// Takes the knots out and puts them in anew, so that they do not run into each other, whatever their order becomes.
static void move_all(struct editor *editor, const struct editor_world *world, struct factors by)
{
    const struct drag *drag = &editor->drag;
    for (int k = 0; k < drag->count && by.time != 1; k++) {
        struct edit edit = editor_edit_of(EDIT_KNOT_REMOVE, editor->active);
        edit.knot = drag->originals[k];
        editor_edit(editor, world, &edit);
    }
    for (int k = 0; k < drag->count; k++) {
        struct edit edit = editor_edit_of(by.time != 1 ? EDIT_KNOT_INSERT : EDIT_KNOT_SET, editor->active);
        edit.knot = scaled(editor, &drag->originals[k], by);
        if (editor_edit(editor, world, &edit)) continue;
        history_restart(world->history, world->document);
        return;
    }
}

void scale_apply(struct editor *editor, const struct editor_world *world)
{
    const struct spline *spline = editor_active_spline(editor, world);
    history_restart(world->history, world->document);
    if (!spline) return;
    struct factors by = wanted(editor);
    if (!is_free(editor, world->document, spline, by.time)) by.time = editor->scaling.free_time;
    editor->scaling.free_time = by.time;
    move_all(editor, world, by);
    say(editor, by);
}

void scale_show(struct editor *editor)
{
    const struct scaling *scaling = &editor->scaling;
    if (editor->drag.kind != DRAG_SCALE) return;
    const float x = curves_x(editor, scaling->frame), y = curves_y(editor, scaling->value), arm = 7;
    const float across[] = {x - arm, y, x + arm, y}, down[] = {x, y - arm, x, y + arm};
    const float line[] = {x, y, editor->drag.x, editor->drag.y};
    if (!scaling->typed[0]) drawlist_dashed(&editor->list, line, 2, 1, 3, 4, theme_fade(theme()->playhead, 0.5f));
    if (!editor->drag.lock_y) drawlist_line(&editor->list, across, 2, 1.5f, theme()->playhead);
    if (!editor->drag.lock_x) drawlist_line(&editor->list, down, 2, 1.5f, theme()->playhead);
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

/// Takes the last character back.
static void erase(struct scaling *scaling)
{
    size_t length = strlen(scaling->typed);
    if (length > 0) scaling->typed[length - 1] = 0;
}

static void change(struct editor *editor, const struct editor_world *world)
{
    drag_start_moving(editor, world);
    editor->drag.stale = true;
}

static void press_key(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    struct scaling *scaling = &editor->scaling;
    if (event->key == KEY_ESCAPE || event->key == KEY_ENTER) {
        drag_end(editor, world, event->key == KEY_ENTER);
        return;
    }
    if (event->key == 'P') {
        if (editor->drag.moved) history_restart(world->history, world->document);
        scaling->about_playhead = !scaling->about_playhead;
        place_pivot(editor, world);
    } else if (event->key == KEY_BACKSPACE) {
        erase(scaling);
    } else if (!drag_lock(&editor->drag, event->key)) {
        return;
    }
    change(editor, world);
}

bool scale_event(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    bool press = event->action != ACTION_RELEASE;
    switch (event->kind) {
    case EVENT_BUTTON:
        if (press) drag_end(editor, world, event->button == BUTTON_LEFT);
        return true;
    case EVENT_KEY:
        if (press) press_key(editor, world, event);
        return press; /* of a key that was held before, the release is somebody else's */
    case EVENT_TEXT:
        if (type(&editor->scaling, event->codepoint)) change(editor, world);
        return true;
    default:
        return event->kind == EVENT_WHEEL; /* the factor is measured in pixels: no zooming meanwhile */
    }
}
