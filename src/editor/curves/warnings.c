/// Warnings on the curves: what a click does about them, and the marks.
#include "scene/warnings.h"
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/curves/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>

/// Of the other curves in sight only that one swings far beyond its knots, as an edit elsewhere may make it. While a drag runs nothing else is
/// said, because it would change with every step.
void warnings_update(struct curves *curves, const struct core *core)
{
    struct warnings *warnings = &curves->warnings;
    const struct spline *spline = spline_list_seen(core);
    const struct evaluation *evaluation = core->evaluation;
    const struct document *document = core->document;
    const bool solved = evaluation && evaluation->samples == document_samples(document), drags = core->drag.owner;
    const uint64_t state[] = {history_revision(core->history),
                              (uint64_t)(core->active + 1),
                              (uint64_t)core->look,
                              solved,
                              solved ? evaluation->revision : 0,
                              drags,
                              curves->cache.key};
    const uint64_t key = hash_bytes(HASH_START, state, sizeof state);
    if (key == curves->warnings_key) return;
    warnings->count = 0;
    curves->warnings_key = key;
    if (!solved) return;
    memset(curves->far, 0, sizeof curves->far);
    if (spline && drags) warnings_add_far(document, evaluation, core->active, warnings);
    if (spline && !drags) warnings_add(document, evaluation, core->active, warnings);
    for (int i = 0; i < curves->cache.other_count; i++)
        warnings_add_far(document, evaluation, curves_other(curves, document, i), warnings);
}

enum { LOWER_STEPS = 8 };

static const double LOWER = 0.9; ///< factor of the frequency from try to try

/// Swings that the spline has too many of with the document as it is now.
static int count_swings(const struct core *core)
{
    const struct document *document = core->document;
    struct evaluation trial = {.solver = core->evaluation->solver, .models = core->evaluation->models};
    struct warnings found = {0};
    evaluation_update(&trial, document, false);
    warnings_add(document, &trial, core->active, &found);
    int count = 0;
    for (int i = 0; i < found.count; i++)
        count += found.list[i].kind == WARNING_SWING || found.list[i].kind == WARNING_FAR;
    evaluation_free(&trial);
    return count;
}

/// Says whether an edit in the open step, if it was `done`, has left fewer swings than `before`; if not, it is taken back.
static bool helps(struct core *core, bool done, int before)
{
    if (done && count_swings(core) < before) return true;
    core->error = (struct error){0};
    history_restart(core->history);
    return false;
}

static bool lower_frequency(struct core *core, const struct spline *spline, int before, char text[96])
{
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    double value = frequency->value;
    if (frequency->track >= 0) return false;
    for (int i = 0; i < LOWER_STEPS; i++) {
        value = core_round(value * LOWER, 0.01);
        const bool done = core_set_parameter(core, core->active, PARAMETER_FREQUENCY, value);
        if (!helps(core, done, before)) continue;
        snprintf(text, 96, "Lowered the frequency to %.3g Hz to tame the swing.", value);
        return true;
    }
    return false;
}

/// A limit on the side of the swing, a little beyond the knots.
static bool limit_curve(struct core *core, const struct spline *spline, const struct warning *warning, int before,
                        char text[96])
{
    const enum parameter side = warning->value > warning->remedy ? PARAMETER_HIGH : PARAMETER_LOW;
    const double value = core_fresh_limit(spline, side);
    if (isfinite(spline->parameter[side].value)) return false;
    if (!helps(core, core_set_parameter(core, core->active, side, value), before)) return false;
    snprintf(text, 96, "Set the %s to %.6g to tame the swing.", parameter_rows[side].name, value);
    return true;
}

static bool tame(const struct curves *curves, struct core *core, const struct warning *warning, char text[96])
{
    const struct spline *spline = core_active_spline(core);
    const int active = core->active, before = count_swings(core);
    const double resolution = 0.01 / curves_pixels_per_value(curves, core);
    const struct knot hold = {.frame = warning->frame,
                              .value = core_round(warning->remedy, resolution),
                              .stiffness = KNOT_DEFAULT_STIFFNESS};
    if (spline->parameter[PARAMETER_CALM].value < 1 &&
        helps(core, core_set_parameter(core, active, PARAMETER_CALM, 1), before)) {
        snprintf(text, 96, "Raised calm to 1 to tame the swing.");
        return true;
    }
    if (helps(core, core_put_knot(core, active, &hold), before)) {
        snprintf(text, 96, "Added a knot at frame %.6g to tame the swing.", warning->frame);
        return true;
    }
    if (limit_curve(core, spline, warning, before, text)) return true;
    return lower_frequency(core, spline, before, text);
}

