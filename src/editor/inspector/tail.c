/// The inspector's section on the tail or chain that is shown: which splines bend it, where a tail stands, how it is built.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/spline_list.h"
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
        ui_dropdown(in->ui, field, place_list, k, in->document->splines[param->track]->name,
                    spline_list_color(in->document, param->track));
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
        snprintf(text, sizeof text, "%s, %s", in->document->splines[channel->spline]->name,
                 axis_label(channel->axis));
        struct rect r = ui_row(ui, UI_ROW);
        ui_hint(ui, r, "One of the splines that bend it");
        uint32_t color = spline_list_color(in->document, channel->spline);
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
            in->inspector->channel = rig_input_count(in->document->rigs[edit.rig]) - 1;
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
    const char *spline = in->document->splines[channel->spline]->name;
    const struct rect field = inspector_labelled(in, "spline");
    ui_hint(in->ui, field, "The spline that bends it");
    ui_dropdown(in->ui, field, feed_list, inspector->channel, spline,
                spline_list_color(in->document, channel->spline));
    build_choices(in, channel);
}

/// Where a chain begins and where it ends.
static const struct end {
    const char *label, *list, *pick, *hint;
    enum bone_use use;
} ends[2] = {
    {"from", "chain.from", "chain.from.pick", "The bone that it begins with", BONE_FIRST},
    {"to", "chain.to", "chain.to.pick", "The bone that it ends with", BONE_LAST},
};

static struct edit chain_edit(const struct inspection *in, const struct rig *contents)
{
    struct edit edit = core_edit_of(EDIT_CHAIN, in->core->active);
    edit.rig = in->inspector->rig;
    edit.contents = contents;
    return edit;
}

/// The bone at one end: a list of those that it may be, and a button to pick it on the stage.
static void build_end(struct inspection *in, const struct end *end, const char *bone)
{
    struct rect field = inspector_labelled(in, end->label), icon = {field.x + field.w - ICON, field.y, ICON, field.h};
    field.w -= ICON + 4;
    const int rig = in->inspector->rig;
    ui_hint(in->ui, field, end->hint);
    ui_dropdown(in->ui, field, end->list, rig, bone, 0);
    const bool picking = in->core->pick.use == end->use && in->core->pick.which == rig;
    if (ui_icon_button(in->ui, icon, end->pick, UI_ICON_PICK, picking, "Pick it on the stage"))
        bones_pick(in->core, picking ? BONE_SELECTED : end->use, rig);
}

static void end_list(struct inspection *in, const struct end *end, const struct chain *chain)
{
    const int model = bones_model_of(in->document, chain);
    const struct imported *character = model >= 0 ? bones_character(in->world, model) : NULL;
    if (!ui_popup_is_open(in->ui, end->list) || !character) return;
    const bool first = end->use == BONE_FIRST;
    const int top = first ? -1 : gltf_find_node(&character->gltf, chain->from);
    const int node = inspector_bone_list(in, end->list, model, top, first ? chain->from : chain->to);
    if (node >= 0) bones_set_end(in->core, in->world, in->inspector->rig, first, node);
}

void inspector_chain_lists(struct inspection *in)
{
    for (int e = 0; e < 2; e++) {
        const struct rig *rig = inspector_shown(in);
        if (rig && rig->kind == RIG_CHAIN) end_list(in, &ends[e], &rig->chain);
    }
}

static void now(const struct inspection *in, int which, struct setting *setting)
{
    (void)which;
    setting->contents = *inspector_shown(in);
    setting->edit = chain_edit(in, &setting->contents);
}

static const struct number_row turn_row = {"chain.turn",
                                           "turn",
                                           "°",
                                           "Turns the axes of side and up about the chain's own direction",
                                           "Turn chain's axes",
                                           NUMBER_AT(contents.chain.turn),
                                           -180,
                                           180,
                                           -36000,
                                           36000,
                                           0,
                                           1,
                                           0};

static void build_mirror(struct inspection *in)
{
    struct rig contents = *inspector_shown(in);
    struct rect r = inspector_labelled(in, "mirror");
    ui_hint(in->ui, r, "Bend to the other side, as a left ear does to a right one");
    if (!ui_toggle(in->ui, r, "chain.mirror", &contents.chain.mirror)) return;
    const struct edit edit = chain_edit(in, &contents);
    core_step(in->core, in->world, "Mirror chain", 0, &edit);
}

static void build_twin(struct inspection *in)
{
    if (!bones_has_twin(in->world, in->inspector->rig)) return;
    const struct rect row = ui_row(in->ui, UI_ROW), button = {row.x, row.y + 2, row.w, row.h - 4};
    ui_hint(in->ui, button, "The same chain on the other side, mirrored, by the same splines");
    if (!ui_button(in->ui, button, "chain.twin", "Mirror to other side", false)) return;
    bones_make_twin(in->core, in->world, in->inspector->rig);
    in->inspector->rig = in->document->rig_count - 1;
}

void inspector_chain(struct inspection *in)
{
    const struct chain *chain = &inspector_shown(in)->chain;
    build_end(in, &ends[0], chain->from);
    build_end(in, &ends[1], chain->to);
    inspector_numbers(in, &turn_row, 1, now);
    build_mirror(in);
    build_twin(in);
}
