/// Filled shapes as anti-aliased triangles. Private to draw/.
#ifndef DRAW_SHAPE_H
#define DRAW_SHAPE_H

#include "draw/batch.h"

/// A vertex of a filled shape: full coverage, white texel.
struct batch_vertex shape_vertex(float x, float y, uint32_t color);

/// The rectangle from (x0, y0) to (x1, y1), device pixels, clipped to `clip`. A partly covered pixel gets exactly
/// that share of the colour.
void shape_rect(struct batch *batch, const float corners[4], struct area clip, uint32_t color);

/// A convex polygon of `count` points, given in logical pixels.
void shape_convex(struct batch *batch, const float *xy, int count, float scale, uint32_t color);

#endif
