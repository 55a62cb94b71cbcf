/// The sections on the active spline's parameters, and on the spline or joint a parameter follows.
#include "base/names.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/parts.h"
#include "scene/order.h"
#include "scene/warnings.h"
#include <math.h>
#include <stdio.h>

static double get(const struct inspector *in, int parameter)
{
    return core_active_spline(in->core)->parameter[parameter].value;
}

static double was(const struct inspector *in, int parameter)
{
    const struct spline *kept = inspector_kept_spline(in);
    const bool has = kept && spline_uses(kept, (enum parameter)parameter, false);
    return has && !param_follows(&kept->parameter[parameter]) ? kept->parameter[parameter].value : NAN;
}

static bool set(struct inspector *in, int parameter, double number, struct error *error)
{
    return core_set_felt(in->core, inspector_limb(in), (enum parameter)parameter, number, false, error);
}

/// In its own undo step.
static void set_parameter(struct inspector *in, enum parameter parameter, double number)
{
    if (core_begin(in->core, parameter_rows[parameter].undo, 0))
        core_end(in->core, set(in, (int)parameter, number, &in->core->error));
}

static void build_slider(struct inspector *in, enum parameter parameter, struct rect r)
{
    const struct spline *spline = core_active_spline(in->core);
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct number_row number = {.name = row->name,
                                      .label = row->name,
                                      .unit = row->unit,
                                      .hint = row->hint,
                                      .undo = row->undo,
                                      .maximum = core_slider_end(in->core->document, spline, parameter),
                                      .lowest = row->minimum,
                                      .highest = parameter_maximum(parameter, spline_mode(spline)),
                                      .fallback = row->fresh,
                                      .step = row->step,
                                      .decimals = row->decimals};
    static const struct number_home home = {.get = get, .set = set, .was = was};
    inspector_number(in, &number, &home, (int)parameter, r);
}

enum { MAX_BONES = 1024 }; ///< in a list

static const struct param *followed(const struct inspector *in)
{
    return &core_active_spline(in->core)->parameter[PARAMETER_EQUILIBRIUM];
}

int inspector_bone_list(struct inspector *in, const struct dropdown *list, int model, int top, const char *chosen)
{
    const struct imported *character = bones_character(in->core, model);
    int nodes[MAX_BONES], row = -1;
    struct ui_item items[MAX_BONES];
    const int count = bones_below(character, top, nodes, MAX_BONES), node = gltf_find_node(&character->gltf, chosen);
    for (int b = 0; b < count; b++) {
        const char *name = character->gltf.nodes[nodes[b]].name;
        if (nodes[b] == node) row = b;
        items[b] = (struct ui_item){name, name, 0};
    }
    const int picked = ui_popup_list(&in->ui, list->name, items, count, row);
    return picked < 0 ? -1 : nodes[picked];
}

static void choose_joint(struct inspector *in, const struct dropdown *list)
{
    const struct joint_motion *motion = followed(in)->motion;
    const int model = document_find_model(in->core->document, motion->model, motion->by_file);
    if (model < 0 || !bones_character(in->core, model)) return;
    const int node = inspector_bone_list(in, list, model, -1, motion->joint);
    if (node >= 0) bones_follow(in->core, in->core->active, model, node);
}

static const struct dropdown joint_list = {"joint", "The joint it follows through the clip", choose_joint};

static void set_track(struct inspector *in, enum parameter parameter, struct param param)
{
    const char *label = param_follows(&param) ? "Follow spline" : "Stop following";
    if (!core_begin(in->core, label, 0)) return;
    core_end(in->core, edit_parameter(in->core->document, in->core->active, parameter, &param, &in->core->error));
}

/// Marks splines the active one cannot follow without a cycle; true if any is left.
static bool find_leaders(const struct inspector *in, bool left_out[INSPECTOR_MAX_SPLINES])
{
    int count = in->core->document->spline_count < INSPECTOR_MAX_SPLINES ? in->core->document->spline_count
                                                                         : INSPECTOR_MAX_SPLINES;
    bool any = false;
    scene_followers(in->core->document, in->core->active, left_out, count);
    for (int s = 0; s < count; s++) any |= !left_out[s];
    return any;
}

enum { MAX_MODELS = 16, MODEL_TEXT = 112 }; ///< models offered

