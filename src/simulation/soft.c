/// Reads --pin and --soft, makes a soft body, tunes it to a frequency, and pins and shakes it.
#include "simulation/soft.h"
#include "base/file.h"
#include "base/need.h"
#include "base/npy.h"
#include "base/png.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SEEN_AMONG = 24 }; ///< modes among which the one that is seen most is found

// --- regions and softness

/// `count` numbers with commas between; false if there are more or fewer.
static bool read_reals(const char *text, int count, double *numbers)
{
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || !isfinite(numbers[i]) || *end != (i + 1 < count ? ',' : '\0')) return false;
        text = end + 1;
    }
    return true;
}

bool region_parse(const char *text, struct region *region)
{
    double n[6];
    *region = (struct region){.kind = REGION_NONE};
    if (strcmp(text, "none") == 0) return true;
    if (strncmp(text, "plane:", 6) == 0) {
        if (!read_reals(text + 6, 6, n) || (n[3] == 0 && n[4] == 0 && n[5] == 0)) return false;
        region->kind = REGION_PLANE;
        memcpy(region->point, n, sizeof region->point);
        memcpy(region->normal, n + 3, sizeof region->normal);
        return true;
    }
    if (strncmp(text, "sphere:", 7) == 0) {
        if (!read_reals(text + 7, 4, n) || !(n[3] > 0)) return false;
        region->kind = REGION_SPHERE;
        memcpy(region->point, n, sizeof region->point);
        region->size = n[3];
        return true;
    }
    if (strncmp(text, "color:", 6) == 0) {
        if (strlen(text + 6) != 6 || strspn(text + 6, "0123456789abcdefABCDEF") != 6) return false;
        region->kind = REGION_COLOR;
        region->color = (uint32_t)strtoul(text + 6, NULL, 16);
        return true;
    }
    region->kind = REGION_FOOT;
    return read_reals(text, 1, &region->size) && region->size >= 0;
}

static bool has_color(const struct region *region, const float linear[3])
{
    const float close = 4; // steps of 255: the rounding of two programs
    for (int c = 0; c < 3; c++) {
        float wanted = (float)(region->color >> (16 - 8 * c) & 0xFF);
        if (fabsf(255 * srgb_from_linear(linear[c]) - wanted) > close) return false;
    }
    return true;
}

double region_distance(const struct region *region, const double point[3])
{
    double least = INFINITY;
    for (int n = 0; n < region->line_count; n++) {
        const double *from = region->line[n][0], *to = region->line[n][1];
        double along[3], away[3];
        for (int c = 0; c < 3; c++) along[c] = to[c] - from[c], away[c] = point[c] - from[c];
        const double length = vec3_dot(along, along), at = length > 0 ? vec3_dot(along, away) / length : 0;
        for (int c = 0; c < 3; c++) away[c] -= fmin(fmax(at, 0), 1) * along[c];
        least = fmin(least, vec3_length(away));
    }
    return least;
}

/// Whether points are in a region other than a colour's. `lowest`: a foot of the usual height is at least as high.
static void mark_points(const struct region *region, const struct surface *surface, double lowest,
                        const double (*point)[3], int count, bool *inside)
{
    double lo[3], hi[3];
    surface_bounds(surface, lo, hi);
    double foot = region->size < 0 ? 0.05 * (hi[1] - lo[1]) : region->size;
    double rounding = 1e-9 * (hi[1] - lo[1]); // so that the layer of nodes at this height counts
    double top = lo[1] + foot;
    if (region->size < 0) top = fmax(top, lowest);
    for (int i = 0; i < count; i++) {
        double away[3], ahead = 0, squared = 0;
        for (int c = 0; c < 3; c++) {
            away[c] = point[i][c] - region->point[c];
            ahead += away[c] * region->normal[c];
            squared += away[c] * away[c];
        }
        if (region->kind == REGION_FOOT) inside[i] = point[i][1] <= top + rounding;
        if (region->kind == REGION_PLANE) inside[i] = ahead <= 0;
        if (region->kind == REGION_BONES) inside[i] = region_distance(region, point[i]) <= region->size;
        if (region->kind == REGION_SPHERE) inside[i] = squared <= region->size * region->size;
    }
}

int region_vertices(const struct region *region, const struct surface *surface, bool *inside)
{
    double(*point)[3] = need((size_t)surface->vertex_count + 1, sizeof *point);
    int found = 0;
    for (int n = 0; n < 3 * surface->vertex_count; n++) point[n / 3][n % 3] = (double)surface->position[n / 3][n % 3];
    mark_points(region, surface, -INFINITY, (const double(*)[3])point, surface->vertex_count, inside);
    for (int i = 0; i < surface->vertex_count; i++) {
        if (region->kind == REGION_COLOR) inside[i] = surface->color && has_color(region, surface->color[i]);
        if (region->kind == REGION_BONES) inside[i] |= region->held[i] > 0.5;
        found += inside[i];
    }
    free(point);
    return found;
}

