/// Turns draw lists into anti-aliased triangles and draws them in painter's order with few calls.
#include "draw/paint.h"
#include "base/need.h"
#include "base/progress.h"
#include "model/vector.h"
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_POINTS = 8192 };

/// Working memory: a line in device pixels, and one of its dashes.
struct line_scratch {
    struct line_point {
        float x, y;
        float along; ///< distance from the nearer end + 1/2, or 1 if the line is closed
    } points[LINE_POINTS], dash[LINE_POINTS];
};

// --- the batch

bool batch_create(struct batch *batch, struct error *error)
{
    *batch = (struct batch){
        .vertices = need_zeroed(BATCH_VERTICES, sizeof *batch->vertices),
        .indices = need_zeroed(BATCH_INDICES, sizeof *batch->indices),
        .parts = need_zeroed(BATCH_PARTS, sizeof *batch->parts),
        .scratch = need_zeroed(1, sizeof *batch->scratch),
    };
    batch->program = gl_program("ui.vert", "ui.frag", NULL, error);
    if (!batch->program) {
        batch_destroy(batch);
        return false;
    }
    batch->framebuffer_uniform = glGetUniformLocation(batch->program, "framebuffer");
    batch->atlas_size_uniform = glGetUniformLocation(batch->program, "atlas_size");

    const size_t stride = sizeof(struct batch_vertex);
    glGenVertexArrays(1, &batch->array);
    glBindVertexArray(batch->array);
    batch->vertex_buffer = gl_buffer(GL_ARRAY_BUFFER, 0, NULL, GL_STREAM_DRAW);
    batch->index_buffer = gl_buffer(GL_ELEMENT_ARRAY_BUFFER, 0, NULL, GL_STREAM_DRAW);
    gl_attribute(0, 2, GL_FLOAT, stride, offsetof(struct batch_vertex, x));
    gl_attribute(1, 2, GL_FLOAT, stride, offsetof(struct batch_vertex, u));
    gl_attribute(2, 4, GL_UNSIGNED_BYTE, stride, offsetof(struct batch_vertex, color));
    gl_attribute(3, 3, GL_FLOAT, stride, offsetof(struct batch_vertex, across));
    glBindVertexArray(0);
    return true;
}

void batch_destroy(struct batch *batch)
{
    glDeleteProgram(batch->program);
    glDeleteVertexArrays(1, &batch->array);
    glDeleteBuffers(1, &batch->vertex_buffer);
    glDeleteBuffers(1, &batch->index_buffer);
    free(batch->vertices);
    free(batch->indices);
    free(batch->parts);
    free(batch->scratch);
    *batch = (struct batch){0};
}

void batch_begin(struct batch *batch, int width, int height, float scale, const struct atlas *atlas, GLuint texture)
{
    batch->vertex_count = batch->index_count = batch->part_count = 0;
    batch->generation++;
    batch->width = width;
    batch->height = height;
    batch->scale = scale;
    batch->atlas = atlas;
    batch->texture = texture;
    batch->upload_us = 0.0;
    batch->uploaded_bytes = 0;
    batch->scissor = (struct area){0, 0, width, height};
}

void batch_flush(struct batch *batch)
{
    if (batch->part_count > 0) {
        glBindVertexArray(batch->array);
        glBindBuffer(GL_ARRAY_BUFFER, batch->vertex_buffer);
        double start = clock_now();
        size_t vertex_bytes = (size_t)batch->vertex_count * sizeof *batch->vertices;
        size_t index_bytes = (size_t)batch->index_count * sizeof *batch->indices;
        // New storage each time, so that the driver need not wait until the GPU has read the old one.
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)vertex_bytes, batch->vertices, GL_STREAM_DRAW);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)index_bytes, batch->indices, GL_STREAM_DRAW);
        batch->uploaded_bytes += (long)(vertex_bytes + index_bytes);
        batch->upload_us += 1e6 * (clock_now() - start);

        glViewport(0, 0, batch->width, batch->height);
        glUseProgram(batch->program);
        glUniform2f(batch->framebuffer_uniform, (float)batch->width, (float)batch->height);
        glUniform2f(batch->atlas_size_uniform, (float)batch->atlas->width, (float)batch->atlas->height);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, batch->texture);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glEnable(GL_SCISSOR_TEST);
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        for (const struct batch_part *part = batch->parts; part < batch->parts + batch->part_count; part++) {
            gl_scissor(part->scissor, batch->height);
            if (part->fill) {
                gl_clear(part->fill);
            } else if (part->count > 0) {
                const void *offset = (const void *)((size_t)part->first * sizeof *batch->indices);
                glDrawElements(GL_TRIANGLES, part->count, GL_UNSIGNED_INT, offset);
            }
        }
        glBindVertexArray(0);
        glDisable(GL_BLEND);
    }
    batch->vertex_count = batch->index_count = batch->part_count = 0;
    batch->generation++;
}

