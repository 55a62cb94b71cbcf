/// What a group of splines that share pins works with. Internal to src/spline.
#ifndef SPLINE_PIN_GROUP_H
#define SPLINE_PIN_GROUP_H

#include "spline/one_sided.h"
#include "spline/pin_rows.h"

struct wiggly_group {
    int splines, pins, knots, bounds, places; ///< capacity; places: samples of one spline that are pulled
    pulled *pulled;
    pin_rows rows;
    int *order;         ///< of pins, by sample
    int *pull_of;       ///< of each row, the pull on the spline in hand, or -1
    double *compliance; ///< Z of the spline in hand, 2P × 2P, and what it does without pulls
    double *alone;
    double *answer; ///< Z R of the spline in hand, 2P × rows
    double *system; ///< S, the lower triangle, then its factor
    double *soft;   ///< φ S_max of each row
    double *lambda, *miss;
    double *want;    ///< S λ + miss: only bounds need it, and all below
    double *reduced; ///< S with the pins' rows kept still, and want with it
    double *square;  ///< scratch of the search for bounds that press: bounds × bounds
    double *root, *product, *scale;
    int *pressing;
    double slack; ///< what a bound may be missed by
    one_sided search;
    tail_row *tail_rows; ///< of the spline in hand
    double *e, *pressed; ///< scratch of its tail
};

/// λ of all rows for what they want (g->want), bounds' not below 0; a row may miss that by so much of the largest. false where it is not found.
bool bounds_find_pushes(wiggly_group *g, double near_enough);

#endif
