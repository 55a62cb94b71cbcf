/// Timing logs, also several runs in one file (`cat run1.csv run2.csv`).
#ifndef REGRESS_LOG_H
#define REGRESS_LOG_H

#include "timing/framelog.h"

/// All frames of all runs, without the warm-up.
struct timing_log {
    double *values; ///< rows × COLUMN_COUNT, NAN where NA
    int *run;       ///< per row, from 0
    int rows, runs;
};

/// false with a sentence: not readable, another schema, not a number, no frames. Then there is nothing to free.
bool timing_log_read(const char *path, struct timing_log *log, struct error *error);
void timing_log_free(struct timing_log *log);

#endif