/// Adds rows for the characters whose joints the equilibrium can follow; returns how many.
static int add_models(const struct inspector *in, struct ui_item *items, char texts[][MODEL_TEXT], int *models)
{
    int count = 0;
    for (int r = -1; count < MAX_MODELS && (r = document_next_rig(in->core->document, RIG_MODEL, r)) >= 0;) {
        if (!bones_character(in->core, r)) continue;
        snprintf(texts[count], MODEL_TEXT, "A joint of %.*s", name_fit(rig_title(in->core->document->rigs[r]), 80),
                 rig_title(in->core->document->rigs[r]));
        items[count] = (struct ui_item){texts[count], texts[count], 0};
        models[count++] = r;
    }
    return count;
}

static void choose_track(struct inspector *in, const struct dropdown *list)
{
    struct ui *ui = &in->ui;
    const struct spline *spline = core_active_spline(in->core);
    enum parameter parameter = (enum parameter)ui->popup.which;
    bool left_out[INSPECTOR_MAX_SPLINES];
    struct ui_item items[INSPECTOR_MAX_SPLINES + MAX_MODELS];
    char texts[MAX_MODELS][MODEL_TEXT];
    int splines[INSPECTOR_MAX_SPLINES], models[MAX_MODELS], row;
    find_leaders(in, left_out);
    const int count = inspector_spline_items(in, left_out, spline->parameter[parameter].track, items, splines, &row);
    const int more = parameter == PARAMETER_EQUILIBRIUM ? add_models(in, items + count, texts, models) : 0;
    const int picked = ui_popup_list(ui, list->name, items, count + more, row);
    if (picked >= count) {
        bones_follow(in->core, in->core->active, models[picked - count], -1);
    } else if (picked >= 0) {
        set_track(in, parameter, param_track(splines[picked]));
    }
}

static const struct dropdown track_list = {"follow", "The spline it follows, sample by sample", choose_track};

/// The field for the followed joint, in place of the spline's.
static void build_joint_field(struct inspector *in, const struct joint_motion *motion, struct rect field)
{
    struct rect icon = {field.x + field.w - INSPECTOR_ICON, field.y, INSPECTOR_ICON, field.h};
    const int active = in->core->active;
    const int model = document_find_model(in->core->document, motion->model, motion->by_file);
    char title[BONES_TITLE];
    const char *text = model < 0 ? motion->joint : bones_title(in->core->document, model, motion->joint, title);
    field.w -= INSPECTOR_ICON + 4;
    inspector_dropdown(in, &joint_list, field, 0, text, 0);
    const bool picking = in->core->pick.use == BONE_FOLLOWED && in->core->pick.which == active;
    if (ui_icon_button(&in->ui, icon, "joint.pick", UI_ICON_PICK, picking, "Pick it on the stage"))
        bones_pick(in->core, picking ? BONE_SELECTED : BONE_FOLLOWED, active);
}

static void build_track(struct inspector *in, enum parameter parameter, struct rect r)
{
    const struct param *param = &core_active_spline(in->core)->parameter[parameter];
    const struct rect field = inspector_label(in, r, parameter_rows[parameter].name);
    if (param->motion) {
        build_joint_field(in, param->motion, field);
    } else {
        inspector_spline_field(in, &track_list, field, (int)parameter, param->track);
    }
}

static void open_list(struct inspector *in, enum parameter parameter, bool joints, struct rect r)
{
    bool left_out[INSPECTOR_MAX_SPLINES];
    if (find_leaders(in, left_out) || joints) {
        ui_popup_open(&in->ui, track_list.name, (int)parameter, r);
        return;
    }
    core_message(in->core, true, "There is no other spline for %.*s to follow.",
                 name_fit(core_active_spline(in->core)->name, 80), core_active_spline(in->core)->name);
}

/// The button at the right of a row: follows a spline from a list, or stops following.
static void build_track_button(struct inspector *in, enum parameter parameter, struct rect r, struct rect row)
{
    const int active = in->core->active;
    const bool follows = param_follows(&in->core->document->splines[active]->parameter[parameter]);
    const bool joints =
        parameter == PARAMETER_EQUILIBRIUM && document_find_rig(in->core->document, RIG_MODEL, 0) >= 0;
    const char *hint = follows  ? "Stop following; keep the value at the playhead"
                       : joints ? "Follow another spline, or a joint of the character"
                                : "Follow another spline";
    char name[64];
    snprintf(name, sizeof name, "follow.%s", parameter_rows[parameter].name);
    const bool pressed = ui_icon_button(&in->ui, r, name, follows ? UI_ICON_UNFOLLOW : UI_ICON_FOLLOW, false, hint);
    if (pressed && follows) set_track(in, parameter, param_number(spline_list_present(in->core, active, parameter)));
    if (pressed && !follows)
        open_list(in, parameter, joints,
                  (struct rect){row.x + UI_LABEL + UI_GAP, row.y, row.w - UI_LABEL - UI_GAP, row.h});
    inspector_offer(in, &track_list);
}

