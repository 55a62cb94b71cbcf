/// Lays curves out in memory, and describes a spline to the solver.
#include "scene/storage.h"
#include <math.h>
#include <string.h>

void storage_place(wiggly_curve *curve, double *numbers, int samples)
{
    size_t n = (size_t)samples;
    *curve = (wiggly_curve){.total = numbers,
                            .y = numbers + n,
                            .re = numbers + 2 * n,
                            .im = numbers + 3 * n,
                            .omega = numbers + 4 * n,
                            .samples = samples,
                            .mode = WIGGLY_CUBIC};
}

/// What the spline follows in a parameter, sample by sample; NULL: a constant, or a motion that is not baked.
static const double *track_of(const struct storage *storage, const wiggly_curve *curves,
                              const struct document *document, int spline, enum parameter parameter)
{
    const struct param *param = &document->splines[spline]->parameter[parameter];
    if (param->track >= 0) return curves[param->track].total;
    if (!param->motion) return NULL;
    const struct baked *baked = &storage->state[spline].baked;
    return baked->key != 0 ? baked->samples : NULL;
}

wiggly_desc storage_describe(const struct storage *storage, const wiggly_curve *curves,
                             const struct document *document, int spline_index, bool cubic)
{
    const struct spline *spline = document->splines[spline_index];
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = document_samples(document);
    desc.step = document_step(document);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        parameter_describe(p, spline->parameter[p].value, track_of(storage, curves, document, spline_index, p),
                           &desc);
    }
    if (cubic && desc.mode != WIGGLY_CUBIC) {
        desc.mode = WIGGLY_CUBIC;
        desc.passive = WIGGLY_OSCILLATOR; // its last value is held: a tail does not wind through its body
    }
    return desc;
}

wiggly_knot storage_knot(const struct document *document, const struct knot *knot)
{
    return (wiggly_knot){.sample = document_sample(document, knot->frame),
                         .has_slope = knot->has_slope,
                         .value = knot->value,
                         .slope = knot->slope,
                         .stiffness = knot->stiffness};
}

void storage_add_knots(wiggly_desc *desc, const struct document *document, int spline, wiggly_knot *knots)
{
    const struct spline *of = document->splines[spline];
    for (int i = 0; i < of->knot_count; i++) knots[i] = storage_knot(document, &of->knots[i]);
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
    for (int r = 0; r < ROWS; r++) memset(rows[r], 0, sizeof(double) * (size_t)desc->samples);
    curve->samples = desc->samples;
    curve->step = desc->step;
    curve->first = 0;
    curve->mode = desc->mode;
    curve->start = WIGGLY_FREE;
}
