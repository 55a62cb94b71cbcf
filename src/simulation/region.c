/// Reads --pin and finds the pinned nodes; reads --soft and sets the elements' stiffness.
#include "simulation/region.h"
#include "base/file.h"
#include "base/need.h"
#include "base/npy.h"
#include "base/png.h"
#include "simulation/linear.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// `count` numbers with commas between; false if there are more or fewer.
static bool read_numbers(const char *text, int count, double *numbers)
{
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || !isfinite(numbers[i]) || *end != (i + 1 < count ? ',' : '\0')) return false;
        text = end + 1;
    }
    return true;
}

static bool read_plane(const char *text, struct region *region)
{
    double n[6];
    if (!read_numbers(text, 6, n) || (n[3] == 0 && n[4] == 0 && n[5] == 0)) return false;
    region->kind = REGION_PLANE;
    memcpy(region->point, n, sizeof region->point);
    memcpy(region->normal, n + 3, sizeof region->normal);
    return true;
}

static bool read_sphere(const char *text, struct region *region)
{
    double n[4];
    if (!read_numbers(text, 4, n) || !(n[3] > 0)) return false;
    region->kind = REGION_SPHERE;
    memcpy(region->point, n, sizeof region->point);
    region->size = n[3];
    return true;
}

static bool read_color(const char *text, struct region *region)
{
    if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6) return false;
    region->kind = REGION_COLOR;
    region->color = (uint32_t)strtoul(text, NULL, 16);
    return true;
}

bool region_parse(const char *text, struct region *region)
{
    *region = (struct region){.kind = REGION_NONE};
    if (strcmp(text, "none") == 0) return true;
    if (strncmp(text, "plane:", 6) == 0) return read_plane(text + 6, region);
    if (strncmp(text, "sphere:", 7) == 0) return read_sphere(text + 7, region);
    if (strncmp(text, "color:", 6) == 0) return read_color(text + 6, region);
    region->kind = REGION_FOOT;
    return read_numbers(text, 1, &region->size) && region->size >= 0;
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

static bool colored_nodes(const struct region *region, const struct lattice *lattice, const struct surface *surface,
                          const char *name, bool *inside, struct error *error)
{
    double *vertex = need_zeroed((size_t)surface->vertex_count + 1, sizeof *vertex);
    double *node = need_zeroed((size_t)lattice->node_count + 1, sizeof *node);
    int found = 0;
    for (int i = 0; surface->color && i < surface->vertex_count; i++) {
        vertex[i] = has_color(region, surface->color[i]);
        found += vertex[i] > 0;
    }
    lattice_spread(lattice, vertex, node);
    for (int i = 0; i < lattice->node_count; i++) inside[i] = node[i] > 0.5;
    free(vertex);
    free(node);
    return found > 0 || fail(error, ERROR_INPUT, "%s: no vertex has the colour %06X of --pin", name, region->color);
}

/// Whether points are in a region other than a colour's. `lowest`: a foot of the usual height is at least as high.
static void check_points(const struct region *region, const struct surface *surface, double lowest,
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
        if (region->kind == REGION_SPHERE) inside[i] = squared <= region->size * region->size;
    }
}

bool region_nodes(const struct region *region, const struct lattice *lattice, const struct surface *surface,
                  const char *name, bool *inside, struct error *error)
{
    if (region->kind == REGION_COLOR) return colored_nodes(region, lattice, surface, name, inside, error);
    double lowest = INFINITY; // if the feet are thinner than a cell
    for (int i = 0; i < lattice->node_count; i++) lowest = fmin(lowest, lattice->node[i][1]);
    check_points(region, surface, lowest, (const double(*)[3])lattice->node, lattice->node_count, inside);
    return true;
}

int region_vertices(const struct region *region, const struct surface *surface, bool *inside)
{
    double(*point)[3] = need((size_t)surface->vertex_count + 1, sizeof *point);
    int found = 0;
    for (int n = 0; n < 3 * surface->vertex_count; n++) point[n / 3][n % 3] = (double)surface->position[n / 3][n % 3];
    check_points(region, surface, -INFINITY, (const double(*)[3])point, surface->vertex_count, inside);
    for (int i = 0; i < surface->vertex_count; i++) {
        if (region->kind == REGION_COLOR) inside[i] = surface->color && has_color(region, surface->color[i]);
        found += inside[i];
    }
    free(point);
    return found;
}

