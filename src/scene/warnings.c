/// Finds what is wrong with a solved spline, and says it.
#include "scene/warnings.h"
#include <math.h>
#include <stdio.h>

static const double FAR = 3;             ///< of a curve, in heights of its knots
static const double LEAST_OTHER = 0.25;  ///< of the other knots' height, as a share of the largest knot's
static const double FAR_SWING = 2;       ///< of a span, in heights of its knots
static const double LEAST_HEIGHT = 0.75; ///< of a span's knots, as a share of the highest: small ones may ring
static const double FAST_RATE = 0.4;     ///< f·(1 + β) in sample rates; at 0.5 swings alias
static const double WIDE_TURN = 0.3;     ///< β · periods between two knots (Figure 4)
static const double FORCED_TURN = 120;   ///< degrees of poses out of step: midway the swing is down to half of theirs
static const double MOST_OF_VALUES =
    30; ///< degrees by which their values alone may be out of step, or no free phase helps
static const double LEAST_FORCED = 0.4; ///< magnitude of such poses, as a share of the largest

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

/// How far a knot is from the equilibrium, a pose with its phase: so far it swings by itself. A still one is not.
static double knot_height(const struct look *look, const struct knot *knot)
{
    const double height_of_value = knot->still ? 0 : height(look->curve, sample_of(look, knot));
    const bool is_pose = knot->has_phase && spline_mode(look->spline) == WIGGLY_COMPLEX;
    return is_pose ? hypot(height_of_value, knot->phase) : height_of_value;
}

