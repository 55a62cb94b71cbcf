/// Warnings on the active curve: what is found, what a click does about it, and the marks.
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

static const double MOST_SWING = 2;      ///< of a span, in heights of its knots
static const double LEAST_HEIGHT = 0.75; ///< of a span's knots, as a share of the highest: small ones may ring
static const double MOST_RATE = 0.4;     ///< f·(1 + β) in sample rates; at 0.5 swings alias
static const double MOST_TURN = 0.3;     ///< β · periods between two knots (Figure 4)

static void add(struct warnings *found, const struct warning *warning)
{
    if (found->count < WARNINGS_MAX) found->list[found->count++] = *warning;
}

/// The highest frequency of a spline in Hz.
static double frequency_of(const struct evaluation *evaluation, const struct spline *spline)
{
    const struct param *param = &spline->parameter[PARAMETER_FREQUENCY];
    if (param->track < 0) return param->value;
    int highest = evaluation_extreme(evaluation, param->track, 0, evaluation->samples - 1, true);
    return fmax(evaluation->curves[param->track].total[highest], 0);
}

static double bandwidth_of(const struct spline *spline)
{
    const struct param *bandwidth = &spline->parameter[PARAMETER_BANDWIDTH];
    return spline_mode(spline) == WIGGLY_COMPLEX && bandwidth->track < 0 ? bandwidth->value : 0;
}

static void find_rate(const struct document *document, const struct evaluation *evaluation,
                      const struct spline *spline, struct warnings *found)
{
    double edge = frequency_of(evaluation, spline) * (1 + bandwidth_of(spline));
    double rate = document->fps * document->substeps;
    if (edge <= MOST_RATE * rate) return;
    add(found, &(struct warning){.kind = WARNING_RATE,
                                 .amount = edge,
                                 .limit = MOST_RATE * rate,
                                 .remedy = ceil(edge / (MOST_RATE * document->fps))});
}

/// Samples from one knot to the next one, around the end of a loop.
struct knot_span {
    int first, length;
    const struct knot *from, *to;
};

static bool take_span(const struct document *document, const struct spline *spline, int k, struct knot_span *span)
{
    bool loop = spline_start(spline) == WIGGLY_LOOP;
    int next = k + 1;
    if (next == spline->knot_count && (!loop || next < 2)) return false;
    next %= spline->knot_count;
    span->from = &spline->knots[k];
    span->to = &spline->knots[next];
    span->first = document_sample(document, span->from->frame);
    span->length = document_sample(document, span->to->frame) - span->first;
    if (span->length <= 0) span->length += document_samples(document) - 1;
    return true;
}

static double height(const wiggly_curve *curve, int sample) { return fabs(curve->total[sample] - curve->y[sample]); }

/// The sample of a span that is furthest from the equilibrium.
static int furthest(const wiggly_curve *curve, const struct knot_span *span)
{
    int best = span->first, period = curve->samples - 1;
    for (int i = 1; i <= span->length; i++) {
        int sample = span->first + i <= period ? span->first + i : span->first + i - period;
        if (height(curve, sample) > height(curve, best)) best = sample;
    }
    return best;
}

static void find_swing(const struct document *document, const wiggly_curve *curve, const struct knot_span *span,
                       double highest, struct warnings *found)
{
    int last = document_sample(document, span->to->frame), peak = furthest(curve, span);
    double knots = fmax(height(curve, span->first), height(curve, last));
    double limit = fmax(knots, LEAST_HEIGHT * highest);
    if (height(curve, peak) <= MOST_SWING * limit || limit <= 0) return;
    add(found, &(struct warning){.kind = WARNING_SWING,
                                 .frame = document_frame(document, peak),
                                 .value = curve->total[peak],
                                 .from = span->from->frame,
                                 .to = span->to->frame,
                                 .amount = height(curve, peak) / limit,
                                 .remedy = curve->y[peak] + copysign(limit, curve->total[peak] - curve->y[peak])});
}

