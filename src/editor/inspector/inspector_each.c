/// Angles of each joint in the inspector: a curve that is drawn by dragging over it, and a field for the joint that was touched last.
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stdio.h>

enum { HEIGHT = 64, INSET = 7, NAME = 32 }; ///< pixels

static const double SPARE = 1.2, LEAST = 10; ///< above the largest angle; degrees

/// The angles as they are laid out.
struct each_view {
    const struct angle_row *row;
    const struct angles *angles;
    struct rect plot;
    double low, high; ///< degrees at its bottom and top
    int joint;        ///< the selected one
    char name[NAME];  ///< of the curve
};

static float x_of(const struct each_view *view, int joint)
{
    const int last = view->angles->count - 1;
    return view->plot.x + view->plot.w * (last > 0 ? (float)joint / (float)last : 0.5f);
}

static float y_of(const struct each_view *view, double angle)
{
    return view->plot.y + view->plot.h * (float)((view->high - angle) / (view->high - view->low));
}

static int joint_at(const struct each_view *view, float x)
{
    const int last = view->angles->count - 1;
    const float joint = roundf((x - view->plot.x) / view->plot.w * (float)last);
    return (int)fminf(fmaxf(joint, 0), (float)last);
}

static double angle_at(const struct each_view *view, float y)
{
    const double share = (double)((y - view->plot.y) / view->plot.h);
    return core_round(view->high - share * (view->high - view->low), view->row->step / 5);
}

/// Its scale, which stays while it is drawn.
static struct each_view lay_out(struct inspection *in, const struct angle_row *row, const struct angles *angles,
                                struct rect box)
{
    struct each_view view = {.row = row, .angles = angles, .plot = rect_inset(box, INSET)};
    double *scale = in->inspector->ramp_scale[row->kind];
    int *joint = &in->inspector->joint[row->kind];
    snprintf(view.name, NAME, "%s.curve", row->name);
    if (in->ui->held != ui_id(view.name)) {
        scale[0] = 0;
        scale[1] = LEAST;
        for (int n = 0; n < angles->count; n++) {
            scale[0] = fmin(scale[0], SPARE * angles->value[n]);
            scale[1] = fmax(scale[1], SPARE * angles->value[n]);
        }
    }
    view.low = scale[0];
    view.high = scale[1];
    if (*joint >= angles->count) *joint = angles->count - 1;
    view.joint = *joint;
    return view;
}

static void draw(const struct inspection *in, const struct each_view *view, struct rect box)
{
    struct drawlist *list = in->ui->list;
    const int count = view->angles->count;
    float line[ANGLES_MAX_JOINTS][2];
    drawlist_rounded(list, box, 4, theme()->raised);
    drawlist_rect(list, (struct rect){view->plot.x, roundf(y_of(view, 0)), view->plot.w, 1}, theme()->grid_major);
    for (int n = 0; n < count; n++) {
        line[n][0] = x_of(view, n);
        line[n][1] = y_of(view, view->angles->value[n]);
        drawlist_rect(list, (struct rect){line[n][0] - 1.5f, line[n][1] - 1.5f, 3, 3}, theme()->accent);
    }
    drawlist_line(list, line[0], count, 1.5f, theme()->accent);
    const float *selected = line[view->joint], r = 3.5f;
    drawlist_rounded(list, (struct rect){selected[0] - r, selected[1] - r, 2 * r, 2 * r}, r, theme()->accent);
}

/// A press takes the joint below it, from where the drag draws.
static void take_press(struct inspection *in, const struct each_view *view, struct rect box, struct ui_handle *handle)
{
    const struct event *event = in->ui->event;
    const bool press = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS && event->button == BUTTON_LEFT;
    if (!press || in->ui->used || in->ui->held || !ui_hovered(in->ui, box)) return;
    in->inspector->joint[view->row->kind] = joint_at(view, event->x);
    in->inspector->drawn = *view->angles;
    in->inspector->drawn_x = handle->x = event->x;
    in->inspector->drawn_y = handle->y = event->y;
}

