/// Angles in the inspector. One angle for all joints is a slider. Several are a slider that scales them and a curve below it: a ramp with
/// draggable points, or one angle per joint, drawn by dragging.
#include "base/error.h"
#include "editor/core/core.h"
#include "editor/inspector/state.h"
#include "maths/maths.h"
#include <math.h>
#include <stdio.h>

enum { SWITCH = 24, MOST_REACH = 1024 }; ///< pixels: width of a form button

static const struct number_row rows[] = {
    [ANGLE_REST] = {.undo = "Set rest pose",
                    .ui = {NAMED("rest", "rest"), BAR(-15, 15), DEGREES, .hint = "Upward bend of each joint at rest",
                           .step = 0.5, .decimals = 1}},
    [ANGLE_LAG] = {.undo = "Set lag",
                   .ui = {NAMED("lag", "lag"), BAR(0, 30), DEGREES,
                          .hint =
                              "How far each joint lags behind the last, in degrees of swing (hold L and press ↑ ↓)",
                          .fallback = 6.5, .step = 0.5, .decimals = 1}},
    [ANGLE_GAIN] = {.undo = "Set gain",
                    .ui = {NAMED("gain", "gain"), BAR(0, 20), DEGREES,
                           .hint = "How far each joint bends when the spline is 1", .fallback = 5, .step = 0.5,
                           .decimals = 1}},
};

static bool set_angles(struct inspector *in, enum angle_kind kind, const struct angles *angles, struct error *error)
{
    const int channel = kind == ANGLE_REST ? -1 : in->channel;
    return edit_angles(in->core->document, (struct channel_place){in->rig, channel}, kind, angles, error);
}

/// As an undo step.
static void change_angles(struct inspector *in, enum angle_kind kind, enum ui_change change, const char *label,
                          const char *what, const struct angles *angles)
{
    if (inspector_step(in, change, label, what)) set_angles(in, kind, angles, &in->core->step.error);
}

/// The shown angles, or if `kept` those before; NULL: none.
static const struct angles *angles_of(const struct inspector *in, int kind, bool kept)
{
    int count = 0;
    const struct rig *rig = kept ? take_rig(in->core, in->rig) : inspector_shown(in);
    const struct channel *channels = rig ? rig_channels(rig, &count) : NULL;
    if (rig && kind == ANGLE_REST) return &rig->tail.rest;
    if (in->channel >= count) return NULL;
    const struct channel *channel = &channels[in->channel];
    if (kept && channel->spline != take_spline(in->core, in->core->focus.active)) return NULL;
    return kind == ANGLE_LAG ? &channel->lag : &channel->gain;
}

/// Gains of channels that move the body may be in percent.
static const char *unit_of(const struct inspector *in, int kind)
{
    return kind == ANGLE_GAIN ? axis_unit(inspector_felt_channel(in)->axis) : rows[kind].ui.unit;
}

/// The largest of several angles; the first and last of them as text.
static double get_largest(const struct inspector *in, int kind, bool kept, char text[64])
{
    const struct angles *angles = angles_of(in, kind, kept);
    if (!angles) return NAN;
    if (angles->form != ANGLES_ONE)
        snprintf(text, 64, "%.1f → %.1f%s", printable_number(angles_number(angles, 0), 0.1),
                 printable_number(angles_number(angles, angles->count - 1), 0.1), unit_of(in, kind));
    return angles_largest(angles);
}

static bool set_largest(struct inspector *in, int kind, double number, struct error *error)
{
    struct angles next = *angles_of(in, kind, false);
    angles_scale(&next, number);
    if (kind != ANGLE_LAG) return set_angles(in, (enum angle_kind)kind, &next, error);
    return core_set_lag(in->core, inspector_limb(in), (struct channel_place){in->rig, in->channel}, &next, error);
}

