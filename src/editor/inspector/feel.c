/// The feel of a limb, or of the active spline alone: frequency, settling time, wind-up, lag and gain.
#include "base/names.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/parts.h"
#include "scene/order.h"
#include <math.h>
#include <stdio.h>

static const struct preset {
    const char *name, *label, *hint;
    double frequency, damping;
    double wind_up; ///< periods
    double lag;     ///< degrees between the first and last joint
} presets[] = {
    {"preset.cat", "Cat", "A cat's tail: slow, soon at rest, the tip far behind", 0.8, 0.22, 0.5, 170},
    {"preset.whip", "Whip", "A whip: quick, a wave that runs to the tip", 1.8, 0.12, 0.35, 260},
    {"preset.heavy", "Heavy", "Something heavy: slow, long in coming, soon at rest", 0.5, 0.35, 0.7, 90},
    {"preset.jelly", "Jelly", "Jelly: quick, wobbles for long", 3, 0.06, 0.5, 60},
    {"preset.antenna", "Antenna", "An antenna: very quick, stiff, rings for long", 5, 0.03, 0.5, 20},
};

enum { PRESETS = sizeof presets / sizeof presets[0], PRESET_GAP = 4, PRESET_MARGINS = 8, TEXT = 32 /* two lines */ };

int inspector_limb(const struct inspector *in) { return in->alone ? -1 : core_limb(in->core); }

const char *inspector_feel_title(struct inspector *in)
{
    const struct document *document = in->core->document;
    const bool alone = in->ui.held || in->ui.typing ? in->alone : in->core->mods & MOD_ALT;
    const int limb = alone ? -1 : core_limb(in->core), size = sizeof in->feel_title;
    const char *name = limb >= 0 ? rig_title(document->rigs[limb]) : core_active_spline(in->core)->name;
    int splines = 0;
    for (int s = 0; limb >= 0 && s < document->spline_count; s++) splines += rig_is_moved(document->rigs[limb], s);
    const int length = snprintf(in->feel_title, (size_t)size, "Feel · %.*s", name_fit(name, 64), name);
    if (splines > 1) snprintf(in->feel_title + length, (size_t)(size - length), " (%d splines)", splines);
    return in->feel_title;
}

/// Sets the same lag for each joint in the channel the spline bends, and in the limb's others.
static bool set_lag(struct inspector *in, double whole)
{
    if (!inspector_felt_channel(in)) return true;
    const int limb = inspector_limb(in), joints = bones_joints(in->core, in->rig);
    const struct angles angles = {.value = {joints > 1 ? core_round(whole / (joints - 1), 0.1) : 0}};
    bool done = true;
    for (int c = 0; c < rig_input_count(in->core->document->rigs[in->rig]) && done; c++) {
        const bool others = limb == in->rig && rig_point_input(in->core->document->rigs[limb], c) >= 0;
        const struct channel_place at = {in->rig, c};
        if (c == in->channel || others)
            done = edit_angles(in->core->document, at, ANGLE_LAG, &angles, &in->core->error);
    }
    return done;
}

static bool set_felt(struct inspector *in, enum parameter parameter, double value, bool alike)
{
    return core_set_felt(in->core, inspector_limb(in), parameter, value, alike, &in->core->error);
}

static void apply(struct inspector *in, const struct preset *preset)
{
    const struct spline *spline = core_active_spline(in->core);
    if (!core_begin(in->core, "Choose a feel", 0)) return;
    const bool good = (spline_mode(spline) != WIGGLY_CUBIC ||
                       core_set_parameter(in->core, in->core->active, PARAMETER_MODE, WIGGLY_COMPLEX)) &&
                      set_felt(in, PARAMETER_FREQUENCY, preset->frequency, false) &&
                      set_felt(in, PARAMETER_DAMPING, preset->damping, true) &&
                      set_felt(in, PARAMETER_WIND_UP, preset->wind_up, true);
    core_end(in->core, good && set_lag(in, preset->lag));
    core_edited(in->core, in->core->active);
}

void inspector_preset(struct inspector *in, int preset)
{
    in->alone = false;
    apply(in, &presets[preset]);
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
        ui_hint(&in->ui, r, presets[i].hint);
        if (ui_button(&in->ui, r, presets[i].name, presets[i].label, false)) apply(in, &presets[i]);
        x = right + PRESET_GAP;
    }
}

