/// The inspector's list of splines, and the active spline's mode, parameters and start.
#include "editor/inspector.h"
#include <math.h>
#include <stdio.h>

enum { MAX_ROWS = 8 }; ///< splines listed at once

void inspector_splines(struct inspection *in)
{
    struct ui *ui = in->ui;
    const struct document *document = in->document;
    int count = document->spline_count, first = 0;
    if (count == 0) ui_paragraph(ui, "This scene has no splines.", THEME_TEXT_DIM);
    if (count > MAX_ROWS) {
        first = in->editor->active - MAX_ROWS / 2;
        first = first < 0 ? 0 : first > count - MAX_ROWS ? count - MAX_ROWS : first;
    }
    for (int i = first; i < count && i < first + MAX_ROWS; i++) {
        char name[128];
        snprintf(name, sizeof name, "spline.%s", document->splines[i].name);
        struct rect r = ui_row(ui, UI_ROW);
        uint32_t color = theme_spline_color[i % THEME_SPLINE_COLORS];
        if (ui_hovered(ui, r)) ui->hint = "Click to edit this spline (PgUp, PgDn)";
        if (ui_list_row(ui, r, name, document->splines[i].name, color, i == in->editor->active)) {
            editor_activate(in->editor, in->world, i);
        }
    }
    if (count > MAX_ROWS) {
        char text[64];
        snprintf(text, sizeof text, "%d of %d splines; PgUp and PgDn go on", MAX_ROWS, count);
        ui_paragraph(ui, text, THEME_TEXT_DIM);
    }
}

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

/// In place of a slider where a track drives the parameter.
static void build_track(struct inspection *in, const struct parameter_row *row, int track)
{
    char text[160];
    struct rect r = inspector_labelled(in, row->label);
    snprintf(text, sizeof text, "follows %s", in->document->splines[track].name);
    if (in->ui->pass == UI_PASS_DRAW) {
        uint32_t color = theme_spline_color[track % THEME_SPLINE_COLORS];
        drawlist_rounded(in->ui->list, (struct rect){r.x, r.y + (r.h - 8) / 2, 8, 8}, 3, color);
    }
    ui_label(in->ui, (struct rect){r.x + 16, r.y, r.w - 16, r.h}, text, THEME_TEXT);
}

static void build_parameter(struct inspection *in, struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct param *param = &spline->parameter[parameter];
    if (param->track >= 0) {
        build_track(in, row, param->track);
        return;
    }
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
    struct edit edit = editor_edit_of(EDIT_PARAMETER, in->editor->active);
    double value = param->value;
    enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &value);
    edit.parameter = parameter;
    edit.param = (struct param){value, -1};
    inspector_change(in, change, row->undo, number.name, &edit);
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
    struct edit edit = editor_edit_of(EDIT_MODE, in->editor->active);
    edit.mode = (enum wiggly_mode)mode;
    editor_step(in->editor, in->world, "Change mode", 0, &edit);
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
    struct edit edit = editor_edit_of(EDIT_START, in->editor->active);
    edit.start = (enum wiggly_start)start;
    editor_step(in->editor, in->world, "Change start", 0, &edit);
}

static void build_spring_toggle(struct inspection *in, const struct spline *spline)
{
    bool on = spline->spring_friction;
    struct rect r = ui_row(in->ui, UI_ROW);
    ui_label(in->ui, (struct rect){r.x, r.y, r.w - 40, r.h}, "spring and friction", THEME_TEXT_DIM);
    if (ui_hovered(in->ui, r)) in->ui->hint = "Spring constant and friction in place of frequency and damping";
    r = (struct rect){r.x + r.w - 28, r.y, 28, r.h};
    if (!ui_toggle(in->ui, r, "spring_friction", &on)) return;
    struct edit edit = editor_edit_of(EDIT_SPRING, in->editor->active);
    edit.flag = on;
    editor_step(in->editor, in->world, on ? "Use spring and friction" : "Use frequency and damping", 0, &edit);
}

/// How fast a swing dies out, 1/s: the slower pole's real part. Negative where a track drives it, so that no number is true.
static double decay_rate(const struct spline *spline)
{
    const struct param *p = spline->parameter;
    double omega, zeta;
    if (spline->mode == WIGGLY_REAL && spline->spring_friction) {
        if (p[PARAMETER_SPRING].track >= 0 || p[PARAMETER_FRICTION].track >= 0) return -1;
        omega = sqrt(p[PARAMETER_SPRING].value);
        zeta = omega > 0 ? p[PARAMETER_FRICTION].value / (2 * omega) : 0;
    } else {
        if (p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0) return -1;
        omega = 2 * M_PI * p[PARAMETER_FREQUENCY].value;
        zeta = p[PARAMETER_DAMPING].value;
    }
    return zeta > 1 ? omega / (zeta + sqrt(zeta * zeta - 1)) : zeta * omega;
}

/// What the parameters mean, in one plain sentence.
static void build_settling(struct inspection *in, const struct spline *spline)
{
    char text[128];
    double rate = decay_rate(spline);
    if (rate < 0) return;
    double settle = log(20) / rate; // until 5 % are left
    if (rate == 0) {
        bool swings = spline->spring_friction || spline->parameter[PARAMETER_FREQUENCY].value > 0;
        snprintf(text, sizeof text, "%s", swings ? "Rings for ever." : "Frequency 0: a plain cubic.");
    } else if (settle >= 1000) {
        snprintf(text, sizeof text, "Settles to 5 %% in more than 1000 s.");
    } else {
        snprintf(text, sizeof text, "Settles to 5 %% in %.2f s (%.0f frames).", settle, settle * in->document->fps);
    }
    ui_paragraph(in->ui, text, THEME_TEXT_DIM);
}

static void build_warnings(struct inspection *in, const struct spline *spline)
{
    const struct evaluation *evaluation = in->world->evaluation;
    int active = in->editor->active;
    if (evaluation && active < evaluation->count && evaluation->status[active] != WIGGLY_OK) {
        ui_paragraph(in->ui, wiggly_status_text(evaluation->status[active]), THEME_WARNING);
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
        ui_paragraph(in->ui, text, THEME_WARNING);
    }
}

void inspector_spline(struct inspection *in)
{
    struct ui *ui = in->ui;
    struct spline *spline = editor_active_spline(in->editor, in->world);
    build_mode(in, spline);
    ui_space(ui, 4);
    bool pair = spline->mode == WIGGLY_REAL && spline->spring_friction;
    if (spline->mode == WIGGLY_CUBIC) {
        ui_paragraph(ui, "The classical spline: smooth through the knots, without swing.", THEME_TEXT_DIM);
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
