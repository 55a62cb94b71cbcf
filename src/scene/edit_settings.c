/// Edits of a spline's mode, start and parameters.
#include "scene/edit_plan.h"
#include "scene/number.h"
#include "scene/order.h"
#include <math.h>

static const double TWO_PI = 6.283185307179586;

static bool same_settings(const struct settings *a, const struct settings *b)
{
    bool same = a->spring_friction == b->spring_friction;
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

/// ω = √k, ζ = γ/2√k, or back: k = ω², γ = 2ζω. The pair that is dropped returns to its default.
static bool convert_spring(const struct spline *spline, struct settings *settings, bool to_spring,
                           struct error *error)
{
    enum parameter from[] = {PARAMETER_FREQUENCY, PARAMETER_DAMPING}, to[] = {PARAMETER_SPRING, PARAMETER_FRICTION};
    double number[2], result[2];
    for (int i = 0; i < 2; i++) {
        enum parameter source = to_spring ? from[i] : to[i];
        number[i] = settings->parameter[source].value;
        if (settings->parameter[source].track >= 0) {
            return fail(error, ERROR_INPUT, "%s: %s follows a spline: make it a number before converting",
                        spline->name, parameter_rows[source].name);
        }
        settings->parameter[source].value = parameter_rows[source].standard;
    }
    double omega = to_spring ? TWO_PI * number[0] : sqrt(number[0]);
    result[0] = to_spring ? omega * omega : omega / TWO_PI;
    result[1] = to_spring ? 2 * number[1] * omega : omega > 0 ? number[1] / (2 * omega) : 0;
    if (!isfinite(result[0]) || !isfinite(result[1])) {
        return fail(error, ERROR_INPUT, "%s: the numbers are too large to convert", spline->name);
    }
    for (int i = 0; i < 2; i++) settings->parameter[to_spring ? to[i] : from[i]].value = result[i];
    settings->spring_friction = to_spring;
    return true;
}

/// Converts and clamps what the mode does not allow.
static bool set_mode(const struct spline *spline, struct settings *settings, enum wiggly_mode mode,
                     struct error *error)
{
    bool converts = mode == WIGGLY_COMPLEX && settings->spring_friction;
    if (converts && !convert_spring(spline, settings, false, error)) return false;
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        double maximum = parameter_maximum(p, mode);
        if (settings->parameter[p].value > maximum) settings->parameter[p].value = maximum;
    }
    return true;
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
    if (parameter == PARAMETER_MODE) return set_mode(spline, settings, (enum wiggly_mode)value, error);
    return parameter != PARAMETER_START || value != WIGGLY_LOOP || check_loop(document, spline, error);
}

bool plan_parameter(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    if ((unsigned)edit->parameter >= PARAMETER_COUNT) return fail(error, ERROR_INPUT, "there is no such parameter");
    if (!spline_has(spline, edit->parameter)) {
        return fail(error, ERROR_INPUT, "%s: %s is not in use", spline->name, parameter_rows[edit->parameter].name);
    }
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

bool plan_spring(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    if (spline_mode(spline) != WIGGLY_REAL) {
        return fail(error, ERROR_INPUT, "%s: spring and friction are for real mode only", spline->name);
    }
    if (edit->flag == settings.spring_friction) return true;
    if (!convert_spring(spline, &settings, edit->flag, error)) return false;
    return add_settings(document, edit, &settings, list, error);
}
