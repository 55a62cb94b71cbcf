/// Angles in the inspector: one for all joints as a slider; one for each as a slider that scales them, the first and the last
/// to fill in between, and a list to type.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SWITCH = 26, MOST_REACH = 1024 }; ///< width of a button between one, each and a ramp

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
                               .unit = "°",
                               .hint = row->hint,
                               .minimum = reach * row->minimum,
                               .maximum = lags ? 720 : reach * row->maximum,
                               .lowest = -36000,
                               .highest = 36000,
                               .fallback = several ? NAN : row->fallback,
                               .step = row->step,
                               .decimals = 1};
    if (several) {
        snprintf(shown, sizeof shown, "%.1f → %.1f°", angles_number(angles, 0),
                 angles_number(angles, angles->count - 1));
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

/// One angle as one for each joint, or several as one, with as little change of the pose as there can be.
static struct angles converted(const struct angles *angles, enum angle_kind kind, int joints)
{
    struct angles next = {.form = angles->form == ANGLES_ONE ? ANGLES_EACH : ANGLES_ONE, .count = joints};
    double sum = 0;
    for (int n = 0; n < joints; n++) {
        next.value[n] = kind == ANGLE_LAG ? angles_lag(angles, n, joints) : angles_at(angles, n, joints);
        sum += next.value[n];
    }
    if (next.form == ANGLES_EACH) return next;
    const double last = angles_at(angles, joints - 1, joints);
    memset(next.value, 0, sizeof next.value);
    next.value[0] = kind != ANGLE_LAG ? sum / joints : joints > 1 ? last / (joints - 1) : 0;
    next.value[0] = round(next.value[0] * 1e4) / 1e4;
    return next;
}

/// The first or the last of one angle a joint; all between are filled in.
static void build_end(struct inspection *in, const struct angle_row *row, const struct angles *angles, int joints,
                      bool last, struct rect r)
{
    char name[32];
    double ends[2] = {angles->value[0], angles->value[joints - 1]};
    snprintf(name, sizeof name, "%s.%s", row->name, last ? "last" : "first");
    const struct ui_number number = {.name = name,
                                     .unit = "°",
                                     .hint = last ? "For the last joint; the joints between are interpolated"
                                                  : "For the first joint; the joints between are interpolated",
                                     .lowest = -36000,
                                     .highest = 36000,
                                     .fallback = NAN,
                                     .step = row->step,
                                     .decimals = 1};
    enum ui_change change = ui_value(in->ui, r, &number, &ends[last]);
    if (change == UI_NONE) return;
    struct angles next = {.form = ANGLES_EACH, .count = joints};
    for (int n = 0; n < joints; n++) {
        double share = joints > 1 ? (double)n / (joints - 1) : last;
        next.value[n] = round((ends[0] + (ends[1] - ends[0]) * share) * 1e4) / 1e4;
    }
    struct edit edit = inspector_angles_edit(in, row, &next);
    inspector_change(in, change, row->undo, name, &edit);
}

/// Numbers set apart by commas or spaces; false where there are not just `count`.
static bool parse_list(const char *text, double *values, int count)
{
    int found = 0;
    while (*text) {
        char *end;
        double value = strtod(text, &end);
        if (end == text || !isfinite(value) || found == count) return false;
        values[found++] = value;
        text = end + strspn(end, ", ;\t");
    }
    return found == count;
}

static void print_list(const struct angles *angles, int joints, char *text, size_t size)
{
    size_t used = 0;
    for (int n = 0; n < joints && used + 24 < size; n++) {
        used += (size_t)snprintf(text + used, size - used, "%s%.4g", n > 0 ? ", " : "", angles->value[n]);
    }
}

/// All of them as a line to be typed over.
static void build_list(struct inspection *in, const struct angle_row *row, const struct angles *angles, int joints,
                       struct rect r)
{
    char name[32], text[UI_TEXT_SIZE];
    snprintf(name, sizeof name, "%s.list", row->name);
    if (!ui_line_is_open(in->ui, name)) {
        if (ui_hovered(in->ui, r)) in->ui->hint = "Type one number per joint, separated by commas";
        print_list(angles, joints, text, sizeof text);
        if (ui_button(in->ui, r, name, "List", false)) ui_line_begin(in->ui, name, text);
        return;
    }
    if (ui_line(in->ui, r, name) != UI_LINE_DONE) return;
    struct angles next = {.form = ANGLES_EACH, .count = joints};
    if (parse_list(in->ui->text.bytes, next.value, joints)) {
        struct edit edit = inspector_angles_edit(in, row, &next);
        core_step(in->core, in->world, row->undo, 0, &edit);
        return;
    }
    snprintf(text, sizeof text, "%s: expected %d numbers, one per joint.", row->name, joints);
    core_message(in->core, true, text);
}

/// The button at the right end of a row that makes its angles another kind; true if it changed them.
static bool build_switch(struct inspection *in, const struct angle_row *row, const struct angles *next, struct rect r,
                         const char *kind, const char *label, const char *hint)
{
    char name[32];
    snprintf(name, sizeof name, "%s.%s", row->name, kind);
    if (ui_hovered(in->ui, r)) in->ui->hint = hint;
    if (!ui_button(in->ui, r, name, label, false)) return false;
    const struct edit edit = inspector_angles_edit(in, row, next);
    core_step(in->core, in->world, row->undo, 0, &edit);
    return true;
}

/// One of each joint: the first, the last, and all as a list.
static void build_each(struct inspection *in, const struct angle_row *row, const struct angles *angles, int joints)
{
    char name[32];
    struct rect line = ui_row(in->ui, UI_ROW);
    snprintf(name, sizeof name, "%s.list", row->name);
    float x = line.x + UI_LABEL + UI_GAP, w = (line.x + line.w - x - 2 * 4) / 3;
    if (ui_line_is_open(in->ui, name)) {
        build_list(in, row, angles, joints, line);
        return;
    }
    build_end(in, row, angles, joints, false, (struct rect){x, line.y, w, line.h});
    build_end(in, row, angles, joints, true, (struct rect){x + w + 4, line.y, w, line.h});
    build_list(in, row, angles, joints, (struct rect){x + 2 * (w + 4), line.y + 2, w, line.h - 4});
}

void inspector_angles(struct inspection *in, const struct angle_row *row, const struct angles *angles)
{
    const int joints = bones_joints(in->world, in->inspector->rig);
    const bool several = angles->form != ANGLES_ONE, is_ramp = angles->form == ANGLES_RAMP;
    struct rect r = ui_row(in->ui, UI_ROW), right = {r.x + r.w - SWITCH, r.y + 2, SWITCH, r.h - 4}, left = right;
    left.x -= SWITCH + 4;
    build_slider(in, row, angles, (struct rect){r.x, r.y, (is_ramp ? right.x : left.x) - r.x - 4, r.h});
    const struct angles other = converted(angles, row->kind, joints),
                        ramp = inspector_as_ramp(angles, row->kind, joints);
    if (build_switch(in, row, &other, right, "each", several ? (is_ramp ? "~" : "n") : "1",
                     several ? "Use one angle for all joints" : "Use one angle per joint"))
        return;
    if (!is_ramp && build_switch(in, row, &ramp, left, "ramp", "~", "Draw the angles along the joints as a curve"))
        return;
    if (is_ramp) inspector_ramp(in, row, angles);
    if (angles->form == ANGLES_EACH) build_each(in, row, angles, joints);
}
