/// Conditions that are met from one side, limits and bounds: an interior-point method. Internal to src/spline.
#ifndef SPLINE_ONE_SIDED_H
#define SPLINE_ONE_SIDED_H

#include <stdbool.h>

/// One limit of all values. At values that are not open, gap and push are 1 and stay so.
typedef struct one_sided_limit {
    double sign, at; ///< sign: of a push, 1 for a least value and -1 for a largest one
    double *gap, *push;
    double *by_gap;  ///< part of it that a step adds
    double *by_push; ///< the same; before that the product of what μ = 0 would add to both
} one_sided_limit;

/// Values, what holds them within limits, and how they move: by S f under forces f. Arrays are of `count` numbers; they are free for other
/// use while `finish` runs.
typedef struct one_sided {
    int count, limits;
    one_sided_limit limit[2];
    double *value;   ///< without any force
    double *is_open; ///< 0 where a value has no limits, else 1
    double *move, *lack;

    void *user;
    bool (*begin)(void *user); ///< sets value, is_open and the limits anew
    bool (*factor)(void *user,
                   const double *stiffness);  ///< S⁻¹ + diag(stiffness); false: there is none
    void (*solve)(void *user, double *force); ///< force ← that, inverse, times force
    bool (*finish)(void *user); ///< solves with what one_sided_holds() as equalities; whether that is the answer

    // in progress
    double soft;      ///< what a force of 1 does to the value that is farthest beyond a limit
    double narrow;    ///< how far the limits are apart, up to 1
    double lack_left; ///< part of `lack`
    double mean;      ///< of gap times push
    double way;       ///< part of the last step that was gone
    int pairs;        ///< of gap and push
    bool bold;        ///< the last step took the second order in
} one_sided;

/// Finds what is held at a limit; true where `finish` has said that it is the answer, or nothing is beyond a limit by more than `slack`.
bool one_sided_solve(one_sided *o, double slack);

/// Which limit holds a value: its sign, or 0. For `finish`.
double one_sided_holds(const one_sided *o, int i);

#endif
