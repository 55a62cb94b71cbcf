/// Finds the frequency and damping that explain the active spline's knots best.
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// Why it cannot be done; NULL: it can.
static const char *obstacle(const struct spline *spline)
{
    const struct param *p = spline->parameter;
    if (spline_mode(spline) == WIGGLY_CUBIC) return "A cubic does not swing; press M to change the mode.";
    if (p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0)
        return "Frequency and damping follow another spline; give them numbers first.";
    if (spline->knot_count < WIGGLY_FEWEST_EXPLAINED) return "Four knots are needed to tell a frequency from them.";
    return NULL;
}

/// How many explanations the knots have.
static int explain(const struct core *core, const struct spline *spline, wiggly_explanation found[2])
{
    const struct evaluation *evaluation = core->evaluation;
    wiggly_desc desc = wiggly_default_desc();
    wiggly_knot *knots = need((size_t)spline->knot_count, sizeof *knots);
    for (int k = 0; k < spline->knot_count; k++) {
        const int sample = document_sample(core->document, spline->knots[k].frame);
        knots[k] = (wiggly_knot){.sample = sample, .value = spline->knots[k].value};
    }
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

/// What the spline would be given: numbers as they are saved.
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
    if (!spline || history_is_open(core->history)) return;
    const char *reason = obstacle(spline);
    wiggly_explanation found[2];
    const int count = reason ? 0 : explain(core, spline, found);
    if (count <= 0) {
        core_message(core, false, reason ? reason : "These knots do not swing: no frequency explains them.");
        return;
    }
    char text[160];
    const int active = core->active, chosen = count == 2 && is_set(spline, &found[0]) ? 1 : 0;
    core_begin(core, "Find frequency", 0);
    const bool good = core_set_parameter(core, active, PARAMETER_FREQUENCY, frequency_of(&found[chosen])) &&
                      core_set_parameter(core, active, PARAMETER_DAMPING, damping_of(&found[chosen]));
    if (!core_end(core, good)) return;
    core_edited(core, core->active);
    const int length = snprintf(text, sizeof text, "%s: %.2f Hz, damping %.3g.", chosen ? "Runner-up" : "Best",
                                found[chosen].frequency, found[chosen].damping);
    char *rest = text + length;
    const size_t room = sizeof text - (size_t)length;
    if (count == 1) {
        snprintf(rest, room, " There is no runner-up.");
    } else {
        snprintf(rest, room, " Shift+F again for the %s: %.2f Hz.", chosen ? "best" : "runner-up",
                 found[1 - chosen].frequency);
    }
    core_message(core, false, text);
}