/// The button at the right end of a row switches to a form, or back to one angle for all; true if pressed.
static bool build_switch(struct inspector *in, enum angle_kind kind, const struct angles *angles,
                         const struct angles *next, struct rect r)
{
    const bool ramp = next->form == ANGLES_RAMP, lit = angles->form == next->form;
    char name[32];
    snprintf(name, sizeof name, "%s.%s", rows[kind].ui.name, ramp ? "ramp" : "each");
    const char *hint = lit    ? "Use one angle for all joints"
                       : ramp ? "Draw the angles along the joints as a curve through a few points"
                              : "Give each joint an angle of its own";
    const struct row form = {ICON(name, ramp ? UI_ICON_RAMP : UI_ICON_EACH), .lit = lit, .hint = hint,
                             .undo = rows[kind].undo};
    if (!inspector_icon(in, r, &form)) return false;
    // The one angle that changes the pose least: the mean, or for lags the last one divided evenly.
    const int joints = bones_joints(in->core, in->rig);
    double sum = 0;
    for (int n = 0; n < joints; n++) sum += angles_at(angles, n, joints);
    const double last = angles_at(angles, joints - 1, joints);
    const double mean = kind != ANGLE_LAG ? sum / joints : joints > 1 ? last / (joints - 1) : 0;
    const struct angles one = {.form = ANGLES_ONE, .value = {round(mean * 1e4) / 1e4}};
    set_angles(in, kind, lit ? &one : next, &in->core->step.error);
    return true;
}

enum { HEIGHT = 64, INSET = 7, NAME = 32, REACH = 11 }; ///< pixels; REACH: of a right click around a point

/// Layout of the curve. A ramp has a handle at each point, per-joint angles one at the selected joint.
struct angle_view {
    enum angle_kind kind;
    const struct angles *angles;
    struct rect box, plot;
    double low, high; ///< degrees at the bottom and top
    int selected;     ///< joint
    int handle_count;
    char names[RAMP_MAX_POINTS][NAME];
    struct ui_handle handles[RAMP_MAX_POINTS];
};

static const double APART = 0.01; ///< least distance between points of a ramp
static const double PLACES = 100, SPARE = 1.2,
                    LEAST = 10; ///< steps along the ramp; room above the largest angle; degrees

static void place_angle(const struct angle_view *view, int i, float xy[2])
{
    const struct angles *angles = view->angles;
    const double each = angles->count > 1 ? (double)i / (angles->count - 1) : 0.5;
    const double at = angles->form == ANGLES_RAMP ? angles->ramp[i].at : each;
    xy[0] = view->plot.x + (float)at * view->plot.w;
    xy[1] = view->plot.y + view->plot.h * (float)((view->high - angles_number(angles, i)) / (view->high - view->low));
}

static double angle_at(const struct angle_view *view, float y)
{
    const double share = (double)((y - view->plot.y) / view->plot.h);
    return core_round(view->high - share * (view->high - view->low), rows[view->kind].ui.step / 5);
}

static bool is_held(const struct angle_view *view, const struct ui *ui)
{
    for (int i = 0; ui->held && i < view->handle_count; i++) {
        if (ui_id(ui, view->names[i]) == ui->held) return true;
    }
    return false;
}

