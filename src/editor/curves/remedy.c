/// Fixes warnings. Against a swing, each remedy is tried on the solved document, and the first that helps is kept.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/curves/curves.h"
#include "editor/curves/view.h"
#include "editor/curves/warnings.h"
#include "scene/motion.h"
#include <math.h>
#include <stdio.h>

enum { LOWER_STEPS = 8 };

static const double LOWER = 0.9; ///< factor of the frequency from try to try

/// Swings that the spline has too many of with the document as it is now; -1 where it cannot be solved.
static int count_swings(const struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    struct evaluation trial = {.method = core->method, .pins = world->evaluation->pins};
    struct warnings found = {0};
    bool good = evaluation_resize(&trial, document, NULL);
    if (good) {
        motions_copy(&trial, world->evaluation);
        evaluation_update(&trial, document, NULL, false);
        warnings_find(document, &trial, core->active, &found);
    }
    int count = 0;
    for (int i = 0; i < found.count; i++) count += found.list[i].kind == WARNING_SWING;
    evaluation_free(&trial);
    return good ? count : -1;
}

/// Does an edit in the open step and says whether there are fewer swings than `before`; if not, it is taken back.
static bool helps(const struct core *core, const struct editor_world *world, const struct edit *edit, int before)
{
    struct document *document = world->document;
    int count = -1;
    if (history_apply(world->history, document, edit, NULL)) count = count_swings(core, world);
    if (count >= 0 && count < before) return true;
    history_restart(world->history, document);
    return false;
}

static bool lower_frequency(const struct core *core, const struct editor_world *world, const struct spline *spline,
                            int before, char text[96])
{
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    double value = frequency->value;
    if (frequency->track >= 0 || spline->spring_friction) return false;
    for (int i = 0; i < LOWER_STEPS; i++) {
        value = core_round(value * LOWER, 0.01);
        struct edit edit = core_parameter_edit(core->active, PARAMETER_FREQUENCY, value);
        if (!helps(core, world, &edit, before)) continue;
        snprintf(text, 96, "Lowered the frequency to %.3g Hz to tame the swing.", value);
        return true;
    }
    return false;
}

/// A limit on the side of the swing, a little beyond the knots.
static bool limit_curve(const struct core *core, const struct editor_world *world, const struct spline *spline,
                        const struct warning *warning, int before, char text[96])
{
    const enum parameter side = warning->value > warning->remedy ? PARAMETER_HIGH : PARAMETER_LOW;
    const double value = core_fresh_limit(spline, side);
    struct edit edit = core_parameter_edit(core->active, side, value);
    if (isfinite(spline->parameter[side].value) || !helps(core, world, &edit, before)) return false;
    snprintf(text, 96, "Set the %s to %.6g to tame the swing.", parameter_rows[side].name, value);
    return true;
}

static bool tame(const struct curves *curves, const struct core *core, const struct editor_world *world,
                 const struct warning *warning, char text[96])
{
    const struct spline *spline = core_active_spline(core, world);
    int before = count_swings(core, world);
    struct edit calm = core_parameter_edit(core->active, PARAMETER_CALM, 1);
    struct edit hold = core_edit_of(EDIT_KNOT_INSERT, core->active);
    double resolution = 0.01 / curves_pixels_per_value(curves, core);
    hold.knot = (struct knot){.frame = warning->frame,
                              .value = core_round(warning->remedy, resolution),
                              .stiffness = KNOT_DEFAULT_STIFFNESS};
    if (spline->parameter[PARAMETER_CALM].value < 1 && helps(core, world, &calm, before)) {
        snprintf(text, 96, "Raised calm to 1 to tame the swing.");
        return true;
    }
    if (helps(core, world, &hold, before)) {
        snprintf(text, 96, "Added a knot at frame %.6g to tame the swing.", warning->frame);
        return true;
    }
    if (limit_curve(core, world, spline, warning, before, text)) return true;
    return lower_frequency(core, world, spline, before, text);
}

/// More substeps keep the motion as it is; where there is no room for them the frequency gives way.
static bool resolve_rate(struct core *core, const struct editor_world *world, const struct warning *warning,
                         char text[96])
{
    struct edit edit = core_edit_of(EDIT_SUBSTEPS, -1);
    edit.substeps = (int)fmin(warning->remedy, SCENE_MAX_SUBSTEPS);
    snprintf(text, 96, "%d substeps a frame.", edit.substeps);
    if (warning->remedy <= SCENE_MAX_SUBSTEPS && history_apply(world->history, world->document, &edit, NULL)) {
        return true;
    }
    const struct spline *spline = core_active_spline(core, world);
    double value = spline->parameter[PARAMETER_FREQUENCY].value * warning->limit / warning->amount;
    edit = core_parameter_edit(core->active, PARAMETER_FREQUENCY, core_round(0.99 * value, 0.01));
    snprintf(text, 96, "%.3g Hz.", edit.param.value);
    return core_edit(core, world, &edit);
}

static bool switch_off(struct core *core, const struct editor_world *world, const struct warning *warning,
                       char text[96])
{
    const struct spline *spline = core_active_spline(core, world);
    int k = spline_find_knot(world->document, spline, document_sample(world->document, warning->frame));
    struct edit edit = core_edit_of(EDIT_KNOT_SET, core->active);
    if (k < 0) return false;
    edit.knot = spline->knots[k];
    edit.knot.has_slope = false;
    snprintf(text, 96, "The slope at frame %.6g is off.", warning->frame);
    return core_edit(core, world, &edit);
}

void curves_remedy_first(struct curves *curves, struct core *core, const struct editor_world *world)
{
    warnings_update(curves, core, world);
    if (curves->warnings.count > 0) {
        warning_remedy(curves, core, world, &curves->warnings.list[0]);
    } else {
        core_message(core, false, "This spline has no warnings.");
    }
}

void warning_remedy(const struct curves *curves, struct core *core, const struct editor_world *world,
                    const struct warning *warning)
{
    static const char *const labels[] = {[WARNING_SWING] = "Tame swing",
                                         [WARNING_RATE] = "Add substeps",
                                         [WARNING_DRIFT] = "Narrow bandwidth",
                                         [WARNING_SLOPE] = "Slope off"};
    const struct warning chosen = *warning;
    char text[96] = "";
    bool good = false;
    if (!core_active_spline(core, world) || history_is_open(world->history)) return;
    history_begin(world->history, labels[chosen.kind], 0);
    if (chosen.kind == WARNING_SWING) good = tame(curves, core, world, &chosen, text);
    if (chosen.kind == WARNING_RATE) good = resolve_rate(core, world, &chosen, text);
    if (chosen.kind == WARNING_DRIFT) {
        struct edit edit = core_parameter_edit(core->active, PARAMETER_BANDWIDTH, chosen.remedy);
        good = core_edit(core, world, &edit);
        snprintf(text, sizeof text, "Bandwidth %.3g.", chosen.remedy);
    }
    if (chosen.kind == WARNING_SLOPE) good = switch_off(core, world, &chosen, text);
    history_end(world->history);
    core_reserve(core, world->document);
    if (good) {
        core_message(core, false, text);
    } else if (chosen.kind == WARNING_SWING) {
        core_message(core, false, "Calm, a limit, a knot or a lower frequency would not help here. Move the knots.");
    }
}
