/// Finds the problems of a spline and puts them into words: slopes and phases without effect (docs/mathematics.md says what knots hold), and those
/// of its solution.
#include "scene/warnings.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include <math.h>
#include <stdio.h>

static const double FAR = 2;             ///< height of a curve, in heights of knots
static const double FAST_RATE = 0.4;     ///< f·(1 + β) in sample rates; at 0.5 swings alias
static const double LEAST_WIND_UP = 2;   ///< samples
static const double WIDE_TURN = 0.3;     ///< β · periods between two knots (Figure 4)
static const double FORCED_TURN = 120;   ///< degrees of poses out of step: midway the swing is down to half of theirs
static const double MOST_OF_VALUES = 30; ///< degrees out of step by values alone; beyond, freeing a phase cannot help
static const double LEAST_FORCED = 0.4;  ///< magnitude of such poses, as a share of the largest

static const double FULL =
    0.9539; ///< damping ratio at which ω_d is 0.3 ω_n: from there on a slope says what comes after it

// --- without effect

/// The knot on a sample, or NULL.
static const struct knot *knot_on(const struct document *document, const struct spline *spline, int sample)
{
    const int k = spline_find_knot(document, spline, sample);
    return k >= 0 ? &spline->knots[k] : NULL;
}

/// Whether a knot leaves nothing of w free.
static bool is_whole(const struct spline *spline, const struct knot *knot)
{
    return knot && (spline_mode(spline) != WIGGLY_COMPLEX || knot->has_phase || knot->still);
}

/// Why a spline's wind-up has no effect, as the rest of "the wind-up has no effect: "; NULL if it has one, or there is none.
static const char *spline_idle_wind_up(const struct document *document, int of)
{
    const struct spline *spline = document->splines[of];
    if (!(spline->parameter[PARAMETER_WIND_UP].value > 0)) return NULL;
    if (spline_mode(spline) != WIGGLY_COMPLEX) return "only Wiggly splines have one";
    if (spline->parameter[PARAMETER_PASSIVE].value == WIGGLY_FILTER) return "the paper's filter has none";
    if (spline_is_limited(spline)) return "limits need the whole curve";
    return pins_move_spline(document, of) ? "pins need the whole curve" : NULL;
}

bool spline_winds_up(const struct document *document, int of)
{
    return document->splines[of]->parameter[PARAMETER_WIND_UP].value > 0 && !spline_idle_wind_up(document, of);
}

bool spline_uses_calm(const struct document *document, int of)
{
    return !spline_winds_up(document, of) || spline_start(document->splines[of]) == WIGGLY_LOOP;
}

int spline_idle_pose(const struct spline *spline)
{
    if (spline_mode(spline) == WIGGLY_COMPLEX) return -1;
    for (int k = 0; k < spline->knot_count; k++) {
        if (spline->knots[k].has_phase) return k;
    }
    return -1;
}

