/// Where on the screen the stage moves, so that the rest need not be redrawn. Private to draw/.
#ifndef DRAW_STAGE_EXTENT_H
#define DRAW_STAGE_EXTENT_H

#include "draw/area.h"
#include "ui/stage.h"

/// Hash of background and lit ground: while it stays the same, so do all pixels outside stage_extent() of both frames.
uint64_t stage_backdrop_hash(const struct stage_view *view);

/// The pixels of `viewport` that rigs and shadows may touch, with `margin` pixels around them.
struct area stage_extent(const struct stage_view *view, struct area viewport, int margin);

/// Height of the ground under the lowest rig.
float stage_lowest_ground(const struct stage_view *view);

/// Extends it by a box in world space.
struct extent;
void extent_add_box(struct extent *extent, const float lo[3], const float hi[3]);

#endif
