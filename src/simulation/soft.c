/// Tunes a soft body to a frequency, and pins and shakes it.
#include "simulation/soft.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct soft_options soft_default_options(void)
{
    return (struct soft_options){.tets = 3000,
                                 .thickness = -1,
                                 .pin = {.kind = REGION_FOOT, .size = -1},
                                 .softness = {.times = 8},
                                 .frequency = 2,
                                 .poisson = 0.35,
                                 .density = 1000,
                                 .damping = 0.03,
                                 .modes = 1};
}

static void measure(struct soft *soft, const struct surface *surface)
{
    double lo[3], hi[3];
    surface_bounds(surface, lo, hi);
    soft->bottom = lo[1];
    soft->height = hi[1] - lo[1];
}

static bool pin(struct soft *soft, const struct surface *surface, const struct region *region, const char *name,
                struct error *error)
{
    const int most = soft->body.node_count > surface->vertex_count ? soft->body.node_count : surface->vertex_count;
    bool *inside = need_zeroed((size_t)most + 1, sizeof *inside);
    bool good = region_nodes(region, &soft->lattice, surface, name, inside, error);
    for (int i = 0; good && i < soft->body.node_count; i++) {
        if (!inside[i]) continue;
        soft->body.pinned[i] = true;
        soft->pinned++;
    }
    const bool whole = region_vertices(region, surface, inside) == surface->vertex_count; // a flag that lies
    free(inside);
    if (!good) return false;
    if (whole || soft->pinned == soft->body.node_count)
        return fail(error, ERROR_INPUT, "%s: nothing can move: all of it is in the region of --pin", name);
    if (soft->pinned == 0 && region->kind != REGION_NONE)
        return fail(error, ERROR_INPUT,
                    "%s: the region of --pin holds nothing: it is off the mesh or smaller than a cell of %.3g m",
                    name, soft->lattice.cell);
    body_ready(&soft->body);
    return true;
}

/// Counts the parts of the lattice without a pinned node.
static void count_loose(struct soft *soft)
{
    const struct lattice *lattice = &soft->lattice;
    bool *held = need_zeroed((size_t)lattice->part_count + 1, sizeof *held);
    for (int e = 0; e < lattice->tet_count; e++) {
        for (int a = 0; a < 4; a++) held[lattice->part[e]] |= soft->body.pinned[lattice->tet[e][a]];
    }
    for (int p = 0; p < lattice->part_count; p++) soft->loose_parts += !held[p];
    free(held);
}

/// The range of the pinned nodes along the shake's axis; the body's low end if none is pinned.
static void pinned_range(const struct soft *soft, double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int i = 0; i < soft->body.node_count; i++) {
        if (!soft->body.pinned[i]) continue;
        range[0] = fmin(range[0], soft->body.rest[i][soft->axis]);
        range[1] = fmax(range[1], soft->body.rest[i][soft->axis]);
    }
    if (soft->pinned == 0) range[0] = range[1] = soft->low;
}

/// How far the surface reaches beyond the pinned nodes along the shake's axis.
static double farthest_away(const struct soft *soft, const double pinned[2])
{
    return fmax(soft->low + soft->size - pinned[1], pinned[0] - soft->low);
}

static void choose_axis(struct soft *soft, const struct surface *surface)
{
    static const int order[] = {1, 0, 2, 1}; // y again if none is long enough
    double lo[3], hi[3], pinned[2];
    surface_bounds(surface, lo, hi);
    const double long_enough = 0.1 * fmax(hi[0] - lo[0], fmax(hi[1] - lo[1], hi[2] - lo[2]));
    for (int k = 0; k < 4; k++) {
        soft->axis = order[k];
        soft->low = lo[soft->axis];
        soft->size = hi[soft->axis] - soft->low;
        pinned_range(soft, pinned);
        if (farthest_away(soft, pinned) > long_enough) return;
    }
}

/// How far a shake moves a node, relative to its amplitude: with a driven base the same for all; else the square of the way from the
/// pinned nodes.
static double shaken_part(const struct soft *soft, const struct shake *shake, const double pinned[2], int node)
{
    if (soft->body.pinned[node]) return 0;
    if (shake->driven) return 1;
    double at = soft->body.rest[node][soft->axis];
    double away = fmax(0, fmax(at - pinned[1], pinned[0] - at));
    double farthest = fmax(farthest_away(soft, pinned), 1e-30);
    return away / farthest * (away / farthest);
}

/// Σ |φ|² over the surface's vertices.
static double surface_power(const struct lattice *lattice, const double (*shape)[3])
{
    float(*vertex)[3] = need_zeroed((size_t)lattice->vertex_count + 1, sizeof *vertex);
    double power = 0;
    lattice_embed(lattice, shape, vertex);
    for (int n = 0; n < 3 * lattice->vertex_count; n++) power += pow((double)vertex[n / 3][n % 3], 2);
    free(vertex);
    return power;
}

