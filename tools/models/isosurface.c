/// Distances to round cones, and surface nets, which turn a distance into triangles.
#include "models/isosurface.h"
#include "base/need.h"
#include "model/vector.h"
#include "models/mesh.h"
#include <math.h>
#include <stdlib.h>

/// Cell corners are sampled in blocks of this size; a block far from the surface is sampled once.
enum { BLOCK = 4 };

struct grid {
    int n[3]; ///< corners per side
    float lo[3], cell;
    float *distance;  ///< at corners, x fastest
    uint32_t *vertex; ///< of the cell with this lowest corner; NO_VERTEX away from the surface
};

#define NO_VERTEX UINT32_MAX

static size_t corner_index(const struct grid *grid, int x, int y, int z)
{
    return ((size_t)z * (size_t)grid->n[1] + (size_t)y) * (size_t)grid->n[0] + (size_t)x;
}

static void corner_point(const struct grid *grid, float x, float y, float z, float p[3])
{
    p[0] = grid->lo[0] + x * grid->cell;
    p[1] = grid->lo[1] + y * grid->cell;
    p[2] = grid->lo[2] + z * grid->cell;
}

static void sample_block(const struct solid *solid, struct grid *grid, const int from[3])
{
    const float half = 0.5f * (BLOCK - 1);
    float p[3];
    corner_point(grid, (float)from[0] + half, (float)from[1] + half, (float)from[2] + half, p);
    const float middle = solid->distance(p);
    const bool far = fabsf(middle) > sqrtf(3.0f) * (half + 1.0f) * grid->cell;
    for (int z = from[2]; z < from[2] + BLOCK && z < grid->n[2]; z++) {
        for (int y = from[1]; y < from[1] + BLOCK && y < grid->n[1]; y++) {
            for (int x = from[0]; x < from[0] + BLOCK && x < grid->n[0]; x++) {
                corner_point(grid, (float)x, (float)y, (float)z, p);
                grid->distance[corner_index(grid, x, y, z)] = far ? middle : solid->distance(p);
            }
        }
    }
}

static void sample(const struct solid *solid, struct grid *grid)
{
    for (int z = 0; z < grid->n[2]; z += BLOCK) {
        for (int y = 0; y < grid->n[1]; y += BLOCK) {
            for (int x = 0; x < grid->n[0]; x += BLOCK) sample_block(solid, grid, (const int[3]){x, y, z});
        }
    }
}

/// From a tetrahedron's four corners, the fewest possible.
static vec3s gradient(const struct solid *solid, vec3s p, float step)
{
    static const vec3s corner[4] = {{{1, -1, -1}}, {{-1, 1, -1}}, {{-1, -1, 1}}, {{1, 1, 1}}};
    vec3s g = glms_vec3_zero();
    for (int c = 0; c < 4; c++) {
        const vec3s q = glms_vec3_muladds(corner[c], step, p);
        g = glms_vec3_muladds(corner[c], solid->distance(q.raw) / (4.0f * step), g);
    }
    return g;
}

