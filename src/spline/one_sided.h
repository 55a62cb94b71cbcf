/// An interior-point method for one-sided conditions: limits and bounds. Internal to src/spline.
#ifndef SPLINE_ONE_SIDED_H
#define SPLINE_ONE_SIDED_H

#include <stdbool.h>

/// A limit of all values. Values that are not open keep a gap and push of 1.
typedef struct one_sided_limit {
    double sign, at; ///< sign of the push: 1 for a lower limit, -1 for an upper one
    double *gap, *push;
    double *by_gap;  ///< relative change of the gap in a step
    double *by_push; ///< likewise of the push; before that the product of both changes for μ = 0
} one_sided_limit;

/// Values, what holds them within limits, and how they move: by S f under forces f. Arrays are of `count` numbers; they are free for other
/// use while `finish` runs.
typedef struct one_sided {
    int count, limits;
    one_sided_limit limit[2];
    double *value;   ///< without forces
    double *is_open; ///< 0 if a value has no limits, else 1
    double *move, *lack;

    void *user;
    bool (*begin)(void *user); ///< sets value, is_open and the limits
    bool (*factor)(void *user,
                   const double *stiffness);  ///< S⁻¹ + diag(stiffness); false: there is none
    void (*solve)(void *user, double *force); ///< multiplies by the inverse of that
    bool (*finish)(void *user); ///< solves with the values of one_sided_holds() held; whether that is the answer

    // in progress
    double soft;      ///< response to a force of 1 of the value farthest beyond a limit
    double lack_left; ///< share of `lack`
    double mean;      ///< mean of gap times push
    double way;       ///< share of the last step that was taken
    int pairs;        ///< of gap and push
    bool bold;        ///< the last step included the second order
} one_sided;

/// Finds the values held at a limit; true if `finish` accepts the answer, or no value exceeds a limit by more than `slack`.
bool one_sided_solve(one_sided *o, double slack);

/// The limit that holds a value: its sign, or 0. For `finish`.
double one_sided_holds(const one_sided *o, int i);

#endif
