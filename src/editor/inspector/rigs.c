/// The sections on rigs: their list and the menu of additions, tails and chains, characters.
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/state.h"
#include "rig/models.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RIG_ROWS = 12 }; ///< listed at once

static bool is_tail_or_chain(const struct document *document, int rig)
{
    return rig >= 0 && rig < document->rig_count &&
           (document->rigs[rig]->kind == RIG_TAIL || document->rigs[rig]->kind == RIG_CHAIN);
}

const struct rig *inspector_shown(const struct inspector *in)
{
    const int rig = in->rig;
    return is_tail_or_chain(in->core->document, rig) ? in->core->document->rigs[rig] : NULL;
}

void inspector_find_rig(struct inspector *in)
{
    const int limb = core_limb(in->core);
    if (limb >= 0 && limb != in->selected) inspector_show_spline(in, in->core->focus.active); // dragged, not clicked
    if (!inspector_shown(in)) {
        const int tail = document_find_rig(in->core->document, RIG_TAIL, 0),
                  chain = document_find_rig(in->core->document, RIG_CHAIN, 0);
        in->rig = tail >= 0 ? tail : chain >= 0 ? chain : 0;
        in->channel = 0;
    }
    const struct rig *shown = inspector_shown(in);
    if (shown && in->channel >= rig_input_count(shown)) in->channel = 0;
    if (in->selected >= in->core->document->rig_count) in->selected = in->core->document->rig_count - 1;
    if (in->selected < 0) in->selected = 0;

    struct character_view *view = &in->core->focus.characters;
    if (document_find_rig(in->core->document, RIG_MODEL, view->character) < 0) view->character = 0;
    const struct model_rig *character = characters_selected(in->core);
    if (character && view->drive >= character->drive_count) view->drive = 0;
}

/// Shows a rig, and one of its inputs, in the section of its kind.
static void show_rig(struct inspector *in, int rig, int input)
{
    struct character_view *view = &in->core->focus.characters;
    in->selected = rig;
    if (is_tail_or_chain(in->core->document, rig)) {
        in->rig = rig;
        in->channel = input;
    } else {
        view->character = document_rig_number(in->core->document, rig);
        view->drive = input;
    }
}

static int input_of(const struct rig *rig, int spline)
{
    for (int i = 0; i < rig_input_count(rig); i++) {
        if (rig_input(rig, i) == spline) return i;
    }
    return -1;
}

void inspector_show_spline(struct inspector *in, int spline)
{
    const struct document *document = in->core->document;
    const int limb = core_limb(in->core);
    int found = limb >= 0 ? limb : in->selected < document->rig_count ? in->selected : -1;
    if (found >= 0 && input_of(document->rigs[found], spline) < 0) found = -1;
    for (int r = 0; r < document->rig_count && found < 0; r++) {
        if (input_of(document->rigs[r], spline) >= 0) found = r;
    }
    if (found >= 0) show_rig(in, found, input_of(document->rigs[found], spline));
}

void inspector_show_rig(struct inspector *in, int rig)
{
    static const char *const sections[] = {
        [RIG_TAIL] = "section.tail", [RIG_CHAIN] = "section.tail", [RIG_MODEL] = "section.character"};
    const struct rig *chosen = in->core->document->rigs[rig];
    if (chosen->kind == RIG_MODEL) in->core->focus.bone.any = false;
    show_rig(in, rig, 0);
    in->core->focus.limb = chosen->id;
    inspector_unfold(in, sections[chosen->kind]);
    if (rig_input_count(chosen) == 0) return;
    if (input_of(chosen, in->core->focus.active) < 0) core_activate(in->core, rig_input(chosen, 0));
    inspector_show_spline(in, in->core->focus.active);
}

void inspector_show_clicked(struct inspector *in, int rig)
{
    if (rig >= in->core->document->rig_count) return;
    inspector_show_rig(in, rig);
    in->seen_bone = in->core->focus.bone; // of a chain
    in->revealed = NULL;
}

enum { MAX_COPIES = 4, MAX_ADDED = 5 + MAX_COPIES, ADDED_LABEL = 96, ADDED_WIDTH = 244 };

void inspector_remove_rig(struct inspector *in, int unused)
{
    (void)unused;
    rigs_ask_remove(in->core, in->selected);
}

void inspector_rigs(struct inspector *in)
{
    static const struct row buttons[] = {
        {ICON("rig.add", UI_ICON_ADD), .hint = "Add a tail, a character, a chain … (A)"},
        {ICON("rig.copy", UI_ICON_COPY), .hint = "Copy this rig, beside it"},
        {ICON("rig.delete", UI_ICON_DELETE), .hint = "Remove this rig, with its splines or without (Shift+Del)"},
    };
    const int count = in->core->document->rig_count, first = inspector_first_row(count, in->selected, RIG_ROWS);
    if (count == 0) ui_paragraph(&in->ui, "Nothing is on the stage yet.", theme()->text_dim);
    for (int rig = first; rig < count && rig < first + RIG_ROWS; rig++) {
        const struct rig *shown = in->core->document->rigs[rig];
        const struct rect r = ui_row(&in->ui, UI_ROW);
        const char *title = path_name(rig_title(shown));
        char name[32], text[160];
        snprintf(name, sizeof name, "%s.%d", rig_word(shown->kind), document_rig_number(in->core->document, rig));
        snprintf(text, sizeof text, "%.*s, %s", name_fit(title, 100), title, rig_word(shown->kind));
        const uint32_t color =
            rig_input_count(shown) > 0 ? spline_list_color(in->core->document, rig_input(shown, 0)) : 0;
        ui_hint(&in->ui, r, "Show this rig and the splines that drive it");
        if (ui_list_row(&in->ui, r, name, text, color, rig == in->selected)) inspector_show_rig(in, rig);
    }
    inspector_more(in, count, RIG_ROWS, "");

    const struct rect r = ui_row(&in->ui, UI_ROW);
    const int before = in->core->document->rig_count, rig = in->selected;
    const int pressed = inspector_buttons(in, r, buttons, before > 0 ? 3 : 1);
    const struct rect below = {r.x - 2, r.y, ADDED_WIDTH, r.h};
    if (pressed == 0) ui_popup_open(&in->ui, inspector_add_list.name, 0, below);
    if (pressed == 1) rigs_copy(in->core, rig);
    if (pressed == 2) rigs_ask_remove(in->core, rig);
    if (in->core->document->rig_count > before) inspector_show_rig(in, before);
}

