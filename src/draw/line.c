/// Turns polylines into anti-aliased triangle strips and drops points that make no visible difference.
#include "draw/paint.h"
#include "model/vector.h"

/// A line with more dashes extends far beyond any screen; it is drawn solid.
enum { DASHES_MAX = 10000 };

/// Sets `along` of an open line and adds a point at its middle, so that each quad's `along` is linear. `points` has room for one more.
/// Returns the new count.
static int measure_ends(struct line_point *points, int count)
{
    float total = 0.0f;
    points[0].along = 0.0f;
    for (int i = 1; i < count; i++) {
        total += hypotf(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
        points[i].along = total;
    }
    int after = 1;
    while (after < count - 1 && points[after].along < 0.5f * total) after++;
    struct line_point a = points[after - 1], b = points[after];
    bool must_split = fminf(a.along, total - b.along) < 0.5f;
    for (int i = 0; i < count; i++) points[i].along = fminf(points[i].along, total - points[i].along) + 0.5f;
    if (!must_split || b.along <= a.along) return count;
    for (int i = count; i > after; i--) points[i] = points[i - 1];
    float t = (0.5f * total - a.along) / (b.along - a.along);
    points[after] = (struct line_point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, 0.5f * total + 0.5f};
    return count + 1;
}

static void draw_open(struct stroke *stroke, struct line_point *points, int count)
{
    stroke_draw(stroke, (struct polyline){points, measure_ends(points, count), false});
}

static struct line_point between(struct line_point a, struct line_point b, float t)
{
    return (struct line_point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, 0.0f};
}

/// Cuts a line into dashes of `on` and gaps of `off` device pixels, each drawn as an open line.
static void draw_dashes(struct stroke *stroke, struct line_scratch *scratch, int count, float on, float off)
{
    struct line_point *dash = scratch->dash;
    const struct line_point *p = scratch->points;
    float left = on; // remaining length of the current dash or gap
    bool inked = true;
    int length = 0;
    dash[length++] = p[0];
    for (int i = 1; i < count; i++) {
        struct line_point at = p[i - 1];
        float rest = hypotf(p[i].x - at.x, p[i].y - at.y);
        while (rest > left) {
            at = between(at, p[i], left / rest);
            rest -= left;
            if (inked) {
                dash[length++] = at;
                draw_open(stroke, dash, length);
            }
            inked = !inked;
            left = inked ? on : off;
            length = 0;
            if (inked) dash[length++] = at;
        }
        left -= rest;
        if (inked && length < LINE_POINTS - 2) dash[length++] = p[i];
    }
    if (inked && length > 1) draw_open(stroke, dash, length);
}

static float length_of(const struct line_point *p, int count)
{
    float length = 0.0f;
    for (int i = 1; i < count; i++) length += hypotf(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
    return length;
}

static void draw_piece(struct stroke *stroke, struct line_scratch *scratch, int count, const struct line_style *style)
{
    struct line_point *p = scratch->points;
    if (count < 2) return;
    bool closed = count > 3 && hypotf(p[0].x - p[count - 1].x, p[0].y - p[count - 1].y) < 0.05f;
    float on = style->on * style->scale, off = style->off * style->scale;
    if (on > 0.0f && off > 0.0f && length_of(p, count) < DASHES_MAX * (on + off)) {
        draw_dashes(stroke, scratch, count, on, off);
    } else if (closed) {
        p[count - 1] = p[0];
        for (int i = 0; i < count; i++) p[i].along = 1.0f;
        stroke_draw(stroke, (struct polyline){p, count, true});
    } else {
        draw_open(stroke, p, count);
    }
}

/// Device pixels. Software rasterisers pay per triangle, but from 1/15 pixel on, slow curves show steps.
static const float TOLERANCE = 0.05f;
static const float COINCIDENT = 0.01f;

/// The directions from the anchor that pass within TOLERANCE of every point so far; the cone only narrows.
struct cone {
    vec2s anchor, low, high;
    vec2s last;  ///< newest accepted point
    float reach; ///< its distance from the anchor
    bool has_last;
};

static void restart(struct cone *cone, vec2s anchor) { *cone = (struct cone){.anchor = anchor}; }

/// Narrows the cone to include `p`; false if the line must bend at the point before.
static bool extend(struct cone *cone, vec2s p)
{
    vec2s d = {{p.x - cone->anchor.x, p.y - cone->anchor.y}};
    float distance = hypotf(d.x, d.y);
    vec2s side = {{-d.y / distance * TOLERANCE, d.x / distance * TOLERANCE}};
    vec2s low = {{d.x - side.x, d.y - side.y}}, high = {{d.x + side.x, d.y + side.y}};
    if (!cone->has_last) {
        cone->low = low;
        cone->high = high;
    } else {
        bool inside = glms_vec2_cross(cone->low, d) >= 0.0f && glms_vec2_cross(d, cone->high) >= 0.0f;
        // After a turning point the direction may still fit, but the tip must remain.
        if (!inside || distance < cone->reach) return false;
        if (glms_vec2_cross(cone->low, low) > 0.0f) cone->low = low;
        if (glms_vec2_cross(high, cone->high) > 0.0f) cone->high = high;
    }
    cone->last = p;
    cone->reach = distance;
    cone->has_last = true;
    return true;
}

/// Scales points to device pixels and drops those within TOLERANCE of the simplified line. Stops when `out` (`capacity` points, at least 3)
/// is full; returns the number written. `read` is the number of input points used; if it is less than `count`, continue at point read − 1.
/// Keeps both ends.
static int simplify_line(const float *xy, int count, float scale, struct line_point *out, int capacity, int *read)
{
    struct cone cone;
    restart(&cone, (vec2s){{xy[0] * scale, xy[1] * scale}});
    out[0] = (struct line_point){.x = cone.anchor.x, .y = cone.anchor.y};
    int written = 1, i = 1;
    for (; i < count; i++) {
        vec2s p = {{xy[2 * i] * scale, xy[2 * i + 1] * scale}};
        vec2s before = cone.has_last ? cone.last : cone.anchor;
        if (hypotf(p.x - before.x, p.y - before.y) < COINCIDENT) continue;
        if (extend(&cone, p)) continue;
        out[written++] = (struct line_point){.x = cone.last.x, .y = cone.last.y};
        restart(&cone, cone.last);
        if (written == capacity) break;
        extend(&cone, p);
    }
    if (i == count && cone.has_last) out[written++] = (struct line_point){.x = cone.last.x, .y = cone.last.y};
    *read = i;
    return written;
}

void line_add(struct batch *batch, struct line_scratch *scratch, const float *xy, int count, struct line_style style,
              struct area visible)
{
    float width = style.width * style.scale;
    float alpha = (float)(style.color & 0xFFu) * fminf(width, 1.0f); // a line thinner than a pixel gets fainter
    struct stroke stroke = {
        .batch = batch,
        .visible = visible,
        .color = (style.color & 0xFFFFFF00u) | (uint32_t)lroundf(alpha),
        .reach = 0.5f * fmaxf(width, 1.0f) + 0.5f,
    };
    while (count > 1) {
        int read = 0;
        int kept = simplify_line(xy, count, style.scale, scratch->points, LINE_POINTS - 1, &read);
        draw_piece(&stroke, scratch, kept, &style);
        if (read == count) break;
        xy += 2 * (read - 1);
        count -= read - 1;
    }
}
