/// Parameters that follow another spline: the row that says so, and the list to choose from.
#include "editor/core/arrange.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include "scene/order.h"
#include <stdio.h>

enum { MAX_MODELS = 16, MODEL_TEXT = 112 }; ///< whose joints are offered

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
    const bool joints = parameter == PARAMETER_EQUILIBRIUM && document_find_rig(in->document, RIG_MODEL, 0) >= 0;
    if (find_leaders(in, left_out) || joints) {
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
    ui_label(in->ui, (struct rect){r.x, r.y, UI_LABEL, r.h}, label, theme()->text_dim);
    struct rect field = {r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
    if (param->motion) {
        inspector_joint_field(in, param->motion, field);
        return;
    }
    ui_hint(in->ui, field, "The spline it follows, sample by sample");
    ui_dropdown(in->ui, field, track_list, (int)parameter, in->document->splines[param->track].name,
                arrange_color(in->document, param->track));
}

void inspector_track_button(struct inspection *in, enum parameter parameter, struct rect r)
{
    int active = in->core->active;
    bool follows = param_follows(&in->document->splines[active].parameter[parameter]);
    enum ui_icon icon = follows ? UI_ICON_UNFOLLOW : UI_ICON_FOLLOW;
    const bool joints = parameter == PARAMETER_EQUILIBRIUM && document_find_rig(in->document, RIG_MODEL, 0) >= 0;
    const char *hint = follows  ? "Stop following; keep the value at the playhead"
                       : joints ? "Follow another spline, or a joint of the character"
                                : "Follow another spline";
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

/// The character whose joint the equilibrium is to follow: rows below the splines, called after their rigs. Returns how many.
static int add_models(const struct inspection *in, struct ui_item *items, char texts[][MODEL_TEXT], int *models)
{
    int count = 0;
    for (int r = document_next_rig(in->document, RIG_MODEL, 0); r >= 0 && count < MAX_MODELS;
         r = document_next_rig(in->document, RIG_MODEL, r + 1)) {
        if (!bones_character(in->world, r)) continue;
        snprintf(texts[count], MODEL_TEXT, "A joint of %.80s", rig_title(&in->document->rigs[r]));
        items[count] = (struct ui_item){texts[count], texts[count], 0};
        models[count++] = r;
    }
    return count;
}

void inspector_track_list(struct inspection *in)
{
    struct ui *ui = in->ui;
    const struct spline *spline = core_active_spline(in->core, in->world);
    inspector_joint_list(in);
    if (!ui_popup_is_open(ui, track_list) || !spline) return;
    enum parameter parameter = (enum parameter)ui->popup.which;
    bool left_out[INSPECTOR_MAX_SPLINES];
    struct ui_item items[INSPECTOR_MAX_SPLINES + MAX_MODELS];
    char texts[MAX_MODELS][MODEL_TEXT];
    int splines[INSPECTOR_MAX_SPLINES], models[MAX_MODELS], row;
    find_leaders(in, left_out);
    const int count = inspector_spline_items(in, left_out, spline->parameter[parameter].track, items, splines, &row);
    const int more = parameter == PARAMETER_EQUILIBRIUM ? add_models(in, items + count, texts, models) : 0;
    const int picked = ui_popup_list(ui, track_list, items, count + more, row);
    if (picked >= count) {
        bones_follow(in->core, in->world, in->core->active, models[picked - count], -1);
    } else if (picked >= 0) {
        set_track(in, parameter, param_track(splines[picked]));
    }
}
