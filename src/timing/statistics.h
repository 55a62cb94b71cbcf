/// Order statistics of frame times, and how sure one can be that two sets of them differ.
#ifndef TIMING_STATISTICS_H
#define TIMING_STATISTICS_H

#include <stdbool.h>

/// Sorts ascending; no NaN among them.
void statistics_sort(double *values, int count);

/// The quantile p in 0 … 1 of sorted values, between two of them by linear interpolation at p·(count − 1). NAN for none.
double statistics_quantile(const double *sorted, int count, double p);

/// What a frame may take to be shown 60 and 30 times a second.
enum { BUDGET_60, BUDGET_30, BUDGET_COUNT };
extern const double frame_budgets_ms[BUDGET_COUNT];

/// Frames over a budget, and the longest run of them.
struct over_budget {
    int frames, longest;
};

/// Counts the values above `budget`, which are in the order of time; NaN breaks a run.
struct over_budget statistics_over(const double *values, int count, double budget);

/// A measured value and the stretch of frames that it belongs to.
struct observation {
    double value;
    int segment;
};

/// Observations in `segments` stretches. Neighbouring frames resemble each other, so the bootstrap draws whole stretches.
struct observations {
    struct observation *items; ///< sorted by statistics_median_ratio()
    int count, segments;
};

/// Medians of both, their ratio (new over old) and its 95 % bootstrap interval.
struct median_ratio {
    double old_median, new_median, ratio, low, high;
};

/// Compares two sets of at least one observation each, with a fixed seed: the same input gives the same interval. `paired`:
/// segment n of both was measured under the same conditions, so they are drawn together and drift between pairs cancels.
/// The ratio of 0 to 0 is 1, of more than 0 to 0 infinite. false where memory is short.
bool statistics_median_ratio(struct observations *old, struct observations *new, bool paired,
                             struct median_ratio *result);

#endif
