/// Emits an anti-aliased polyline, segment by segment.
//
// A line is a strip of quads, one per segment, half a pixel wider on each side than the line. Each vertex has its signed distance `across`
// from the middle, which the shader turns into coverage. At gentle joints both quads share the mitre's two corners, equally far from both
// lines: no seam, and nothing is drawn twice, so translucent lines look right. At hairpins the outer side is a fan around the joint (a
// round join).
//
//        in[0] ----- mitre ----- out[0]        left:  across = +reach
//          p0 --------- p --------- p1
//        in[1] ----- mitre ----- out[1]        right: across = −reach

#include "draw/paint.h"
#include "model/vector.h"

/// Beyond 120° a mitre would be longer than the line is wide.
static const float SHARPEST_MITRE = -0.5f;
enum { FAN_STEPS = 8 };

struct segment {
    vec2s direction;
    float length;
};

/// Two sides of a quad's end: [0] left, [1] right.
struct side_pair {
    vec2s at[2];
};

struct joint {
    struct side_pair in, out; ///< end of the quad before, start of the quad after
    bool smooth;              ///< in and out are the same
    int outer;                ///< the outer side of the hairpin
};

static struct segment segment_between(struct line_point a, struct line_point b)
{
    vec2s d = {{b.x - a.x, b.y - a.y}};
    float length = fmaxf(hypotf(d.x, d.y), 1.0e-6f);
    return (struct segment){glms_vec2_divs(d, length), length};
}

static vec2s offset(struct line_point p, vec2s direction, float by)
{
    return (vec2s){{p.x + direction.x * by, p.y + direction.y * by}};
}

/// The two points beside `p`. Left of a direction on the screen is (y, −x), because y points down.
static struct side_pair beside(struct line_point p, vec2s direction, float reach)
{
    vec2s normal = {{direction.y, -direction.x}};
    return (struct side_pair){{offset(p, normal, reach), offset(p, normal, -reach)}};
}

static struct joint joint_at(struct line_point p, struct segment before, struct segment after, float reach)
{
    vec2s a = before.direction, b = after.direction;
    float cosine = a.x * b.x + a.y * b.y, sine = a.x * b.y - a.y * b.x;
    // The mitre's corner lies reach · tan(angle / 2) along both segments and must not pass their other ends.
    float back = cosine > -0.999f ? reach * fabsf(sine) / (1.0f + cosine) : INFINITY;
    bool fits = back <= fminf(before.length, after.length);
    struct joint joint = {
        .in = beside(p, a, reach), .out = beside(p, b, reach), .smooth = false, .outer = sine > 0.0f ? 0 : 1};
    if (!fits) return joint;
    vec2s mitre = {{(a.y + b.y) / (1.0f + cosine), -(a.x + b.x) / (1.0f + cosine)}};
    struct side_pair corners = {{offset(p, mitre, reach), offset(p, mitre, -reach)}};
    joint.smooth = cosine > SHARPEST_MITRE;
    if (joint.smooth) {
        joint.in = joint.out = corners;
    } else {
        int inner = 1 - joint.outer;
        joint.in.at[inner] = joint.out.at[inner] = corners.at[inner];
    }
    return joint;
}

static void add_vertex(const struct stroke *stroke, vec2s at, float across, float along)
{
    struct batch_vertex vertex = shape_vertex(at.x, at.y, stroke->color);
    vertex.across = across;
    vertex.reach = stroke->reach;
    vertex.along = along;
    batch_add(stroke->batch, vertex);
}

static void add_pair(const struct stroke *stroke, struct side_pair pair, float along)
{
    add_vertex(stroke, pair.at[0], stroke->reach, along);
    add_vertex(stroke, pair.at[1], -stroke->reach, along);
}

static void add_quad(struct stroke *stroke, struct side_pair from, float from_along, struct side_pair to,
                     float to_along)
{
    uint32_t next = batch_reserve(stroke->batch, 4, 6);
    if (!stroke->linked || stroke->generation != stroke->batch->generation) {
        add_pair(stroke, from, from_along);
        stroke->left = next;
        stroke->right = next + 1;
        next += 2;
    }
    add_pair(stroke, to, to_along);
    batch_triangle(stroke->batch, stroke->left, stroke->right, next);
    batch_triangle(stroke->batch, next, stroke->right, next + 1);
    stroke->left = next;
    stroke->right = next + 1;
    stroke->generation = stroke->batch->generation;
}