/// Starts a new part; there must be room.
static struct batch_part *open_part(struct batch *batch)
{
    if (batch->part_count == BATCH_PARTS) batch_flush(batch);
    struct batch_part *part = &batch->parts[batch->part_count++];
    *part = (struct batch_part){.scissor = batch->scissor, .first = batch->index_count};
    return part;
}

/// Fills an area with an opaque colour 0xRRGGBBAA. For large areas this is cheaper than triangles.
static void fill(struct batch *batch, struct area area, uint32_t color)
{
    struct area visible = area_intersect(area, batch->scissor);
    if (area_empty(visible)) return;
    struct batch_part *part = open_part(batch);
    part->scissor = visible;
    part->fill = color;
}

/// Makes room, flushing if necessary, and returns the index of the next vertex.
static uint32_t reserve(struct batch *batch, int vertices, int indices)
{
    if (vertices > BATCH_VERTICES - batch->vertex_count || indices > BATCH_INDICES - batch->index_count)
        batch_flush(batch);
    const struct batch_part *last = batch->part_count ? &batch->parts[batch->part_count - 1] : NULL;
    if (!last || last->fill || memcmp(&last->scissor, &batch->scissor, sizeof batch->scissor) != 0) open_part(batch);
    return (uint32_t)batch->vertex_count;
}

static void add_triangle(struct batch *batch, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *out = batch->indices + batch->index_count;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    batch->index_count += 3;
    batch->parts[batch->part_count - 1].count += 3;
}

// --- filled shapes

/// Above this size glClear is cheaper than two triangles (measured with llvmpipe).
enum { FILL_PIXELS = 4096, CONVEX_MAX = 128 };

/// A vertex of a filled shape: full coverage, white texel.
static struct batch_vertex shape_vertex(float x, float y, uint32_t color)
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

/// A rectangle: corners in device pixels and in the atlas.
struct quad {
    float x0, y0, x1, y1, u0, v0, u1, v1;
};

static void add_quad(struct batch *batch, const struct quad *quad, uint32_t color)
{
    const float x[4] = {quad->x0, quad->x1, quad->x1, quad->x0}, y[4] = {quad->y0, quad->y0, quad->y1, quad->y1};
    const float u[4] = {quad->u0, quad->u1, quad->u1, quad->u0}, v[4] = {quad->v0, quad->v0, quad->v1, quad->v1};
    uint32_t base = reserve(batch, 4, 6);
    for (int i = 0; i < 4; i++) {
        struct batch_vertex vertex = shape_vertex(x[i], y[i], color);
        vertex.u = u[i];
        vertex.v = v[i];
        batch->vertices[batch->vertex_count++] = vertex;
    }
    add_triangle(batch, base, base + 1, base + 2);
    add_triangle(batch, base, base + 2, base + 3);
}

