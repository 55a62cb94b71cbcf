/// The fox's tail, as a tube of rings with skinning weights.
#include "model/fox.h"
#include "models/fox_maker.h"
#include <math.h>

/// Start of the tube inside the torso, of the swelling, and of the tip.
#define TUBE_START (-0.10f)
#define TIP_LENGTH (FOX_TAIL_LENGTH - FOX_TIP_START)

static const float half_turn = 3.14159265f;

/// A ring: place along the tail, radius, and the profile's unit direction there (along, outward).
struct ring {
    float z, radius, along, outward;
};

static struct ring swelling_ring(float z)
{
    const float swell = FOX_TIP_START - FOX_SWELL_START, by = FOX_BRUSH_RADIUS - FOX_TAIL_RADIUS;
    const float t = fminf(fmaxf((z - FOX_SWELL_START) / swell, 0.0f), 1.0f);
    const float slope = by * 6.0f * t * (1.0f - t) / swell;
    const float length = hypotf(1.0f, slope);
    return (struct ring){z, FOX_TAIL_RADIUS + by * t * t * (3.0f - 2.0f * t), 1.0f / length, slope / length};
}

static float tip_radius(float s) { return FOX_BRUSH_RADIUS * sqrtf(1.0f - s * s) * (1.0f - FOX_TIP_POINT * s * s); }

/// `angle` runs from 0 at the tip's start to a quarter turn at its end; rings are closer at higher curvature.
static struct ring tip_ring(float angle)
{
    const float s = sinf(angle), c = cosf(angle);
    const float dz = TIP_LENGTH * c;
    const float dr = -FOX_BRUSH_RADIUS * s * (1.0f - FOX_TIP_POINT * s * s + 2.0f * FOX_TIP_POINT * c * c);
    const float length = hypotf(dz, dr);
    return (struct ring){FOX_TIP_START + TIP_LENGTH * s, tip_radius(s), dz / length, dr / length};
}

static void add_ring(struct ring ring, int segments, struct mesh *mesh)
{
    for (int s = 0; s < segments; s++) {
        const float angle = 2.0f * half_turn * (float)s / (float)segments;
        const float x = cosf(angle), y = sinf(angle);
        struct vertex vertex = {
            .position = {ring.radius * x, ring.radius * y, ring.z},
            .normal = {ring.along * x, ring.along * y, -ring.outward},
            .bend = 1.0f,
            .open = 1.0f,
        };
        coat_tail(ring.z, y, vertex.mark);
        coat_marked(vertex.mark, vertex.color);
        mesh_vertex(mesh, &vertex);
    }
}

/// Two triangles per segment between the ring at vertex `first` and the next.
static void join_rings(uint32_t first, uint32_t segments, struct mesh *mesh)
{
    for (uint32_t s = 0; s < segments; s++) {
        const uint32_t a = first + s, b = first + (s + 1) % segments;
        mesh_triangle(mesh, a, b, b + segments);
        mesh_triangle(mesh, a, b + segments, a + segments);
    }
}

static void close_tip(uint32_t last_ring, uint32_t segments, struct mesh *mesh)
{
    struct vertex tip = {
        .position = {0.0f, 0.0f, FOX_TAIL_LENGTH}, .normal = {0.0f, 0.0f, 1.0f}, .bend = 1.0f, .open = 1.0f};
    coat_tail(FOX_TAIL_LENGTH, 0.0f, tip.mark);
    coat_marked(tip.mark, tip.color);
    const uint32_t end = mesh_vertex(mesh, &tip);
    for (uint32_t s = 0; s < segments; s++) mesh_triangle(mesh, last_ring + s, last_ring + (s + 1) % segments, end);
}

void mesh_fox_tail(int rings, int segments, struct mesh *mesh)
{
    const int tip_rings = rings / 3, swelling_rings = rings - tip_rings;
    const uint32_t first = (uint32_t)mesh->vertex_count, around = (uint32_t)segments;
    for (int r = 0; r < swelling_rings; r++) {
        add_ring(swelling_ring(TUBE_START + (FOX_TIP_START - TUBE_START) * (float)r / (float)swelling_rings),
                 segments, mesh);
    }
    for (int r = 0; r < tip_rings; r++) {
        add_ring(tip_ring(0.5f * half_turn * (float)r / (float)tip_rings), segments, mesh);
    }
    for (uint32_t r = 0; r + 1 < (uint32_t)rings; r++) join_rings(first + r * around, around, mesh);
    close_tip(first + ((uint32_t)rings - 1) * around, around, mesh);
}