static bool follow_joint(struct inspector *in, const struct param *param, struct error *error)
{
    return edit_parameter(in->core->document, in->core->active, PARAMETER_EQUILIBRIUM, param, error);
}

static void build_of(struct inspector *in)
{
    static const struct ui_choice choices[] = {
        [MOTION_TURN] = {"turn", "Turn"}, [MOTION_ACROSS] = {"across", "Across"}, [MOTION_UP] = {"up", "Up"}};
    struct joint_motion motion = *followed(in)->motion;
    int of = (int)motion.of;
    if (!inspector_choice(in, "joint's", "Its turn in degrees, or its movement across or up in metres", "joint.of",
                          choices, MOTION_KINDS, &of))
        return;
    struct param param = *followed(in);
    motion.of = (enum motion_of)of;
    param.motion = &motion;
    if (core_begin(in->core, "Set joint's motion", 0)) core_end(in->core, follow_joint(in, &param, &in->core->error));
}

static const void *followed_gain(const struct inspector *in) { return followed(in)->motion; }

static bool set_gain(struct inspector *in, int which, double gain, struct error *error)
{
    struct joint_motion motion = *followed(in)->motion;
    const struct param param = {.track = -1, .motion = &motion};
    (void)which;
    motion.gain = gain;
    return follow_joint(in, &param, error);
}

static const struct number_row gain_rows[] = {
    {"joint.gain", "strength", NULL, "How much of the joint's motion it follows", "Set joint's gain",
     NUMBER_AT(struct joint_motion, gain), 0, 0, -1e6, 1e6, 1, 0.01, 2},
};

static void build_joint(struct inspector *in)
{
    if (followed(in)->motion) build_of(in);
    static const struct number_home home = {.of = followed_gain, .set = set_gain};
    if (followed(in)->motion) inspector_numbers(in, gain_rows, 1, &home);
}

static void build_number(struct inspector *in, enum parameter parameter)
{
    const struct spline *spline = core_active_spline(in->core);
    struct rect r = ui_row(&in->ui, UI_ROW);
    const bool follows = param_follows(&spline->parameter[parameter]);
    const bool may_follow = parameter_rows[parameter].kind == PARAMETER_TRACK && (in->core->more || follows);
    if (may_follow) r.w -= UI_ROW + 2;
    if (!follows) {
        build_slider(in, parameter, r);
    } else {
        build_track(in, parameter, r);
    }
    struct rect button = {r.x + r.w + 2, r.y, UI_ROW, UI_ROW};
    if (may_follow) build_track_button(in, parameter, button, r);
    if (spline->parameter[parameter].motion) build_joint(in);
}

static void build_choice(struct inspector *in, enum parameter parameter)
{
    const struct spline *spline = core_active_spline(in->core);
    const struct parameter_row *row = &parameter_rows[parameter];
    struct ui_choice choices[PARAMETER_MAX_WORDS];
    int chosen = (int)spline->parameter[parameter].value, count = 0;
    for (; row->words[count]; count++) choices[count] = (struct ui_choice){row->words[count], row->labels[count]};
    struct rect r = parameter == PARAMETER_MODE ? ui_row(&in->ui, UI_ROW) : inspector_labelled(in, row->name);
    ui_hint(&in->ui, r, row->hint);
    if (ui_segments(&in->ui, r, row->name, choices, count, &chosen)) set_parameter(in, parameter, chosen);
}

void inspector_parameter(struct inspector *in, enum parameter parameter)
{
    if (!spline_uses(core_active_spline(in->core), parameter, false)) return;
    if (parameter_rows[parameter].kind == PARAMETER_CHOICE) {
        build_choice(in, parameter);
    } else {
        build_number(in, parameter);
    }
}

