/// A group of splines that share pins: the splines, the rows of pins and bounds, and their dense system (docs/mathematics.md, Pins). Internal
/// to src/spline.
#ifndef SPLINE_PIN_GROUP_H
#define SPLINE_PIN_GROUP_H

#include "spline/bound_tail.h"
#include "spline/one_sided.h"

/// One spline of a group.
typedef struct pulled {
    wiggly_solver *solver;
    wiggly_desc desc;    ///< the caller's, with defaults
    wiggly_curve *curve; ///< the caller's
    problem problem;
    system_pulls pulls;
    double scale;    ///< of the system's compliance, to that of its weighted energy
    double spread;   ///< √ of the largest D: the most that pulls move any x, in units of √(energy / scale)
    bound_tail tail; ///< the motion that bounds add after the last knot
    double *e;       ///< that motion, one number per sample
} pulled;

/// One condition: Σ over splines of on[2s] Re x_s + on[2s + 1] Im x_s at a sample is `want`. A bound's is at least that, and `on` is on
/// the sample of each spline that the bound's own is a part of (pin_rows_sample()).
typedef struct pin_row {
    int sample;
    int first, count; ///< the rows of that sample
    double want;
    double soft;         ///< its softness, as a share of the largest eigenvalue of S among the sample's rows
    wiggly_bound *bound; ///< or NULL
} pin_row;

typedef struct pin_rows {
    int count, splines;
    int fixed;       ///< how many of them are the pins'
    pin_row *row;    ///< by sample
    double *on;      ///< 2 × splines numbers a row
    double *scratch; ///< memory for the conditions of all pins in one sample
} pin_rows;

/// Numbers of scratch memory for so many splines and pins.
size_t pin_rows_scratch(int splines, int pins);

/// Finds the rows of pins; `order` holds their indices by sample. Splines without pulls at a sample do not take part.
void pin_rows_find(pin_rows *rows, const pulled *splines, const wiggly_pin *pins, const int *order, int pin_count);

/// Adds the rows of bounds, except those that knots and pins determine. The splines have pulls at their samples.
void pin_rows_add_bounds(pin_rows *rows, const pulled *splines, wiggly_bound *bounds, int bound_count);

/// The sample at which a posed spline is pulled for a pull at any sample; -1: nowhere.
int pin_rows_sample(const pulled *spline, int sample);

/// The share of a bound's motion that knots and pins leave free at its sample.
double pin_rows_reach(const pin_rows *rows, const pulled *splines, const wiggly_bound *bound);

struct wiggly_group {
    int splines, pins, knots, bounds, places; ///< capacity; places: pulled samples of one spline
    pulled *pulled;
    pin_rows rows;
    int *order;         ///< of pins, by sample
    int *pull_of;       ///< per row: the pull on the current spline, or -1
    double *compliance; ///< Z of the current spline, 2P × 2P, and its motion without pulls
    double *alone;
    double *answer; ///< Z R of the current spline, 2P × rows
    double *system; ///< S, the lower triangle, then its factor
    double *soft;   ///< φ S_max of each row
    double *lambda, *miss;
    double *want;    ///< S λ + miss; needed, like all below, only for bounds
    double *reduced; ///< S with the pins' rows held, and want likewise
    double *square;  ///< scratch of the search for bounds that press: bounds × bounds
    double *root, *product, *scale;
    int *pressing;
    bool *presses;
    double slack; ///< tolerance of bounds
    double unit;  ///< a power of two that all values are multiplied by
    one_sided search;
    tail_row *tail_rows; ///< of the current spline
    double *e, *pressed; ///< scratch of its tail
};

/// λ for the rows' targets g->want, not below 0 for bounds; a row may miss by this share of the largest. false if it is not found.
bool bounds_find_pushes(wiggly_group *g, double near_enough);

#endif
