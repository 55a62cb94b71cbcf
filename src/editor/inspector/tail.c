/// The inspector's section on the tail or chain that is shown: which splines bend it, where a tail stands, how it is built.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/parts.h"
#include <math.h>
#include <stdio.h>

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

static const char rename_line[] = "tail.rename", place_list[] = "place";

static void build_name(struct inspector *in)
{
    const struct rig *rig = inspector_shown(in);
    struct rect r = inspector_labelled(in, "name");
    if (!ui_line_is_open(&in->ui, rename_line)) {
        struct rect field = {r.x, r.y + 2, r.w, r.h - 4};
        ui_hint(&in->ui, field, "Click to rename");
        if (ui_button(&in->ui, field, "tail.name", rig_title(rig), false))
            ui_line_begin(&in->ui, rename_line, rig_title(rig));
    } else if (ui_line(&in->ui, r, rename_line) == UI_LINE_DONE) {
        if (!core_begin(in->core, rig->kind == RIG_TAIL ? "Rename tail" : "Rename chain", 0)) return;
        const char *name = in->ui.text.bytes;
        core_end(in->core, edit_rig_name(in->core->document, in->rig, name, &in->core->error));
    }
}

static const struct number_row position[] = {
    {"position.x", "x", "m", "Position of the body along x", "Move body", NUMBER_AT(struct param, value), 0, 0, -1e6,
     1e6, 0, 0.01, 3},
    {"position.y", "y", "m", "Position of the body along y", "Move body", NUMBER_AT(struct param, value), 0, 0, -1e6,
     1e6, 0.26, 0.01, 3},
    {"position.z", "z", "m", "Position of the body along z", "Move body", NUMBER_AT(struct param, value), 0, 0, -1e6,
     1e6, 0, 0.01, 3},
};

static double get_position(const struct inspector *in, int k) { return inspector_shown(in)->tail.position[k].value; }

static bool put_position(struct inspector *in, int k, struct param param, struct error *error)
{
    struct rig changed = *inspector_shown(in);
    changed.tail.position[k] = param;
    return edit_rig_set(in->core->document, in->rig, &changed, error);
}

static bool set_position(struct inspector *in, int k, double metres, struct error *error)
{
    return put_position(in, k, param_number(metres), error);
}

/// A step of its own: lets the body follow a spline, or stay.
static void follow(struct inspector *in, int k, struct param param)
{
    if (core_begin(in->core, param.track < 0 ? "Stop following" : "Follow spline", 0))
        core_end(in->core, put_position(in, k, param, &in->core->error));
}

