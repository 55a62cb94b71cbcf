/// The slope of a solved curve at a sample.
#include "spline/forced_response.h"
#include "spline/poles.h"
#include <string.h>

/// x without the response to the equilibrium's motion, of which `response` has total and Im, N numbers each; NULL: none.
static cplx made_by_knots(const wiggly_curve *curve, const double *response, int sample)
{
    if (!response) return (cplx){curve->re[sample], curve->im[sample]};
    const double *total = response, *im = total + curve->samples;
    return (cplx){curve->re[sample] - (total[sample] - curve->y[sample]), curve->im[sample] - im[sample]};
}

double curve_slope(const wiggly_desc *desc, const wiggly_curve *curve, int sample, double *room)
{
    const int last = curve->samples - 1;
    const bool loop = desc->start == WIGGLY_LOOP, behind = sample > curve->first || loop, ahead = sample < last;
    if (desc->passive ==
        WIGGLY_FILTER) { // the paper's slope: the step to the next sample; at the last, from the one before
        const int from = ahead ? sample : sample - 1;
        return from < 0 ? 0 : (curve->total[from + 1] - curve->total[from]) / desc->step;
    }

    // The speed of the equilibrium and its response, which knots do not change.
    const double *response = NULL;
    double known = 0;
    if (desc->equilibrium.track && last > 0) {
        const size_t n = (size_t)curve->samples;
        forced_response u = {.total = room, .im = room + n, .speed = room + 2 * n, .room = room + 3 * n};
        response = room;
        memset(room, 0, CURVE_SLOPE_ROOM * n * sizeof *room);
        if (desc->mode == WIGGLY_CUBIC) {
            forced_response_rest(desc, curve->y, &u);
        } else {
            forced_response_find(desc, curve->y, desc->calm, &u);
        }
        known = u.speed[sample];
    }

    // As in the solver's slope rows (rows.c): the speed from both sides, at an end from one; after the last knot, which alone moves it, its own.
    const poles at = poles_at(desc, sample, loop ? LEAST_DAMPING * desc->calm : 0);
    const cplx here = made_by_knots(curve, response, sample);
    if (desc->mode == WIGGLY_COMPLEX && !loop && desc->knot_count > 0 &&
        sample >= desc->knots[desc->knot_count - 1].sample)
        return known + cplx_mul(poles_passive(&at), here).re;
    double sum = 0;
    if (ahead) {
        const speed_form form = poles_speed(&at, desc->step, false);
        const cplx change = cplx_sub(made_by_knots(curve, response, sample + 1), here);
        sum += cplx_mul(form.on_x, here).re + cplx_mul(form.on_e, change).re;
    }
    if (behind) {
        const speed_form form = poles_speed(&at, desc->step, true);
        const cplx change = cplx_sub(here, made_by_knots(curve, response, sample > 0 ? sample - 1 : last - 1));
        sum += cplx_mul(form.on_x, here).re + cplx_mul(form.on_e, change).re;
    }
    return known + (ahead || behind ? sum / ((ahead + behind) * desc->step) : 0);
}