bool softness_apply(const struct softness *softness, const struct lattice *lattice, const struct surface *surface,
                    const char *name, struct body *body, struct error *error)
{
    enum { FILE_LIMIT = 1 << 30 };
    if (!softness->from) return true;
    const bool by_distance = strcmp(softness->from, "distance") == 0, by_color = strcmp(softness->from, "color") == 0;
    double *vertex = need_zeroed((size_t)surface->vertex_count + 1, sizeof *vertex);
    double *node = need_zeroed((size_t)lattice->node_count + 1, sizeof *node);
    bool good = true;
    if (by_distance) {
        // Shortest paths along the elements' edges from the pinned nodes (Bellman and Ford), scaled to a longest of 1.
        double longest = 0;
        bool any = false;
        for (int i = 0; i < lattice->node_count; i++) {
            node[i] = body->pinned[i] ? 0 : INFINITY;
            any |= body->pinned[i];
        }
        for (bool changed = true; changed;) {
            changed = false;
            for (int e = 0; e < lattice->tet_count; e++) {
                for (int k = 0; k < 16; k++) {
                    int from = lattice->tet[e][k / 4], to = lattice->tet[e][k % 4];
                    double edge[3];
                    for (int c = 0; c < 3; c++) edge[c] = lattice->node[to][c] - lattice->node[from][c];
                    double way = node[from] + vec3_length(edge);
                    if (way >= node[to]) continue;
                    node[to] = way;
                    changed = true;
                }
            }
        }
        for (int i = 0; i < lattice->node_count; i++) longest = isfinite(node[i]) ? fmax(longest, node[i]) : longest;
        for (int i = 0; i < lattice->node_count; i++) node[i] = fmin(1, node[i] / fmax(longest, 1e-300));
        if (!any) good = fail(error, ERROR_INPUT, "%s: --soft distance: expected a pinned region, got none", name);
    } else if (by_color) {
        if (!surface->color)
            good = fail(error, ERROR_INPUT, "%s: --soft color: expected colours of vertices, got none", name);
        for (int i = 0; good && i < surface->vertex_count; i++) {
            for (int c = 0; c < 3; c++) vertex[i] += (double)srgb_from_linear(surface->color[i][c]) / 3;
            vertex[i] =
                fmin(1, fmax(0, vertex[i])); // colours in files may be brighter than white or darker than black
        }
    } else { // a .npy of float32 or float64 numbers
        const char *path = softness->from;
        const int vertices = surface->vertex_count;
        struct npy npy;
        char *data = NULL;
        size_t size;
        good =
            file_read_text(path, FILE_LIMIT, &data, &size, error) && npy_read_header(&npy, path, data, size, error);
        bool fits = good && npy.count >= 1 && npy.lengths[0] == vertices;
        for (int i = 1; fits && i < npy.count; i++) fits = npy.lengths[i] == 1;
        if (good && !fits)
            good = fail(error, ERROR_INPUT, "%s: expected an array of %d numbers, one a vertex, got %s", path,
                        vertices, npy.shape);
        if (good && size - (size_t)npy.data < (size_t)vertices * (size_t)npy.number_size)
            good = fail(error, ERROR_INPUT, "%s: expected %d numbers, got a file that ends before", path, vertices);
        for (int i = 0; good && i < vertices; i++) {
            vertex[i] = npy_number(&npy, data + npy.data + (size_t)i * (size_t)npy.number_size);
            if (!(vertex[i] >= 0 && vertex[i] <= 1))
                good = fail(error, ERROR_INPUT, "%s: vertex %d: expected a number from 0 to 1, got %g", path, i,
                            vertex[i]);
        }
        free(data);
    }
    if (good && !by_distance) lattice_spread(lattice, vertex, node);
    for (int e = 0; good && e < body->element_count; e++) {
        double weight = 0;
        for (int a = 0; a < 4; a++) weight += node[lattice->tet[e][a]] / 4;
        body->elements[e].stiffness = pow(softness->times, -weight);
    }
    free(vertex);
    free(node);
    return good;
}

// --- the soft body

struct soft_options soft_default_options(void)
{
    return (struct soft_options){.tets = 3000,
                                 .thickness = -1,
                                 .pin = {.kind = REGION_FOOT, .size = -1},
                                 .softness = {.times = 8},
                                 .frequency = 2,
                                 .poisson = 0.35,
                                 .density = 1000,
                                 .damping = 0.03};
}

static const double line_reach = 0.6; ///< cells: a line passes no farther from some node of the lattice

