/// One frame of the editor: events are handed to who wants them, time passes, everything is shown.
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include "editor/stage/follow.h"
#include "editor/stage/record.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

static void press(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    enum drag_kind divider = divider_at(editor, event->x, event->y);
    if (divider != DRAG_NONE && event->button == BUTTON_LEFT) {
        drag_begin(editor, divider, event);
    } else if (rect_contains(editor->layout.curves, event->x, event->y)) {
        curves_press(editor, world, event);
    } else if (rect_contains(editor->layout.stage, event->x, event->y)) {
        stage_press(editor, world, event);
    } else {
        transport_event(editor, world, event);
    }
}

/// Events that neither a dialog nor a running drag nor the inspector wanted.
static void dispatch(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    struct request request = {.kind = event->kind == EVENT_CLOSE ? REQUEST_QUIT : REQUEST_OPEN};
    switch (event->kind) {
    case EVENT_KEY:
    case EVENT_TEXT:
        keys_event(editor, world, event);
        break;
    case EVENT_BUTTON:
        if (event->action == ACTION_PRESS) press(editor, world, event);
        break;
    case EVENT_WHEEL:
        if (rect_contains(editor->layout.curves, event->x, event->y)) curves_wheel(editor, event);
        if (rect_contains(editor->layout.status, event->x, event->y)) transport_event(editor, world, event);
        if (rect_contains(editor->layout.stage, event->x, event->y)) stage_wheel(editor, event);
        break;
    case EVENT_PASTE:
        paste_knots(editor, world, event->text);
        break;
    case EVENT_CLOSE:
        dialog_leave(editor, world, &request);
        break;
    case EVENT_DROP:
        snprintf(request.path, sizeof request.path, "%s", event->path ? event->path : "");
        dialog_leave(editor, world, &request);
        break;
    default:
        break;
    }
}

/// Pointer and modifiers, and errors that were read.
static void note(struct editor *editor, const struct event *event)
{
    bool has_pointer = event->kind == EVENT_POINTER || event->kind == EVENT_BUTTON || event->kind == EVENT_WHEEL;
    if (has_pointer) {
        editor->pointer_x = event->x;
        editor->pointer_y = event->y;
    }
    if (has_pointer || event->kind == EVENT_KEY) editor->mods = event->mods;
    bool pressed = event->kind == EVENT_KEY || event->kind == EVENT_BUTTON;
    if (pressed && event->action == ACTION_PRESS && editor->message.is_error) {
        editor->message.text[0] = 0;
        editor->message.is_error = false;
    }
}

void editor_let_go(struct editor *editor, const struct editor_world *world)
{
    if (editor->drag.kind != DRAG_NONE) drag_end(editor, world, true);
    inspector_let_go(editor, world);
}

/// What opened over the panels ends whatever the pointer and the keys were in the middle of.
static void let_go(struct editor *editor, const struct editor_world *world)
{
    if (editor->dialog.kind == DIALOG_NONE && !editor->help.open) return;
    if (editor->drag.kind != DRAG_NONE) drag_end(editor, world, true);
    editor->held_key = 0;
    editor->space_down = false;
}

void editor_event(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    note(editor, event);
    if (event->kind == EVENT_SIZE) editor_resize(editor, event->x, event->y, event->scale);
    editor_reserve(editor, world->document);
    bool used = dialog_event(editor, world, event) || help_event(editor, event) || welcome_event(editor, event) ||
                drag_event(editor, world, event) ||
                (editor->drag.kind == DRAG_NONE && inspector_event(editor, world, event));
    if (event->kind == EVENT_KEY && event->action != ACTION_RELEASE) {
        editor->press = (struct press){.used = used, .repeated = event->action == ACTION_REPEAT};
    }
    if (!used) dispatch(editor, world, event);
    let_go(editor, world);
}

void editor_advance(struct editor *editor, const struct editor_world *world, double dt)
{
    struct message *message = &editor->message;
    editor->press = (struct press){.used = false}; // what it types comes in the same frame
    if (message->seconds_left > 0) {
        message->seconds_left -= dt;
        if (message->seconds_left <= 0) message->text[0] = 0;
    }
    status_advance(editor, dt);
    playback_advance(editor, world, dt);
    drag_apply(editor, world);
    brush_advance(editor, world, dt);
    grab_apply(editor, world);
    follow_advance(editor, world, dt);
    record_advance(editor, world);
}

void editor_pose(struct editor *editor, const struct editor_world *world)
{
    if (!editor->fitted) {
        editor->fitted = true;
        view_frame_all(editor, world);
        stage_fit(editor, world);
    }
    stage_pose(editor, world);
    brush_pose(editor, world);
}

