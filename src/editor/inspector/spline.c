/// The sections on the active spline: its feel, its parameters and what they follow.
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/state.h"
#include "scene/text.h"
#include "scene/warnings.h"
#include <math.h>
#include <stdio.h>

static const struct preset {
    const char *name, *label, *hint;
    double frequency, damping;
    double wind_up; ///< periods
    double lag;     ///< degrees between the first and last joint
} presets[] = {
    {NAMED("preset.cat", "Cat"), .hint = "A cat's tail: slow, soon at rest, the tip far behind", .frequency = 0.8,
     .damping = 0.22, .wind_up = 0.5, .lag = 170},
    {NAMED("preset.whip", "Whip"), .hint = "A whip: quick, a wave that runs to the tip", .frequency = 1.8,
     .damping = 0.12, .wind_up = 0.35, .lag = 260},
    {NAMED("preset.heavy", "Heavy"), .hint = "Something heavy: slow, long in coming, soon at rest", .frequency = 0.5,
     .damping = 0.35, .wind_up = 0.7, .lag = 90},
    {NAMED("preset.jelly", "Jelly"), .hint = "Jelly: quick, wobbles for long", .frequency = 3, .damping = 0.06,
     .wind_up = 0.5, .lag = 60},
    {NAMED("preset.antenna", "Antenna"), .hint = "An antenna: very quick, stiff, rings for long", .frequency = 5,
     .damping = 0.03, .wind_up = 0.5, .lag = 20},
};

static const char preset_undo[] = "Choose a feel";

enum { PRESETS = sizeof presets / sizeof presets[0], PRESET_GAP = 4, PRESET_MARGINS = 8, TEXT = 32 /* two lines */ };

int inspector_limb(const struct inspector *in) { return in->alone ? -1 : core_limb(in->core); }

const char *inspector_feel_title(struct inspector *in)
{
    const struct document *document = in->core->document;
    const bool alone = in->ui.held || in->ui.typing ? in->alone : in->core->input.mods & MOD_ALT;
    const int limb = alone ? -1 : core_limb(in->core), size = sizeof in->feel_title;
    const char *name = limb >= 0 ? rig_title(document->rigs[limb]) : core_active_spline(in->core)->name;
    int splines = 0;
    for (int s = 0; s < document->spline_count; s++) splines += core_is_felt(in->core, limb, s);
    const int length = snprintf(in->feel_title, (size_t)size, "Feel · %.*s", name_fit(name, 64), name);
    if (splines > 1) snprintf(in->feel_title + length, (size_t)(size - length), " (%d splines)", splines);
    return in->feel_title;
}

static void apply_preset(struct inspector *in, const struct preset *preset)
{
    struct core *core = in->core;
    struct document *document = core->document;
    struct error *error = &core->step.error;
    const int limb = inspector_limb(in);
    bool good = true;
    for (int s = 0; s < document->spline_count && good; s++) {
        const bool is_chosen = s == core->focus.active || (limb == LIMB_ROWS && core_is_felt(core, limb, s));
        if (is_chosen && spline_mode(document->splines[s]) == WIGGLY_CUBIC)
            good = core_set_parameter(core, s, PARAMETER_MODE, WIGGLY_COMPLEX);
    }
    good = good && core_set_felt(core, limb, PARAMETER_FREQUENCY, preset->frequency, false, error) &&
           core_set_felt(core, limb, PARAMETER_DAMPING, preset->damping, true, error) &&
           core_set_felt(core, limb, PARAMETER_WIND_UP, preset->wind_up, true, error);

    // The same lag for each joint in the channel that the spline bends, and in those of the limb, or of the rows.
    const bool bends = inspector_felt_channel(in);
    for (int r = 0; r < document->rig_count && good; r++) {
        int count;
        const struct channel *channels = rig_channels(document->rigs[r], &count);
        const int joints = count > 0 ? bones_joints(core, r) : 0;
        const struct angles angles = {.value = {joints > 1 ? core_round(preset->lag / (joints - 1), 0.1) : 0}};
        for (int c = 0; c < count && good; c++, channels = rig_channels(document->rigs[r], &count)) {
            const bool shown = bends && r == in->rig, all = limb == LIMB_ROWS || (shown && limb == r);
            const bool felt = all && core_is_felt(core, limb, channels[c].spline);
            if ((shown && c == in->channel) || (felt && rig_point_input(document->rigs[r], c) >= 0))
                good = edit_angles(document, (struct channel_place){r, c}, ANGLE_LAG, &angles, error);
        }
    }
    core_edited(in->core, in->core->focus.active);
}

