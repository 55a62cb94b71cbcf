/// Drops points of a polyline whose absence nobody would see.
#include "draw/paint.h"
#include "model/vector.h"

/// Device pixels. Software rasterisers pay by the triangle, but from a fifteenth of a pixel up, steps show in slow curves.
static const float TOLERANCE = 0.05f;
static const float COINCIDENT = 0.01f;

/// The directions from the anchor that pass every point since within TOLERANCE: a cone that only narrows.
struct cone {
    vec2s anchor, low, high;
    vec2s last;  ///< newest point inside
    float reach; ///< its distance from the anchor
    bool has_last;
};

static void restart(struct cone *cone, vec2s anchor) { *cone = (struct cone){.anchor = anchor}; }

/// Narrows the cone to pass `p`; false if the line must bend at the point before it.
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
        // Past a turning point the direction may still fit, but the tip must stay.
        if (!inside || distance < cone->reach) return false;
        if (glms_vec2_cross(cone->low, low) > 0.0f) cone->low = low;
        if (glms_vec2_cross(high, cone->high) > 0.0f) cone->high = high;
    }
    cone->last = p;
    cone->reach = distance;
    cone->has_last = true;
    return true;
}

int simplify_line(const float *xy, int count, float scale, struct line_point *out, int capacity, int *read)
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
