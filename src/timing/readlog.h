/// Reads timing logs back, also several runs in one file (`cat run1.csv run2.csv`).
#ifndef TIMING_READLOG_H
#define TIMING_READLOG_H

#include "timing/columns.h"

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

#endif