void inspector_preset(struct inspector *in, int preset)
{
    in->alone = false;
    if (core_step(in->core, preset_undo, 0)) apply_preset(in, &presets[preset]);
}

static float presets_width(int first, int end)
{
    float width = (float)(end - first - 1) * PRESET_GAP;
    for (int i = first; i < end; i++) width += ui_text_width(presets[i].label);
    return width;
}

/// Buttons side by side, sized by their words.
static void build_preset_row(struct inspector *in, struct rect row, int first, int end)
{
    const float spare = (row.w - presets_width(first, end)) / (float)(end - first);
    float x = row.x;
    for (int i = first; i < end; i++) {
        const float right = x + ui_text_width(presets[i].label) + spare;
        const struct rect r = {roundf(x), row.y + 1, roundf(right) - roundf(x), row.h - 2};
        const struct row button = {NAMED(presets[i].name, presets[i].label), .hint = presets[i].hint,
                                   .undo = preset_undo};
        if (inspector_button(in, r, &button)) apply_preset(in, &presets[i]);
        x = right + PRESET_GAP;
    }
}

/// The active spline as it was before, or NULL.
static const struct spline *kept_spline(const struct inspector *in)
{
    const int kept = take_spline(in->core, in->core->focus.active);
    return kept >= 0 ? in->core->take.document->splines[kept] : NULL;
}

/// Frames of a period at the spline's own frequency.
static double period_of(const struct inspector *in, const struct spline *spline)
{
    return in->core->document->fps / spline->parameter[PARAMETER_FREQUENCY].value;
}

/// The longest wind-up in frames, which stands for the whole curve.
static double longest_wind_up(const struct inspector *in)
{
    return parameter_rows[PARAMETER_WIND_UP].usual * period_of(in, core_active_spline(in->core));
}

enum { SETTLE = PARAMETER_COUNT }; ///< beside the parameters: the settling time, which sets the damping

static double get_felt(const struct inspector *in, int which, bool kept, char text[64])
{
    const struct spline *spline = kept ? kept_spline(in) : core_active_spline(in->core);
    if (!spline) return NAN;
    if (which == SETTLE) {
        const struct settling alone = settle_alone(spline, document_step(in->core->document));
        const bool never = alone.kind == SETTLE_NEVER || alone.kind == SETTLE_LATE;
        if (never) snprintf(text, 64, "never");
        return never ? SETTLE_LIMIT : alone.kind == SETTLE_ALONE ? alone.seconds : NAN;
    }
    const struct param *param = &spline->parameter[which];
    if (!spline_uses(spline, (enum parameter)which, false) || param_follows(param)) return NAN;
    if (which != PARAMETER_WIND_UP) return param->value;
    if (param->value > 0) return param->value * period_of(in, spline);
    snprintf(text, 64, "whole curve");
    return longest_wind_up(in);
}

/// Settling time of a spline with another damping; INFINITY: never, or too late.
static double settles(const struct spline *spline, double damping, double step)
{
    struct spline other = *spline;
    other.parameter[PARAMETER_DAMPING].value = damping;
    const struct settling settling = settle_alone(&other, step);
    return settling.kind == SETTLE_ALONE ? settling.seconds : INFINITY;
}

