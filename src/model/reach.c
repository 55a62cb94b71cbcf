/// Distances along a surface, by Dijkstra from a few starting points; and where a ray hits triangles.
#include "model/reach.h"
#include "model/vector.h"
#include <math.h>
#include <string.h>

static const float SHORTER = 0.86f; ///< 1/1.16

void reach_create(struct reach *reach, struct pool *pool, int vertices)
{
    const size_t room = (size_t)vertices;
    *reach = (struct reach){.capacity = vertices};
    reach->distance = pool_take(pool, room, sizeof *reach->distance);
    reach->vertices = pool_take(pool, room, sizeof *reach->vertices);
    reach->along = pool_take(pool, room, sizeof *reach->along);
    reach->heap = pool_take(pool, room, sizeof *reach->heap);
    reach->place = pool_take(pool, room, sizeof *reach->place);
    for (int i = 0; i < vertices; i++) reach->distance[i] = reach->along[i] = INFINITY;
}

static void put(struct reach *reach, int at, int vertex)
{
    reach->heap[at] = vertex;
    reach->place[vertex] = at;
}

static void sift_up(struct reach *reach, int vertex)
{
    int at = reach->place[vertex];
    while (at > 0 && reach->along[vertex] < reach->along[reach->heap[(at - 1) / 2]]) {
        put(reach, at, reach->heap[(at - 1) / 2]);
        at = (at - 1) / 2;
    }
    put(reach, at, vertex);
}

static void sift_down(struct reach *reach, int vertex)
{
    int at = reach->place[vertex];
    for (;;) {
        int child = 2 * at + 1;
        if (child >= reach->heap_count) break;
        if (child + 1 < reach->heap_count && reach->along[reach->heap[child + 1]] < reach->along[reach->heap[child]])
            child++;
        if (reach->along[vertex] <= reach->along[reach->heap[child]]) break;
        put(reach, at, reach->heap[child]);
        at = child;
    }
    put(reach, at, vertex);
}

static int take_nearest(struct reach *reach)
{
    const int nearest = reach->heap[0], last = reach->heap[--reach->heap_count];
    if (reach->heap_count > 0) {
        put(reach, 0, last);
        sift_down(reach, last);
    }
    return nearest;
}

/// Offers a path of that length to a vertex.
static void offer(struct reach *reach, uint32_t vertex, float along)
{
    if (!(along < reach->along[vertex])) return;
    const bool is_new = reach->along[vertex] == INFINITY;
    reach->along[vertex] = along;
    if (is_new) put(reach, reach->heap_count++, (int)vertex);
    sift_up(reach, (int)vertex);
}

static void spot_position(const struct surface_spot *spot, const float (*positions)[3], float out[3])
{
    vec3s sum = glms_vec3_zero();
    for (int c = 0; c < 3; c++) sum = glms_vec3_muladds(vec3_from(positions[spot->corner[c]]), spot->weight[c], sum);
    glm_vec3_copy(sum.raw, out);
}

/// Forgets earlier results.
static void clear(struct reach *reach)
{
    for (int i = 0; i < reach->count; i++)
        reach->distance[reach->vertices[i]] = reach->along[reach->vertices[i]] = INFINITY;
    for (int i = 0; i < reach->heap_count; i++) reach->along[reach->heap[i]] = INFINITY;
    reach->count = reach->heap_count = 0;
}

static float nearest_straight(const float (*positions)[3], const struct surface_spot *spots, int count, int vertex)
{
    float least = INFINITY;
    for (int s = 0; s < count; s++) {
        float at[3];
        spot_position(&spots[s], positions, at);
        least = fminf(least, glms_vec3_distance(vec3_from(at), vec3_from(positions[vertex])));
    }
    return least;
}

void reach_find(struct reach *reach, const struct figure *figure, const struct surface_spot *spots, int count,
                float limit)
{
    const float(*positions)[3] = (const float(*)[3])figure->character.position;
    clear(reach);
    for (int s = 0; s < count; s++) {
        float at[3];
        spot_position(&spots[s], positions, at);
        for (int c = 0; c < 3; c++)
            offer(reach, spots[s].corner[c],
                  glms_vec3_distance(vec3_from(at), vec3_from(positions[spots[s].corner[c]])));
    }
    while (reach->heap_count > 0 && SHORTER * reach->along[reach->heap[0]] <= limit) {
        const int vertex = take_nearest(reach);
        const float along = reach->along[vertex];
        reach->vertices[reach->count++] = vertex;
        reach->distance[vertex] = fmaxf(SHORTER * along, nearest_straight(positions, spots, count, vertex));
        for (int e = figure->edges.first[vertex]; e < figure->edges.first[vertex + 1]; e++) {
            const uint32_t other = figure->edges.other[e];
            offer(reach, other,
                  along + glms_vec3_distance(vec3_from(positions[vertex]), vec3_from(positions[other])));
        }
    }
}

// --- rays

static const float SLACK = 1e-4f; ///< share of a triangle, so that rounding leaves no gaps between neighbours

/// Möller and Trumbore 1997.
float pick_triangle(const float *const corner[3], const float eye[3], const float direction[3], float uv[2])
{
    const vec3s first = vec3_from(corner[0]), along = vec3_from(direction);
    const vec3s side = glms_vec3_sub(vec3_from(corner[1]), first), other = glms_vec3_sub(vec3_from(corner[2]), first);
    const vec3s p = glms_vec3_cross(along, other);
    const float determinant = glms_vec3_dot(side, p);
    if (!(determinant > 0.0f)) return -1; // edge on, or from behind
    const vec3s from = glms_vec3_sub(vec3_from(eye), first);
    uv[0] = glms_vec3_dot(from, p);
    const float slack = SLACK * determinant;
    if (uv[0] < -slack || uv[0] > determinant + slack) return -1;
    const vec3s q = glms_vec3_cross(from, side);
    uv[1] = glms_vec3_dot(along, q);
    if (uv[1] < -slack || uv[0] + uv[1] > determinant + slack) return -1;
    uv[0] /= determinant;
    uv[1] /= determinant;
    return glms_vec3_dot(other, q) / determinant;
}

bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot)
{
    const uint32_t *indices = figure->character.indices;
    float nearest = INFINITY;
    for (int t = 0; t < figure->character.index_count; t += 3) {
        const float *const corner[3] = {posed[indices[t]], posed[indices[t + 1]], posed[indices[t + 2]]};
        float uv[2];
        const float distance = pick_triangle(corner, eye, direction, uv);
        if (!(distance > 0.0f && distance < nearest)) continue;
        nearest = distance;
        memcpy(spot->corner, indices + t, sizeof spot->corner);
        spot->weight[0] = 1.0f - uv[0] - uv[1];
        spot->weight[1] = uv[0];
        spot->weight[2] = uv[1];
    }
    return nearest < INFINITY;
}