/// A coordinate: a number, or the spline that it follows, and the button from one to the other.
static void build_coordinate(struct inspector *in, const struct tail *tail, int k)
{
    struct rect r = ui_row(&in->ui, UI_ROW), icon = {r.x + r.w - INSPECTOR_ICON, r.y, INSPECTOR_ICON, r.h};
    static const struct number_home home = {.get = get_position, .set = set_position};
    const struct param *param = &tail->position[k];
    char button[32];
    r.w -= INSPECTOR_ICON + 4;
    snprintf(button, sizeof button, "position.%s.follow", coordinate_name(k));
    struct rect field = {r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
    if (param->track >= 0) {
        ui_label(&in->ui, (struct rect){r.x, r.y, UI_LABEL, r.h}, coordinate_name(k), theme()->text_dim);
        ui_dropdown(&in->ui, field, place_list, k, in->core->document->splines[param->track]->name,
                    spline_list_color(in->core->document, param->track));
        wiggly_value now = evaluation_at(in->core->evaluation, param->track, in->core->playback.position);
        if (ui_icon_button(&in->ui, icon, button, UI_ICON_UNFOLLOW, false,
                           "Stop following; stay at the current position"))
            follow(in, k, param_number(core_round(now.y + now.re, 1e-3)));
        return;
    }
    inspector_number(in, &position[k], &home, k, r);
    if (in->core->document->spline_count == 0) return;
    if (ui_icon_button(&in->ui, icon, button, UI_ICON_FOLLOW, false, "Follow a spline (in metres)")) {
        ui_popup_open(&in->ui, place_list, k, field);
    }
}

static void place_popup(struct inspector *in)
{
    const struct rig *rig = inspector_shown(in);
    if (!ui_popup_is_open(&in->ui, place_list) || !rig || rig->kind != RIG_TAIL) return;
    int k = in->ui.popup.which;
    int picked = inspector_spline_list(in, place_list, NULL, rig->tail.position[k].track);
    if (picked >= 0) follow(in, k, param_track(picked));
}

static const char feed_list[] = "feed", axis_list[] = "axis";

static struct channel_place place_of(const struct inspector *in)
{
    return (struct channel_place){in->rig, in->channel};
}

/// The channel that is chosen of the tail or chain; NULL where it has none.
static const struct channel *chosen_channel(const struct inspector *in)
{
    int count = 0;
    const struct rig *rig = inspector_shown(in);
    const struct channel *channels = rig ? rig_channels(rig, &count) : NULL;
    return in->channel < count ? &channels[in->channel] : NULL;
}

/// Shows a channel, and what it feels like.
static void choose(struct inspector *in, int channel)
{
    in->channel = channel;
    core_activate(in->core, chosen_channel(in)->spline);
    in->channel = channel; // of two by the same spline
}

/// A step of its own.
static bool put_channel(struct inspector *in, const char *label, const struct channel *channel)
{
    return core_begin(in->core, label, 0) &&
           core_end(in->core, edit_channel(in->core->document, place_of(in), channel, &in->core->error));
}

/// A gain that was never set becomes the new axis's.
static void set_axis(struct inspector *in, enum axis axis)
{
    struct channel changed = *chosen_channel(in);
    const bool untouched = changed.gain.form == ANGLES_ONE && changed.gain.value[0] == axis_gain(changed.axis);
    changed.axis = axis;
    if (untouched) changed.gain.value[0] = axis_gain(axis);
    put_channel(in, "Set axis", &changed);
}

static void build_axis_list(struct inspector *in, const struct channel *channel)
{
    enum { COUNT = sizeof tail_axes / sizeof *tail_axes };
    struct ui_item items[COUNT];
    int row = -1;
    if (!ui_popup_is_open(&in->ui, axis_list)) return;
    for (int a = 0; a < COUNT; a++) {
        items[a] = tail_axes[a].item;
        if (tail_axes[a].axis == channel->axis) row = a;
    }
    const int picked = ui_popup_list(&in->ui, axis_list, items, COUNT, row);
    if (picked >= 0) set_axis(in, tail_axes[picked].axis);
}

/// The list of splines that the channel can bend by, and of what it can move, where one is open.
static void build_channel_lists(struct inspector *in)
{
    const struct channel *channel = chosen_channel(in);
    if (channel) build_axis_list(in, channel);
    if (!ui_popup_is_open(&in->ui, feed_list) || !channel) return;
    int picked = inspector_spline_list(in, feed_list, NULL, channel->spline);
    if (picked < 0) return;
    struct channel changed = *channel;
    changed.spline = picked;
    if (put_channel(in, "Set channel's spline", &changed)) choose(in, in->channel);
}

/// Where a chain begins and where it ends.
static const struct end {
    const char *label, *list, *pick, *hint;
    enum bone_use use;
} ends[2] = {
    {"from", "chain.from", "chain.from.pick", "The bone that it begins with", BONE_FIRST},
    {"to", "chain.to", "chain.to.pick", "The bone that it ends with", BONE_LAST},
};

static void end_list(struct inspector *in, const struct end *end, const struct chain *chain)
{
    const int model = bones_model_of(in->core->document, chain);
    const struct imported *character = model >= 0 ? bones_character(in->core, model) : NULL;
    if (!ui_popup_is_open(&in->ui, end->list) || !character) return;
    const bool first = end->use == BONE_FIRST;
    const int top = first ? -1 : gltf_find_node(&character->gltf, chain->from);
    const int node = inspector_bone_list(in, end->list, model, top, first ? chain->from : chain->to);
    if (node >= 0) bones_set_end(in->core, in->rig, first, node);
}

/// The lists of the bones that a chain can begin and end with.
static void build_chain_lists(struct inspector *in)
{
    for (int e = 0; e < 2; e++) {
        const struct rig *rig = inspector_shown(in);
        if (rig && rig->kind == RIG_CHAIN) end_list(in, &ends[e], &rig->chain);
    }
}

void inspector_tail_lists(struct inspector *in)
{
    build_channel_lists(in);
    build_chain_lists(in);
    place_popup(in);
}

static const struct number_row size[] = {
    {"joints", "joints", NULL, "More joints bend more smoothly; shape and swing stay the same", "Set joints",
     WHOLE_AT(struct tail, joints), 1, 64, 1, TAIL_MAX_JOINTS, TAIL_DEFAULT_JOINTS, 1, 0},
    {"length", "length", "m", "Length of the tail; the body scales with it", "Set length",
     NUMBER_AT(struct tail, length), 0.2, 4, 1e-3, 1e6, TAIL_DEFAULT_LENGTH, 0.05, 2},
};

static const void *shown_tail(const struct inspector *in) { return &inspector_shown(in)->tail; }

static bool set_size(struct inspector *in, int which, double number, struct error *error)
{
    struct rig changed = *inspector_shown(in);
    if (which == 0) return edit_joints(in->core->document, in->rig, (int)lround(number), error);
    changed.tail.length = number;
    return edit_rig_set(in->core->document, in->rig, &changed, error);
}

void inspector_overlays(struct inspector *in)
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
        ui_hint(&in->ui, r, toggles[i].hint);
        ui_toggle(&in->ui, r, toggles[i].name, toggles[i].on);
    }
}