/// Sets the scale, which is constant during a drag, and the handles.
static void lay_out(struct inspector *in, struct angle_view *view)
{
    const struct angles *angles = view->angles;
    const bool is_ramp = angles->form == ANGLES_RAMP;
    const struct rect line = ui_row(&in->ui, HEIGHT);
    double *scale = in->ramp_scale[view->kind];
    view->box = (struct rect){line.x, line.y + 2, line.w, line.h - 6};
    view->plot = rect_inset(view->box, INSET);
    view->selected = in->joint[view->kind];
    view->handle_count = is_ramp ? angles->count : 1;
    snprintf(view->names[0], NAME, "%s.curve", rows[view->kind].ui.name);
    for (int i = 0; is_ramp && i < angles->count; i++)
        snprintf(view->names[i], NAME, "%s.point.%d", rows[view->kind].ui.name, i);
    if (!is_held(view, &in->ui)) {
        scale[0] = 0;
        scale[1] = LEAST;
        for (int i = 0; i < angles->count; i++) {
            scale[0] = fmin(scale[0], SPARE * angles_number(angles, i));
            scale[1] = fmax(scale[1], SPARE * angles_number(angles, i));
        }
    }
    view->low = scale[0];
    view->high = scale[1];
    for (int i = 0; i < view->handle_count; i++) {
        float at[2];
        place_angle(view, is_ramp ? i : view->selected, at);
        view->handles[i] = (struct ui_handle){
            .name = view->names[i],
            .hint = is_ramp ? "Drag; double-click beside it adds a point, right-click or Del removes one"
                            : "Drag over the joints to draw their angles; a click selects one",
            .x = at[0],
            .y = at[1]};
    }
}

static struct ramp_point point_at(const struct angle_view *view, float x, float y)
{
    const double at = (double)((x - view->plot.x) / view->plot.w);
    return (struct ramp_point){round(fmin(fmax(at, 0), 1) * PLACES) / PLACES, angle_at(view, y)};
}

/// The points of a ramp. A double-click adds one; a right click or Del on a focused one removes it. A press on a point focuses it for
/// arrow keys and Del.
static void build_ramp(struct inspector *in, struct angle_view *view)
{
    struct ui *ui = &in->ui;
    struct angles next = *view->angles;
    int which = 0;
    ui_hint(ui, view->box, "From the first joint to the tip; double-click adds a point");
    const enum ui_change change = ui_handles(ui, view->box, view->handles, view->handle_count, &which);
    if (change != UI_NONE) {
        const struct ui_handle *handle = &view->handles[which];
        struct ramp_point point = point_at(view, handle->x, handle->y);
        if (change == UI_NUDGE) {
            point = next.ramp[which];
            point.at += handle->step_x / PLACES;
            point.angle += handle->step_y * rows[view->kind].ui.step;
        }
        const double low = which > 0 ? next.ramp[which - 1].at + APART : 0; // between its neighbours
        const double high = which + 1 < next.count ? next.ramp[which + 1].at - APART : 1;
        next.ramp[which] = (struct ramp_point){fmin(fmax(point.at, low), high), point.angle};
        change_angles(in, view->kind, change, rows[view->kind].undo, handle->name, &next);
        return;
    }
    if (ui->pass != UI_PASS_EVENT) return;
    const struct event *event = ui->event;
    const bool press = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS && event->button == BUTTON_LEFT;
    if (press && is_held(view, ui)) ui->focus = ui->held;
    if (ui->used) return;
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS &&
                     (event->key == KEY_DELETE || event->key == KEY_BACKSPACE);
    const bool click = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS &&
                       event->button == BUTTON_RIGHT && ui_hovered(ui, view->box);
    int removed = -1;
    for (int i = 0; i < view->angles->count && removed < 0; i++) {
        const struct ui_handle *handle = &view->handles[i];
        if (key && ui->focus == ui_id(ui, handle->name)) removed = i;
        if (click && maths_hypotf(event->x - handle->x, event->y - handle->y) < REACH) removed = i;
    }
    const bool adds = press && event->clicks == 2 && ui_hovered(ui, view->box);
    if (removed < 0 && !adds) return;
    ui->used = true;
    if (adds) {
        const struct ramp_point point = point_at(view, event->x, event->y);
        int i = 0;
        while (i < next.count && next.ramp[i].at < point.at) i++;
        const bool close = (i > 0 && point.at - next.ramp[i - 1].at < APART) ||
                           (i < next.count && next.ramp[i].at - point.at < APART);
        if (close || next.count == RAMP_MAX_POINTS) return;
        for (int k = next.count++; k > i; k--) next.ramp[k] = next.ramp[k - 1];
        next.ramp[i] = point;
    } else if (next.count > 2) {
        next.count--;
        for (int k = removed; k < next.count; k++) next.ramp[k] = next.ramp[k + 1];
    } else {
        core_message(in->core, false, "A ramp needs at least two points.");
        return;
    }
    change_angles(in, view->kind, UI_SET, adds ? "Add point" : "Remove point", NULL, &next);
}

