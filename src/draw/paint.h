/// Turns draw lists into anti-aliased triangles: shapes, lines and text. Private to draw/.
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "draw/batch.h"
#include "ui/font.h"

// Filled shapes.

/// A vertex of a filled shape: full coverage, white texel.
struct batch_vertex shape_vertex(float x, float y, uint32_t color);

/// A rectangle: corners in device pixels and in the atlas.
struct quad {
    float x0, y0, x1, y1, u0, v0, u1, v1;
};

void shape_quad(struct batch *batch, const struct quad *quad, uint32_t color);
/// Fills from (x0, y0) to (x1, y1).
void shape_fill(struct batch *batch, float x0, float y0, float x1, float y1, uint32_t color);

/// The rectangle from (x0, y0) to (x1, y1) in device pixels, clipped to `clip`. A partly covered pixel gets exactly that share of the
/// colour.
void shape_rect(struct batch *batch, const float corners[4], struct area clip, uint32_t color);

/// A convex polygon of `count` points in logical pixels.
void shape_convex(struct batch *batch, const float *xy, int count, float scale, uint32_t color);

// The area of a line that goes up and down between points.

/// Everything between each of `count` points and the next, `width` wide. Points and width are logical pixels; x never decreases.
void band_add(struct batch *batch, const float *xy, int count, float width, float scale, uint32_t color);

// Polylines.

enum { LINE_POINTS = 8192 };

struct line_point {
    float x, y;
    float along; ///< distance from the nearer end + 1/2, or 1 if the line is closed
};

/// Working memory: a line in device pixels, and one of its dashes.
struct line_scratch {
    struct line_point points[LINE_POINTS], dash[LINE_POINTS];
};

struct line_style {
    float width;   ///< logical pixels
    float on, off; ///< dashes, logical pixels; both 0: solid
    float scale;   ///< device pixels per logical pixel
    uint32_t color;
};

/// Adds a polyline in logical pixels; omits parts that cannot touch `visible`.
void line_add(struct batch *batch, struct line_scratch *scratch, const float *xy, int count, struct line_style style,
              struct area visible);

// The triangle strip of one line, in device pixels.

/// A line being drawn: its style, and the last pair of vertices, which the next quad shares.
struct stroke {
    struct batch *batch;
    struct area visible;
    uint32_t color;
    float reach; ///< half width + 1/2, device pixels
    uint32_t left, right;
    unsigned generation;
    bool linked;
};

/// Distinct points; if closed, the last equals the first.
struct polyline {
    const struct line_point *points;
    int count;
    bool closed;
};

/// Adds the triangles of a line of at least two points; omits segments outside the clip.
void stroke_draw(struct stroke *stroke, struct polyline line);

// Draw lists.

struct painter {
    struct batch *batch;
    struct line_scratch *scratch;
    const struct atlas *atlas;
    float scale;
};

/// Adds every command that touches `area`, in order and clipped to it.
void paint_list(const struct painter *painter, const struct drawlist *list, struct area area);

#endif