static bool pin_nodes(struct soft *soft, const struct surface *surface, const struct region *region, const char *name,
                      struct error *error)
{
    const int most = soft->body.node_count > surface->vertex_count ? soft->body.node_count : surface->vertex_count;
    bool *inside = need_zeroed((size_t)most + 1, sizeof *inside);
    const struct lattice *lattice = &soft->lattice;
    const bool colored = region->kind == REGION_COLOR, bones = region->kind == REGION_BONES;
    struct region widened = *region;
    bool good = true;
    soft->depth = widened.size = bones ? fmax(region->size, line_reach * lattice->cell) : region->size;
    region = &widened;
    if (!colored) {
        double lowest = INFINITY; // if the feet are thinner than a cell
        for (int i = 0; i < lattice->node_count; i++) lowest = fmin(lowest, lattice->node[i][1]);
        mark_points(region, surface, lowest, (const double(*)[3])lattice->node, lattice->node_count, inside);
    }
    if (colored || bones) {
        double *vertex = need_zeroed((size_t)surface->vertex_count + 1, sizeof *vertex);
        double *node = need_zeroed((size_t)lattice->node_count + 1, sizeof *node);
        int found = bones;
        for (int i = 0; i < surface->vertex_count; i++) {
            vertex[i] = bones ? region->held[i] : surface->color && has_color(region, surface->color[i]);
            found += vertex[i] > 0;
        }
        lattice_spread(lattice, vertex, node);
        for (int i = 0; i < lattice->node_count; i++) inside[i] |= node[i] > 0.5;
        free(vertex);
        free(node);
        if (found == 0)
            good = fail(error, ERROR_INPUT, "%s: no vertex has the colour %06X of --pin", name, region->color);
    }
    for (int i = 0; good && i < soft->body.node_count; i++) {
        if (!inside[i]) continue;
        soft->body.pinned[i] = true;
        soft->pinned++;
    }
    bool *held = need_zeroed((size_t)lattice->part_count + 1, sizeof *held);
    for (int n = 0; n < 4 * lattice->tet_count; n++)
        held[lattice->part[n / 4]] |= soft->body.pinned[lattice->tet[n / 4][n % 4]];
    for (int p = 0; p < lattice->part_count; p++) soft->unpinned_parts += !held[p];
    for (int n = 0; bones && soft->pinned > 0 && n < 4 * lattice->tet_count; n++)
        if (!held[lattice->part[n / 4]]) soft->body.pinned[lattice->tet[n / 4][n % 4]] = true;
    free(held);
    const bool whole = region_vertices(region, surface, inside) == surface->vertex_count; // a flag that lies
    free(inside);
    if (!good) return false;
    if (bones && (whole || soft->pinned == soft->body.node_count))
        return fail(
            error, ERROR_INPUT,
            "%s: nothing can move: all of it is within %.3g m of a bone: try a smaller --depth, or more --tets", name,
            soft->depth);
    if (whole || soft->pinned == soft->body.node_count)
        return fail(error, ERROR_INPUT, "%s: nothing can move: all of it is in the region of --pin", name);
    if (soft->pinned == 0 && region->kind != REGION_NONE)
        return fail(error, ERROR_INPUT,
                    "%s: the region of %s holds nothing: it is off the mesh or smaller than a cell of %.3g m", name,
                    bones ? "--depth" : "--pin", lattice->cell);
    return true;
}

/// How far a shake moves a node, relative to its amplitude: with a driven base the same for all; else the square of the way from the
/// pinned nodes.
static double shaken_part(const struct soft *soft, const struct shake *shake, int node)
{
    if (soft->body.pinned[node]) return 0;
    if (shake->driven) return 1;
    double at = soft->body.rest[node][soft->axis];
    double away = fmax(0, fmax(at - soft->held[1], soft->held[0] - at)), farthest = fmax(soft->farthest, 1e-30);
    return away / farthest * (away / farthest);
}

double soft_frequency(const struct soft *soft)
{
    return soft->modes.count > 0 ? soft->modes.frequency[soft->seen] : 0;
}