const char *knot_idle_slope(const struct document *document, int of, int knot)
{
    const struct spline *spline = document->splines[of];
    const struct knot *at = &spline->knots[knot];
    const struct param *damping = &spline->parameter[PARAMETER_DAMPING];
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    const enum wiggly_start start = spline_start(spline);
    const bool loop = start == WIGGLY_LOOP;
    if (!at->has_slope) return NULL;
    if (spline_winds_up(document, of)) { // it takes a slope as a phase
        if (at->has_phase) return "the pose says the phase";
        const bool is_still = !param_follows(frequency) && frequency->value == 0;
        return is_still || (!param_follows(damping) && damping->value >= FULL) ? "the spline hardly swings" : NULL;
    }

    // Solved are a whole loop, the samples from the first knot on, or all after a start at rest.
    const bool outer = knot == 0 || knot + 1 == spline->knot_count;
    const bool pinned = outer && pins_move_spline(document, of); // pins may be beyond it
    const int samples = document_samples(document), sample = document_sample(document, at->frame),
              earliest = document_sample(document, spline->knots[0].frame);
    const int first = start == WIGGLY_FREE || (start == WIGGLY_REST && earliest < 2) ? earliest : 0;
    if ((loop ? samples - 1 : samples - first) < 3 && !pinned) return "there are fewer than three samples";

    // The paper's slope is the step to the next sample; at the last sample, from the one before.
    if (spline->parameter[PARAMETER_PASSIVE].value == WIGGLY_FILTER) {
        const int other = loop ? (sample + 1) % (samples - 1) : sample + 1 < samples ? sample + 1 : sample - 1;
        if (!knot_on(document, spline, other)) return NULL;
        return other < sample && !loop ? "the sample before is a knot too" : "the next sample is a knot too";
    }

    // A Wiggly spline continues after its last knot freely, as the slope there says, or as a track does.
    if (knot + 1 == spline->knot_count && !loop && spline_mode(spline) == WIGGLY_COMPLEX) {
        if (pinned || frequency->track >= 0 || damping->track >= 0) return NULL;
        if (frequency->value > 0 && damping->value < FULL)
            return at->has_phase ? "after the last pose the motion follows from that pose alone" : NULL;
    }

    // The oscillator's slope is a speed measured on both sides, at an end on one.
    const bool complex = spline_mode(spline) == WIGGLY_COMPLEX;
    const int period = samples - 1;
    const int before = loop ? (sample + period - 1) % period : sample - 1;
    const int after = loop ? (sample + 1) % period : sample + 1;
    const bool begins = !loop && sample == first && !pinned, ends = !loop && after == samples;
    if (!is_whole(spline, knot_on(document, spline, sample))) return NULL;
    if (!begins && !is_whole(spline, knot_on(document, spline, before))) return NULL;
    if (!ends && !is_whole(spline, knot_on(document, spline, after))) return NULL;
    if (begins || ends)
        return complex ? "it and the sample beside it hold poses or are still" : "the sample beside it is a knot too";
    return complex ? "it and both samples beside it hold poses or are still" : "both samples beside it have knots";
}

// --- solved splines

/// The solved spline that is checked, and the warnings found so far on all splines.
struct look {
    const struct document *document;
    const struct evaluation *evaluation;
    int of;
    const struct spline *spline;
    const wiggly_curve *curve;
    struct warnings *found;
};

static void add_warning(const struct look *look, struct warning warning)
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

/// How far a knot swings by itself: its distance from the equilibrium, for a pose with its phase; 0 if it is still.
static double knot_height(const struct look *look, const struct knot *knot)
{
    const double height_of_value = knot->still ? 0 : height(look->curve, sample_of(look, knot));
    const bool is_pose = knot->has_phase && spline_mode(look->spline) == WIGGLY_COMPLEX;
    return is_pose ? maths_hypot(height_of_value, knot->phase) : height_of_value;
}

/// How far a spline is expected to swing.
struct measure {
    double knots;     ///< the knots' heights, root mean square, so that a single high one counts little
    double value;     ///< height of the highest knot, without its phase
    double low, high; ///< of the equilibrium
};

