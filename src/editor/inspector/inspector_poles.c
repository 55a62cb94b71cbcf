/// The inspector's view of the active spline's poles: dragged in an inset, seen on the unit circle and in their response.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/inspection.h"
#include "editor/inspector/poles.h"
#include <math.h>

enum { CIRCLE = 112, INSET = 92, TICKS = 18, RESPONSE = 112 }; ///< heights

/// A parameter's value at the playhead, in its range.
static double value_now(const struct inspection *in, const struct spline *spline, enum parameter parameter)
{
    const struct param *param = &spline->parameter[parameter];
    const struct evaluation *evaluation = in->world->evaluation;
    double value = param->value;
    if (param->track >= 0) {
        if (!evaluation || param->track >= evaluation->count) return 0;
        int sample = document_sample(in->document, core_frame(in->core, in->document));
        if (sample < 0 || sample >= evaluation->samples) return 0;
        value = evaluation->curves[param->track].total[sample];
    }
    return parameter_clamped(parameter, spline_mode(spline), value);
}

static struct pole_setting setting_of(const struct inspection *in, const struct spline *spline)
{
    struct pole_setting setting = {.kind = spline_mode(spline) == WIGGLY_REAL ? FILTER_TWO_REAL : FILTER_TWO_COMPLEX,
                                   .bandwidth = value_now(in, spline, PARAMETER_BANDWIDTH),
                                   .step = document_step(in->document)};
    if (spline->spring_friction && spline_mode(spline) == WIGGLY_REAL) {
        double omega = sqrt(value_now(in, spline, PARAMETER_SPRING));
        setting.hz = omega / (2 * M_PI);
        setting.damping = omega > 0 ? value_now(in, spline, PARAMETER_FRICTION) / (2 * omega) : 0;
    } else {
        setting.hz = value_now(in, spline, PARAMETER_FREQUENCY);
        setting.damping = value_now(in, spline, PARAMETER_DAMPING);
    }
    return setting;
}

enum { HANDLE_CENTRE, HANDLE_LOWER, HANDLE_UPPER, HANDLES };

static double rounded(double value, double steps) { return round(value * steps) / steps; }

/// The edits that make a setting the spline's, where a handle was moved; parameters that follow a track are left alone.
/// Returns their number.
static int edits_of(const struct inspection *in, const struct spline *spline, const struct pole_setting *setting,
                    int which, struct edit edits[2])
{
    const struct param *p = spline->parameter;
    int count = 0;
    if (spline->spring_friction && spline_mode(spline) == WIGGLY_REAL) {
        double omega = 2 * M_PI * setting->hz;
        if (p[PARAMETER_SPRING].track < 0)
            edits[count++] = core_parameter_edit(in->core->active, PARAMETER_SPRING, rounded(omega * omega, 100));
        if (p[PARAMETER_FRICTION].track < 0)
            edits[count++] = core_parameter_edit(in->core->active, PARAMETER_FRICTION,
                                                 rounded(2 * setting->damping * omega, 1000));
        return count;
    }
    if (which == HANDLE_CENTRE && p[PARAMETER_FREQUENCY].track < 0)
        edits[count++] = core_parameter_edit(in->core->active, PARAMETER_FREQUENCY, rounded(setting->hz, 100));
    if (p[PARAMETER_DAMPING].track < 0)
        edits[count++] = core_parameter_edit(in->core->active, PARAMETER_DAMPING, rounded(setting->damping, 1000));
    if (which != HANDLE_CENTRE && p[PARAMETER_BANDWIDTH].track < 0)
        edits[count++] =
            core_parameter_edit(in->core->active, PARAMETER_BANDWIDTH, rounded(setting->bandwidth, 1000));
    return count;
}