/// Fills from (x0, y0) to (x1, y1).
static void add_whole(struct batch *batch, float x0, float y0, float x1, float y1, uint32_t color)
{
    add_quad(batch, &(struct quad){x0, y0, x1, y1, 0.5f, 0.5f, 0.5f, 0.5f}, color);
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

/// The rectangle from (x0, y0) to (x1, y1) in device pixels, clipped to `clip`. A partly covered pixel gets exactly that share of the
/// colour.
static void add_rectangle(struct batch *batch, const float corners[4], struct area clip, uint32_t color)
{
    struct span columns[3], rows[3];
    int column_count = cut_spans(corners[0], corners[2], clip.x0, clip.x1, columns);
    int row_count = cut_spans(corners[1], corners[3], clip.y0, clip.y1, rows);
    for (int i = 0; i < row_count; i++) {
        for (int j = 0; j < column_count; j++) {
            struct area area = {columns[j].from, rows[i].from, columns[j].to, rows[i].to};
            const float coverage = columns[j].coverage * rows[i].coverage;
            uint32_t shade = (color & 0xFFFFFF00u) | (uint32_t)lroundf((float)(color & 0xFFu) * coverage);
            if ((shade & 0xFFu) == 0xFFu && area_pixels(area) >= FILL_PIXELS) {
                fill(batch, area, shade);
            } else {
                add_whole(batch, (float)area.x0, (float)area.y0, (float)area.x1, (float)area.y1, shade);
            }
        }
    }
}

/// How far point i moves if both its edges move out by one pixel: the mitre of the normals.
static vec2s outward(const vec2s *points, int count, int i, float side)
{
    vec2s before = points[(i + count - 1) % count], p = points[i], after = points[(i + 1) % count];
    float a = side / hypotf(p.x - before.x, p.y - before.y), b = side / hypotf(after.x - p.x, after.y - p.y);
    vec2s n = {{(p.y - before.y) * a, (before.x - p.x) * a}}, m = {{(after.y - p.y) * b, (p.x - after.x) * b}};
    float stretch = 1.0f / fmaxf(1.0f + n.x * m.x + n.y * m.y, 0.25f);
    return (vec2s){{(n.x + m.x) * stretch, (n.y + m.y) * stretch}};
}

/// A convex polygon of `count` points in logical pixels.
static void add_convex(struct batch *batch, const float *xy, int count, float scale, uint32_t color)
{
    vec2s points[CONVEX_MAX];
    int n = 0; // in device pixels, without coinciding neighbours
    for (int i = 0; i < count && n < CONVEX_MAX; i++) {
        vec2s p = {{xy[2 * i] * scale, xy[2 * i + 1] * scale}};
        if (n && hypotf(p.x - points[n - 1].x, p.y - points[n - 1].y) < 0.01f) continue;
        points[n++] = p;
    }
    while (n > 1 && hypotf(points[0].x - points[n - 1].x, points[0].y - points[n - 1].y) < 0.01f) n--;
    if (n < 3) return;
    float area = 0.0f; // twice the signed one, whose sign gives the winding
    for (int i = 0; i < n; i++) {
        vec2s a = points[i], b = points[(i + 1) % n];
        area += (a.x - points[0].x) * (b.y - points[0].y) - (b.x - points[0].x) * (a.y - points[0].y);
    }
    if (area == 0.0f) return;
    uint32_t base = reserve(batch, 2 * n, 9 * n - 6);
    for (int i = 0; i < n; i++) {
        vec2s out = outward(points, n, i, area > 0.0f ? 1.0f : -1.0f);
        struct batch_vertex inner = shape_vertex(points[i].x - 0.5f * out.x, points[i].y - 0.5f * out.y, color);
        struct batch_vertex outer = shape_vertex(points[i].x + 0.5f * out.x, points[i].y + 0.5f * out.y, color);
        outer.across = 1.0f;
        batch->vertices[batch->vertex_count++] = inner;
        batch->vertices[batch->vertex_count++] = outer;
    }
    for (int i = 0; i < n; i++) {
        uint32_t here = base + 2 * (uint32_t)i, next = base + 2 * (uint32_t)((i + 1) % n);
        add_triangle(batch, here, here + 1, next);
        add_triangle(batch, next, here + 1, next + 1);
    }
    for (int i = 2; i < n; i++) add_triangle(batch, base, base + 2 * (uint32_t)(i - 1), base + 2 * (uint32_t)i);
}

// The area of a line that goes up and down between points, with one point per pixel column.
//
// Columns are grouped into stretches. The rows that a whole stretch covers are one rectangle: software rasterisers draw triangles one pixel
// wide and a panel high as slowly as ones four pixels wide. Strips follow the edges above and below:
//
//     out   o---o---o---o      half a pixel beyond the edge: no coverage
// half a pixel inside: full coverage
//           |           |
//     core  o-----------o      the rectangle's side

enum { STRETCH = 16 }; ///< columns

struct stretch {
    float x[STRETCH], top[STRETCH], bottom[STRETCH]; ///< edges of the line per column
    int count;
    float core_top, core_bottom; ///< the rows that all columns cover
};

static void add_edge(struct batch *batch, const struct stretch *s, const float *edge, float outward, float core,
                     uint32_t color)
{
    const uint32_t base = reserve(batch, 3 * s->count, 12 * (s->count - 1));
    for (int i = 0; i < s->count; i++) {
        struct batch_vertex out = shape_vertex(s->x[i], edge[i] + 0.5f * outward, color);
        out.across = 1.0f;
        batch->vertices[batch->vertex_count++] = out;
        batch->vertices[batch->vertex_count++] = shape_vertex(s->x[i], edge[i] - 0.5f * outward, color);
        batch->vertices[batch->vertex_count++] = shape_vertex(s->x[i], core, color);
    }
    for (uint32_t i = 0; i + 1 < (uint32_t)s->count; i++) {
        for (uint32_t row = 0; row < 2; row++) {
            const uint32_t here = base + 3 * i + row;
            add_triangle(batch, here, here + 1, here + 3);
            add_triangle(batch, here + 3, here + 1, here + 4);
        }
    }
}

/// Fills everything between each of `count` points and the next, `width` wide. Points and width are logical pixels; x never decreases.
static void add_band(struct batch *batch, const float *xy, int count, float width, float scale, uint32_t color)
{
    const float reach = 0.5f * fmaxf(width * scale, 1.0f);
    for (int first = 0; first + 2 < count;) {
        // The most columns that have a row in common. Neighbours always do, because they share a point.
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
        add_whole(batch, s.x[0], s.core_top, s.x[s.count - 1], s.core_bottom, color);
        add_edge(batch, &s, s.top, -1.0f, s.core_top, color);
        add_edge(batch, &s, s.bottom, 1.0f, s.core_bottom, color);
        first += s.count - 1; // the next stretch starts with this one's last column
    }
}

// The triangle strip of one line, segment by segment, in device pixels.
//
// A line is a strip of quads, one per segment, half a pixel wider on each side than the line. Each vertex has its signed distance `across`
// from the middle, which the shader turns into coverage. At gentle joints both quads share the mitre's two corners, equally far from both
// lines: no seam, and nothing is drawn twice, so translucent lines look right. At hairpins the outer side is a fan around the joint (a
// round join).
//
//        in[0] ----- mitre ----- out[0]        left:  across = +reach
//          p0 --------- p --------- p1
//        in[1] ----- mitre ----- out[1]        right: across = −reach

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

static void add_beside(const struct stroke *stroke, vec2s at, float across, float along)
{
    struct batch_vertex vertex = shape_vertex(at.x, at.y, stroke->color);
    vertex.across = across;
    vertex.reach = stroke->reach;
    vertex.along = along;
    stroke->batch->vertices[stroke->batch->vertex_count++] = vertex;
}

static void add_pair(const struct stroke *stroke, struct side_pair pair, float along)
{
    add_beside(stroke, pair.at[0], stroke->reach, along);
    add_beside(stroke, pair.at[1], -stroke->reach, along);
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
    uint32_t base = reserve(stroke->batch, FAN_STEPS + 4, 3 * (FAN_STEPS + 2));
    add_beside(stroke, (vec2s){{p.x, p.y}}, 0.0f, p.along);
    add_beside(stroke, joint->in.at[inner], -side * stroke->reach, p.along);
    for (int i = 0; i <= FAN_STEPS; i++) {
        float angle = start + turn * (float)i / FAN_STEPS;
        add_beside(stroke, offset(p, (vec2s){{cosf(angle), sinf(angle)}}, stroke->reach), side * stroke->reach,
                   p.along);
    }
    add_beside(stroke, joint->out.at[inner], -side * stroke->reach, p.along);
    uint32_t arc = base + 2;
    for (uint32_t i = 0; i < FAN_STEPS; i++) add_triangle(stroke->batch, base, arc + i, arc + i + 1);
    bool shared = joint->in.at[inner].x == joint->out.at[inner].x && joint->in.at[inner].y == joint->out.at[inner].y;
    if (!shared) return;
    add_triangle(stroke->batch, base, base + 1, arc);
    add_triangle(stroke->batch, base, arc + FAN_STEPS, arc + FAN_STEPS + 1);
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

/// Adds the triangles of a line of at least two points; omits segments outside the clip.
static void add_stroke(struct stroke *stroke, struct polyline line)
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
        if (visible) {
            uint32_t corner = reserve(stroke->batch, 4, 6);
            if (!stroke->linked || stroke->generation != stroke->batch->generation) {
                add_pair(stroke, from, from_along);
                stroke->left = corner;
                stroke->right = corner + 1;
                corner += 2;
            }
            add_pair(stroke, joint.in, along);
            add_triangle(stroke->batch, stroke->left, stroke->right, corner);
            add_triangle(stroke->batch, corner, stroke->right, corner + 1);
            stroke->left = corner;
            stroke->right = corner + 1;
            stroke->generation = stroke->batch->generation;
        }
        // A hairpin's inner corner lies far from the joint but beside both segments.
        if (!joint.smooth && (visible || is_visible(stroke, p[i], point_after(line, i))))
            add_fan(stroke, p[i], &joint);
        stroke->linked = visible && joint.smooth;
        from_along = along;
        segment = next;
    }
}

