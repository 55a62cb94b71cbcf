/// Order statistics of frame times, and how sure one can be that two sets of them differ.
#ifndef TIMING_STATISTICS_H
#define TIMING_STATISTICS_H

#include <stdbool.h>

/// Sorts ascending; no NaN among them.
void statistics_sort(double *values, int count);

/// The quantile p in 0 … 1 of sorted values, between two of them by linear interpolation at p·(count − 1). NAN for none.
double statistics_quantile(const double *sorted, int count, double p);

/// Budget of a frame at 60 and 30 frames per second.
enum { BUDGET_60, BUDGET_30, BUDGET_COUNT };
extern const double frame_budgets_ms[BUDGET_COUNT];

/// Frames over a budget, and the longest run of them.
struct over_budget {
    int frames, longest;
};

/// Counts the values above `budget`, which are in the order of time; NaN breaks a run.
struct over_budget statistics_over(const double *values, int count, double budget);

/// A measured value and the segment that it belongs to.
struct observation {
    double value;
    int segment;
};

/// Sorts by value; no NaN among them.
void statistics_sort_observations(struct observation *items, int count);

/// The quantile p of sorted observations, each counted weight[segment] times. NAN for none.
double statistics_weighted_quantile(const struct observation *sorted, int count, const int *weight, double p);

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
typedef double statistics_quantity(const int *old_weight, const int *new_weight, const void *user);

/// The quantity with every segment counted once, and over 1000 draws of as many segments as there are, with replacement. The
/// seed is fixed: the same input gives the same interval. false where memory is short.
bool statistics_bootstrap(const struct segments *segments, statistics_quantity *quantity, const void *user,
                          struct estimate *result);

#endif
