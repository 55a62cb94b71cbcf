/// A ramp in the inspector: angles along a tail or chain as a small curve whose points are dragged.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stdio.h>

enum { HEIGHT = 64, INSET = 7, NAME = 24, REACH = 11 }; ///< pixels; REACH: of a right click from its point

static const double APART = 0.01;                          ///< between places of neighbouring points
static const double PLACES = 100, SPARE = 1.2, LEAST = 10; ///< places in all; above the largest angle; degrees

/// A ramp as it is laid out.
struct ramp_view {
    const struct angle_row *row;
    const struct angles *angles;
    struct rect plot;
    double low, high; ///< degrees at its bottom and top
    char names[RAMP_MAX_POINTS][NAME];
    struct ui_handle handles[RAMP_MAX_POINTS];
};

static float x_of(const struct ramp_view *view, double at) { return view->plot.x + (float)at * view->plot.w; }

static float y_of(const struct ramp_view *view, double angle)
{
    const struct rect *plot = &view->plot;
    return plot->y + plot->h * (float)((view->high - angle) / (view->high - view->low));
}

/// The point that a place of the plot stands for.
static struct ramp_point point_at(const struct ramp_view *view, float x, float y)
{
    const double at = (double)((x - view->plot.x) / view->plot.w),
                 share = (double)((y - view->plot.y) / view->plot.h);
    const double angle = view->high - share * (view->high - view->low);
    return (struct ramp_point){round(fmin(fmax(at, 0), 1) * PLACES) / PLACES, core_round(angle, view->row->step / 5)};
}

static bool is_held(const struct ramp_view *view, uint32_t held)
{
    for (int i = 0; held && i < view->angles->count; i++) {
        if (ui_id(view->names[i]) == held) return true;
    }
    return false;
}

/// Its scale, which stays while a point is dragged; and where its points are.
static void lay_out(struct inspection *in, struct ramp_view *view)
{
    double *scale = in->inspector->ramp_scale[view->row->kind];
    for (int i = 0; i < view->angles->count; i++) snprintf(view->names[i], NAME, "%s.point.%d", view->row->name, i);
    if (!is_held(view, in->ui->held)) {
        scale[0] = 0;
        scale[1] = LEAST;
        for (int i = 0; i < view->angles->count; i++) {
            scale[0] = fmin(scale[0], SPARE * view->angles->ramp[i].angle);
            scale[1] = fmax(scale[1], SPARE * view->angles->ramp[i].angle);
        }
    }
    view->low = scale[0];
    view->high = scale[1];
    for (int i = 0; i < view->angles->count; i++) {
        const struct ramp_point *point = &view->angles->ramp[i];
        view->handles[i] =
            (struct ui_handle){.name = view->names[i],
                               .hint = "Drag; double-click beside it adds a point, right-click or Del removes one",
                               .x = x_of(view, point->at),
                               .y = y_of(view, point->angle)};
    }
}

static void draw(const struct inspection *in, const struct ramp_view *view, struct rect box)
{
    struct drawlist *list = in->ui->list;
    const int count = view->angles->count;
    float line[RAMP_MAX_POINTS + 2][2] = {{view->plot.x, view->handles[0].y}};
    drawlist_rounded(list, box, 4, theme()->raised);
    drawlist_rect(list, (struct rect){view->plot.x, roundf(y_of(view, 0)), view->plot.w, 1}, theme()->grid_major);
    for (int i = 0; i < count; i++) {
        line[i + 1][0] = view->handles[i].x;
        line[i + 1][1] = view->handles[i].y;
    }
    line[count + 1][0] = view->plot.x + view->plot.w;
    line[count + 1][1] = view->handles[count - 1].y;
    drawlist_line(list, line[0], count + 2, 1.5f, theme()->accent);
    for (int i = 0; i < count; i++) {
        const float x = view->handles[i].x, y = view->handles[i].y, r = 4;
        const float diamond[4][2] = {{x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}};
        drawlist_convex(list, diamond[0], 4, theme()->accent);
    }
}

/// Puts a point between its neighbours.
static void move_point(struct angles *angles, int i, struct ramp_point point)
{
    const double low = i > 0 ? angles->ramp[i - 1].at + APART : 0;
    const double high = i + 1 < angles->count ? angles->ramp[i + 1].at - APART : 1;
    angles->ramp[i] = (struct ramp_point){fmin(fmax(point.at, low), high), point.angle};
}