/// More substeps keep the motion as it is; where there is no room for them the frequency gives way.
static bool resolve_rate(struct core *core, const struct warning *warning, char text[96])
{
    const int substeps = (int)fmin(warning->remedy, SCENE_MAX_SUBSTEPS);
    snprintf(text, 96, "%d substeps a frame.", substeps);
    if (warning->remedy <= SCENE_MAX_SUBSTEPS && edit_substeps(core->document, substeps, NULL)) return true;
    const struct spline *spline = core_active_spline(core);
    const double value = spline->parameter[PARAMETER_FREQUENCY].value * warning->limit / warning->amount;
    const double lower = core_round(0.99 * value, 0.01);
    snprintf(text, 96, "%.3g Hz.", lower);
    return core_set_parameter(core, core->active, PARAMETER_FREQUENCY, lower);
}

/// Makes the edit in the document, which need not be the one on the table.
static bool apply_far(struct document *document, const struct warning *warning, enum far_remedy remedy,
                      struct error *error)
{
    const int of = warning->spline;
    const struct param low = param_number(warning->low), high = param_number(warning->high), calm = param_number(1);
    const struct knot pose = {.frame = warning->frame,
                              .value = warning->remedy,
                              .has_phase = spline_mode(document->splines[of]) == WIGGLY_COMPLEX,
                              .phase = warning->phase,
                              .stiffness = KNOT_DEFAULT_STIFFNESS};
    if (remedy == FAR_CALM) return edit_parameter(document, of, PARAMETER_CALM, &calm, error);
    if (remedy == FAR_POSE) return edit_knot_insert(document, of, &pose, error);
    return remedy == FAR_LIMITS && edit_parameter(document, of, PARAMETER_LOW, &low, error) &&
           edit_parameter(document, of, PARAMETER_HIGH, &high, error);
}

/// How many times as far as it may the curve swings with a remedy; infinitely where that cannot be had.
static double swing_with(const struct core *core, const struct warning *warning, enum far_remedy remedy)
{
    struct error error;
    struct document *document = document_copy(core->document);
    struct evaluation trial = {.solver = core->evaluation->solver, .models = core->evaluation->models};
    double farthest = INFINITY;
    if (apply_far(document, warning, remedy, &error)) {
        evaluation_update(&trial, document, false);
        farthest = warning_times_far(core->document, core->evaluation, &trial, warning->spline);
        evaluation_free(&trial);
    }
    document_destroy(document);
    return farthest;
}

static enum far_remedy choose_far(const struct core *core, const struct warning *warning)
{
    const double calm = core->document->splines[warning->spline]->parameter[PARAMETER_CALM].value;
    if (calm < 1 && swing_with(core, warning, FAR_CALM) <= 1) return FAR_CALM;
    const double limits = swing_with(core, warning, FAR_LIMITS), pose = swing_with(core, warning, FAR_POSE);
    if (fmin(limits, pose) >= warning->amount) return FAR_NOTHING;
    return pose < limits ? FAR_POSE : FAR_LIMITS;
}

static bool tame_far(struct core *core, const struct warning *warning, char text[96])
{
    const enum far_remedy remedy = choose_far(core, warning);
    if (remedy == FAR_CALM) snprintf(text, 96, "Raised calm to 1 to tame the swing.");
    if (remedy == FAR_LIMITS)
        snprintf(text, 96, "Set limits from %.6g to %.6g to tame the swing.", warning->low, warning->high);
    if (remedy == FAR_POSE) snprintf(text, 96, "Added a pose at frame %.6g to tame the swing.", warning->frame);
    return apply_far(core->document, warning, remedy, &core->error);
}

/// The knot of a spline at a frame.
static bool find_knot(const struct document *document, int of, double frame, struct knot *knot)
{
    const struct spline *spline = document->splines[of];
    const int k = spline_find_knot(document, spline, document_sample(document, frame));
    if (k >= 0) *knot = spline->knots[k];
    return k >= 0;
}

static bool free_phase(struct document *document, int of, double frame, struct error *error)
{
    struct knot knot;
    if (!find_knot(document, of, frame, &knot)) return false;
    knot.has_phase = false;
    knot.phase = 0;
    return edit_knot_set(document, of, &knot, error);
}

/// Frees the later of two poses, the earlier one, or both.
static bool free_ends(struct document *document, const struct warning *warning, unsigned ends, struct error *error)
{
    bool good = true;
    if (ends & 1) good = free_phase(document, warning->spline, warning->to, error);
    if (good && ends & 2) good = free_phase(document, warning->spline, warning->from, error);
    return good;
}

static double swing_left(const struct core *core, const struct warning *warning, unsigned ends)
{
    struct error error;
    struct document *document = document_copy(core->document);
    struct evaluation trial = {.solver = core->evaluation->solver, .models = core->evaluation->models};
    double left = 0;
    if (free_ends(document, warning, ends, &error)) {
        evaluation_update(&trial, document, false);
        left = warning_swing_left(warning, document, &trial);
        evaluation_free(&trial);
    }
    document_destroy(document);
    return left;
}

