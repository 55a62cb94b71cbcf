/// Finds the frequency and damping that explain the active spline's knots best.
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

/// How many explanations the knots have; -1 if memory runs out.
static int explain(const struct core *core, const struct editor_world *world, const struct spline *spline,
                   wiggly_explanation found[2])
{
    const struct evaluation *evaluation = world->evaluation;
    wiggly_desc desc = wiggly_default_desc();
    wiggly_knot *knots = malloc(sizeof *knots * (size_t)spline->knot_count);
    if (!knots) return -1;
    for (int k = 0; k < spline->knot_count; k++) {
        const int sample = document_sample(world->document, spline->knots[k].frame);
        knots[k] = (wiggly_knot){.sample = sample, .value = spline->knots[k].value};
    }
    desc.step = document_step(world->document);
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
static void settings_of(const wiggly_explanation *found, struct edit edits[2], int active)
{
    edits[0] = core_parameter_edit(active, PARAMETER_FREQUENCY, round(found->frequency * 100) / 100);
    edits[1] = core_parameter_edit(active, PARAMETER_DAMPING, round(found->damping * 1000) / 1000);
}

static bool is_set(const struct spline *spline, const struct edit edits[2])
{
    return spline->parameter[edits[0].parameter].value == edits[0].param.value &&
           spline->parameter[edits[1].parameter].value == edits[1].param.value;
}

void core_find_frequency(struct core *core, const struct editor_world *world, int unused)
{
    (void)unused;
    const struct spline *spline = core_active_spline(core, world);
    if (!spline || history_is_open(world->history)) return;
    const char *reason = obstacle(spline);
    wiggly_explanation found[2];
    const int count = reason ? 0 : explain(core, world, spline, found);
    if (count <= 0) {
        if (!reason) reason = "These knots do not swing: no frequency explains them.";
        core_message(core, count < 0, count < 0 ? "There is not enough memory." : reason);
        return;
    }
    struct edit edits[2];
    char text[160];
    settings_of(&found[0], edits, core->active);
    const int chosen = count == 2 && is_set(spline, edits) ? 1 : 0;
    settings_of(&found[chosen], edits, core->active);
    history_begin(world->history, "Find frequency", 0);
    const bool good = core_edit(core, world, &edits[0]) && core_edit(core, world, &edits[1]);
    history_end(world->history);
    if (!good) return;
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
