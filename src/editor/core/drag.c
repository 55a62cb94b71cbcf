/// Mouse drags: of knots and slopes (edits made anew from the original at every step), view, playhead and dividers.
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include "editor/stage/body.h"
#include "editor/stage/record.h"
#include <assert.h>
#include <math.h>

static const float CLICK_REACH = 3;          ///< pixels that a click may wander
static const double SLOPE_RESOLUTION = 1e-3; ///< of the visible values, a second
static const double FINE = 0.1;              ///< of the pointer's way, with Shift
static const double LENGTH_SLACK = 8;    ///< pixels by which a handle may be pulled before it says more than a slope
static const float ORBIT_SPEED = 0.008f; ///< radians a pixel

bool drag_snaps(const struct editor *editor, unsigned mods) { return editor->options.no_snap == !!(mods & MOD_CTRL); }

void drag_begin(struct editor *editor, enum drag_kind kind, const struct event *event)
{
    struct drag *drag = &editor->drag;
    struct knot *originals = drag->originals;
    int capacity = drag->capacity;
    *drag = (struct drag){.kind = kind,
                          .button = event->button,
                          .x = event->x,
                          .y = event->y,
                          .start_x = event->x,
                          .start_y = event->y,
                          .snap = drag_snaps(editor, event->mods),
                          .originals = originals,
                          .capacity = capacity};
    editor->ghost.visible = false;
}

/// Whether a knot, as it was before the drag, moves with it.
static bool moves_along(const struct editor *editor, const struct knot *knot)
{
    return selection_has(&editor->selection, knot->id) || ripple_moves(&editor->drag, knot);
}

void drag_collect(struct editor *editor, const struct spline *spline)
{
    struct drag *drag = &editor->drag;
    drag->count = 0;
    for (int k = 0; k < spline->knot_count && drag->count < drag->capacity; k++) {
        if (moves_along(editor, &spline->knots[k])) drag->originals[drag->count++] = spline->knots[k];
    }
}

void drag_begin_knots(struct editor *editor, const struct editor_world *world, unsigned knot,
                      const struct event *event)
{
    const struct spline *spline = editor_active_spline(editor, world);
    struct drag *drag = &editor->drag;
    assert(spline);
    drag_begin(editor, DRAG_KNOTS, event);
    drag->knot = knot;
    drag_collect(editor, spline);
}

void drag_begin_slope(struct editor *editor, const struct editor_world *world, unsigned knot, int handle,
                      const struct event *event)
{
    const struct spline *spline = editor_active_spline(editor, world);
    struct drag *drag = &editor->drag;
    assert(spline && drag->capacity > 0);
    drag_begin(editor, DRAG_SLOPE, event);
    drag->knot = knot;
    drag->handle = handle;
    drag->originals[0] = spline->knots[spline_find_id(spline, knot)];
    drag->count = 1;
}

static bool edits_document(const struct drag *drag)
{
    return drag->kind == DRAG_KNOTS || drag->kind == DRAG_SLOPE || drag->kind == DRAG_SCALE ||
           drag->kind == DRAG_GRAB || drag->kind == DRAG_BODY;
}

/// The shift in frames that the pointer asks for: whole frames for the knot that is held, inside the range for all.
static double wanted_frames(struct editor *editor, const struct document *document, const struct spline *spline)
{
    const struct drag *drag = &editor->drag;
    if (drag->lock_y) return 0;
    double frames = drag->moved_x / curves_pixels_per_frame(editor);
    const struct knot *first = &drag->originals[0], *last = &drag->originals[drag->count - 1], *held = first;
    for (int k = 0; k < drag->count; k++) {
        if (drag->originals[k].id == drag->knot) held = &drag->originals[k];
    }
    if (drag->snap) frames = fabs(frames) < 0.5 ? 0 : round(held->frame + frames) - held->frame;
    double end = document_frame(document, document_last_knot_sample(document, spline));
    double most = end - last->frame, least = ripple_least(editor, document, spline);
    if (drag->ripple && frames > most) ripple_stopped(editor);
    return fmax(fmin(frames, most), least);
}