void inspector_add(struct inspector *in, int what)
{
    const int before = in->core->document->rig_count;
    if (what == ADD_TAIL) rigs_add_tail(in->core);
    if (what == ADD_FILE) in->core->question.adds = true;
    if (what == ADD_COPY) rigs_copy(in->core, in->selected);
    if (what == ADD_CHAIN) bones_make_chain(in->core, false);
    if (what == ADD_SPLINE) spline_list_change(in->core, LIST_ADD);
    if (what >= ADD_COPY_OF) rigs_copy(in->core, what - ADD_COPY_OF);
    if (in->core->document->rig_count > before) inspector_show_rig(in, before);
}

static void choose_added(struct inspector *in, const struct dropdown *list)
{
    const struct document *document = in->core->document;
    struct ui_item items[MAX_ADDED] = {{"tail", "Tail", 0, ADD_TAIL},
                                       {"file", "Character or background file …", 0, ADD_FILE}};
    char names[MAX_COPIES][24], labels[MAX_COPIES][ADDED_LABEL];
    int count = 2;
    for (int r = 0, copies = 0; r < document->rig_count && copies < MAX_COPIES; r++) {
        const char *title = path_name(rig_title(document->rigs[r]));
        if (document->rigs[r]->kind != RIG_MODEL) continue;
        snprintf(names[copies], sizeof names[0], "copy.%d", r);
        snprintf(labels[copies], ADDED_LABEL, "One more %.*s", name_fit(title, 80), title);
        items[count++] = (struct ui_item){names[copies], labels[copies], 0, ADD_COPY_OF + r};
        copies++;
    }
    if (document_find_rig(document, RIG_MODEL, 0) >= 0)
        items[count++] = (struct ui_item){"chain", "Chain from the selected bone (J)", 0, ADD_CHAIN};
    items[count++] = (struct ui_item){"spline", "Spline", 0, ADD_SPLINE};
    inspector_add(in, inspector_list(in, list, items, count, -1));
}

const struct dropdown inspector_add_list = {.name = "add", .build = choose_added};

void inspector_add_menu(struct inspector *in, int unused)
{
    const struct layout *layout = &in->core->view.layout;
    const float x = in->core->input.pointer_x, y = in->core->input.pointer_y;
    const bool beside = rect_contains(layout->stage, x, y) || rect_contains(layout->curves, x, y);
    const struct rect panel = layout->inspector;
    const struct rect at = {beside ? x : panel.x + UI_PAD, beside ? y : panel.y, ADDED_WIDTH, beside ? 0 : 4};
    (void)unused;
    ui_popup_open(&in->ui, inspector_add_list.name, 0, at);
    if (beside) in->ui.popup.room = (struct rect){0, 0, panel.x, layout->status.y};
    ui_push(&in->ui, 0);
    in->ui.focus = ui_id(&in->ui, "item.tail"); // the first row
    ui_pop(&in->ui);
}

/// A tail's and its body's channels, in list order.
static const struct ui_item tail_axes[] = {
    {"bend", "to the side", 0, AXIS_SIDE},
    {"lift", "up and down", 0, AXIS_UP},
    {"look", "turn of the head", 0, AXIS_LOOK},
    {"nod", "nod of the head", 0, AXIS_NOD},
    {"ears", "ears", 0, AXIS_EARS},
    {"breath", "chest", 0, AXIS_BREATH},
    {"stretch", "stretch", 0, AXIS_STRETCH},
    {"blink", "eyelids", 0, AXIS_BLINK},
};
enum { TAIL_AXES = sizeof tail_axes / sizeof *tail_axes };

enum { ROW_X, ROW_JOINTS = ROW_X + 3, ROW_LENGTH, ROW_TURN, ROW_OFFSET };

static const struct number_row tail_rows[] = {
    [ROW_X] = {NUMBER_AT(struct rig, tail.position[0].value), .undo = "Move body",
               .ui = {NAMED("position.x", "x"), METRES, .hint = "Position of the body along x"}},
    {NUMBER_AT(struct rig, tail.position[1].value), .undo = "Move body",
     .ui = {NAMED("position.y", "y"), METRES, .hint = "Position of the body along y", .fallback = 0.26}},
    {NUMBER_AT(struct rig, tail.position[2].value), .undo = "Move body",
     .ui = {NAMED("position.z", "z"), METRES, .hint = "Position of the body along z"}},
    [ROW_JOINTS] = {WHOLE_AT(struct rig, tail.joints), .undo = "Set joints",
                    .ui = {NAMED("joints", "joints"),
                           .hint = "More joints bend more smoothly; shape and swing stay the same", BAR(1, 64),
                           TYPED(1, TAIL_MAX_JOINTS), .fallback = TAIL_DEFAULT_JOINTS, .step = 1}},
    [ROW_LENGTH] = {NUMBER_AT(struct rig, tail.length), .undo = "Set length",
                    .ui = {NAMED("length", "length"), .unit = "m",
                           .hint = "Length of the tail; the body scales with it", BAR(0.2, 4), TYPED(1e-3, 1e6),
                           .fallback = TAIL_DEFAULT_LENGTH, .step = 0.05, .decimals = 2}},
    [ROW_TURN] = {NUMBER_AT(struct rig, chain.turn), .undo = "Turn chain's axes",
                  .ui = {NAMED("chain.turn", "turn"), DEGREES,
                         .hint = "Turns the axes of side and up about the chain's own direction", BAR(-180, 180),
                         .step = 1}},
    [ROW_OFFSET] = {NUMBER_AT(struct rig, offset), .undo = "Set offset",
                    .ui = {NAMED("offset", "offset"), .unit = "f",
                           .hint = "Frames by which its splines move it later, so that twins are not in step",
                           BAR(-12, 12), TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .step = 0.5, .decimals = 2}},
};

