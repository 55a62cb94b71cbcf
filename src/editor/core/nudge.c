/// Changes by key: knots and parameters in small steps. Equal nudges of the same knots are one undo step.
#include "editor/core/nudge.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/core/state.h"
#include <math.h>
#include <stdio.h>

/// Kinds of nudges for merge_key().
enum nudge_kind { NUDGE_FRAMES = 1, NUDGE_VALUE, NUDGE_PARAMETER = 100 };

static const double TAU = 6.283185307179586;

/// Where the selected knots would collide with others, or leave the range, when shifted.
enum shift_outcome { SHIFT_FREE, SHIFT_OCCUPIED, SHIFT_OUTSIDE };

static enum shift_outcome try_shift(const struct core *core, const struct document *document,
                                    const struct spline *spline, double frames)
{
    enum shift_outcome outcome = SHIFT_FREE;
    for (int k = 0; k < spline->knot_count; k++) {
        if (!selection_has(&core->selection, spline->knots[k].id)) continue;
        int sample = document_sample(document, spline->knots[k].frame + frames);
        if (sample < 0 || sample > document_last_knot_sample(document, spline)) return SHIFT_OUTSIDE;
        int at = spline_find_knot(document, spline, sample);
        if (at >= 0 && !selection_has(&core->selection, spline->knots[at].id)) outcome = SHIFT_OCCUPIED;
    }
    return outcome;
}

/// The shift itself, or the next multiple of it behind the knots that are in the way; 0 where there is no room.
static double free_shift(const struct core *core, const struct document *document, const struct spline *spline,
                         double frames)
{
    for (double shift = frames; frames != 0; shift += frames) {
        enum shift_outcome outcome = try_shift(core, document, spline, shift);
        if (outcome == SHIFT_FREE) return shift;
        if (outcome == SHIFT_OUTSIDE) break;
    }
    return 0;
}

void nudge_knots(struct core *core, const struct editor_world *world, double frames, double value)
{
    struct spline *spline = core_active_spline(core, world);
    if (selection_count(&core->selection, spline) == 0 || history_is_open(world->history)) return;
    double shift = free_shift(core, world->document, spline, frames);
    if (shift == 0 && value == 0) return;
    uint64_t merge = merge_key(core, world, frames != 0 ? NUDGE_FRAMES : NUDGE_VALUE);
    history_begin(world->history, "Nudge knots", merge);
    for (int i = 0, count = spline->knot_count; i < count; i++) {
        int k = shift > 0 ? count - 1 - i : i; /* from the far end, so that they do not run into each other */
        if (!selection_has(&core->selection, spline->knots[k].id)) continue;
        struct edit edit = core_edit_of(EDIT_KNOT_SET, core->active);
        edit.knot = spline->knots[k];
        edit.knot.frame += shift;
        if (value != 0) edit.knot.value = round_value(edit.knot.value + value, 0.01 * fabs(value));
        core_edit(core, world, &edit);
    }
    history_end(world->history);
}

const struct channel *active_channel(const struct core *core, const struct document *document, int *tail,
                                     int *channel)
{
    const struct channel *first = NULL;
    for (int t = document->tail_count - 1; t >= 0; t--) {
        for (int c = document->tails[t].channel_count - 1; c >= 0; c--) {
            const struct channel *candidate = &document->tails[t].channels[c];
            if (first && first->spline == core->active && candidate->spline != core->active) continue;
            first = candidate;
            *tail = t;
            *channel = c;
        }
    }
    return first;
}

static void nudge_lag(struct core *core, const struct editor_world *world, double degrees)
{
    int tail = -1, channel = -1;
    const struct channel *active = active_channel(core, world->document, &tail, &channel);
    if (!active) {
        core_message(core, false, "Nothing lags here: the scene has no tail.");
        return;
    }
    struct angles lag = active->lag;
    int count = lag.each ? world->document->tails[tail].joints : 1;
    for (int n = 0; n < count; n++) lag.value[n] += lag.each ? n * degrees : degrees;
    struct edit edit = core_edit_of(EDIT_ANGLES, core->active);
    edit.tail = tail;
    edit.channel = channel;
    edit.angle = ANGLE_LAG;
    edit.angles = &lag;
    uint64_t kind = NUDGE_PARAMETER + PARAMETER_COUNT + (uint64_t)(tail * 4096 + channel);
    core_step(core, world, "Change lag", merge_key(core, world, kind), &edit);
}

