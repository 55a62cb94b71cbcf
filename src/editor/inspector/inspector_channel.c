/// The channels of a tail: which splines bend it, how, and how much.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <stdio.h>

enum { ICON = 24 };

static const char feed_list[] = "feed";

static struct edit channel_edit(const struct inspection *in, enum edit_kind kind)
{
    struct edit edit = core_edit_of(kind, in->core->active);
    edit.rig = document_find_rig(in->document, RIG_TAIL, in->inspector->tail);
    edit.channel = in->inspector->channel;
    return edit;
}

static void build_list(struct inspection *in, const struct tail *tail)
{
    struct ui *ui = in->ui;
    for (int c = 0; c < tail->channel_count; c++) {
        const struct channel *channel = &tail->channels[c];
        char name[32], text[192];
        snprintf(name, sizeof name, "channel.%d", c);
        const char *axis = channel->axis == AXIS_SIDE ? "sideways" : "up and down";
        snprintf(text, sizeof text, "%s, %s", in->document->splines[channel->spline].name, axis);
        struct rect r = ui_row(ui, UI_ROW);
        if (ui_hovered(ui, r)) ui->hint = "One of the splines that bend this tail";
        uint32_t color = arrange_color(in->document, channel->spline);
        if (ui_list_row(ui, r, name, text, color, c == in->inspector->channel)) {
            in->inspector->channel = c;
        }
    }
}

static void build_buttons(struct inspection *in, const struct tail *tail)
{
    struct rect r = inspector_labelled(in, "channel"), icon = {r.x - 2, r.y, ICON, r.h};
    if (ui_icon_button(in->ui, icon, "channel.add", UI_ICON_ADD, false, "Bend this tail by the active spline too")) {
        struct edit edit = channel_edit(in, EDIT_CHANNEL_ADD);
        if (core_step(in->core, in->world, "Add channel", 0, &edit)) {
            in->inspector->channel = in->document->rigs[edit.rig].tail.channel_count - 1;
        }
        return;
    }
    icon.x += ICON + 6;
    if (tail->channel_count == 0) return;
    if (ui_icon_button(in->ui, icon, "channel.delete", UI_ICON_DELETE, false, "Delete this channel")) {
        struct edit edit = channel_edit(in, EDIT_CHANNEL_REMOVE);
        core_step(in->core, in->world, "Delete channel", 0, &edit);
    }
}

static void build_choices(struct inspection *in, const struct channel *channel)
{
    static const struct ui_choice axes[] = {[AXIS_SIDE] = {"side", "Sideways"}, [AXIS_UP] = {"up", "Up"}};
    static const struct ui_choice parts[] = {
        [PART_TOTAL] = {"total", "Total"}, [PART_DISPLACEMENT] = {"displacement", "Displaced"}};
    struct ui *ui = in->ui;
    int axis = (int)channel->axis, part = (int)channel->of;
    if (ui_segments(ui, inspector_labelled(in, "axis"), "axis", axes, 2, &axis)) {
        struct edit edit = channel_edit(in, EDIT_AXIS);
        edit.axis = (enum axis)axis;
        core_step(in->core, in->world, "Set axis", 0, &edit);
    }
    struct rect r = inspector_labelled(in, "bends by");
    if (ui_hovered(ui, r)) ui->hint = "Total, or displacement only: use that for a tail on a moving base";
    if (ui_segments(ui, r, "part", parts, 2, &part)) {
        struct edit edit = channel_edit(in, EDIT_PART);
        edit.of = (enum channel_part)part;
        core_step(in->core, in->world, "Set what bends", 0, &edit);
    }
}

void inspector_feed_list(struct inspection *in)
{
    const struct inspector *inspector = in->inspector;
    const struct tail *tail = document_tail(in->document, inspector->tail);
    if (!ui_popup_is_open(in->ui, feed_list) || !tail) return;
    if (inspector->channel >= tail->channel_count) return;
    int picked = inspector_spline_list(in, feed_list, NULL, tail->channels[inspector->channel].spline);
    if (picked < 0) return;
    struct edit edit = channel_edit(in, EDIT_FEED);
    edit.spline = picked;
    core_step(in->core, in->world, "Set channel's spline", 0, &edit);
}

void inspector_channels(struct inspection *in, const struct tail *tail)
{
    const struct inspector *inspector = in->inspector;
    build_list(in, tail);
    ui_space(in->ui, 4);
    if (inspector->channel >= tail->channel_count) return;
    inspector_angles(in, &angle_row_lag, &tail->channels[inspector->channel].lag);
    inspector_angles(in, &angle_row_gain, &tail->channels[inspector->channel].gain);
}

void inspector_channel(struct inspection *in, const struct tail *tail)
{
    const struct inspector *inspector = in->inspector;
    build_buttons(in, tail);
    tail = document_tail(in->document, inspector->tail); // a button may have made another list of channels
    if (inspector->channel >= tail->channel_count) return;
    const struct channel *channel = &tail->channels[inspector->channel];
    const char *spline = in->document->splines[channel->spline].name;
    ui_dropdown(in->ui, inspector_labelled(in, "spline"), feed_list, inspector->channel, spline,
                arrange_color(in->document, channel->spline));
    build_choices(in, channel);
}
