/// The inspector's section on the shown tail or chain: its channels, its place, its shape.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/parts.h"
#include <math.h>
#include <stdio.h>

/// A tail's and its body's channels, in list order.
static const struct {
    enum axis axis;
    struct ui_item item;
} tail_axes[] = {
    {AXIS_SIDE, {"side", "bend", 0}},
    {AXIS_UP, {"up", "lift", 0}},
    {AXIS_LOOK, {"look", "turn of the head", 0}},
    {AXIS_NOD, {"nod", "nod of the head", 0}},
    {AXIS_EARS, {"ears", "ears", 0}},
    {AXIS_BREATH, {"breath", "chest", 0}},
    {AXIS_STRETCH, {"stretch", "stretch", 0}},
    {AXIS_BLINK, {"blink", "eyelids", 0}},
};

static const char rename_line[] = "tail.rename";

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

enum { ROW_X, ROW_JOINTS = ROW_X + 3, ROW_LENGTH, ROW_TURN };

static const struct number_row rows[] = {
    [ROW_X] = {"position.x", "x", "m", "Position of the body along x", "Move body",
               NUMBER_AT(struct rig, tail.position[0].value), 0, 0, -1e6, 1e6, 0, 0.01, 3},
    {"position.y", "y", "m", "Position of the body along y", "Move body",
     NUMBER_AT(struct rig, tail.position[1].value), 0, 0, -1e6, 1e6, 0.26, 0.01, 3},
    {"position.z", "z", "m", "Position of the body along z", "Move body",
     NUMBER_AT(struct rig, tail.position[2].value), 0, 0, -1e6, 1e6, 0, 0.01, 3},
    [ROW_JOINTS] = {"joints", "joints", NULL, "More joints bend more smoothly; shape and swing stay the same",
                    "Set joints", WHOLE_AT(struct rig, tail.joints), 1, 64, 1, TAIL_MAX_JOINTS, TAIL_DEFAULT_JOINTS,
                    1, 0},
    [ROW_LENGTH] = {"length", "length", "m", "Length of the tail; the body scales with it", "Set length",
                    NUMBER_AT(struct rig, tail.length), 0.2, 4, 1e-3, 1e6, TAIL_DEFAULT_LENGTH, 0.05, 2},
    [ROW_TURN] = {"chain.turn", "turn", "°", "Turns the axes of side and up about the chain's own direction",
                  "Turn chain's axes", NUMBER_AT(struct rig, chain.turn), -180, 180, -36000, 36000, 0, 1, 0},
};

static int shown_rig(const struct inspector *in) { return in->rig; }

static const struct number_home of_shown = {.rig = shown_rig};

/// Lets the body follow a spline, or stop, in its own undo step.
static void follow(struct inspector *in, int k, struct param param)
{
    struct rig changed = *inspector_shown(in);
    changed.tail.position[k] = param;
    if (core_begin(in->core, param.track < 0 ? "Stop following" : "Follow spline", 0))
        core_end(in->core, edit_rig_set(in->core->document, in->rig, &changed, &in->core->error));
}

static void choose_place(struct inspector *in, const struct dropdown *list)
{
    const int k = in->ui.popup.which;
    const int picked = inspector_spline_list(in, list, inspector_shown(in)->tail.position[k].track);
    if (picked >= 0) follow(in, k, param_track(picked));
}

static const struct dropdown place_list = {"place", "The spline it follows, sample by sample", choose_place};

