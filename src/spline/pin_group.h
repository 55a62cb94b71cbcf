/// What a group of splines that share pins works with: splines, the rows that pins and bounds are, their dense system
/// (docs/mathematics.md, Pins). Internal to src/spline.
#ifndef SPLINE_PIN_GROUP_H
#define SPLINE_PIN_GROUP_H

#include "spline/bound_tail.h"
#include "spline/one_sided.h"

/// One spline of a group.
typedef struct pulled {
    wiggly_solver *solver;
    wiggly_desc desc;    ///< the caller's as it was read
    wiggly_curve *curve; ///< the caller's
    problem problem;
    system_pulls pulls;
    double scale;    ///< of the system's compliance, to that of its weighted energy
    bound_tail tail; ///< what bounds press behind the last knot
    double *e;       ///< that, one number a sample
} pulled;

/// One condition: Σ over splines of on[2s] Re x_s + on[2s + 1] Im x_s at a sample is `want`. A bound's is at least that, and `on` is on
/// the sample of each spline that the bound's own is a part of (pin_rows_sample()).
typedef struct pin_row {
    int sample;
    int first, count; ///< the rows of that sample
    double want;
    double soft; ///< by how much it gives way, as a part of the largest eigenvalue of S among the sample's rows
    wiggly_bound *bound; ///< or NULL
} pin_row;

typedef struct pin_rows {
    int count, splines;
    int fixed;       ///< how many of them are the pins'
    pin_row *row;    ///< by sample
    double *on;      ///< 2 × splines numbers a row
    double *scratch; ///< room for the conditions of all pins in one sample
} pin_rows;

/// Numbers of scratch that so many splines and pins need.
size_t pin_rows_scratch(int splines, int pins);

/// Finds the rows of pins that are ordered by sample; `order` holds their indices. Splines without pulls at a sample have no part in it.
void pin_rows_find(pin_rows *rows, const pulled *splines, const wiggly_pin *pins, const int *order, int pin_count);

/// Adds the rows of bounds, whose samples the splines have as pulls by now, but for those that knots and pins hold.
void pin_rows_add_bounds(pin_rows *rows, const pulled *splines, wiggly_bound *bounds, int bound_count);

/// The sample of a posed spline's own at which it is pulled for one at any sample; -1: nowhere.
int pin_rows_sample(const pulled *spline, int sample);

/// What part of all that moves a bound's point knots and pins leave free at its sample.
double pin_rows_reach(const pin_rows *rows, const pulled *splines, const wiggly_bound *bound);

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