/// Whether no knot that stays is on a sample to which one would move.
static bool is_free(const struct editor *editor, const struct document *document, const struct spline *spline,
                    double frames)
{
    const struct drag *drag = &editor->drag;
    for (int k = 0; k < drag->count; k++) {
        int at = spline_find_knot(document, spline, document_sample(document, drag->originals[k].frame + frames));
        if (at >= 0 && !moves_along(editor, &spline->knots[at])) return false;
    }
    return true;
}

/// Moves all originals; from the far end on, so that they do not run into each other.
static bool move_knots(struct editor *editor, const struct editor_world *world, double frames, double value)
{
    const struct drag *drag = &editor->drag;
    double resolution = 0.01 / curves_pixels_per_value(editor);
    for (int i = 0; i < drag->count; i++) {
        const struct knot *original = &drag->originals[frames > 0 ? drag->count - 1 - i : i];
        struct edit edit = editor_edit_of(EDIT_KNOT_SET, editor->active);
        edit.knot = *original;
        edit.knot.frame += frames;
        if (value != 0 && selection_has(&editor->selection, original->id)) {
            edit.knot.value = round_value(original->value + value, resolution);
        }
        if (!history_apply(world->history, world->document, &edit, NULL)) return false;
    }
    return true;
}

static void apply_knots(struct editor *editor, const struct editor_world *world)
{
    struct drag *drag = &editor->drag;
    const struct spline *spline = editor_active_spline(editor, world);
    history_restart(world->history, world->document);
    if (!spline || drag->count == 0) return;
    double frames = wanted_frames(editor, world->document, spline);
    double value = drag->lock_x ? 0 : -drag->moved_y / curves_pixels_per_value(editor);
    if (!is_free(editor, world->document, spline, frames)) frames = drag->free_frames;
    if (!move_knots(editor, world, frames, value)) {
        history_restart(world->history, world->document);
        frames = drag->free_frames;
        move_knots(editor, world, frames, value);
    }
    drag->free_frames = frames;
}

/// The slope that lets the held end of the handle point at the pointer; pulled out or pushed in, also the stiffness.
static void apply_slope(struct editor *editor, const struct editor_world *world)
{
    const struct drag *drag = &editor->drag;
    const struct knot *knot = &drag->originals[0];
    float end[2];
    curves_handle(editor, world->document, knot, drag->handle, end);
    double x = curves_x(editor, document_frame(world->document, document_sample(world->document, knot->frame)));
    double across = end[0] + drag->moved_x - x;
    double down = end[1] + drag->moved_y - curves_y(editor, knot->value);
    across = drag->handle ? fmax(across, 2) : fmin(across, -2);
    double seconds = across / curves_pixels_per_frame(editor) / world->document->fps;
    struct edit edit = editor_edit_of(EDIT_KNOT_SET, editor->active);
    edit.knot = *knot;
    double visible = editor->view.value1 - editor->view.value0;
    edit.knot.slope = round_value(-down / curves_pixels_per_value(editor) / seconds, SLOPE_RESOLUTION * visible);
    double length = handle_length(knot->stiffness), longer = hypot(across, down) - length;
    if (fabs(longer) > LENGTH_SLACK) {
        edit.knot.stiffness = handle_stiffness(length + longer - copysign(LENGTH_SLACK, longer));
    }
    history_restart(world->history, world->document);
    editor_edit(editor, world, &edit);
}

void drag_apply(struct editor *editor, const struct editor_world *world)
{
    struct drag *drag = &editor->drag;
    if (!drag->stale || !drag->moved) return;
    drag->stale = false;
    if (drag->kind == DRAG_KNOTS) apply_knots(editor, world);
    if (drag->kind == DRAG_SLOPE) apply_slope(editor, world);
    if (drag->kind == DRAG_SCALE) scale_apply(editor, world);
}

void drag_start_moving(struct editor *editor, const struct editor_world *world)
{
    struct drag *drag = &editor->drag;
    if (drag->moved) return;
    drag->moved = true;
    if (!edits_document(drag)) return;
    const char *label = drag->kind == DRAG_SLOPE   ? "Change slope"
                        : drag->kind == DRAG_GRAB  ? "Pull tail"
                        : drag->kind == DRAG_BODY  ? "Move body"
                        : drag->kind == DRAG_SCALE ? "Scale knots"
                        : drag->count == 1         ? "Move knot"
                                                   : "Move knots";
    history_begin(world->history, label, 0);
    if (drag->kind == DRAG_BODY && editor->record.armed) record_begin(editor);
    ghost_capture(editor, world);
}

