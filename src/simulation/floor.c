/// Springs under the surface's vertices.
#include "simulation/floor.h"
#include "simulation/linear.h"
#include <math.h>
#include <string.h>

/// A vertex gets a third of the area of each of its triangles.
static void add_areas(const struct surface *surface, double *area)
{
    double normal[3], middle[3];
    for (int i = 0; i < surface->index_count; i++) {
        triangle_measure(surface, i / 3, normal, middle);
        area[surface->indices[i]] += vec3_length(normal) / 6;
    }
}

void floor_create(struct floor *f, const struct lattice *lattice, const struct surface *surface, double height,
                  double young, double density)
{
    const double stiffer = 10; // than a layer of cells: the floor gives way a tenth as much as the feet
    size_t count = (size_t)surface->vertex_count + 1;
    *f = (struct floor){.lattice = lattice, .height = height};
    f->spring = pool_take(&f->pool, count, sizeof *f->spring);
    f->damper = pool_take(&f->pool, count, sizeof *f->damper);
    f->origin = pool_take(&f->pool, count, sizeof *f->origin);
    f->touched = pool_take(&f->pool, count, sizeof *f->touched);
    f->damped = pool_take(&f->pool, count, sizeof *f->damped);
    f->pushed = pool_take(&f->pool, count, sizeof *f->pushed);
    add_areas(surface, f->spring);
    for (int i = 0; i < surface->vertex_count; i++) {
        f->damper[i] = f->spring[i] * sqrt(young * density);
        f->spring[i] *= stiffer * young / lattice->cell;
    }
}

void floor_free(struct floor *f)
{
    pool_free(&f->pool);
    *f = (struct floor){0};
}

static double depth_of(const struct floor *f, int vertex, double risen, const double (*x)[3])
{
    const struct lattice *l = f->lattice;
    const int *node = l->tet[l->host[vertex]];
    double depth = f->height + risen;
    for (int a = 0; a < 4; a++) depth -= l->weight[vertex][a] * x[node[a]][1];
    return depth;
}

void floor_start(struct floor *f)
{
    memcpy(f->damped, f->touched, (size_t)f->lattice->vertex_count * sizeof *f->damped);
}

void floor_aim(struct floor *f, double rate, const double (*q)[3], double risen, double speed)
{
    f->rate = rate;
    for (int i = 0; i < f->lattice->vertex_count; i++) {
        if (f->damped[i]) f->origin[i] = depth_of(f, i, risen, q) - speed / rate;
    }
}

double floor_push(struct floor *f, double risen, const double (*x)[3], double (*force)[3])
{
    const struct lattice *l = f->lattice;
    double energy = 0;
    f->drag = 0;
    for (int i = 0; i < l->vertex_count; i++) {
        f->touched[i] = f->pushed[i] = false;
        if (l->host[i] < 0 || !(f->spring[i] > 0)) continue;
        const int *node = l->tet[l->host[i]];
        const double depth = depth_of(f, i, risen, x), below = fmax(depth, 0);
        const double drag = f->damped[i] ? f->damper[i] * f->rate : 0, sunk = depth - f->origin[i];
        const double push = f->spring[i] * below + drag * sunk, spring = 0.5 * f->spring[i] * below * below;
        f->touched[i] = depth > 0;
        f->pushed[i] = push > 0;
        energy += spring;
        // Where the damper would pull, the potential stays at its minimum.
        const double origin = fmax(f->origin[i], 0), both = drag * f->spring[i] / (drag + f->spring[i]);
        f->drag += push > 0 ? 0.5 * drag * sunk * sunk : 0.5 * both * origin * origin - spring;
        for (int a = 0; push > 0 && a < 4; a++) force[node[a]][1] += l->weight[i][a] * push;
    }
    return energy;
}

void floor_stiffness(const struct floor *f, struct body *body)
{
    const struct lattice *l = f->lattice;
    for (int i = 0; i < l->vertex_count; i++) {
        if (!f->pushed[i]) continue;
        const int *place = body->place[l->host[i]];
        const double stiffness = (f->touched[i] ? f->spring[i] : 0) + (f->damped[i] ? f->damper[i] * f->rate : 0);
        for (int k = 0; k < 16; k++) {
            if (place[k] < 0) continue;
            body->stiffness.block[place[k]][4] += stiffness * l->weight[i][k / 4] * l->weight[i][k % 4];
        }
    }
}
