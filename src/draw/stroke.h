/// The strip of triangles of one line, in device pixels. Private to draw/.
#ifndef DRAW_STROKE_H
#define DRAW_STROKE_H

#include "draw/batch.h"
#include "draw/line.h"

/// A line being drawn: its look, and the last pair of vertices, for the next quad to share.
struct stroke {
    struct batch *batch;
    struct area visible;
    uint32_t color;
    float reach; ///< half width + 1/2, device pixels
    uint32_t left, right;
    unsigned generation;
    bool linked;
};

/// Distinct points; where closed the last one is the first one again.
struct polyline {
    const struct line_point *points;
    int count;
    bool closed;
};

/// Adds the triangles of a line of at least two points; segments that cannot touch what is visible are left out.
void stroke_draw(struct stroke *stroke, struct polyline line);

#endif