static const double MORE_SWING = 1.25; ///< that a free phase has to leave

/// Frees what leaves most of the swing, one pose rather than both.
static bool free_forced(struct core *core, const struct warning *warning, char text[96])
{
    double best = MORE_SWING * warning_swing_left(warning, core->document, core->evaluation);
    unsigned ends = 0;
    for (unsigned tried = 1; tried <= 3; tried++) {
        const double left = swing_left(core, warning, tried);
        if (left > best) best = MORE_SWING * left, ends = tried;
    }
    if (ends == 3) snprintf(text, 96, "The phases at frames %.6g and %.6g are free.", warning->from, warning->to);
    if (ends == 1 || ends == 2)
        snprintf(text, 96, "The phase at frame %.6g is free.", ends == 1 ? warning->to : warning->from);
    return ends > 0 && free_ends(core->document, warning, ends, &core->error);
}

static bool free_phases(struct core *core, char text[96])
{
    bool good = true;
    for (int k = 0; k < core_active_spline(core)->knot_count && good; k++) {
        const struct knot *knot = &core_active_spline(core)->knots[k];
        good = !knot->has_phase || free_phase(core->document, core->active, knot->frame, &core->error);
    }
    snprintf(text, 96, "The knots hold their values alone.");
    return good;
}

static bool switch_off(struct core *core, const struct warning *warning, char text[96])
{
    struct knot knot;
    if (!find_knot(core->document, core->active, warning->frame, &knot)) return false;
    knot.has_slope = false;
    snprintf(text, 96, "The slope at frame %.6g is off.", warning->frame);
    return core_put_knot(core, core->active, &knot);
}

void curves_remedy_first(struct curves *curves, struct core *core, int unused)
{
    (void)unused;
    warnings_update(curves, core);
    if (curves->warnings.count > 0) {
        warning_remedy(curves, core, &curves->warnings.list[0]);
    } else {
        core_message(core, false, "This spline has no warnings.");
    }
}

void warning_remedy(const struct curves *curves, struct core *core, const struct warning *warning)
{
    static const char *const labels[] = {
        [WARNING_SWING] = "Tame swing",    [WARNING_RATE] = "Add substeps",     [WARNING_DRIFT] = "Narrow bandwidth",
        [WARNING_FAR] = "Tame swing",      [WARNING_FORCED] = "Free the phase", [WARNING_SLOPE] = "Slope off",
        [WARNING_PHASE] = "Free the phase"};
    const struct warning chosen = *warning;
    char text[96] = "";
    bool good = false;
    core_activate(core, chosen.spline);
    if (!core_active_spline(core) || !core_begin(core, labels[chosen.kind], 0)) return;
    if (chosen.kind == WARNING_FAR) good = tame_far(core, &chosen, text);
    if (chosen.kind == WARNING_SWING) good = tame(curves, core, &chosen, text);
    if (chosen.kind == WARNING_RATE) good = resolve_rate(core, &chosen, text);
    if (chosen.kind == WARNING_DRIFT) {
        good = core_set_parameter(core, core->active, PARAMETER_BANDWIDTH, chosen.remedy);
        snprintf(text, sizeof text, "Bandwidth %.3g.", chosen.remedy);
    }
    if (chosen.kind == WARNING_FORCED) good = free_forced(core, &chosen, text);
    if (chosen.kind == WARNING_SLOPE) good = switch_off(core, &chosen, text);
    if (chosen.kind == WARNING_PHASE) good = free_phases(core, text);
    if (core_end(core, good)) {
        core_message(core, false, text);
    } else if (chosen.kind == WARNING_FORCED) {
        core_message(core, false, "Free phases would not help here. Move the knots, or change the frequency.");
    } else if (chosen.kind == WARNING_FAR) {
        core_message(core, false, "Neither limits nor a pose would help here. Move the knots.");
    } else if (chosen.kind == WARNING_SWING) {
        core_message(core, false, "Calm, a limit, a knot or a lower frequency would not help here. Move the knots.");
    }
}

static const float SIZE = 7, LIFT = 16, EDGE = 12; ///< half a marker; above its place; from the plot's border

bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2])
{
    const struct rect plot = core->layout.plot;
    xy[0] = plot.x + EDGE;
    xy[1] = plot.y + EDGE;
    if (warning->kind == WARNING_RATE) return true;
    xy[0] = curves_x(curves, core, warning->frame);
    xy[1] = fminf(fmaxf(curves_y_of(curves, core, warning->spline, warning->value) - LIFT, plot.y + EDGE),
                  plot.y + plot.h - EDGE);
    return xy[0] >= plot.x && xy[0] <= plot.x + plot.w;
}