static bool set_felt(struct inspector *in, int which, double number, struct error *error)
{
    const struct spline *spline = core_active_spline(in->core);
    const double step = document_step(in->core->document);
    enum parameter parameter = (enum parameter)which;
    if (which == SETTLE) { // at most critical damping; time falls as damping rises, so bisection works
        double low = 0, high = 1;
        for (int i = 0; i < 40; i++) {
            const double middle = (low + high) / 2;
            const bool late = settles(spline, middle, step) > number;
            low = late ? middle : low;
            high = late ? high : middle;
        }
        parameter = PARAMETER_DAMPING;
        number = round(high * 1e4) / 1e4;
    } else if (which == PARAMETER_WIND_UP) {
        const bool whole = number >= longest_wind_up(in);
        number = whole ? 0 : round(number / period_of(in, spline) * 1e4) / 1e4;
    }
    return core_set_felt(in->core, inspector_limb(in), parameter, number, false, error);
}

/// A parameter of the active spline, or its settling time, as a number.
static void build_number(struct inspector *in, int which, struct rect r)
{
    static const struct number_home home = {.get = get_felt, .set = set_felt};
    static const struct number_row settle = {
        .undo = "Set settle time",
        .ui = {NAMED("settle", "settles in"), .unit = "s",
               .hint = "Time until 5 % of a swing is left; changes the damping, not the frequency",
               .highest = SETTLE_LIMIT, .fallback = NAN, .step = 0.05, .decimals = 2}};
    const struct spline *spline = core_active_spline(in->core);
    const struct parameter_row *row = &parameter_rows[which == SETTLE ? PARAMETER_DAMPING : which];
    struct number_row number = {.undo = row->undo,
                                .ui = {NAMED(row->name, row->name), .unit = row->unit, .hint = row->hint,
                                       .fallback = row->fresh, .step = row->step, .decimals = row->step < 1 ? 2 : 0}};
    if (which == SETTLE) {
        number = settle;
        number.ui.lowest = ceil(settles(spline, 1, document_step(in->core->document)) * 100) / 100;
    } else if (which == PARAMETER_WIND_UP) {
        number.ui.maximum = longest_wind_up(in);
        number.ui.lowest = 1;
        number.ui.highest = INFINITY;
        number.ui.fallback *= period_of(in, spline);
    } else {
        number.ui.maximum = core_slider_end(in->core->document, spline, (enum parameter)which);
        number.ui.lowest = row->minimum;
        number.ui.highest = parameter_maximum((enum parameter)which, spline_mode(spline));
    }
    inspector_number(in, &number, &home, which, r);
}

/// The settling in one sentence.
static void build_sentence(struct inspector *in)
{
    const bool kept = take_is_shown(in->core) && kept_spline(in);
    const struct spline *spline = kept ? kept_spline(in) : core_active_spline(in->core);
    const struct document *document = kept ? in->core->take.document : in->core->document;
    const struct evaluation *evaluation = kept ? &in->core->take.evaluation : in->core->evaluation;
    const int active = kept ? take_spline(in->core, in->core->focus.active) : in->core->focus.active;
    char text[128];
    struct settling settling = settle_alone(spline, document_step(document));
    if (evaluation && active < evaluation->count && spline->knot_count > 0) {
        const int last = document_sample(document, spline->knots[spline->knot_count - 1].frame);
        settling = settle_measure(spline, &evaluation->curves[active], last);
    }
    const double frames = settling.seconds * document->fps;
    const enum settle_kind kind = settling.kind;
    const char *fixed = spline_mode(spline) == WIGGLY_CUBIC ? "A cubic: smooth through the knots, with no swing."
                                                            : "Frequency 0 makes it a plain cubic.";
    if (kind == SETTLE_UNKNOWN) return;
    if (kind == SETTLE_NEVER) fixed = "Rings forever.";
    if (kind == SETTLE_LATE) snprintf(text, sizeof text, "Takes more than %d s to settle to 5 %%.", SETTLE_LIMIT);
    if (kind == SETTLE_ALONE) snprintf(text, sizeof text, "Settles to 5 %% in %.0f frames.", frames);
    if (kind == SETTLE_SEEN)
        snprintf(text, sizeof text, "Settles to 5 %% %.0f frames after the last knot.", ceil(frames - 1e-6));
    if (kind == SETTLE_LEFT)
        snprintf(text, sizeof text, "Still swinging when the scene ends (%.0f %%).", 100 * settling.left);
    ui_paragraph(&in->ui, kind == SETTLE_CUBIC || kind == SETTLE_NEVER ? fixed : text, theme()->text_dim);
}