/// Uses two rows if one would cut words.
static void build_presets(struct inspector *in)
{
    const struct rect row = ui_row(&in->ui, UI_ROW);
    const bool fit = presets_width(0, PRESETS) + PRESETS * PRESET_MARGINS <= row.w;
    const int in_first = fit ? PRESETS : (PRESETS + 1) / 2;
    build_preset_row(in, row, 0, in_first);
    if (!fit) build_preset_row(in, ui_row(&in->ui, UI_ROW), in_first, PRESETS);
}

static bool is_never(enum settle_kind kind) { return kind == SETTLE_NEVER || kind == SETTLE_LATE; }

/// Settling time with another damping; INFINITY: never, or too late.
static double settles(const struct spline *spline, double damping, double step)
{
    struct spline other = *spline;
    other.parameter[PARAMETER_DAMPING].value = damping;
    const struct settling settling = settle_alone(&other, step);
    return settling.kind == SETTLE_ALONE ? settling.seconds : INFINITY;
}

/// The damping, at most critical, for a settling time. Time falls as damping rises, so bisection works.
static double damping_for(const struct spline *spline, double seconds, double step)
{
    double low = 0, high = 1;
    for (int i = 0; i < 40; i++) {
        const double middle = (low + high) / 2;
        if (settles(spline, middle, step) > seconds) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

const struct spline *inspector_kept_spline(const struct inspector *in)
{
    const int kept = take_spline(in->core, in->core->active);
    return kept >= 0 ? in->core->take.document->splines[kept] : NULL;
}

const struct spline *inspector_seen_spline(const struct inspector *in)
{
    const struct spline *kept = take_is_shown(in->core) ? inspector_kept_spline(in) : NULL;
    return kept ? kept : core_active_spline(in->core);
}

/// A spline's settling time as a number; setting it sets the damping.
static double seconds_of(const struct inspector *in, const struct spline *spline)
{
    const struct settling alone = settle_alone(spline, document_step(in->core->document));
    return alone.kind == SETTLE_ALONE ? alone.seconds : is_never(alone.kind) ? SETTLE_LIMIT : NAN;
}

static double get_settle(const struct inspector *in, int which)
{
    (void)which;
    return seconds_of(in, core_active_spline(in->core));
}

static double was_settle(const struct inspector *in, int which)
{
    const struct spline *kept = inspector_kept_spline(in);
    (void)which;
    return kept ? seconds_of(in, kept) : NAN;
}

static bool set_settle(struct inspector *in, int which, double seconds, struct error *error)
{
    const struct spline *spline = core_active_spline(in->core);
    const double damping = damping_for(spline, seconds, document_step(in->core->document));
    const double rounded = round(damping * 1e4) / 1e4;
    (void)which;
    return core_set_felt(in->core, inspector_limb(in), PARAMETER_DAMPING, rounded, false, error);
}

static const char *show_settle(const struct inspector *in, int which, char text[64])
{
    const struct spline *spline = inspector_seen_spline(in);
    (void)which, (void)text;
    return is_never(settle_alone(spline, document_step(in->core->document)).kind) ? "never" : NULL;
}

static void build_settle(struct inspector *in)
{
    static const struct number_home home = {
        .get = get_settle, .set = set_settle, .shown = show_settle, .was = was_settle};
    const struct spline *spline = core_active_spline(in->core);
    const double step = document_step(in->core->document);
    const enum settle_kind kind = settle_alone(spline, step).kind;
    if (kind != SETTLE_ALONE && !is_never(kind)) {
        inspector_idle(in, "settles in", "–");
        return;
    }
    const struct number_row number = {.name = "settle",
                                      .label = "settles in",
                                      .unit = "s",
                                      .hint =
                                          "Time until 5 % of a swing is left; changes the damping, not the frequency",
                                      .undo = "Set settle time",
                                      .lowest = ceil(settles(spline, 1, step) * 100) / 100,
                                      .highest = SETTLE_LIMIT,
                                      .fallback = NAN,
                                      .step = 0.05,
                                      .decimals = 2};
    struct rect r = ui_row(&in->ui, UI_ROW);
    r.w -= UI_ROW + 2; // lines up with the rows above, which have a button there
    inspector_number(in, &number, &home, 0, r);
}

/// Frames of a period at the spline's own frequency.
static double period_of(const struct inspector *in, const struct spline *spline)
{
    return in->core->document->fps / spline->parameter[PARAMETER_FREQUENCY].value;
}

static double period_frames(const struct inspector *in) { return period_of(in, core_active_spline(in->core)); }

static double longest_wind_up(const struct inspector *in)
{
    return parameter_rows[PARAMETER_WIND_UP].usual * period_frames(in);
}

/// The wind-up in frames. The longest stands for the whole curve.
static double get_wind_up(const struct inspector *in, int which)
{
    const double periods = core_active_spline(in->core)->parameter[PARAMETER_WIND_UP].value;
    (void)which;
    return periods > 0 ? periods * period_frames(in) : longest_wind_up(in);
}

static double was_wind_up(const struct inspector *in, int which)
{
    const struct spline *kept = inspector_kept_spline(in);
    (void)which;
    if (!kept || !spline_uses(kept, PARAMETER_WIND_UP, false)) return NAN;
    const double periods = kept->parameter[PARAMETER_WIND_UP].value;
    return periods > 0 ? periods * period_of(in, kept) : longest_wind_up(in);
}

static bool set_wind_up(struct inspector *in, int which, double frames, struct error *error)
{
    const bool whole = frames >= longest_wind_up(in);
    const double periods = whole ? 0 : round(frames / period_frames(in) * 1e4) / 1e4;
    (void)which;
    return core_set_felt(in->core, inspector_limb(in), PARAMETER_WIND_UP, periods, false, error);
}

static const char *show_wind_up(const struct inspector *in, int which, char text[64])
{
    (void)which, (void)text;
    return inspector_seen_spline(in)->parameter[PARAMETER_WIND_UP].value > 0 ? NULL : "whole curve";
}

static void build_wind_up(struct inspector *in)
{
    static const struct number_home home = {
        .get = get_wind_up, .set = set_wind_up, .shown = show_wind_up, .was = was_wind_up};
    const struct spline *spline = core_active_spline(in->core);
    const struct parameter_row *row = &parameter_rows[PARAMETER_WIND_UP];
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    if (!spline_uses(spline, PARAMETER_WIND_UP, false) || param_follows(frequency) || frequency->value == 0) {
        inspector_idle(in, row->name, "–");
        return;
    }
    const struct number_row number = {.name = row->name,
                                      .label = row->name,
                                      .unit = row->unit,
                                      .hint = row->hint,
                                      .undo = row->undo,
                                      .maximum = longest_wind_up(in),
                                      .lowest = 1,
                                      .highest = INFINITY,
                                      .fallback = row->fresh * period_frames(in),
                                      .step = row->step};
    struct rect r = ui_row(&in->ui, UI_ROW);
    if (in->core->more) r.w -= UI_ROW + 2; // lines up, too
    inspector_number(in, &number, &home, 0, r);
}

/// The settling in one sentence.
static void build_sentence(struct inspector *in)
{
    const struct spline *spline = inspector_seen_spline(in);
    const bool kept = spline != core_active_spline(in->core);
    const struct document *document = kept ? in->core->take.document : in->core->document;
    const struct evaluation *evaluation = kept ? &in->core->take.evaluation : in->core->evaluation;
    const int active = kept ? take_spline(in->core, in->core->active) : in->core->active;
    char text[128];
    struct settling settling = settle_alone(spline, document_step(document));
    if (evaluation && active < evaluation->count && spline->knot_count > 0) {
        const int last = document_sample(document, spline->knots[spline->knot_count - 1].frame);
        settling = settle_measure(spline, &evaluation->curves[active], last);
    }
    const double frames = settling.seconds * document->fps;
    switch (settling.kind) {
    case SETTLE_UNKNOWN:
        return;
    case SETTLE_NEVER:
        snprintf(text, sizeof text, "Rings forever.");
        break;
    case SETTLE_CUBIC:
        snprintf(text, sizeof text, "%s",
                 spline_mode(spline) == WIGGLY_CUBIC ? "A cubic: smooth through the knots, with no swing."
                                                     : "Frequency 0 makes it a plain cubic.");
        break;
    case SETTLE_LATE:
        snprintf(text, sizeof text, "Takes more than %d s to settle to 5 %%.", SETTLE_LIMIT);
        break;
    case SETTLE_ALONE:
        snprintf(text, sizeof text, "Settles to 5 %% in %.0f frames.", frames);
        break;
    case SETTLE_SEEN:
        snprintf(text, sizeof text, "Settles to 5 %% %.0f frames after the last knot.", ceil(frames - 1e-6));
        break;
    case SETTLE_LEFT:
        snprintf(text, sizeof text, "Still swinging when the scene ends (%.0f %%).", 100 * settling.left);
        break;
    }
    ui_paragraph(&in->ui, text, theme()->text_dim);
}

/// false if there are no warnings.
static bool build_warnings(struct inspector *in)
{
    const float top = in->ui.y;
    const struct spline *spline = core_active_spline(in->core);
    const struct evaluation *evaluation = in->core->evaluation;
    const int active = in->core->active;
    char sentence[EVALUATION_SENTENCE];
    if (evaluation && active < evaluation->count && evaluation_sentence(evaluation, active, sentence))
        ui_paragraph(&in->ui, sentence, theme()->warning);
    const struct param *p = spline->parameter;
    const double beta = spline_mode(spline) == WIGGLY_COMPLEX ? p[PARAMETER_BANDWIDTH].value : 0;
    const double highest = p[PARAMETER_FREQUENCY].value * (1 + beta);
    const double limit = in->core->document->fps * in->core->document->substeps / 2;
    const bool poles = spline_mode(spline) != WIGGLY_CUBIC && p[PARAMETER_FREQUENCY].track < 0;
    if (poles && highest > limit) {
        char text[128];
        snprintf(text, sizeof text, "Faster than half the sample rate (%g Hz): the swing aliases.", limit);
        ui_paragraph(&in->ui, text, theme()->warning);
    }
    return in->ui.y > top;
}

static void build_find(struct inspector *in)
{
    const struct rect row = ui_row(&in->ui, UI_ROW), r = {row.x, row.y + 1, row.w, row.h - 2};
    ui_hint(&in->ui, r, "Frequency and damping that explain the knots best (Shift+F); again: the runner-up");
    if (ui_button(&in->ui, r, "frequency.find", "Find the frequency", false)) core_find_frequency(in->core, 0);
}

/// Lag and gain of the channel or coordinate the spline drives; below each is room for the highest curve of any spline.
static void build_reach(struct inspector *in)
{
    static const char *const labels[] = {[ANGLE_LAG] = "lag", [ANGLE_GAIN] = "gain"};
    const bool bends = inspector_felt_channel(in) != NULL, drives = !bends && inspector_felt_drive(in);
    for (int kind = ANGLE_LAG; kind <= ANGLE_GAIN; kind++) {
        const float top = in->ui.y;
        if (bends) inspector_angles(in, (enum angle_kind)kind);
        if (!bends && !drives) inspector_idle(in, labels[kind], "–");
        in->ui.y = top + (drives ? 0 : UI_ROW) + inspector_highest_curve(in, (enum angle_kind)kind);
    }
}

/// Rows keep their places for every kind of spline.
void inspector_feel(struct inspector *in)
{
    static const enum parameter pace[] = {PARAMETER_FREQUENCY, PARAMETER_DAMPING};
    build_presets(in);
    for (size_t i = 0; i < sizeof pace / sizeof pace[0]; i++) {
        if (spline_uses(core_active_spline(in->core), pace[i], false)) {
            inspector_parameter(in, pace[i]);
        } else {
            inspector_idle(in, parameter_rows[pace[i]].name, "–");
        }
    }
    if (in->core->more) build_settle(in);
    build_wind_up(in);
    build_reach(in);
    const float end = in->ui.y + TEXT;
    if (!build_warnings(in)) build_sentence(in);
    in->ui.y = fmaxf(in->ui.y, end);
    if (in->core->more) build_find(in);
}