// --- polylines

/// A line with more dashes extends far beyond any screen; it is drawn solid.
enum { DASHES_MAX = 10000 };

/// Adds an open line. Sets `along` and splits it in the middle, so that each quad's `along` is linear. `points` has room for one more.
static void add_open(struct stroke *stroke, struct line_point *points, int count)
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
    if (must_split && !(b.along <= a.along)) {
        for (int i = count++; i > after; i--) points[i] = points[i - 1];
        float t = (0.5f * total - a.along) / (b.along - a.along);
        points[after] = (struct line_point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, 0.5f * total + 0.5f};
    }
    add_stroke(stroke, (struct polyline){points, count, false});
}

/// Cuts a line into dashes of `on` and gaps of `off` device pixels, each drawn as an open line.
static void add_dashes(struct stroke *stroke, int count, float on, float off)
{
    struct line_point *dash = stroke->batch->scratch->dash;
    const struct line_point *p = stroke->batch->scratch->points;
    float left = on; // remaining length of the current dash or gap
    bool inked = true;
    int length = 0;
    dash[length++] = p[0];
    for (int i = 1; i < count; i++) {
        struct line_point at = p[i - 1];
        float rest = hypotf(p[i].x - at.x, p[i].y - at.y);
        while (rest > left) {
            const float t = left / rest;
            at = (struct line_point){at.x + (p[i].x - at.x) * t, at.y + (p[i].y - at.y) * t, 0.0f};
            rest -= left;
            if (inked) {
                dash[length++] = at;
                add_open(stroke, dash, length);
            }
            inked = !inked;
            left = inked ? on : off;
            length = 0;
            if (inked) dash[length++] = at;
        }
        left -= rest;
        if (inked && length < LINE_POINTS - 2) dash[length++] = p[i];
    }
    if (inked && length > 1) add_open(stroke, dash, length);
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

/// Adds a polyline in logical pixels; omits parts that cannot touch `visible`.
static void add_line(struct batch *batch, const struct draw_command *command, const float *xy, struct area visible)
{
    struct line_point *p = batch->scratch->points;
    const float scale = batch->scale, width = command->width * scale;
    const float on = command->on * scale, off = command->off * scale;
    float alpha = (float)(command->color & 0xFFu) * fminf(width, 1.0f); // a line thinner than a pixel gets fainter
    struct stroke stroke = {
        .batch = batch,
        .visible = visible,
        .color = (command->color & 0xFFFFFF00u) | (uint32_t)lroundf(alpha),
        .reach = 0.5f * fmaxf(width, 1.0f) + 0.5f,
    };
    for (int left = command->count, read = 0; left > 1; xy += 2 * (read - 1), left -= read - 1) {
        // Device pixels, without points within TOLERANCE of the simplified line, whose ends stay. `read` is the number of points used; the
        // next piece continues at the last of them.
        struct cone cone = {.anchor = {{xy[0] * scale, xy[1] * scale}}};
        p[0] = (struct line_point){.x = cone.anchor.x, .y = cone.anchor.y};
        int count = 1;
        for (read = 1; read < left; read++) {
            const vec2s at = {{xy[2 * read] * scale, xy[2 * read + 1] * scale}};
            const vec2s before = cone.has_last ? cone.last : cone.anchor;
            if (hypotf(at.x - before.x, at.y - before.y) < COINCIDENT || extend(&cone, at)) continue;
            p[count++] = (struct line_point){.x = cone.last.x, .y = cone.last.y};
            cone = (struct cone){.anchor = cone.last};
            if (count == LINE_POINTS - 1) break;
            extend(&cone, at);
        }
        if (read == left && cone.has_last) p[count++] = (struct line_point){.x = cone.last.x, .y = cone.last.y};
        const bool dashed = on > 0.0f && off > 0.0f;
        float length = 0.0f;
        for (int i = 1; dashed && i < count; i++) length += hypotf(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
        if (count > 1 && dashed && length < DASHES_MAX * (on + off)) {
            add_dashes(&stroke, count, on, off);
        } else if (count > 3 && hypotf(p[0].x - p[count - 1].x, p[0].y - p[count - 1].y) < 0.05f) {
            p[count - 1] = p[0];
            for (int i = 0; i < count; i++) p[i].along = 1.0f;
            add_stroke(&stroke, (struct polyline){p, count, true});
        } else if (count > 1) {
            add_open(&stroke, p, count);
        }
        if (read == left) break;
    }
}

// --- text and lists

/// Clips an interval to [low, high] and its texels in proportion; false if it is empty.
static bool clip_axis(float *from, float *to, float *texel_from, float *texel_to, int low, int high)
{
    float slope = (*texel_to - *texel_from) / (*to - *from);
    if (*from < (float)low) {
        *texel_from += ((float)low - *from) * slope;
        *from = (float)low;
    }
    if (*to > (float)high) {
        *texel_to -= (*to - (float)high) * slope;
        *to = (float)high;
    }
    return *to > *from;
}

/// A line of text with its pen at (x, y) in logical pixels, clipped to `clip`.
static void add_text(struct batch *batch, const struct draw_command *command, const char *text, struct area clip)
{
    float pen = roundf(command->x * batch->scale), baseline = roundf(command->y * batch->scale);
    for (uint32_t c; (c = utf8_next(&text)) != 0;) {
        const struct glyph *glyph = atlas_glyph(batch->atlas, command->font, command->width, c);
        struct quad quad = {
            pen + glyph->xoff,  baseline + glyph->yoff,
            pen + glyph->xoff2, baseline + glyph->yoff2,
            glyph->x0,          glyph->y0,
            glyph->x1,          glyph->y1,
        };
        pen += glyph->advance;
        if (glyph->x1 == glyph->x0) continue;
        if (!clip_axis(&quad.x0, &quad.x1, &quad.u0, &quad.u1, clip.x0, clip.x1)) continue;
        if (!clip_axis(&quad.y0, &quad.y1, &quad.v0, &quad.v1, clip.y0, clip.y1)) continue;
        add_quad(batch, &quad, command->color);
    }
}

void paint_list(struct batch *batch, const struct drawlist *list, struct area area)
{
    const float s = batch->scale;
    batch->scissor = area;
    for (const struct draw_command *command = list->commands; command < list->commands + list->count; command++) {
        const struct rect b = command->bounds, c = command->clip;
        const struct area reach = area_outer(b, s), clip = area_rounded(c, s);
        const float *xy = list->points + 2 * (size_t)command->first;
        if (!area_touches(reach, area)) continue;
        // Lines and polygons that extend beyond their clip need it as scissor. Other commands keep the current scissor if possible, because
        // every change costs a draw call.
        const bool is_whole = b.x > c.x && b.y > c.y && b.x + b.w < c.x + c.w && b.y + b.h < c.y + c.h;
        if (command->kind != DRAW_RECT && command->kind != DRAW_TEXT && !is_whole) {
            batch->scissor = area_intersect(clip, area);
        } else if (!area_contains(batch->scissor, area_intersect(reach, area))) {
            batch->scissor = area;
        }
        switch (command->kind) {
        case DRAW_RECT:
            add_rectangle(batch, (const float[4]){xy[0] * s, xy[1] * s, xy[2] * s, xy[3] * s}, clip, command->color);
            break;
        case DRAW_LINE:
            add_line(batch, command, xy, area_intersect(clip, area));
            break;
        case DRAW_BAND:
            add_band(batch, xy, command->count, command->width, s, command->color);
            break;
        case DRAW_CONVEX:
            add_convex(batch, xy, command->count, s, command->color);
            break;
        case DRAW_TEXT:
            add_text(batch, command, list->text + command->first, clip);
            break;
        }
    }
}