/// A row that ends where those do that have a button.
static struct rect shorter(struct inspector *in)
{
    struct rect r = ui_row(&in->ui, UI_ROW);
    r.w -= UI_ROW + 2;
    return r;
}

/// Rows keep their places for every kind of spline.
void inspector_feel(struct inspector *in)
{
    static const char *const labels[] = {[ANGLE_LAG] = "lag", [ANGLE_GAIN] = "gain"};
    struct ui *ui = &in->ui;
    const struct rect row = ui_row(ui, UI_ROW);
    const bool fit = presets_width(0, PRESETS) + PRESETS * PRESET_MARGINS <= row.w; // else two rows: no word is cut
    const int in_first = fit ? PRESETS : (PRESETS + 1) / 2;
    build_preset_row(in, row, 0, in_first);
    if (!fit) build_preset_row(in, ui_row(ui, UI_ROW), in_first, PRESETS);

    for (enum parameter pace = PARAMETER_FREQUENCY; pace <= PARAMETER_DAMPING; pace++) {
        if (spline_uses(core_active_spline(in->core), pace, false)) {
            inspector_parameter(in, pace);
        } else {
            inspector_idle(in, parameter_rows[pace].name, "–");
        }
    }
    char text[EVALUATION_SENTENCE];
    const struct spline *swings = core_active_spline(in->core);
    const struct param *frequency = &swings->parameter[PARAMETER_FREQUENCY];
    if (!spline_uses(swings, PARAMETER_WIND_UP, false) || param_follows(frequency) || frequency->value == 0) {
        inspector_idle(in, parameter_rows[PARAMETER_WIND_UP].name, "–");
    } else {
        build_number(in, PARAMETER_WIND_UP, in->core->view.on[SWITCH_MORE] ? shorter(in) : ui_row(ui, UI_ROW));
    }

    // Lag and gain of the channel or coordinate it drives; below each is room for the highest curve of any spline.
    const bool bends = inspector_felt_channel(in) != NULL, drives = !bends && inspector_felt_drive(in);
    for (int kind = ANGLE_LAG; kind <= ANGLE_GAIN; kind++) {
        const float top = ui->y;
        if (bends) inspector_angles(in, (enum angle_kind)kind);
        if (!bends && !drives) inspector_idle(in, labels[kind], "–");
        ui->y = top + (drives ? 0 : UI_ROW) + inspector_highest_curve(in, (enum angle_kind)kind);
    }
    const float top = ui->y;
    const struct spline *spline = core_active_spline(in->core);
    const struct evaluation *evaluation = in->core->evaluation;
    if (evaluation && in->core->focus.active < evaluation->count &&
        evaluation_sentence(evaluation, in->core->focus.active, text))
        ui_paragraph(ui, text, theme()->warning);
    const struct param *p = spline->parameter;
    const double beta = spline_mode(spline) == WIGGLY_COMPLEX ? p[PARAMETER_BANDWIDTH].value : 0;
    const double highest = p[PARAMETER_FREQUENCY].value * (1 + beta);
    const double limit = in->core->document->fps * in->core->document->substeps / 2;
    const bool poles = spline_mode(spline) != WIGGLY_CUBIC && p[PARAMETER_FREQUENCY].track < 0;
    if (poles && highest > limit) {
        snprintf(text, sizeof text, "Faster than half the sample rate (%g Hz): the swing aliases.", limit);
        ui_paragraph(ui, text, theme()->warning);
    }
    if (ui->y == top) build_sentence(in);
    ui->y = fmaxf(ui->y, top + TEXT);
    if (!in->core->view.on[SWITCH_MORE]) return;
    const struct rect line = ui_row(ui, UI_ROW), r = {line.x, line.y + 1, line.w, line.h - 2};
    static const struct row find = {
        NAMED("frequency.find", "Find the frequency"),
        .hint = "Frequency and damping that explain the knots best (Shift+F); again: the runner-up"};
    if (inspector_button(in, r, &find)) core_find_frequency(in->core);
}