bool soft_create(struct soft *soft, const struct surface *surface, const char *name,
                 const struct soft_options *options, struct error *error)
{
    *soft = (struct soft){0};
    struct lattice *lattice = &soft->lattice;
    struct body *body = &soft->body;
    const struct region *held = &options->pin;
    double lo[3], hi[3];
    surface_bounds(surface, lo, hi);
    soft->bottom = lo[1];
    soft->height = hi[1] - lo[1];
    const double foot = held->size < 0 ? 0.05 * soft->height : held->size;
    const double layer = held->kind == REGION_FOOT ? soft->bottom + foot : NAN;
    bool good = lattice_create(lattice, surface, &(struct lattice_options){options->tets, layer, options->thickness},
                               name, error);
    const struct body_mesh mesh = {(const double(*)[3])lattice->node, lattice->node_count,
                                   (const int(*)[4])lattice->tet, lattice->fraction, lattice->tet_count};
    if (good && !body_create(body, &mesh, material_from(1, options->poisson), options->density))
        good = fail(error, ERROR_INPUT, "%s: the lattice has a tetrahedron without volume", name);
    good = good && pin_nodes(soft, surface, held, name, error) &&
           softness_apply(&options->softness, lattice, surface, name, body, error);
    if (!good) {
        soft_free(soft);
        return false;
    }

    body_ready(body);
    static const int order[] = {1, 0, 2, 1}; // y again if none is long enough
    const double long_enough = 0.1 * fmax(hi[0] - lo[0], fmax(hi[1] - lo[1], hi[2] - lo[2]));
    for (int k = 0; k < 4; k++) {
        soft->axis = order[k];
        soft->low = lo[soft->axis];
        soft->size = hi[soft->axis] - soft->low;
        soft->held[0] = soft->pinned > 0 ? INFINITY : soft->low;
        soft->held[1] = soft->pinned > 0 ? -INFINITY : soft->low;
        for (int i = 0; i < body->node_count; i++) {
            if (!body->pinned[i]) continue;
            soft->held[0] = fmin(soft->held[0], body->rest[i][soft->axis]);
            soft->held[1] = fmax(soft->held[1], body->rest[i][soft->axis]);
        }
        soft->farthest = fmax(soft->low + soft->size - soft->held[1], soft->held[0] - soft->low);
        if (soft->farthest > long_enough) break;
    }

    // Finds the modes for Young's modulus 1 and scales it: frequencies grow with its square root.
    modes_create(&soft->modes, body, options->shake ? SEEN_AMONG : 1);
    if (soft->modes.count == 0) return true;
    if (options->shake) {
        // Finds the mode that is seen most: by the power with which it moves the surface, times how long it lasts, 1 / ω.
        const int vertices = soft->lattice.vertex_count;
        float(*vertex)[3] = need_zeroed((size_t)vertices + 1, sizeof *vertex);
        double most = 0, all = 0;
        for (int k = 0; k < soft->modes.count; k++) {
            const double(*shape)[3] = (const double(*)[3])(soft->modes.shape + (size_t)k * (size_t)body->node_count);
            const double omega = soft->modes.frequency[k];
            double moved[3] = {0}; // Σ m φ u: how far the shake moves the mode; a push, 1 / ω as far
            for (int i = 0; i < body->node_count; i++) {
                const double part = body->mass[i] * shaken_part(soft, options->shake, i);
                for (int c = 0; c < 3; c++) moved[c] += part * shape[i][c];
            }
            const double *along = options->shake->direction;
            const double overlap = vec3_dot(along, along) > 0 ? vec3_dot(moved, along) : vec3_length(moved);
            const double amplitude = options->shake->impulse ? overlap / omega : overlap;
            double power = 0; // Σ |φ|² over the surface's vertices; those without triangles stay at 0
            lattice_embed(&soft->lattice, shape, vertex);
            for (int n = 0; n < 3 * vertices; n++) power += pow((double)vertex[n / 3][n % 3], 2);
            const double seen = amplitude * amplitude * power / omega;
            all += seen;
            if (seen <= most) continue;
            most = seen;
            soft->seen = k;
        }
        soft->share = all > 0 ? most / all : 0;
        free(vertex);
    }
    soft->young =
        options->young > 0 ? options->young : pow(options->frequency / soft->modes.frequency[soft->seen], 2);
    for (int k = 0; k < soft->modes.count; k++) soft->modes.frequency[k] *= sqrt(soft->young);
    if (!(options->young > 0)) soft->modes.frequency[soft->seen] = options->frequency; // to the last bit
    body->material = material_from(soft->young, options->poisson);
    const double omega = 2 * M_PI * soft_frequency(soft);
    soft->alpha = options->damping * omega;
    soft->beta = options->damping / omega;
    return true;
}

void soft_free(struct soft *soft)
{
    pool_free(&soft->lattice.pool);
    pool_free(&soft->body.pool);
    pool_free(&soft->modes.pool);
    *soft = (struct soft){0};
}

void soft_shake(const struct soft *soft, const struct shake *shake, struct integrator *integrator)
{
    if (shake->driven) return;
    double size = shake->amplitude * soft->size * (shake->impulse ? 2 * M_PI * soft_frequency(soft) : 1);
    for (int i = 0; i < soft->body.node_count; i++) {
        double part = shaken_part(soft, shake, i);
        for (int c = 0; c < 3; c++) {
            double change = size * part * shake->direction[c];
            (shake->impulse ? integrator->v : integrator->x)[i][c] += change;
        }
    }
}
