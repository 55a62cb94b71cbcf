/// How sure one can be that two sets of frame times differ.
#ifndef REGRESS_BOOTSTRAP_H
#define REGRESS_BOOTSTRAP_H

#include <stdbool.h>

/// A measured value and the segment that it belongs to.
struct observation {
    double value;
    int segment;
};

/// Sorts by value; no NaN among them.
void sort_observations(struct observation *items, int count);

/// The quantile p of sorted observations, each counted weight[segment] times. NAN for none.
double weighted_quantile(const struct observation *sorted, int count, const int *weight, double p);

/// How two sets fall into segments. Neighbouring frames resemble each other, so the bootstrap draws whole segments.
/// `paired`: segment n of both was measured under the same conditions, so both are drawn together and drift cancels.
struct segments {
    int old_count, new_count; ///< the same where paired
    bool paired;
};

/// A quantity and its 99 % bootstrap interval; NAN where it could not be measured.
struct estimate {
    double value, low, high;
};

/// Computes a quantity of both sets with each segment counted as often as its weight says; NAN where there is nothing.
typedef double bootstrap_quantity(const int *old_weight, const int *new_weight, const void *user);

/// The quantity with every segment counted once, and over 1000 draws of as many segments as there are, with replacement. The
/// seed is fixed: the same input gives the same interval. Ends the program where memory is short.
struct estimate bootstrap(const struct segments *segments, bootstrap_quantity *quantity, const void *user);

#endif
