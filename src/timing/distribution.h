/// How the frame times of a log are distributed, for people.
#ifndef TIMING_DISTRIBUTION_H
#define TIMING_DISTRIBUTION_H

#include "timing/columns.h"
#include <stdio.h>

/// Percentiles of every time, frames over budget, a histogram of frame_ms, and where the slowest frames spent their time.
void distribution_print(const struct timing_log *log, const char *name, FILE *out);

#endif
