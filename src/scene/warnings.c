/// Finds what is wrong with a solved spline, and says it.
#include "scene/warnings.h"
#include <math.h>
#include <stdio.h>

static const double FAR = 2.5;           ///< of a curve, in heights of its highest knot
static const double MOST_SWING = 2;      ///< of a span, in heights of its knots
static const double LEAST_HEIGHT = 0.75; ///< of a span's knots, as a share of the highest: small ones may ring
static const double MOST_RATE = 0.4;     ///< f·(1 + β) in sample rates; at 0.5 swings alias
static const double MOST_TURN = 0.3;     ///< β · periods between two knots (Figure 4)
static const double MOST_FORCED = 135;   ///< degrees of poses out of step: midway the swing is down to 0.38 of theirs
static const double LEAST_FORCED = 0.4;  ///< magnitude of such poses, as a share of the largest

/// A solved spline that is looked at, and what was found so far, of all splines.
struct look {
    const struct document *document;
    const struct evaluation *evaluation;
    int of;
    const struct spline *spline;
    const wiggly_curve *curve;
    double frequency; ///< the highest, Hz; only where all is looked at
    struct warnings *found;
};

static void add(const struct look *look, struct warning warning)
{
    struct warnings *found = look->found;
    warning.spline = look->of;
    if (found->count < WARNINGS_MAX) found->list[found->count++] = warning;
}

static int sample_of(const struct look *look, const struct knot *knot)
{
    return document_sample(look->document, knot->frame);
}

static double height(const wiggly_curve *curve, int sample) { return fabs(curve->total[sample] - curve->y[sample]); }

/// How far the knots are from the equilibrium at most; a still one is not.
static double highest_knot(const struct look *look)
{
    double highest = 0;
    for (int k = 0; k < look->spline->knot_count; k++) {
        const struct knot *knot = &look->spline->knots[k];
        if (!knot->still) highest = fmax(highest, height(look->curve, sample_of(look, knot)));
    }
    return highest;
}

/// Its sample furthest from the equilibrium, and from where to where that moves.
static int peak_of(const wiggly_curve *curve, double range[2])
{
    int peak = 0;
    range[0] = range[1] = curve->y[0];
    for (int i = 1; i < curve->samples; i++) {
        const double y = curve->y[i];
        range[0] = y < range[0] ? y : range[0];
        range[1] = y > range[1] ? y : range[1];
        if (height(curve, i) > height(curve, peak)) peak = i;
    }
    return peak;
}

/// Limits beyond where the equilibrium moves by the highest knot and a little more, in numbers of few digits.
static void set_limits(struct warning *warning, const double range[2], double highest)
{
    const double room = 1.15 * highest, digits = pow(10, 1 - floor(log10(room)));
    warning->low = floor((range[0] - room) * digits) / digits;
    warning->high = ceil((range[1] + room) * digits) / digits;
}

/// The sample of the peak, or -1. A moving equilibrium swings the curve, too, without any knot.
static int find_far(const struct look *look)
{
    double range[2];
    const wiggly_curve *curve = look->curve;
    if (look->spline->knot_count == 0 || spline_is_limited(look->spline)) return -1;
    const int peak = peak_of(curve, range);
    const double highest = highest_knot(look), farthest = height(curve, peak);
    const double most = FAR * fmax(highest, range[1] - range[0]);
    if (highest <= 0 || farthest <= most) return -1;
    struct warning warning = {.kind = WARNING_FAR,
                              .frame = document_frame(look->document, peak),
                              .value = curve->total[peak],
                              .amount = farthest / highest,
                              .limit = highest,
                              .remedy = curve->y[peak] + copysign(highest, curve->total[peak] - curve->y[peak]),
                              .most = most,
                              .phase = curve->im[peak] * highest / farthest};
    set_limits(&warning, range, highest);
    add(look, warning);
    return peak;
}

/// The highest frequency of the spline in Hz.
static double frequency_of(const struct look *look)
{
    const struct param *param = &look->spline->parameter[PARAMETER_FREQUENCY];
    if (param->track < 0) return param->value;
    const int highest = evaluation_extreme(look->evaluation, param->track, 0, look->evaluation->samples - 1, true);
    return fmax(look->evaluation->curves[param->track].total[highest], 0);
}

static double bandwidth_of(const struct spline *spline)
{
    const struct param *bandwidth = &spline->parameter[PARAMETER_BANDWIDTH];
    return spline_mode(spline) == WIGGLY_COMPLEX && bandwidth->track < 0 ? bandwidth->value : 0;
}

static void find_rate(const struct look *look)
{
    const struct document *document = look->document;
    const double edge = look->frequency * (1 + bandwidth_of(look->spline));
    const double rate = document->fps * document->substeps;
    if (edge <= MOST_RATE * rate) return;
    add(look, (struct warning){.kind = WARNING_RATE,
                               .amount = edge,
                               .limit = MOST_RATE * rate,
                               .remedy = ceil(edge / (MOST_RATE * document->fps))});
}

