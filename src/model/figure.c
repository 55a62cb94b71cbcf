/// Prepares a character for drawing: normals, bounds; poses it; applies painted phases and amplitudes; and finds distances along
/// its surface, and where a ray hits it.
#include "model/figure.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct slope *slope_at(const struct figure *figure, int coordinate, int part, int vertex)
{
    const ptrdiff_t row = (ptrdiff_t)coordinate * figure->parts + part;
    return &figure->slopes[row * figure->character.vertex_count + vertex];
}

/// Fits derivatives along t₁ and t₂ by least squares to the differences along the edges around a vertex.
static void fit_slope(struct figure *figure, int coordinate, int vertex)
{
    const struct character *c = &figure->character;
    const struct coordinate *n = &c->coordinates[coordinate];
    const vec3s tangent = vec3_from(figure->tangent[vertex]);
    const vec3s across = glms_vec3_cross(vec3_from(c->normal[vertex]), tangent);
    const int parts = coordinate_parts(n);
    struct slope s[COORDINATE_PARTS] = {0};
    struct {
        float uu, uv, vv;
    } fit = {0}; // the normal matrix
    for (int e = figure->edges.first[vertex]; e < figure->edges.first[vertex + 1]; e++) {
        const uint32_t other = figure->edges.other[e];
        const vec3s edge = glms_vec3_sub(vec3_from(c->position[other]), vec3_from(c->position[vertex]));
        const float square = glms_vec3_norm2(edge), weight = 1.0f / square; // short edges count as much as long ones
        if (!(square > 0.0f)) continue;
        const float uv[2] = {glms_vec3_dot(edge, tangent), glms_vec3_dot(edge, across)}; // in the tangent plane
        fit.uu += weight * uv[0] * uv[0];
        fit.uv += weight * uv[0] * uv[1];
        fit.vv += weight * uv[1] * uv[1];
        for (int i = 0; i < 3 * parts; i++) {
            const int p = i / 3, k = i % 3;
            const float difference = weight * (n->parts[p][other][k] - n->parts[p][vertex][k]);
            s[p].u[k] += difference * uv[0];
            s[p].v[k] += difference * uv[1];
        }
    }

    // The inverse of the normal matrix times both derivatives.
    const float determinant = fit.uu * fit.vv - fit.uv * fit.uv, trace = fit.uu + fit.vv;
    const float inverse =
        determinant > 1e-6f * trace * trace ? 1.0f / determinant : 0.0f; // 0: the edges span no plane
    for (int i = 0; i < 3 * parts; i++) {
        const float u = s[i / 3].u[i % 3], v = s[i / 3].v[i % 3];
        s[i / 3].u[i % 3] = inverse * (fit.vv * u - fit.uv * v);
        s[i / 3].v[i % 3] = inverse * (fit.uu * v - fit.uv * u);
    }
    for (int p = 0; p < parts; p++) *slope_at(figure, coordinate, p, vertex) = s[p];
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

/// Makes room for what is derived from coordinates.
static void make_room(struct figure *figure, struct pool *pool)
{
    const struct character *c = &figure->character;
    const size_t vertices = (size_t)c->vertex_count, coordinates = (size_t)c->coordinate_count;
    figure->parts = COORDINATE_STRAIGHT;
    for (int k = 0; k < c->coordinate_count; k++) {
        const int parts = coordinate_parts(&c->coordinates[k]);
        if (parts > figure->parts) figure->parts = parts;
    }
    figure->slopes = pool_take(pool, vertices * coordinates * (size_t)figure->parts, sizeof *figure->slopes);
    figure->largest = pool_take(pool, coordinates, sizeof *figure->largest);
}

// --- the figure

void figure_derive(struct figure *figure)
{
    const struct character *c = &figure->character;
    struct pool *pool = &figure->pool;
    figure->tangent = pool_take(pool, (size_t)c->vertex_count, sizeof *figure->tangent);
    make_room(figure, pool);
    figure->edges = adjacency_create(pool, (const float(*)[3])c->position, (const float(*)[3])c->normal,
                                     c->vertex_count, c->indices, c->index_count);
    glm_vec3_fill(figure->lo, INFINITY);
    glm_vec3_fill(figure->hi, -INFINITY);
    for (int i = 0; i < c->vertex_count; i++) {
        const float *n = c->normal[i]; // a tangent comes from the axis of its smallest component
        int least = 0;
        for (int k = 1; k < 3; k++) {
            if (fabsf(n[k]) < fabsf(n[least])) least = k;
        }
        vec3s axis = glms_vec3_zero();
        axis.raw[least] = 1.0f;
        const vec3s across = glms_vec3_sub(axis, glms_vec3_scale(vec3_from(n), n[least]));
        const vec3s tangent = glms_vec3_divs(across, glms_vec3_norm(across));
        memcpy(figure->tangent[i], tangent.raw, sizeof figure->tangent[i]);
        glm_vec3_minv(c->position[i], figure->lo, figure->lo);
        glm_vec3_maxv(c->position[i], figure->hi, figure->hi);
    }
    for (int k = 0; k < c->coordinate_count; k++) {
        measure_largest(figure, k);
        for (int i = 0; i < c->vertex_count; i++) fit_slope(figure, k, i);
    }
}

struct figure_target figure_target_create(const struct figure *figure, int coordinate, int part, struct pool *pool)
{
    const struct character *c = &figure->character;
    const struct coordinate *n = &c->coordinates[coordinate];
    struct figure_target target = {.name = pool_text(pool, n->name, coordinate_endings[part], ""),
                                   .position = (const float(*)[3])n->parts[part],
                                   .scale = part == 1 ? -1.0f : 1.0f,
                                   .turn = 1};
    if (!figure->slopes) return target;
    float(*normal)[3] = pool_take(pool, (size_t)c->vertex_count, sizeof *normal);
    for (int i = 0; i < c->vertex_count; i++) {
        const struct slope *s = slope_at(figure, coordinate, part, i);
        const vec3s u = vec3_from(figure->tangent[i]), v = glms_vec3_cross(vec3_from(c->normal[i]), u);
        const vec3s sum = glms_vec3_add(glms_vec3_cross(vec3_from(s->u), v), glms_vec3_cross(u, vec3_from(s->v)));
        for (int k = 0; k < 3; k++) normal[i][k] = target.scale * sum.raw[k];
    }
    target.normal = (const float(*)[3])normal;
    return target;
}

bool figure_has_room(const struct character *character)
{
    enum { OTHERS = 4 }; // working memory, and other arrays per vertex or corner
    const size_t vertices = (size_t)character->vertex_count, corners = (size_t)character->index_count;
    size_t slopes = 0;
    for (int k = 0; k < character->coordinate_count; k++)
        slopes += (size_t)coordinate_parts(&character->coordinates[k]) * sizeof(struct slope);
    return need_has_room(vertices * (slopes + OTHERS * sizeof(struct spot)) + corners * OTHERS * sizeof(uint32_t));
}

void figure_create(struct figure *figure, struct character *character)
{
    *figure = (struct figure){.character = *character, .id = gltf_new_id()};
    *character = (struct character){0};
    figure_derive(figure);

    // A disc around the lowest points on each side of the middle; and what is far darker than the mean colour.
    const struct character *c = &figure->character;
    const float low = figure->lo[1] + 0.02f * (figure->hi[1] - figure->lo[1]);
    const float middle = 0.5f * (figure->lo[0] + figure->hi[0]), share = 0.45f;
    float sum[FIGURE_SOLES][5] = {{0}}; // count, x, z, x², z²
    double luminance = 0.0;
    for (int i = 0; i < c->vertex_count; i++) {
        const float *p = c->position[i];
        luminance += (double)glms_vec3_dot(vec3_from(c->color[i]), (vec3s){{0.2126f, 0.7152f, 0.0722f}});
        if (p[1] > low) continue;
        float *s = sum[p[0] > middle];
        const float add[5] = {1.0f, p[0], p[2], p[0] * p[0], p[2] * p[2]};
        for (int k = 0; k < 5; k++) s[k] += add[k];
    }
    figure->dark = c->vertex_count > 0 ? share * (float)(luminance / c->vertex_count) : 0.0f;
    for (int side = 0; side < FIGURE_SOLES; side++) {
        const float *s = sum[side], count = s[0];
        if (count == 0.0f) continue;
        const float x = s[1] / count, z = s[2] / count;
        const float variance = s[3] / count - x * x + s[4] / count - z * z;
        figure->soles[side] = (struct sole){x, z, 2.0f * sqrtf(fmaxf(variance, 0.0f))};
    }
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

void coordinate_weights(const struct coordinate *c, const double z[2], double weights[COORDINATE_PARTS],
                        double by[2][COORDINATE_PARTS])
{
    // |z|² = q r², z² is q z² with q = 1, beyond m (2 m r − m²) / r².
    const double x = z[0], y = z[1], square = x * x + y * y, r = sqrt(square), m = c->sq ? c->most : 0;
    const double q = r > m ? m * (2 * r - m) / square : 1,
                 slope = r > m ? 2 * m * (m - r) / (square * r) : 0; // dq/dr
    const double list[COORDINATE_PARTS] = {x, y, q * square, q * (x * x - y * y), 2 * q * x * y};
    memcpy(weights, list, sizeof list);
    for (int k = 0; by && k < 2; k++) {
        const double along = r > m ? slope * z[k] / r : 0, turned = k == 0 ? y : x; // dq/dx or dq/dy
        const double derivatives[COORDINATE_PARTS] = {k == 0, k == 1, along * square + 2 * q * z[k],
                                                      along * (x * x - y * y) + (k == 0 ? 2 : -2) * q * z[k],
                                                      2 * along * x * y + 2 * q * turned};
        memcpy(by[k], derivatives, sizeof derivatives);
    }
}

void morph_add(struct morph *morph, const struct figure *figure, int coordinate, const double z[2])
{
    double weights[COORDINATE_PARTS];
    coordinate_weights(&figure->character.coordinates[coordinate], z, weights, NULL);
    for (int p = 0; p < COORDINATE_PARTS; p++) morph->weight[morph->count][p] = (float)weights[p];
    morph->coordinate[morph->count++] = coordinate;
}

/// sum += Re(z (re + j·im))
static void add_real_part(const float z[2], const float re[3], const float im[3], float sum[3])
{
    for (int k = 0; k < 3; k++) sum[k] += z[0] * re[k] - z[1] * im[k];
}

/// sum += |z|² sq + Re(z² (re + j·im)), with their weights.
static void add_curve(const float weights[3], const float sq[3], const float re[3], const float im[3], float sum[3])
{
    for (int k = 0; k < 3; k++) sum[k] += weights[0] * sq[k];
    add_real_part(weights + 1, re, im, sum);
}

void morph_vertex(const struct figure *figure, const struct morph *morph, int vertex, float position[3],
                  float normal[3])
{
    memcpy(position, figure->character.position[vertex], 3 * sizeof *position);
    for (int k = 0; k < morph->count; k++) {
        const struct coordinate *c = &figure->character.coordinates[morph->coordinate[k]];
        const float *weight = morph->weight[k];
        add_real_part(weight, c->re[vertex], c->im[vertex], position);
        if (c->sq) add_curve(weight + COORDINATE_STRAIGHT, c->sq[vertex], c->re2[vertex], c->im2[vertex], position);
    }
    if (!normal) return;
    vec3s u = vec3_from(figure->tangent[vertex]), v = glms_vec3_cross(vec3_from(figure->character.normal[vertex]), u);
    for (int k = 0; k < morph->count; k++) {
        const int n = morph->coordinate[k], step = figure->character.vertex_count;
        const struct slope *s = slope_at(figure, n, 0, vertex);
        const float *weight = morph->weight[k];
        add_real_part(weight, s->u, s[step].u, u.raw);
        add_real_part(weight, s->v, s[step].v, v.raw);
        if (!figure->character.coordinates[n].sq) continue;
        weight += COORDINATE_STRAIGHT;
        add_curve(weight, s[2 * step].u, s[3 * step].u, s[4 * step].u, u.raw);
        add_curve(weight, s[2 * step].v, s[3 * step].v, s[4 * step].v, v.raw);
    }
    vec3s n = glms_vec3_cross(u, v);
    n = glms_vec3_divs(n, fmaxf(glms_vec3_norm(n), 1e-9f)); // no direction if squeezed flat, but not NaN
    glm_vec3_copy(n.raw, normal);
}

struct morph figure_morph(const struct figure *figure, const float *weights)
{
    struct morph morph = {0};
    for (int k = 0; k < figure->character.coordinate_count && morph.count < MORPH_MAX_COORDINATES; k++) {
        const struct coordinate *c = &figure->character.coordinates[k];
        const float re = weights[c->target[0]], im = weights[c->target[1]], scale = (float)c->scale;
        if (re == 0 && im == 0) continue;
        morph_add(&morph, figure, k, (const double[2]){(double)(scale * re), (double)(scale * im)});
    }
    return morph;
}

// --- in a pose of its file

/// What carries all vertices of a soft mesh, and where to look for what carries one.
struct carried {
    const struct gltf_mesh *mesh;
    const float *weights;
    const float (*joints)[16]; ///< NULL: it has no skin
    mat4s back;                ///< from where a vertex is at rest to the mesh
    bool is_moved;             ///< that is not 1
    mat4s all;                 ///< of vertices without joints
    bool turns;                ///< it is not always 1
    bool has_way;              ///< targets that are no coordinate's move vertices
};

/// Whether a target of the mesh moves vertices but is no coordinate's.
static bool is_other(const struct carried *carried, const struct character *c, int target)
{
    bool other = carried->weights[target] != 0;
    for (int k = 0; k < c->coordinate_count && other; k++) {
        for (int p = 0; p < coordinate_parts(&c->coordinates[k]); p++) other &= target != c->coordinates[k].target[p];
    }
    return other;
}

static struct carried carried_of(const struct model_pose *model)
{
    const struct character *c = &model->figure->character;
    struct carried carried = {.back = glms_mat4_identity(), .all = glms_mat4_identity()};
    const struct gltf_node *node = &model->gltf->nodes[c->node];
    carried.mesh = &model->gltf->meshes[node->mesh];
    carried.weights = model->pose->weights + node->first_weight;
    if (node->skin >= 0) carried.joints = model->pose->joints + model->gltf->skins[node->skin].first_joint;
    const float *world = model->pose->world[c->node];
    carried.is_moved = memcmp(&carried.back, c->moved, sizeof c->moved) != 0;
    if (carried.is_moved) carried.back = glms_mat4_inv(mat4_from(c->moved));
    carried.turns = memcmp(world, c->moved, sizeof c->moved) != 0;
    if (carried.turns) carried.all = glms_mat4_mul(mat4_from(world), carried.back);
    for (int t = 0; t < carried.mesh->target_count; t++) carried.has_way |= is_other(&carried, c, t);
    return carried;
}

static void carry(const struct carried *carried, const struct model_pose *model, const struct gltf_part *part, int at,
                  mat4s *matrix, vec3s *way)
{
    const struct character *c = &model->figure->character;
    *way = glms_vec3_zero();
    for (int t = 0; carried->has_way && t < carried->mesh->target_count; t++) {
        const float(*position)[3] = (const float(*)[3])part->targets[t].position;
        if (position && is_other(carried, c, t))
            *way = glms_vec3_add(*way, glms_vec3_scale(vec3_from(position[at]), carried->weights[t]));
    }
    if (carried->has_way && carried->is_moved) *way = glms_mat4_mulv3(mat4_from(c->moved), *way, 0.0f);
    *matrix = carried->all;
    if (!carried->joints || !part->joints) return;
    float blended[16];
    gltf_blend(carried->joints, part->joints[at], part->weights[at], blended);
    *matrix = carried->is_moved ? glms_mat4_mul(mat4_from(blended), carried->back) : mat4_from(blended);
}

/// Goes on to the part of a vertex, from the one of an earlier vertex. `first` is the part's first vertex.
static void find_part(const struct gltf_mesh *mesh, int vertex, int *part, int *first)
{
    while (mesh->parts[*part].shared || vertex - *first >= mesh->parts[*part].vertex_count) {
        if (!mesh->parts[*part].shared) *first += mesh->parts[*part].vertex_count;
        (*part)++;
    }
}

void figure_carry(const struct model_pose *model, int vertex, float matrix[16], float way[3])
{
    const struct carried carried = carried_of(model);
    mat4s m;
    vec3s by;
    int part = 0, first = 0;
    find_part(carried.mesh, vertex, &part, &first);
    carry(&carried, model, &carried.mesh->parts[part], vertex - first, &m, &by);
    memcpy(matrix, &m, sizeof m);
    memcpy(way, by.raw, sizeof by.raw);
}

/// Places a vertex in the world. `part` and `first` are 0 before the first vertex, then for this function.
static void place_vertex(const struct carried *carried, const struct model_pose *model, int vertex, int *part,
                         int *first, float place[3], float normal[3])
{
    mat4s m = carried->all;
    morph_vertex(model->figure, &model->morph, vertex, place, normal);
    if (carried->joints || carried->has_way) {
        vec3s way;
        find_part(carried->mesh, vertex, part, first);
        carry(carried, model, &carried->mesh->parts[*part], vertex - *first, &m, &way);
        glm_vec3_add(place, way.raw, place);
    }
    if (carried->joints || carried->turns) glm_mat4_mulv3(m.raw, place, 1.0f, place);
    if (normal && (carried->joints || carried->turns)) gltf_turn_normal((const float *)m.raw, normal);
    m = mat4_from(model->root);
    glm_mat4_mulv3(m.raw, place, 1.0f, place);
    if (normal) gltf_turn_normal((const float *)m.raw, normal);
}

void figure_vertices(const struct model_pose *model, float (*places)[3], float (*normals)[3], float lo[3],
                     float hi[3])
{
    const struct carried carried = carried_of(model);
    int part = 0, first = 0;
    for (int v = 0; v < model->figure->character.vertex_count; v++) {
        float at[3], *place = places ? places[v] : at;
        place_vertex(&carried, model, v, &part, &first, place, normals ? normals[v] : NULL);
        for (int k = 0; lo && k < 3; k++) {
            lo[k] = fminf(lo[k], place[k]);
            hi[k] = fmaxf(hi[k], place[k]);
        }
    }
}

void figure_vertex(const struct model_pose *model, int vertex, float place[3])
{
    const struct carried carried = carried_of(model);
    int part = 0, first = 0;
    place_vertex(&carried, model, vertex, &part, &first, place, NULL);
}

int figure_lowest(const struct model_pose *model, float *height)
{
    const struct carried carried = carried_of(model);
    const struct character *c = &model->figure->character;
    int part = 0, first = 0, lowest = -1;
    for (int v = 0; v < c->vertex_count; v++) {
        bool moves = false;
        float place[3];
        for (int n = 0; n < c->coordinate_count && !moves; n++) {
            for (int p = 0; p < coordinate_parts(&c->coordinates[n]); p++)
                moves |= glms_vec3_norm2(vec3_from(c->coordinates[n].parts[p][v])) > 0;
        }
        if (!moves) continue;
        place_vertex(&carried, model, v, &part, &first, place, NULL);
        if (place[1] >= *height) continue;
        *height = place[1];
        lowest = v;
    }
    return lowest;
}

// --- a figure that is painted

struct painted *painted_create(const struct figure *plain)
{
    struct painted *painted = need_zeroed(1, sizeof *painted);
    struct figure *figure = &painted->figure;
    struct pool *pool = &figure->pool;
    const size_t vertices = (size_t)plain->character.vertex_count;
    const size_t coordinates = (size_t)plain->character.coordinate_count;
    painted->plain = plain;
    *figure = *plain;
    figure->id = gltf_new_id();
    figure->version = 1;
    *pool = (struct pool){0};
    make_room(figure, pool);
    figure->character.coordinates = pool_take(pool, coordinates, sizeof *figure->character.coordinates);
    painted->applied = pool_take(pool, vertices * coordinates, sizeof *painted->applied);
    painted->stale = pool_take(pool, vertices, sizeof *painted->stale);
    for (size_t k = 0; k < coordinates; k++) {
        const struct coordinate *from = &plain->character.coordinates[k];
        struct coordinate *c = &figure->character.coordinates[k];
        *c = *from; // shares the name
        for (int p = 0; p < coordinate_parts(from); p++) {
            c->parts[p] = pool_take(pool, vertices, sizeof *c->parts[p]);
            memcpy(c->parts[p], from->parts[p], vertices * sizeof *c->parts[p]);
        }
    }
    memcpy(figure->slopes, plain->slopes, vertices * coordinates * (size_t)plain->parts * sizeof *plain->slopes);
    memcpy(figure->largest, plain->largest, coordinates * sizeof *figure->largest);
    return painted;
}

void painted_destroy(struct painted *painted)
{
    if (!painted) return;
    pool_free(&painted->figure.pool);
    free(painted);
}

/// to = (re + j·im) from
static void turn_vector(float re, float im, const float from_re[3], const float from_im[3], float to_re[3],
                        float to_im[3])
{
    for (int k = 0; k < 3; k++) {
        to_re[k] = re * from_re[k] - im * from_im[k];
        to_im[k] = re * from_im[k] + im * from_re[k];
    }
}

void painted_update(struct painted *painted, const float (*paint)[2])
{
    struct figure *figure = &painted->figure;
    const int vertices = figure->character.vertex_count;
    const struct adjacency *edges = &figure->edges;
    const uint64_t next = figure->version + 1;
    for (int k = 0; k < figure->character.coordinate_count; k++) {
        static const float none[2];
        const struct coordinate *from = &painted->plain->character.coordinates[k];
        struct coordinate *to = &figure->character.coordinates[k];
        bool any = false;
        for (int i = 0; i < vertices; i++) {
            const size_t at = (size_t)k * (size_t)vertices + (size_t)i;
            const float *value = paint ? paint[at] : none;
            float *applied = painted->applied[at];
            if (applied[0] == value[0] && applied[1] == value[1]) continue;
            memcpy(applied, value, sizeof painted->applied[at]);
            any = true;

            // Ñ' = Ñ e^{a + jψ}; its slopes and its neighbours' are out of date.
            const float size = maths_expf(value[0]), re = size * maths_cosf(value[1]),
                        im = size * maths_sinf(value[1]);
            turn_vector(re, im, from->re[i], from->im[i], to->re[i], to->im[i]);
            if (from->sq) {
                glm_vec3_scale(from->sq[i], size * size, to->sq[i]);
                turn_vector(re * re - im * im, 2 * re * im, from->re2[i], from->im2[i], to->re2[i], to->im2[i]);
            }
            painted->stale[i] = true;
            for (int e = edges->first[i]; e < edges->first[i + 1]; e++) painted->stale[edges->other[e]] = true;
        }
        for (int i = 0; any && i < vertices; i++) {
            if (!painted->stale[i]) continue;
            painted->stale[i] = false;
            fit_slope(figure, k, i);
        }
        if (!any) continue;
        measure_largest(figure, k);
        figure->version = next;
    }
}

// --- distances along a surface, by paths that are made shorter until none can be

static const float SHORTER = 0.86f; ///< 1/1.16

void reach_create(struct reach *reach, struct pool *pool, int vertices)
{
    const size_t room = (size_t)vertices;
    *reach = (struct reach){.capacity = vertices};
    reach->distance = pool_take(pool, room, sizeof *reach->distance);
    reach->vertices = pool_take(pool, room, sizeof *reach->vertices);
    reach->along = pool_take(pool, room, sizeof *reach->along);
    reach->queue = pool_take(pool, room, sizeof *reach->queue);
    reach->waits = pool_take(pool, room, sizeof *reach->waits);
    for (int i = 0; i < vertices; i++) reach->distance[i] = reach->along[i] = INFINITY;
}

/// Offers a path of that length to a vertex, which then waits to offer it to its neighbours.
static void offer(struct reach *reach, uint32_t vertex, float along, float limit)
{
    if (!(along < reach->along[vertex] && SHORTER * along <= limit)) return;
    if (reach->along[vertex] == INFINITY) reach->vertices[reach->count++] = (int)vertex;
    reach->along[vertex] = along;
    if (reach->waits[vertex]) return;
    reach->waits[vertex] = true;
    reach->queue[(reach->first + reach->waiting++) % reach->capacity] = (int)vertex;
}

void reach_find(struct reach *reach, const struct figure *figure, const struct surface_spot *spots, int count,
                float limit)
{
    const float(*positions)[3] = (const float(*)[3])figure->character.position;
    vec3s at[REACH_MAX_SPOTS];
    for (int i = 0; i < reach->count; i++)
        reach->distance[reach->vertices[i]] = reach->along[reach->vertices[i]] = INFINITY;
    reach->count = 0;
    for (int s = 0; s < count; s++) {
        const uint32_t *corner = spots[s].corner;
        at[s] = glms_vec3_zero();
        for (int c = 0; c < 3; c++)
            at[s] = glms_vec3_muladds(vec3_from(positions[corner[c]]), spots[s].weight[c], at[s]);
        for (int c = 0; c < 3; c++)
            offer(reach, corner[c], glms_vec3_distance(at[s], vec3_from(positions[corner[c]])), limit);
    }
    for (; reach->waiting > 0; reach->waiting--) {
        const int vertex = reach->queue[reach->first];
        reach->waits[vertex] = false;
        for (int e = figure->edges.first[vertex]; e < figure->edges.first[vertex + 1]; e++) {
            const uint32_t other = figure->edges.other[e];
            const float edge = glms_vec3_distance(vec3_from(positions[vertex]), vec3_from(positions[other]));
            offer(reach, other, reach->along[vertex] + edge, limit);
        }
        reach->first = (reach->first + 1) % reach->capacity;
    }
    for (int i = 0; i < reach->count; i++) {
        const int vertex = reach->vertices[i];
        float straight = INFINITY; // the shortest line from a spot
        for (int s = 0; s < count; s++)
            straight = fminf(straight, glms_vec3_distance(at[s], vec3_from(positions[vertex])));
        reach->distance[vertex] = fmaxf(SHORTER * reach->along[vertex], straight);
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