enum { MAX_BONES = 1024 }; ///< in a list

static const struct param *followed(const struct inspector *in)
{
    return &core_active_spline(in->core)->parameter[PARAMETER_EQUILIBRIUM];
}

void inspector_bone_field(struct inspector *in, const struct dropdown *list, struct rect r, int which,
                          const char *text, int of)
{
    struct bone_pick *pick = &in->core->focus.pick;
    const struct row button = {ICON(list->pick, UI_ICON_PICK), .hint = "Pick it on the stage",
                               .lit = pick->use == list->use && pick->which == of};
    const struct rect icon = {r.x + r.w - INSPECTOR_ICON, r.y, INSPECTOR_ICON, r.h};
    r.w -= INSPECTOR_ICON + 4;
    inspector_dropdown(in, list, r, which, text, 0);
    if (inspector_icon(in, icon, &button)) *pick = (struct bone_pick){button.lit ? BONE_SELECTED : list->use, of};
}

int inspector_bone_list(struct inspector *in, const struct dropdown *list, int model, int top, const char *chosen)
{
    const struct imported *character = bones_character(in->core, model);
    int nodes[MAX_BONES];
    struct ui_item items[MAX_BONES];
    const int count = bones_below(character, top, nodes, MAX_BONES);
    for (int b = 0; b < count; b++) {
        const char *name = character->gltf.nodes[nodes[b]].name;
        items[b] = (struct ui_item){name, name, 0, nodes[b]};
    }
    return inspector_list(in, list, items, count, gltf_find_node(&character->gltf, chosen));
}

static void choose_joint(struct inspector *in, const struct dropdown *list)
{
    const struct joint_motion *motion = followed(in)->motion;
    const int model = document_find_model(in->core->document, motion->model);
    if (model < 0 || !bones_character(in->core, model)) return;
    const int node = inspector_bone_list(in, list, model, -1, motion->joint);
    if (node >= 0) bones_follow(in->core, in->core->focus.active, model, node);
}

static const struct dropdown joint_list = {NAMED("joint", NULL), .hint = "The joint it follows through the clip",
                                           .pick = "joint.pick", .use = BONE_FOLLOWED, .build = choose_joint};

/// Marks splines the active one cannot follow without a cycle; true if any is left.
static bool find_leaders(const struct inspector *in, bool left_out[INSPECTOR_MAX_SPLINES])
{
    const int all = in->core->document->spline_count;
    const int count = all < INSPECTOR_MAX_SPLINES ? all : INSPECTOR_MAX_SPLINES;
    bool any = false;
    scene_followers(in->core->document, in->core->focus.active, left_out, count);
    for (int s = 0; s < count; s++) any |= !left_out[s];
    return any;
}

enum { MAX_MODELS = 16, MODEL_TEXT = 112 }; ///< models offered

