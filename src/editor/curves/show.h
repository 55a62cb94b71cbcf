/// What is drawn in the curves panel, as far as its mouse has to know.
#ifndef EDITOR_CURVES_SHOW_H
#define EDITOR_CURVES_SHOW_H

#include "editor/curves/state.h"

/// The handle's length in pixels says how firmly the slope is held, 12 for each power of ten.
double handle_length(double stiffness);
/// The stiffness that a length of the handle stands for.
double handle_stiffness(double length);
/// A knot: a diamond, filled with its colour; with an outline where it is selected.
void knot_mark(struct drawlist *list, float x, float y, float radius, uint32_t color, bool selected);
/// The ring around the knot under the pointer.
void knot_ring(struct drawlist *list, float x, float y);
/// Where the playhead's frame number is, on the ruler; empty where the playhead is out of sight.
struct rect playhead_tag(const struct curves *curves, const struct core *core, const struct document *document);

/// The corner left of the ruler, which says what it counts.
struct rect ruler_corner(const struct core *core);
/// Grids, numbers and ruler; part of curves_show().
void grid_show(const struct curves *curves, struct core *core, const struct editor_world *world);

/// The knot to draw after one, where knots are crowded: the next that is selected or under the pointer, or at least `gap` pixels on.
int crowd_next(const struct curves *curves, const struct core *core, const struct document *document, int spline,
               int knot, float gap);

#endif