/// What a held letter stands for, and its step (design: "mode; f, ζ, β, calm, lag").
static const struct parameter_key {
    int letter;
    enum parameter parameter;
    double step;
} parameter_keys[] = {
    {.letter = 'F', .parameter = PARAMETER_FREQUENCY, .step = 0.05},
    {.letter = 'Z', .parameter = PARAMETER_DAMPING, .step = 0.01},
    {.letter = 'B', .parameter = PARAMETER_BANDWIDTH, .step = 0.01},
    {.letter = 'C', .parameter = PARAMETER_CALM, .step = 0.01},
};

/// The same step where the spline has spring and friction instead: f = √k/2π, ζ = γ/2√k.
static void step_spring(const struct spline *spline, struct edit *edit, double step)
{
    double spring = spline->parameter[PARAMETER_SPRING].value;
    if (edit->parameter == PARAMETER_FREQUENCY) {
        double frequency = fmax(sqrt(fmax(spring, 0)) / TAU + step, 0);
        edit->parameter = PARAMETER_SPRING;
        edit->param.value = TAU * frequency * TAU * frequency;
    } else {
        edit->parameter = PARAMETER_FRICTION;
        edit->param.value = spline->parameter[PARAMETER_FRICTION].value + step * 2 * sqrt(fmax(spring, 1));
    }
    edit->param.track = spline->parameter[edit->parameter].track;
}

static double slider_maximum(const struct document *document, enum parameter parameter, enum wiggly_mode mode)
{
    double most = parameter_maximum(parameter, mode);
    if (parameter == PARAMETER_FREQUENCY) most = fmin(most, fmin(12, document->fps * document->substeps / 2));
    if (parameter == PARAMETER_DAMPING) most = fmin(most, mode == WIGGLY_REAL ? 3 : 1);
    return most;
}

/// Why a parameter does nothing now, or NULL.
static const char *why_idle(const struct spline *spline, enum parameter parameter)
{
    if (parameter == PARAMETER_CALM) return NULL;
    if (spline->mode == WIGGLY_CUBIC) return "A cubic neither swings nor rings; M changes the mode.";
    if (parameter == PARAMETER_BANDWIDTH && spline->mode == WIGGLY_REAL) {
        return "Only the complex mode has a bandwidth; M changes the mode.";
    }
    return NULL;
}

static void nudge_one(struct core *core, const struct editor_world *world, const struct spline *spline,
                      enum parameter parameter, double step)
{
    const char *idle = why_idle(spline, parameter);
    if (idle) {
        core_message(core, false, idle);
        return;
    }
    struct edit edit = core_edit_of(EDIT_PARAMETER, core->active);
    edit.parameter = parameter;
    edit.param = spline->parameter[parameter];
    bool pair = spline->spring_friction && (parameter == PARAMETER_FREQUENCY || parameter == PARAMETER_DAMPING);
    if (pair) step_spring(spline, &edit, step);
    if (edit.param.track >= 0) {
        char text[160];
        snprintf(text, sizeof text, "The %s follows the spline \"%.60s\".", parameter_name(edit.parameter),
                 world->document->splines[edit.param.track].name);
        core_message(core, false, text);
        return;
    }
    if (!pair)
        edit.param.value =
            round((edit.param.value + step) * 1e6) / 1e6; /* 0.30000000000000004 is no number to save */
    double most =
        fmax(slider_maximum(world->document, edit.parameter, spline->mode), spline->parameter[edit.parameter].value);
    edit.param.value = fmin(fmax(edit.param.value, parameter_minimum(edit.parameter, spline->mode)), most);
    if (edit.param.value == spline->parameter[edit.parameter].value) return;
    core_step(core, world, "Change parameter", merge_key(core, world, NUDGE_PARAMETER + edit.parameter), &edit);
}

void nudge_parameter(struct core *core, const struct editor_world *world, int letter, int direction)
{
    const struct spline *spline = core_active_spline(core, world);
    if (letter == 'L') nudge_lag(core, world, 0.5 * direction);
    for (size_t i = 0; spline && i < sizeof parameter_keys / sizeof parameter_keys[0]; i++) {
        if (parameter_keys[i].letter != letter) continue;
        nudge_one(core, world, spline, parameter_keys[i].parameter, parameter_keys[i].step * direction);
    }
}

void cycle_mode(struct core *core, const struct editor_world *world)
{
    const struct spline *spline = core_active_spline(core, world);
    if (!spline) return;
    struct edit edit = core_edit_of(EDIT_MODE, core->active);
    edit.mode = spline->mode == WIGGLY_COMPLEX ? WIGGLY_REAL
                : spline->mode == WIGGLY_REAL  ? WIGGLY_CUBIC
                                               : WIGGLY_COMPLEX;
    core_step(core, world, "Change mode", 0, &edit);
}
