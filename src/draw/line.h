/// Polylines as anti-aliased strips of triangles. Private to draw/.
#ifndef DRAW_LINE_H
#define DRAW_LINE_H

#include "draw/batch.h"

enum { LINE_POINTS = 8192 };

struct line_point {
    float x, y;
    float along; ///< distance from the nearer end + 1/2, or 1 where the line is closed
};

/// Working memory: a line in device pixels, and one dash of it.
struct line_scratch {
    struct line_point points[LINE_POINTS], dash[LINE_POINTS];
};

struct line_style {
    float width;   ///< logical pixels
    float on, off; ///< dashes, logical pixels; 0 where there are none
    float scale;   ///< device pixels a logical pixel
    uint32_t color;
};

/// Adds a polyline given in logical pixels; parts that cannot touch `visible` are left out.
void line_add(struct batch *batch, struct line_scratch *scratch, const float *xy, int count, struct line_style style,
              struct area visible);

#endif
