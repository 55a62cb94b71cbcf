/// Intersects and shrinks rectangles.
#include "ui/drawlist.h"
#include <math.h>

struct rect rect_intersect(struct rect a, struct rect b)
{
    float x = fmaxf(a.x, b.x), y = fmaxf(a.y, b.y);
    float w = fminf(a.x + a.w, b.x + b.w) - x, h = fminf(a.y + a.h, b.y + b.h) - y;
    return (struct rect){x, y, fmaxf(w, 0.0f), fmaxf(h, 0.0f)};
}

struct rect rect_inset(struct rect r, float by)
{
    return (struct rect){r.x + by, r.y + by, fmaxf(r.w - 2.0f * by, 0.0f), fmaxf(r.h - 2.0f * by, 0.0f)};
}
