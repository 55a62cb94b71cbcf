/// The slope of a solved spline at a sample: a knot with this slope and the curve's value does not change the curve.
#include "base/need.h"
#include "scene/storage.h"
#include "spline/forced_response.h"
#include "spline/poles.h"
#include <stdlib.h>

static const double LEAST_DAMPING = 0.05; ///< of a loop, times calm

/// A spline at a sample, and its x without the response to the equilibrium's motion.
struct place {
    wiggly_desc desc;
    const wiggly_curve *curve;
    double *answer; ///< total, Im and speed of the response to the equilibrium's motion, N numbers each; NULL: none
    double damping; ///< lowest damping
    bool tail;      ///< after the last knot, so that only that knot moves it
    int sample;
};

static cplx made_by_knots(const struct place *place, int sample)
{
    const wiggly_curve *curve = place->curve;
    if (!place->answer) return (cplx){curve->re[sample], curve->im[sample]};
    const double *total = place->answer, *im = total + curve->samples;
    return (cplx){curve->re[sample] - (total[sample] - curve->y[sample]), curve->im[sample] - im[sample]};
}

/// As in the solver's slope rows (src/spline/rows.c): the speed from both sides, at an end from one.
static double speed_of_knots(const struct place *place)
{
    const wiggly_desc *desc = &place->desc;
    const int i = place->sample, last = place->curve->samples - 1;
    const bool loop = desc->start == WIGGLY_LOOP, behind = i > place->curve->first || loop, ahead = i < last;
    const poles at = poles_at(desc, i, place->damping);
    const cplx here = made_by_knots(place, i);
    if (place->tail) return cplx_mul(poles_passive(&at), here).re;
    double sum = 0;
    if (ahead) {
        const speed_form form = poles_speed(&at, desc->step, false);
        const cplx change = cplx_sub(made_by_knots(place, i + 1), here);
        sum += cplx_mul(form.on_x, here).re + cplx_mul(form.on_e, change).re;
    }
    if (behind) {
        const speed_form form = poles_speed(&at, desc->step, true);
        const cplx change = cplx_sub(here, made_by_knots(place, i > 0 ? i - 1 : last - 1));
        sum += cplx_mul(form.on_x, here).re + cplx_mul(form.on_e, change).re;
    }
    return ahead || behind ? sum / ((ahead + behind) * desc->step) : 0;
}

/// The paper's slope: the step to the next sample; at the last sample, from the one before.
static double step_ahead(const wiggly_curve *curve, int sample, double step)
{
    const int from = sample + 1 < curve->samples ? sample : sample - 1;
    return from < 0 ? 0 : (curve->total[from + 1] - curve->total[from]) / step;
}

/// The speed of the equilibrium and its response, which knots do not change.
static double speed_of_equilibrium(struct place *place)
{
    const double *y = place->curve->y;
    const size_t n = (size_t)place->curve->samples;
    forced_response u = {.total = place->answer, .im = place->answer + n, .speed = place->answer + 2 * n};
    if (place->desc.mode == WIGGLY_CUBIC) {
        for (size_t i = 0; i < n; i++) u.total[i] = y[i];
    } else {
        forced_response_find(&place->desc, y, place->desc.calm, &u);
    }
    return forced_response_speed(&place->desc, y, &u, place->sample);
}

double evaluation_slope(const struct evaluation *evaluation, const struct document *document, int spline, int sample)
{
    bool solved =
        evaluation && spline >= 0 && spline < evaluation->count && evaluation->samples > sample && sample >= 0;
    if (!solved) return 0;
    struct place place = {.desc = storage_describe(evaluation, document, spline, evaluation->cubic),
                          .curve = &evaluation->curves[spline],
                          .sample = sample};
    const struct spline *of = document->splines[spline];
    const bool loop = place.desc.start == WIGGLY_LOOP;
    if (place.desc.passive == WIGGLY_FILTER) return step_ahead(place.curve, sample, place.desc.step);
    place.damping = loop ? LEAST_DAMPING * place.desc.calm : 0;
    place.tail = place.desc.mode == WIGGLY_COMPLEX && !loop && of->knot_count > 0 &&
                 sample >= document_sample(document, of->knots[of->knot_count - 1].frame);
    double known = 0;
    if (place.desc.equilibrium.track && place.curve->samples > 1) {
        place.answer = need_zeroed(3 * (size_t)place.curve->samples, sizeof *place.answer);
        known = speed_of_equilibrium(&place);
    }
    const double slope = known + speed_of_knots(&place);
    free(place.answer);
    return slope;
}
