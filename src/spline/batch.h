/// A batch whose vectors are chosen by the caller: for tests and measurements.
#ifndef SPLINE_BATCH_H
#define SPLINE_BATCH_H

#include <wiggly/wiggly.h>

/// Like wiggly_batch_create() with `lanes` splines side by side: 8, 4, or 0 for none; at most chain_lanes().
wiggly_status batch_of_lanes(int samples, int knots, int threads, int lanes, wiggly_batch **batch);

#endif
