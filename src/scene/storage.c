/// An evaluation's memory, and the solver's description of a spline.
#include "scene/storage.h"
#include <math.h>
#include <string.h>

/// What a parameter of a spline follows, sample by sample; NULL: a constant, or a motion that is not read yet.
static const double *track_of(const struct evaluation *evaluation, const struct document *document, int spline,
                              enum parameter parameter)
{
    const struct param *param = &document->splines[spline]->parameter[parameter];
    if (param->track >= 0) return evaluation->curves[param->track].total;
    return param->motion ? evaluation_motion(evaluation, spline) : NULL;
}

const double *evaluation_motion(const struct evaluation *evaluation, int spline)
{
    const struct baked *baked = &evaluation->storage->state[spline].baked;
    return baked->key != 0 ? baked->samples : NULL;
}

double evaluation_offset(const struct evaluation *evaluation, const struct document *document, int spline,
                         double position)
{
    bool settles = false;
    if (!evaluation || spline >= evaluation->count || evaluation->samples == 0) return 0;
    const struct spline *of = document->splines[spline];
    for (int k = 0; k < of->knot_count; k++) settles |= of->knots[k].settles;
    if (!settles) return 0;
    const double *own = track_of(evaluation, document, spline, PARAMETER_EQUILIBRIUM);
    const double at = fmin(fmax(position, 0), evaluation->samples - 1),
                 number = of->parameter[PARAMETER_EQUILIBRIUM].value;
    const int i = (int)at, next = i + 1 < evaluation->samples ? i + 1 : i;
    const double *y = evaluation->curves[spline].y;
    const double here = y[i] - (own ? own[i] : number), there = y[next] - (own ? own[next] : number);
    return here + (at - i) * (there - here);
}

wiggly_desc storage_describe(const struct evaluation *evaluation, const struct document *document, int spline,
                             bool cubic)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = document_samples(document);
    desc.step = document_step(document);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        parameter_describe(p, document->splines[spline]->parameter[p].value,
                           track_of(evaluation, document, spline, p), &desc);
    }
    desc.has_low = desc.low > -INFINITY;
    desc.has_high = desc.high < INFINITY;
    if (cubic && desc.mode != WIGGLY_CUBIC) {
        desc.mode = WIGGLY_CUBIC;
        desc.passive = WIGGLY_OSCILLATOR; // holds its last value, so that a tail does not wind through its body
    }
    return desc;
}

void storage_add_knots(wiggly_desc *desc, const struct document *document, int spline, wiggly_knot *knots)
{
    const struct spline *of = document->splines[spline];
    for (int i = 0; i < of->knot_count; i++) {
        const struct knot *knot = &of->knots[i];
        knots[i] = (wiggly_knot){.sample = document_sample(document, knot->frame),
                                 .has_slope = knot->has_slope,
                                 .value = knot->still ? 0 : knot->value,
                                 .slope = knot->slope,
                                 .stiffness = knot->stiffness,
                                 .phase = knot->phase,
                                 .has_phase = knot->has_phase,
                                 .still = knot->still,
                                 .settles = knot->settles};
    }
    desc->knots = knots;
    desc->knot_count = of->knot_count;
}

int storage_knot_room(const struct spline *spline, int samples)
{
    return spline->knot_count + (spline_is_limited(spline) ? samples : 0);
}

void storage_flatten(wiggly_curve *curve, const wiggly_desc *desc)
{
    double *const rows[] = {curve->total, curve->y, curve->re, curve->im, curve->omega};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        memset(rows[r], 0, sizeof(double) * (size_t)desc->samples);
    curve->samples = desc->samples;
    curve->step = desc->step;
    curve->first = 0;
    curve->mode = desc->mode;
    curve->start = WIGGLY_FREE;
}