static void choose_track(struct inspector *in, const struct dropdown *list)
{
    struct ui *ui = &in->ui;
    const struct document *document = in->core->document;
    const struct spline *spline = core_active_spline(in->core);
    enum parameter parameter = (enum parameter)ui->popup.which;
    bool left_out[INSPECTOR_MAX_SPLINES];
    struct ui_item items[INSPECTOR_MAX_SPLINES + MAX_MODELS];
    char texts[MAX_MODELS][MODEL_TEXT];
    find_leaders(in, left_out);
    const int count = inspector_spline_items(in, left_out, items);
    int more = 0; // characters whose joints the equilibrium can follow
    for (int r = -1; parameter == PARAMETER_EQUILIBRIUM && more < MAX_MODELS &&
                     (r = document_next_rig(document, RIG_MODEL, r)) >= 0;) {
        if (!bones_character(in->core, r)) continue;
        const char *title = rig_title(document->rigs[r]);
        snprintf(texts[more], MODEL_TEXT, "A joint of %.*s", name_fit(title, 80), title);
        items[count + more] = (struct ui_item){texts[more], texts[more], 0, INSPECTOR_MAX_SPLINES + r};
        more++;
    }
    const int picked = inspector_list(in, list, items, count + more, spline->parameter[parameter].track);
    const int active = in->core->focus.active;
    if (picked >= INSPECTOR_MAX_SPLINES) {
        bones_follow(in->core, active, picked - INSPECTOR_MAX_SPLINES, -1);
    } else if (picked >= 0 && core_step(in->core, "Follow spline", 0)) {
        const struct param track = param_track(picked);
        edit_parameter(in->core->document, active, parameter, &track, &in->core->step.error);
    }
}

static const struct dropdown track_list = {
    .name = "follow", .hint = "The spline it follows, sample by sample", .build = choose_track};

/// The button at the right of a row: follows a spline from a list, or stops following.
static void build_track_button(struct inspector *in, enum parameter parameter, struct rect row)
{
    const struct rect r = {row.x + row.w + 2, row.y, UI_ROW, UI_ROW};
    const int active = in->core->focus.active;
    const bool follows = param_follows(&in->core->document->splines[active]->parameter[parameter]);
    const bool joints =
        parameter == PARAMETER_EQUILIBRIUM && document_find_rig(in->core->document, RIG_MODEL, 0) >= 0;
    char name[64];
    snprintf(name, sizeof name, "follow.%s", parameter_rows[parameter].name);
    const struct row button = {ICON(name, follows ? UI_ICON_UNFOLLOW : UI_ICON_FOLLOW),
                               .undo = follows ? "Stop following" : NULL,
                               .hint = follows  ? "Stop following; keep the value at the playhead"
                                       : joints ? "Follow another spline, or a joint of the character"
                                                : "Follow another spline"};
    const bool pressed = inspector_icon(in, r, &button);
    if (pressed && follows) {
        const struct param number = param_number(spline_list_present(in->core, active, parameter));
        edit_parameter(in->core->document, active, parameter, &number, &in->core->step.error);
    }
    bool left_out[INSPECTOR_MAX_SPLINES];
    if (pressed && !follows && (find_leaders(in, left_out) || joints)) {
        const struct rect field = {row.x + UI_LABEL + UI_GAP, row.y, row.w - UI_LABEL - UI_GAP, row.h};
        ui_popup_open(&in->ui, track_list.name, (int)parameter, field);
    } else if (pressed && !follows) {
        core_message(in->core, true, "There is no other spline for %.*s to follow.",
                     name_fit(core_active_spline(in->core)->name, 80), core_active_spline(in->core)->name);
    }
    inspector_offer(in, &track_list);
}

enum { MOTION_GAIN, MOTION_PART };

static bool set_motion(struct inspector *in, int which, double number, struct error *error)
{
    struct joint_motion motion = *followed(in)->motion;
    const struct param param = {.track = -1, .motion = &motion};
    if (which == MOTION_GAIN) motion.gain = number;
    if (which == MOTION_PART) motion.of = (enum motion_of)number;
    return edit_parameter(in->core->document, in->core->focus.active, PARAMETER_EQUILIBRIUM, &param, error);
}

static const struct number_row gain_rows[] = {
    {NUMBER_AT(struct joint_motion, gain), .undo = "Set joint's gain",
     .ui = {NAMED("joint.gain", "strength"), .hint = "How much of the joint's motion it follows", TYPED(-1e6, 1e6),
            .fallback = 1, .step = 0.01, .decimals = 2}},
};

