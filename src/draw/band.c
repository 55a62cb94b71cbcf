/// Fills the area between an upper and a lower edge with one point per pixel column.
//
// Columns are grouped into stretches. The rows that a whole stretch covers are one rectangle: software rasterisers draw triangles one pixel
// wide and a panel high as slowly as ones four pixels wide. Strips follow the edges above and below:
//
//     out   o---o---o---o      half a pixel beyond the edge: no coverage
// half a pixel inside: full coverage
//           |           |
//     core  o-----------o      the rectangle's side
#include "draw/paint.h"
#include <math.h>

enum { STRETCH = 16 }; ///< columns

struct stretch {
    float x[STRETCH], top[STRETCH], bottom[STRETCH]; ///< edges of the line per column
    int count;
    float core_top, core_bottom; ///< the rows that all columns cover
};

/// The most columns from point `first` on that have a row in common. Neighbours always do, because they share a point.
static struct stretch take_stretch(const float *xy, int first, int count, float reach, float scale)
{
    struct stretch s = {.core_top = -INFINITY, .core_bottom = INFINITY};
    for (int c = first; c + 1 < count && s.count < STRETCH; c++) {
        const float *p = xy + 2 * (size_t)c;
        const float top = fminf(p[1], p[3]) * scale - reach, bottom = fmaxf(p[1], p[3]) * scale + reach;
        const float core_top = fmaxf(s.core_top, top + 0.5f), core_bottom = fminf(s.core_bottom, bottom - 0.5f);
        if (s.count > 1 && core_top > core_bottom) break;
        s.core_top = core_top;
        s.core_bottom = fmaxf(core_top, core_bottom);
        s.x[s.count] = p[0] * scale;
        s.top[s.count] = top;
        s.bottom[s.count++] = bottom;
    }
    return s;
}

static void add_edge(struct batch *batch, const struct stretch *s, const float *edge, float outward, float core,
                     uint32_t color)
{
    const uint32_t base = batch_reserve(batch, 3 * s->count, 12 * (s->count - 1));
    for (int i = 0; i < s->count; i++) {
        struct batch_vertex out = shape_vertex(s->x[i], edge[i] + 0.5f * outward, color);
        out.across = 1.0f;
        batch_add(batch, out);
        batch_add(batch, shape_vertex(s->x[i], edge[i] - 0.5f * outward, color));
        batch_add(batch, shape_vertex(s->x[i], core, color));
    }
    for (uint32_t i = 0; i + 1 < (uint32_t)s->count; i++) {
        for (uint32_t row = 0; row < 2; row++) {
            const uint32_t here = base + 3 * i + row;
            batch_triangle(batch, here, here + 1, here + 3);
            batch_triangle(batch, here + 3, here + 1, here + 4);
        }
    }
}

void band_add(struct batch *batch, const float *xy, int count, float width, float scale, uint32_t color)
{
    const float reach = 0.5f * fmaxf(width * scale, 1.0f);
    for (int first = 0; first + 2 < count;) {
        const struct stretch s = take_stretch(xy, first, count, reach, scale);
        shape_fill(batch, s.x[0], s.core_top, s.x[s.count - 1], s.core_bottom, color);
        add_edge(batch, &s, s.top, -1.0f, s.core_top, color);
        add_edge(batch, &s, s.bottom, 1.0f, s.core_bottom, color);
        first += s.count - 1; // the next stretch starts with this one's last column
    }
}
