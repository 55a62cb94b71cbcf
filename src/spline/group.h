/// Splines of a batch, a few at a time: those that share filter and start are solved side by side, the others one by one.
#ifndef SPLINE_GROUP_H
#define SPLINE_GROUP_H

#include "spline/chain_lanes.h"
#include <wiggly/wiggly.h>

enum { GROUP_ROOM = 16 }; ///< splines between two calls of group_finish()

typedef struct group group;

/// Bytes of a group for splines of up to `samples` samples and `knots` knots; 0 where that does not fit.
size_t group_memsize(int samples, int knots);

/// Lays a group into that many zeroes, aligned for double; `lanes` (8, 4 or 0: none) splines go side by side.
group *group_lay_out(void *memory, int samples, int knots, int lanes);

/// Takes a spline; it may be solved now or later.
void group_add(group *group, const wiggly_desc *desc, wiggly_curve *curve);

/// Solves what is left; returns how many were taken since the last time, and their statuses in that order.
int group_finish(group *group, wiggly_status *statuses);

#endif
