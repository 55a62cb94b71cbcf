/// Rectangles of whole device pixels from the top left. Private to draw/.
#ifndef DRAW_AREA_H
#define DRAW_AREA_H

#include "ui/drawlist.h"
#include <math.h>

/// Pixels [x0, x1) × [y0, y1).
struct area {
    int x0, y0, x1, y1;
};

static inline int area_max(int a, int b) { return a > b ? a : b; }
static inline int area_min(int a, int b) { return a < b ? a : b; }

static inline bool area_empty(struct area a) { return a.x1 <= a.x0 || a.y1 <= a.y0; }

static inline long area_pixels(struct area a) { return area_empty(a) ? 0 : (long)(a.x1 - a.x0) * (a.y1 - a.y0); }

static inline struct area area_intersect(struct area a, struct area b)
{
    return (struct area){area_max(a.x0, b.x0), area_max(a.y0, b.y0), area_min(a.x1, b.x1), area_min(a.y1, b.y1)};
}

static inline struct area area_union(struct area a, struct area b)
{
    return (struct area){area_min(a.x0, b.x0), area_min(a.y0, b.y0), area_max(a.x1, b.x1), area_max(a.y1, b.y1)};
}

static inline bool area_same(struct area a, struct area b)
{
    return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1;
}

static inline bool area_touches(struct area a, struct area b) { return !area_empty(area_intersect(a, b)); }

static inline bool area_contains(struct area a, struct area b)
{
    return b.x0 >= a.x0 && b.y0 >= a.y0 && b.x1 <= a.x1 && b.y1 <= a.y1;
}

/// Converts a finite device coordinate without overflow.
static inline int area_whole(float device) { return (int)fminf(fmaxf(device, -1.0e6f), 1.0e6f); }

/// All pixels that touch a logical rectangle.
static inline struct area area_outer(struct rect r, float scale)
{
    return (struct area){area_whole(floorf(r.x * scale)), area_whole(floorf(r.y * scale)),
                         area_whole(ceilf((r.x + r.w) * scale)), area_whole(ceilf((r.y + r.h) * scale))};
}

/// A logical rectangle rounded to pixel edges, for clips and viewports.
static inline struct area area_rounded(struct rect r, float scale)
{
    return (struct area){area_whole(roundf(r.x * scale)), area_whole(roundf(r.y * scale)),
                         area_whole(roundf((r.x + r.w) * scale)), area_whole(roundf((r.y + r.h) * scale))};
}

#endif