void inspector_spline(struct inspector *in)
{
    static const enum parameter shown[] = {PARAMETER_MODE, PARAMETER_EQUILIBRIUM, PARAMETER_START};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) inspector_parameter(in, shown[i]);
    static const struct ui_choice choices[] = {{"off", "Off"}, {"on", "On"}};
    const struct spline *spline = core_active_spline(in->core);
    int settles = spline_settles(spline);
    const char *label = "pose to pose", *hint = "Let the motion settle at every knot: it overshoots each, and stays";
    if (spline_mode(spline) == WIGGLY_CUBIC) {
        inspector_idle(in, label, "–");
    } else if (inspector_choice(in, label, hint, "settles.all", choices, 2, &settles)) {
        core_toggle_pose_to_pose(in->core, 0);
    }
}

void inspector_advanced(struct inspector *in)
{
    static const enum parameter shown[] = {PARAMETER_BANDWIDTH, PARAMETER_CALM, PARAMETER_PASSIVE};
    const bool calm = spline_uses_calm(in->core->document, in->core->active);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        if (shown[i] != PARAMETER_CALM || calm) inspector_parameter(in, shown[i]);
    }
}

/// A limit's number and switch; off, only the name.
static void build_limit(struct inspector *in, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct rect r = ui_row(&in->ui, UI_ROW);
    const struct rect name = {r.x, r.y, r.w - 34, r.h}, at = {r.x + r.w - 28, r.y, 28, r.h};
    bool on = isfinite(spline->parameter[parameter].value);
    if (on) {
        build_slider(in, parameter, name);
    } else {
        ui_label(&in->ui, name, row->name, theme()->text_dim);
    }
    ui_hint(&in->ui, r, row->hint);
    if (ui_toggle(&in->ui, at, parameter == PARAMETER_HIGH ? "limit.high" : "limit.low", &on))
        set_parameter(in, parameter, on ? core_fresh_limit(spline, parameter) : row->standard);
}

void inspector_limits(struct inspector *in)
{
    const struct spline *spline = core_active_spline(in->core);
    build_limit(in, spline, PARAMETER_HIGH);
    build_limit(in, spline, PARAMETER_LOW);
}

/// First amount of a roll.
static const double FRESH_VARIATION = 0.3;

/// Another seed, and an amount if there was none, in one step.
static void roll(struct inspector *in, const struct spline *spline)
{
    const int most = (int)parameter_rows[PARAMETER_SEED].maximum + 1;
    const long long seed = (long long)spline->parameter[PARAMETER_SEED].value;
    const bool is_new = spline->parameter[PARAMETER_VARIATION].value == 0;
    const int active = in->core->active;
    if (!core_begin(in->core, "Roll variation", 0)) return;
    core_set_parameter(in->core, active, PARAMETER_SEED, (double)((seed * 7 + 1) % 1000 % most));
    if (is_new) core_set_parameter(in->core, active, PARAMETER_VARIATION, FRESH_VARIATION);
    core_end(in->core, true);
    core_edited(in->core, in->core->active);
}

void inspector_roll(struct inspector *in, int unused)
{
    (void)unused;
    roll(in, core_active_spline(in->core));
}

/// Why a variation is not visible, or NULL.
static const char *stillness(const struct spline *spline)
{
    const struct param *p = spline->parameter;
    if (p[PARAMETER_PASSIVE].value != WIGGLY_OSCILLATOR) return "The paper's filter has no variations.";
    for (enum parameter n = PARAMETER_FREQUENCY; n <= PARAMETER_BANDWIDTH; n++) {
        if (p[n].track >= 0 && spline_uses(spline, n, false))
            return "There are no variations while frequency or damping follows a spline.";
    }
    return p[PARAMETER_FREQUENCY].value > 0 ? NULL : "A spline that does not swing has no variations.";
}

void inspector_variation(struct inspector *in)
{
    const struct spline *spline = core_active_spline(in->core);
    const char *reason = stillness(spline);
    build_slider(in, PARAMETER_VARIATION, ui_row(&in->ui, UI_ROW));
    struct rect r = ui_row(&in->ui, UI_ROW), button = {r.x + r.w - 64, r.y + 2, 64, r.h - 4};
    r.w -= 70;
    build_slider(in, PARAMETER_SEED, r);
    ui_hint(&in->ui, button, "Another motion through the same knots");
    if (ui_button(&in->ui, button, "variation.roll", "Roll", false)) roll(in, spline);
    if (reason) ui_paragraph(&in->ui, reason, theme()->text_dim);
}
