/// The active spline's mode, parameters and start.
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include "editor/inspector/settle.h"
#include <math.h>
#include <stdio.h>

/// How each parameter is shown. `maximum` of the bar for all modes; frequency and damping have their own rule.
struct parameter_row {
    const char *label, *unit, *hint, *undo;
    double maximum, fallback, step;
    int decimals;
};

static const struct parameter_row parameter_rows[PARAMETER_COUNT] = {
    [PARAMETER_FREQUENCY] = {"frequency", "Hz", "How fast it swings, in swings a second (hold F, arrows)",
                             "Set frequency", 12, 1, 0.05, 2},
    [PARAMETER_DAMPING] = {"damping", NULL, "0 rings for ever, 1 is critical (hold Z, arrows)", "Set damping", 1, 0.1,
                           0.01, 2},
    [PARAMETER_BANDWIDTH] = {"bandwidth", NULL,
                             "How freely the swing may change its pace between knots (hold B, arrows)",
                             "Set bandwidth", 1, 0.1, 0.01, 2},
    [PARAMETER_SPRING] = {"spring", "1/s²", "Spring constant k of the paper's equation 12", "Set spring", 2000, 40, 1,
                          1},
    [PARAMETER_FRICTION] = {"friction", "1/s", "Friction gamma of the paper's equation 12", "Set friction", 50, 1,
                            0.1, 2},
    [PARAMETER_CALM] = {"calm", NULL, "What swing at the start costs; 0 is the paper's formula (hold C, arrows)",
                        "Set calm", 1, 1, 0.01, 2},
    [PARAMETER_EQUILIBRIUM] = {"equilibrium", NULL, "Where it comes to rest", "Set equilibrium", 0, 0, 0.01, 2},
};

/// The right end of a parameter's bar; 0 where it has none.
static double bar_maximum(const struct document *document, const struct spline *spline, enum parameter parameter)
{
    if (parameter == PARAMETER_FREQUENCY) return fmin(12, document->fps * document->substeps / 2);
    if (parameter == PARAMETER_DAMPING && spline->mode == WIGGLY_REAL) return 3;
    return parameter_rows[parameter].maximum;
}

static void build_slider(struct inspection *in, const struct spline *spline, enum parameter parameter, struct rect r)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    struct ui_number number = {
        .name = parameter_name(parameter),
        .label = row->label,
        .unit = row->unit,
        .hint = row->hint,
        .maximum = bar_maximum(in->document, spline, parameter),
        .lowest = parameter_minimum(parameter, spline->mode),
        .highest = parameter_maximum(parameter, spline->mode),
        .fallback = row->fallback,
        .step = row->step,
        .decimals = row->decimals,
    };
    struct edit edit = core_edit_of(EDIT_PARAMETER, in->core->active);
    double value = spline->parameter[parameter].value;
    enum ui_change change = ui_value(in->ui, r, &number, &value);
    edit.parameter = parameter;
    edit.param = (struct param){value, -1};
    inspector_change(in, change, row->undo, number.name, &edit);
}

static void build_parameter(struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    struct rect r = ui_row(in->ui, UI_ROW);
    bool may_follow = parameter != PARAMETER_CALM;
    if (may_follow) r.w -= UI_ROW + 2;
    if (spline->parameter[parameter].track < 0) {
        build_slider(in, spline, parameter, r);
    } else {
        inspector_track(in, parameter, parameter_rows[parameter].label, r);
    }
    struct rect button = {r.x + r.w + 2, r.y, UI_ROW, UI_ROW};
    if (may_follow) inspector_follow_button(in, parameter, button);
}

static void build_mode(struct inspection *in, const struct spline *spline)
{
    static const struct ui_choice modes[] = {[WIGGLY_COMPLEX] = {"complex", "Complex"},
                                             [WIGGLY_REAL] = {"real", "Real"},
                                             [WIGGLY_CUBIC] = {"cubic", "Cubic"}};
    int mode = (int)spline->mode;
    struct rect r = ui_row(in->ui, UI_ROW);
    if (ui_hovered(in->ui, r))
        in->ui->hint = "Complex: free to shift in phase. Real: a damped spring. Cubic: no swing (M)";
    if (!ui_segments(in->ui, r, "mode", modes, 3, &mode)) return;
    struct edit edit = core_edit_of(EDIT_MODE, in->core->active);
    edit.mode = (enum wiggly_mode)mode;
    core_step(in->core, in->world, "Change mode", 0, &edit);
}

