/// Angles in the inspector: one for all joints as a slider; several as a slider that scales them and a curve, of a few points that are
/// dragged (a ramp) or of each joint, drawn by dragging over it.
#include "base/error.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/parts.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SWITCH = 24, MOST_REACH = 1024 }; ///< width of a button for a form

const struct angle_row angle_row_lag = {
    ANGLE_LAG, "lag", "How far each joint lags behind the last, in degrees of swing (hold L and press ↑ ↓)",
    "Set lag", 0,     30,
    6.5,       0.5};
const struct angle_row angle_row_gain = {
    ANGLE_GAIN, "gain", "How far each joint bends when the spline is 1", "Set gain", 0, 20, 5, 0.5};
const struct angle_row angle_row_rest = {
    ANGLE_REST, "rest", "Upward bend of each joint at rest", "Set rest pose", -15, 15, 0, 0.5};

/// Which of them is the largest: what a slider shows and sets where there are several.
static int peak(const struct angles *angles)
{
    int found = 0;
    for (int i = 1; i < angles_count(angles); i++) {
        if (fabs(angles_number(angles, i)) > fabs(angles_number(angles, found))) found = i;
    }
    return found;
}

/// All angles in proportion, so that the largest becomes `value`.
static void scale_angles(struct angles *angles, double value)
{
    const int largest = peak(angles);
    const double before = angles_number(angles, largest);
    for (int i = 0; i < angles_count(angles); i++) {
        const double scaled = before == 0 ? value : angles_number(angles, i) * (value / before);
        angles_set_number(angles, i, i == largest ? value : scaled);
    }
}

static bool set_angles(struct inspector *in, const struct angle_row *row, const struct angles *angles,
                       struct error *error)
{
    const int channel = row->kind == ANGLE_REST ? -1 : in->channel;
    return edit_angles(in->core->document, (struct channel_place){in->rig, channel}, row->kind, angles, error);
}

bool inspector_set_angles(struct inspector *in, const struct angle_row *row, const struct angles *angles)
{
    return set_angles(in, row, angles, &in->core->error);
}

/// The same as a step of its own.
static void step_angles(struct inspector *in, const struct angle_row *row, const char *label,
                        const struct angles *angles)
{
    if (core_begin(in->core, label, 0)) core_end(in->core, inspector_set_angles(in, row, angles));
}

/// The same as what a widget's change is.
static void change_angles(struct inspector *in, const struct angle_row *row, enum ui_change change, const char *what,
                          const struct angles *angles)
{
    if (inspector_begin(in, change, row->undo, what))
        inspector_end(in, change, inspector_set_angles(in, row, angles));
}

/// What its numbers are in: the gain of what moves the body may be in percent.
static const char *unit_of(const struct inspector *in, const struct angle_row *row)
{
    return row->kind == ANGLE_GAIN ? axis_unit(inspector_felt_channel(in)->axis) : "°";
}

/// By how much a slider's ends are taken further out, so that it has the angle on it; the same as long as it is dragged.
static double reach_of(struct inspector *in, const struct angle_row *row, double angle)
{
    double *reach = &in->angle_reach[row->kind];
    if (*reach >= 1 && in->ui.held == ui_id(row->name)) return *reach;
    *reach = 1;
    while (fabs(angle) > *reach * row->maximum && *reach < MOST_REACH) *reach *= 2;
    return *reach;
}

/// The angles of a row, as the document has them now.
static const struct angles *angles_of(const struct inspector *in, const struct angle_row *row)
{
    const struct rig *rig = inspector_shown(in);
    if (row->kind == ANGLE_REST) return &rig->tail.rest;
    const struct channel *channel = &rig->bent.channels[in->channel];
    return row->kind == ANGLE_LAG ? &channel->lag : &channel->gain;
}

static const struct angle_row *const angle_rows[] = {
    [ANGLE_REST] = &angle_row_rest, [ANGLE_LAG] = &angle_row_lag, [ANGLE_GAIN] = &angle_row_gain};

/// The largest of them is what the slider shows.
static double get_largest(const struct inspector *in, int kind)
{
    const struct angles *angles = angles_of(in, angle_rows[kind]);
    return angles_number(angles, peak(angles));
}

