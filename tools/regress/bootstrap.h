/// How sure one can be that two sets of frame times differ.
#ifndef REGRESS_BOOTSTRAP_H
#define REGRESS_BOOTSTRAP_H

/// A measured value and the segment that it belongs to.
struct observation {
    double value;
    int segment;
};

/// Sorts by value; no NaN among them.
void sort_observations(struct observation *items, int count);

/// The quantile p of sorted observations, each counted weight[segment] times. NAN for none.
double weighted_quantile(const struct observation *sorted, int count, const int *weight, double p);

/// A quantity and its 99 % bootstrap interval; NAN where it could not be measured.
struct estimate {
    double value, low, high;
};

/// Computes a quantity of both sets with each segment counted as often as its weight says; NAN where there is nothing.
typedef double bootstrap_quantity(const int *weight, const void *user);

/// The quantity with every segment counted once, and over 1000 draws of as many segments as there are, with replacement. Neighbouring
/// frames resemble each other, so whole segments are drawn; segment n of both sets was measured under the same conditions, so both are
/// drawn together, and drift cancels. The seed is fixed: the same input gives the same interval.
struct estimate bootstrap(int segments, bootstrap_quantity *quantity, const void *user);

#endif
