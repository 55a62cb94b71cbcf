/// Changes by key, in small steps.
#ifndef EDITOR_CORE_NUDGE_H
#define EDITOR_CORE_NUDGE_H

#include "editor/core/state.h"

/// Moves the selected knots by frames and values, as one step with equal nudges before.
void core_nudge_knots(struct core *core, const struct editor_world *world, double frames, double value);
/// The channel that the active spline moves, the first of all where it moves none; NULL where there is none at all.
const struct channel *core_active_channel(const struct core *core, const struct document *document, int *tail,
                                          int *channel);
/// Where a parameter's slider ends; 0: it has none.
double core_slider_end(const struct document *document, const struct spline *spline, enum parameter parameter);
/// Changes the parameter that a held letter stands for, or with L the lag, by its step.
void core_nudge_parameter(struct core *core, const struct editor_world *world, int letter, int direction);
/// The next of complex, real and cubic.
void core_cycle_mode(struct core *core, const struct editor_world *world);

#endif
