/// Prepares a character for drawing: normals, a coarser mesh, bounds; poses it; and applies painted phases and amplitudes.
#include "model/figure.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Sums over the edges around a vertex, for the least-squares fit of derivatives along t₁ and t₂: the normal matrix.
struct fit {
    float uu, uv, vv;
};

/// A unit vector orthogonal to n, from the axis of n's smallest component.
static void tangent_of(const float n[3], float t[3])
{
    int least = 0;
    for (int k = 1; k < 3; k++) {
        if (fabsf(n[k]) < fabsf(n[least])) least = k;
    }
    vec3s axis = glms_vec3_zero();
    axis.raw[least] = 1.0f;
    vec3s across = glms_vec3_sub(axis, glms_vec3_scale(vec3_from(n), n[least]));
    across = glms_vec3_divs(across, glms_vec3_norm(across));
    glm_vec3_copy(across.raw, t);
}

/// An edge from vertex i in its tangent plane, weighted so that short edges count as much as long ones.
static bool edge_in_plane(const struct figure *figure, uint32_t i, uint32_t j, float uv[2], float *weight)
{
    const struct character *c = &figure->character;
    const vec3s edge = glms_vec3_sub(vec3_from(c->position[j]), vec3_from(c->position[i]));
    const vec3s tangent = vec3_from(figure->tangent[i]);
    const float square = glms_vec3_norm2(edge);
    if (!(square > 0.0f)) return false;
    uv[0] = glms_vec3_dot(edge, tangent);
    uv[1] = glms_vec3_dot(edge, glms_vec3_cross(vec3_from(c->normal[i]), tangent));
    *weight = 1.0f / square;
    return true;
}

static void add_edge(struct fit *fit, const float uv[2], float weight)
{
    fit->uu += weight * uv[0] * uv[0];
    fit->uv += weight * uv[0] * uv[1];
    fit->vv += weight * uv[1] * uv[1];
}

/// Adds weight · difference · (u, v) to both derivatives.
static void add_difference(const float a[3], const float b[3], const float uv[2], float weight, float by_u[3],
                           float by_v[3])
{
    for (int k = 0; k < 3; k++) {
        const float difference = weight * (b[k] - a[k]);
        by_u[k] += difference * uv[0];
        by_v[k] += difference * uv[1];
    }
}

/// (by_u, by_v) = (normal matrix)⁻¹ (by_u, by_v)
static void solve_fit(const struct fit *fit, float by_u[3], float by_v[3])
{
    const float determinant = fit->uu * fit->vv - fit->uv * fit->uv, trace = fit->uu + fit->vv;
    const float inverse =
        determinant > 1e-6f * trace * trace ? 1.0f / determinant : 0.0f; // 0: the edges span no plane
    for (int k = 0; k < 3; k++) {
        const float u = by_u[k], v = by_v[k];
        by_u[k] = inverse * (fit->vv * u - fit->uv * v);
        by_v[k] = inverse * (fit->uu * v - fit->uv * u);
    }
}

static void fit_slope(struct figure *figure, int coordinate, int vertex)
{
    const struct character *c = &figure->character;
    const struct coordinate *n = &c->coordinates[coordinate];
    struct slope *s = &figure->slopes[coordinate * c->vertex_count + vertex];
    struct fit fit = {0};
    *s = (struct slope){0};
    for (int e = figure->edges.first[vertex]; e < figure->edges.first[vertex + 1]; e++) {
        const uint32_t other = figure->edges.other[e];
        float uv[2], weight;
        if (!edge_in_plane(figure, (uint32_t)vertex, other, uv, &weight)) continue;
        add_edge(&fit, uv, weight);
        add_difference(n->re[vertex], n->re[other], uv, weight, s->re_u, s->re_v);
        add_difference(n->im[vertex], n->im[other], uv, weight, s->im_u, s->im_v);
    }
    solve_fit(&fit, s->re_u, s->re_v);
    solve_fit(&fit, s->im_u, s->im_v);
}

/// Measures the largest amplitudes of a coordinate.
static void measure_largest(struct figure *figure, int coordinate)
{
    const struct coordinate *n = &figure->character.coordinates[coordinate];
    float square[3] = {0};
    for (int i = 0; i < figure->character.vertex_count; i++) {
        for (int k = 0; k < 3; k++)
            square[k] = fmaxf(square[k], n->re[i][k] * n->re[i][k] + n->im[i][k] * n->im[i][k]);
    }
    for (int k = 0; k < 3; k++) figure->largest[coordinate][k] = sqrtf(square[k]);
}