/// Whether the next drag of a body is recorded; without a body nothing is.
static void build_record(struct inspector *in)
{
    if (!document_tail(in->core->document, 0)) return;
    const struct rect r = inspector_labelled(in, "record");
    ui_hint(&in->ui, r, "Record the next drag of the body as knots (or press R while dragging)");
    ui_toggle(&in->ui, r, "record", &in->core->record_armed);
}

static const char *axis_label(enum axis axis)
{
    size_t a = 0;
    while (a < sizeof tail_axes / sizeof *tail_axes && tail_axes[a].axis != axis) a++;
    return a < sizeof tail_axes / sizeof *tail_axes ? tail_axes[a].item.label : "twist";
}

static void build_list(struct inspector *in)
{
    struct ui *ui = &in->ui;
    int count;
    const struct channel *channels = rig_channels(inspector_shown(in), &count);
    for (int c = 0; c < count; c++) {
        const struct channel *channel = &channels[c];
        char name[32], text[192];
        snprintf(name, sizeof name, "channel.%d", c);
        snprintf(text, sizeof text, "%s, %s", in->core->document->splines[channel->spline]->name,
                 axis_label(channel->axis));
        struct rect r = ui_row(ui, UI_ROW);
        ui_hint(ui, r, "One of the splines that bend it");
        uint32_t color = spline_list_color(in->core->document, channel->spline);
        if (ui_list_row(ui, r, name, text, color, c == in->channel)) {
            choose(in, c);
            return;
        }
    }
}

static void build_channels(struct inspector *in)
{
    build_list(in);
    ui_space(&in->ui, 4);
}

static void build_buttons(struct inspector *in)
{
    static const struct icon_button buttons[] = {
        {"channel.add", "Bend it by the active spline too", UI_ICON_ADD},
        {"channel.delete", "Delete this channel", UI_ICON_DELETE},
    };
    struct error *error = &in->core->error;
    const int rig = in->rig, spline = in->core->active;
    const int pressed = inspector_icons(in, inspector_labelled(in, "channel"), buttons, chosen_channel(in) ? 2 : 1);
    if (pressed < 0 || !core_begin(in->core, pressed == 0 ? "Add channel" : "Delete channel", 0)) return;
    const bool done = pressed == 0 ? edit_channel_add(in->core->document, rig, spline, AXIS_SIDE, PART_TOTAL, error)
                                   : edit_channel_remove(in->core->document, place_of(in), error);
    if (core_end(in->core, done) && pressed == 0) in->channel = rig_input_count(in->core->document->rigs[rig]) - 1;
}

static void build_choices(struct inspector *in, const struct channel *channel)
{
    static const struct ui_choice chain[] = {
        [AXIS_SIDE] = {"side", "Side"}, [AXIS_UP] = {"up", "Up"}, [AXIS_TWIST] = {"twist", "Twist"}};
    static const struct ui_choice parts[] = {
        [PART_TOTAL] = {"total", "Total"}, [PART_DISPLACEMENT] = {"displacement", "Displaced"}};
    struct ui *ui = &in->ui;
    int axis = (int)channel->axis, part = (int)channel->of;
    struct rect row = inspector_labelled(in, "axis");
    ui_hint(ui, row, "The way it bends, or moves the body");
    if (inspector_shown(in)->kind == RIG_TAIL) {
        ui_dropdown(ui, row, axis_list, in->channel, axis_label(channel->axis), 0);
    } else if (ui_segments(ui, row, "axis", chain, 3, &axis)) {
        set_axis(in, (enum axis)axis);
    }
    if (inspector_choice(in, "bends by", "Total, or displacement only: use that for a tail on a moving base", "part",
                         parts, 2, &part)) {
        struct channel changed = *channel;
        changed.of = (enum channel_part)part;
        put_channel(in, "Set what bends", &changed);
    }
}