/// Lets the body follow a spline, or stop.
static void follow(struct inspector *in, int k, struct param param)
{
    struct rig changed = *inspector_shown(in);
    changed.tail.position[k] = param;
    edit_rig_set(in->core->document, in->rig, &changed, &in->core->step.error);
}

static void choose_place(struct inspector *in, const struct dropdown *list)
{
    const int k = in->ui.popup.which;
    const int picked = inspector_spline_list(in, list, inspector_shown(in)->tail.position[k].track);
    if (picked >= 0) follow(in, k, param_track(picked));
}

static const struct dropdown place_list = {NAMED("place", NULL), .hint = "The spline it follows, sample by sample",
                                           .undo = "Follow spline", .build = choose_place};

/// A coordinate: a number or the followed spline, and the button between the two.
static void build_coordinate(struct inspector *in, const struct tail *tail, int k)
{
    const int track = tail->position[k].track;
    const bool follows = track >= 0;
    struct rect r = ui_row(&in->ui, UI_ROW), icon = {r.x + r.w - INSPECTOR_ICON, r.y, INSPECTOR_ICON, r.h};
    char name[32];
    r.w -= INSPECTOR_ICON + 4;
    snprintf(name, sizeof name, "position.%s.follow", coordinate_name(k));
    const struct rect field = {r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
    if (follows) {
        inspector_spline_field(in, &place_list, inspector_label(in, r, coordinate_name(k)), k, track);
    } else {
        inspector_number(in, &tail_rows[ROW_X + k], &(struct number_home){.rig = &in->rig}, k, r);
        if (in->core->document->spline_count == 0) return;
    }
    const struct row button = {
        ICON(name, follows ? UI_ICON_UNFOLLOW : UI_ICON_FOLLOW), .undo = follows ? "Stop following" : NULL,
        .hint = follows ? "Stop following; stay at the current position" : "Follow a spline (in metres)"};
    if (inspector_icon(in, icon, &button)) {
        const wiggly_value now = evaluation_at(in->core->evaluation, track, in->core->view.playback.position);
        if (follows) follow(in, k, param_number(core_round(now.y + now.re, 1e-3)));
        if (!follows) ui_popup_open(&in->ui, place_list.name, k, field);
    }
    inspector_offer(in, &place_list);
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
static void choose_channel(struct inspector *in, int channel)
{
    in->channel = channel; // two channels may share a spline
    core_choose(in->core, chosen_channel(in)->spline);
}

enum { CHANNEL_AXIS, CHANNEL_SPLINE, CHANNEL_PART };

/// Edits one of these of the shown channel. A gain still at its axis's default becomes the new axis's default.
static bool set_channel(struct inspector *in, int which, int number)
{
    struct channel changed = *chosen_channel(in);
    const bool untouched = changed.gain.form == ANGLES_ONE && changed.gain.value[0] == axis_gain(changed.axis);
    if (which == CHANNEL_AXIS) changed.axis = (enum axis)number;
    if (which == CHANNEL_SPLINE) changed.spline = number;
    if (which == CHANNEL_PART) changed.of = (enum channel_part)number;
    if (untouched) changed.gain.value[0] = axis_gain(changed.axis);
    const struct channel_place place = {in->rig, in->channel};
    return edit_channel(in->core->document, place, &changed, &in->core->step.error);
}

static void choose_axis(struct inspector *in, const struct dropdown *list)
{
    const int axis = inspector_list(in, list, tail_axes, TAIL_AXES, (int)chosen_channel(in)->axis);
    if (axis >= 0) set_channel(in, CHANNEL_AXIS, axis);
}

static const struct dropdown axis_list = {NAMED("axis", "moves"), .hint = "What this channel moves",
                                          .undo = "Set axis", .build = choose_axis};

static void choose_feed(struct inspector *in, const struct dropdown *list)
{
    const int spline = inspector_spline_list(in, list, chosen_channel(in)->spline);
    if (spline >= 0 && set_channel(in, CHANNEL_SPLINE, spline)) choose_channel(in, in->channel);
}

static const struct dropdown feed_list = {NAMED("feed", "spline"), .hint = "The spline that drives this channel",
                                          .undo = "Set channel's spline", .build = choose_feed};

static void choose_end(struct inspector *in, const struct dropdown *list)
{
    const bool first = list->use == BONE_FIRST;
    const struct chain *chain = &inspector_shown(in)->chain;
    const int model = rig_body(in->core->document, in->rig);
    const struct imported *character = model >= 0 ? bones_character(in->core, model) : NULL;
    if (!character) return;
    const int top = first ? -1 : gltf_find_node(&character->gltf, chain->from);
    const int node = inspector_bone_list(in, list, model, top, first ? chain->from : chain->to);
    if (node >= 0) bones_set_end(in->core, in->rig, first, node);
}

static const struct dropdown from_list = {NAMED("chain.from", "from"), .hint = "First bone of the chain",
                                          .pick = "chain.from.pick", .use = BONE_FIRST, .build = choose_end};
static const struct dropdown to_list = {NAMED("chain.to", "to"), .hint = "Last bone of the chain",
                                        .pick = "chain.to.pick", .use = BONE_LAST, .build = choose_end};

static bool set_joints(struct inspector *in, int which, double number, struct error *error)
{
    (void)which;
    return edit_joints(in->core->document, in->rig, (int)lround(number), error);
}

static void build_overlays(struct inspector *in)
{
    static const struct row rows[] = {
        {NAMED("onion", "onion skin"), .hint = "Show the pose at the knots around the playhead (O)"},
        {NAMED("trail", "motion arc"),
         .hint = "Show the path of the tip or liveliest point, one mark per frame (Shift+O)"},
        {NAMED("ghost", "ghost pose"), .hint = "Show the pose at the knot that is dragged or nudged (F4)"},
    };
    static const int switches[] = {SWITCH_ONION, SWITCH_TRAIL, SWITCH_GHOST};
    for (int i = 0; i < 3; i++)
        inspector_toggle(in, ui_row(&in->ui, UI_ROW), &rows[i], &in->core->view.on[switches[i]]);
}

static const char *axis_label(enum axis axis)
{
    int a = 0;
    while (a < TAIL_AXES && tail_axes[a].value != (int)axis) a++;
    return a < TAIL_AXES ? tail_axes[a].label : "twist";
}

static void build_channel(struct inspector *in)
{
    static const struct row buttons[] = {
        {ICON("channel.add", UI_ICON_ADD), .hint = "Add a channel that the active spline drives",
         .undo = "Add channel"},
        {ICON("channel.delete", UI_ICON_DELETE), .hint = "Delete this channel", .undo = "Delete channel"},
    };
    static const struct ui_choice chain[] = {
        [AXIS_SIDE] = {"side", "Bend"}, [AXIS_UP] = {"up", "Lift"}, [AXIS_TWIST] = {"twist", "Twist"}};
    static const struct ui_choice parts[] = {
        [PART_TOTAL] = {"total", "Curve"}, [PART_DISPLACEMENT] = {"displacement", "Swing"}};
    static const struct row moves = {NAMED("axis", "moves"), .hint = "What this channel moves", .undo = "Set axis",
                                     CHOICES(chain)};
    static const struct row driven = {
        NAMED("part", "driven by"),
        .hint = "The whole curve, or its swing about the equilibrium only: for a tail on a moving base",
        .undo = "Set what bends", CHOICES(parts)};
    struct error *error = &in->core->step.error;
    const int rig = in->rig, spline = in->core->focus.active;
    const int pressed = inspector_buttons(in, inspector_labelled(in, "channel"), buttons, chosen_channel(in) ? 2 : 1);
    if (pressed == 0 && edit_channel_add(in->core->document, rig, spline, AXIS_SIDE, PART_TOTAL, error))
        in->channel = rig_input_count(in->core->document->rigs[rig]) - 1;
    if (pressed == 1) edit_channel(in->core->document, (struct channel_place){rig, in->channel}, NULL, error);

    const struct channel *channel = chosen_channel(in);
    if (!channel) return;
    inspector_spline_field(in, &feed_list, ui_row(&in->ui, UI_ROW), in->channel, channel->spline);
    int axis = (int)channel->axis, part = (int)channel->of;
    if (inspector_shown(in)->kind == RIG_TAIL) {
        inspector_dropdown(in, &axis_list, ui_row(&in->ui, UI_ROW), in->channel, axis_label(channel->axis), 0);
    } else if (inspector_choice(in, &moves, &axis)) {
        set_channel(in, CHANNEL_AXIS, axis);
    }
    if (inspector_choice(in, &driven, &part)) set_channel(in, CHANNEL_PART, part);
}

void inspector_mirror(struct inspector *in, int unused)
{
    (void)unused;
    bones_make_twin(in->core, bones_mirrorable(in->core, in->rig));
    in->rig = in->core->document->rig_count - 1;
}

/// These rows may change channels and rigs, so each looks up the shown rig again.
void inspector_tail(struct inspector *in)
{
    const struct number_home home = {.rig = &in->rig}, joints = {.rig = &in->rig, .set = set_joints};
    struct ui *ui = &in->ui;
    inspector_find_rig(in); // a row may have removed one
    const bool is_tail = inspector_shown(in)->kind == RIG_TAIL;
    int count;
    const struct channel *channels = rig_channels(inspector_shown(in), &count);
    for (int c = 0; c < count; c++) {
        const struct channel *channel = &channels[c];
        char name[32], text[192];
        snprintf(name, sizeof name, "channel.%d", c);
        snprintf(text, sizeof text, "%s, %s", in->core->document->splines[channel->spline]->name,
                 axis_label(channel->axis));
        const struct rect r = ui_row(ui, UI_ROW);
        ui_hint(ui, r, "A channel of this rig, and the spline that drives it");
        const uint32_t color = spline_list_color(in->core->document, channel->spline);
        if (ui_list_row(ui, r, name, text, color, c == in->channel)) choose_channel(in, c);
    }
    ui_space(ui, 4);
    if (is_tail) inspector_angles(in, ANGLE_REST);
    build_channel(in);
    ui_space(ui, 4);

    const struct rect named = inspector_labelled(in, "name");
    const struct rig *rig = inspector_shown(in);
    const struct row rename = {.name = "tail.rename", .undo = is_tail ? "Rename tail" : "Rename chain"};
    if (!ui_line_is_open(ui, rename.name)) {
        const struct rect field = {named.x, named.y + 2, named.w, named.h - 4};
        const struct row name = {.name = "tail.name", .label = rig_title(rig), .hint = "Click to rename"};
        if (inspector_button(in, field, &name)) ui_line_begin(ui, rename.name, name.label);
    } else if (inspector_line(in, named, &rename) &&
               !edit_rig_name(in->core->document, in->rig, ui->text.bytes, &in->core->step.error)) {
        ui_line_again(ui, rename.name);
    }
    if (is_tail) {
        inspector_numbers(in, &tail_rows[ROW_JOINTS], 1, &joints);
        inspector_numbers(in, &tail_rows[ROW_LENGTH], 1, &home);
        for (int k = 0; k < 3; k++) build_coordinate(in, &inspector_shown(in)->tail, k);
    } else {
        const struct chain *chain = &inspector_shown(in)->chain;
        inspector_bone_field(in, &from_list, ui_row(ui, UI_ROW), in->rig, chain->from, in->rig);
        inspector_bone_field(in, &to_list, ui_row(ui, UI_ROW), in->rig, chain->to, in->rig);
        inspector_numbers(in, &tail_rows[ROW_TURN], 1, &home);

        struct rig changed = *inspector_shown(in);
        static const struct row mirror = {NAMED("chain.mirror", "mirror"),
                                          .hint = "Bend to the other side, as a left ear does to a right one",
                                          .undo = "Mirror chain"};
        if (inspector_toggle(in, ui_row(ui, UI_ROW), &mirror, &changed.chain.mirror))
            edit_rig_set(in->core->document, in->rig, &changed, &in->core->step.error);
    }
    inspector_numbers(in, &tail_rows[ROW_OFFSET], 1, &home);
    if (!is_tail && bones_mirrorable(in->core, in->rig) == in->rig) {
        const struct rect row = ui_row(ui, UI_ROW), button = {row.x, row.y + 2, row.w, row.h - 4};
        static const struct row twin = {
            NAMED("chain.twin", "Mirror to other side"),
            .hint = "Add the mirrored chain, bent by the same splines; you can choose others for its channels"};
        if (inspector_button(in, button, &twin)) inspector_mirror(in, 0);
    }

    // The next drag of a body may be recorded.
    if (document_tail(in->core->document, 0)) {
        static const struct row record = {
            NAMED("record", "record"),
            .hint = "Record the next drag of the body as knots (or press R while dragging)"};
        inspector_toggle(in, ui_row(ui, UI_ROW), &record, &in->core->view.on[SWITCH_RECORD]);
    }
    build_overlays(in);
}

const struct channel *inspector_felt_channel(const struct inspector *in)
{
    const struct channel *channel = chosen_channel(in);
    return channel && channel->spline == in->core->focus.active ? channel : NULL;
}

enum { MAX_COORDINATES = 32 }; ///< coordinates in the add list

/// Selects a channel and the spline that drives it.
static void choose_drive(struct inspector *in, int drive)
{
    const struct model_rig *rig = characters_selected(in->core);
    core_choose(in->core, rig->drives[drive].spline);
    in->core->focus.characters.drive = drive; // two channels may share a spline
}

/// The coordinate the active spline drives, if that is the selected one.
static const struct drive *felt_drive(const struct inspector *in)
{
    const struct character_view *view = &in->core->focus.characters;
    const struct model_rig *rig = characters_selected(in->core);
    if (!rig || view->drive >= rig->drive_count) return NULL;
    return rig->drives[view->drive].spline == in->core->focus.active ? &rig->drives[view->drive] : NULL;
}

static const struct number_row drive_rows[] = {
    {NUMBER_AT(struct drive, lag), .undo = "Set lag",
     .ui = {NAMED("drive.lag", "lag"), DEGREES, .hint = "How far it lags behind the spline; 360 is a full swing",
            BAR(-180, 180), .step = 1, .decimals = 1}},
    {NUMBER_AT(struct drive, amplitude), .undo = "Set amplitude",
     .ui = {NAMED("amplitude", "amplitude"), .hint = "How far it swings when the spline is 1", BAR(-2, 2), ANY_NUMBER,
            .fallback = DRIVE_DEFAULT_AMPLITUDE, .step = 0.05, .decimals = 2}},
};

static double get_drive(const struct inspector *in, int which, bool kept, char text[64])
{
    const int owner = characters_rig(in->core), drive = in->core->focus.characters.drive;
    const struct rig *rig = kept ? take_rig(in->core, owner) : in->core->document->rigs[owner];
    (void)text;
    if (!rig || drive >= rig->model.drive_count) return NAN;
    return number_at(&drive_rows[which], &rig->model.drives[drive]);
}

/// Edits the selected coordinate's drive.
static bool set_drive(struct inspector *in, const struct drive *drive, struct error *error)
{
    return edit_drive(in->core->document, characters_rig(in->core), in->core->focus.characters.drive, drive, error);
}

/// The lags of a limb's other drives go with it.
static bool set_drive_number(struct inspector *in, int which, double number, struct error *error)
{
    const int owner = characters_rig(in->core), chosen = in->core->focus.characters.drive;
    const struct drive *before = felt_drive(in);
    const double lag = before->lag;
    struct drive drive = *before;
    number_put(&drive_rows[which], &drive, number);
    const int limb = inspector_limb(in), felt = limb == owner || limb == LIMB_ROWS;
    const int all = drive.lag != lag && felt ? characters_selected(in->core)->drive_count : 0;
    bool done = set_drive(in, &drive, error);
    for (int k = 0; k < all && done; k++) {
        struct drive other = characters_selected(in->core)->drives[k];
        other.lag = core_in_step(other.lag, lag, drive.lag);
        done = k == chosen || !core_is_felt(in->core, limb, other.spline) ||
               edit_drive(in->core->document, owner, k, &other, error);
    }
    return done;
}

bool inspector_felt_drive(struct inspector *in)
{
    static const struct number_home home = {.get = get_drive, .set = set_drive_number};
    if (!felt_drive(in)) return false;
    inspector_numbers(in, drive_rows, sizeof drive_rows / sizeof drive_rows[0], &home);
    return true;
}

static void choose_spline(struct inspector *in, const struct dropdown *list)
{
    struct drive next = characters_selected(in->core)->drives[in->core->focus.characters.drive];
    next.spline = inspector_spline_list(in, list, next.spline);
    if (next.spline >= 0 && set_drive(in, &next, &in->core->step.error))
        choose_drive(in, in->core->focus.characters.drive);
}

static const struct dropdown spline_list = {NAMED("drive.splines", "spline"),
                                            .hint = "The spline that drives this channel", .undo = "Set spline",
                                            .build = choose_spline};

/// Lists the figure's undriven coordinates; returns how many.
static int free_coordinates(const struct inspector *in, const struct model_rig *rig,
                            struct ui_item items[MAX_COORDINATES])
{
    const struct figure *figure = models_figure(in->core->models, in->core->document, characters_rig(in->core));
    int count = 0;
    if (!figure || rig->drive_count == MODEL_MAX_DRIVES) return 0;
    for (int k = 0; k < figure->character.coordinate_count && count < MAX_COORDINATES; k++) {
        const char *name = figure->character.coordinates[k].name;
        int drive = 0;
        while (drive < rig->drive_count && strcmp(rig->drives[drive].name, name) != 0) drive++;
        if (drive < rig->drive_count) continue;
        items[count] = (struct ui_item){name, name, 0, count};
        count++;
    }
    return count;
}

static void add_coordinate(struct inspector *in, const struct dropdown *list)
{
    struct ui_item items[MAX_COORDINATES];
    const int count = free_coordinates(in, characters_selected(in->core), items);
    const int picked = inspector_list(in, list, items, count, -1);
    if (picked < 0) return;
    char *name = need_text(items[picked].name);
    const struct drive drive = {.name = name,
                                .spline = in->core->focus.active >= 0 ? in->core->focus.active : 0,
                                .amplitude = DRIVE_DEFAULT_AMPLITUDE};
    edit_drive(in->core->document, characters_rig(in->core), -1, &drive, &in->core->step.error);
    free(name);
}

static const struct dropdown add_list = {NAMED("drive.add", NULL),
                                         .hint = "Add a channel that the active spline drives", .undo = "Add channel",
                                         .build = add_coordinate};

static const struct number_row floor_rows[] = {
    {NUMBER_AT(struct rig, model.floor), .undo = "Set floor",
     .ui = {NAMED("floor.height", "height"), .unit = "m", .hint = "No point of the character goes lower", BAR(-1, 0),
            ANY_NUMBER, .step = 0.01, .decimals = 3}},
};

static const struct number_row brush_rows[] = {
    {NUMBER_AT(struct brush, radius), .scale = 100,
     .ui = {NAMED("radius", "radius"), BAR(1, 50), .unit = "%",
            .hint = "Radius, relative to the character's height (Ctrl+wheel on the stage)", TYPED(1, 50),
            .fallback = 12, .step = 1}},
    {NUMBER_AT(struct brush, strength), .scale = 100,
     .ui = {NAMED("strength", "strength"), BAR(2, 100), .unit = "%",
            .hint = "How fast paint flows (Shift+wheel on the stage)", TYPED(2, 100), .fallback = 40, .step = 1}},
};

static void build_brush(struct inspector *in)
{
    static const struct ui_choice switches[] = {{"off", "Off"}, {"on", "Brush"}};
    static const struct ui_choice phase[] = {{"advance", "Advance"}, {"delay", "Delay"}, {"smooth", "Smooth"}};
    static const struct ui_choice amplitude[] = {
        {"more", "Swing more"}, {"less", "Swing less"}, {"smooth", "Smooth"}};
    static const struct ui_choice erase[] = {{"all", "Erase"}};
    static const struct row paint = {
        NAMED("paint", "paint"), .hint = "Paint phase and amplitude onto the character (Shift+B)", CHOICES(switches)};
    static const struct {
        enum brush_mode first; // of a kind, side by side
        struct row row;
    } modes[] = {
        {BRUSH_ADVANCE,
         {.name = "phase", .hint = "Move earlier, later, or blend with the surroundings", CHOICES(phase)}},
        {BRUSH_MORE,
         {.name = "swing", .hint = "Swing more, less, or blend with the surroundings", CHOICES(amplitude)}},
        {BRUSH_ERASE, {.name = "erase", .hint = "Remove paint and restore the model", CHOICES(erase)}},
    };
    static const struct row clean = {NAMED("paint.clean", "Remove all paint"),
                                     .hint = "Restore the model everywhere"};
    struct brush *brush = &in->core->focus.brush;
    const struct number_home home = {.own = brush};
    int on = brush->on;
    if (inspector_choice(in, &paint, &on)) characters_set_brush(in->core, on);
    const struct model_rig *rig = characters_selected(in->core);
    for (size_t i = 0; brush->on && i < sizeof modes / sizeof *modes; i++) {
        const int chosen = (int)brush->mode - (int)modes[i].first;
        int index = chosen >= 0 && chosen < modes[i].row.count ? chosen : -1; // none of another kind
        if (inspector_choice(in, &modes[i].row, &index)) brush->mode = (enum brush_mode)((int)modes[i].first + index);
    }
    if (brush->on) inspector_numbers(in, brush_rows, sizeof brush_rows / sizeof brush_rows[0], &home);
    if (!rig || !rig->painted || paint_is_plain(rig->painted)) return;
    if (inspector_button(in, ui_row(&in->ui, UI_ROW), &clean)) characters_clean_paint(in->core);
}

/// What is soft of the selected character: its channels, floor, phases and paint.
static void build_soft(struct inspector *in)
{
    static const struct ui_choice maps[] = {{"off", "Off"}, {"x", "x"}, {"y", "y"}, {"z", "z"}};
    static const struct ui_choice switches[] = {{"off", "Off"}, {"on", "On"}};
    static const struct row phases = {NAMED("phases", "phases"),
                                      .hint = "Colour each point by its phase along x, y or z", CHOICES(maps)};
    struct character_view *view = &in->core->focus.characters;
    inspector_find_rig(in); // a row may have removed one
    const struct model_rig *rig = characters_selected(in->core);
    struct ui_item items[MAX_COORDINATES];
    bool removed = false;
    for (int k = 0; !removed && k < rig->drive_count; k++) {
        const struct drive *drive = &rig->drives[k];
        const char *spline = in->core->document->splines[drive->spline]->name;
        char name[32], remove[32], text[200];
        struct rect r = ui_row(&in->ui, UI_ROW), button = {r.x + r.w - r.h, r.y, r.h, r.h};
        snprintf(name, sizeof name, "drive.%d", k);
        snprintf(remove, sizeof remove, "drive.%d.remove", k);
        snprintf(text, sizeof text, "%.*s, driven by %.*s", name_fit(drive->name, 60), drive->name,
                 name_fit(spline, 60), spline);
        const struct row remover = {ICON(remove, UI_ICON_DELETE), .hint = "Remove this channel",
                                    .undo = "Remove channel"};
        const uint32_t color = spline_list_color(in->core->document, drive->spline);
        r.w -= r.h + 4;
        ui_hint(&in->ui, r, "A channel of this character, and the spline that drives it");
        if (ui_list_row(&in->ui, r, name, text, color, k == view->drive)) choose_drive(in, k);
        removed = inspector_icon(in, button, &remover);
        if (removed) edit_drive(in->core->document, characters_rig(in->core), k, NULL, &in->core->step.error);
    }
    if (free_coordinates(in, rig, items) > 0 && in->core->document->spline_count > 0)
        inspector_dropdown(in, &add_list, ui_row(&in->ui, UI_ROW), 0, "Add a channel", 0);
    ui_space(&in->ui, 4);
    const int owner = characters_rig(in->core);
    if (view->drive < rig->drive_count) {
        inspector_spline_field(in, &spline_list, ui_row(&in->ui, UI_ROW), 0, rig->drives[view->drive].spline);
        const struct coordinate *c = characters_coordinate(in->core); // as the analysis found it
        char text[200];
        if (!c) {
            ui_paragraph(&in->ui, "The model has no such channel.", theme()->text_dim);
        } else if (c->frequency > 0) {
            const int said =
                snprintf(text, sizeof text, "Found at %.2f Hz, damping %.3f. It explains %.0f %% of this motion",
                         c->frequency, c->damping, 100 * c->explained);
            if (c->pca1 > 0)
                snprintf(text + said, sizeof text - (size_t)said,
                         "; without phases (real PCA) one component explains %.0f %%, two %.0f %%", 100 * c->pca1,
                         100 * c->pca2);
            strcat(text, ".");
            ui_paragraph(&in->ui, text, theme()->text_dim);
        }
    }

    inspector_numbers(in, &tail_rows[ROW_OFFSET], 1, &(struct number_home){.rig = &owner});
    rig = characters_selected(in->core); // as edited
    int floor = rig->has_floor;
    const struct row ground = {NAMED("floor", "floor"), .hint = "Keep the whole character above a height",
                               .undo = floor ? "Remove floor" : "Set floor", CHOICES(switches)};
    if (inspector_choice(in, &ground, &floor)) {
        struct rig changed = *in->core->document->rigs[owner];
        changed.model.has_floor = floor;
        if (floor) changed.model.floor = rig->position[1];
        edit_rig_set(in->core->document, owner, &changed, &in->core->step.error);
    } else if (rig->has_floor) {
        inspector_numbers(in, floor_rows, 1, &(struct number_home){.rig = &owner});
        const struct floor_left *left = evaluation_floor(in->core->evaluation, owner);
        char text[120];
        if (left && left->depth >= 1e-4) {
            snprintf(text, sizeof text, "Up to %.3g m below it, deepest at frame %.6g: knots and pins come first.",
                     left->depth,
                     document_frame(in->core->document, left->sample) + in->core->document->rigs[owner]->offset);
            ui_paragraph(&in->ui, text, theme()->text_dim);
        }
    }

    bool *on = in->core->view.on;
    int map = on[SWITCH_PHASE_MAP] ? 1 + view->axis : 0;
    if (inspector_choice(in, &phases, &map)) {
        on[SWITCH_PHASE_MAP] = map > 0;
        if (map > 0) view->axis = map - 1;
    }
    build_overlays(in);
    build_brush(in);
}

enum { MAX_CLIPS = 256 }; ///< in the clip list

/// The shown rig: the selected bone's, else the one chosen here.
static int shown_model(const struct inspector *in)
{
    int model;
    if (bones_selected(in->core, &model) >= 0) return model;
    model = document_find_rig(in->core->document, RIG_MODEL, in->core->focus.characters.character);
    return model < 0 ? document_find_rig(in->core->document, RIG_MODEL, 0) : model;
}

static void choose_clip(struct inspector *in, const struct dropdown *list)
{
    const int model = shown_model(in);
    const struct gltf *gltf = &bones_character(in->core, model)->gltf;
    const char *clip = in->core->document->rigs[model]->model.clip;
    struct ui_item items[MAX_CLIPS + 1] = {{"none", "None", 0, 0}};
    int count = 1;
    for (int c = 0; c < gltf->clip_count && c < MAX_CLIPS; c++)
        items[count++] = (struct ui_item){gltf->clips[c].name, gltf->clips[c].name, 0, c + 1};
    const int picked = inspector_list(in, list, items, count, gltf_find_clip(gltf, clip) + 1);
    if (picked >= 0)
        bones_choose_clip(in->core, model, picked > 0 ? gltf->clips[picked - 1].name : NULL, REPEAT_BY_CLIP);
}

static const struct dropdown clip_list = {NAMED("model.clips", "clip"),
                                          .hint = "The clip of the file that it repeats", .build = choose_clip};

static const struct number_row place[] = {
    {NUMBER_AT(struct rig, model.position[0]), .undo = "Place character",
     .ui = {NAMED("model.x", "x"), METRES, .hint = "Where it stands along x"}},
    {NUMBER_AT(struct rig, model.position[1]), .undo = "Place character",
     .ui = {NAMED("model.y", "y"), METRES, .hint = "Height of the ground under it"}},
    {NUMBER_AT(struct rig, model.position[2]), .undo = "Place character",
     .ui = {NAMED("model.z", "z"), METRES, .hint = "Where it stands along z"}},
    {NUMBER_AT(struct rig, model.scale), .undo = "Place character",
     .ui = {NAMED("model.scale", "scale"), .hint = "Size, relative to the file's", TYPED(1e-9, 1e9), .fallback = 1,
            .step = 0.01, .decimals = 3}},
    {NUMBER_AT(struct rig, model.turn), .undo = "Place character",
     .ui = {NAMED("model.turn", "turn"), DEGREES, .hint = "About the vertical", BAR(-180, 180), .step = 1}},
};

void inspector_character(struct inspector *in)
{
    static const struct row buttons[] = {
        {NAMED("bone.chain", "Make chain"),
         .hint = "Make a chain from this bone to its tip, bent by a new spline (J)"},
        {NAMED("bone.follow", "With follow-through"),
         .hint = "Make a chain that follows through on the clip (Shift+J)"},
    };
    static const struct row repeats = {NAMED("model.loops", "loops"),
                                       .hint = "The clip begins again after its end; else it plays once"};
    struct ui *ui = &in->ui;
    const int model = shown_model(in);
    const struct imported *shown = bones_character(in->core, model);
    const struct model_rig *rig = &in->core->document->rigs[model]->model;
    const int number = document_rig_number(in->core->document, model);
    if (rigs_is_soft(in->core, model) && model == characters_rig(in->core)) {
        build_soft(in);
        rig = &in->core->document->rigs[model]->model; // as edited
        ui_space(ui, 4);
    }

    struct rect r = inspector_labelled(in, "file");
    ui_hint(ui, r, "The glTF file that shows this character");
    ui_label(ui, r, path_name(rig->model), theme()->text);
    if (!shown) ui_paragraph(ui, "wiggly could not read this file.", theme()->warning);
    if (shown && shown->gltf.not_shown) {
        char text[512];
        snprintf(text, sizeof text, "Not shown: %.*s.", name_fit(shown->gltf.not_shown, 400), shown->gltf.not_shown);
        ui_paragraph(ui, text, theme()->text_dim);
    }

    if (shown && shown->gltf.clip_count > 0)
        inspector_dropdown(in, &clip_list, ui_row(ui, UI_ROW), number, rig->clip ? rig->clip : "None", 0);
    const int clip = shown ? gltf_find_clip(&shown->gltf, rig->clip) : -1;
    if (clip >= 0) {
        bool loops = clip_play(rig, &shown->gltf.clips[clip]).loops;
        if (inspector_toggle(in, ui_row(ui, UI_ROW), &repeats, &loops))
            bones_choose_clip(in->core, model, rig->clip, loops ? REPEAT_LOOP : REPEAT_ONCE);
    }
    inspector_numbers(in, place, sizeof place / sizeof place[0], &(struct number_home){.rig = &model});
    if (!shown || shown->skeleton.count == 0) return;

    int owner;
    const int node = bones_selected(in->core, &owner);
    r = inspector_labelled(in, "bone");
    if (node < 0) {
        ui_label(ui, r, "click one on the stage", theme()->text_dim);
    } else {
        ui_label(ui, r, bones_character(in->core, owner)->gltf.nodes[node].name, theme()->text);
        const struct rect row = ui_row(ui, UI_ROW);
        const float widths[2] = {row.w * 0.38f, row.w * 0.62f - 6};
        for (int i = 0; i < 2; i++) {
            const struct rect button = {i > 0 ? row.x + (widths[0] + 6) : row.x, row.y + 2, widths[i], row.h - 4};
            if (inspector_button(in, button, &buttons[i])) bones_make_chain(in->core, i > 0);
        }
    }
    if (in->core->app.in_page) return;
    const struct row flesh = {.name = "model.flesh",
                              .label = in->core->app.figures->makes_flesh ? "Stop making flesh"
                                       : node < 0                         ? "Make flesh"
                                                                          : "Make flesh of the bone",
                              .hint = "Simulate it as a soft body, to swing on its bones"};
    r = ui_row(ui, UI_ROW);
    if (inspector_button(in, (struct rect){r.x, r.y + 2, r.w, r.h - 4}, &flesh)) rigs_make_flesh(in->core);
}