static void measure(struct figure *figure)
{
    const struct character *c = &figure->character;
    glm_vec3_fill(figure->lo, INFINITY);
    glm_vec3_fill(figure->hi, -INFINITY);
    for (int i = 0; i < c->vertex_count; i++) {
        tangent_of(c->normal[i], figure->tangent[i]);
        glm_vec3_minv(c->position[i], figure->lo, figure->lo);
        glm_vec3_maxv(c->position[i], figure->hi, figure->hi);
    }
}

static void find_dark(struct figure *figure)
{
    static const float share = 0.45f; // of the mean
    const struct character *c = &figure->character;
    double sum = 0.0;
    for (int i = 0; i < c->vertex_count; i++)
        sum += (double)glms_vec3_dot(vec3_from(c->color[i]), (vec3s){{0.2126f, 0.7152f, 0.0722f}});
    figure->dark = c->vertex_count > 0 ? share * (float)(sum / c->vertex_count) : 0.0f;
}

/// A disc around the lowest points on each side of the middle.
static void find_soles(struct figure *figure)
{
    const struct character *c = &figure->character;
    const float low = figure->lo[1] + 0.02f * (figure->hi[1] - figure->lo[1]);
    const float middle = 0.5f * (figure->lo[0] + figure->hi[0]);
    float sum[FIGURE_SOLES][5] = {{0}}; // count, x, z, x², z²
    for (int i = 0; i < c->vertex_count; i++) {
        const float *p = c->position[i];
        if (p[1] > low) continue;
        float *s = sum[p[0] > middle];
        const float add[5] = {1.0f, p[0], p[2], p[0] * p[0], p[2] * p[2]};
        for (int k = 0; k < 5; k++) s[k] += add[k];
    }
    for (int side = 0; side < FIGURE_SOLES; side++) {
        const float *s = sum[side], count = s[0];
        if (count == 0.0f) continue;
        const float x = s[1] / count, z = s[2] / count;
        const float variance = s[3] / count - x * x + s[4] / count - z * z;
        figure->soles[side] = (struct sole){x, z, 2.0f * sqrtf(fmaxf(variance, 0.0f))};
    }
}

static void reserve(struct figure *figure)
{
    const struct character *c = &figure->character;
    const size_t vertices = (size_t)c->vertex_count, coordinates = (size_t)c->coordinate_count;
    struct pool *pool = &figure->pool;
    figure->tangent = pool_take(pool, vertices, sizeof *figure->tangent);
    figure->slopes = pool_take(pool, vertices * coordinates, sizeof *figure->slopes);
    figure->largest = pool_take(pool, coordinates, sizeof *figure->largest);
    figure->coarse = pool_take(pool, (size_t)c->index_count, sizeof *figure->coarse);
    figure->coarse_from = pool_take(pool, (size_t)c->index_count / 3, sizeof *figure->coarse_from);
}

static uint64_t new_id(void)
{
    static uint64_t made;
    return ++made;
}

void figure_derive(struct figure *figure)
{
    const struct character *c = &figure->character;
    reserve(figure);
    adjacency_create(&figure->edges, &figure->pool, (const float(*)[3])c->position, (const float(*)[3])c->normal,
                     c->vertex_count, c->indices, c->index_count);
    measure(figure);
    for (int k = 0; k < c->coordinate_count; k++) {
        measure_largest(figure, k);
        for (int i = 0; i < c->vertex_count; i++) fit_slope(figure, k, i);
    }
}

void figure_forget(struct figure *figure)
{
    figure->character = (struct character){0};
    figure_free(figure);
}

static void turn_normals(const struct figure *figure, int coordinate, bool imaginary, float (*turn)[3])
{
    const struct character *c = &figure->character;
    for (int i = 0; i < c->vertex_count; i++) {
        const struct slope *s = &figure->slopes[coordinate * c->vertex_count + i];
        const vec3s u = vec3_from(figure->tangent[i]), v = glms_vec3_cross(vec3_from(c->normal[i]), u);
        const vec3s du = vec3_from(imaginary ? s->im_u : s->re_u), dv = vec3_from(imaginary ? s->im_v : s->re_v);
        const vec3s sum = glms_vec3_add(glms_vec3_cross(du, v), glms_vec3_cross(u, dv));
        for (int k = 0; k < 3; k++) turn[i][k] = imaginary ? -sum.raw[k] : sum.raw[k];
    }
}

