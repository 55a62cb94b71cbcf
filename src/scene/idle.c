/// Slopes and phases without effect (docs/mathematics.md says what knots hold).
#include "scene/pins.h"
#include "scene/warnings.h"

static const double FULL =
    0.9539; ///< damping ratio at which ω_d is 0.3 ω_n: from there on a slope says what comes after it

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

/// Number of samples that are solved: a whole loop, the samples from the first knot on, or all after a start at rest.
static int samples_solved(const struct document *document, const struct spline *spline, int *first)
{
    const int samples = document_samples(document), earliest = document_sample(document, spline->knots[0].frame);
    const enum wiggly_start start = spline_start(spline);
    *first = start == WIGGLY_FREE || (start == WIGGLY_REST && earliest < 2) ? earliest : 0;
    return start == WIGGLY_LOOP ? samples - 1 : samples - *first;
}

/// The paper's slope is the step to the next sample; at the last sample, from the one before.
static const char *idle_step(const struct document *document, const struct spline *spline, int sample)
{
    const int samples = document_samples(document);
    const bool loop = spline_start(spline) == WIGGLY_LOOP;
    const int other = loop ? (sample + 1) % (samples - 1) : sample + 1 < samples ? sample + 1 : sample - 1;
    if (!knot_on(document, spline, other)) return NULL;
    return other < sample && !loop ? "the sample before is a knot too" : "the next sample is a knot too";
}

/// How a complex spline continues after its last knot: 1: freely, 0: as the slope there says, -1: depends on a track.
static int goes_by_itself(const struct spline *spline)
{
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    const struct param *damping = &spline->parameter[PARAMETER_DAMPING];
    if (frequency->track >= 0 || damping->track >= 0) return -1;
    return frequency->value > 0 && damping->value < FULL;
}

/// The oscillator's slope is a speed measured on both sides, at an end on one.
static const char *idle_speed(const struct document *document, const struct spline *spline, int sample, int first,
                              bool pinned)
{
    const bool loop = spline_start(spline) == WIGGLY_LOOP, complex = spline_mode(spline) == WIGGLY_COMPLEX;
    const int samples = document_samples(document), period = samples - 1;
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

const char *spline_idle_wind_up(const struct document *document, int of)
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

/// A spline that winds up takes a slope as a phase.
static const char *idle_phase(const struct spline *spline, const struct knot *knot)
{
    const struct param *damping = &spline->parameter[PARAMETER_DAMPING];
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    if (knot->has_phase) return "the pose says the phase";
    const bool is_still = !param_follows(frequency) && frequency->value == 0;
    return is_still || (!param_follows(damping) && damping->value >= FULL) ? "the spline hardly swings" : NULL;
}

const char *knot_idle_slope(const struct document *document, int of, int knot)
{
    const struct spline *spline = document->splines[of];
    const struct knot *at = &spline->knots[knot];
    int first;
    if (!at->has_slope) return NULL;
    if (spline_winds_up(document, of)) return idle_phase(spline, at);
    const bool outer = knot == 0 || knot + 1 == spline->knot_count;
    const bool pinned = outer && pins_move_spline(document, of); // pins may be beyond it
    if (samples_solved(document, spline, &first) < 3 && !pinned) return "there are fewer than three samples";
    const int sample = document_sample(document, at->frame);
    if (spline->parameter[PARAMETER_PASSIVE].value == WIGGLY_FILTER) return idle_step(document, spline, sample);
    const bool last = knot + 1 == spline->knot_count && spline_start(spline) != WIGGLY_LOOP;
    if (last && spline_mode(spline) == WIGGLY_COMPLEX) {
        const int by_itself = pinned ? -1 : goes_by_itself(spline);
        if (by_itself > 0 && at->has_phase) return "after the last pose the motion follows from that pose alone";
        if (by_itself != 0) return NULL;
    }
    return idle_speed(document, spline, sample, first, pinned);
}

int spline_idle_pose(const struct spline *spline)
{
    if (spline_mode(spline) == WIGGLY_COMPLEX) return -1;
    for (int k = 0; k < spline->knot_count; k++) {
        if (spline->knots[k].has_phase) return k;
    }
    return -1;
}
