/// The inspector's section on a tail: its channels, their lag and gain, and the pose at rest.
#include "editor/arrange.h"
#include "editor/inspector.h"
#include <math.h>
#include <stdio.h>

/// One of a tail's three angles, as a slider shows it.
struct angle_row {
    enum angle_kind kind;
    const char *name, *hint, *undo;
    double minimum, maximum, fallback, step;
};

static const struct angle_row lag_row = {
    ANGLE_LAG, "lag", "How much later each joint follows, in degrees of swing (hold L, arrows)", "Set lag", 0, 30,
    6.5,       0.5};
static const struct angle_row gain_row = {
    ANGLE_GAIN, "gain", "How far a joint bends at a spline value of 1", "Set gain", 0, 20, 5, 0.5};
static const struct angle_row rest_row = {
    ANGLE_REST, "rest", "Curl of the tail without motion; a joint's bend upwards", "Set rest pose", -15, 15, 0, 0.5};

/// Joint with the largest angle: what a slider shows and sets where there is one angle a joint.
static int peak_joint(const struct angles *angles, int joints)
{
    int peak = 0;
    for (int n = 1; angles->each && n < joints; n++) {
        if (fabs(angles->value[n]) > fabs(angles->value[peak])) peak = n;
    }
    return peak;
}

/// All angles in proportion, so that the largest becomes `value`.
static void scale_angles(struct angles *angles, int joints, double value)
{
    int peak = peak_joint(angles, joints);
    double before = angles->value[peak];
    angles->value[peak] = value;
    for (int n = 0; angles->each && n < joints; n++) {
        if (n != peak) angles->value[n] = before == 0 ? value : angles->value[n] * (value / before);
    }
}

static void build_angles(struct inspection *in, const struct angle_row *row, const struct angles *angles)
{
    const struct inspector *inspector = &in->editor->inspector;
    int joints = in->document->tails[inspector->tail].joints;
    char shown[64];
    bool lags =
        row->kind == ANGLE_LAG && angles->each; // each joint's own lag: up to a few turns, not degrees a joint
    struct ui_number number = {.name = row->name,
                               .label = row->name,
                               .unit = "°",
                               .hint = row->hint,
                               .minimum = row->minimum,
                               .maximum = lags ? 720 : row->maximum,
                               .lowest = -36000,
                               .highest = 36000,
                               .fallback = angles->each ? NAN : row->fallback,
                               .step = row->step,
                               .decimals = 1};
    if (angles->each) {
        snprintf(shown, sizeof shown, "%.1f → %.1f°", angles->value[0], angles->value[joints - 1]);
        number.shown = shown;
    }
    double value = angles->value[peak_joint(angles, joints)];
    enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &value);
    if (change == UI_NONE) return;
    inspector_take_back(in, change); // scaled from where the drag began, so that a drag through 0 loses no proportion
    struct angles next = *angles;
    scale_angles(&next, joints, value);
    struct edit edit = editor_edit_of(EDIT_ANGLES, 0);
    edit.tail = inspector->tail;
    edit.channel = row->kind == ANGLE_REST ? -1 : inspector->channel;
    edit.angle = row->kind;
    edit.angles = &next;
    inspector_change(in, change, row->undo, row->name, &edit);
}

static void build_channels(struct inspection *in, const struct tail *tail)
{
    struct ui *ui = in->ui;
    for (int c = 0; c < tail->channel_count; c++) {
        const struct channel *channel = &tail->channels[c];
        char name[32], text[192];
        snprintf(name, sizeof name, "channel.%d", c);
        const char *axis = channel->axis == AXIS_SIDE ? "sideways" : "up and down";
        snprintf(text, sizeof text, "%s, %s", in->document->splines[channel->spline].name, axis);
        uint32_t color = arrange_color(in->document, channel->spline);
        struct rect r = ui_row(ui, UI_ROW);
        if (ui_hovered(ui, r)) ui->hint = "A spline that bends this tail";
        if (ui_list_row(ui, r, name, text, color, c == in->editor->inspector.channel))
            in->editor->inspector.channel = c;
    }
}

/// A row for each tail where there is a choice.
static void build_tails(struct inspection *in)
{
    for (int t = 0; in->document->tail_count > 1 && t < in->document->tail_count; t++) {
        char name[32];
        snprintf(name, sizeof name, "tail.%d", t);
        struct inspector *inspector = &in->editor->inspector;
        if (ui_list_row(in->ui, ui_row(in->ui, UI_ROW), name, in->document->tails[t].name, 0, t == inspector->tail)) {
            inspector->tail = t;
            inspector->channel = 0;
        }
    }
}

void inspector_tail(struct inspection *in)
{
    struct ui *ui = in->ui;
    struct inspector *inspector = &in->editor->inspector;
    const struct document *document = in->document;
    if (inspector->tail >= document->tail_count) inspector->tail = 0;
    build_tails(in);
    const struct tail *tail = &document->tails[inspector->tail];
    if (inspector->channel >= tail->channel_count) inspector->channel = 0;
    build_channels(in, tail);
    ui_space(ui, 4);
    if (tail->channel_count > 0) {
        build_angles(in, &lag_row, &tail->channels[inspector->channel].lag);
        build_angles(in, &gain_row, &tail->channels[inspector->channel].gain);
    }
    build_angles(in, &rest_row, &tail->rest);
    char text[96];
    snprintf(text, sizeof text, "%d joints, %.4g m", tail->joints, tail->length);
    ui_paragraph(ui, text, THEME_TEXT_DIM);
}
