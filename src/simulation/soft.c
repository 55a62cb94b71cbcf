/// Tunes a soft body to a frequency, and pins and shakes it.
#include "simulation/soft.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct soft_options soft_default_options(void)
{
    return (struct soft_options){
        .tets = 3000, .pin = -1, .frequency = 2, .poisson = 0.35, .density = 1000, .damping = 0.03, .modes = 1};
}

static void measure(struct soft *soft, const struct surface *surface)
{
    double lo[3], hi[3];
    surface_bounds(surface, lo, hi);
    soft->bottom = lo[1];
    soft->height = hi[1] - lo[1];
}

static void pin(struct soft *soft, double height)
{
    if (height < 0) height = 0.05 * soft->height;
    for (int i = 0; i < soft->body.node_count; i++) {
        if (soft->body.rest[i][1] > soft->bottom + height) continue;
        body_pin(&soft->body, i);
        soft->pinned++;
    }
    body_ready(&soft->body);
}

/// Counts the parts of the lattice that nothing holds.
static bool count_loose(struct soft *soft)
{
    const struct lattice *lattice = &soft->lattice;
    bool *held = calloc((size_t)lattice->part_count + 1, sizeof *held);
    if (!held) return false;
    for (int e = 0; e < lattice->tet_count; e++) {
        for (int a = 0; a < 4; a++) held[lattice->part[e]] |= soft->body.pinned[lattice->tet[e][a]];
    }
    for (int p = 0; p < lattice->part_count; p++) soft->loose_parts += !held[p];
    free(held);
    return true;
}

/// Finds the modes with Young's modulus 1 and scales: frequencies go with its square root.
static bool tune(struct soft *soft, const struct soft_options *options)
{
    soft->body.material = material_from(1, options->poisson);
    if (!modes_create(&soft->modes, &soft->body, options->modes)) return false;
    if (soft->modes.count == 0) return true;
    double first = soft->modes.frequency[0];
    soft->young = options->young > 0 ? options->young : pow(options->frequency / first, 2);
    for (int k = 0; k < soft->modes.count; k++) soft->modes.frequency[k] *= sqrt(soft->young);
    soft->body.material = material_from(soft->young, options->poisson);
    double omega = 2 * M_PI * soft->modes.frequency[0];
    soft->alpha = options->damping * omega;
    soft->beta = options->damping / omega;
    return true;
}

bool soft_create(struct soft *soft, const struct surface *surface, const char *name,
                 const struct soft_options *options, struct error *error)
{
    *soft = (struct soft){0};
    struct lattice *lattice = &soft->lattice;
    measure(soft, surface);
    if (!lattice_create(lattice, surface, options->tets, name, error)) return false;
    bool good = body_create(&soft->body, (const double(*)[3])lattice->node, lattice->node_count,
                            (const int(*)[4])lattice->tet, lattice->fraction, lattice->tet_count,
                            material_from(1, options->poisson), options->density);
    if (good) pin(soft, options->pin);
    if (good && soft->pinned == soft->body.node_count) {
        soft_free(soft);
        return fail(error, ERROR_INPUT, "%s: nothing can move: the whole lattice is below the --pin height", name);
    }
    good = good && count_loose(soft) && tune(soft, options);
    if (good) return true;
    soft_free(soft);
    return fail_no_memory(error, name);
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
    double held = soft->bottom, top = soft->bottom + soft->height;
    for (int i = 0; i < soft->body.node_count; i++) {
        if (soft->body.pinned[i]) held = fmax(held, soft->body.rest[i][1]);
    }
    double omega = soft->modes.count ? 2 * M_PI * soft->modes.frequency[0] : 0;
    double size = shake->amplitude * soft->height * (shake->impulse ? omega : 1);
    for (int i = 0; i < soft->body.node_count; i++) {
        if (soft->body.pinned[i]) continue;
        double above = fmax(0, (soft->body.rest[i][1] - held) / fmax(top - held, 1e-30));
        for (int c = 0; c < 3; c++) {
            double change = size * above * above * shake->direction[c];
            (shake->impulse ? integrator->v : integrator->x)[i][c] += change;
        }
    }
}