/// A coordinate: a number or the followed spline, and the button between the two.
static void build_coordinate(struct inspector *in, const struct tail *tail, int k)
{
    const int track = tail->position[k].track;
    const bool follows = track >= 0;
    const char *hint = follows ? "Stop following; stay at the current position" : "Follow a spline (in metres)";
    struct rect r = ui_row(&in->ui, UI_ROW), icon = {r.x + r.w - INSPECTOR_ICON, r.y, INSPECTOR_ICON, r.h};
    char button[32];
    r.w -= INSPECTOR_ICON + 4;
    snprintf(button, sizeof button, "position.%s.follow", coordinate_name(k));
    const struct rect field = {r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
    if (follows) {
        inspector_spline_field(in, &place_list, inspector_label(in, r, coordinate_name(k)), k, track);
    } else {
        inspector_number(in, &rows[ROW_X + k], &of_shown, k, r);
        if (in->core->document->spline_count == 0) return;
    }
    if (ui_icon_button(&in->ui, icon, button, follows ? UI_ICON_UNFOLLOW : UI_ICON_FOLLOW, false, hint)) {
        const wiggly_value now = evaluation_at(in->core->evaluation, track, in->core->playback.position);
        if (follows) follow(in, k, param_number(core_round(now.y + now.re, 1e-3)));
        if (!follows) ui_popup_open(&in->ui, place_list.name, k, field);
    }
    inspector_offer(in, &place_list);
}

static struct channel_place place_of(const struct inspector *in)
{
    return (struct channel_place){in->rig, in->channel};
}

/// The shown channel, or NULL.
static const struct channel *chosen_channel(const struct inspector *in)
{
    int count = 0;
    const struct rig *rig = inspector_shown(in);
    const struct channel *channels = rig ? rig_channels(rig, &count) : NULL;
    return in->channel < count ? &channels[in->channel] : NULL;
}

/// Selects a channel and its spline.
static void choose(struct inspector *in, int channel)
{
    in->channel = channel;
    core_choose(in->core, chosen_channel(in)->spline);
    in->channel = channel; // two channels may share a spline
}

/// In its own undo step.
static bool put_channel(struct inspector *in, const char *label, const struct channel *channel)
{
    return core_begin(in->core, label, 0) &&
           core_end(in->core, edit_channel(in->core->document, place_of(in), channel, &in->core->error));
}

/// A gain still at its default becomes the new axis's default.
static void set_axis(struct inspector *in, enum axis axis)
{
    struct channel changed = *chosen_channel(in);
    const bool untouched = changed.gain.form == ANGLES_ONE && changed.gain.value[0] == axis_gain(changed.axis);
    changed.axis = axis;
    if (untouched) changed.gain.value[0] = axis_gain(axis);
    put_channel(in, "Set axis", &changed);
}

static void choose_axis(struct inspector *in, const struct dropdown *list)
{
    enum { COUNT = sizeof tail_axes / sizeof *tail_axes };
    struct ui_item items[COUNT];
    int row = -1;
    for (int a = 0; a < COUNT; a++) {
        items[a] = tail_axes[a].item;
        if (tail_axes[a].axis == chosen_channel(in)->axis) row = a;
    }
    const int picked = ui_popup_list(&in->ui, list->name, items, COUNT, row);
    if (picked >= 0) set_axis(in, tail_axes[picked].axis);
}

static const struct dropdown axis_list = {"axis", "What this channel moves", choose_axis};

static void choose_feed(struct inspector *in, const struct dropdown *list)
{
    struct channel changed = *chosen_channel(in);
    changed.spline = inspector_spline_list(in, list, changed.spline);
    if (changed.spline >= 0 && put_channel(in, "Set channel's spline", &changed)) choose(in, in->channel);
}

static const struct dropdown feed_list = {"feed", "The spline that drives this channel", choose_feed};

/// One end of a chain.
struct end {
    struct dropdown list; ///< first member, so that a list pointer leads back here
    const char *label, *pick;
    enum bone_use use;
};

static void choose_end(struct inspector *in, const struct dropdown *list)
{
    const bool first = ((const struct end *)list)->use == BONE_FIRST;
    const struct chain *chain = &inspector_shown(in)->chain;
    const int model = rig_body(in->core->document, in->rig);
    const struct imported *character = model >= 0 ? bones_character(in->core, model) : NULL;
    if (!character) return;
    const int top = first ? -1 : gltf_find_node(&character->gltf, chain->from);
    const int node = inspector_bone_list(in, list, model, top, first ? chain->from : chain->to);
    if (node >= 0) bones_set_end(in->core, in->rig, first, node);
}

static const struct end ends[2] = {
    {{"chain.from", "First bone of the chain", choose_end}, "from", "chain.from.pick", BONE_FIRST},
    {{"chain.to", "Last bone of the chain", choose_end}, "to", "chain.to.pick", BONE_LAST},
};

static bool set_joints(struct inspector *in, int which, double number, struct error *error)
{
    (void)which;
    return edit_joints(in->core->document, in->rig, (int)lround(number), error);
}

void inspector_overlays(struct inspector *in)
{
    struct core *core = in->core;
    const struct {
        const char *name, *label, *hint;
        bool *on;
    } toggles[] = {
        {"onion", "onion skin", "Show the pose at the knots around the playhead (O)", &core->overlays.onion},
        {"trail", "motion arc", "Show the path of the tip or liveliest point, one mark per frame (Shift+O)",
         &core->overlays.trail},
        {"ghost", "ghost pose", "Show the pose at the knot that is dragged or nudged (F4)", &core->overlays.ghost},
    };
    for (size_t i = 0; i < sizeof toggles / sizeof toggles[0]; i++) {
        struct rect r = inspector_labelled(in, toggles[i].label);
        ui_hint(&in->ui, r, toggles[i].hint);
        ui_toggle(&in->ui, r, toggles[i].name, toggles[i].on);
    }
}

/// Whether the next drag of a body is recorded. Only a body can be.
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
        ui_hint(ui, r, "A channel of this rig, and the spline that drives it");
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
        {"channel.add", "Add a channel that the active spline drives", UI_ICON_ADD},
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
        [AXIS_SIDE] = {"side", "Bend"}, [AXIS_UP] = {"up", "Lift"}, [AXIS_TWIST] = {"twist", "Twist"}};
    static const struct ui_choice parts[] = {
        [PART_TOTAL] = {"total", "Curve"}, [PART_DISPLACEMENT] = {"displacement", "Swing"}};
    int axis = (int)channel->axis, part = (int)channel->of;
    if (inspector_shown(in)->kind == RIG_TAIL) {
        inspector_dropdown(in, &axis_list, inspector_labelled(in, "moves"), in->channel, axis_label(channel->axis),
                           0);
    } else if (inspector_choice(in, "moves", axis_list.hint, "axis", chain, 3, &axis)) {
        set_axis(in, (enum axis)axis);
    }
    if (inspector_choice(in, "driven by",
                         "The whole curve, or its swing about the equilibrium only: for a tail on a moving base",
                         "part", parts, 2, &part)) {
        struct channel changed = *channel;
        changed.of = (enum channel_part)part;
        put_channel(in, "Set what bends", &changed);
    }
}