enum { FILE_LIMIT = 1 << 30 };

/// Shortest paths along the elements' edges from the pinned nodes (Bellman and Ford), scaled to a longest of 1.
static bool weigh_distance(const struct lattice *lattice, const struct body *body, const char *name, double *node,
                           struct error *error)
{
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
    return any || fail(error, ERROR_INPUT, "%s: --soft distance: expected a pinned region, got none", name);
}

static bool weigh_color(const struct surface *surface, const char *name, double *vertex, struct error *error)
{
    if (!surface->color)
        return fail(error, ERROR_INPUT, "%s: --soft color: expected colours of vertices, got none", name);
    for (int i = 0; i < surface->vertex_count; i++) {
        for (int c = 0; c < 3; c++) vertex[i] += (double)srgb_from_linear(surface->color[i][c]) / 3;
        vertex[i] = fmin(1, fmax(0, vertex[i])); // colours in files may be brighter than white or darker than black
    }
    return true;
}

/// Reads a .npy of `vertices` float32 or float64 numbers.
static bool read_weights(const char *path, const char *data, size_t size, int vertices, double *vertex,
                         struct error *error)
{
    struct npy npy;
    if (!npy_read_header(&npy, path, data, size, error)) return false;
    bool fits = npy.count >= 1 && npy.lengths[0] == vertices;
    for (int i = 1; i < npy.count; i++) fits &= npy.lengths[i] == 1;
    if (!fits)
        return fail(error, ERROR_INPUT, "%s: expected an array of %d numbers, one a vertex, got %s", path, vertices,
                    npy.shape);
    if (size - (size_t)npy.data < (size_t)vertices * (size_t)npy.number_size)
        return fail(error, ERROR_INPUT, "%s: expected %d numbers, got a file that ends before", path, vertices);
    for (int i = 0; i < vertices; i++) {
        vertex[i] = npy_number(&npy, data + npy.data + (size_t)i * (size_t)npy.number_size);
        if (!(vertex[i] >= 0 && vertex[i] <= 1))
            return fail(error, ERROR_INPUT, "%s: vertex %d: expected a number from 0 to 1, got %g", path, i,
                        vertex[i]);
    }
    return true;
}

static bool weigh_painted(const char *path, int vertices, double *vertex, struct error *error)
{
    char *data;
    size_t size;
    if (!file_read_text(path, FILE_LIMIT, &data, &size, error)) return false;
    bool good = read_weights(path, data, size, vertices, vertex, error);
    free(data);
    return good;
}

static bool weigh(const struct softness *softness, const struct lattice *lattice, const struct surface *surface,
                  const char *name, const struct body *body, double *vertex, double *node, struct error *error)
{
    if (strcmp(softness->from, "distance") == 0) return weigh_distance(lattice, body, name, node, error);
    bool good = strcmp(softness->from, "color") == 0
                    ? weigh_color(surface, name, vertex, error)
                    : weigh_painted(softness->from, surface->vertex_count, vertex, error);
    if (good) lattice_spread(lattice, vertex, node);
    return good;
}

bool softness_apply(const struct softness *softness, const struct lattice *lattice, const struct surface *surface,
                    const char *name, struct body *body, struct error *error)
{
    if (!softness->from) return true;
    double *vertex = need_zeroed((size_t)surface->vertex_count + 1, sizeof *vertex);
    double *node = need_zeroed((size_t)lattice->node_count + 1, sizeof *node);
    const bool good = weigh(softness, lattice, surface, name, body, vertex, node, error);
    for (int e = 0; good && e < body->element_count; e++) {
        double weight = 0;
        for (int a = 0; a < 4; a++) weight += node[lattice->tet[e][a]] / 4;
        body->elements[e].stiffness = pow(softness->times, -weight);
    }
    free(vertex);
    free(node);
    return good;
}
