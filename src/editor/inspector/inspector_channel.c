/// The channels of a tail or chain: which splines bend it, how, and how much.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <stdio.h>

enum { ICON = 24 };

static const char feed_list[] = "feed", axis_list[] = "axis";

/// What a channel can do to a tail and its body, in the order of its list.
static const struct {
    enum axis axis;
    struct ui_item item;
} tail_axes[] = {
    {AXIS_SIDE, {"side", "sideways", 0}},        {AXIS_UP, {"up", "up and down", 0}},
    {AXIS_LOOK, {"look", "turns the head", 0}},  {AXIS_NOD, {"nod", "lifts the head", 0}},
    {AXIS_EARS, {"ears", "lays ears back", 0}},  {AXIS_BREATH, {"breath", "widens the chest", 0}},
    {AXIS_STRETCH, {"stretch", "stretches", 0}}, {AXIS_BLINK, {"blink", "closes the lids", 0}},
};

static const char *axis_label(enum axis axis)
{
    size_t a = 0;
    while (a < sizeof tail_axes / sizeof *tail_axes && tail_axes[a].axis != axis) a++;
    return a < sizeof tail_axes / sizeof *tail_axes ? tail_axes[a].item.label : "twist";
}

static struct edit channel_edit(const struct inspection *in, enum edit_kind kind)
{
    struct edit edit = core_edit_of(kind, in->core->active);
    edit.rig = in->inspector->rig;
    edit.channel = in->inspector->channel;
    return edit;
}

/// The channel that is chosen of the tail or chain; NULL where it has none.
static const struct channel *chosen_channel(const struct inspection *in)
{
    int count = 0;
    const struct rig *rig = inspector_shown(in);
    const struct channel *channels = rig ? rig_channels(rig, &count) : NULL;
    return in->inspector->channel < count ? &channels[in->inspector->channel] : NULL;
}

const struct channel *inspector_felt_channel(const struct inspection *in)
{
    const struct channel *channel = chosen_channel(in);
    return channel && channel->spline == in->core->active ? channel : NULL;
}

/// Shows a channel, and what it feels like.
static void choose(struct inspection *in, int channel)
{
    in->inspector->channel = channel;
    core_activate(in->core, in->world, chosen_channel(in)->spline);
    in->inspector->channel = channel; // of two by the same spline
}

static void build_list(struct inspection *in)
{
    struct ui *ui = in->ui;
    int count;
    const struct channel *channels = rig_channels(inspector_shown(in), &count);
    for (int c = 0; c < count; c++) {
        const struct channel *channel = &channels[c];
        char name[32], text[192];
        snprintf(name, sizeof name, "channel.%d", c);
        snprintf(text, sizeof text, "%s, %s", in->document->splines[channel->spline].name, axis_label(channel->axis));
        struct rect r = ui_row(ui, UI_ROW);
        ui_hint(ui, r, "One of the splines that bend it");
        uint32_t color = arrange_color(in->document, channel->spline);
        if (ui_list_row(ui, r, name, text, color, c == in->inspector->channel)) {
            choose(in, c);
            return;
        }
    }
}

static void build_buttons(struct inspection *in)
{
    struct rect r = inspector_labelled(in, "channel"), icon = {r.x - 2, r.y, ICON, r.h};
    if (ui_icon_button(in->ui, icon, "channel.add", UI_ICON_ADD, false, "Bend it by the active spline too")) {
        struct edit edit = channel_edit(in, EDIT_CHANNEL_ADD);
        if (core_step(in->core, in->world, "Add channel", 0, &edit)) {
            in->inspector->channel = rig_input_count(&in->document->rigs[edit.rig]) - 1;
        }
        return;
    }
    icon.x += ICON + 6;
    if (!chosen_channel(in)) return;
    if (ui_icon_button(in->ui, icon, "channel.delete", UI_ICON_DELETE, false, "Delete this channel")) {
        struct edit edit = channel_edit(in, EDIT_CHANNEL_REMOVE);
        core_step(in->core, in->world, "Delete channel", 0, &edit);
    }
}