/// What the pointer is over now: things move under it.
static void update_hover(struct editor *editor, const struct editor_world *world)
{
    if (editor->drag.kind != DRAG_NONE) return;
    float x = editor->pointer_x, y = editor->pointer_y;
    editor->hover = (struct hover){.kind = HOVER_NONE};
    if (editor->dialog.kind != DIALOG_NONE || editor->help.open || divider_at(editor, x, y) != DRAG_NONE) return;
    if (rect_contains(editor->layout.curves, x, y)) editor->hover = curves_hover(editor, world, x, y);
    if (rect_contains(editor->layout.stage, x, y)) editor->hover = stage_hover(editor, x, y);
    if (rect_contains(editor->layout.status, x, y)) editor->hover = transport_hover(editor, x, y);
}

/// A short thick piece in the middle of a divider: the line alone does not look as if it could be dragged.
static void show_grip(struct editor *editor, enum drag_kind divider, float x, float y)
{
    enum { LENGTH = 36, THICKNESS = 3 };
    const bool across = divider == DRAG_STAGE_DIVIDER;
    const float w = across ? LENGTH : THICKNESS, h = across ? THICKNESS : LENGTH;
    const bool held = editor->drag.kind == divider;
    const bool hot =
        editor->drag.kind == DRAG_NONE && divider_at(editor, editor->pointer_x, editor->pointer_y) == divider;
    const uint32_t color = held ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    drawlist_rounded(&editor->list, (struct rect){roundf(x - w / 2), roundf(y - h / 2), w, h}, THICKNESS / 2.0f,
                     color);
}

static void show_dividers(struct editor *editor)
{
    const struct layout *l = &editor->layout;
    drawlist_rect(&editor->list, (struct rect){0, l->curves.y, l->curves.w, 1}, theme()->border);
    drawlist_rect(&editor->list, (struct rect){l->inspector.x, 0, 1, l->inspector.h}, theme()->border);
    show_grip(editor, DRAG_STAGE_DIVIDER, l->curves.w / 2, l->curves.y + 0.5f);
    show_grip(editor, DRAG_INSPECTOR_DIVIDER, l->inspector.x + 0.5f, l->inspector.h / 2);
}

void editor_show(struct editor *editor, const struct editor_world *world)
{
    drawlist_clear(&editor->list, editor->layout.window);
    update_hover(editor, world);
    stage_show(editor, world);
    caption_show(editor, world->document);
    welcome_show(editor, world);
    curves_show(editor, world);
    inspector_show(editor, world);
    show_dividers(editor);
    status_show(editor, world);
    help_show(editor);
    dialog_show(editor, world);
}

enum cursor editor_cursor(const struct editor *editor)
{
    static const enum cursor of_drag[] = {
        [DRAG_KNOTS] = CURSOR_MOVE,
        [DRAG_SLOPE] = CURSOR_MOVE,
        [DRAG_PAN] = CURSOR_MOVE,
        [DRAG_BOX] = CURSOR_ARROW,
        [DRAG_SCALE] = CURSOR_MOVE,
        [DRAG_SCRUB] = CURSOR_HORIZONTAL,
        [DRAG_RANGE] = CURSOR_HORIZONTAL,
        [DRAG_STAGE_PAN] = CURSOR_MOVE,
        [DRAG_GRAB] = CURSOR_HAND,
        [DRAG_BODY] = CURSOR_MOVE,
        [DRAG_PAINT] = CURSOR_ARROW,
        [DRAG_STAGE_DIVIDER] = CURSOR_VERTICAL,
        [DRAG_INSPECTOR_DIVIDER] = CURSOR_HORIZONTAL,
    };
    static const enum cursor of_hover[] = {
        [HOVER_NONE] = CURSOR_ARROW, [HOVER_KNOT] = CURSOR_MOVE,        [HOVER_SLOPE] = CURSOR_MOVE,
        [HOVER_CURVE] = CURSOR_HAND, [HOVER_RULER] = CURSOR_HORIZONTAL, [HOVER_JOINT] = CURSOR_HAND,
        [HOVER_UNITS] = CURSOR_HAND, [HOVER_BODY] = CURSOR_MOVE,        [HOVER_PLAY] = CURSOR_HAND,
        [HOVER_LOOP] = CURSOR_HAND,  [HOVER_SPEED] = CURSOR_HAND,       [HOVER_WARNING] = CURSOR_HAND,
    };
    static const enum cursor of_widget[] = {
        [UI_OVER_NOTHING] = CURSOR_ARROW, [UI_OVER_NUMBER] = CURSOR_HORIZONTAL, [UI_OVER_TEXT] = CURSOR_TEXT};
    if (editor->dialog.kind != DIALOG_NONE) return of_widget[editor->dialog.ui.over];
    if (editor->help.open) return CURSOR_ARROW;
    if (editor->drag.kind != DRAG_NONE) return of_drag[editor->drag.kind];
    enum drag_kind divider = divider_at(editor, editor->pointer_x, editor->pointer_y);
    if (divider != DRAG_NONE) return of_drag[divider];
    if (editor->inspector.ui.over != UI_OVER_NOTHING) return of_widget[editor->inspector.ui.over];
    if (editor->hover.kind == HOVER_CURVE && editor->hover.spline == editor->active) return CURSOR_ARROW;
    return of_hover[editor->hover.kind];
}
