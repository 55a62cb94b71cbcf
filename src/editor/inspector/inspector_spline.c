/// The active spline's parameters: a row for each, and the sections "Spline", "Advanced", "Limits and steadiness" and "Variation".
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/inspection.h"
#include "scene/order.h"
#include <math.h>
#include <stdio.h>

static void now(const struct inspection *in, int parameter, struct setting *setting)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    const double value = spline->parameter[parameter].value;
    setting->edit = core_parameter_edit(in->core->active, (enum parameter)parameter, value);
}

static void build_slider(struct inspection *in, enum parameter parameter, struct rect r)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct number_row number = {.name = row->name,
                                      .label = row->name,
                                      .unit = row->unit,
                                      .hint = row->hint,
                                      .undo = row->undo,
                                      .at = offsetof(struct setting, edit.param.value),
                                      .maximum = core_slider_end(in->document, spline, parameter),
                                      .lowest = row->minimum,
                                      .highest = parameter_maximum(parameter, spline_mode(spline)),
                                      .fallback = row->fresh,
                                      .step = row->step,
                                      .decimals = row->decimals};
    inspector_number(in, &number, now, (int)parameter, r);
}

static void build_number(struct inspection *in, enum parameter parameter)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    struct rect r = ui_row(in->ui, UI_ROW);
    bool may_follow = parameter_rows[parameter].kind == PARAMETER_TRACK;
    if (may_follow) r.w -= UI_ROW + 2;
    if (!param_follows(&spline->parameter[parameter])) {
        build_slider(in, parameter, r);
    } else {
        inspector_track(in, parameter, parameter_rows[parameter].name, r);
    }
    struct rect button = {r.x + r.w + 2, r.y, UI_ROW, UI_ROW};
    if (may_follow) inspector_track_button(in, parameter, button);
    if (spline->parameter[parameter].motion) inspector_joint(in);
}

static void build_choice(struct inspection *in, enum parameter parameter)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    const struct parameter_row *row = &parameter_rows[parameter];
    struct ui_choice choices[PARAMETER_MAX_WORDS];
    int chosen = (int)spline->parameter[parameter].value, count = 0;
    for (; row->words[count]; count++) choices[count] = (struct ui_choice){row->words[count], row->labels[count]};
    struct rect r = parameter == PARAMETER_MODE ? ui_row(in->ui, UI_ROW) : inspector_labelled(in, row->name);
    ui_hint(in->ui, r, row->hint);
    if (!ui_segments(in->ui, r, row->name, choices, count, &chosen)) return;
    struct edit edit = core_parameter_edit(in->core->active, parameter, chosen);
    core_step(in->core, in->world, row->undo, 0, &edit);
}

void inspector_parameter(struct inspection *in, enum parameter parameter)
{
    if (!spline_uses(core_active_spline(in->core, in->world), parameter, false)) return;
    if (parameter_rows[parameter].kind == PARAMETER_CHOICE) {
        build_choice(in, parameter);
    } else {
        build_number(in, parameter);
    }
}

void inspector_spline(struct inspection *in)
{
    static const enum parameter shown[] = {PARAMETER_MODE, PARAMETER_EQUILIBRIUM, PARAMETER_START};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) inspector_parameter(in, shown[i]);
}

static void build_spring_toggle(struct inspection *in, const struct spline *spline)
{
    bool on = spline->spring_friction;
    struct rect r = ui_row(in->ui, UI_ROW);
    ui_label(in->ui, (struct rect){r.x, r.y, r.w - 40, r.h}, "spring and friction", theme()->text_dim);
    ui_hint(in->ui, r, "Use spring constant and friction instead of frequency and damping");
    r = (struct rect){r.x + r.w - 28, r.y, 28, r.h};
    if (!ui_toggle(in->ui, r, "spring_friction", &on)) return;
    struct edit edit = core_edit_of(EDIT_SPRING, in->core->active);
    edit.flag = on;
    core_step(in->core, in->world, on ? "Use spring and friction" : "Use frequency and damping", 0, &edit);
}

void inspector_advanced(struct inspection *in)
{
    static const enum parameter shown[] = {PARAMETER_BANDWIDTH, PARAMETER_CALM, PARAMETER_PASSIVE};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) inspector_parameter(in, shown[i]);
    const struct spline *spline = core_active_spline(in->core, in->world);
    if (spline_mode(spline) == WIGGLY_REAL) build_spring_toggle(in, spline);
}

/// A number and a switch beside it; off, the name alone.
static void build_limit(struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct rect r = ui_row(in->ui, UI_ROW);
    const struct rect name = {r.x, r.y, r.w - 34, r.h}, at = {r.x + r.w - 28, r.y, 28, r.h};
    bool on = isfinite(spline->parameter[parameter].value);
    if (on) {
        build_slider(in, parameter, name);
    } else {
        ui_label(in->ui, name, row->name, theme()->text_dim);
    }
    ui_hint(in->ui, r, row->hint);
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
    inspector_parameter(in, PARAMETER_STEADY);
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
    core_edited(in->core, in->core->active);
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
    build_slider(in, PARAMETER_VARIATION, ui_row(in->ui, UI_ROW));
    struct rect r = ui_row(in->ui, UI_ROW), button = {r.x + r.w - 64, r.y + 2, 64, r.h - 4};
    r.w -= 70;
    build_slider(in, PARAMETER_SEED, r);
    ui_hint(in->ui, button, "Another motion through the same knots");
    if (ui_button(in->ui, button, "variation.roll", "Roll", false)) roll(in, spline);
    if (reason) ui_paragraph(in->ui, reason, theme()->text_dim);
}