/// Mean of the intersections of the cell's twelve edges with the surface, in cells from the lowest corner.
static bool cell_crossing(const struct grid *grid, int x, int y, int z, float mean[3])
{
    float d[8];
    for (int c = 0; c < 8; c++)
        d[c] = grid->distance[corner_index(grid, x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
    int crossings = 0;
    glm_vec3_zero(mean);
    for (int axis = 0; axis < 3; axis++) {
        for (int c = 0; c < 8; c++) {
            const int other = c | 1 << axis;
            if (other == c || (d[c] < 0.0f) == (d[other] < 0.0f)) continue;
            for (int k = 0; k < 3; k++) mean[k] += (float)(c >> k & 1);
            mean[axis] += d[c] / (d[c] - d[other]);
            crossings++;
        }
    }
    if (crossings == 0) return false;
    glm_vec3_divs(mean, (float)crossings, mean);
    return true;
}

/// Newton steps along the gradient move the point onto the surface.
void surface_place(const struct solid *solid, float cell, struct vertex *vertex)
{
    vec3s position = vec3_from(vertex->position);
    for (int step = 0; step < 2; step++) {
        const vec3s g = gradient(solid, position, 0.05f * cell);
        const float by = solid->distance(position.raw) / fmaxf(glms_vec3_norm2(g), 1e-6f);
        position = glms_vec3_sub(position, glms_vec3_clamp(glms_vec3_scale(g, by), -cell, cell));
    }
    vec3s normal = gradient(solid, position, 0.25f * cell);
    normal = glms_vec3_divs(normal, fmaxf(glms_vec3_norm(normal), 1e-6f));
    glm_vec3_copy(position.raw, vertex->position);
    glm_vec3_copy(normal.raw, vertex->normal);
    solid->paint(vertex);
}

static void place_vertices(const struct solid *solid, struct grid *grid, struct mesh *mesh)
{
    for (int z = 0; z + 1 < grid->n[2]; z++) {
        for (int y = 0; y + 1 < grid->n[1]; y++) {
            for (int x = 0; x + 1 < grid->n[0]; x++) {
                float mean[3];
                uint32_t *slot = &grid->vertex[corner_index(grid, x, y, z)];
                *slot = NO_VERTEX;
                if (!cell_crossing(grid, x, y, z, mean)) continue;
                struct vertex vertex = {0};
                corner_point(grid, (float)x + mean[0], (float)y + mean[1], (float)z + mean[2], vertex.position);
                surface_place(solid, grid->cell, &vertex);
                *slot = mesh_vertex(mesh, &vertex);
            }
        }
    }
}

/// The quad around the edge that leaves corner c along `axis`, if the surface crosses it. Its corners are the vertices of the four cells at
/// the edge.
static void edge_quad(const struct grid *grid, const int c[3], int axis, struct mesh *mesh)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (c[u] == 0 || c[v] == 0 || c[axis] + 1 >= grid->n[axis]) return;
    int end[3] = {c[0], c[1], c[2]};
    end[axis]++;
    const bool inside = grid->distance[corner_index(grid, c[0], c[1], c[2])] < 0.0f;
    if (inside == (grid->distance[corner_index(grid, end[0], end[1], end[2])] < 0.0f)) return;
    uint32_t quad[4];
    for (int k = 0; k < 4; k++) {
        int cell[3] = {c[0], c[1], c[2]};
        cell[u] -= k == 0 || k == 3;
        cell[v] -= k < 2;
        quad[k] = grid->vertex[corner_index(grid, cell[0], cell[1], cell[2])];
    }
    const int second = inside ? 1 : 3, last = inside ? 3 : 1;
    mesh_triangle(mesh, quad[0], quad[second], quad[2]);
    mesh_triangle(mesh, quad[0], quad[2], quad[last]);
}

static void connect(const struct grid *grid, struct mesh *mesh)
{
    for (int z = 0; z + 1 < grid->n[2]; z++) {
        for (int y = 0; y + 1 < grid->n[1]; y++) {
            for (int x = 0; x + 1 < grid->n[0]; x++) {
                for (int axis = 0; axis < 3; axis++) edge_quad(grid, (const int[3]){x, y, z}, axis, mesh);
            }
        }
    }
}

void isosurface(const struct solid *solid, const float lo[3], const float hi[3], float cell, struct mesh *mesh)
{
    struct grid grid = {.cell = cell};
    size_t corners = 1;
    for (int k = 0; k < 3; k++) {
        grid.n[k] = (int)ceilf((hi[k] - lo[k]) / cell) + 3;
        grid.lo[k] = lo[k] - cell;
        corners *= (size_t)grid.n[k];
    }
    grid.distance = need(corners, sizeof *grid.distance);
    grid.vertex = need(corners, sizeof *grid.vertex);
    sample(solid, &grid);
    place_vertices(solid, &grid, mesh);
    connect(&grid, mesh);
    free(grid.distance);
    free(grid.vertex);
}

/// Distance to a round cone. In the half plane through its axis (x along, r from it), the ball nearest to a point lies where the cone's
/// surface normal through the point, tilted by asin((radius_a − radius_b)/length), meets the axis.
static float part_distance(const struct part *part, const float p[3])
{
    const vec3s from = vec3_from(part->a), axis = glms_vec3_sub(vec3_from(part->b), from);
    const vec3s q = glms_vec3_sub((vec3s){{part->mirror ? fabsf(p[0]) : p[0], p[1], p[2]}}, from);
    const float length = glms_vec3_norm(axis), x = glms_vec3_dot(q, axis) / length;
    const float r = sqrtf(fmaxf(glms_vec3_norm2(q) - x * x, 0.0f));
    const float tilt = (part->radius_a - part->radius_b) / length;
    const float ball = fminf(fmaxf(x - r * tilt / sqrtf(1.0f - tilt * tilt), 0.0f), length);
    return sqrtf((x - ball) * (x - ball) + r * r) - part->radius_a -
           (part->radius_b - part->radius_a) * ball / length;
}

float parts_union(float old, float added, float blend, float rgb[3], const float added_rgb[3])
{
    const float h = fmaxf(blend - fabsf(added - old), 0.0f) / blend;
    const float share = added < old ? 1.0f - 0.5f * h * h : 0.5f * h * h;
    for (int k = 0; rgb && k < 3; k++) rgb[k] += (added_rgb[k] - rgb[k]) * share;
    return fminf(added, old) - 0.25f * h * h * blend;
}

float parts_add(const struct part *table, size_t count, const float p[3], float distance, float rgb[3])
{
    for (size_t i = 0; i < count; i++) {
        float part_rgb[3] = {0};
        if (rgb) coat_linear(table[i].color, part_rgb);
        distance = parts_union(distance, part_distance(&table[i], p), table[i].blend, rgb, part_rgb);
    }
    return distance;
}
