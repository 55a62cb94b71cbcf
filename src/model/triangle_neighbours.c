/// Finds the triangles across edges: an edge a → b is b → a there.
#include "base/need.h"
#include "model/adjacency.h"
#include <math.h>
#include <stdlib.h>

/// Corners that are looked at for one edge: more at one place are a mesh that has collapsed.
enum { CORNERS_MAX = 64 };

struct corners {
    uint32_t *spot;   ///< of each vertex: the first one at its place
    int *last, *many; ///< of each such vertex: a corner there, and how many
    int *before;      ///< of each corner: the one before it at the same place, −1: none
};

/// Places on a grid so fine that it joins only what was meant to be one: a ring whose last vertex is its first but for rounding.
static float (*snap(const float (*position)[3], int count))[3]
{
    static const float CELLS = 1 << 20;
    float(*snapped)[3] = need((size_t)count + 1, sizeof *snapped), largest = 0.0f;
    for (int i = 0; i < 3 * count; i++) largest = fmaxf(largest, fabsf(position[i / 3][i % 3]));
    const float cell = largest / CELLS;
    for (int i = 0; i < 3 * count; i++) {
        const float place = position[i / 3][i % 3];
        snapped[i / 3][i % 3] = cell > 0.0f ? cell * roundf(place / cell) : place;
    }
    return snapped;
}

static void merge_vertices(const struct spot *spots, int count, uint32_t *spot)
{
    for (int i = 0; i < count; i++) {
        const bool same = i > 0 && spots_meet(&spots[i - 1], &spots[i]);
        spot[spots[i].vertex] = same ? spot[spots[i - 1].vertex] : spots[i].vertex;
    }
}

static void list_corners(struct corners *corners, int vertex_count, const uint32_t *indices, int index_count)
{
    for (int v = 0; v < vertex_count; v++) corners->last[v] = -1;
    for (int i = 0; i < index_count; i++) {
        const uint32_t spot = corners->spot[indices[i]];
        corners->before[i] = corners->last[spot];
        corners->last[spot] = i;
        corners->many[spot]++;
    }
}

static int corner_before(int i) { return i % 3 == 0 ? i + 2 : i - 1; }

/// Of the edge from a corner: the triangle across. Of its ends, the one with fewer corners is looked at, so that the middle of a large fan costs nothing.
static int find_one(const struct corners *corners, const uint32_t *indices, int corner)
{
    const uint32_t from = corners->spot[indices[corner]], to = corners->spot[indices[next_corner(corner)]];
    const uint32_t third = corners->spot[indices[corner_before(corner)]];
    const bool at_end = corners->many[to] <= corners->many[from];
    int back = NEIGHBOUR_NONE, other = corners->last[at_end ? to : from];
    for (int n = 0; other >= 0 && n < CORNERS_MAX; n++, other = corners->before[other]) {
        const int begins = at_end ? other : corner_before(other), ends = next_corner(begins);
        if (corners->spot[indices[begins]] != to || corners->spot[indices[ends]] != from) continue;
        if (corners->spot[indices[next_corner(ends)]] != third) return begins / 3;
        back = begins / 3;
    }
    return back;
}

void neighbours_find(const float (*position)[3], int vertex_count, const uint32_t *indices, int index_count,
                     int *neighbours)
{
    const size_t vertices = (size_t)vertex_count + 1;
    float(*snapped)[3] = snap(position, vertex_count);
    struct spot *spots = need(vertices, sizeof *spots);
    struct corners corners = {need(vertices, sizeof *corners.spot), need(vertices, sizeof *corners.last),
                              need_zeroed(vertices, sizeof *corners.many),
                              need((size_t)index_count + 1, sizeof *corners.before)};
    spots_sort((const float(*)[3])snapped, vertex_count, spots);
    merge_vertices(spots, vertex_count, corners.spot);
    list_corners(&corners, vertex_count, indices, index_count);
    for (int i = 0; i < index_count; i++) neighbours[i] = find_one(&corners, indices, i);
    free(snapped);
    free(spots);
    free(corners.spot);
    free(corners.last);
    free(corners.many);
    free(corners.before);
}

/// The corner of a triangle that is nearest to a place.
static int corner_at(const float (*position)[3], const uint32_t *indices, int triangle, const float place[3])
{
    int nearest = 3 * triangle;
    float least = INFINITY;
    for (int i = 3 * triangle; i < 3 * triangle + 3; i++) {
        const float *own = position[indices[i]];
        const float x = own[0] - place[0], y = own[1] - place[1], z = own[2] - place[2];
        const float distance = x * x + y * y + z * z;
        if (distance >= least) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

void neighbours_cut(const float (*position)[3], const uint32_t *indices, const uint32_t *look, int index_count,
                    int *neighbours)
{
    for (int i = 0; i < index_count; i++) {
        const int other = neighbours[i], ends[2] = {i, next_corner(i)};
        if (other < 0 || other > i / 3) continue;
        for (int e = 0; e < 2; e++) {
            const int there = corner_at(position, indices, other, position[indices[ends[e]]]);
            if (look[there] != look[ends[e]]) neighbours[i] = NEIGHBOUR_CUT;
        }
    }
}

uint32_t neighbours_look(int material, const float color[3])
{
    uint32_t look = (uint32_t)material;
    for (int k = 0; k < 3; k++) look = look << 4 | (uint32_t)lroundf(8.0f * fminf(fmaxf(color[k], 0.0f), 1.0f));
    return look;
}