static void find_idle(const struct document *document, int of, int k, struct warnings *found)
{
    const struct knot *knot = &document->splines[of]->knots[k];
    const char *why = knot_idle_slope(document, of, k);
    if (!why) return;
    add(found, &(struct warning){.kind = WARNING_SLOPE, .frame = knot->frame, .value = knot->value, .why = why});
}

/// Poses outside complex mode: the first one stands for all.
static void find_idle_poses(const struct spline *spline, struct warnings *found)
{
    const int pose = spline_idle_pose(spline);
    if (pose < 0) return;
    const struct knot *knot = &spline->knots[pose];
    add(found, &(struct warning){.kind = WARNING_PHASE, .frame = knot->frame, .value = knot->value});
}

/// The worst drift alone is kept: its remedy is the others' too.
static void find_drift(const struct document *document, const wiggly_curve *curve, const struct knot_span *span,
                       double frequency, double bandwidth, struct warning *drift)
{
    double periods = frequency * span->length * document_step(document);
    if (bandwidth * periods <= MOST_TURN * (1 + 1e-9)) return; /* at the limit is within it, rounding or not */
    if (periods <= drift->amount) return;
    int period = curve->samples - 1, middle = span->first + span->length / 2;
    if (middle > period) middle -= period;
    *drift = (struct warning){.kind = WARNING_DRIFT,
                              .frame = document_frame(document, middle),
                              .value = curve->total[middle],
                              .from = span->from->frame,
                              .to = span->to->frame,
                              .amount = periods,
                              .limit = bandwidth,
                              .remedy = floor(1000 * MOST_TURN / periods) / 1000};
}

void warnings_find(const struct document *document, const struct evaluation *evaluation, int of,
                   struct warnings *found)
{
    const struct spline *spline = document->splines[of];
    found->count = 0;
    if (of >= evaluation->count || evaluation->cubic) return;
    find_idle_poses(spline, found);
    for (int k = 0; k < spline->knot_count; k++) find_idle(document, of, k, found);
    if (spline_mode(spline) == WIGGLY_CUBIC) return;
    const double frequency = frequency_of(evaluation, spline), bandwidth = bandwidth_of(spline);
    double highest = 0;
    struct warning drift = {0};
    find_rate(document, evaluation, spline, found);
    for (int k = 0; k < spline->knot_count; k++) {
        highest = fmax(highest, height(&evaluation->curves[of], document_sample(document, spline->knots[k].frame)));
    }
    for (int k = 0; k < spline->knot_count; k++) {
        struct knot_span span;
        if (!take_span(document, spline, k, &span)) continue;
        find_swing(document, &evaluation->curves[of], &span, highest, found);
        find_drift(document, &evaluation->curves[of], &span, frequency, bandwidth, &drift);
    }
    if (drift.amount > 0) add(found, &drift);
}