static struct measure measure(const struct look *look)
{
    const double *y = look->curve->y;
    struct measure all = {.low = y[0], .high = y[0]};
    double squares = 0;
    int count = 0;
    for (int k = 0; k < look->spline->knot_count; k++) {
        const struct knot *knot = &look->spline->knots[k];
        if (knot->still) continue;
        squares += knot_height(look, knot) * knot_height(look, knot);
        all.value = fmax(all.value, height(look->curve, sample_of(look, knot)));
        count++;
    }
    all.knots = count > 0 ? sqrt(squares / count) : 0;
    for (int i = 1; i < look->curve->samples; i++) {
        if (y[i] < all.low) all.low = y[i];
        if (y[i] > all.high) all.high = y[i];
    }
    return all;
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

/// Where a curve exceeds its expected swing the most.
struct far {
    int sample;
    double times, limit; ///< height = times · FAR · limit
};

/// Allowed is twice the height of the knots around, of the average knot, or of the equilibrium's range; without swinging knots, anything.
static struct far find_farthest(const struct look *look)
{
    struct far far = {0};
    const struct knot *knots = look->spline->knots;
    const int count = look->spline->knot_count, last = count - 1;
    const bool loop = spline_start(look->spline) == WIGGLY_LOOP;
    const struct measure all = measure(look);
    const double least = fmax(all.knots, all.high - all.low);
    for (int k = 0; k <= count && all.knots > 0; k++) {
        const struct knot *before = &knots[k > 0 ? k - 1 : loop ? last : 0];
        const struct knot *after = &knots[k < count ? k : loop ? 0 : last];
        const int from = k > 0 ? sample_of(look, before) : 0;
        const int to = k < count ? sample_of(look, after) : look->curve->samples - 1;
        const double limit = fmax(least, fmax(knot_height(look, before), knot_height(look, after)));
        for (int i = from; i <= to; i++) {
            const double times = height(look->curve, i) / (FAR * limit);
            if (times > far.times) far = (struct far){.sample = i, .times = times, .limit = limit};
        }
    }
    return far;
}

void warnings_add_far(const struct document *document, const struct evaluation *evaluation, int of,
                      struct warnings *found)
{
    struct look look;
    if (!look_at(document, evaluation, of, found, &look) || spline_winds_up(document, of)) return;
    const wiggly_curve *curve = look.curve;
    const struct far far = find_farthest(&look);
    const int peak = far.sample;
    if (spline_mode(look.spline) == WIGGLY_CUBIC || far.times <= 1 || spline_is_limited(look.spline)) return;
    struct warning warning = {.kind = WARNING_FAR,
                              .frame = document_frame(look.document, peak),
                              .value = curve->total[peak],
                              .remedy = curve->y[peak] + copysign(far.limit, curve->total[peak] - curve->y[peak]),
                              .phase = curve->im[peak] * far.limit / height(curve, peak)};

