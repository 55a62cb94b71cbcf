/// What a line that goes up and down from point to point covers, as few triangles. Private to draw/.
#ifndef DRAW_BAND_H
#define DRAW_BAND_H

#include "draw/batch.h"

/// Everything between each of `count` points and the next, `width` wide; points and width in logical pixels, x never decreasing.
void band_add(struct batch *batch, const float *xy, int count, float width, float scale, uint32_t color);

#endif