/// What the setting becomes when a handle was moved.
static struct pole_setting moved_to(const struct inspection *in, struct pole_setting setting, struct rect inset,
                                    int which, enum ui_change change, const struct ui_handle *handle)
{
    const struct poles_view *view = &in->inspector->poles;
    double highest = fmin(12, 0.5 / setting.step), most = setting.kind == FILTER_TWO_REAL ? 3 : 1;
    double hz = setting.hz, side = which == HANDLE_LOWER ? -1 : 1;
    if (change == UI_NUDGE) {
        setting.damping += 0.01 * handle->step_y;
        if (which == HANDLE_CENTRE) {
            setting.hz += 0.05 * handle->step_x;
        } else {
            setting.bandwidth += side * 0.01 * handle->step_x;
        }
    } else {
        setting.damping = poles_damping(view, inset, handle->y);
        if (which == HANDLE_CENTRE) {
            setting.hz = poles_hz(view, inset, handle->x);
        } else {
            setting.bandwidth = side * (poles_hz(view, inset, handle->x) - hz) / hz;
        }
    }
    setting.hz = fmax(0.01, fmin(highest, setting.hz));
    setting.damping = fmax(0, fmin(most, setting.damping));
    setting.bandwidth = fmax(0, fmin(1, setting.bandwidth));
    return setting;
}

static void build_inset(struct inspection *in, const struct spline *spline, const struct pole_setting *setting)
{
    struct poles_view *view = &in->inspector->poles;
    struct rect row = ui_row(in->ui, INSET + TICKS), inset = {row.x, row.y, row.w, INSET};
    float y = poles_y(view, inset, setting->damping);
    double spread = setting->hz * setting->bandwidth;
    struct ui_handle handles[HANDLES] = {
        [HANDLE_CENTRE] = {"pole.centre", "Drag sideways for frequency, up for damping (Shift: fine)",
                           poles_x(view, inset, setting->hz), y, 0, 0},
        [HANDLE_LOWER] = {"pole.lower", "Pole: drag sideways for bandwidth, up for damping",
                          poles_x(view, inset, setting->hz - spread), y, 0, 0},
        [HANDLE_UPPER] = {"pole.upper", "Pole: drag sideways for bandwidth, up for damping",
                          poles_x(view, inset, setting->hz + spread), y, 0, 0}};
    int which = 0, count = setting->kind == FILTER_TWO_COMPLEX ? HANDLES : 1;
    if (in->ui->pass == UI_PASS_DRAW) poles_draw_inset(view, setting, inset, in->ui->list);
    enum ui_change change = ui_handles(in->ui, row, handles, count, &which);
    if (change == UI_NONE) return;
    struct edit edits[2];
    struct pole_setting wanted = *setting;
    if (change == UI_DRAG || change == UI_NUDGE) {
        wanted = moved_to(in, *setting, inset, which, change, &handles[which]);
    }
    int edit_count = edits_of(in, spline, &wanted, which, edits);
    inspector_change_all(in, change, "Move poles", handles[which].name, edits, edit_count);
}

static bool is_held(const struct ui *ui)
{
    return ui->held &&
           (ui->held == ui_id("pole.centre") || ui->held == ui_id("pole.lower") || ui->held == ui_id("pole.upper"));
}

void inspector_poles(struct inspection *in)
{
    struct ui *ui = in->ui;
    struct poles_view *view = &in->inspector->poles;
    struct spline *spline = core_active_spline(in->core, in->world);
    struct pole_setting setting = setting_of(in, spline);
    if (spline_mode(spline) == WIGGLY_CUBIC || !(setting.hz > 0)) {
        ui_paragraph(ui, "Both poles are at 1 (frequency 0): a cubic does not swing by itself.", theme()->text_dim);
        return;
    }
    if (!is_held(ui)) poles_fit(view, &setting);
    poles_update(view, &setting);
    ui_space(ui, 4);
    struct rect top = ui_row(ui, CIRCLE);
    struct rect circle = {top.x, top.y, CIRCLE, CIRCLE};
    ui_hint(ui, circle, "Unit circle: poles inside are stable; angle is frequency, distance from the rim damping");
    if (ui->pass == UI_PASS_DRAW) {
        struct rect legend = {top.x + CIRCLE + UI_GAP, top.y, top.w - CIRCLE - UI_GAP, CIRCLE};
        poles_draw_circle(&setting, circle, ui->list);
        poles_draw_legend(view, legend, ui->list);
    }
    ui_space(ui, 6);
    build_inset(in, spline, &setting);
    ui_space(ui, 4);
    struct rect response = ui_row(ui, RESPONSE);
    ui_hint(ui, response, "Response in dB over Hz: the complex filter rejects low frequencies");
    if (ui->pass == UI_PASS_DRAW) poles_draw_response(view, response, ui->list);
    ui_space(ui, 4);
}
