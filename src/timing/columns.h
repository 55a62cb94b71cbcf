/// The columns of the timing log, for its writer and its readers, what sums one up, and logs read back.
#ifndef TIMING_COLUMNS_H
#define TIMING_COLUMNS_H

#include "timing/framelog.h"
#include <stddef.h>

#define TIMING_SCHEMA "wiggly-frames 2"
#define TIMING_SCHEMA_BEFORE "wiggly-frames 1" ///< without frame_interval_ms; still read

enum column_use {
    COLUMN_LABEL,   ///< identifies the frame; never compared
    COLUMN_WAIT,    ///< idle time: more of it is no loss
    COLUMN_COST,    ///< less is better
    COLUMN_COUNTER, ///< the same in every run of the same session
};

struct column {
    const char *name;
    enum column_use use;
    bool is_count;     ///< a long in struct frame_row, else a double
    int decimals;      ///< of a double, in the file
    size_t offset;     ///< in struct frame_row
    double grain;      ///< COLUMN_COST: smaller differences are the clock's, not the program's
    double tail_grain; ///< COLUMN_COST: smaller ones at p95 and p99 are the scheduler's, and nobody sees them
};

enum {
    COLUMN_FRAME,
    COLUMN_TIME,
    COLUMN_FRAME_MS,
    COLUMN_FRAME_INTERVAL_MS,
    COLUMN_INPUT_US = 5,
    COLUMN_SOLVE_US = 7,
    COLUMN_GPU_US = 11,
    COLUMN_SWAP_US = 12,
    COLUMN_EVENT_TO_SWAP_US = 17,
    COLUMN_COUNT = 20
};

extern const struct column timing_columns[COLUMN_COUNT];

/// The number in a column of a row; NAN where it was not measured.
double column_value(const struct column *column, const struct frame_row *row);

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

// Reads timing logs back, also several runs in one file (`cat run1.csv run2.csv`).

/// All frames of all runs, without the warm-up.
struct timing_log {
    double *values; ///< rows × COLUMN_COUNT, NAN where NA
    int *run;       ///< per row, from 0
    int rows, runs;
    char solvers[64]; ///< by what the splines were solved: "chain", "chain, band"; "" where the log does not say
};

/// false with a sentence: not readable, another schema, not a number, no frames. Then there is nothing to free.
bool timing_log_read(const char *path, struct timing_log *log, struct error *error);
void timing_log_free(struct timing_log *log);

/// Percentiles of every time, frames over budget, a histogram of frame_ms, and where the slowest frames spent their time.
void distribution_print(const struct timing_log *log, const char *name, FILE *out);

#endif
