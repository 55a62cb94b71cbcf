/// Edits of a spline's mode, start and parameters.
#include "scene/editing.h"
#include "scene/order.h"
#include "scene/text.h"
#include <math.h>
#include <string.h>

static bool same_param(const struct param *a, const struct param *b)
{
    return a->value == b->value && a->track == b->track && a->gain == b->gain && motion_equals(a->motion, b->motion);
}

/// Gives the spline the parameters of `wanted`.
static void set(struct document *document, int index, const struct spline *wanted)
{
    const struct spline *old = document->splines[index];
    bool same = true;
    for (int p = 0; p < PARAMETER_COUNT; p++) same &= same_param(&old->parameter[p], &wanted->parameter[p]);
    if (same) return;
    struct spline *own = document_own_spline(document, index);
    motion_hold(wanted->parameter[PARAMETER_EQUILIBRIUM].motion);
    motion_drop(own->parameter[PARAMETER_EQUILIBRIUM].motion);
    memcpy(own->parameter, wanted->parameter, sizeof own->parameter);
}

static bool check_track(const struct document *document, const struct spline *spline, enum parameter parameter,
                        int track, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    if (row->kind != PARAMETER_TRACK)
        return fail(error, ERROR_INPUT, "%s: %s must be a number", spline->name, row->name);
    return track < document->spline_count ||
           fail(error, ERROR_INPUT, "%s: there is no spline to follow", spline->name);
}

/// The motion as the document has it, with one holder; NULL: it may not be followed.
static struct joint_motion *new_motion(const struct document *document, const struct spline *spline,
                                       enum parameter parameter, const struct param *param, struct error *error)
{
    const char *name = spline->name;
    struct joint_motion motion = *param->motion;
    const char *model = motion.model ? motion.model : "";
    bool good = true;
    motion.by_file = document_find_model(document, model, false) < 0;
    if (parameter != PARAMETER_EQUILIBRIUM) {
        good = fail(error, ERROR_INPUT, "%s: only the equilibrium follows a joint", name);
    } else if (!motion.joint || !motion.joint[0] || (unsigned)motion.of >= MOTION_KINDS || !isfinite(param->gain)) {
        good = fail(error, ERROR_INPUT, "%s: a motion needs a joint and a finite gain", name);
    } else if (document_find_model(document, model, motion.by_file) < 0) {
        good = fail(error, ERROR_INPUT, "%s: there is no model \"%s\" to follow", name, model);
    } else if (motion.chain && document_find_chain(document, motion.chain) < 0) {
        good = fail(error, ERROR_INPUT, "%s: there is no chain \"%s\"", name, motion.chain);
    }
    return good ? motion_create(&motion) : NULL;
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
static void clamp_to_mode(struct spline *settings, enum wiggly_mode mode)
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

static bool set_choice(const struct document *document, struct spline *settings, enum parameter parameter,
                       double value, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    if (!(value >= 0 && value <= row->maximum && value == floor(value)))
        return fail(error, ERROR_INPUT, "there is no such %s", row->name);
    settings->parameter[parameter] = param_number(value);
    if (parameter == PARAMETER_MODE) clamp_to_mode(settings, (enum wiggly_mode)value);
    return parameter != PARAMETER_START || value != WIGGLY_LOOP || check_loop(document, settings, error);
}

static bool set_number(const struct document *document, struct spline *settings, enum parameter parameter,
                       double value, struct error *error)
{
    const bool limits = parameter_rows[parameter].kind == PARAMETER_LIMIT;
    if (!(limits ? check_limit(document, settings, parameter, value, error)
                 : check_constant(settings, parameter, value, error)))
        return false;
    settings->parameter[parameter] = param_number(value + 0.0);
    return true;
}

/// Whether no spline follows itself, by way of others.
static bool has_order(const struct document *document, int spline, int track, struct error *error)
{
    struct order_cycle cycle;
    return scene_has_order(document, &cycle) ||
           fail(error, ERROR_INPUT, "%s cannot follow %s, which already follows it", document->splines[spline]->name,
                document->splines[track]->name);
}

static bool change(struct document *document, int spline, enum parameter parameter, const struct param *param,
                   struct error *error)
{
    struct spline settings = *document->splines[spline];
    struct joint_motion *motion = NULL;
    if (parameter_rows[parameter].kind == PARAMETER_CHOICE) {
        if (!set_choice(document, &settings, parameter, param->value, error)) return false;
    } else if (param->motion) {
        motion = new_motion(document, &settings, parameter, param, error);
        if (!motion) return false;
        settings.parameter[parameter] = (struct param){0, -1, motion, param->gain + 0.0};
    } else if (param->track >= 0) {
        if (!check_track(document, &settings, parameter, param->track, error)) return false;
        settings.parameter[parameter] = param_track(param->track);
    } else if (!set_number(document, &settings, parameter, param->value, error)) {
        return false;
    }
    set(document, spline, &settings);
    motion_drop(motion);
    return param->track < 0 || has_order(document, spline, param->track, error);
}

bool edit_parameter(struct document *document, int spline, enum parameter parameter, const struct param *param,
                    struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    if ((unsigned)parameter >= PARAMETER_COUNT) return fail(error, ERROR_INPUT, "there is no such parameter");
    struct document *before = edit_begin(document);
    return edit_end(document, before, change(document, spline, parameter, param, error), error);
}
