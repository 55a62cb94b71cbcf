/// Lanczos on the inverse.
///
/// With the lumped M the problem is symmetric in ψ = M^½ φ: A ψ = ω² ψ, A = M^-½ K M^-½. The largest eigenvalues θ of
/// (A + sI)⁻¹ belong to the lowest frequencies, ω² = 1/θ − s. The small shift s makes the inverse exist for a free body, too. Each
/// Lanczos step solves one system in K + sM by conjugate gradients. Every new vector is made orthogonal to all before it, twice, so
/// that no mode is found again. The small problem is diagonalised by Jacobi's method.
#include "base/need.h"
#include "base/progress.h"
#include "simulation/body.h"
#include "simulation/linear.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { RIGID = 6, GRADIENTS_MAX = 20000 };

struct lanczos {
    struct body *body;
    struct pool pool;
    int node_count, steps, done;
    double shift;
    double (*basis)[3];       ///< (steps + 1) × node_count
    double (*left)[3];        ///< right-hand side
    double *small;            ///< steps × steps: the operator in the basis
    double *values, *vectors; ///< of `small`
};

static void lanczos_create(struct lanczos *l, struct body *body, int steps)
{
    size_t nodes = (size_t)body->node_count, m = (size_t)steps;
    *l = (struct lanczos){.body = body, .node_count = body->node_count, .steps = steps};
    l->basis = pool_take(&l->pool, (m + 1) * nodes, sizeof *l->basis);
    l->left = pool_take(&l->pool, nodes, sizeof *l->left);
    l->small = pool_take(&l->pool, m * m, sizeof *l->small);
    l->values = pool_take(&l->pool, m, sizeof *l->values);
    l->vectors = pool_take(&l->pool, m * m, sizeof *l->vectors);
}

/// The body's matrix becomes K + sM. The shift is a small part of the stiffness.
static void prepare(struct lanczos *l)
{
    struct body *body = l->body;
    struct blocks *k = &body->stiffness;
    body_forces(body, (const double(*)[3])body->rest, l->left);
    body_stiffness(body);
    double stiffness = 0, mass = 0;
    for (int i = 0; i < k->rows; i++) {
        const double *d = k->block[k->diagonal[i]];
        if (body->pinned[i]) continue;
        stiffness += d[0] + d[4] + d[8];
        mass += 3 * body->mass[i];
    }
    l->shift = mass > 0 ? 1e-6 * stiffness / mass : 1;
    for (int i = 0; i < k->rows; i++) {
        for (int d = 0; d < 9; d += 4) k->block[k->diagonal[i]][d] += l->shift * body->mass[i];
    }
}

/// out = M^½ (K + sM)⁻¹ M^½ in
static void apply(struct lanczos *l, const double (*in)[3], double (*out)[3])
{
    const double *mass = l->body->mass;
    for (int i = 0; i < l->node_count; i++) {
        for (int c = 0; c < 3; c++) {
            l->left[i][c] = sqrt(mass[i]) * in[i][c];
            out[i][c] = 0;
        }
    }
    conjugate_solve(&l->body->scratch, &l->body->stiffness, (const double(*)[3])l->left, out, 1e-11, GRADIENTS_MAX);
    for (int i = 0; i < l->node_count; i++) {
        for (int c = 0; c < 3; c++) out[i][c] *= sqrt(mass[i]);
    }
}

static double dot(const double (*a)[3], const double (*b)[3], int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) sum += vec3_dot(a[i], b[i]);
    return sum;
}

/// Makes `v` orthogonal to the first `count` basis vectors, adds the removed parts to parts[], and scales it to length 1.
/// Returns the length before scaling, 0 if nothing is left.
static double orthonormalise(struct lanczos *l, double (*v)[3], int count, double *parts)
{
    const int n = l->node_count;
    double start = sqrt(dot((const double(*)[3])v, (const double(*)[3])v, n));
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < count; k++) {
            double(*b)[3] = l->basis + (size_t)k * (size_t)n;
            double part = dot((const double(*)[3])v, (const double(*)[3])b, n);
            if (parts) parts[k] += part;
            for (int i = 0; i < n; i++) {
                for (int c = 0; c < 3; c++) v[i][c] -= part * b[i][c];
            }
        }
    }
    double length = sqrt(dot((const double(*)[3])v, (const double(*)[3])v, n));
    if (!(length > 1e-10 * start)) return 0;
    for (int i = 0; i < n; i++) {
        for (int c = 0; c < 3; c++) v[i][c] /= length;
    }
    return length;
}