static void build_start(struct inspection *in, const struct spline *spline)
{
    static const struct ui_choice starts[] = {
        [WIGGLY_FREE] = {"free", "Free"}, [WIGGLY_REST] = {"rest", "Rest"}, [WIGGLY_LOOP] = {"loop", "Loop"}};
    int start = (int)spline->start;
    struct rect r = inspector_labelled(in, "start");
    if (ui_hovered(in->ui, r))
        in->ui->hint = "Free: already swinging. Rest: from standstill. Loop: the end meets the start";
    if (!ui_segments(in->ui, r, "start", starts, 3, &start)) return;
    struct edit edit = core_edit_of(EDIT_START, in->core->active);
    edit.start = (enum wiggly_start)start;
    core_step(in->core, in->world, "Change start", 0, &edit);
}

static void build_spring_toggle(struct inspection *in, const struct spline *spline)
{
    bool on = spline->spring_friction;
    struct rect r = ui_row(in->ui, UI_ROW);
    ui_label(in->ui, (struct rect){r.x, r.y, r.w - 40, r.h}, "spring and friction", theme()->text_dim);
    if (ui_hovered(in->ui, r)) in->ui->hint = "Spring constant and friction in place of frequency and damping";
    r = (struct rect){r.x + r.w - 28, r.y, 28, r.h};
    if (!ui_toggle(in->ui, r, "spring_friction", &on)) return;
    struct edit edit = core_edit_of(EDIT_SPRING, in->core->active);
    edit.flag = on;
    core_step(in->core, in->world, on ? "Use spring and friction" : "Use frequency and damping", 0, &edit);
}

/// What the parameters mean, in one plain sentence.
static void build_settling(struct inspection *in, const struct spline *spline)
{
    char text[128];
    struct settling settling = settle_measure(spline, document_step(in->document));
    double frames = settling.seconds * in->document->fps;
    switch (settling.kind) {
    case SETTLE_UNKNOWN:
        return;
    case SETTLE_NEVER:
        snprintf(text, sizeof text, "Rings for ever.");
        break;
    case SETTLE_CUBIC:
        snprintf(text, sizeof text, "Frequency 0: a plain cubic.");
        break;
    case SETTLE_LATE:
        snprintf(text, sizeof text, "Settles to 5 %% in more than %d s.", SETTLE_LIMIT);
        break;
    case SETTLE_MEASURED:
        snprintf(text, sizeof text, "Settles to 5 %% in %.2f s (%.0f frames).", settling.seconds, frames);
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
    double beta = spline->mode == WIGGLY_COMPLEX ? p[PARAMETER_BANDWIDTH].value : 0;
    double highest = p[PARAMETER_FREQUENCY].value * (1 + beta);
    double limit = in->document->fps * in->document->substeps / 2;
    bool poles = spline->mode != WIGGLY_CUBIC && !spline->spring_friction && p[PARAMETER_FREQUENCY].track < 0;
    if (poles && highest > limit) {
        char text[128];
        snprintf(text, sizeof text, "Faster than half the sample rate (%g Hz): the swing is not seen as it is.",
                 limit);
        ui_paragraph(in->ui, text, theme()->warning);
    }
}

void inspector_spline(struct inspection *in)
{
    struct ui *ui = in->ui;
    struct spline *spline = core_active_spline(in->core, in->world);
    build_mode(in, spline);
    ui_space(ui, 4);
    bool pair = spline->mode == WIGGLY_REAL && spline->spring_friction;
    if (spline->mode == WIGGLY_CUBIC) {
        ui_paragraph(ui, "The classical spline: smooth through the knots, without swing.", theme()->text_dim);
    } else {
        build_parameter(in, spline, pair ? PARAMETER_SPRING : PARAMETER_FREQUENCY);
        build_parameter(in, spline, pair ? PARAMETER_FRICTION : PARAMETER_DAMPING);
        build_settling(in, spline);
        if (spline->mode == WIGGLY_COMPLEX) build_parameter(in, spline, PARAMETER_BANDWIDTH);
        if (spline->mode == WIGGLY_REAL) build_spring_toggle(in, spline);
        build_parameter(in, spline, PARAMETER_CALM);
    }
    build_parameter(in, spline, PARAMETER_EQUILIBRIUM);
    build_start(in, spline);
    build_warnings(in, spline);
}