/// Its channels: the list; and what the chosen one is made of.
static void build_channel(struct inspector *in)
{
    build_buttons(in);
    const struct channel *channel = chosen_channel(in);
    if (!channel) return;
    const char *spline = in->core->document->splines[channel->spline]->name;
    const struct rect field = inspector_labelled(in, "spline");
    ui_hint(&in->ui, field, "The spline that bends it");
    ui_dropdown(&in->ui, field, feed_list, in->channel, spline,
                spline_list_color(in->core->document, channel->spline));
    build_choices(in, channel);
}

/// The bone at one end: a list of those that it may be, and a button to pick it on the stage.
static void build_end(struct inspector *in, const struct end *end, const char *bone)
{
    struct rect field = inspector_labelled(in, end->label),
                icon = {field.x + field.w - INSPECTOR_ICON, field.y, INSPECTOR_ICON, field.h};
    field.w -= INSPECTOR_ICON + 4;
    const int rig = in->rig;
    ui_hint(&in->ui, field, end->hint);
    ui_dropdown(&in->ui, field, end->list, rig, bone, 0);
    const bool picking = in->core->pick.use == end->use && in->core->pick.which == rig;
    if (ui_icon_button(&in->ui, icon, end->pick, UI_ICON_PICK, picking, "Pick it on the stage"))
        bones_pick(in->core, picking ? BONE_SELECTED : end->use, rig);
}

static const struct number_row turn_rows[] = {
    {"chain.turn", "turn", "°", "Turns the axes of side and up about the chain's own direction", "Turn chain's axes",
     NUMBER_AT(struct chain, turn), -180, 180, -36000, 36000, 0, 1, 0},
};

static const void *shown_chain(const struct inspector *in) { return &inspector_shown(in)->chain; }

static bool set_turn(struct inspector *in, int which, double degrees, struct error *error)
{
    struct rig changed = *inspector_shown(in);
    (void)which;
    changed.chain.turn = degrees;
    return edit_rig_set(in->core->document, in->rig, &changed, error);
}

static void build_mirror(struct inspector *in)
{
    struct rig changed = *inspector_shown(in);
    struct rect r = inspector_labelled(in, "mirror");
    ui_hint(&in->ui, r, "Bend to the other side, as a left ear does to a right one");
    if (ui_toggle(&in->ui, r, "chain.mirror", &changed.chain.mirror) && core_begin(in->core, "Mirror chain", 0))
        core_end(in->core, edit_rig_set(in->core->document, in->rig, &changed, &in->core->error));
}

static void build_twin(struct inspector *in)
{
    if (!bones_has_twin(in->core, in->rig)) return;
    const struct rect row = ui_row(&in->ui, UI_ROW), button = {row.x, row.y + 2, row.w, row.h - 4};
    ui_hint(&in->ui, button, "The same chain on the other side, mirrored, by the same splines");
    if (!ui_button(&in->ui, button, "chain.twin", "Mirror to other side", false)) return;
    bones_make_twin(in->core, in->rig);
    in->rig = in->core->document->rig_count - 1;
}

/// What a chain is made of, its place in the list of chains aside; and the buttons that make its twin and take it away.
static void build_chain(struct inspector *in)
{
    static const struct number_home home = {.of = shown_chain, .set = set_turn};
    const struct chain *chain = &inspector_shown(in)->chain;
    build_end(in, &ends[0], chain->from);
    build_end(in, &ends[1], chain->to);
    inspector_numbers(in, turn_rows, 1, &home);
    build_mirror(in);
    build_twin(in);
}

/// Buttons among these rows may make another list of channels, and more rigs: each looks what is shown up anew.
static void build_shown(struct inspector *in)
{
    const bool is_tail = inspector_shown(in)->kind == RIG_TAIL;
    static const struct number_home home = {.of = shown_tail, .set = set_size};
    if (in->channel >= rig_input_count(inspector_shown(in))) in->channel = 0;
    build_channels(in);
    if (is_tail) inspector_angles(in, ANGLE_REST);
    build_channel(in);
    ui_space(&in->ui, 4);
    build_name(in);
    if (!is_tail) {
        build_chain(in);
        return;
    }
    inspector_numbers(in, size, sizeof size / sizeof size[0], &home);
    for (int k = 0; k < 3; k++) build_coordinate(in, &inspector_shown(in)->tail, k);
}

void inspector_tail(struct inspector *in)
{
    inspector_find_rig(in); // one may just have been removed
    build_shown(in);
    build_record(in);
    inspector_overlays(in);
}

const struct channel *inspector_felt_channel(const struct inspector *in)
{
    const struct channel *channel = chosen_channel(in);
    return channel && channel->spline == in->core->active ? channel : NULL;
}