/// Samples from one knot to the next one, around the end of a loop.
struct knot_span {
    int first, length;
    const struct knot *from, *to;
};

static bool take_span(const struct look *look, int k, struct knot_span *span)
{
    const struct spline *spline = look->spline;
    const bool loop = spline_start(spline) == WIGGLY_LOOP;
    const int count = spline->knot_count;
    if (loop && count > 1) k = (k + count) % count;
    if (k < 0 || k >= count || (k + 1 == count && (!loop || count == 1))) return false;
    span->from = &spline->knots[k];
    span->to = &spline->knots[(k + 1) % count];
    span->first = sample_of(look, span->from);
    span->length = sample_of(look, span->to) - span->first;
    if (span->length <= 0) span->length += document_samples(look->document) - 1;
    return true;
}

/// A sample of a span, which may go on past a loop's seam.
static int sample_in(const struct look *look, const struct knot_span *span, int i)
{
    const int period = look->curve->samples - 1;
    return span->first + i <= period ? span->first + i : span->first + i - period;
}

/// A warning of a span, in its middle.
static struct warning in_middle(const struct look *look, const struct knot_span *span, enum warning_kind kind)
{
    const int middle = sample_in(look, span, span->length / 2);
    return (struct warning){.kind = kind,
                            .frame = document_frame(look->document, middle),
                            .value = look->curve->total[middle],
                            .from = span->from->frame,
                            .to = span->to->frame};
}

/// The sample of a span that is furthest from the equilibrium.
static int furthest(const struct look *look, const struct knot_span *span)
{
    int best = span->first;
    for (int i = 1; i <= span->length; i++) {
        const int sample = sample_in(look, span, i);
        if (height(look->curve, sample) > height(look->curve, best)) best = sample;
    }
    return best;
}

/// `far`: the sample that is warned of already, or -1.
static void find_swing(const struct look *look, const struct knot_span *span, double highest, int far)
{
    const wiggly_curve *curve = look->curve;
    const int peak = furthest(look, span);
    const double knots = fmax(height(curve, span->first), height(curve, sample_of(look, span->to)));
    const double limit = fmax(knots, LEAST_HEIGHT * highest);
    if (height(curve, peak) <= MOST_SWING * limit || limit <= 0 || peak == far) return;
    add(look, (struct warning){.kind = WARNING_SWING,
                               .frame = document_frame(look->document, peak),
                               .value = curve->total[peak],
                               .from = span->from->frame,
                               .to = span->to->frame,
                               .amount = height(curve, peak) / limit,
                               .remedy = curve->y[peak] + copysign(limit, curve->total[peak] - curve->y[peak])});
}

/// The worst drift alone is kept: its remedy is the others' too.
static void find_drift(const struct look *look, const struct knot_span *span, struct warning *drift)
{
    const double bandwidth = bandwidth_of(look->spline);
    const double periods = look->frequency * span->length * document_step(look->document);
    if (bandwidth * periods <= MOST_TURN * (1 + 1e-9)) return; /* at the limit is within it, rounding or not */
    if (periods <= drift->amount) return;
    *drift = in_middle(look, span, WARNING_DRIFT);
    drift->amount = periods;
    drift->limit = bandwidth;
    drift->remedy = floor(1000 * MOST_TURN / periods) / 1000;
}

static double magnitude(const struct look *look, const struct knot *knot)
{
    return hypot(knot->value - look->curve->y[sample_of(look, knot)], knot->phase);
}

static double largest_pose(const struct look *look)
{
    double largest = 0;
    for (int k = 0; k < look->spline->knot_count; k++) {
        const struct knot *knot = &look->spline->knots[k];
        if (knot->has_phase) largest = fmax(largest, magnitude(look, knot));
    }
    return largest;
}

/// Degrees by which two neighbouring poses miss each other's swing, beyond what the bandwidth makes up for on the way: from one to the next
/// x turns by ∫ω dt, give or take β of that. 0 within a period, where knots are keys and not yet a swing, and for small poses.
static double degrees_forced(const struct look *look, const struct knot_span *span, double largest)
{
    const wiggly_curve *curve = look->curve;
    const struct knot *const ends[] = {span->from, span->to};
    double turn = 0, angle[2];
    for (int e = 0; e < 2; e++) {
        if (!ends[e]->has_phase || magnitude(look, ends[e]) < LEAST_FORCED * largest) return 0;
        angle[e] = atan2(ends[e]->phase, ends[e]->value - curve->y[sample_of(look, ends[e])]);
    }
    for (int i = 0; i < span->length; i++) {
        const double here = curve->omega[sample_in(look, span, i)], next = curve->omega[sample_in(look, span, i + 1)];
        turn += 0.5 * (here + next) * curve->step;
    }
    if (turn < 2 * M_PI) return 0;
    const double miss = fabs(remainder(angle[1] - angle[0] - turn, 2 * M_PI));
    return (miss - bandwidth_of(look->spline) * turn) * 180 / M_PI;
}

