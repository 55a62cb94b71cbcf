/// The inspector's section on the tail or chain that is shown: what bends it, where a tail stands, how it is built, and what is shown of
/// its motion.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stdio.h>

enum { ICON = 24 };

static const char rename_line[] = "tail.rename", place_list[] = "place";

static struct edit rig_edit(const struct inspection *in, enum edit_kind kind)
{
    struct edit edit = core_edit_of(kind, in->core->active);
    edit.rig = in->inspector->rig;
    return edit;
}

static void build_name(struct inspection *in)
{
    const struct rig *rig = inspector_shown(in);
    struct rect r = inspector_labelled(in, "name");
    if (!ui_line_is_open(in->ui, rename_line)) {
        struct rect field = {r.x, r.y + 2, r.w, r.h - 4};
        ui_hint(in->ui, field, "Click to rename");
        if (ui_button(in->ui, field, "tail.name", rig_title(rig), false))
            ui_line_begin(in->ui, rename_line, rig_title(rig));
    } else if (ui_line(in->ui, r, rename_line) == UI_LINE_DONE) {
        struct edit edit = rig_edit(in, EDIT_RIG_NAME);
        edit.text = in->ui->text.bytes;
        core_step(in->core, in->world, rig->kind == RIG_TAIL ? "Rename tail" : "Rename chain", 0, &edit);
    }
}

static void position_now(const struct inspection *in, int k, struct setting *setting)
{
    setting->edit = rig_edit(in, EDIT_POSITION);
    setting->edit.coordinate = k;
    setting->edit.param = inspector_shown(in)->tail.position[k];
}

static const struct number_row position[] = {
    {"position.x", "x", "m", "Position of the body along x", "Move body", NUMBER_AT(edit.param.value), 0, 0, -1e6,
     1e6, 0, 0.01, 3},
    {"position.y", "y", "m", "Position of the body along y", "Move body", NUMBER_AT(edit.param.value), 0, 0, -1e6,
     1e6, 0.26, 0.01, 3},
    {"position.z", "z", "m", "Position of the body along z", "Move body", NUMBER_AT(edit.param.value), 0, 0, -1e6,
     1e6, 0, 0.01, 3},
};

/// A coordinate: a number, or the spline that it follows, and the button from one to the other.
static void build_coordinate(struct inspection *in, const struct tail *tail, int k)
{
    struct rect r = ui_row(in->ui, UI_ROW), icon = {r.x + r.w - ICON, r.y, ICON, r.h};
    const struct param *param = &tail->position[k];
    struct edit edit = rig_edit(in, EDIT_POSITION);
    char button[32];
    edit.coordinate = k;
    edit.param = *param;
    r.w -= ICON + 4;
    snprintf(button, sizeof button, "position.%s.follow", coordinate_name(k));
    struct rect field = {r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
    if (param->track >= 0) {
        ui_label(in->ui, (struct rect){r.x, r.y, UI_LABEL, r.h}, coordinate_name(k), theme()->text_dim);
        ui_dropdown(in->ui, field, place_list, k, in->document->splines[param->track].name,
                    arrange_color(in->document, param->track));
        wiggly_value now = evaluation_at(in->world->evaluation, param->track, in->core->playback.position);
        if (!ui_icon_button(in->ui, icon, button, UI_ICON_UNFOLLOW, false,
                            "Stop following; stay at the current position"))
            return;
        edit.param = param_number(core_round(now.y + now.re, 1e-3));
        core_step(in->core, in->world, "Stop following", 0, &edit);
        return;
    }
    inspector_number(in, &position[k], position_now, k, r);
    if (in->document->spline_count == 0) return;
    if (ui_icon_button(in->ui, icon, button, UI_ICON_FOLLOW, false, "Follow a spline (in metres)")) {
        ui_popup_open(in->ui, place_list, k, field);
    }
}

static void place_popup(struct inspection *in)
{
    const struct rig *rig = inspector_shown(in);
    if (!ui_popup_is_open(in->ui, place_list) || !rig || rig->kind != RIG_TAIL) return;
    int k = in->ui->popup.which;
    int picked = inspector_spline_list(in, place_list, NULL, rig->tail.position[k].track);
    if (picked < 0) return;
    struct edit edit = rig_edit(in, EDIT_POSITION);
    edit.coordinate = k;
    edit.param = param_track(picked);
    core_step(in->core, in->world, "Follow spline", 0, &edit);
}

void inspector_tail_lists(struct inspection *in)
{
    inspector_channel_lists(in);
    inspector_chain_lists(in);
    place_popup(in);
}

static void size_now(const struct inspection *in, int which, struct setting *setting)
{
    const struct tail *tail = &inspector_shown(in)->tail;
    setting->edit = rig_edit(in, which == 0 ? EDIT_JOINTS : EDIT_LENGTH);
    setting->edit.to = tail->joints;
    setting->edit.number = tail->length;
}

static const struct number_row size[] = {
    {"joints", "joints", NULL, "More joints bend more smoothly; shape and swing stay the same", "Set joints",
     WHOLE_AT(edit.to), 1, 64, 1, TAIL_MAX_JOINTS, TAIL_DEFAULT_JOINTS, 1, 0},
    {"length", "length", "m", "Length of the tail; the body scales with it", "Set length", NUMBER_AT(edit.number),
     0.2, 4, 1e-3, 1e6, TAIL_DEFAULT_LENGTH, 0.05, 2},
};

void inspector_overlays(struct inspection *in)
{
    struct core *core = in->core;
    const struct {
        const char *name, *label, *hint;
        bool *on;
    } toggles[] = {
        {"onion", "onion skin", "Show the pose at the knots around the playhead (O)", &core->overlays.onion},
        {"trail", "motion arc", "Show the path of the tip or liveliest point, one mark per frame (P)",
         &core->overlays.trail},
        {"ghost", "ghost pose", "Show the pose at the knot that is dragged or nudged (F4)", &core->overlays.ghost},
    };
    for (size_t i = 0; i < sizeof toggles / sizeof toggles[0]; i++) {
        struct rect r = inspector_labelled(in, toggles[i].label);
        ui_hint(in->ui, r, toggles[i].hint);
        ui_toggle(in->ui, r, toggles[i].name, toggles[i].on);
    }
}

/// Whether the next drag of a body is recorded; without a body nothing is.
static void build_record(struct inspection *in)
{
    if (!document_tail(in->document, 0)) return;
    const struct rect r = inspector_labelled(in, "record");
    ui_hint(in->ui, r, "Record the next drag of the body as knots (or press R while dragging)");
    ui_toggle(in->ui, r, "record", &in->core->record_armed);
}

/// Buttons among these rows may make another list of channels, and more rigs: each looks what is shown up anew.
static void build_shown(struct inspection *in)
{
    struct inspector *inspector = in->inspector;
    const bool is_tail = inspector_shown(in)->kind == RIG_TAIL;
    if (inspector->channel >= rig_input_count(inspector_shown(in))) inspector->channel = 0;
    inspector_channels(in);
    if (is_tail) inspector_angles(in, &angle_row_rest, &inspector_shown(in)->tail.rest);
    inspector_channel(in);
    ui_space(in->ui, 4);
    build_name(in);
    if (!is_tail) {
        inspector_chain(in);
        return;
    }
    inspector_numbers(in, size, sizeof size / sizeof size[0], size_now);
    for (int k = 0; k < 3; k++) build_coordinate(in, &inspector_shown(in)->tail, k);
}

void inspector_tail(struct inspection *in)
{
    inspector_find_rig(in); // one may just have been removed
    build_shown(in);
    build_record(in);
    inspector_overlays(in);
}