/// All joints between the last place and this one come to lie on the line between both.
static void draw_to(struct inspector *inspector, const struct each_view *view, const struct ui_handle *handle)
{
    const int from = joint_at(view, inspector->drawn_x), to = joint_at(view, handle->x), way = to >= from ? 1 : -1;
    for (int n = from;; n += way) {
        const float share = to == from ? 1 : (float)(n - from) / (float)(to - from);
        const float y = inspector->drawn_y + share * (handle->y - inspector->drawn_y);
        inspector->drawn.value[n] = angle_at(view, y);
        if (n == to) break;
    }
    inspector->drawn_x = handle->x;
    inspector->drawn_y = handle->y;
    inspector->joint[view->row->kind] = to;
}

/// ← and → go along the joints, ↑ and ↓ change one.
static void nudge(struct inspection *in, const struct each_view *view, const struct ui_handle *handle)
{
    const int last = view->angles->count - 1, next = view->joint + handle->step_x;
    in->inspector->joint[view->row->kind] = next < 0 ? 0 : next > last ? last : next;
    if (handle->step_y == 0) return;
    struct angles angles = *view->angles;
    char what[NAME];
    snprintf(what, NAME, "%s.joint.%d", view->row->name, view->joint);
    angles.value[view->joint] += handle->step_y * view->row->step;
    const struct edit edit = inspector_angles_edit(in, view->row, &angles);
    inspector_change(in, UI_NUDGE, view->row->undo, what, &edit);
}

static void build_curve(struct inspection *in, const struct each_view *view, struct rect box)
{
    struct ui *ui = in->ui;
    struct ui_handle handle = {.name = view->name,
                               .hint = "Drag over the joints to draw their angles; a click selects one",
                               .x = x_of(view, view->joint),
                               .y = y_of(view, view->angles->value[view->joint])};
    int which;
    ui_hint(ui, box, handle.hint);
    if (ui->pass == UI_PASS_DRAW) draw(in, view, box);
    if (ui->pass == UI_PASS_EVENT) take_press(in, view, box, &handle);
    const enum ui_change change = ui_handles(ui, box, &handle, 1, &which);
    if (ui->held == ui_id(view->name)) ui->focus = ui->held; // so that arrows mean what was pressed
    if (change == UI_NUDGE) {
        nudge(in, view, &handle);
    } else if (change != UI_NONE) {
        if (change == UI_DRAG) draw_to(in->inspector, view, &handle);
        const struct edit edit = inspector_angles_edit(in, view->row, &in->inspector->drawn);
        inspector_change(in, change, view->row->undo, view->name, &edit);
    }
}

/// The selected joint's number.
static void build_joint(struct inspection *in, const struct angle_row *row, const struct angles *angles)
{
    const int joint = in->inspector->joint[row->kind];
    char name[NAME], label[NAME];
    snprintf(name, NAME, "%s.joint", row->name);
    snprintf(label, NAME, "joint %d", joint + 1);
    const struct ui_number number = {.name = name,
                                     .label = label,
                                     .unit = inspector_angle_unit(in, row),
                                     .hint = "Angle of the joint that was touched last in the curve above",
                                     .lowest = -36000,
                                     .highest = 36000,
                                     .fallback = NAN,
                                     .step = row->step,
                                     .decimals = 1};
    struct angles next = *angles;
    const enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &next.value[joint]);
    const struct edit edit = inspector_angles_edit(in, row, &next);
    inspector_change(in, change, row->undo, name, &edit);
}

void inspector_each(struct inspection *in, const struct angle_row *row, const struct angles *angles)
{
    const struct rect line = ui_row(in->ui, HEIGHT), box = {line.x, line.y + 2, line.w, line.h - 6};
    const struct each_view view = lay_out(in, row, angles, box);
    build_curve(in, &view, box);
    build_joint(in, row, angles);
}
