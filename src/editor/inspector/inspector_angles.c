/// Angles in the inspector: one for all joints as a slider; several as a slider that scales them and a curve.
#include "base/printable.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
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

struct edit inspector_angles_edit(const struct inspection *in, const struct angle_row *row,
                                  const struct angles *angles)
{
    struct edit edit = core_edit_of(EDIT_ANGLES, 0);
    edit.rig = in->inspector->rig;
    edit.channel = row->kind == ANGLE_REST ? -1 : in->inspector->channel;
    edit.angle = row->kind;
    edit.angles = angles;
    return edit;
}

const char *inspector_angle_unit(const struct inspection *in, const struct angle_row *row)
{
    return row->kind == ANGLE_GAIN ? axis_unit(inspector_felt_channel(in)->axis) : "°";
}

/// By how much a slider's ends are taken further out, so that it has the angle on it; the same as long as it is dragged.
static double reach_of(struct inspection *in, const struct angle_row *row, double angle)
{
    double *reach = &in->inspector->angle_reach[row->kind];
    if (*reach >= 1 && in->ui->held == ui_id(row->name)) return *reach;
    *reach = 1;
    while (fabs(angle) > *reach * row->maximum && *reach < MOST_REACH) *reach *= 2;
    return *reach;
}

static void build_slider(struct inspection *in, const struct angle_row *row, const struct angles *angles,
                         struct rect r)
{
    char shown[64];
    const bool several = angles->form != ANGLES_ONE;
    bool lags = row->kind == ANGLE_LAG && several; // each joint's own lag: up to a few turns, not degrees a joint
    double value = angles_number(angles, peak(angles));
    const double reach = lags ? 1 : reach_of(in, row, value);
    struct ui_number number = {.name = row->name,
                               .label = row->name,
                               .unit = inspector_angle_unit(in, row),
                               .hint = row->hint,
                               .minimum = reach * row->minimum,
                               .maximum = lags ? 720 : reach * row->maximum,
                               .lowest = -36000,
                               .highest = 36000,
                               .fallback = several ? NAN : row->fallback,
                               .step = row->step,
                               .decimals = 1};
    if (several) {
        snprintf(shown, sizeof shown, "%.1f → %.1f%s", printable_number(angles_number(angles, 0), 0.1),
                 printable_number(angles_number(angles, angles->count - 1), 0.1), number.unit);
        number.shown = shown;
    }
    enum ui_change change = ui_value(in->ui, r, &number, &value);
    if (change == UI_NONE) return;
    inspector_take_back(in, change); // scaled from where the drag began, so that a drag through 0 loses no proportion
    struct angles next = *angles;
    scale_angles(&next, value);
    struct edit edit = inspector_angles_edit(in, row, &next);
    inspector_change(in, change, row->undo, row->name, &edit);
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
static bool build_switch(struct inspection *in, const struct angle_row *row, const struct angles *angles,
                         const struct angles *next, struct rect r)
{
    const bool ramp = next->form == ANGLES_RAMP, lit = angles->form == next->form;
    char name[32];
    snprintf(name, sizeof name, "%s.%s", row->name, ramp ? "ramp" : "each");
    const char *hint = lit    ? "Back to one angle for all joints"
                       : ramp ? "Draw the angles along the joints as a curve through a few points"
                              : "Give each joint an angle of its own";
    if (!ui_icon_button(in->ui, r, name, ramp ? UI_ICON_RAMP : UI_ICON_EACH, lit, hint)) return false;
    const int joints = bones_joints(in->world, in->inspector->rig);
    const struct angles one = one_angle(angles, row->kind, joints);
    const struct edit edit = inspector_angles_edit(in, row, lit ? &one : next);
    core_step(in->core, in->world, row->undo, 0, &edit);
    return true;
}

void inspector_angles(struct inspection *in, const struct angle_row *row, const struct angles *angles)
{
    const int joints = bones_joints(in->world, in->inspector->rig);
    struct rect r = ui_row(in->ui, UI_ROW), right = {r.x + r.w - SWITCH, r.y, SWITCH, r.h}, left = right;
    left.x -= SWITCH;
    build_slider(in, row, angles, (struct rect){r.x, r.y, left.x - r.x - 2, r.h});
    const struct angles ramp = inspector_as_ramp(angles, row->kind, joints),
                        each = each_angle(angles, row->kind, joints);
    if (build_switch(in, row, angles, &ramp, left) || build_switch(in, row, angles, &each, right)) return;
    if (angles->form == ANGLES_RAMP) inspector_ramp(in, row, angles);
    if (angles->form == ANGLES_EACH) inspector_each(in, row, angles);
}
