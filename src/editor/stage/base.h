/// The splines that the position of the held body follows. Within a step of the history.
#ifndef EDITOR_STAGE_BASE_H
#define EDITOR_STAGE_BASE_H

#include "editor/stage/state.h"

/// Notes what hangs on the held body, before anything is edited.
void base_begin(struct stage *stage, const struct editor_world *world);
/// Where a coordinate is at a sample, metres, as a spline would have it.
double base_value(const struct editor_world *world, int tail, int coordinate, int sample);
/// The spline that a coordinate follows, a new cubic where it is a number yet; -1 on failure.
int base_spline(const struct stage *stage, struct core *core, const struct editor_world *world, int coordinate);
/// Sets or inserts a knot, within the limits of its spline (see core_hold()); a level one stands still there.
void base_put_knot(struct core *core, const struct editor_world *world, int spline, int sample, double value,
                   bool level, char why[STOPPED_SIZE]);
/// The coordinate follows the spline from now on.
void base_follow(const struct stage *stage, struct core *core, const struct editor_world *world, int coordinate,
                 int base);
/// Lets the channels that swung with a coordinate follow its spline. A tail that has none that would gets one: its spline, else -1.
int base_hang_channels(const struct stage *stage, struct core *core, const struct editor_world *world, int coordinate,
                       int base);
/// Adds a sentence on that spline to what is said; nothing for -1.
void base_say_channel(const struct editor_world *world, int spline, char *text, size_t size);

#endif
