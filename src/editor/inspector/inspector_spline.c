/// The active spline's mode, parameters and start.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/inspection.h"
#include "editor/inspector/settle.h"
#include "scene/order.h"
#include <math.h>
#include <stdio.h>

static void build_slider(struct inspection *in, const struct spline *spline, enum parameter parameter, struct rect r)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    struct ui_number number = {
        .name = row->name,
        .label = row->name,
        .unit = row->unit,
        .hint = row->hint,
        .maximum = core_slider_end(in->document, spline, parameter),
        .lowest = row->minimum,
        .highest = parameter_maximum(parameter, spline_mode(spline)),
        .fallback = row->fresh,
        .step = row->step,
        .decimals = row->decimals,
    };
    double value = spline->parameter[parameter].value;
    enum ui_change change = ui_value(in->ui, r, &number, &value);
    struct edit edit = core_parameter_edit(in->core->active, parameter, value);
    inspector_change(in, change, row->undo, number.name, &edit);
}

static void build_number(struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    struct rect r = ui_row(in->ui, UI_ROW);
    bool may_follow = parameter_rows[parameter].kind == PARAMETER_TRACK;
    if (may_follow) r.w -= UI_ROW + 2;
    if (!param_follows(&spline->parameter[parameter])) {
        build_slider(in, spline, parameter, r);
    } else {
        inspector_track(in, parameter, parameter_rows[parameter].name, r);
    }
    struct rect button = {r.x + r.w + 2, r.y, UI_ROW, UI_ROW};
    if (may_follow) inspector_track_button(in, parameter, button);
    if (spline->parameter[parameter].motion) inspector_joint(in);
}

static void build_choice(struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    struct ui_choice choices[PARAMETER_MAX_WORDS];
    int chosen = (int)spline->parameter[parameter].value, count = 0;
    for (; row->words[count]; count++) choices[count] = (struct ui_choice){row->words[count], row->labels[count]};
    struct rect r = parameter == PARAMETER_MODE ? ui_row(in->ui, UI_ROW) : inspector_labelled(in, row->name);
    if (ui_hovered(in->ui, r)) in->ui->hint = row->hint;
    if (!ui_segments(in->ui, r, row->name, choices, count, &chosen)) return;
    struct edit edit = core_parameter_edit(in->core->active, parameter, chosen);
    core_step(in->core, in->world, row->undo, 0, &edit);
}

static void build_parameter(struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    if (parameter_rows[parameter].kind == PARAMETER_CHOICE) {
        build_choice(in, spline, parameter);
    } else {
        build_number(in, spline, parameter);
    }
}

static void build_spring_toggle(struct inspection *in, const struct spline *spline)
{
    bool on = spline->spring_friction;
    struct rect r = ui_row(in->ui, UI_ROW);
    ui_label(in->ui, (struct rect){r.x, r.y, r.w - 40, r.h}, "spring and friction", theme()->text_dim);
    if (ui_hovered(in->ui, r)) in->ui->hint = "Use spring constant and friction instead of frequency and damping";
    r = (struct rect){r.x + r.w - 28, r.y, 28, r.h};
    if (!ui_toggle(in->ui, r, "spring_friction", &on)) return;
    struct edit edit = core_edit_of(EDIT_SPRING, in->core->active);
    edit.flag = on;
    core_step(in->core, in->world, on ? "Use spring and friction" : "Use frequency and damping", 0, &edit);
}

/// What the damping means to this motion, in one plain sentence.
static void build_settling(struct inspection *in, const struct spline *spline)
{
    const struct evaluation *evaluation = in->world->evaluation;
    const int active = in->core->active;
    char text[128];
    struct settling settling = settle_alone(spline, document_step(in->document));
    if (evaluation && active < evaluation->count && spline->knot_count > 0) {
        int last = document_sample(in->document, spline->knots[spline->knot_count - 1].frame);
        settling = settle_measure(spline, &evaluation->curves[active], last);
    }
    double frames = settling.seconds * in->document->fps;
    switch (settling.kind) {
    case SETTLE_UNKNOWN:
        return;
    case SETTLE_NEVER:
        snprintf(text, sizeof text, "Rings forever.");
        break;
    case SETTLE_CUBIC:
        snprintf(text, sizeof text, "Frequency 0 makes it a plain cubic.");
        break;
    case SETTLE_LATE:
        snprintf(text, sizeof text, "Takes more than %d s to settle to 5 %%.", SETTLE_LIMIT);
        break;
    case SETTLE_ALONE:
        snprintf(text, sizeof text, "Settles to 5 %% in %.2f s (%.0f frames).", settling.seconds, frames);
        break;
    case SETTLE_SEEN:
        snprintf(text, sizeof text, "Settles to 5 %% %.0f frames after the last knot.", ceil(frames - 1e-6));
        break;
    case SETTLE_LEFT:
        snprintf(text, sizeof text, "At the end %.0f %% of the swing is left.", 100 * settling.left);
        break;
    }
    ui_paragraph(in->ui, text, theme()->text_dim);
}