void inspector_parameter(struct inspector *in, enum parameter parameter)
{
    const struct spline *spline = core_active_spline(in->core);
    const struct parameter_row *row = &parameter_rows[parameter];
    if (!spline_uses(spline, parameter, false)) return;
    if (row->kind == PARAMETER_CHOICE) {
        struct ui_choice choices[PARAMETER_MAX_WORDS];
        int chosen = (int)spline->parameter[parameter].value, count = 0;
        for (; row->words[count]; count++) choices[count] = (struct ui_choice){row->words[count], row->labels[count]};
        const struct row choice = {NAMED(row->name, parameter == PARAMETER_MODE ? NULL : row->name),
                                   .hint = row->hint, .undo = row->undo, .choices = choices, .count = count};
        if (inspector_choice(in, &choice, &chosen)) set_felt(in, (int)parameter, chosen, &in->core->step.error);
        return;
    }

    struct rect r = ui_row(&in->ui, UI_ROW);
    const bool follows = param_follows(&spline->parameter[parameter]);
    const bool may_follow = row->kind == PARAMETER_TRACK &&
                            (in->core->view.on[SWITCH_MORE] || follows || parameter == PARAMETER_EQUILIBRIUM);
    if (may_follow) r.w -= UI_ROW + 2;
    const struct param *param = &spline->parameter[parameter];
    const struct rect field = follows ? inspector_label(in, r, row->name) : r;
    if (!follows) {
        build_number(in, (int)parameter, r);
    } else if (param->motion) {
        const struct joint_motion *motion = param->motion;
        const int model = document_find_model(in->core->document, motion->model);
        char title[BONES_TITLE];
        const char *text = model < 0 ? motion->joint : bones_title(in->core->document, model, motion->joint, title);
        inspector_bone_field(in, &joint_list, field, 0, text, in->core->focus.active);
    } else {
        inspector_spline_field(in, &track_list, field, (int)parameter, param->track);
    }
    if (may_follow) build_track_button(in, parameter, r);
    if (!spline->parameter[parameter].motion) return;

    static const struct ui_choice motions[] = {[MOTION_TURN] = {"turn", "Turn"},
                                               [MOTION_ACROSS] = {"across", "Side"},
                                               [MOTION_UP] = {"up", "Up"},
                                               [MOTION_BASE] = {"base", "Base"}};
    static const struct row part = {NAMED("joint.of", "joint's"),
                                    .hint = "Its turn, its way across or up, or what it does to the flesh on it",
                                    .undo = "Set joint's motion", CHOICES(motions)};
    if (followed(in)->motion) {
        int of = (int)followed(in)->motion->of;
        if (inspector_choice(in, &part, &of)) set_motion(in, MOTION_PART, of, &in->core->step.error);
    }
    const struct number_home home = {.of = followed(in)->motion, .set = set_motion};
    if (home.of) inspector_numbers(in, gain_rows, 1, &home);
}

void inspector_spline(struct inspector *in)
{
    static const enum parameter shown[] = {PARAMETER_MODE, PARAMETER_EQUILIBRIUM, PARAMETER_START};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) inspector_parameter(in, shown[i]);
    static const struct ui_choice choices[] = {{"off", "Off"}, {"on", "On"}};
    static const struct row all = {
        NAMED("settles.all", "pose to pose"),
        .hint = "Let the motion settle at every knot: it overshoots each, and stays. Poses become values",
        CHOICES(choices)};
    int settles = spline_settles(core_active_spline(in->core));
    if (spline_mode(core_active_spline(in->core)) == WIGGLY_CUBIC) {
        inspector_idle(in, all.label, "–");
    } else if (inspector_choice(in, &all, &settles)) {
        core_pose_to_pose(in->core, inspector_limb(in));
    }
}