struct figure_target figure_target_create(const struct figure *figure, int coordinate, bool imaginary,
                                          struct pool *pool)
{
    const char *ending = imaginary ? ".im" : ".re";
    const struct coordinate *n = &figure->character.coordinates[coordinate];
    struct figure_target target = {.sign = imaginary ? -1.0f : 1.0f,
                                   .position = (const float(*)[3])(imaginary ? n->im : n->re)};
    target.name = pool_take(pool, strlen(n->name) + strlen(ending) + 1, 1);
    stpcpy(stpcpy(target.name, n->name), ending);
    if (!figure->slopes) return target;
    target.normal = pool_take(pool, (size_t)figure->character.vertex_count, sizeof *target.normal);
    turn_normals(figure, coordinate, imaginary, target.normal);
    return target;
}

bool figure_has_room(const struct character *character)
{
    enum { OTHERS = 4 }; // working memory, and other arrays per vertex or corner
    const size_t vertices = (size_t)character->vertex_count, corners = (size_t)character->index_count;
    const size_t slopes = (size_t)character->coordinate_count * sizeof(struct slope);
    return need_has_room(vertices * (slopes + OTHERS * sizeof(struct spot)) + corners * OTHERS * sizeof(uint32_t));
}

void figure_create(struct figure *figure, struct character *character)
{
    *figure = (struct figure){.character = *character, .id = new_id()};
    *character = (struct character){0};
    figure_derive(figure);
    find_soles(figure);
    find_dark(figure);
    decimate(&figure->character, FIGURE_COARSE, figure->coarse, figure->coarse_from, &figure->coarse_count);
}

void figure_free(struct figure *figure)
{
    character_free(&figure->character);
    pool_free(&figure->pool);
    *figure = (struct figure){0};
}

int figure_find(const struct figure *figure, const char *name)
{
    for (int k = 0; k < figure->character.coordinate_count; k++) {
        if (strcmp(figure->character.coordinates[k].name, name) == 0) return k;
    }
    return -1;
}

/// sum += Re(z (re + j·im))
static void add_real_part(const float z[2], const float re[3], const float im[3], float sum[3])
{
    for (int k = 0; k < 3; k++) sum[k] += z[0] * re[k] - z[1] * im[k];
}

static void morph_normal(const struct figure *figure, const struct morph *morph, int vertex, float normal[3])
{
    vec3s u = vec3_from(figure->tangent[vertex]), v = glms_vec3_cross(vec3_from(figure->character.normal[vertex]), u);
    for (int k = 0; k < morph->count; k++) {
        const struct slope *s = &figure->slopes[morph->coordinate[k] * figure->character.vertex_count + vertex];
        add_real_part(morph->weight[k], s->re_u, s->im_u, u.raw);
        add_real_part(morph->weight[k], s->re_v, s->im_v, v.raw);
    }
    vec3s n = glms_vec3_cross(u, v);
    n = glms_vec3_divs(n, fmaxf(glms_vec3_norm(n), 1e-9f)); // no direction if squeezed flat, but not NaN
    glm_vec3_copy(n.raw, normal);
}

void morph_vertex(const struct figure *figure, const struct morph *morph, int vertex, float position[3],
                  float normal[3])
{
    memcpy(position, figure->character.position[vertex], 3 * sizeof *position);
    for (int k = 0; k < morph->count; k++) {
        const struct coordinate *c = &figure->character.coordinates[morph->coordinate[k]];
        add_real_part(morph->weight[k], c->re[vertex], c->im[vertex], position);
    }
    if (normal) morph_normal(figure, morph, vertex, normal);
}

void morph_places(const struct figure *figure, const struct morph *morph, const float position[3], float (*places)[3])
{
    for (int i = 0; i < figure->character.vertex_count; i++) {
        morph_vertex(figure, morph, i, places[i], NULL);
        places[i][0] += position[0];
        places[i][1] += position[1] - figure->lo[1];
        places[i][2] += position[2];
    }
}

void morph_bounds(const struct figure *figure, const struct morph *morph, float lo[3], float hi[3])
{
    glm_vec3_fill(lo, INFINITY);
    glm_vec3_fill(hi, -INFINITY);
    for (int i = 0; i < figure->character.vertex_count; i++) {
        float p[3];
        morph_vertex(figure, morph, i, p, NULL);
        glm_vec3_minv(p, lo, lo);
        glm_vec3_maxv(p, hi, hi);
    }
}

// --- a figure that is painted

