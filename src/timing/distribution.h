/// How the frame times of a log are distributed, for people: as text and as a picture.
#ifndef TIMING_DISTRIBUTION_H
#define TIMING_DISTRIBUTION_H

#include "timing/columns.h"
#include <stdio.h>

/// Percentiles of every time, frames over budget, a histogram of frame_ms, and where the slowest frames spent their time.
void distribution_print(const struct timing_log *log, const char *name, FILE *out);

/// An SVG: every frame of every run along the session, the histogram, and the percentiles up to the slowest frame.
/// Whether `out` was written is the caller's to check.
void distribution_draw(const struct timing_log *log, const char *name, FILE *out);

/// The smallest of 1, 2 and 5 times a power of ten that is not below `least`.
double round_step(double least);

/// Histogram of sorted values in steps that read well (1, 2 or 5 times a power of ten), at most 24 up to p99 and one for the rest.
struct histogram {
    double start, step;
    int bins;       ///< the last one takes all that is above
    int counts[26]; ///< values in [start + i·step, start + (i + 1)·step)
    int most;       ///< largest count
};

struct histogram histogram_of(const double *sorted, int count);

/// The measured values of a column in the order of the log; `values` has room for all rows. Returns how many.
int column_values(const struct timing_log *log, int column, double *values);

#endif