static int joint_at(const struct angle_view *view, float x)
{
    const int last = view->angles->count - 1;
    const float joint = roundf((x - view->plot.x) / view->plot.w * (float)last);
    return (int)fminf(fmaxf(joint, 0), (float)last);
}

/// One angle per joint, drawn by dragging; arrow keys change the selected one.
static void build_each(struct inspector *in, struct angle_view *view)
{
    const struct number_row *number = &rows[view->kind];
    struct ui *ui = &in->ui;
    int which;
    ui_hint(ui, view->box, view->handles->hint);
    const struct event *event = ui->event;
    const bool press = ui->pass == UI_PASS_EVENT && event->kind == EVENT_BUTTON && event->action == ACTION_PRESS &&
                       event->button == BUTTON_LEFT;
    if (press && !ui->used && !ui->held && ui_hovered(ui, view->box)) { // selects the joint and starts drawing there
        in->joint[view->kind] = joint_at(view, event->x);
        in->drawn = *view->angles;
        in->drawn_x = view->handles->x = event->x;
        in->drawn_y = view->handles->y = event->y;
    }
    const struct ui_handle *handle = view->handles;
    const enum ui_change change = ui_handles(ui, view->box, view->handles, 1, &which);
    if (is_held(view, ui)) ui->focus = ui->held; // arrow keys then move the pressed point
    if (change == UI_NUDGE) {                    // ← → select a joint, ↑ ↓ change its angle
        const int last = view->angles->count - 1, next = view->selected + handle->step_x;
        in->joint[view->kind] = next < 0 ? 0 : next > last ? last : next;
        struct angles angles = *view->angles;
        char what[NAME];
        snprintf(what, NAME, "%s.joint.%d", number->ui.name, view->selected);
        angles.value[view->selected] += handle->step_y * number->ui.step;
        if (handle->step_y != 0) change_angles(in, view->kind, UI_NUDGE, number->undo, what, &angles);
    } else if (change == UI_DRAG) { // puts all joints between the last position of the pointer and this one on a line
        const int from = joint_at(view, in->drawn_x), to = joint_at(view, handle->x), way = to >= from ? 1 : -1;
        for (int n = from; n != to + way; n += way) {
            const float share = to == from ? 1 : (float)(n - from) / (float)(to - from);
            in->drawn.value[n] = angle_at(view, in->drawn_y + share * (handle->y - in->drawn_y));
        }
        in->drawn_x = handle->x;
        in->drawn_y = handle->y;
        in->joint[view->kind] = to;
    }
    if (change != UI_NONE && change != UI_NUDGE)
        change_angles(in, view->kind, change, number->undo, view->names[0], &in->drawn);
}

float inspector_highest_curve(const struct inspector *in, enum angle_kind kind)
{
    const struct document *document = in->core->document;
    for (int r = 0; in->core->view.on[SWITCH_MORE] && r < document->rig_count; r++) {
        int count;
        const struct channel *channels = rig_channels(document->rigs[r], &count);
        for (int c = 0; c < count; c++)
            if ((kind == ANGLE_LAG ? channels[c].lag.form : channels[c].gain.form) != ANGLES_ONE) return HEIGHT;
    }
    return 0;
}

