/// Splines that move a body, and channels that let its tail follow through.
///
/// A channel whose spline has its own knots keeps that spline. The swing that the base causes goes into a new channel on a spline with the
/// same poles. By linearity the motion is the same, and every existing key keeps its meaning. A tail without a channel for an axis gets a
/// new one, too.
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/stage/parts.h"
#include "model/fox.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 300 };

static const double RESOLUTION = 1e-3; ///< metres
static const double LEAST_SHARE = 0.05;
static const double MAIN_SHARE = 0.5; ///< least component of a coordinate along an axis' bending direction

/// Appends a spline; returns its index, or -1.
static int add_spline(struct core *core, const char *name)
{
    const bool done = edit_spline_add(core->document, -1, name, NULL, &core->error);
    return done ? core->document->spline_count - 1 : -1;
}

void base_put_knot(struct core *core, int spline, int sample, double value, bool level, char why[STOPPED_SIZE])
{
    struct knot knot = core_knot_at(core->document, spline, sample);
    knot.value = core_round(value, RESOLUTION);
    core_hold(core->document->splines[spline], &knot, why);
    knot.has_slope = level;
    knot.slope = 0;
    knot.stiffness = level ? RECORD_STIFFNESS : KNOT_DEFAULT_STIFFNESS;
    core_put_knot(core, spline, &knot);
}

void base_begin(struct stage *stage, const struct core *core)
{
    struct body_drag *hold = &stage->body_drag;
    const struct tail *tail = tail_of(core->document, hold->rig);
    hold->loops = tail->channel_count > 0;
    for (int c = 0; c < tail->channel_count; c++) {
        hold->hangs[c] = swing_hangs(tail->channels, tail->channel_count, &tail->channels[c]);
        hold->loops &= spline_start(core->document->splines[tail->channels[c].spline]) == WIGGLY_LOOP;
    }
}

int base_spline(const struct stage *stage, struct core *core, int coordinate)
{
    const int rig = stage->body_drag.rig;
    const struct tail *moved = tail_of(core->document, rig);
    char name[NAME_SIZE];
    if (moved->position[coordinate].track >= 0) return moved->position[coordinate].track;
    snprintf(name, sizeof name, "%.*s %s", name_fit(core->document->rigs[rig]->name, 250),
             core->document->rigs[rig]->name, coordinate_name(coordinate));
    int spline = add_spline(core, name);
    if (spline < 0) return -1;
    core_set_parameter(core, spline, PARAMETER_MODE, WIGGLY_CUBIC);
    if (stage->body_drag.loops) core_set_parameter(core, spline, PARAMETER_START, WIGGLY_LOOP);
    return spline;
}

double base_value(const struct core *core, int rig, int coordinate, int sample)
{
    const struct tail *moved = tail_of(core->document, rig);
    const struct param *param = &moved->position[coordinate];
    if (param->track >= 0) {
        const wiggly_value value = evaluation_at(core->evaluation, param->track, sample);
        return value.y + value.re;
    }
    // A fixed height stands for the ground; a height that follows a spline is above 0.
    return coordinate == 1 ? moved->length * (double)(FOX_BASE_HEIGHT / FOX_TAIL_LENGTH) : param->value;
}

void base_follow(const struct stage *stage, struct core *core, int coordinate, int base)
{
    const int rig = stage->body_drag.rig;
    struct rig moved = *core->document->rigs[rig];
    moved.tail.position[coordinate] = param_track(base);
    edit_rig_set(core->document, rig, &moved, &core->error);
}

static void follow_base(struct core *core, int spline, int base)
{
    const struct param param = param_track(base);
    edit_parameter(core->document, spline, PARAMETER_EQUILIBRIUM, &param, &core->error);
}

/// A spline with another's poles and no knots, driven by the base, from rest or as a loop; returns its index, or -1.
static int add_follower(struct core *core, int model, const char *name, int base)
{
    int spline = add_spline(core, name);
    if (spline < 0) return -1;
    const struct spline *copied = core->document->splines[model];
    const bool loops = spline_start(copied) == WIGGLY_LOOP;
    core_set_parameter(core, spline, PARAMETER_MODE, spline_mode(copied));
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        if (p != PARAMETER_EQUILIBRIUM && p != PARAMETER_START)
            edit_parameter(core->document, spline, p, &copied->parameter[p], &core->error);
    }
    core_set_parameter(core, spline, PARAMETER_START, loops ? WIGGLY_LOOP : WIGGLY_REST);
    follow_base(core, spline, base);
    return spline;
}