    // Limits, in short numbers: the equilibrium's range plus a little more than the highest knot on either side.
    const struct measure all = measure(&look);
    const double room = 1.15 * (all.value > 0 ? all.value : all.knots);
    const double digits = maths_power_of_ten(1 - maths_decade(room));
    warning.low = floor((all.low - room) * digits) / digits;
    warning.high = ceil((all.high + room) * digits) / digits;
    add_warning(&look, warning);
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

/// The highest frequency of the swing, Hz, and the highest that keeps its shape.
static double edge_of(const struct look *look) { return frequency_of(look) * (1 + bandwidth_of(look->spline)); }
static double edge_allowed(const struct look *look)
{
    return FAST_RATE * look->document->fps * look->document->substeps;
}

/// Samples from one knot to the next, also across a loop's seam.
struct knot_span {
    int first, length;
    const struct knot *from, *to;
};

static bool take_span(const struct look *look, int k, struct knot_span *span)
{
    const struct spline *spline = look->spline;
    const int count = spline->knot_count;
    if (k < 0 || count < 2 || (k + 1 == count && spline_start(spline) != WIGGLY_LOOP)) return false;
    span->from = &spline->knots[k];
    span->to = &spline->knots[(k + 1) % count];
    span->first = sample_of(look, span->from);
    span->length = sample_of(look, span->to) - span->first;
    if (span->length <= 0) span->length += document_samples(look->document) - 1;
    return true;
}

static int sample_in(const struct look *look, const struct knot_span *span, int i)
{
    const int period = look->curve->samples - 1;
    return span->first + i <= period ? span->first + i : span->first + i - period;
}

/// A warning placed in the middle of a span.
static struct warning in_middle(const struct look *look, const struct knot_span *span, enum warning_kind kind)
{
    const int middle = sample_in(look, span, span->length / 2);
    return (struct warning){.kind = kind,
                            .frame = document_frame(look->document, middle),
                            .value = look->curve->total[middle],
                            .from = span->from->frame,
                            .to = span->to->frame};
}

/// Whether the curve does not leave its equilibrium.
static bool is_flat(const struct look *look, const struct knot_span *span)
{
    double highest = 0;
    for (int i = 0; i <= span->length; i++) highest = fmax(highest, height(look->curve, sample_in(look, span, i)));
    return highest <= 1e-9 * fmax(1, fabs(look->curve->y[span->first]));
}

static double degrees_between(double a, double b) { return fabs(remainder(a - b, 2 * M_PI)) * 180 / M_PI; }

/// The least degrees by which a knot without a phase is out of step: its value gives only the sign of Re x.
static double degrees_if_free(double angle, const struct knot *knot, double y)
{
    return fmax(0, degrees_between(angle, knot->value < y ? M_PI : 0) - 90);
}

/// Degrees by which two neighbouring poses are out of step, minus the share β of the turn that the bandwidth absorbs. 0 if their phases are
/// not the cause: if poses are small, less than a period apart, or out of step by their values alone.
static double degrees_forced(const struct look *look, const struct knot_span *span, double largest)
{
    const struct knot *const ends[] = {span->from, span->to};
    const double *omega = look->curve->omega;
    double angle[2], y[2], turn = 0; // the angle by which a free x turns from one knot to the next, ∫ω dt
    for (int i = 0; i < span->length; i++)
        turn += 0.5 * (omega[sample_in(look, span, i)] + omega[sample_in(look, span, i + 1)]) * look->curve->step;
    for (int e = 0; e < 2; e++) {
        if (!ends[e]->has_phase || knot_height(look, ends[e]) < LEAST_FORCED * largest) return 0;
        y[e] = look->curve->y[sample_of(look, ends[e])];
        angle[e] = maths_atan2(ends[e]->phase, ends[e]->value - y[e]);
    }
    const double miss = degrees_between(angle[1] - angle[0], turn);
    const double freed = fmin(degrees_if_free(angle[0] + turn, ends[1], y[1]), //
                              degrees_if_free(angle[1] - turn, ends[0], y[0]));
    if (turn < 2 * M_PI || freed > MOST_OF_VALUES) return 0;
    return miss - bandwidth_of(look->spline) * turn * 180 / M_PI;
}

double warning_left(const struct warning *warning, const struct document *document,
                    const struct evaluation *evaluation)
{
    struct look look;
    if (!look_at(document, evaluation, warning->spline, NULL, &look)) return INFINITY;
    if (warning->kind == WARNING_FAR) return find_farthest(&look).times;
    if (warning->kind == WARNING_RATE) return edge_of(&look) / edge_allowed(&look);

    // The smaller swing of two poses, divided by the smallest swing between them.
    struct knot_span span;
    const int first = document_sample(document, warning->from);
    if (!take_span(&look, spline_find_knot(document, look.spline, first), &span)) return INFINITY;
    double least = INFINITY, ends = INFINITY;
    for (int i = 0; i <= span.length; i++) {
        const int sample = sample_in(&look, &span, i);
        const double here = maths_hypot(look.curve->re[sample], look.curve->im[sample]);
        least = fmin(least, here);
        if (i == 0 || i == span.length) ends = fmin(ends, here);
    }
    return ends > 0 ? ends / least : INFINITY;
}

void warnings_add_forced(const struct document *document, const struct evaluation *evaluation, int of,
                         struct warnings *found)
{
    struct look look;
    if (!look_at(document, evaluation, of, found, &look)) return;
    const struct spline *spline = look.spline;
    const struct param *equilibrium = &spline->parameter[PARAMETER_EQUILIBRIUM];
    if (spline_mode(spline) != WIGGLY_COMPLEX || param_follows(equilibrium) ||
        spline->parameter[PARAMETER_BANDWIDTH].track >= 0)
        return; // poses cannot be out of step
    double largest = 0;
    for (int k = 0; k < spline->knot_count; k++) {
        if (spline->knots[k].has_phase) largest = fmax(largest, knot_height(&look, &spline->knots[k]));
    }
    for (int k = 0; k < spline->knot_count; k++) {
        struct knot_span span;
        if (!take_span(&look, k, &span)) continue;
        struct warning warning = in_middle(&look, &span, WARNING_FORCED);
        warning.amount = degrees_forced(&look, &span, largest);
        if (warning.amount > FORCED_TURN) add_warning(&look, warning);
    }
}

void warnings_add(const struct document *document, const struct evaluation *evaluation, int of,
                  struct warnings *found)
{
    struct look look;
    if (!look_at(document, evaluation, of, found, &look)) return;
    const struct spline *spline = look.spline;
    const bool is_cubic = spline_mode(spline) == WIGGLY_CUBIC;
    warnings_add_far(document, evaluation, of, found);