void inspector_advanced(struct inspector *in)
{
    inspector_parameter(in, PARAMETER_BANDWIDTH);
    if (spline_uses_calm(in->core->document, in->core->focus.active)) inspector_parameter(in, PARAMETER_CALM);
    inspector_parameter(in, PARAMETER_PASSIVE);
    char text[64];
    if (isnan(get_felt(in, SETTLE, false, text))) {
        inspector_idle(in, "settles in", "–");
    } else {
        build_number(in, SETTLE, shorter(in));
    }
    static const struct row phase = {NAMED("phase", "phase curve"),
                                     .hint = "Also draw the curve's imaginary part, a quarter of a swing behind it"};
    inspector_toggle(in, ui_row(&in->ui, UI_ROW), &phase, &in->core->view.on[SWITCH_PHASE]);
}

/// A number and a switch for each limit; off, only the name.
void inspector_limits(struct inspector *in)
{
    for (int which = PARAMETER_HIGH; which >= PARAMETER_LOW; which--) {
        const struct spline *spline = core_active_spline(in->core);
        const struct parameter_row *row = &parameter_rows[which];
        const struct row limit = {
            .name = which == PARAMETER_HIGH ? "limit.high" : "limit.low", .hint = row->hint, .undo = row->undo};
        const struct rect r = ui_row(&in->ui, UI_ROW);
        const struct rect name = {r.x, r.y, r.w - 34, r.h}, at = {r.x + r.w - 28, r.y, 28, r.h};
        bool on = isfinite(spline->parameter[which].value);
        if (on) build_number(in, which, name);
        if (!on) ui_label(&in->ui, name, row->name, theme()->text_dim);
        ui_hint(&in->ui, r, row->hint);
        if (!inspector_toggle(in, at, &limit, &on)) continue;
        const double number = on ? core_fresh_limit(spline, (enum parameter)which) : row->standard;
        set_felt(in, which, number, &in->core->step.error);
    }
}

/// First amount of a roll.
static const double FRESH_VARIATION = 0.3;

void inspector_roll(struct inspector *in, int unused)
{
    // Another seed, and an amount if there was none.
    const struct spline *spline = core_active_spline(in->core);
    const int most = (int)parameter_rows[PARAMETER_SEED].maximum + 1;
    const long long seed = (long long)spline->parameter[PARAMETER_SEED].value;
    const bool is_new = spline->parameter[PARAMETER_VARIATION].value == 0;
    const int active = in->core->focus.active;
    (void)unused;
    if (!core_step(in->core, "Roll variation", 0)) return;
    core_set_parameter(in->core, active, PARAMETER_SEED, (double)((seed * 7 + 1) % 1000 % most));
    if (is_new) core_set_parameter(in->core, active, PARAMETER_VARIATION, FRESH_VARIATION);
    core_edited(in->core, active);
}

void inspector_variation(struct inspector *in)
{
    static const struct row roll = {NAMED("variation.roll", "Roll"), .hint = "Another motion through the same knots"};
    const struct spline *spline = core_active_spline(in->core);
    const struct param *p = spline->parameter;
    const char *reason = NULL; // why it is not visible
    if (p[PARAMETER_FREQUENCY].value <= 0) reason = "A spline that does not swing has no variations.";
    for (enum parameter n = PARAMETER_FREQUENCY; n <= PARAMETER_BANDWIDTH; n++) {
        if (p[n].track >= 0 && spline_uses(spline, n, false))
            reason = "There are no variations while frequency or damping follows a spline.";
    }
    if (p[PARAMETER_PASSIVE].value != WIGGLY_OSCILLATOR) reason = "The paper's filter has no variations.";
    build_number(in, PARAMETER_VARIATION, ui_row(&in->ui, UI_ROW));
    struct rect r = ui_row(&in->ui, UI_ROW), button = {r.x + r.w - 64, r.y + 2, 64, r.h - 4};
    r.w -= 70;
    build_number(in, PARAMETER_SEED, r);
    if (inspector_button(in, button, &roll)) inspector_roll(in, 0);
    if (reason) ui_paragraph(&in->ui, reason, theme()->text_dim);
}