static void build_warnings(struct inspection *in, const struct spline *spline)
{
    const struct evaluation *evaluation = in->world->evaluation;
    int active = in->core->active;
    if (evaluation && active < evaluation->count && evaluation->status[active] != WIGGLY_OK) {
        ui_paragraph(in->ui, wiggly_status_text(evaluation->status[active]), theme()->warning);
    }
    const struct param *p = spline->parameter;
    double beta = spline_mode(spline) == WIGGLY_COMPLEX ? p[PARAMETER_BANDWIDTH].value : 0;
    double highest = p[PARAMETER_FREQUENCY].value * (1 + beta);
    double limit = in->document->fps * in->document->substeps / 2;
    bool poles = spline_mode(spline) != WIGGLY_CUBIC && !spline->spring_friction && p[PARAMETER_FREQUENCY].track < 0;
    if (poles && highest > limit) {
        char text[128];
        snprintf(text, sizeof text, "Faster than half the sample rate (%g Hz): the swing aliases.", limit);
        ui_paragraph(in->ui, text, theme()->warning);
    }
}

/// Below frequency and damping, or what stands for them.
static void build_pair(struct inspection *in, const struct spline *spline)
{
    build_settling(in, spline);
    if (spline_mode(spline) == WIGGLY_REAL) build_spring_toggle(in, spline);
}

void inspector_spline(struct inspection *in)
{
    struct spline *spline = core_active_spline(in->core, in->world);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        if (!spline_uses(spline, p, false) || p >= PARAMETER_LOW || p == PARAMETER_STEADY)
            continue; // they have sections
        build_parameter(in, spline, p);
        if (p == PARAMETER_MODE) ui_space(in->ui, 4);
        if (p == PARAMETER_MODE && spline_mode(spline) == WIGGLY_CUBIC)
            ui_paragraph(in->ui, "The classical spline: smooth through the knots, with no swing.", theme()->text_dim);
        if (p == PARAMETER_DAMPING || p == PARAMETER_FRICTION) build_pair(in, spline);
    }
    build_warnings(in, spline);
}

/// A number and a switch beside it; off, the name alone.
static void build_limit(struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct rect r = ui_row(in->ui, UI_ROW);
    const struct rect name = {r.x, r.y, r.w - 34, r.h}, at = {r.x + r.w - 28, r.y, 28, r.h};
    bool on = isfinite(spline->parameter[parameter].value);
    if (on) {
        build_slider(in, spline, parameter, name);
    } else {
        ui_label(in->ui, name, row->name, theme()->text_dim);
    }
    if (ui_hovered(in->ui, r)) in->ui->hint = row->hint;
    if (!ui_toggle(in->ui, at, parameter == PARAMETER_HIGH ? "limit.high" : "limit.low", &on)) return;
    struct edit edit =
        core_parameter_edit(in->core->active, parameter, on ? core_fresh_limit(spline, parameter) : row->standard);
    core_step(in->core, in->world, row->undo, 0, &edit);
}

void inspector_limits(struct inspection *in)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    build_limit(in, spline, PARAMETER_HIGH);
    build_limit(in, spline, PARAMETER_LOW);
    if (spline_uses(spline, PARAMETER_STEADY, false)) build_parameter(in, spline, PARAMETER_STEADY);
}

/// Of a roll where there is no variation yet.
static const double FRESH_VARIATION = 0.3;

/// Another seed, and an amount where there was none, as one step.
static void roll(struct inspection *in, const struct spline *spline)
{
    const int most = (int)parameter_rows[PARAMETER_SEED].maximum + 1;
    const long long seed = (long long)spline->parameter[PARAMETER_SEED].value;
    struct edit edit = core_parameter_edit(in->core->active, PARAMETER_SEED, (double)((seed * 7 + 1) % 1000 % most));
    history_begin(in->world->history, "Roll variation", 0);
    core_edit(in->core, in->world, &edit);
    edit = core_parameter_edit(in->core->active, PARAMETER_VARIATION, FRESH_VARIATION);
    if (spline->parameter[PARAMETER_VARIATION].value == 0) core_edit(in->core, in->world, &edit);
    history_end(in->world->history);
}

/// Why there is no variation to see; NULL: there is.
static const char *stillness(const struct spline *spline)
{
    const struct param *p = spline->parameter;
    if (p[PARAMETER_PASSIVE].value != WIGGLY_OSCILLATOR) return "The paper's filter has no variations.";
    for (enum parameter n = PARAMETER_FREQUENCY; n <= PARAMETER_FRICTION; n++) {
        if (p[n].track >= 0 && spline_uses(spline, n, false))
            return "Where frequency or damping follow a spline there are no variations.";
    }
    const enum parameter pace = spline->spring_friction ? PARAMETER_SPRING : PARAMETER_FREQUENCY;
    return p[pace].value > 0 ? NULL : "What does not swing has no variations.";
}

void inspector_variation(struct inspection *in)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    const char *reason = stillness(spline);
    build_slider(in, spline, PARAMETER_VARIATION, ui_row(in->ui, UI_ROW));
    struct rect r = ui_row(in->ui, UI_ROW), button = {r.x + r.w - 64, r.y + 2, 64, r.h - 4};
    r.w -= 70;
    build_slider(in, spline, PARAMETER_SEED, r);
    if (ui_hovered(in->ui, button)) in->ui->hint = "Another motion through the same knots";
    if (ui_button(in->ui, button, "variation.roll", "Roll", false)) roll(in, spline);
    if (reason) ui_paragraph(in->ui, reason, theme()->text_dim);
}