bool curves_warning(const struct curves *curves, const struct core *core, double number, float xy[2])
{
    bool there = number >= 0 && number < curves->warnings.count;
    return there && warning_place(curves, core, &curves->warnings.list[(int)number], xy);
}

/// What a click does about it.
static void put_remedy(const struct warning *warning, enum far_remedy far, char remedy[96])
{
    switch (warning->kind) {
    case WARNING_FAR:
        if (far == FAR_CALM) snprintf(remedy, 96, "Click to raise calm to 1.");
        if (far == FAR_LIMITS)
            snprintf(remedy, 96, "Click to set limits from %.6g to %.6g, which leave the smallest swing.",
                     warning->low, warning->high);
        if (far == FAR_POSE)
            snprintf(remedy, 96, "Click to add a pose at frame %.6g, which leaves the smallest swing.",
                     warning->frame);
        if (far == FAR_NOTHING) snprintf(remedy, 96, "Neither limits nor a pose would help. Move the knots.");
        break;
    case WARNING_SWING:
        snprintf(remedy, 96, "Click to tame it with more calm, a knot at the peak or a lower frequency.");
        break;
    case WARNING_RATE:
        snprintf(remedy, 96, "Click to use %.0f substeps per frame.", warning->remedy);
        break;
    case WARNING_DRIFT:
        snprintf(remedy, 96, "Click to narrow it to %.3g.", warning->remedy);
        break;
    case WARNING_FORCED:
        snprintf(remedy, 96, "Click to free the phase of one of the poses, or of both.");
        break;
    case WARNING_SLOPE:
        snprintf(remedy, 96, "Click to switch it off.");
        break;
    case WARNING_PHASE:
        snprintf(remedy, 96, "Click to free the phases of the spline's knots.");
        break;
    }
}

/// The warning under the pointer, or NULL.
static const struct warning *hovered_warning(const struct curves *curves, const struct core *core)
{
    int index = core->hover.handle;
    if (core->hover.kind != HOVER_WARNING || index >= curves->warnings.count) return NULL;
    return &curves->warnings.list[index];
}

void warnings_try(struct curves *curves, const struct core *core)
{
    const struct warning *warning = hovered_warning(curves, core);
    if (!warning || warning->kind != WARNING_FAR || core->drag.owner) return;
    enum far_remedy *far = &curves->far[warning - curves->warnings.list];
    if (*far == FAR_UNTRIED) *far = choose_far(core, warning);
}

static void show_marker(struct drawlist *list, const float xy[2], bool hovered)
{
    const float x = xy[0], y = xy[1], r = hovered ? SIZE + 1.5f : SIZE;
    const float corners[] = {x, y - r, x + r, y + 0.8f * r, x - r, y + 0.8f * r};
    drawlist_convex(list, corners, 3, theme()->warning);
    drawlist_rect(list, (struct rect){x - 0.75f, y - 0.4f * r, 1.5f, 0.6f * r}, theme()->panel);
    drawlist_rect(list, (struct rect){x - 0.75f, y + 0.38f * r, 1.5f, 1.5f}, theme()->panel);
}

void warnings_show(const struct curves *curves, struct core *core)
{
    const struct warning *hovered = hovered_warning(curves, core);
    for (int i = 0; i < curves->warnings.count; i++) {
        float xy[2];
        const struct warning *warning = &curves->warnings.list[i];
        if (warning_place(curves, core, warning, xy)) show_marker(&core->list, xy, warning == hovered);
    }
}

void warnings_show_words(const struct curves *curves, struct core *core)
{
    enum { PAD = 10, LINE = 18 };
    const struct warning *warning = hovered_warning(curves, core);
    float xy[2];
    if (!warning || !warning_place(curves, core, warning, xy)) return;
    char what[WARNING_SENTENCE], remedy[96] = "";
    warning_say(warning, what);
    put_remedy(warning, curves->far[warning - curves->warnings.list], remedy);
    const struct rect panel = core->layout.curves;
    float width =
        fmaxf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, what), font_width(FONT_LABEL, THEME_TEXT_NORMAL, remedy));
    float w = fminf(width + 2 * PAD, panel.w - 16), h = 2 * LINE + PAD;
    float x = fminf(fmaxf(xy[0] - w / 2, panel.x + 8), panel.x + panel.w - 8 - w);
    float y = xy[1] + 14 + h < panel.y + panel.h ? xy[1] + 14 : xy[1] - 14 - h;
    struct rect box = {roundf(x), roundf(y), w, h};
    drawlist_rounded(&core->list, box, 5, theme()->raised);
    drawlist_rounded_line(&core->list, box, 5, 1, theme_fade(theme()->warning, 0.6f));
    drawlist_text_fit(&core->list, box.x + PAD, box.y + LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, what);
    drawlist_text_fit(&core->list, box.x + PAD, box.y + 2 * LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->warning, remedy);
}