/// Whether poses can be out of step: not where tracks say what moves the curve and how far it adapts.
static bool has_step(const struct spline *spline)
{
    const struct param *equilibrium = &spline->parameter[PARAMETER_EQUILIBRIUM];
    return spline_mode(spline) == WIGGLY_COMPLEX && equilibrium->track < 0 && !equilibrium->motion &&
           spline->parameter[PARAMETER_BANDWIDTH].track < 0;
}

/// The pose to free is the one that is out of step on both sides, else the later one.
static void find_forced(const struct look *look, int k, double largest)
{
    struct knot_span span, before;
    if (!take_span(look, k, &span)) return;
    const double degrees = degrees_forced(look, &span, largest);
    if (degrees <= MOST_FORCED) return;
    const bool both = take_span(look, k - 1, &before) && degrees_forced(look, &before, largest) > MOST_FORCED;
    struct warning warning = in_middle(look, &span, WARNING_FORCED);
    warning.amount = degrees;
    warning.remedy = both ? span.from->frame : span.to->frame;
    add(look, warning);
}

static void find_idle(const struct look *look)
{
    const struct spline *spline = look->spline;
    const int pose = spline_idle_pose(spline);
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        const char *why = knot_idle_slope(look->document, look->of, k);
        struct warning warning = {.kind = WARNING_PHASE, .frame = knot->frame, .value = knot->value, .why = why};
        if (k == pose) add(look, warning);
        warning.kind = WARNING_SLOPE;
        if (why) add(look, warning);
    }
}

static bool look_at(const struct document *document, const struct evaluation *evaluation, int of,
                    struct warnings *found, struct look *look)
{
    if (of < 0 || of >= evaluation->count || evaluation->cubic) return false;
    *look = (struct look){.document = document,
                          .evaluation = evaluation,
                          .of = of,
                          .spline = document->splines[of],
                          .curve = &evaluation->curves[of],
                          .found = found};
    return true;
}

void warnings_add_far(const struct document *document, const struct evaluation *evaluation, int of,
                      struct warnings *found)
{
    struct look look;
    if (look_at(document, evaluation, of, found, &look) && spline_mode(look.spline) != WIGGLY_CUBIC) find_far(&look);
}

void warnings_add_forced(const struct document *document, const struct evaluation *evaluation, int of,
                         struct warnings *found)
{
    struct look look;
    if (!look_at(document, evaluation, of, found, &look) || !has_step(look.spline)) return;
    const double largest = largest_pose(&look);
    for (int k = 0; k < look.spline->knot_count; k++) find_forced(&look, k, largest);
}

void warnings_add(const struct document *document, const struct evaluation *evaluation, int of,
                  struct warnings *found)
{
    struct look look;
    struct warning drift = {0};
    if (!look_at(document, evaluation, of, found, &look)) return;
    const bool swings = spline_mode(look.spline) != WIGGLY_CUBIC;
    const int far = swings ? find_far(&look) : -1;
    const double highest = highest_knot(&look);
    find_idle(&look);
    if (!swings) return;
    look.frequency = frequency_of(&look);
    find_rate(&look);
    for (int k = 0; k < look.spline->knot_count; k++) {
        struct knot_span span;
        if (!take_span(&look, k, &span)) continue;
        find_swing(&look, &span, highest, far);
        find_drift(&look, &span, &drift);
    }
    if (drift.amount > 0) add(&look, drift);
    warnings_add_forced(document, evaluation, of, found);
}

void warning_say(const struct warning *warning, char text[WARNING_SENTENCE])
{
    switch (warning->kind) {
    case WARNING_FAR:
        snprintf(text, WARNING_SENTENCE, "Frame %.6g: the curve swings %.1f times as far as its largest knot.",
                 warning->frame, warning->amount);
        break;
    case WARNING_SWING:
        snprintf(text, WARNING_SENTENCE, "Frames %.6g to %.6g: the curve swings %.1f times as far as its knots.",
                 warning->from, warning->to, warning->amount);
        break;
    case WARNING_RATE:
        snprintf(text, WARNING_SENTENCE,
                 "%.3g Hz is too close to half the sample rate to keep its shape (the limit is %.3g Hz).",
                 warning->amount, warning->limit);
        break;
    case WARNING_DRIFT:
        snprintf(text, WARNING_SENTENCE,
                 "Bandwidth %.3g is too wide for the %.1f periods between frames %.6g and %.6g: the swing drifts out "
                 "of phase.",
                 warning->limit, warning->amount, warning->from, warning->to);
        break;
    case WARNING_FORCED:
        snprintf(text, WARNING_SENTENCE,
                 "Frames %.6g to %.6g: the poses are %.0f degrees out of step, so they break the swing between them.",
                 warning->from, warning->to, warning->amount);
        break;
    case WARNING_SLOPE:
        snprintf(text, WARNING_SENTENCE, "Frame %.6g: the slope has no effect: %s.", warning->frame, warning->why);
        break;
    case WARNING_PHASE:
        snprintf(text, WARNING_SENTENCE,
                 "Frame %.6g: the pose holds its value alone, as only complex mode has a phase.", warning->frame);
        break;
    }
}
