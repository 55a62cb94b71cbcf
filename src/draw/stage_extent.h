/// What of the stage moves, and where that is on the screen, so that the rest of it need not be drawn again. Private to draw/.
#ifndef DRAW_STAGE_EXTENT_H
#define DRAW_STAGE_EXTENT_H

#include "draw/area.h"
#include "ui/stage.h"

/// Of the background and the lit ground: where it stays the same, so do all pixels outside stage_extent() then and now.
uint64_t stage_backdrop_hash(const struct stage_view *view);

/// The pixels of `viewport` that rigs and shadows may touch, with `margin` pixels around them.
struct area stage_extent(const struct stage_view *view, struct area viewport, int margin);

/// Height of the ground that the lowest rig stands on.
float stage_lowest_ground(const struct stage_view *view);

/// Adds a box of the world to what a painter covers.
struct extent;
void extent_add_box(struct extent *extent, const float lo[3], const float hi[3]);

#endif
