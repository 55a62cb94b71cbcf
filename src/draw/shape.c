/// Filled shapes as triangles with anti-aliased edges.
#include "draw/paint.h"

/// Above this size glClear is cheaper than two triangles (measured with llvmpipe).
enum { FILL_PIXELS = 4096, CONVEX_MAX = 128 };

struct batch_vertex shape_vertex(float x, float y, uint32_t color)
{
    return (struct batch_vertex){
        .x = x,
        .y = y,
        .u = 0.5f,
        .v = 0.5f,
        .color = {(unsigned char)(color >> 24), (unsigned char)(color >> 16), (unsigned char)(color >> 8),
                  (unsigned char)color},
        .reach = 1.0f,
        .along = 1.0f,
    };
}

void shape_quad(struct batch *batch, const struct quad *quad, uint32_t color)
{
    const float x[4] = {quad->x0, quad->x1, quad->x1, quad->x0}, y[4] = {quad->y0, quad->y0, quad->y1, quad->y1};
    const float u[4] = {quad->u0, quad->u1, quad->u1, quad->u0}, v[4] = {quad->v0, quad->v0, quad->v1, quad->v1};
    uint32_t base = batch_reserve(batch, 4, 6);
    for (int i = 0; i < 4; i++) {
        struct batch_vertex vertex = shape_vertex(x[i], y[i], color);
        vertex.u = u[i];
        vertex.v = v[i];
        batch_add(batch, vertex);
    }
    batch_triangle(batch, base, base + 1, base + 2);
    batch_triangle(batch, base, base + 2, base + 3);
}

void shape_fill(struct batch *batch, float x0, float y0, float x1, float y1, uint32_t color)
{
    shape_quad(batch, &(struct quad){x0, y0, x1, y1, 0.5f, 0.5f, 0.5f, 0.5f}, color);
}

/// A run of pixels with equal coverage.
struct span {
    int from, to;
    float coverage;
};

/// Splits [from, to] into runs of partly and fully covered pixels; returns their number (at most 3).
static int cut_spans(float from, float to, int clip_from, int clip_to, struct span spans[3])
{
    from = fmaxf(from, (float)clip_from);
    to = fminf(to, (float)clip_to);
    if (!(to > from)) return 0;
    int first = (int)floorf(from), last = (int)ceilf(to) - 1;
    if (first == last) {
        spans[0] = (struct span){first, first + 1, to - from};
        return 1;
    }
    int count = 0;
    float lead = (float)(first + 1) - from, tail = to - (float)last;
    if (lead < 1.0f) spans[count++] = (struct span){first, first + 1, lead};
    struct span whole = {lead < 1.0f ? first + 1 : first, tail < 1.0f ? last : last + 1, 1.0f};
    if (whole.to > whole.from) spans[count++] = whole;
    if (tail < 1.0f) spans[count++] = (struct span){last, last + 1, tail};
    return count;
}

static uint32_t covered(uint32_t color, float coverage)
{
    return (color & 0xFFFFFF00u) | (uint32_t)lroundf((float)(color & 0xFFu) * coverage);
}

void shape_rect(struct batch *batch, const float corners[4], struct area clip, uint32_t color)
{
    struct span columns[3], rows[3];
    int column_count = cut_spans(corners[0], corners[2], clip.x0, clip.x1, columns);
    int row_count = cut_spans(corners[1], corners[3], clip.y0, clip.y1, rows);
    for (int i = 0; i < row_count; i++) {
        for (int j = 0; j < column_count; j++) {
            struct area area = {columns[j].from, rows[i].from, columns[j].to, rows[i].to};
            uint32_t shade = covered(color, columns[j].coverage * rows[i].coverage);
            if ((shade & 0xFFu) == 0xFFu && area_pixels(area) >= FILL_PIXELS) {
                batch_fill(batch, area, shade);
            } else {
                shape_fill(batch, (float)area.x0, (float)area.y0, (float)area.x1, (float)area.y1, shade);
            }
        }
    }
}

struct point {
    float x, y;
};

/// Device points without coinciding neighbours.
static int device_points(const float *xy, int count, float scale, struct point *points)
{
    int kept = 0;
    for (int i = 0; i < count && kept < CONVEX_MAX; i++) {
        struct point p = {xy[2 * i] * scale, xy[2 * i + 1] * scale};
        if (kept && hypotf(p.x - points[kept - 1].x, p.y - points[kept - 1].y) < 0.01f) continue;
        points[kept++] = p;
    }
    while (kept > 1 && hypotf(points[0].x - points[kept - 1].x, points[0].y - points[kept - 1].y) < 0.01f) kept--;
    return kept;
}

/// Twice the signed area; its sign gives the winding.
static float twice_area(const struct point *points, int count)
{
    float sum = 0.0f;
    for (int i = 0; i < count; i++) {
        struct point a = points[i], b = points[(i + 1) % count];
        sum += (a.x - points[0].x) * (b.y - points[0].y) - (b.x - points[0].x) * (a.y - points[0].y);
    }
    return sum;
}

/// How far point i moves if both its edges move out by one pixel: the mitre of the normals.
static struct point outward(const struct point *points, int count, int i, float side)
{
    struct point before = points[(i + count - 1) % count], p = points[i], after = points[(i + 1) % count];
    float a = side / hypotf(p.x - before.x, p.y - before.y), b = side / hypotf(after.x - p.x, after.y - p.y);
    struct point n = {(p.y - before.y) * a, (before.x - p.x) * a}, m = {(after.y - p.y) * b, (p.x - after.x) * b};
    float stretch = 1.0f / fmaxf(1.0f + n.x * m.x + n.y * m.y, 0.25f);
    return (struct point){(n.x + m.x) * stretch, (n.y + m.y) * stretch};
}

void shape_convex(struct batch *batch, const float *xy, int count, float scale, uint32_t color)
{
    struct point points[CONVEX_MAX];
    int n = device_points(xy, count, scale, points);
    float area = n >= 3 ? twice_area(points, n) : 0.0f;
    if (area == 0.0f) return;
    uint32_t base = batch_reserve(batch, 2 * n, 9 * n - 6);
    for (int i = 0; i < n; i++) {
        struct point out = outward(points, n, i, area > 0.0f ? 1.0f : -1.0f);
        struct batch_vertex inner = shape_vertex(points[i].x - 0.5f * out.x, points[i].y - 0.5f * out.y, color);
        struct batch_vertex outer = shape_vertex(points[i].x + 0.5f * out.x, points[i].y + 0.5f * out.y, color);
        outer.across = 1.0f;
        batch_add(batch, inner);
        batch_add(batch, outer);
    }
    for (int i = 0; i < n; i++) {
        uint32_t here = base + 2 * (uint32_t)i, next = base + 2 * (uint32_t)((i + 1) % n);
        batch_triangle(batch, here, here + 1, next);
        batch_triangle(batch, next, here + 1, next + 1);
    }
    for (int i = 2; i < n; i++) batch_triangle(batch, base, base + 2 * (uint32_t)(i - 1), base + 2 * (uint32_t)i);
}