/// How far a shake moves a mode: their overlap Σ m φ·u; a push, 1 / ω as far.
static double mode_amplitude(const struct soft *soft, const struct shake *shake, const double (*shape)[3],
                             double omega)
{
    const struct body *body = &soft->body;
    double pinned[2], overlap = 0;
    pinned_range(soft, pinned);
    for (int i = 0; i < body->node_count; i++) {
        double along = 0;
        for (int c = 0; c < 3; c++) along += shape[i][c] * shake->direction[c];
        overlap += body->mass[i] * shaken_part(soft, shake, pinned, i) * along;
    }
    return shake->impulse ? overlap / omega : overlap;
}

/// Finds the mode that is seen most: by the power with which it moves the surface, times how long it lasts, 1 / ω.
static void find_seen(struct soft *soft, const struct shake *shake)
{
    double most = 0, all = 0;
    for (int k = 0; k < soft->modes.count; k++) {
        const double(*shape)[3] = (const double(*)[3])(soft->modes.shape + (size_t)k * (size_t)soft->body.node_count);
        const double omega = soft->modes.frequency[k], amplitude = mode_amplitude(soft, shake, shape, omega);
        const double seen = amplitude * amplitude * surface_power(&soft->lattice, shape) / omega;
        all += seen;
        if (seen <= most) continue;
        most = seen;
        soft->seen = k;
    }
    soft->share = all > 0 ? most / all : 0;
}

/// Finds the modes for Young's modulus 1 and scales it: frequencies grow with its square root.
static void tune(struct soft *soft, const struct soft_options *options)
{
    soft->body.material = material_from(1, options->poisson);
    modes_create(&soft->modes, &soft->body, options->modes);
    if (soft->modes.count == 0) return;
    if (options->shake) find_seen(soft, options->shake);
    soft->young =
        options->young > 0 ? options->young : pow(options->frequency / soft->modes.frequency[soft->seen], 2);
    for (int k = 0; k < soft->modes.count; k++) soft->modes.frequency[k] *= sqrt(soft->young);
    soft->body.material = material_from(soft->young, options->poisson);
    double omega = 2 * M_PI * soft_frequency(soft);
    soft->alpha = options->damping * omega;
    soft->beta = options->damping / omega;
}

double soft_frequency(const struct soft *soft)
{
    return soft->modes.count > 0 ? soft->modes.frequency[soft->seen] : 0;
}

static bool make(struct soft *soft, const struct surface *surface, const char *name,
                 const struct soft_options *options, struct error *error)
{
    struct lattice *lattice = &soft->lattice;
    const struct region *held = &options->pin;
    double foot = held->size < 0 ? 0.05 * soft->height : held->size;
    double layer = held->kind == REGION_FOOT ? soft->bottom + foot : NAN;
    if (!lattice_create(lattice, surface, options->tets, layer, options->thickness, name, error)) return false;
    bool whole = body_create(&soft->body, (const double(*)[3])lattice->node, lattice->node_count,
                             (const int(*)[4])lattice->tet, lattice->fraction, lattice->tet_count,
                             material_from(1, options->poisson), options->density);
    if (!whole) return fail(error, ERROR_INPUT, "%s: the lattice has a tetrahedron without volume", name);
    if (!pin(soft, surface, held, name, error) ||
        !softness_apply(&options->softness, lattice, surface, name, &soft->body, error))
        return false;
    count_loose(soft);
    choose_axis(soft, surface);
    tune(soft, options);
    return true;
}

bool soft_create(struct soft *soft, const struct surface *surface, const char *name,
                 const struct soft_options *options, struct error *error)
{
    *soft = (struct soft){0};
    measure(soft, surface);
    if (make(soft, surface, name, options, error)) return true;
    soft_free(soft);
    return false;
}

void soft_free(struct soft *soft)
{
    lattice_free(&soft->lattice);
    body_free(&soft->body);
    modes_free(&soft->modes);
    *soft = (struct soft){0};
}

void soft_shake(const struct soft *soft, const struct shake *shake, struct integrator *integrator)
{
    if (shake->driven) return;
    double size = shake->amplitude * soft->size * (shake->impulse ? 2 * M_PI * soft_frequency(soft) : 1), pinned[2];
    pinned_range(soft, pinned);
    for (int i = 0; i < soft->body.node_count; i++) {
        double part = shaken_part(soft, shake, pinned, i);
        for (int c = 0; c < 3; c++) {
            double change = size * part * shake->direction[c];
            (shake->impulse ? integrator->v : integrator->x)[i][c] += change;
        }
    }
}
