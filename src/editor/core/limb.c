/// The limb that Feel acts on: its splines' frequency, damping and wind-up and its channels' lag change together.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "scene/order.h"
#include <math.h>

int core_limb(const struct core *core)
{
    const struct document *document = core->document;
    for (int r = 0; core->limb != 0 && r < document->rig_count; r++) {
        if (document->rigs[r]->id == core->limb) return rig_is_moved(document->rigs[r], core->active) ? r : -1;
    }
    return -1;
}

double core_in_step(double other, double before, double now)
{
    if (before == 0) return other == 0 ? now : other;
    return round(other * (now / before) * 1e6) / 1e6;
}

/// Whether a parameter of another spline changes with the active one's.
static bool is_felt(const struct document *document, int limb, int spline, enum parameter parameter)
{
    return (parameter == PARAMETER_FREQUENCY || parameter == PARAMETER_DAMPING || parameter == PARAMETER_WIND_UP) &&
           limb >= 0 && rig_is_moved(document->rigs[limb], spline) &&
           spline_uses(document->splines[spline], parameter, false);
}

bool core_set_felt(struct core *core, int limb, enum parameter parameter, double value, bool alike,
                   struct error *error)
{
    struct document *document = core->document;
    const struct param before = core_active_spline(core)->parameter[parameter];
    bool done = true;
    for (int s = 0; s < document->spline_count && done; s++) {
        const struct spline *spline = document->splines[s];
        const bool is_active = s == core->active;
        if (param_follows(&spline->parameter[parameter]) || (!is_active && !is_felt(document, limb, s, parameter)))
            continue;
        double next = value;
        if (!is_active && !alike && !param_follows(&before))
            next = core_in_step(spline->parameter[parameter].value, before.value, value);
        const struct param param = param_number(parameter_clamped(parameter, spline_mode(spline), next));
        done = edit_parameter(document, s, parameter, &param, error);
    }
    return done;
}

bool core_set_lag(struct core *core, int limb, struct channel_place at, const struct angles *lag, struct error *error)
{
    struct document *document = core->document;
    int count;
    const double before = angles_largest(&rig_channels(document->rigs[at.rig], &count)[at.channel].lag);
    bool done = edit_angles(document, at, ANGLE_LAG, lag, error);
    for (int c = 0; c < count && limb == at.rig && done; c++) {
        struct angles other = rig_channels(document->rigs[limb], &count)[c].lag;
        if (c == at.channel || rig_point_input(document->rigs[limb], c) < 0) continue;
        angles_scale(&other, core_in_step(angles_largest(&other), before, angles_largest(lag)));
        done = edit_angles(document, (struct channel_place){limb, c}, ANGLE_LAG, &other, error);
    }
    return done;
}