void inspector_angles(struct inspector *in, enum angle_kind kind)
{
    const int joints = bones_joints(in->core, in->rig);
    struct rect r = ui_row(&in->ui, UI_ROW), right = {r.x + r.w - SWITCH, r.y, SWITCH, r.h}, left = right;
    left.x -= SWITCH;
    static const struct number_home home = {.get = get_largest, .set = set_largest};
    const struct angles *before = angles_of(in, (int)kind, false);
    const bool several = before->form != ANGLES_ONE;
    const bool lags = kind == ANGLE_LAG && several; // each joint's own lag may be a few turns
    struct number_row number = rows[kind];
    double *reach = &in->angle_reach[kind]; // extends the slider's ends to include its angle; constant during a drag
    if (!lags && (*reach < 1 || in->ui.held != ui_id(&in->ui, number.ui.name))) {
        *reach = 1;
        while (fabs(angles_largest(before)) > *reach * number.ui.maximum && *reach < MOST_REACH) *reach *= 2;
    }
    number.ui.unit = unit_of(in, (int)kind);
    number.ui.minimum *= lags ? 1 : *reach;
    number.ui.maximum = lags ? 720 : *reach * number.ui.maximum;
    if (several) number.ui.fallback = NAN;
    if (in->core->view.on[SWITCH_MORE]) r.w = left.x - r.x - 2;
    inspector_number(in, &number, &home, (int)kind, r);
    if (!in->core->view.on[SWITCH_MORE]) return;

    const struct angles *angles = angles_of(in, (int)kind, false);
    struct angles ramp = {.form = ANGLES_RAMP, .count = 2}, each = {.form = ANGLES_EACH, .count = joints};
    for (int n = 0; n < joints; n++)
        each.value[n] = kind == ANGLE_LAG ? angles_lag(angles, n, joints) : angles_at(angles, n, joints);
    for (int i = 0; i < 2; i++) ramp.ramp[i] = (struct ramp_point){i, each.value[i * (joints - 1)]};
    if (build_switch(in, kind, angles, &ramp, left) || build_switch(in, kind, angles, &each, right)) return;
    const struct angles now = *angles; // an edit may free them while they are shown
    if (now.form == ANGLES_ONE) return;

    // The curve of several.
    struct angle_view view = {.kind = kind, .angles = &now};
    int *joint = &in->joint[kind];
    if (now.form == ANGLES_EACH && *joint >= now.count) *joint = now.count - 1;
    lay_out(in, &view);
    const bool is_ramp = now.form == ANGLES_RAMP;
    if (in->ui.pass == UI_PASS_DRAW) {
        struct drawlist *list = in->ui.list;
        const struct rect *plot = &view.plot;
        const int count = now.count;
        const float zero = roundf(plot->y + plot->h * (float)(view.high / (view.high - view.low)));
        float line[ANGLES_MAX_JOINTS + 2][2];
        drawlist_rounded(list, view.box, 4, theme()->raised);
        drawlist_rect(list, (struct rect){plot->x, zero, plot->w, 1}, theme()->grid_major);
        for (int i = 0; i < count; i++) {
            float *at = line[i + 1];
            place_angle(&view, i, at);
            const float x = at[0], y = at[1], diamond[] = {x - 4, y, x, y - 4, x + 4, y, x, y + 4};
            if (is_ramp) drawlist_convex(list, diamond, 4, theme()->accent);
            if (!is_ramp) drawlist_rect(list, (struct rect){x - 1.5f, y - 1.5f, 3, 3}, theme()->accent);
        }
        line[0][0] = plot->x; // a ramp is constant outside its points
        line[0][1] = line[1][1];
        line[count + 1][0] = plot->x + plot->w;
        line[count + 1][1] = line[count][1];
        drawlist_line(list, line[is_ramp ? 0 : 1], is_ramp ? count + 2 : count, 1.5f, theme()->accent);
        if (!is_ramp) drawlist_disc(list, line[view.selected + 1], 3.5f, theme()->accent);
    }
    if (is_ramp) build_ramp(in, &view);
    if (!is_ramp) build_each(in, &view);
}