static void change_point(struct inspection *in, const struct ramp_view *view, enum ui_change change, int which)
{
    const struct ui_handle *handle = &view->handles[which];
    struct angles next = *view->angles;
    struct ramp_point point = point_at(view, handle->x, handle->y);
    if (change == UI_NUDGE) {
        point = next.ramp[which];
        point.at += handle->step_x / PLACES;
        point.angle += handle->step_y * view->row->step;
    }
    move_point(&next, which, point);
    const struct edit edit = inspector_angles_edit(in, view->row, &next);
    inspector_change(in, change, view->row->undo, handle->name, &edit);
}

static void add_point(struct inspection *in, const struct ramp_view *view, struct ramp_point point)
{
    struct angles next = *view->angles;
    int i = 0;
    while (i < next.count && next.ramp[i].at < point.at) i++;
    const bool close =
        (i > 0 && point.at - next.ramp[i - 1].at < APART) || (i < next.count && next.ramp[i].at - point.at < APART);
    if (close || next.count == RAMP_MAX_POINTS) return;
    for (int k = next.count++; k > i; k--) next.ramp[k] = next.ramp[k - 1];
    next.ramp[i] = point;
    const struct edit edit = inspector_angles_edit(in, view->row, &next);
    core_step(in->core, in->world, "Add point", 0, &edit);
}

static void remove_point(struct inspection *in, const struct ramp_view *view, int which)
{
    struct angles next = *view->angles;
    if (next.count <= 2) {
        core_message(in->core, false, "A ramp needs at least two points.");
        return;
    }
    next.count--;
    for (int k = which; k < next.count; k++) next.ramp[k] = next.ramp[k + 1];
    const struct edit edit = inspector_angles_edit(in, view->row, &next);
    core_step(in->core, in->world, "Remove point", 0, &edit);
}

/// The point that the event is to remove: under a right click, or that has the focus when Del is pressed; −1: none.
static int removed_point(const struct inspection *in, const struct ramp_view *view, struct rect box)
{
    const struct event *event = in->ui->event;
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS &&
                     (event->key == KEY_DELETE || event->key == KEY_BACKSPACE);
    const bool click = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS &&
                       event->button == BUTTON_RIGHT && ui_hovered(in->ui, box);
    for (int i = 0; i < view->angles->count; i++) {
        const struct ui_handle *handle = &view->handles[i];
        if (key && in->ui->focus == ui_id(handle->name)) return i;
        if (click && hypotf(event->x - handle->x, event->y - handle->y) < REACH) return i;
    }
    return -1;
}

/// What adds and removes points; a press on one also gives it the focus, so that arrows and Del mean it.
static void take_event(struct inspection *in, const struct ramp_view *view, struct rect box)
{
    struct ui *ui = in->ui;
    const struct event *event = ui->event;
    const bool press = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS && event->button == BUTTON_LEFT;
    if (press && is_held(view, ui->held)) ui->focus = ui->held;
    if (ui->used) return;
    const int removed = removed_point(in, view, box);
    const bool adds = press && event->clicks == 2 && ui_hovered(ui, box);
    if (removed < 0 && !adds) return;
    ui->used = true;
    if (adds) {
        add_point(in, view, point_at(view, event->x, event->y));
    } else {
        remove_point(in, view, removed);
    }
}

void inspector_ramp(struct inspection *in, const struct angle_row *row, const struct angles *angles)
{
    struct ui *ui = in->ui;
    struct rect line = ui_row(ui, HEIGHT), box = {line.x, line.y + 2, line.w, line.h - 6};
    struct ramp_view view = {.row = row, .angles = angles, .plot = rect_inset(box, INSET)};
    int which = 0;
    lay_out(in, &view);
    ui_hint(ui, box, "From the first joint to the tip; double-click adds a point");
    if (ui->pass == UI_PASS_DRAW) draw(in, &view, box);
    const enum ui_change change = ui_handles(ui, box, view.handles, angles->count, &which);
    if (change != UI_NONE) {
        change_point(in, &view, change, which);
    } else if (ui->pass == UI_PASS_EVENT) {
        take_event(in, &view, box);
    }
}

struct angles inspector_as_ramp(const struct angles *angles, enum angle_kind kind, int joints)
{
    struct angles ramp = {.form = ANGLES_RAMP, .count = 2};
    for (int i = 0; i < 2; i++) {
        const int joint = i * (joints - 1);
        const double angle = kind == ANGLE_LAG ? angles_lag(angles, joint, joints) : angles_at(angles, joint, joints);
        ramp.ramp[i] = (struct ramp_point){i, angle};
    }
    return ramp;
}
