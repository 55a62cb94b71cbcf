/// Changes of parameters by key, in small steps. Equal nudges are one undo step.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "scene/order.h"
#include <math.h>
#include <stdio.h>

enum { NUDGE_PARAMETER = 100 }; ///< a kind of nudges for core_merge_key()

const struct channel *core_active_channel(const struct core *core, int *rig, int *channel)
{
    const struct channel *first = NULL;
    for (int r = core->document->rig_count - 1; r >= 0; r--) {
        int count;
        const struct channel *channels = rig_channels(core->document->rigs[r], &count);
        for (int c = count - 1; c >= 0; c--) {
            const struct channel *candidate = &channels[c];
            if (first && first->spline == core->active && candidate->spline != core->active) continue;
            first = candidate;
            *rig = r;
            *channel = c;
        }
    }
    return first;
}

static void nudge_lag(struct core *core, double degrees)
{
    int rig = -1, channel = -1;
    const struct channel *active = core_active_channel(core, &rig, &channel);
    if (!active) {
        core_message(core, false, "This scene has no tail to lag.");
        return;
    }
    struct angles lag = active->lag;
    const int joints = bones_joints(core, rig);
    for (int i = 0; i < angles_count(&lag); i++) {
        double behind = lag.form == ANGLES_ONE ? 1 : lag.form == ANGLES_EACH ? i : lag.ramp[i].at * (joints - 1);
        angles_set_number(&lag, i, angles_number(&lag, i) + behind * degrees);
    }
    const struct channel_place at = {rig, channel};
    const uint64_t kind = NUDGE_PARAMETER + PARAMETER_COUNT + (uint64_t)(rig * 4096 + channel);
    if (!core_begin(core, "Change lag", core_merge_key(core, kind))) return;
    core_end(core, edit_angles(core->document, at, ANGLE_LAG, &lag, &core->error));
}

/// Of the largest knot.
static const double FRESH_ROOM = 0.15;

double core_slider_end(const struct document *document, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    double most = fmin(row->usual, parameter_maximum(parameter, spline_mode(spline)));
    return row->is_frequency ? fmin(most, document->fps * document->substeps / 2) : most;
}

double core_fresh_limit(const struct spline *spline, enum parameter parameter)
{
    const bool is_high = parameter == PARAMETER_HIGH;
    double edge = 0, largest = 0;
    for (int k = 0; k < spline->knot_count; k++) {
        const double value = spline->knots[k].value;
        if (k == 0 || (is_high ? value > edge : value < edge)) edge = value;
        largest = fmax(largest, fabs(value));
    }
    const double room = largest > 0 ? FRESH_ROOM * largest : 1;
    return is_high ? ceil(100 * (edge + room) - 1e-6) / 100 : floor(100 * (edge - room) + 1e-6) / 100;
}

/// Says why a parameter does nothing now; false where it does something.
static bool say_idle(struct core *core, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    char text[160];
    if (parameter == PARAMETER_CALM || row->modes >> spline_mode(spline) & 1) return false;
    if (spline_mode(spline) == WIGGLY_CUBIC) {
        snprintf(text, sizeof text, "A cubic does not swing; press M to change the mode.");
    } else {
        snprintf(text, sizeof text, "Only %s mode has a %s; press M to change the mode.",
                 row->modes & IN_COMPLEX ? "complex" : "real", row->name);
    }
    core_message(core, false, text);
    return true;
}

static void nudge_one(struct core *core, const struct spline *spline, enum parameter parameter, double step)
{
    if (say_idle(core, spline, parameter)) return;
    const struct param *before = &spline->parameter[parameter];
    if (before->track >= 0) {
        char text[160];
        snprintf(text, sizeof text, "The %s follows the spline \"%.60s\".", parameter_rows[parameter].name,
                 core->document->splines[before->track]->name);
        core_message(core, false, text);
        return;
    }
    struct param param = *before;
    param.value = round((param.value + step) * 1e6) / 1e6; /* 0.30000000000000004 is no number to save */
    double most = parameter_maximum(parameter, spline_mode(spline));
    if (parameter_rows[parameter].usual > 0)
        most = fmax(core_slider_end(core->document, spline, parameter), before->value);
    param.value = fmin(fmax(param.value, parameter_rows[parameter].minimum), most);
    if (param.value == before->value) return;
    if (!core_begin(core, "Change parameter", core_merge_key(core, NUDGE_PARAMETER + parameter))) return;
    core_end(core, edit_parameter(core->document, core->active, parameter, &param, &core->error));
}

void core_nudge_parameter(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    if (core->held_key == 0) return;
    if (core->held_key == 'L') nudge_lag(core, 0.5 * direction);
    enum parameter parameter = parameter_of_letter(core->held_key);
    if (!spline || parameter == PARAMETER_COUNT) return;
    nudge_one(core, spline, parameter, parameter_rows[parameter].step * direction);
}

void core_cycle_choice(struct core *core, int parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct spline *spline = core_active_spline(core);
    if (!spline) return;
    double next = spline->parameter[parameter].value + 1;
    if (!core_begin(core, row->undo, 0)) return;
    core_end(core,
             core_set_parameter(core, core->active, (enum parameter)parameter, next <= row->maximum ? next : 0));
}
