#include "simulation/midpoint.h"
#include "simulation/vec3.h"
#include <stdlib.h>
#include <string.h>

enum { NEWTON_MAX = 200, HALVINGS_MAX = 40, GRADIENTS_MAX = 2000 };

// A looser one makes more Newton iterations, each of which assembles anew; a tighter one saves none.
static const double linear_tolerance = 1e-3;

struct midpoint_work {
    double (*y)[3];         ///< the unknown
    double (*trial)[3];     ///< y and a part of the Newton step
    double (*force)[3];     ///< f(y)
    double (*downhill)[3];  ///< minus the gradient of the potential
    double (*direction)[3]; ///< the Newton step
    double (*drag)[3];      ///< K(x₀)(y − x₀)
    struct blocks lagged;   ///< K(x₀): the pattern is the body's, the blocks are its own
};

bool midpoint_create(struct midpoint *midpoint, struct body *body, double step)
{
    size_t n = (size_t)body->node_count;
    *midpoint = (struct midpoint){.body = body, .step = step, .tolerance = 1e-9};
    midpoint->x = calloc(n, sizeof *midpoint->x);
    midpoint->v = calloc(n, sizeof *midpoint->v);
    struct midpoint_work *w = midpoint->work = calloc(1, sizeof *w);
    bool good = midpoint->x && midpoint->v && w;
    if (good) {
        double(**vectors[])[3] = {&w->y, &w->trial, &w->force, &w->downhill, &w->direction, &w->drag};
        for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
            *vectors[i] = calloc(n, sizeof **vectors[i]);
            good = good && *vectors[i];
        }
        w->lagged = body->stiffness;
        w->lagged.block = calloc((size_t)body->stiffness.start[n] + 1, sizeof *w->lagged.block);
        good = good && w->lagged.block;
    }
    if (good) memcpy(midpoint->x, body->rest, n * sizeof *midpoint->x);
    if (!good) midpoint_free(midpoint);
    return good;
}

void midpoint_free(struct midpoint *midpoint)
{
    struct midpoint_work *w = midpoint->work;
    if (w) {
        free(w->y);
        free(w->trial);
        free(w->force);
        free(w->downhill);
        free(w->direction);
        free(w->drag);
        free(w->lagged.block);
    }
    free(w);
    free(midpoint->x);
    free(midpoint->v);
    *midpoint = (struct midpoint){0};
}

/// The potential at y, whose gradient's negative goes to work->downhill:
/// 2/h² |y − x₀ − h/2 v₀|²_M + α/h |y − x₀|²_M + β/h (y − x₀)ᵀ K₀ (y − x₀) + Ψ(y)
static double evaluate(struct midpoint *m, const double (*y)[3])
{
    struct midpoint_work *w = m->work;
    const double h = m->step, *mass = m->body->mass;
    double energy = body_forces(m->body, y, w->force);
    if (m->beta > 0) {
        for (int i = 0; i < m->body->node_count; i++) {
            for (int c = 0; c < 3; c++) w->trial[i][c] = y[i][c] - m->x[i][c];
        }
        blocks_multiply(&w->lagged, (const double(*)[3])w->trial, w->drag);
    }
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3; c++) {
            w->downhill[i][c] = 0;
            if (m->body->pinned[i]) continue;
            double moved = y[i][c] - m->x[i][c], ahead = moved - h / 2 * m->v[i][c];
            double drag = m->beta > 0 ? m->beta * w->drag[i][c] : 0;
            energy += mass[i] * (2 / (h * h) * ahead * ahead + m->alpha / h * moved * moved) + drag * moved / h;
            w->downhill[i][c] =
                w->force[i][c] - mass[i] * (4 / (h * h) * ahead + 2 * m->alpha / h * moved) - 2 / h * drag;
        }
    }
    return energy;
}

/// K₀ = K(x₀)
static void lag_stiffness(struct midpoint *m)
{
    struct midpoint_work *w = m->work;
    body_forces(m->body, (const double(*)[3])m->x, w->force);
    body_stiffness(m->body);
    memcpy(w->lagged.block, m->body->stiffness.block,
           (size_t)w->lagged.start[w->lagged.rows] * sizeof *w->lagged.block);
}

/// 4/h² M + 2/h C + K(y), where the potential was last evaluated, into the body's matrix.
static void assemble(struct midpoint *m)
{
    struct blocks *a = &m->body->stiffness;
    const double h = m->step, factor = 2 * m->beta / h;
    body_stiffness(m->body);
    int count = a->start[a->rows];
    for (int k = 0; factor > 0 && k < count; k++) {
        for (int i = 0; i < 9; i++) a->block[k][i] += factor * m->work->lagged.block[k][i];
    }
    for (int i = 0; i < a->rows; i++) {
        double inertia = m->body->mass[i] * (4 / (h * h) + 2 * m->alpha / h);
        for (int d = 0; d < 9; d += 4) a->block[a->diagonal[i]][d] += inertia;
    }
}

/// Goes from y along the Newton step as far as the potential falls enough (Armijo). Returns the largest move of a node;
/// NaN where there is no way down.
static double search(struct midpoint *m, double *energy)
{
    struct midpoint_work *w = m->work;
    const int n = 3 * m->body->node_count;
    double slope = 0, largest = 0, *y = *w->y, *direction = *w->direction, before = *energy;
    for (int i = 0; i < n; i++) slope += direction[i] * (*w->downhill)[i];
    for (int i = 0; i < m->body->node_count; i++) largest = fmax(largest, vec3_length(w->direction[i]));
    double part = 1, taken = 0, rounding = 1e-13 * fabs(before);
    for (int halving = 0; halving < HALVINGS_MAX; halving++, part /= 2) {
        for (int i = 0; i < n; i++) y[i] += (part - taken) * direction[i];
        taken = part;
        *energy = evaluate(m, (const double(*)[3])w->y);
        if (*energy <= before - 1e-4 * part * slope + rounding) return part * largest;
    }
    return NAN;
}

/// Finds the y at which the potential is least.
static bool minimise(struct midpoint *m)
{
    struct midpoint_work *w = m->work;
    const size_t bytes = (size_t)m->body->node_count * sizeof *w->direction;
    double energy = evaluate(m, (const double(*)[3])w->y);
    for (int iteration = 0; iteration < NEWTON_MAX; iteration++) {
        assemble(m);
        memset(w->direction, 0, bytes);
        m->gradients += conjugate_solve(&m->body->scratch, &m->body->stiffness, (const double(*)[3])w->downhill,
                                        w->direction, linear_tolerance, GRADIENTS_MAX);
        m->newton++;
        double moved = search(m, &energy);
        if (!isfinite(moved)) return false;
        if (moved <= m->tolerance) return true;
    }
    return false;
}

bool midpoint_step(struct midpoint *m)
{
    struct midpoint_work *w = m->work;
    const int n = m->body->node_count;
    const double h = m->step;
    if (m->beta > 0) lag_stiffness(m);
    for (int i = 0; i < n; i++) {
        for (int c = 0; c < 3; c++) w->y[i][c] = m->x[i][c] + (m->body->pinned[i] ? 0 : h / 2 * m->v[i][c]);
    }
    if (!minimise(m)) return false;
    for (int i = 0; i < n; i++) {
        for (int c = 0; c < 3 && !m->body->pinned[i]; c++) {
            double moved = w->y[i][c] - m->x[i][c];
            m->v[i][c] = 4 / h * moved - m->v[i][c];
            m->x[i][c] += 2 * moved;
        }
    }
    return true;
}
