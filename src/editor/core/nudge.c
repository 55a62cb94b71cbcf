/// Changes the active spline's parameters by keys, and finds the frequency and damping that explain its knots.
#include "base/names.h"
#include "base/need.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "scene/warnings.h"
#include <math.h>
#include <stdlib.h>

enum { NUDGE_PARAMETER = 100 }; ///< kind for core_merge_key()

const struct channel *core_active_channel(const struct core *core, int *rig, int *channel)
{
    const struct channel *first = NULL;
    const int limb = core_limb(core);
    for (int r = core->document->rig_count - 1; r >= 0; r--) {
        int count;
        const struct channel *channels = rig_channels(core->document->rigs[r], &count);
        for (int c = count - 1; c >= 0; c--) {
            const struct channel *candidate = &channels[c];
            const bool suits = first && first->spline == core->active;
            if (suits && (candidate->spline != core->active || (*rig == limb && r != limb))) continue;
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
    if (core_step(core, "Change lag", core_merge_key(core, kind)))
        core_set_lag(core, core_limb(core), at, &lag, &core->error);
}

/// Of the largest value.
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
    double edge = 0, largest = -1;
    for (int k = 0; k < spline->knot_count; k++) {
        const double value = spline->knots[k].value;
        if (spline->knots[k].still) continue;
        if (largest < 0 || (is_high ? value > edge : value < edge)) edge = value;
        largest = fmax(largest, fabs(value));
    }
    const double room = largest > 0 ? FRESH_ROOM * largest : 1;
    return is_high ? ceil(100 * (edge + room) - 1e-6) / 100 : floor(100 * (edge - room) + 1e-6) / 100;
}

/// Shows why a parameter has no effect now; false if it has one.
static bool say_idle(struct core *core, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    if (parameter == PARAMETER_CALM && !spline_uses_calm(core->document, core->active)) {
        core_message(core, false, "Calm is for whole curves: drag the wind-up to its right end first.");
        return true;
    }
    if (parameter == PARAMETER_CALM || row->modes >> spline_mode(spline) & 1) return false;
    if (spline_mode(spline) == WIGGLY_CUBIC) {
        core_message(core, false, "A cubic does not swing. Press M to change the kind.");
    } else {
        core_message(core, false, "Only a %s spline has a %s. Press M to change the kind.",
                     row->modes & IN_COMPLEX ? "wiggly" : "spring", row->name);
    }
    return true;
}

static void nudge_one(struct core *core, const struct spline *spline, enum parameter parameter, double step)
{
    if (say_idle(core, spline, parameter)) return;
    const struct param *before = &spline->parameter[parameter];
    if (before->track >= 0) {
        core_message(core, false, "The %s follows the spline \"%.*s\".", parameter_rows[parameter].name,
                     name_fit(core->document->splines[before->track]->name, 60),
                     core->document->splines[before->track]->name);
        return;
    }
    struct param param = *before;
    param.value = round((param.value + step) * 1e6) / 1e6; /* 0.30000000000000004 is no number to save */
    double most = parameter_maximum(parameter, spline_mode(spline));
    if (parameter_rows[parameter].usual > 0)
        most = fmax(core_slider_end(core->document, spline, parameter), before->value);
    param.value = fmin(fmax(param.value, parameter_rows[parameter].minimum), most);
    if (param.value == before->value) return;
    if (core_step(core, "Change parameter", core_merge_key(core, NUDGE_PARAMETER + parameter)))
        core_set_felt(core, core_limb(core), parameter, param.value, false, &core->error);
}

void core_nudge_parameter(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    if (core->held_key == 0) return;
    core->held_used = true;
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
    if (core_step(core, row->undo, 0))
        core_set_parameter(core, core->active, (enum parameter)parameter, next <= row->maximum ? next : 0);
}

void core_toggle_pose_to_pose(struct core *core, int unused)
{
    (void)unused;
    const struct spline *spline = core_active_spline(core);
    if (!spline) return;
    const bool settles = !spline_settles(spline);
    if (!core_step(core, settles ? "Pose to pose" : "Settle off", 0)) return;
    edit_spline_settles(core->document, core->active, settles, &core->error);
    core_edited(core, core->active);
}

/// Why it cannot be done, or NULL.
static const char *obstacle(const struct spline *spline)
{
    const struct param *p = spline->parameter;
    if (spline_mode(spline) == WIGGLY_CUBIC) return "A cubic does not swing. Press M to change the kind.";
    if (p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0)
        return "Frequency or damping follows another spline. Give it a number first.";
    if (spline->knot_count < WIGGLY_FEWEST_EXPLAINED) return "Four knots or more are needed to find a frequency.";
    return NULL;
}

/// Finds explanations of the knots; returns how many.
static int explain(const struct core *core, const struct spline *spline, wiggly_explanation found[2])
{
    const struct evaluation *evaluation = core->evaluation;
    wiggly_desc desc = wiggly_default_desc();
    wiggly_knot *knots = need((size_t)spline->knot_count, sizeof *knots);
    for (int k = 0; k < spline->knot_count; k++) {
        const int sample = document_sample(core->document, spline->knots[k].frame);
        const struct knot *knot = &spline->knots[k];
        knots[k] = (wiggly_knot){.sample = sample, .value = knot->value, .still = knot->still};
    }
    desc.samples = document_samples(core->document);
    desc.step = document_step(core->document);
    desc.mode = spline_mode(spline);
    desc.knots = knots;
    desc.knot_count = spline->knot_count;
    desc.equilibrium.value = spline->parameter[PARAMETER_EQUILIBRIUM].value;
    if (param_follows(&spline->parameter[PARAMETER_EQUILIBRIUM]) && evaluation && core->active < evaluation->count)
        desc.equilibrium.track = evaluation->curves[core->active].y;
    const int count = wiggly_explain(&desc, found);
    free(knots);
    return count;
}

/// Rounded as in files.
static double frequency_of(const wiggly_explanation *found) { return round(found->frequency * 100) / 100; }

static double damping_of(const wiggly_explanation *found) { return round(found->damping * 1000) / 1000; }

static bool is_set(const struct spline *spline, const wiggly_explanation *found)
{
    return spline->parameter[PARAMETER_FREQUENCY].value == frequency_of(found) &&
           spline->parameter[PARAMETER_DAMPING].value == damping_of(found);
}

void core_find_frequency(struct core *core, int unused)
{
    (void)unused;
    const struct spline *spline = core_active_spline(core);
    if (!spline) return;
    const char *reason = obstacle(spline);
    wiggly_explanation found[2];
    const int count = reason ? 0 : explain(core, spline, found);
    if (count <= 0) {
        core_message(core, false, "%s", reason ? reason : "These knots do not swing: no frequency explains them.");
        return;
    }
    const int active = core->active, chosen = count == 2 && is_set(spline, &found[0]) ? 1 : 0;
    if (!core_step(core, "Find frequency", 0) ||
        !core_set_parameter(core, active, PARAMETER_FREQUENCY, frequency_of(&found[chosen])) ||
        !core_set_parameter(core, active, PARAMETER_DAMPING, damping_of(&found[chosen])))
        return;
    core_edited(core, core->active);
    const char *which = chosen ? "Runner-up" : "Best";
    const double hz = found[chosen].frequency, damping = found[chosen].damping;
    if (count == 1) {
        core_message(core, false, "%s: %.2f Hz, damping %.3g. There is no runner-up.", which, hz, damping);
    } else {
        core_message(core, false, "%s: %.2f Hz, damping %.3g. Shift+F again for the %s: %.2f Hz.", which, hz, damping,
                     chosen ? "best" : "runner-up", found[1 - chosen].frequency);
    }
}
