/// Springs under the surface's vertices.
#include "simulation/floor.h"
#include "simulation/vec3.h"
#include <stdlib.h>

/// Each triangle gives a third of its area to its corners.
static void add_areas(const struct surface *surface, double *area)
{
    for (int i = 0; i < surface->index_count; i += 3) {
        double edge[2][3], across[3];
        const uint32_t *corner = surface->indices + i;
        for (int c = 0; c < 3; c++) {
            for (int k = 0; k < 2; k++) {
                edge[k][c] = (double)surface->position[corner[k + 1]][c] - (double)surface->position[corner[0]][c];
            }
        }
        vec3_cross(edge[0], edge[1], across);
        for (int k = 0; k < 3; k++) area[corner[k]] += vec3_length(across) / 6;
    }
}

bool floor_create(struct floor *f, const struct lattice *lattice, const struct surface *surface, double height,
                  double young)
{
    const double stiffer = 10; // than the body's own layer of cells: sinks in by a tenth of what the feet give way
    size_t count = (size_t)surface->vertex_count + 1;
    *f = (struct floor){.lattice = lattice, .height = height};
    f->spring = calloc(count, sizeof *f->spring);
    f->touched = calloc(count, sizeof *f->touched);
    if (!f->spring || !f->touched) {
        floor_free(f);
        return false;
    }
    add_areas(surface, f->spring);
    for (int i = 0; i < surface->vertex_count; i++) f->spring[i] *= stiffer * young / lattice->cell;
    return true;
}

void floor_free(struct floor *f)
{
    free(f->spring);
    free(f->touched);
    *f = (struct floor){0};
}

double floor_push(struct floor *f, double risen, const double (*x)[3], double (*force)[3])
{
    const struct lattice *l = f->lattice;
    double energy = 0;
    for (int i = 0; i < l->vertex_count; i++) {
        f->touched[i] = false;
        if (l->host[i] < 0) continue;
        const int *node = l->tet[l->host[i]];
        double depth = f->height + risen;
        for (int a = 0; a < 4; a++) depth -= l->weight[i][a] * x[node[a]][1];
        f->touched[i] = depth > 0;
        if (!f->touched[i]) continue;
        energy += 0.5 * f->spring[i] * depth * depth;
        for (int a = 0; a < 4; a++) force[node[a]][1] += l->weight[i][a] * f->spring[i] * depth;
    }
    return energy;
}

void floor_stiffness(const struct floor *f, struct body *body)
{
    const struct lattice *l = f->lattice;
    for (int i = 0; i < l->vertex_count; i++) {
        if (!f->touched[i]) continue;
        const int *place = body->place[l->host[i]];
        for (int k = 0; k < 16; k++) {
            if (place[k] < 0) continue;
            body->stiffness.block[place[k]][4] += f->spring[i] * l->weight[i][k / 4] * l->weight[i][k % 4];
        }
    }
}