    const int pose = spline_idle_pose(spline);
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        const char *why = knot_idle_slope(document, of, k);
        struct warning idle = {.kind = WARNING_PHASE, .frame = knot->frame, .value = knot->value, .why = why};
        if (k == pose) add_warning(&look, idle);
        idle.kind = WARNING_SLOPE;
        if (why) add_warning(&look, idle);
    }

    const double wind_up = spline->parameter[PARAMETER_WIND_UP].value, frequency = frequency_of(&look);
    const double samples = wind_up / (frequency * document_step(document));
    const char *why = spline_idle_wind_up(document, of);
    if (why && spline_mode(spline) == WIGGLY_COMPLEX)
        add_warning(&look, (struct warning){.kind = WARNING_WIND_UP, .why = why});
    if (wind_up > 0 && !why && samples < LEAST_WIND_UP)
        add_warning(&look, (struct warning){.kind = WARNING_SUDDEN,
                                            .amount = samples,
                                            .remedy = ceil(100 * wind_up * LEAST_WIND_UP / samples) / 100});

    for (int k = 0; k < spline->knot_count && is_cubic; k++) {
        const struct knot *knot = &spline->knots[k];
        if (!knot->settles) continue;
        add_warning(&look, (struct warning){.kind = WARNING_SETTLES, .frame = knot->frame, .value = knot->value});
        break;
    }
    if (is_cubic) return;

    const double edge = edge_of(&look), allowed = edge_allowed(&look);
    if (edge > allowed)
        add_warning(&look, (struct warning){.kind = WARNING_RATE,
                                            .amount = edge,
                                            .limit = allowed,
                                            .remedy = ceil(edge / (FAST_RATE * document->fps))});
    if (spline_winds_up(document, of)) return; // what follows is about the whole curve

    struct warning drift = {0}; // only the worst, because its remedy cures the others, too
    for (int k = 0; k < spline->knot_count; k++) {
        struct knot_span span;
        if (!take_span(&look, k, &span)) continue;
        const double periods = frequency * span.length * document_step(document);
        const double most = WIDE_TURN * (1 + 1e-9); // allows for rounding
        if (bandwidth_of(spline) * periods <= most || periods <= drift.amount || is_flat(&look, &span)) continue;
        drift = in_middle(&look, &span, WARNING_DRIFT);
        drift.amount = periods;
        drift.limit = bandwidth_of(spline);
        drift.remedy = floor(1000 * WIDE_TURN / periods) / 1000;
    }
    if (drift.amount > 0) add_warning(&look, drift);
    warnings_add_forced(document, evaluation, of, found);
}

void warning_say(const struct warning *w, char text[WARNING_SENTENCE])
{
    const size_t size = WARNING_SENTENCE;
    switch (w->kind) {
    case WARNING_FAR:
        snprintf(text, size, "Frame %.6g: the curve swings to %.3g, far beyond the knots around it.", w->frame,
                 w->value);
        break;
    case WARNING_RATE:
        snprintf(text, size, "%.3g Hz is too close to half the sample rate to keep its shape (the limit is %.3g Hz).",
                 w->amount, w->limit);
        break;
    case WARNING_DRIFT:
        snprintf(text, size,
                 "Frames %.6g to %.6g: the swing drifts, because bandwidth %.3g is too wide for %.1f periods.",
                 w->from, w->to, w->limit, w->amount);
        break;
    case WARNING_FORCED:
        snprintf(text, size,
                 "Frames %.6g to %.6g: the poses are %.0f degrees out of step, so they break the swing between them.",
                 w->from, w->to, w->amount);
        break;
    case WARNING_SLOPE:
        snprintf(text, size, "Frame %.6g: the slope has no effect: %s.", w->frame, w->why);
        break;
    case WARNING_WIND_UP:
        snprintf(text, size, "The wind-up has no effect: %s.", w->why);
        break;
    case WARNING_SUDDEN:
        snprintf(text, size, "The wind-up is %.2g samples long at the highest frequency: below two, it is a jerk.",
                 w->amount);
        break;
    case WARNING_SETTLES:
        snprintf(text, size, "Frame %.6g: the knot does not settle, because a Cubic does not swing.", w->frame);
        break;
    case WARNING_PHASE:
        snprintf(text, size, "Frame %.6g: the pose holds only its value, because only Wiggly splines have a phase.",
                 w->frame);
        break;
    }
}