/// A gain that was never set becomes the new axis's.
static void set_axis(struct inspection *in, enum axis axis)
{
    const struct channel *channel = chosen_channel(in);
    const struct angles gain = {.value = {axis_gain(axis)}};
    const bool untouched = channel->gain.form == ANGLES_ONE && channel->gain.value[0] == axis_gain(channel->axis);
    struct edit edit = channel_edit(in, EDIT_AXIS);
    edit.axis = axis;
    if (history_is_open(in->world->history)) return;
    history_begin(in->world->history, "Set axis", 0);
    const bool done = core_edit(in->core, in->world, &edit);
    const struct edit with = inspector_angles_edit(in, &angle_row_gain, &gain);
    if (done && untouched) core_edit(in->core, in->world, &with);
    history_end(in->world->history);
}

static void build_choices(struct inspection *in, const struct channel *channel)
{
    static const struct ui_choice chain[] = {
        [AXIS_SIDE] = {"side", "Side"}, [AXIS_UP] = {"up", "Up"}, [AXIS_TWIST] = {"twist", "Twist"}};
    static const struct ui_choice parts[] = {
        [PART_TOTAL] = {"total", "Total"}, [PART_DISPLACEMENT] = {"displacement", "Displaced"}};
    struct ui *ui = in->ui;
    int axis = (int)channel->axis, part = (int)channel->of;
    struct rect row = inspector_labelled(in, "axis");
    ui_hint(ui, row, "The way it bends, or moves the body");
    if (inspector_shown(in)->kind == RIG_TAIL) {
        ui_dropdown(ui, row, axis_list, in->inspector->channel, axis_label(channel->axis), 0);
    } else if (ui_segments(ui, row, "axis", chain, 3, &axis)) {
        set_axis(in, (enum axis)axis);
    }
    struct rect r = inspector_labelled(in, "bends by");
    ui_hint(ui, r, "Total, or displacement only: use that for a tail on a moving base");
    if (ui_segments(ui, r, "part", parts, 2, &part)) {
        struct edit edit = channel_edit(in, EDIT_PART);
        edit.of = (enum channel_part)part;
        core_step(in->core, in->world, "Set what bends", 0, &edit);
    }
}

static void build_axis_list(struct inspection *in, const struct channel *channel)
{
    enum { COUNT = sizeof tail_axes / sizeof *tail_axes };
    struct ui_item items[COUNT];
    int row = -1;
    if (!ui_popup_is_open(in->ui, axis_list)) return;
    for (int a = 0; a < COUNT; a++) {
        items[a] = tail_axes[a].item;
        if (tail_axes[a].axis == channel->axis) row = a;
    }
    const int picked = ui_popup_list(in->ui, axis_list, items, COUNT, row);
    if (picked >= 0) set_axis(in, tail_axes[picked].axis);
}

void inspector_channel_lists(struct inspection *in)
{
    const struct channel *channel = chosen_channel(in);
    if (channel) build_axis_list(in, channel);
    if (!ui_popup_is_open(in->ui, feed_list) || !channel) return;
    int picked = inspector_spline_list(in, feed_list, NULL, channel->spline);
    if (picked < 0) return;
    struct edit edit = channel_edit(in, EDIT_FEED);
    edit.spline = picked;
    if (core_step(in->core, in->world, "Set channel's spline", 0, &edit)) choose(in, edit.channel);
}

void inspector_channels(struct inspection *in)
{
    build_list(in);
    ui_space(in->ui, 4);
}

void inspector_channel(struct inspection *in)
{
    const struct inspector *inspector = in->inspector;
    build_buttons(in);
    const struct channel *channel = chosen_channel(in);
    if (!channel) return;
    const char *spline = in->document->splines[channel->spline].name;
    const struct rect field = inspector_labelled(in, "spline");
    ui_hint(in->ui, field, "The spline that bends it");
    ui_dropdown(in->ui, field, feed_list, inspector->channel, spline, arrange_color(in->document, channel->spline));
    build_choices(in, channel);
}
