/// Finds problems: swings that outgrow their knots, frequencies too high for the sample rate, bandwidths that let the phase
/// drift, slopes that have no effect.
#include "editor/curves/warnings.h"
#include "base/hash.h"
#include "editor/core/arrange.h"
#include <math.h>

static const double TWO_PI = 6.283185307179586;
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
    if (spline->spring_friction) return sqrt(fmax(spline->parameter[PARAMETER_SPRING].value, 0)) / TWO_PI;
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
struct span {
    int first, length;
    const struct knot *from, *to;
};

static bool take_span(const struct document *document, const struct spline *spline, int k, struct span *span)
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
static int furthest(const wiggly_curve *curve, const struct span *span)
{
    int best = span->first, period = curve->samples - 1;
    for (int i = 1; i <= span->length; i++) {
        int sample = span->first + i <= period ? span->first + i : span->first + i - period;
        if (height(curve, sample) > height(curve, best)) best = sample;
    }
    return best;
}

static void find_swing(const struct document *document, const wiggly_curve *curve, const struct span *span,
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

static void find_idle_slope(const struct document *document, const struct spline *spline, int k,
                            struct warnings *found)
{
    const struct knot *knot = &spline->knots[k];
    const bool filters = spline->parameter[PARAMETER_PASSIVE].value == WIGGLY_FILTER; // it sees one side alone
    if (!knot->has_slope || filters || k == 0 || k + 1 == spline->knot_count) return;
    if (document_sample(document, knot[1].frame) - document_sample(document, knot[-1].frame) != 2) return;
    add(found, &(struct warning){.kind = WARNING_SLOPE, .frame = knot->frame, .value = knot->value});
}

/// The worst drift alone is kept: its remedy is the others' too.
static void find_drift(const struct document *document, const wiggly_curve *curve, const struct span *span,
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
    const struct spline *spline = &document->splines[of];
    found->count = 0;
    if (of >= evaluation->count || spline_mode(spline) == WIGGLY_CUBIC || evaluation->cubic) return;
    const double frequency = frequency_of(evaluation, spline), bandwidth = bandwidth_of(spline);
    double highest = 0;
    struct warning drift = {0};
    find_rate(document, evaluation, spline, found);
    for (int k = 0; k < spline->knot_count; k++) {
        highest = fmax(highest, height(&evaluation->curves[of], document_sample(document, spline->knots[k].frame)));
        find_idle_slope(document, spline, k, found);
    }
    for (int k = 0; k < spline->knot_count; k++) {
        struct span span;
        if (!take_span(document, spline, k, &span)) continue;
        find_swing(document, &evaluation->curves[of], &span, highest, found);
        find_drift(document, &evaluation->curves[of], &span, frequency, bandwidth, &drift);
    }
    if (drift.amount > 0) add(found, &drift);
}

void warnings_update(struct curves *curves, const struct core *core, const struct editor_world *world)
{
    struct warnings *warnings = &curves->warnings;
    const struct spline *spline = arrange_seen(core, world);
    const struct evaluation *evaluation = world->evaluation;
    bool solved = spline && evaluation && evaluation->samples == document_samples(world->document);
    const uint64_t state[] = {history_revision(world->history), (uint64_t)(core->active + 1), (uint64_t)core->look,
                              solved, evaluation ? evaluation->revision : 0};
    uint64_t key = hash_bytes(HASH_START, state, sizeof state);
    if (key == warnings->key) return;
    warnings->count = 0;
    warnings->key = key;
    if (solved) warnings_find(world->document, evaluation, core->active, warnings);
}