static void build_channel(struct inspector *in)
{
    build_buttons(in);
    const struct channel *channel = chosen_channel(in);
    if (!channel) return;
    inspector_spline_field(in, &feed_list, inspector_labelled(in, "spline"), in->channel, channel->spline);
    build_choices(in, channel);
}

/// A list of bones for one end, and a button to pick one on the stage.
static void build_end(struct inspector *in, const struct end *end, const char *bone)
{
    struct rect field = inspector_labelled(in, end->label),
                icon = {field.x + field.w - INSPECTOR_ICON, field.y, INSPECTOR_ICON, field.h};
    field.w -= INSPECTOR_ICON + 4;
    const int rig = in->rig;
    inspector_dropdown(in, &end->list, field, rig, bone, 0);
    const bool picking = in->core->pick.use == end->use && in->core->pick.which == rig;
    if (ui_icon_button(&in->ui, icon, end->pick, UI_ICON_PICK, picking, "Pick it on the stage"))
        bones_pick(in->core, picking ? BONE_SELECTED : end->use, rig);
}

static void build_mirror(struct inspector *in)
{
    struct rig changed = *inspector_shown(in);
    struct rect r = inspector_labelled(in, "mirror");
    ui_hint(&in->ui, r, "Bend to the other side, as a left ear does to a right one");
    if (ui_toggle(&in->ui, r, "chain.mirror", &changed.chain.mirror) && core_begin(in->core, "Mirror chain", 0))
        core_end(in->core, edit_rig_set(in->core->document, in->rig, &changed, &in->core->error));
}

void inspector_mirror(struct inspector *in, int unused)
{
    (void)unused;
    bones_make_twin(in->core, bones_mirrorable(in->core, in->rig));
    in->rig = in->core->document->rig_count - 1;
}

static void build_twin(struct inspector *in)
{
    if (bones_mirrorable(in->core, in->rig) != in->rig) return;
    const struct rect row = ui_row(&in->ui, UI_ROW), button = {row.x, row.y + 2, row.w, row.h - 4};
    ui_hint(&in->ui, button,
            "Add the mirrored chain, bent by the same splines; you can choose others for its channels");
    if (ui_button(&in->ui, button, "chain.twin", "Mirror to other side", false)) inspector_mirror(in, 0);
}

static void build_chain(struct inspector *in)
{
    const struct chain *chain = &inspector_shown(in)->chain;
    build_end(in, &ends[0], chain->from);
    build_end(in, &ends[1], chain->to);
    inspector_numbers(in, &rows[ROW_TURN], 1, &of_shown);
    build_mirror(in);
    build_twin(in);
}

/// These rows may change channels and rigs, so each looks up the shown rig again.
static void build_shown(struct inspector *in)
{
    const bool is_tail = inspector_shown(in)->kind == RIG_TAIL;
    static const struct number_home joints = {.rig = shown_rig, .set = set_joints};
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
    inspector_numbers(in, &rows[ROW_JOINTS], 1, &joints);
    inspector_numbers(in, &rows[ROW_LENGTH], 1, &of_shown);
    for (int k = 0; k < 3; k++) build_coordinate(in, &inspector_shown(in)->tail, k);
}

void inspector_tail(struct inspector *in)
{
    inspector_find_rig(in); // a row may have removed one
    build_shown(in);
    build_record(in);
    inspector_overlays(in);
}

const struct channel *inspector_felt_channel(const struct inspector *in)
{
    const struct channel *channel = chosen_channel(in);
    return channel && channel->spline == in->core->active ? channel : NULL;
}