static void move_pointer(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    struct drag *drag = &editor->drag;
    float dx = event->x - drag->x, dy = event->y - drag->y;
    double fine = event->mods & MOD_SHIFT && edits_document(drag) ? FINE : 1;
    drag->x = event->x;
    drag->y = event->y;
    drag->moved_x += dx * fine;
    drag->moved_y += dy * fine;
    drag->snap = drag_snaps(editor, event->mods);
    drag->stale = true;
    if (!drag->moved) {
        if (hypotf(event->x - drag->start_x, event->y - drag->start_y) < CLICK_REACH) return;
        drag_start_moving(editor, world);
    }
    if (drag->kind == DRAG_PAN) view_pan(editor, drag->moved_x, drag->moved_y);
    if (drag->kind == DRAG_ORBIT) {
        camera_orbit(&editor->camera, -(float)drag->moved_x * ORBIT_SPEED, (float)drag->moved_y * ORBIT_SPEED);
    }
    if (drag->kind == DRAG_STAGE_PAN) {
        camera_pan(&editor->camera, (float)drag->moved_x, (float)drag->moved_y, editor->layout.stage.h);
    }
    if (drag->kind == DRAG_STAGE_DIVIDER || drag->kind == DRAG_INSPECTOR_DIVIDER) {
        divider_move(editor, drag->kind, event->x, event->y);
    }
    if (drag->kind == DRAG_SCRUB) {
        double frame = curves_frame(editor, event->x);
        playback_seek(editor, world->document, drag->snap ? round(frame) : frame);
    }
    if (drag->kind == DRAG_RANGE) range_drag(editor, world->document, event->x);
    if (drag->kind == DRAG_BOX) box_update(editor, world);
    if (!edits_document(drag)) drag->moved_x = drag->moved_y = 0;
}

bool drag_lock(struct drag *drag, int key)
{
    if (key != 'X' && key != 'Y') return false;
    bool *lock = key == 'X' ? &drag->lock_x : &drag->lock_y;
    bool on = !*lock;
    drag->lock_x = drag->lock_y = false;
    *lock = on;
    drag->stale = true;
    return true;
}

void drag_end(struct editor *editor, const struct editor_world *world, bool keep)
{
    struct drag *drag = &editor->drag;
    bool open = drag->moved && edits_document(drag);
    if (open && keep) drag_apply(editor, world);
    if (open && drag->kind == DRAG_BODY) body_release(editor, world, keep);
    if (open && !keep) history_restart(world->history, world->document);
    if (open && !keep) selection_drop_from(&editor->selection, world->document->next_id);
    if (open) history_end(world->history);
    if (drag->kind == DRAG_PAINT) brush_end(editor, world, keep);
    if (!drag->moved && keep && drag->kind == DRAG_KNOTS && drag->collapse) {
        selection_clear(&editor->selection);
        selection_set(&editor->selection, drag->knot, true);
    }
    if (drag->kind == DRAG_RANGE) range_end(editor, keep);
    if (drag->kind == DRAG_BOX) box_end(editor, keep);
    drag->kind = DRAG_NONE;
    editor->ghost.visible = false;
}

bool drag_event(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    struct drag *drag = &editor->drag;
    if (drag->kind == DRAG_NONE) return false;
    if (event->kind == EVENT_POINTER) {
        move_pointer(editor, world, event);
        return true;
    }
    if (drag->kind == DRAG_SCALE) return scale_event(editor, world, event);
    if (event->kind == EVENT_BUTTON) {
        if (event->action == ACTION_RELEASE && event->button == drag->button) drag_end(editor, world, true);
        return true;
    }
    if (event->kind != EVENT_KEY || event->action != ACTION_PRESS) return false;
    bool locks = (drag->kind == DRAG_KNOTS || drag->kind == DRAG_BODY) && !(event->mods & (MOD_CTRL | MOD_ALT));
    if (event->key == KEY_ESCAPE) {
        drag_end(editor, world, false);
        return true;
    }
    if (locks && event->key == 'R' && drag->kind == DRAG_BODY) {
        drag_start_moving(editor, world);
        record_begin(editor);
    } else if (locks && event->key == 'R') {
        ripple_toggle(editor, world);
    }
    return locks && (event->key == 'R' || drag_lock(drag, event->key));
}
