/// What of the drawn panel its mouse has to know.
#ifndef EDITOR_CURVES_CURVES_SHOW_H
#define EDITOR_CURVES_CURVES_SHOW_H

#include "editor/curves/state.h"

/// The handle's length in pixels says how firmly the slope is held, 12 for each power of ten.
double handle_length(double stiffness);
/// The stiffness that a length of the handle stands for.
double handle_stiffness(double length);
/// Where the playhead's frame number is, on the ruler; empty where the playhead is out of sight.
struct rect playhead_tag(const struct curves *curves, const struct core *core, const struct document *document);

#endif