/// Adds a displacement channel about an axis, copying another channel; returns its spline, or -1.
static int add_channel(const struct stage *stage, struct core *core, const struct channel *model, enum axis axis,
                       const char *name, double scale, int base)
{
    struct document *document = core->document;
    const int spline = add_follower(core, model->spline, name, base);
    struct angles gain = model->gain;
    const struct angles lag = model->lag;
    if (spline < 0) return -1;
    for (int i = 0; i < angles_count(&gain); i++)
        angles_set_number(&gain, i, round(angles_number(&gain, i) * scale * 1e4) / 1e4);
    const int rig = stage->body_drag.rig;
    if (!edit_channel_add(document, rig, spline, axis, PART_DISPLACEMENT, &core->error)) return -1;
    const struct channel_place added = {rig, document->rigs[rig]->tail.channel_count - 1};
    edit_angles(document, added, ANGLE_LAG, &lag, &core->error);
    edit_angles(document, added, ANGLE_GAIN, &gain, &core->error);
    return spline;
}

/// The axis about which the tail should bend when its base moves along a coordinate; AXES if a channel already bends about it, or if it
/// bends too little along the coordinate.
static enum axis missing_axis(const struct stage *stage, const struct core *core, int coordinate, double *share)
{
    const struct tail *tail = tail_of(core->document, stage->body_drag.rig);
    const struct posing posing = stage_posing(core);
    struct swing_arm arm = {.joints = 0};
    swing_arm(&posing, stage->body_drag.rig, &arm);
    const bool up = fabs(arm.direction[AXIS_UP][coordinate]) > fabs(arm.direction[AXIS_SIDE][coordinate]);
    const enum axis axis = up ? AXIS_UP : AXIS_SIDE;
    *share = arm.direction[axis][coordinate];
    for (int c = 0; c < tail->channel_count; c++) {
        if (tail->channels[c].axis == axis) return AXES;
    }
    return fabs(*share) >= MAIN_SHARE ? axis : AXES;
}

/// Adds a spline and channel that swing the tail with a coordinate, if missing; returns the spline, or -1.
static int add_missing(const struct stage *stage, struct core *core, int coordinate, int base)
{
    const struct document *document = core->document;
    const struct tail *tail = tail_of(document, stage->body_drag.rig);
    double share;
    const enum axis axis = missing_axis(stage, core, coordinate, &share);
    char name[NAME_SIZE];
    if (axis == AXES) return -1;
    snprintf(name, sizeof name, "%.*s %s", name_fit(rig_title(document->rigs[stage->body_drag.rig]), 250),
             rig_title(document->rigs[stage->body_drag.rig]), axis_word(axis));
    for (int c = 0; c < tail->channel_count; c++) {
        const struct channel model = tail->channels[c];
        const double scale = drag_inertia_scale(stage, document, stage->body_drag.rig, c);
        if (axis_bends(model.axis) && stage->body_drag.hangs[c] && scale != 0)
            return add_channel(stage, core, &model, axis, name, scale * share, base);
    }
    return -1;
}

int base_hang_channels(const struct stage *stage, struct core *core, int coordinate, int base)
{
    const int rig = stage->body_drag.rig, count = tail_of(core->document, rig)->channel_count;
    const struct posing posing = stage_posing(core);
    for (int c = 0; c < count; c++) {
        const struct tail *tail = tail_of(core->document, rig);
        const struct channel channel = tail->channels[c];
        const struct param *equilibrium = &core->document->splines[channel.spline]->parameter[PARAMETER_EQUILIBRIUM];
        double direction[3], scale = drag_inertia_scale(stage, core->document, rig, c);
        struct swing_arm arm = {.joints = 0};
        swing_arm(&posing, rig, &arm);
        swing_direction(&arm, channel.axis, direction);
        bool swung = stage->body_drag.hangs[c] && fabs(direction[coordinate]) > LEAST_SHARE && scale != 0;
        if (!swung) continue;
        if (channel.of == PART_TOTAL) {
            char name[NAME_SIZE];
            snprintf(name, sizeof name, "%.*s follow", name_fit(core->document->splines[channel.spline]->name, 280),
                     core->document->splines[channel.spline]->name);
            add_channel(stage, core, &channel, channel.axis, name, scale * direction[coordinate], base);
        } else if (!param_follows(equilibrium)) {
            follow_base(core, channel.spline, base);
        }
    }
    return add_missing(stage, core, coordinate, base);
}

void base_say_channel(const struct core *core, int spline, char *text, size_t size)
{
    if (spline < 0) return;
    const struct spline *made = core->document->splines[spline];
    const int base = made->parameter[PARAMETER_EQUILIBRIUM].track;
    const size_t length = strlen(text);
    snprintf(text + length, size - length, " New spline %s: the tail swings after %s.", made->name,
             base >= 0 ? core->document->splines[base]->name : "it");
}
