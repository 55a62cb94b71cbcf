/// What became slower between the logs of two builds, and how certain that is.
#ifndef TIMING_COMPARE_H
#define TIMING_COMPARE_H

#include "timing/readlog.h"
#include "timing/statistics.h"

/// Two logs and room to compare them.
struct comparison {
    const struct timing_log *old, *new;
    struct segments segments;
    bool by_run; ///< segments are runs: at least eight in both; else stretches of 60 frames
    bool
        same_shape; ///< as many runs of as many frames in both: frame n did the same work, so frames are compared one by one
    struct observation *old_items, *new_items, *ratios; ///< private
    struct tally *old_tallies, *new_tallies;            ///< private
};

/// The logs must outlive the comparison. false with a sentence where memory is short.
bool comparison_open(struct comparison *comparison, const struct timing_log *old, const struct timing_log *new,
                     struct error *error);
void comparison_close(struct comparison *comparison);

/// One number of both builds. `change` is new over old less 1 for times, new less old for shares (1 is all frames) and runs
/// of frames.
struct change {
    double old, new;
    struct estimate change;
    bool worse; ///< by more than its limit, with the whole interval past a part of it
};

enum { QUANTILE_P50, QUANTILE_P95, QUANTILE_P99, QUANTILE_COUNT };
extern const double compared_quantiles[QUANTILE_COUNT];

/// Quantiles of a column. The change of p50 is the median of new over old frame by frame where the logs have the same shape,
/// which detects a few percent; else the ratio of the medians. Returns false if one of the logs has no measurement (no
/// change then), or memory is short.
bool compare_times(struct comparison *comparison, int column, struct change changes[QUANTILE_COUNT]);

/// Share of frames over a budget, and the mean over the runs of the longest run of them; without an interval unless segments are
/// runs. false where memory is short.
bool compare_budget(struct comparison *comparison, double budget_ms, struct change *share, struct change *longest);

#endif
