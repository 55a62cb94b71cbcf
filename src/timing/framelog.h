/// The timing log: one row per frame in memory, written as CSV in blocks outside the timed part, and summarised at the end.
#ifndef TIMING_FRAMELOG_H
#define TIMING_FRAMELOG_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/// One frame; microseconds unless the name says otherwise. NAN, and below 0 in a count, is written as NA: not measured.
struct frame_row {
    long frame; ///< from 0 in every run
    double t_s; ///< seconds since the start of the process, when the timed part (input to the end of the swap) began
    double frame_ms;
    double frame_interval_ms; ///< from the end of the last frame's swap to the end of this one's; NAN after a rest
    double wait_us, input_us, edit_us, solve_us, pose_us, upload_us, draw_us;
    double gpu_us; ///< of this frame, though it comes back some frames later: see framelog_gpu()
    double swap_us;
    long splines_solved, samples, knots; ///< solved in this frame: splines, their samples, their knots
    long edited;                         ///< 1 where the document is not what the frame before it showed
    double event_to_swap_us;             ///< oldest event of the frame to the end of the swap; NAN where none came
    long allocations, uploaded_bytes;
    const char *solver; ///< as in struct frame_header; no column: a line says where it changes
};

/// What the header says.
struct frame_header {
    const char *gl_renderer;
    const char *solver; ///< by what the splines are solved; must outlive the log; NULL: NA
    int width, height;
    float scale;
    int vsync;
    int warm_up;           ///< frames left out of the summary and marked in the header
    double first_frame_ms; ///< start of the process to the end of the first swap; NAN for these two: NA
};

struct framelog;

/// `path` may be NULL: frames are kept for the summary only. Memory for a summary of `capacity` frames is taken at once; when full,
/// older ones stay in the file but leave the summary (a long live session). NULL with a sentence where the file cannot be made.
struct framelog *framelog_open(const char *path, const struct frame_header *header, int capacity,
                               struct error *error);

/// Adds a row. Allocates nothing, and writes only full blocks of 256 rows: call it outside the timed part.
/// After a failed write the file is not touched again; framelog_close() says so once.
void framelog_push(struct framelog *log, const struct frame_row *row);

/// Enters the GPU time of an earlier frame of this run, one of the last 16; that of an older frame, or of a negative one, is
/// dropped.
void framelog_gpu(struct framelog *log, long frame, double gpu_us);

/// Writes what is left, checks every call; with `summary` prints frames, fps, percentiles of four times, frames over budget
/// and the 1 % low. Frees the log.
bool framelog_close(struct framelog *log, FILE *summary, struct error *error);

/// Allocations by our own objects since the start of the process (-Wl,--wrap=malloc, calloc, realloc).
long allocation_count(void);

// The columns of the log, for its writer and its readers, and what sums one up.

#define TIMING_SCHEMA "wiggly-frames 2"

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

#endif