static void reserve_painted(struct painted *painted)
{
    const struct character *plain = &painted->plain->character;
    struct figure *figure = &painted->figure;
    struct pool *pool = &figure->pool;
    const size_t vertices = (size_t)plain->vertex_count, coordinates = (size_t)plain->coordinate_count;
    figure->slopes = pool_take(pool, vertices * coordinates, sizeof *figure->slopes);
    figure->largest = pool_take(pool, coordinates, sizeof *figure->largest);
    figure->character.coordinates = pool_take(pool, coordinates, sizeof *figure->character.coordinates);
    painted->applied = pool_take(pool, vertices * coordinates, sizeof *painted->applied);
    painted->stale = pool_take(pool, vertices, sizeof *painted->stale);
    for (size_t k = 0; k < coordinates; k++) {
        struct coordinate *c = &figure->character.coordinates[k];
        *c = plain->coordinates[k]; // shares the name
        c->re = pool_take(pool, vertices, sizeof *c->re);
        c->im = pool_take(pool, vertices, sizeof *c->im);
    }
}

static void copy_coordinates(struct painted *painted)
{
    const struct character *plain = &painted->plain->character;
    const size_t vertices = (size_t)plain->vertex_count, coordinates = (size_t)plain->coordinate_count;
    for (size_t k = 0; k < coordinates; k++) {
        struct coordinate *c = &painted->figure.character.coordinates[k];
        memcpy(c->re, plain->coordinates[k].re, vertices * sizeof *c->re);
        memcpy(c->im, plain->coordinates[k].im, vertices * sizeof *c->im);
    }
    memcpy(painted->figure.slopes, painted->plain->slopes, vertices * coordinates * sizeof(struct slope));
    memcpy(painted->figure.largest, painted->plain->largest, coordinates * sizeof *painted->figure.largest);
}

struct painted *painted_create(const struct figure *plain)
{
    struct painted *painted = need_zeroed(1, sizeof *painted);
    painted->plain = plain;
    painted->figure = *plain;
    painted->figure.id = new_id();
    painted->figure.version = 1;
    painted->figure.pool = (struct pool){0};
    reserve_painted(painted);
    copy_coordinates(painted);
    return painted;
}

void painted_destroy(struct painted *painted)
{
    if (!painted) return;
    pool_free(&painted->figure.pool);
    free(painted);
}

/// Ñ' = Ñ e^{a + jψ} at one vertex; marks its slopes and its neighbours' as out of date.
static void turn(struct painted *painted, int coordinate, int vertex, const float value[2])
{
    const struct coordinate *from = &painted->plain->character.coordinates[coordinate];
    struct coordinate *to = &painted->figure.character.coordinates[coordinate];
    const struct adjacency *edges = &painted->figure.edges;
    const float size = maths_expf(value[0]), re = size * maths_cosf(value[1]), im = size * maths_sinf(value[1]);
    for (int k = 0; k < 3; k++) {
        to->re[vertex][k] = re * from->re[vertex][k] - im * from->im[vertex][k];
        to->im[vertex][k] = re * from->im[vertex][k] + im * from->re[vertex][k];
    }
    painted->stale[vertex] = true;
    for (int e = edges->first[vertex]; e < edges->first[vertex + 1]; e++) painted->stale[edges->other[e]] = true;
}

/// Applies the paint to one coordinate; false if nothing changed.
static bool apply(struct painted *painted, int coordinate, const float (*paint)[2])
{
    static const float none[2];
    const int vertices = painted->figure.character.vertex_count;
    float(*applied)[2] = painted->applied + (size_t)coordinate * (size_t)vertices;
    bool any = false;
    for (int i = 0; i < vertices; i++) {
        const float *value = paint ? paint[(size_t)coordinate * (size_t)vertices + (size_t)i] : none;
        if (applied[i][0] == value[0] && applied[i][1] == value[1]) continue;
        memcpy(applied[i], value, sizeof applied[i]);
        turn(painted, coordinate, i, value);
        any = true;
    }
    return any;
}

void painted_update(struct painted *painted, const float (*paint)[2])
{
    struct figure *figure = &painted->figure;
    const uint64_t next = figure->version + 1;
    for (int k = 0; k < figure->character.coordinate_count; k++) {
        if (!apply(painted, k, paint)) continue;
        for (int i = 0; i < figure->character.vertex_count; i++) {
            if (!painted->stale[i]) continue;
            painted->stale[i] = false;
            fit_slope(figure, k, i);
        }
        measure_largest(figure, k);
        figure->version = next;
    }
}