void warnings_update(struct curves *curves, const struct core *core)
{
    struct warnings *warnings = &curves->warnings;
    const struct spline *spline = spline_list_seen(core);
    const struct evaluation *evaluation = core->evaluation;
    bool solved = spline && evaluation && evaluation->samples == document_samples(core->document);
    const uint64_t state[] = {history_revision(core->history), (uint64_t)(core->active + 1), (uint64_t)core->look,
                              solved, evaluation ? evaluation->revision : 0};
    uint64_t key = hash_bytes(HASH_START, state, sizeof state);
    if (key == warnings->key) return;
    warnings->count = 0;
    warnings->key = key;
    if (solved) warnings_find(core->document, evaluation, core->active, warnings);
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
    warnings_find(document, &trial, core->active, &found);
    int count = 0;
    for (int i = 0; i < found.count; i++) count += found.list[i].kind == WARNING_SWING;
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

static bool free_phases(struct core *core, char text[96])
{
    const struct spline *spline = core_active_spline(core);
    bool good = true;
    for (int k = 0; k < spline->knot_count && good; k++) {
        struct knot knot = spline->knots[k];
        knot.has_phase = false;
        knot.phase = 0;
        good = core_put_knot(core, core->active, &knot);
        spline = core_active_spline(core);
    }
    snprintf(text, 96, "The knots hold their values alone.");
    return good;
}

static bool switch_off(struct core *core, const struct warning *warning, char text[96])
{
    const struct spline *spline = core_active_spline(core);
    int k = spline_find_knot(core->document, spline, document_sample(core->document, warning->frame));
    if (k < 0) return false;
    struct knot knot = spline->knots[k];
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
    static const char *const labels[] = {[WARNING_SWING] = "Tame swing",
                                         [WARNING_RATE] = "Add substeps",
                                         [WARNING_DRIFT] = "Narrow bandwidth",
                                         [WARNING_SLOPE] = "Slope off",
                                         [WARNING_PHASE] = "Free the phase"};
    const struct warning chosen = *warning;
    char text[96] = "";
    bool good = false;
    if (!core_active_spline(core) || !core_begin(core, labels[chosen.kind], 0)) return;
    if (chosen.kind == WARNING_SWING) good = tame(curves, core, &chosen, text);
    if (chosen.kind == WARNING_RATE) good = resolve_rate(core, &chosen, text);
    if (chosen.kind == WARNING_DRIFT) {
        good = core_set_parameter(core, core->active, PARAMETER_BANDWIDTH, chosen.remedy);
        snprintf(text, sizeof text, "Bandwidth %.3g.", chosen.remedy);
    }
    if (chosen.kind == WARNING_SLOPE) good = switch_off(core, &chosen, text);
    if (chosen.kind == WARNING_PHASE) good = free_phases(core, text);
    if (core_end(core, good)) {
        core_message(core, false, text);
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
    xy[1] = fminf(fmaxf(curves_y(curves, core, warning->value) - LIFT, plot.y + EDGE), plot.y + plot.h - EDGE);
    return xy[0] >= plot.x && xy[0] <= plot.x + plot.w;
}

bool curves_warning(const struct curves *curves, const struct core *core, double number, float xy[2])
{
    bool there = number >= 0 && number < curves->warnings.count;
    return there && warning_place(curves, core, &curves->warnings.list[(int)number], xy);
}

/// What is wrong, and what a click does about it.
static void put_words(const struct warning *warning, char what[160], char remedy[96])
{
    switch (warning->kind) {
    case WARNING_SWING:
        snprintf(what, 160, "Frames %.6g to %.6g: the curve swings %.1f times as far as its knots.", warning->from,
                 warning->to, warning->amount);
        snprintf(remedy, 96, "Click to tame it with more calm, a knot at the peak or a lower frequency.");
        break;
    case WARNING_RATE:
        snprintf(what, 160, "%.3g Hz is too close to half the sample rate to keep its shape (the limit is %.3g Hz).",
                 warning->amount, warning->limit);
        snprintf(remedy, 96, "Click to use %.0f substeps per frame.", warning->remedy);
        break;
    case WARNING_DRIFT:
        snprintf(what, 160,
                 "Bandwidth %.3g is too wide for the %.1f periods between frames %.6g and %.6g: the swing drifts out "
                 "of phase.",
                 warning->limit, warning->amount, warning->from, warning->to);
        snprintf(remedy, 96, "Click to narrow it to %.3g.", warning->remedy);
        break;
    case WARNING_SLOPE:
        snprintf(what, 160, "Frame %.6g: the slope has no effect: %s.", warning->frame, warning->why);
        snprintf(remedy, 96, "Click to switch it off.");
        break;
    case WARNING_PHASE:
        snprintf(what, 160, "Frame %.6g: the pose holds its value alone, as only complex mode has a phase.",
                 warning->frame);
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
    char what[160], remedy[96];
    put_words(warning, what, remedy);
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
