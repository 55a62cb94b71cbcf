/// Reads and applies --pin.
#include "simulation/region.h"
#include "base/need.h"
#include "base/png.h"
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
    const float close = 4; // steps of 255: what rounding in two programs comes to
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

bool region_nodes(const struct region *region, const struct lattice *lattice, const struct surface *surface,
                  const char *name, bool *inside, struct error *error)
{
    if (region->kind == REGION_COLOR) return colored_nodes(region, lattice, surface, name, inside, error);
    double lo[3], hi[3];
    surface_bounds(surface, lo, hi);
    double foot = region->size < 0 ? 0.05 * (hi[1] - lo[1]) : region->size;
    double rounding = 1e-9 * (hi[1] - lo[1]); // a layer of nodes lies at this height
    double top = lo[1] + foot, lowest = INFINITY;
    for (int i = 0; i < lattice->node_count; i++) lowest = fmin(lowest, lattice->node[i][1]);
    if (region->size < 0) top = fmax(top, lowest); // feet thinner than a cell
    for (int i = 0; i < lattice->node_count; i++) {
        double away[3], ahead = 0, squared = 0;
        for (int c = 0; c < 3; c++) {
            away[c] = lattice->node[i][c] - region->point[c];
            ahead += away[c] * region->normal[c];
            squared += away[c] * away[c];
        }
        if (region->kind == REGION_FOOT) inside[i] = lattice->node[i][1] <= top + rounding;
        if (region->kind == REGION_PLANE) inside[i] = ahead <= 0;
        if (region->kind == REGION_SPHERE) inside[i] = squared <= region->size * region->size;
    }
    return true;
}
