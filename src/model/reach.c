/// Distances along a surface, by Dijkstra from a few starting points.
#include "model/reach.h"
#include "base/need.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

static const float SHORTER = 0.86f; ///< 1/1.16

void reach_create(struct reach *reach, int vertices)
{
    const size_t room = (size_t)vertices + 1;
    *reach = (struct reach){.capacity = vertices};
    reach->distance = need(room, sizeof *reach->distance);
    reach->vertices = need(room, sizeof *reach->vertices);
    reach->along = need(room, sizeof *reach->along);
    reach->heap = need(room, sizeof *reach->heap);
    reach->place = need(room, sizeof *reach->place);
    for (int i = 0; i < vertices; i++) reach->distance[i] = reach->along[i] = INFINITY;
}

void reach_free(struct reach *reach)
{
    free(reach->distance);
    free(reach->vertices);
    free(reach->along);
    free(reach->heap);
    free(reach->place);
    *reach = (struct reach){0};
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

/// Where a spot is.
static void spot_position(const struct surface_spot *spot, const float (*positions)[3], float out[3])
{
    vec3s sum = glms_vec3_zero();
    for (int c = 0; c < 3; c++) sum = glms_vec3_muladds(vec3_from(positions[spot->corner[c]]), spot->weight[c], sum);
    glm_vec3_copy(sum.raw, out);
}

/// Forgets what was found before.
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
