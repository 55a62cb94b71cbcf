/// Parameters that follow another spline: the row that says so, and the list to choose from.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include "scene/order.h"
#include <stdio.h>

static const char track_list[] = "follow";

/// Marks the splines that the active one cannot follow without a cycle; whether any is left.
static bool find_leaders(const struct inspection *in, bool left_out[INSPECTOR_MAX_SPLINES])
{
    int count =
        in->document->spline_count < INSPECTOR_MAX_SPLINES ? in->document->spline_count : INSPECTOR_MAX_SPLINES;
    bool any = false;
    scene_followers(in->document, in->core->active, left_out, count);
    for (int s = 0; s < count; s++) any |= !left_out[s];
    return any;
}

static void set_track(struct inspection *in, enum parameter parameter, struct param param)
{
    struct edit edit = core_edit_of(EDIT_PARAMETER, in->core->active);
    edit.parameter = parameter;
    edit.param = param;
    const char *label = param_follows(&param) ? "Follow spline" : "Stop following";
    core_step(in->core, in->world, label, 0, &edit);
}

static void open_list(struct inspection *in, enum parameter parameter, struct rect r)
{
    bool left_out[INSPECTOR_MAX_SPLINES];
    if (find_leaders(in, left_out)) {
        ui_popup_open(in->ui, track_list, (int)parameter, r);
        return;
    }
    char text[160];
    snprintf(text, sizeof text, "There is no other spline for %.80s to follow.",
             in->document->splines[in->core->active].name);
    core_message(in->core, true, text);
}

void inspector_track(struct inspection *in, enum parameter parameter, const char *label, struct rect r)
{
    const struct spline *spline = &in->document->splines[in->core->active];
    const struct param *param = &spline->parameter[parameter];
    char text[160];
    ui_label(in->ui, (struct rect){r.x, r.y, UI_LABEL, r.h}, label, theme()->text_dim);
    if (param->motion) {
        snprintf(text, sizeof text, "%s, %s", param->motion->joint, motion_words[param->motion->of]);
    } else {
        snprintf(text, sizeof text, "%s", in->document->splines[param->track].name);
    }
    struct rect field = {r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
    if (ui_hovered(in->ui, field))
        in->ui->hint =
            param->motion ? "The joint it follows, and what of it" : "The spline it follows, sample by sample";
    const uint32_t color = param->motion ? theme()->text_dim : arrange_color(in->document, param->track);
    ui_dropdown(in->ui, field, track_list, (int)parameter, text, color);
}

void inspector_track_button(struct inspection *in, enum parameter parameter, struct rect r)
{
    int active = in->core->active;
    bool follows = param_follows(&in->document->splines[active].parameter[parameter]);
    enum ui_icon icon = follows ? UI_ICON_UNFOLLOW : UI_ICON_FOLLOW;
    const char *hint = follows ? "Stop following; keep the value at the playhead" : "Follow another spline";
    char name[64];
    snprintf(name, sizeof name, "follow.%s", parameter_rows[parameter].name);
    if (!ui_icon_button(in->ui, r, name, icon, false, hint)) return;
    if (follows) {
        double value = arrange_present(in->core, in->world, active, parameter);
        set_track(in, parameter, param_number(value));
    } else {
        struct rect row = {in->ui->area.x + UI_PAD + UI_LABEL + UI_GAP, r.y, 0, r.h};
        row.w = r.x - 2 - row.x;
        open_list(in, parameter, row);
    }
}

void inspector_track_list(struct inspection *in)
{
    struct ui *ui = in->ui;
    const struct spline *spline = core_active_spline(in->core, in->world);
    if (!ui_popup_is_open(ui, track_list) || !spline) return;
    enum parameter parameter = (enum parameter)ui->popup.which;
    bool left_out[INSPECTOR_MAX_SPLINES];
    find_leaders(in, left_out);
    int picked = inspector_spline_list(in, track_list, left_out, spline->parameter[parameter].track);
    if (picked >= 0) set_track(in, parameter, param_track(picked));
}