static bool set_largest(struct inspector *in, int kind, double number, struct error *error)
{
    struct angles next = *angles_of(in, angle_rows[kind]);
    scale_angles(&next, number);
    return set_angles(in, angle_rows[kind], &next, error);
}

/// Of several, the first one and the last one.
static const char *show_ends(const struct inspector *in, int kind, char text[64])
{
    const struct angles *angles = angles_of(in, angle_rows[kind]);
    if (angles->form == ANGLES_ONE) return NULL;
    snprintf(text, 64, "%.1f → %.1f%s", printable_number(angles_number(angles, 0), 0.1),
             printable_number(angles_number(angles, angles->count - 1), 0.1), unit_of(in, angle_rows[kind]));
    return text;
}

static void build_slider(struct inspector *in, const struct angle_row *row, const struct angles *angles,
                         struct rect r)
{
    static const struct number_home home = {.get = get_largest, .set = set_largest, .shown = show_ends};
    const bool several = angles->form != ANGLES_ONE;
    bool lags = row->kind == ANGLE_LAG && several; // each joint's own lag: up to a few turns, not degrees a joint
    const double reach = lags ? 1 : reach_of(in, row, get_largest(in, (int)row->kind));
    const struct number_row number = {.name = row->name,
                                      .label = row->name,
                                      .unit = unit_of(in, row),
                                      .hint = row->hint,
                                      .undo = row->undo,
                                      .minimum = reach * row->minimum,
                                      .maximum = lags ? 720 : reach * row->maximum,
                                      .lowest = -36000,
                                      .highest = 36000,
                                      .fallback = several ? NAN : row->fallback,
                                      .step = row->step,
                                      .decimals = 1};
    inspector_number(in, &number, &home, (int)row->kind, r);
}

/// An angle for each joint, as they are now.
static struct angles each_angle(const struct angles *angles, enum angle_kind kind, int joints)
{
    struct angles next = {.form = ANGLES_EACH, .count = joints};
    for (int n = 0; n < joints; n++)
        next.value[n] = kind == ANGLE_LAG ? angles_lag(angles, n, joints) : angles_at(angles, n, joints);
    return next;
}

/// One angle for all, with as little change of the pose as there can be: their mean, or the last one's lag shared out.
static struct angles one_angle(const struct angles *angles, enum angle_kind kind, int joints)
{
    double sum = 0;
    for (int n = 0; n < joints; n++) sum += angles_at(angles, n, joints);
    const double last = angles_at(angles, joints - 1, joints);
    const double one = kind != ANGLE_LAG ? sum / joints : joints > 1 ? last / (joints - 1) : 0;
    return (struct angles){.form = ANGLES_ONE, .value = {round(one * 1e4) / 1e4}};
}

/// The button at the right end of a row that makes its angles of a form, or one for all joints where they have it already; true if it
/// changed them.
static bool build_switch(struct inspector *in, const struct angle_row *row, const struct angles *angles,
                         const struct angles *next, struct rect r)
{
    const bool ramp = next->form == ANGLES_RAMP, lit = angles->form == next->form;
    char name[32];
    snprintf(name, sizeof name, "%s.%s", row->name, ramp ? "ramp" : "each");
    const char *hint = lit    ? "Back to one angle for all joints"
                       : ramp ? "Draw the angles along the joints as a curve through a few points"
                              : "Give each joint an angle of its own";
    if (!ui_icon_button(&in->ui, r, name, ramp ? UI_ICON_RAMP : UI_ICON_EACH, lit, hint)) return false;
    const int joints = bones_joints(in->core, in->rig);
    const struct angles one = one_angle(angles, row->kind, joints);
    step_angles(in, row, row->undo, lit ? &one : next);
    return true;
}

enum { HEIGHT = 64, INSET = 7, NAME = 32, REACH = 11 }; ///< pixels; REACH: of a right click from its point

/// A ramp as it is laid out.
struct ramp_view {
    const struct angle_row *row;
    const struct angles *angles;
    struct rect plot;
    double low, high; ///< degrees at its bottom and top
    char names[RAMP_MAX_POINTS][NAME];
    struct ui_handle handles[RAMP_MAX_POINTS];
};

static const double APART = 0.01;                          ///< between places of neighbouring points
static const double PLACES = 100, SPARE = 1.2, LEAST = 10; ///< places in all; above the largest angle; degrees

