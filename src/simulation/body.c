/// Sums energy, forces and stiffness over the elements.
#include "simulation/body.h"
#include "simulation/linear.h"
#include <string.h>

static void allocate(struct body *body)
{
    size_t nodes = (size_t)body->node_count, elements = (size_t)body->element_count;
    body->rest = pool_take(&body->pool, nodes + 1, sizeof *body->rest);
    body->mass = pool_take(&body->pool, nodes + 1, sizeof *body->mass);
    body->pinned = pool_take(&body->pool, nodes + 1, sizeof *body->pinned);
    body->elements = pool_take(&body->pool, elements + 1, sizeof *body->elements);
    body->svd = pool_take(&body->pool, elements + 1, sizeof *body->svd);
    body->place = pool_take(&body->pool, elements + 1, sizeof *body->place);
    conjugate_create(&body->scratch, body->node_count, &body->pool);
}

bool body_create(struct body *body, const double (*rest)[3], int node_count, const int (*tets)[4],
                 const double *fraction, int element_count, struct material material, double density)
{
    *body = (struct body){.node_count = node_count, .element_count = element_count, .material = material};
    bool good = true;
    allocate(body);
    memcpy(body->rest, rest, (size_t)node_count * sizeof *rest);
    for (int e = 0; good && e < element_count; e++) {
        struct element *element = &body->elements[e];
        good = element_init(element, tets[e], rest, fraction ? fraction[e] : 1);
        for (int a = 0; good && a < 4; a++) body->mass[tets[e][a]] += density * element->volume / 4;
    }
    if (good)
        blocks_create(&body->stiffness, node_count, body->elements, element_count, &body->pool);
    else
        body_free(body);
    return good;
}

void body_free(struct body *body)
{
    pool_free(&body->pool);
    *body = (struct body){0};
}

void body_ready(struct body *body)
{
    for (int e = 0; e < body->element_count; e++) {
        const int *node = body->elements[e].node;
        for (int k = 0; k < 16; k++) {
            int row = node[k / 4], column = node[k % 4];
            bool fixed = body->pinned[row] || body->pinned[column];
            body->place[e][k] = fixed ? -1 : blocks_find(&body->stiffness, row, column);
        }
    }
}

double body_forces(struct body *body, const double (*x)[3], double (*force)[3])
{
    double energy = 0;
    memset(force, 0, (size_t)body->node_count * sizeof *force);
    for (int e = 0; e < body->element_count; e++) {
        element_decompose(&body->elements[e], x, &body->svd[e]);
        energy += element_force(&body->elements[e], &body->material, &body->svd[e], force);
    }
    for (int i = 0; i < body->node_count; i++) {
        if (body->pinned[i]) memset(force[i], 0, sizeof force[i]);
    }
    return energy;
}

void body_stiffness(struct body *body)
{
    struct blocks *k = &body->stiffness;
    memset(k->block, 0, (size_t)k->start[k->rows] * sizeof *k->block);
    double block[4][4][9];
    for (int e = 0; e < body->element_count; e++) {
        element_stiffness(&body->elements[e], &body->material, &body->svd[e], block);
        for (int n = 0; n < 16; n++) {
            if (body->place[e][n] < 0) continue;
            double *target = k->block[body->place[e][n]];
            for (int i = 0; i < 9; i++) target[i] += block[n / 4][n % 4][i];
        }
    }
    for (int i = 0; i < body->node_count; i++) {
        double *target = k->block[k->diagonal[i]];
        for (int d = 0; body->pinned[i] && d < 9; d += 4) target[d] = 1;
    }
}

double body_kinetic(const struct body *body, const double (*v)[3])
{
    double sum = 0;
    for (int i = 0; i < body->node_count; i++) sum += body->mass[i] * vec3_dot(v[i], v[i]);
    return sum / 2;
}
