/// Edits of a spline's mode, start and parameters.
#include "scene/edit_plan.h"
#include "scene/number.h"
#include "scene/order.h"
#include <math.h>

static bool same_settings(const struct settings *a, const struct settings *b)
{
    bool same = true;
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        const struct param *one = &a->parameter[i], *other = &b->parameter[i];
        same &= one->value == other->value && one->track == other->track && one->motion == other->motion &&
                one->gain == other->gain;
    }
    return same;
}

static bool add_settings(struct document *document, const struct edit *edit, const struct settings *settings,
                         struct change_list *list, struct error *error)
{
    struct settings old = settings_of(&document->splines[edit->spline]);
    struct change change = {.kind = CHANGE_SETTINGS, .spline = edit->spline, .settings = *settings};
    return same_settings(&old, settings) || plan_add(list, &change, error);
}

/// Whether a spline may follow another in a parameter, found by trying it on the document.
static bool check_track(struct document *document, const struct edit *edit, struct error *error)
{
    struct spline *spline = &document->splines[edit->spline];
    struct order_cycle cycle;
    int track = edit->param.track;
    const struct parameter_row *row = &parameter_rows[edit->parameter];
    if (row->kind != PARAMETER_TRACK)
        return fail(error, ERROR_INPUT, "%s: %s must be a number", spline->name, row->name);
    if (track >= document->spline_count) {
        return fail(error, ERROR_INPUT, "%s: there is no spline to follow", spline->name);
    }
    struct param old = spline->parameter[edit->parameter];
    spline->parameter[edit->parameter].track = track;
    bool good = scene_has_order(document, &cycle);
    spline->parameter[edit->parameter] = old;
    if (good) return true;
    if (cycle.spline < 0) return plan_no_memory(error);
    return fail(error, ERROR_INPUT, "%s cannot follow %s, which already follows it", spline->name,
                document->splines[track].name);
}

/// Makes `param` follow the edit's motion, with the document's own copy of it.
static bool set_motion(struct document *document, const struct edit *edit, struct param *param, struct error *error)
{
    const char *name = document->splines[edit->spline].name;
    struct joint_motion motion = *edit->param.motion;
    const char *model = motion.model ? motion.model : "";
    if (edit->parameter != PARAMETER_EQUILIBRIUM) {
        return fail(error, ERROR_INPUT, "%s: only the equilibrium follows a joint", name);
    }
    if (!motion.joint || !motion.joint[0] || (unsigned)motion.of >= MOTION_KINDS || !isfinite(edit->param.gain)) {
        return fail(error, ERROR_INPUT, "%s: a motion needs a joint and a finite gain", name);
    }
    motion.by_file = document_find_model(document, model, false) < 0;
    if (document_find_model(document, model, motion.by_file) < 0) {
        return fail(error, ERROR_INPUT, "%s: there is no model \"%s\" to follow", name, model);
    }
    if (motion.chain && document_find_chain(document, motion.chain) < 0) {
        return fail(error, ERROR_INPUT, "%s: there is no chain \"%s\"", name, motion.chain);
    }
    *param = (struct param){0, -1, motion_list_keep(&document->motions, &motion), edit->param.gain + 0.0};
    return param->motion || plan_no_memory(error);
}

static bool check_constant(const struct spline *spline, enum parameter parameter, double value, struct error *error)
{
    double low = parameter_rows[parameter].minimum, high = parameter_maximum(parameter, spline_mode(spline));
    const char *name = parameter_rows[parameter].name;
    if (!isfinite(value)) return fail(error, ERROR_INPUT, "%s: %s must be finite", spline->name, name);
    if (parameter_rows[parameter].kind == PARAMETER_WHOLE && value != floor(value))
        return fail(error, ERROR_INPUT, "%s: %s must be a whole number", spline->name, name);
    if (value >= low && value <= high) return true;
    if (value < low) return fail(error, ERROR_INPUT, "%s: %s must be at least %g", spline->name, name, low);
    return fail(error, ERROR_INPUT, "%s: %s must be at most %g", spline->name, name, high);
}

/// A limit may be infinite, which is none; knots stay within.
static bool check_limit(const struct document *document, const struct spline *spline, enum parameter parameter,
                        double value, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const bool is_high = parameter == PARAMETER_HIGH;
    const double other = spline->parameter[is_high ? PARAMETER_LOW : PARAMETER_HIGH].value;
    if (value == row->standard) return true;
    if (!isfinite(value)) return fail(error, ERROR_INPUT, "%s: a limit must be finite", spline->name);
    if (!document_check_samples(1, document_samples(document), true, error)) return false;
    if (is_high ? value <= other : value >= other)
        return fail(error, ERROR_INPUT, "%s: the low limit must be below the high one", spline->name);
    for (int k = 0; k < spline->knot_count; k++) {
        char frame[NUMBER_TEXT_SIZE];
        if (is_high ? spline->knots[k].value <= value : spline->knots[k].value >= value) continue;
        number_print(spline->knots[k].frame, frame);
        return fail(error, ERROR_INPUT, "%s: the knot at frame %s is %s that", spline->name, frame,
                    is_high ? "above" : "below");
    }
    return true;
}

/// Clamps what the mode does not allow.
static void clamp_to_mode(struct settings *settings, enum wiggly_mode mode)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++)
        settings->parameter[p].value = fmin(settings->parameter[p].value, parameter_maximum(p, mode));
}

static bool check_loop(const struct document *document, const struct spline *spline, struct error *error)
{
    int last = document_samples(document) - 1;
    if (last == 0) return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", spline->name);
    if (spline_find_knot(document, spline, last) < 0) return true;
    return fail(error, ERROR_INPUT,
                "%s: delete the knot at the last frame first; in a loop that frame repeats the first", spline->name);
}

static bool set_choice(const struct document *document, const struct spline *spline, struct settings *settings,
                       enum parameter parameter, double value, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    if (!(value >= 0 && value <= row->maximum && value == floor(value)))
        return fail(error, ERROR_INPUT, "there is no such %s", row->name);
    settings->parameter[parameter] = param_number(value);
    if (parameter == PARAMETER_MODE) clamp_to_mode(settings, (enum wiggly_mode)value);
    return parameter != PARAMETER_START || value != WIGGLY_LOOP || check_loop(document, spline, error);
}

bool plan_parameter(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    if ((unsigned)edit->parameter >= PARAMETER_COUNT) return fail(error, ERROR_INPUT, "there is no such parameter");
    struct param *param = &settings.parameter[edit->parameter];
    if (parameter_rows[edit->parameter].kind == PARAMETER_CHOICE) {
        if (!set_choice(document, spline, &settings, edit->parameter, edit->param.value, error)) return false;
    } else if (edit->param.motion) {
        if (!set_motion(document, edit, param, error)) return false;
    } else if (edit->param.track >= 0) {
        if (!check_track(document, edit, error)) return false;
        *param = param_track(edit->param.track);
    } else {
        const bool limits = parameter_rows[edit->parameter].kind == PARAMETER_LIMIT;
        const double value = edit->param.value;
        if (!(limits ? check_limit(document, spline, edit->parameter, value, error)
                     : check_constant(spline, edit->parameter, value, error)))
            return false;
        *param = param_number(edit->param.value + 0.0);
    }
    return add_settings(document, edit, &settings, list, error);
}