static float x_of(const struct ramp_view *view, double at) { return view->plot.x + (float)at * view->plot.w; }

static float y_of(const struct ramp_view *view, double angle)
{
    const struct rect *plot = &view->plot;
    return plot->y + plot->h * (float)((view->high - angle) / (view->high - view->low));
}

static bool is_held(const struct ramp_view *view, uint32_t held)
{
    for (int i = 0; held && i < view->angles->count; i++) {
        if (ui_id(view->names[i]) == held) return true;
    }
    return false;
}

/// Its scale, which stays while a point is dragged; and where its points are.
static void lay_out(struct inspector *in, struct ramp_view *view)
{
    double *scale = in->ramp_scale[view->row->kind];
    for (int i = 0; i < view->angles->count; i++) snprintf(view->names[i], NAME, "%s.point.%d", view->row->name, i);
    if (!is_held(view, in->ui.held)) {
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

static void draw(const struct inspector *in, const struct ramp_view *view, struct rect box)
{
    struct drawlist *list = in->ui.list;
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

/// The point that a place of the plot stands for.
static struct ramp_point point_at(const struct ramp_view *view, float x, float y)
{
    const double at = (double)((x - view->plot.x) / view->plot.w),
                 share = (double)((y - view->plot.y) / view->plot.h);
    const double angle = view->high - share * (view->high - view->low);
    return (struct ramp_point){round(fmin(fmax(at, 0), 1) * PLACES) / PLACES, core_round(angle, view->row->step / 5)};
}

/// Puts a point between its neighbours.
static void move_point(struct angles *angles, int i, struct ramp_point point)
{
    const double low = i > 0 ? angles->ramp[i - 1].at + APART : 0;
    const double high = i + 1 < angles->count ? angles->ramp[i + 1].at - APART : 1;
    angles->ramp[i] = (struct ramp_point){fmin(fmax(point.at, low), high), point.angle};
}

static void change_point(struct inspector *in, const struct ramp_view *view, enum ui_change change, int which)
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
    change_angles(in, view->row, change, handle->name, &next);
}

static void add_point(struct inspector *in, const struct ramp_view *view, struct ramp_point point)
{
    struct angles next = *view->angles;
    int i = 0;
    while (i < next.count && next.ramp[i].at < point.at) i++;
    const bool close =
        (i > 0 && point.at - next.ramp[i - 1].at < APART) || (i < next.count && next.ramp[i].at - point.at < APART);
    if (close || next.count == RAMP_MAX_POINTS) return;
    for (int k = next.count++; k > i; k--) next.ramp[k] = next.ramp[k - 1];
    next.ramp[i] = point;
    step_angles(in, view->row, "Add point", &next);
}

static void remove_point(struct inspector *in, const struct ramp_view *view, int which)
{
    struct angles next = *view->angles;
    if (next.count <= 2) {
        core_message(in->core, false, "A ramp needs at least two points.");
        return;
    }
    next.count--;
    for (int k = which; k < next.count; k++) next.ramp[k] = next.ramp[k + 1];
    step_angles(in, view->row, "Remove point", &next);
}

/// The point that the event is to remove: under a right click, or that has the focus when Del is pressed; −1: none.
static int removed_point(const struct inspector *in, const struct ramp_view *view, struct rect box)
{
    const struct event *event = in->ui.event;
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS &&
                     (event->key == KEY_DELETE || event->key == KEY_BACKSPACE);
    const bool click = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS &&
                       event->button == BUTTON_RIGHT && ui_hovered(&in->ui, box);
    for (int i = 0; i < view->angles->count; i++) {
        const struct ui_handle *handle = &view->handles[i];
        if (key && in->ui.focus == ui_id(handle->name)) return i;
        if (click && hypotf(event->x - handle->x, event->y - handle->y) < REACH) return i;
    }
    return -1;
}

/// What adds and removes points; a press on one also gives it the focus, so that arrows and Del mean it.
static void take_event(struct inspector *in, const struct ramp_view *view, struct rect box)
{
    struct ui *ui = &in->ui;
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

/// Below the row of a ramp: its curve.
static void build_ramp_row(struct inspector *in, const struct angle_row *row, const struct angles *angles)
{
    struct ui *ui = &in->ui;
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

/// A ramp of two points from the first joint's angle to the last one's.
static struct angles as_ramp(const struct angles *angles, enum angle_kind kind, int joints)
{
    struct angles ramp = {.form = ANGLES_RAMP, .count = 2};
    for (int i = 0; i < 2; i++) {
        const int joint = i * (joints - 1);
        const double angle = kind == ANGLE_LAG ? angles_lag(angles, joint, joints) : angles_at(angles, joint, joints);
        ramp.ramp[i] = (struct ramp_point){i, angle};
    }
    return ramp;
}

/// The angles as they are laid out.
struct each_view {
    const struct angle_row *row;
    const struct angles *angles;
    struct rect plot;
    double low, high; ///< degrees at its bottom and top
    int joint;        ///< the selected one
    char name[NAME];  ///< of the curve
};

/// Its scale, which stays while it is drawn.
static struct each_view each_lay_out(struct inspector *in, const struct angle_row *row, const struct angles *angles,
                                     struct rect box)
{
    struct each_view view = {.row = row, .angles = angles, .plot = rect_inset(box, INSET)};
    double *scale = in->ramp_scale[row->kind];
    int *joint = &in->joint[row->kind];
    snprintf(view.name, NAME, "%s.curve", row->name);
    if (in->ui.held != ui_id(view.name)) {
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

static float each_x_of(const struct each_view *view, int joint)
{
    const int last = view->angles->count - 1;
    return view->plot.x + view->plot.w * (last > 0 ? (float)joint / (float)last : 0.5f);
}

static float each_y_of(const struct each_view *view, double angle)
{
    return view->plot.y + view->plot.h * (float)((view->high - angle) / (view->high - view->low));
}

static void each_draw(const struct inspector *in, const struct each_view *view, struct rect box)
{
    struct drawlist *list = in->ui.list;
    const int count = view->angles->count;
    float line[ANGLES_MAX_JOINTS][2];
    drawlist_rounded(list, box, 4, theme()->raised);
    drawlist_rect(list, (struct rect){view->plot.x, roundf(each_y_of(view, 0)), view->plot.w, 1},
                  theme()->grid_major);
    for (int n = 0; n < count; n++) {
        line[n][0] = each_x_of(view, n);
        line[n][1] = each_y_of(view, view->angles->value[n]);
        drawlist_rect(list, (struct rect){line[n][0] - 1.5f, line[n][1] - 1.5f, 3, 3}, theme()->accent);
    }
    drawlist_line(list, line[0], count, 1.5f, theme()->accent);
    const float *selected = line[view->joint], r = 3.5f;
    drawlist_rounded(list, (struct rect){selected[0] - r, selected[1] - r, 2 * r, 2 * r}, r, theme()->accent);
}

static int joint_at(const struct each_view *view, float x)
{
    const int last = view->angles->count - 1;
    const float joint = roundf((x - view->plot.x) / view->plot.w * (float)last);
    return (int)fminf(fmaxf(joint, 0), (float)last);
}

/// A press takes the joint below it, from where the drag draws.
static void take_press(struct inspector *in, const struct each_view *view, struct rect box, struct ui_handle *handle)
{
    const struct event *event = in->ui.event;
    const bool press = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS && event->button == BUTTON_LEFT;
    if (!press || in->ui.used || in->ui.held || !ui_hovered(&in->ui, box)) return;
    in->joint[view->row->kind] = joint_at(view, event->x);
    in->drawn = *view->angles;
    in->drawn_x = handle->x = event->x;
    in->drawn_y = handle->y = event->y;
}

static double angle_at(const struct each_view *view, float y)
{
    const double share = (double)((y - view->plot.y) / view->plot.h);
    return core_round(view->high - share * (view->high - view->low), view->row->step / 5);
}

/// All joints between the last place and this one come to lie on the line between both.
static void draw_to(struct inspector *in, const struct each_view *view, const struct ui_handle *handle)
{
    const int from = joint_at(view, in->drawn_x), to = joint_at(view, handle->x), way = to >= from ? 1 : -1;
    for (int n = from;; n += way) {
        const float share = to == from ? 1 : (float)(n - from) / (float)(to - from);
        const float y = in->drawn_y + share * (handle->y - in->drawn_y);
        in->drawn.value[n] = angle_at(view, y);
        if (n == to) break;
    }
    in->drawn_x = handle->x;
    in->drawn_y = handle->y;
    in->joint[view->row->kind] = to;
}

/// ← and → go along the joints, ↑ and ↓ change one.
static void nudge(struct inspector *in, const struct each_view *view, const struct ui_handle *handle)
{
    const int last = view->angles->count - 1, next = view->joint + handle->step_x;
    in->joint[view->row->kind] = next < 0 ? 0 : next > last ? last : next;
    if (handle->step_y == 0) return;
    struct angles angles = *view->angles;
    char what[NAME];
    snprintf(what, NAME, "%s.joint.%d", view->row->name, view->joint);
    angles.value[view->joint] += handle->step_y * view->row->step;
    change_angles(in, view->row, UI_NUDGE, what, &angles);
}

static void build_curve(struct inspector *in, const struct each_view *view, struct rect box)
{
    struct ui *ui = &in->ui;
    struct ui_handle handle = {.name = view->name,
                               .hint = "Drag over the joints to draw their angles; a click selects one",
                               .x = each_x_of(view, view->joint),
                               .y = each_y_of(view, view->angles->value[view->joint])};
    int which;
    ui_hint(ui, box, handle.hint);
    if (ui->pass == UI_PASS_DRAW) each_draw(in, view, box);
    if (ui->pass == UI_PASS_EVENT) take_press(in, view, box, &handle);
    const enum ui_change change = ui_handles(ui, box, &handle, 1, &which);
    if (ui->held == ui_id(view->name)) ui->focus = ui->held; // so that arrows mean what was pressed
    if (change == UI_NUDGE) {
        nudge(in, view, &handle);
    } else if (change != UI_NONE) {
        if (change == UI_DRAG) draw_to(in, view, &handle);
        change_angles(in, view->row, change, view->name, &in->drawn);
    }
}

/// The number of the joint that is selected.
static double get_joint(const struct inspector *in, int kind)
{
    return angles_of(in, angle_rows[kind])->value[in->joint[kind]];
}

static bool set_joint(struct inspector *in, int kind, double number, struct error *error)
{
    struct angles next = *angles_of(in, angle_rows[kind]);
    next.value[in->joint[kind]] = number;
    return set_angles(in, angle_rows[kind], &next, error);
}

static void build_joint(struct inspector *in, const struct angle_row *row)
{
    static const struct number_home home = {.get = get_joint, .set = set_joint};
    char name[NAME], label[NAME];
    snprintf(name, NAME, "%s.joint", row->name);
    snprintf(label, NAME, "joint %d", in->joint[row->kind] + 1);
    const struct number_row number = {.name = name,
                                      .label = label,
                                      .unit = unit_of(in, row),
                                      .hint = "Angle of the joint that was touched last in the curve above",
                                      .undo = row->undo,
                                      .lowest = -36000,
                                      .highest = 36000,
                                      .fallback = NAN,
                                      .step = row->step,
                                      .decimals = 1};
    inspector_number(in, &number, &home, (int)row->kind, ui_row(&in->ui, UI_ROW));
}

/// Below the row of angles of each joint: their curve, and the number of one.
static void build_each_row(struct inspector *in, const struct angle_row *row, const struct angles *angles)
{
    const struct rect line = ui_row(&in->ui, HEIGHT), box = {line.x, line.y + 2, line.w, line.h - 6};
    const struct each_view view = each_lay_out(in, row, angles, box);
    build_curve(in, &view, box);
    build_joint(in, row);
}

void inspector_angles(struct inspector *in, const struct angle_row *row, const struct angles *angles)
{
    const int joints = bones_joints(in->core, in->rig);
    struct rect r = ui_row(&in->ui, UI_ROW), right = {r.x + r.w - SWITCH, r.y, SWITCH, r.h}, left = right;
    left.x -= SWITCH;
    build_slider(in, row, angles, (struct rect){r.x, r.y, left.x - r.x - 2, r.h});
    angles = angles_of(in, row);
    const struct angles ramp = as_ramp(angles, row->kind, joints), each = each_angle(angles, row->kind, joints);
    if (build_switch(in, row, angles, &ramp, left) || build_switch(in, row, angles, &each, right)) return;
    const struct angles now = *angles; // an edit may free them while they are shown
    if (now.form == ANGLES_RAMP) build_ramp_row(in, row, &now);
    if (now.form == ANGLES_EACH) build_each_row(in, row, &now);
}