static double highest_knot(const struct look *look)
{
    double highest = 0;
    for (int k = 0; k < look->spline->knot_count; k++)
        highest = fmax(highest, knot_height(look, &look->spline->knots[k]));
    return highest;
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

/// How far a curve may swing: beside its largest knot, up to the knots on either side, more than elsewhere.
struct reach {
    int from, to; ///< samples beside the largest knot; across a loop's seam if `from` is behind `to`
    double largest, other, value,
        most[2];     ///< heights: of the largest knot, the next one, and of the largest value alone
    double range[2]; ///< of the equilibrium
};

static bool is_beside(const struct reach *reach, int sample)
{
    if (reach->from <= reach->to) return sample >= reach->from && sample <= reach->to;
    return sample >= reach->from || sample <= reach->to;
}

/// From the knot before one to the knot after it; a domain's end, or all of a loop, where there is none.
static void set_sides(const struct look *look, int knot, struct reach *reach)
{
    const struct spline *spline = look->spline;
    const int count = spline->knot_count;
    const bool loop = spline_start(spline) == WIGGLY_LOOP && count > 2;
    const bool begins = knot == 0 && !loop, ends = knot + 1 == count && !loop;
    reach->from = begins ? 0 : sample_of(look, &spline->knots[(knot + count - 1) % count]);
    reach->to = ends ? look->curve->samples - 1 : sample_of(look, &spline->knots[(knot + 1) % count]);
}

/// A moving equilibrium swings the curve, too, without any knot.
static struct reach reach_of(const struct look *look)
{
    struct reach reach = {.range = {INFINITY, -INFINITY}};
    int knot = 0;
    for (int k = 0; k < look->spline->knot_count; k++) {
        const struct knot *at = &look->spline->knots[k];
        const double here = knot_height(look, at);
        if (!at->still) reach.value = fmax(reach.value, height(look->curve, sample_of(look, at)));
        reach.other = fmax(reach.other, fmin(here, reach.largest));
        if (here > reach.largest) reach.largest = here, knot = k;
    }
    set_sides(look, knot, &reach);
    for (int i = 0; i < look->curve->samples; i++) {
        const double y = look->curve->y[i];
        reach.range[0] = y < reach.range[0] ? y : reach.range[0];
        reach.range[1] = y > reach.range[1] ? y : reach.range[1];
    }
    const double moves = reach.range[1] - reach.range[0];
    reach.most[true] = FAR * fmax(reach.largest, moves);
    reach.most[false] = FAR * fmax(fmax(reach.other, LEAST_OTHER * reach.largest), moves);
    return reach;
}

/// The sample that is furthest beyond what it may, or least within, and how many times as far as it may.
static int farthest(const wiggly_curve *curve, const struct reach *reach, double *times)
{
    int peak = 0;
    *times = 0;
    for (int i = 0; i < curve->samples; i++) {
        const double here = height(curve, i) / reach->most[is_beside(reach, i)];
        if (here > *times) *times = here, peak = i;
    }
    return peak;
}

/// Limits beyond where the equilibrium moves by the largest value and a little more, in numbers of few digits.
static void set_limits(struct warning *warning, const struct reach *reach)
{
    const double room = 1.15 * (reach->value > 0 ? reach->value : reach->largest);
    const double digits = pow(10, 1 - floor(log10(room)));
    warning->low = floor((reach->range[0] - room) * digits) / digits;
    warning->high = ceil((reach->range[1] + room) * digits) / digits;
}

/// The sample of the peak, or -1.
static int find_far(const struct look *look)
{
    double times;
    const wiggly_curve *curve = look->curve;
    if (look->spline->knot_count == 0 || spline_is_limited(look->spline)) return -1;
    const struct reach reach = reach_of(look);
    if (reach.largest <= 0) return -1;
    const int peak = farthest(curve, &reach, &times);
    const bool beside = is_beside(&reach, peak);
    const double limit = reach.most[beside] / FAR;
    if (times <= 1) return -1;
    struct warning warning = {.kind = WARNING_FAR,
                              .frame = document_frame(look->document, peak),
                              .value = curve->total[peak],
                              .amount = times,
                              .remedy = curve->y[peak] + copysign(limit, curve->total[peak] - curve->y[peak]),
                              .phase = curve->im[peak] * limit / height(curve, peak),
                              .why = beside ? "its largest knot" : "its other knots"};
    set_limits(&warning, &reach);
    add(look, warning);
    return peak;
}

double warning_times_far(const struct document *document, const struct evaluation *before,
                         const struct evaluation *after, int of)
{
    double times;
    struct look look;
    if (!look_at(document, before, of, NULL, &look)) return 0;
    const struct reach reach = reach_of(&look);
    farthest(&after->curves[of], &reach, &times);
    return times;
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
    if (edge <= FAST_RATE * rate) return;
    add(look, (struct warning){.kind = WARNING_RATE,
                               .amount = edge,
                               .limit = FAST_RATE * rate,
                               .remedy = ceil(edge / (FAST_RATE * document->fps))});
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
    const double knots = fmax(knot_height(look, span->from), knot_height(look, span->to));
    const double limit = fmax(knots, LEAST_HEIGHT * highest);
    if (height(curve, peak) <= FAR_SWING * limit || limit <= 0 || peak == far) return;
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
    if (bandwidth * periods <= WIDE_TURN * (1 + 1e-9)) return; /* at the limit is within it, rounding or not */
    if (periods <= drift->amount) return;
    *drift = in_middle(look, span, WARNING_DRIFT);
    drift->amount = periods;
    drift->limit = bandwidth;
    drift->remedy = floor(1000 * WIDE_TURN / periods) / 1000;
}

static double largest_pose(const struct look *look)
{
    double largest = 0;
    for (int k = 0; k < look->spline->knot_count; k++) {
        const struct knot *knot = &look->spline->knots[k];
        if (knot->has_phase) largest = fmax(largest, knot_height(look, knot));
    }
    return largest;
}

static double degrees_between(double a, double b) { return fabs(remainder(a - b, 2 * M_PI)) * 180 / M_PI; }

/// How far a free knot is out of step at least: its value says the side alone on which x is.
static double degrees_if_free(double angle, const struct knot *knot, double y)
{
    return fmax(0, degrees_between(angle, knot->value < y ? M_PI : 0) - 90);
}

/// By what angle x turns from one knot to the next if it is left to itself, ∫ω dt.
static double turn_of(const struct look *look, const struct knot_span *span)
{
    const double *omega = look->curve->omega;
    double turn = 0;
    for (int i = 0; i < span->length; i++)
        turn += 0.5 * (omega[sample_in(look, span, i)] + omega[sample_in(look, span, i + 1)]) * look->curve->step;
    return turn;
}

/// Degrees by which two neighbouring poses miss each other's swing, beyond the part β of the turn that the bandwidth makes up for. 0 where
/// that is no matter of their phases: for small poses, within a period, where knots are keys and not yet a swing, and where their values alone
/// are out of step as well.
static double degrees_forced(const struct look *look, const struct knot_span *span, double largest)
{
    const struct knot *const ends[] = {span->from, span->to};
    const double turn = turn_of(look, span);
    double angle[2], y[2];
    for (int e = 0; e < 2; e++) {
        if (!ends[e]->has_phase || knot_height(look, ends[e]) < LEAST_FORCED * largest) return 0;
        y[e] = look->curve->y[sample_of(look, ends[e])];
        angle[e] = atan2(ends[e]->phase, ends[e]->value - y[e]);
    }
    const double miss = degrees_between(angle[1] - angle[0], turn);
    const double freed = fmin(degrees_if_free(angle[0] + turn, ends[1], y[1]), //
                              degrees_if_free(angle[1] - turn, ends[0], y[0]));
    if (turn < 2 * M_PI || freed > MOST_OF_VALUES) return 0;
    return miss - bandwidth_of(look->spline) * turn * 180 / M_PI;
}

/// Whether poses can be out of step: not where tracks say what moves the curve and how far it adapts.
static bool has_step(const struct spline *spline)
{
    const struct param *equilibrium = &spline->parameter[PARAMETER_EQUILIBRIUM];
    return spline_mode(spline) == WIGGLY_COMPLEX && equilibrium->track < 0 && !equilibrium->motion &&
           spline->parameter[PARAMETER_BANDWIDTH].track < 0;
}

static void find_forced(const struct look *look, int k, double largest)
{
    struct knot_span span;
    if (!take_span(look, k, &span)) return;
    struct warning warning = in_middle(look, &span, WARNING_FORCED);
    warning.amount = degrees_forced(look, &span, largest);
    if (warning.amount > FORCED_TURN) add(look, warning);
}

double warning_swing_left(const struct warning *warning, const struct document *document,
                          const struct evaluation *evaluation)
{
    struct look look;
    struct knot_span span;
    const int first = document_sample(document, warning->from);
    if (!look_at(document, evaluation, warning->spline, NULL, &look)) return 0;
    if (!take_span(&look, spline_find_knot(document, look.spline, first), &span)) return 0;
    double least = INFINITY, ends = INFINITY;
    for (int i = 0; i <= span.length; i++) {
        const int sample = sample_in(&look, &span, i);
        const double here = hypot(look.curve->re[sample], look.curve->im[sample]);
        least = fmin(least, here);
        if (i == 0 || i == span.length) ends = fmin(ends, here);
    }
    return ends > 0 ? least / ends : 0;
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
        snprintf(text, WARNING_SENTENCE, "Frame %.6g: the curve swings to %.3g, far beyond %s.", warning->frame,
                 warning->value, warning->why);
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