/// Fills the wedge between two quads, from the inner corner around the joint to the outer arc.
static void add_fan(const struct stroke *stroke, struct line_point p, const struct joint *joint)
{
    int outer = joint->outer, inner = 1 - outer;
    float side = outer == 0 ? 1.0f : -1.0f;
    vec2s from = joint->in.at[outer], to = joint->out.at[outer];
    float start = atan2f(from.y - p.y, from.x - p.x), end = atan2f(to.y - p.y, to.x - p.x);
    // The arc turns as the line does: clockwise on the screen (y down) if the outer side is the left one.
    float turn = remainderf(end - start, 2.0f * (float)M_PI);
    if (turn * side < 0.0f) turn += side * 2.0f * (float)M_PI;
    uint32_t base = batch_reserve(stroke->batch, FAN_STEPS + 4, 3 * (FAN_STEPS + 2));
    add_vertex(stroke, (vec2s){{p.x, p.y}}, 0.0f, p.along);
    add_vertex(stroke, joint->in.at[inner], -side * stroke->reach, p.along);
    for (int i = 0; i <= FAN_STEPS; i++) {
        float angle = start + turn * (float)i / FAN_STEPS;
        add_vertex(stroke, offset(p, (vec2s){{cosf(angle), sinf(angle)}}, stroke->reach), side * stroke->reach,
                   p.along);
    }
    add_vertex(stroke, joint->out.at[inner], -side * stroke->reach, p.along);
    uint32_t arc = base + 2;
    for (uint32_t i = 0; i < FAN_STEPS; i++) batch_triangle(stroke->batch, base, arc + i, arc + i + 1);
    bool shared = joint->in.at[inner].x == joint->out.at[inner].x && joint->in.at[inner].y == joint->out.at[inner].y;
    if (!shared) return;
    batch_triangle(stroke->batch, base, base + 1, arc);
    batch_triangle(stroke->batch, base, arc + FAN_STEPS, arc + FAN_STEPS + 1);
}

/// Whether a segment with its mitres can touch the clip.
static bool is_visible(const struct stroke *stroke, struct line_point a, struct line_point b)
{
    float margin = 2.0f * stroke->reach + 1.0f;
    return fmaxf(a.x, b.x) + margin > (float)stroke->visible.x0 &&
           fminf(a.x, b.x) - margin < (float)stroke->visible.x1 &&
           fmaxf(a.y, b.y) + margin > (float)stroke->visible.y0 &&
           fminf(a.y, b.y) - margin < (float)stroke->visible.y1;
}

/// An end of the line: half a pixel beyond the last point, where `along` is 0.
static struct joint cap_at(struct line_point p, vec2s direction, float beyond, float reach)
{
    struct line_point end = {p.x + direction.x * beyond, p.y + direction.y * beyond, 0.0f};
    struct side_pair pair = beside(end, direction, reach);
    return (struct joint){.in = pair, .out = pair, .smooth = true};
}

/// The point after point i, cyclically if closed.
static struct line_point point_after(struct polyline line, int i)
{
    return line.points[i + 1 < line.count ? i + 1 : 1];
}

void stroke_draw(struct stroke *stroke, struct polyline line)
{
    const struct line_point *p = line.points;
    int end = line.count - 1;
    struct segment segment = segment_between(p[0], p[1]);
    struct joint joint = cap_at(p[0], segment.direction, -0.5f, stroke->reach);
    float from_along = 0.0f;
    if (line.closed) {
        joint = joint_at(p[0], segment_between(p[end - 1], p[end]), segment, stroke->reach);
        from_along = p[0].along;
    }
    stroke->linked = false;
    for (int i = 1; i <= end; i++) {
        struct side_pair from = joint.out;
        bool stops = i == end && !line.closed;
        bool visible = is_visible(stroke, p[i - 1], p[i]);
        float along = stops ? 0.0f : p[i].along;
        struct segment next = stops ? segment : segment_between(p[i], point_after(line, i));
        joint = stops ? cap_at(p[i], segment.direction, 0.5f, stroke->reach)
                      : joint_at(p[i], segment, next, stroke->reach);
        if (visible) add_quad(stroke, from, from_along, joint.in, along);
        // A hairpin's inner corner lies far from the joint but beside both segments.
        if (!joint.smooth && (visible || is_visible(stroke, p[i], point_after(line, i))))
            add_fan(stroke, p[i], &joint);
        stroke->linked = visible && joint.smooth;
        from_along = along;
        segment = next;
    }
}