/// A fixed pseudorandom vector, in −½ … ½, that no mode is orthogonal to.
static void fill_start(struct lanczos *l, double (*v)[3], uint64_t seed)
{
    for (int i = 0; i < l->node_count; i++) {
        for (int c = 0; c < 3; c++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            v[i][c] = l->body->pinned[i] ? 0 : (double)(seed >> 40) / (1 << 24) - 0.5;
        }
    }
}

/// Builds the basis and the operator in it. If the space is exhausted (equal eigenvalues), goes on with a new random vector.
static void build(struct lanczos *l)
{
    const size_t n = (size_t)l->node_count;
    const int m = l->steps;
    fill_start(l, l->basis, 1);
    orthonormalise(l, l->basis, 0, NULL);
    for (int k = 0; k < m; k++) {
        double(*next)[3] = l->basis + (size_t)(k + 1) * n;
        double *parts = l->values; // unused until the end
        stage_tell("finding the modes", k, m);
        memset(parts, 0, (size_t)m * sizeof *parts);
        apply(l, (const double(*)[3])(l->basis + (size_t)k * n), next);
        double length = orthonormalise(l, next, k + 1, parts);
        l->done = k + 1;
        l->small[k * m + k] = parts[k];
        if (length == 0) {
            fill_start(l, next, (uint64_t)k + 2);
            if (orthonormalise(l, next, k + 1, NULL) == 0) return; // the space is exhausted
        } else if (k + 1 < m) {
            l->small[k * m + k + 1] = l->small[(k + 1) * m + k] = length;
        }
    }
}

/// φ = M^-½ Σ_k s_k basis_k
static void expand(const struct lanczos *l, const double *small, double (*shape)[3])
{
    for (int k = 0; k < l->done; k++) {
        const double(*b)[3] = (const double(*)[3])(l->basis + (size_t)k * (size_t)l->node_count);
        for (int i = 0; i < l->node_count; i++) {
            for (int c = 0; c < 3; c++) shape[i][c] += small[k] * b[i][c] / sqrt(l->body->mass[i]);
        }
    }
}

/// Modes of the small problem, lowest frequency first. Those near the shift are rigid and are skipped.
static void extract(struct lanczos *l, struct modes *modes, int wanted)
{
    int m = l->done;
    for (int i = 0; i < m; i++) {
        for (int k = 0; k < m; k++) l->small[i * m + k] = l->small[i * l->steps + k];
    }
    eigen_symmetric(m, l->small, l->values, l->vectors);
    for (int i = m - 1; i >= 0 && modes->count < wanted; i--) {
        double squared = 1 / l->values[i] - l->shift;
        if (!(l->values[i] > 0) || squared < 1e-4 * l->shift) continue;
        modes->frequency[modes->count] = sqrt(squared) / (2 * M_PI);
        expand(l, l->vectors + (size_t)i * (size_t)m, modes->shape + (size_t)modes->count * (size_t)l->node_count);
        modes->count++;
    }
}

void modes_create(struct modes *modes, struct body *body, int count)
{
    int movable = 0;
    for (int i = 0; i < body->node_count; i++) movable += 3 * !body->pinned[i];
    int steps = 2 * (count + RIGID) + 24; // the test against a dense solver shows that all converge
    if (steps > movable) steps = movable;
    *modes = (struct modes){0};
    modes->frequency = need_zeroed((size_t)count + 1, sizeof *modes->frequency);
    modes->shape = need_zeroed((size_t)(count + 1) * (size_t)body->node_count, sizeof *modes->shape);
    if (steps == 0) return;
    struct lanczos lanczos;
    lanczos_create(&lanczos, body, steps);
    prepare(&lanczos);
    build(&lanczos);
    stage_tell("finding the modes", steps, steps);
    extract(&lanczos, modes, count);
    pool_free(&lanczos.pool);
}

void modes_free(struct modes *modes)
{
    free(modes->frequency);
    free(modes->shape);
    *modes = (struct modes){0};
}
