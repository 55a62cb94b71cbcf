/// Numerics of an elastic body, from the singular values of one 3×3 matrix to the normal modes of the whole.
#include "simulation/body.h"
#include "base/need.h"
#include "base/progress.h"
#include "maths/maths.h"
#include "maths/symmetric.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// --- singular values

// One-sided Jacobi (Hestenes): rotations from the right make the columns of A = F V orthogonal; their lengths are the
// singular values, the columns themselves σ_k u_k. It works on F and not on FᵀF, so small singular values keep their
// digits. The remaining signs follow from u₂ = u₀ × u₁ and σ₂ = u₂ · a₂.
enum { SVD_SWEEPS_MAX = 16 }; // three or four are enough in practice

/// The pairs of axes.
static const int axis_pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};

/// Columns p and q become c·p − s·q and s·p + c·q.
static void rotate_columns(double column[3][3], int p, int q, double c, double s)
{
    for (int i = 0; i < 3; i++) {
        double x = column[p][i], y = column[q][i];
        column[p][i] = c * x - s * y;
        column[q][i] = s * x + c * y;
    }
}

/// Makes columns p and q of A orthogonal; false where they are already.
static bool orthogonalise(double a[3][3], double v[3][3], int p, int q)
{
    double pp = vec3_dot(a[p], a[p]), qq = vec3_dot(a[q], a[q]), pq = vec3_dot(a[p], a[q]);
    if (fabs(pq) <= DBL_EPSILON * sqrt(pp) * sqrt(qq)) return false;
    double zeta = (qq - pp) / (2 * pq);
    double t = copysign(1, zeta) / (fabs(zeta) + sqrt(1 + zeta * zeta)); // the smaller angle
    double c = 1 / sqrt(1 + t * t);
    rotate_columns(a, p, q, c, c * t);
    rotate_columns(v, p, q, c, c * t);
    return true;
}

void svd3(const double f[3][3], struct svd *svd)
{
    double column[3][3], u[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 9; i++) column[i % 3][i / 3] = f[i / 3][i % 3];
    bool moved = true;
    for (int sweep = 0; moved && sweep < SVD_SWEEPS_MAX; sweep++) {
        moved = false;
        for (int k = 0; k < 3; k++) moved |= orthogonalise(column, v, axis_pairs[k][0], axis_pairs[k][1]);
    }
    for (int k = 0; k < 3; k++) { // in order, by quarter turns, so that V stays a rotation
        const int p = axis_pairs[k][0], q = axis_pairs[k][1];
        if (vec3_dot(column[p], column[p]) >= vec3_dot(column[q], column[q])) continue;
        rotate_columns(column, p, q, 0, -1);
        rotate_columns(v, p, q, 0, -1);
    }
    svd->sigma[0] = vec3_length(column[0]);
    for (int i = 0; i < 3; i++) u[0][i] = svd->sigma[0] > 0 ? column[0][i] / svd->sigma[0] : i == 0;

    // u₁ is along a₁ minus its part along u₀; if that is zero, any unit vector orthogonal to u₀.
    double along = vec3_dot(u[0], column[1]);
    for (int i = 0; i < 3; i++) u[1][i] = column[1][i] - along * u[0][i];
    double length = vec3_length(u[1]);
    if (length <= DBL_EPSILON * svd->sigma[0]) {
        int axis = fabs(u[0][0]) < 0.6 ? 0 : 1; // far from parallel to u₀
        double other[3] = {0};
        other[axis] = 1;
        vec3_cross(u[0], other, u[1]);
        length = vec3_length(u[1]);
    }
    for (int i = 0; i < 3; i++) u[1][i] /= length;

    vec3_cross(u[0], u[1], u[2]);
    svd->sigma[1] = vec3_dot(u[1], column[1]);
    svd->sigma[2] = vec3_dot(u[2], column[2]);
    for (int i = 0; i < 9; i++) svd->u[i / 3][i % 3] = u[i % 3][i / 3], svd->v[i / 3][i % 3] = v[i % 3][i / 3];
}

// --- one tetrahedron

struct material material_from(double young, double poisson)
{
    return (struct material){.mu = young / (2 * (1 + poisson)),
                             .lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

/// L(σ). log1p keeps all digits of σ − 1 near rest.
static double logarithm(double sigma)
{
    return sigma >= MATERIAL_CLAMP ? log1p(sigma - 1) : log(MATERIAL_CLAMP) + sigma / MATERIAL_CLAMP - 1;
}

/// L'(σ)
static double slope(double sigma) { return 1 / fmax(sigma, MATERIAL_CLAMP); }

static double log_volume(const double sigma[3])
{
    return logarithm(sigma[0]) + logarithm(sigma[1]) + logarithm(sigma[2]);
}

double material_energy(const struct material *material, const double sigma[3])
{
    double shear = 0, volume = log_volume(sigma);
    for (int i = 0; i < 3; i++) { // ½(σ² − 1) − L(σ) with σ = 1 + e: less cancellation near rest
        double e = sigma[i] - 1;
        shear += e + 0.5 * e * e - logarithm(sigma[i]);
    }
    return material->mu * shear + 0.5 * material->lambda * volume * volume;
}

void material_stress(const struct material *material, const double sigma[3], double stress[3])
{
    double pressure = material->lambda * log_volume(sigma) - material->mu;
    for (int i = 0; i < 3; i++) stress[i] = material->mu * sigma[i] + pressure * slope(sigma[i]);
}

/// ∂P/∂F in principal axes, made positive semidefinite block by block (Teran, Sifakis, Irving, Fedkiw 2005): `stretch`
/// acts on the three diagonal entries; on each pair of entries (i, j) and (j, i) `straight` on the entry itself and
/// `across` on its mirror image. Pairs in the order 01, 02, 12. Pa.
struct principal_stiffness {
    double stretch[3][3];
    double straight[3], across[3];
};

static void material_stiffness(const struct material *material, const double sigma[3],
                               struct principal_stiffness *stiffness)
{
    double stress[3], pressure = material->lambda * log_volume(sigma) - material->mu;
    material_stress(material, sigma, stress);
    double(*stretch)[3] = stiffness->stretch;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) stretch[i][j] = material->lambda * slope(sigma[i]) * slope(sigma[j]);
        const double curvature = sigma[i] >= MATERIAL_CLAMP ? -1 / (sigma[i] * sigma[i]) : 0; // L''(σ)
        stretch[i][i] += material->mu + pressure * curvature;
    }
    for (int k = 0; k < 3; k++) {
        int i = axis_pairs[k][0], j = axis_pairs[k][1];
        double difference = sigma[i] - sigma[j], sum = sigma[i] + sigma[j]; // both ≥ 0 in this order
        // Two eigenvalues: (Pᵢ − Pⱼ)/(σᵢ − σⱼ) of the symmetric shear, (Pᵢ + Pⱼ)/(σᵢ + σⱼ) of the rotation.
        double shear = difference > 1e-6 ? (stress[i] - stress[j]) / difference
                                         : 0.5 * (stretch[i][i] + stretch[j][j]) - stretch[i][j];
        double turn = (stress[i] + stress[j]) / fmax(sum, 1e-6);
        shear = fmax(shear, 0);
        turn = fmax(turn, 0);
        stiffness->straight[k] = 0.5 * (shear + turn);
        stiffness->across[k] = 0.5 * (shear - turn);
    }

    double minor = stretch[0][0] * stretch[1][1] - stretch[0][1] * stretch[0][1];
    double determinant = stretch[2][2] * minor - stretch[0][0] * stretch[1][2] * stretch[1][2] -
                         stretch[1][1] * stretch[0][2] * stretch[0][2] +
                         2 * stretch[0][1] * stretch[0][2] * stretch[1][2];
    if (stretch[0][0] > 0 && minor > 0 && determinant > 0) return; // Sylvester: already definite
    double vectors[9], values[3];                                  // else without its negative eigenvalues
    symmetric_eigen(3, &stretch[0][0], values, vectors);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            stretch[i][j] = 0;
            for (int k = 0; k < 3; k++) stretch[i][j] += fmax(values[k], 0) * vectors[3 * k + i] * vectors[3 * k + j];
        }
    }
}

bool element_init(struct element *element, const int node[4], const double (*rest)[3], double fraction)
{
    memcpy(element->node, node, sizeof element->node);
    double edge[3][3];
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) edge[k][i] = rest[node[k + 1]][i] - rest[node[0]][i];
    }
    double(*b)[3] = element->gradient;
    for (int k = 0; k < 3; k++) vec3_cross(edge[(k + 1) % 3], edge[(k + 2) % 3], b[k + 1]);
    double six_volumes = vec3_dot(edge[0], b[1]);
    double size = vec3_length(edge[0]) * vec3_length(edge[1]) * vec3_length(edge[2]);
    if (!(fabs(six_volumes) > 1e-12 * size)) return false;
    for (int i = 0; i < 3; i++) {
        for (int k = 1; k < 4; k++) b[k][i] /= six_volumes;
        b[0][i] = -(b[1][i] + b[2][i] + b[3][i]);
    }
    element->volume = fraction * fabs(six_volumes) / 6;
    element->stiffness = 1;
    return true;
}

/// Vᵀ b_a: the gradients in the principal axes of the material.
static void principal_gradients(const struct element *element, const struct svd *svd, double g[4][3])
{
    for (int a = 0; a < 4; a++) {
        for (int k = 0; k < 3; k++) {
            g[a][k] = svd->v[0][k] * element->gradient[a][0] + svd->v[1][k] * element->gradient[a][1] +
                      svd->v[2][k] * element->gradient[a][2];
        }
    }
}

/// The 3×3 blocks −∂f_a/∂x_b (N/m), made semidefinite; block[a][b] row by row.
static void element_stiffness(const struct element *element, const struct material *material, const struct svd *svd,
                              double block[4][4][9])
{
    struct principal_stiffness stiffness = {0};
    const double factor = element->volume * element->stiffness;
    double g[4][3], principal[3][3], turned[3][3];
    material_stiffness(material, svd->sigma, &stiffness);
    principal_gradients(element, svd, g);
    for (int a = 0; a < 4; a++) {
        for (int b = a; b < 4; b++) {
            // Entry (i, k) is Σ_jl (∂P_ij/∂F_kl) p_j q_l in principal axes; all other entries of ∂P/∂F are zero.
            const double *p = g[a], *q = g[b];
            for (int i = 0; i < 9; i++)
                principal[i / 3][i % 3] = stiffness.stretch[i / 3][i % 3] * p[i / 3] * q[i % 3];
            for (int n = 0; n < 3; n++) {
                const int i = axis_pairs[n][0], j = axis_pairs[n][1];
                principal[i][i] += stiffness.straight[n] * p[j] * q[j];
                principal[j][j] += stiffness.straight[n] * p[i] * q[i];
                principal[i][j] += stiffness.across[n] * p[j] * q[i];
                principal[j][i] += stiffness.across[n] * p[i] * q[j];
            }

            for (int i = 0; i < 9; i++) { // block = factor · U m Uᵀ
                const double *m = principal[i / 3], *u = svd->u[i % 3];
                turned[i / 3][i % 3] = factor * (m[0] * u[0] + m[1] * u[1] + m[2] * u[2]);
            }
            for (int i = 0; i < 9; i++) {
                const double *u = svd->u[i / 3];
                block[a][b][i] = u[0] * turned[0][i % 3] + u[1] * turned[1][i % 3] + u[2] * turned[2][i % 3];
            }
            for (int i = 0; b > a && i < 9; i++) block[b][a][i] = block[a][b][3 * (i % 3) + i / 3];
        }
    }
}

// --- sparse matrices

static int compare_pairs(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

void blocks_multiply(const struct blocks *blocks, const double (*x)[3], double (*y)[3])
{
    for (int i = 0; i < blocks->rows; i++) {
        double sum[3] = {0};
        for (int k = blocks->start[i]; k < blocks->start[i + 1]; k++) {
            const double *a = blocks->block[k], *v = x[blocks->column[k]];
            sum[0] += a[0] * v[0] + a[1] * v[1] + a[2] * v[2];
            sum[1] += a[3] * v[0] + a[4] * v[1] + a[5] * v[2];
            sum[2] += a[6] * v[0] + a[7] * v[1] + a[8] * v[2];
        }
        for (int c = 0; c < 3; c++) y[i][c] = sum[c];
    }
}

/// z = D⁻¹ r; returns r · z.
static double precondition(const struct conjugate *c, int rows, const double (*r)[3], double (*z)[3])
{
    double dot = 0;
    for (int i = 0; i < rows; i++) {
        const double *d = c->inverse[i], *v = r[i];
        for (int k = 0; k < 3; k++) {
            z[i][k] = d[3 * k] * v[0] + d[3 * k + 1] * v[1] + d[3 * k + 2] * v[2];
            dot += z[i][k] * v[k];
        }
    }
    return dot;
}

int conjugate_solve(struct conjugate *c, const struct blocks *a, const double (*b)[3], double (*x)[3],
                    double tolerance, int limit)
{
    const int rows = a->rows, n = 3 * rows;
    double *r = *c->r, *z = *c->z, *p = *c->p, *q = *c->q, *unknown = *x;
    const double *right = *b;
    for (int i = 0; i < rows; i++) { // inverse of a symmetric definite 3×3 block by cofactors
        const double *d = a->block[a->diagonal[i]];
        double *out = c->inverse[i];
        double c0 = d[4] * d[8] - d[5] * d[7], c1 = d[5] * d[6] - d[3] * d[8], c2 = d[3] * d[7] - d[4] * d[6];
        double scale = 1 / (d[0] * c0 + d[1] * c1 + d[2] * c2);
        out[0] = c0 * scale;
        out[1] = out[3] = c1 * scale;
        out[2] = out[6] = c2 * scale;
        out[4] = (d[0] * d[8] - d[2] * d[6]) * scale;
        out[5] = out[7] = (d[1] * d[6] - d[0] * d[7]) * scale;
        out[8] = (d[0] * d[4] - d[1] * d[3]) * scale;
    }
    double goal = tolerance * tolerance * precondition(c, rows, b, c->z);
    blocks_multiply(a, (const double(*)[3])x, c->q);
    for (int i = 0; i < n; i++) r[i] = right[i] - q[i];
    double rz = precondition(c, rows, (const double(*)[3])c->r, c->z);
    memcpy(p, z, (size_t)n * sizeof *p);
    int iteration = 0;
    for (; iteration < limit && rz > goal; iteration++) {
        blocks_multiply(a, (const double(*)[3])c->p, c->q);
        double curvature = 0;
        for (int i = 0; i < n; i++) curvature += p[i] * q[i];
        double alpha = rz / curvature;
        for (int i = 0; i < n; i++) {
            unknown[i] += alpha * p[i];
            r[i] -= alpha * q[i];
        }
        double next = precondition(c, rows, (const double(*)[3])c->r, c->z);
        double beta = next / rz;
        rz = next;
        for (int i = 0; i < n; i++) p[i] = z[i] + beta * p[i];
    }
    return iteration;
}

// --- the body

bool body_create(struct body *body, const struct body_mesh *mesh, struct material material, double density)
{
    *body = (struct body){.node_count = mesh->node_count, .element_count = mesh->element_count, .material = material};
    size_t nodes = (size_t)mesh->node_count, elements = (size_t)mesh->element_count;
    bool good = true;
    body->rest = pool_take(&body->pool, nodes + 1, sizeof *body->rest);
    body->mass = pool_take(&body->pool, nodes + 1, sizeof *body->mass);
    body->pinned = pool_take(&body->pool, nodes + 1, sizeof *body->pinned);
    body->elements = pool_take(&body->pool, elements + 1, sizeof *body->elements);
    body->svd = pool_take(&body->pool, elements + 1, sizeof *body->svd);
    body->place = pool_take(&body->pool, elements + 1, sizeof *body->place);
    struct conjugate *scratch = &body->scratch;
    scratch->r = pool_take(&body->pool, nodes, sizeof *scratch->r);
    scratch->z = pool_take(&body->pool, nodes, sizeof *scratch->z);
    scratch->p = pool_take(&body->pool, nodes, sizeof *scratch->p);
    scratch->q = pool_take(&body->pool, nodes, sizeof *scratch->q);
    scratch->inverse = pool_take(&body->pool, nodes, sizeof *scratch->inverse);
    memcpy(body->rest, mesh->rest, nodes * sizeof *mesh->rest);
    for (int e = 0; good && e < mesh->element_count; e++) {
        struct element *element = &body->elements[e];
        good = element_init(element, mesh->tets[e], mesh->rest, mesh->fraction ? mesh->fraction[e] : 1);
        for (int a = 0; good && a < 4; a++) body->mass[mesh->tets[e][a]] += density * element->volume / 4;
    }
    if (!good) {
        pool_free(&body->pool);
        return false;
    }
    return true;
}

void body_ready(struct body *body)
{
    int kept = 0;
    for (int e = 0; e < body->element_count; e++) { // one whose nodes are all pinned never does anything
        const int *node = body->elements[e].node;
        if (!body->pinned[node[0]] || !body->pinned[node[1]] || !body->pinned[node[2]] || !body->pinned[node[3]])
            body->elements[kept++] = body->elements[e];
    }
    body->element_count = kept;

    // The matrix has a block for each node, and for each pair of free nodes that share an element: the pairs (row, column), sorted, each once.
    struct blocks *blocks = &body->stiffness;
    const size_t nodes = (size_t)body->node_count;
    uint64_t *pairs = need(nodes + (size_t)kept * 16, sizeof *pairs);
    size_t all = 0, known = 0;
    for (uint64_t i = 0; i < nodes; i++) pairs[all++] = i << 32 | i;
    for (int n = 0; n < 16 * kept; n++) {
        const int *node = body->elements[n / 16].node, row = node[n / 4 % 4], column = node[n % 4];
        if (!body->pinned[row] && !body->pinned[column]) pairs[all++] = (uint64_t)row << 32 | (uint32_t)column;
    }
    qsort(pairs, all, sizeof *pairs, compare_pairs);
    for (size_t i = 0; i < all; i++) {
        if (i == 0 || pairs[i] != pairs[i - 1]) pairs[known++] = pairs[i];
    }
    blocks->rows = body->node_count;
    blocks->start = pool_take(&body->pool, nodes + 1, sizeof *blocks->start);
    blocks->column = pool_take(&body->pool, known + 1, sizeof *blocks->column);
    blocks->block = pool_take(&body->pool, known + 1, sizeof *blocks->block);
    blocks->diagonal = pool_take(&body->pool, nodes, sizeof *blocks->diagonal);
    for (size_t i = 0; i < known; i++) {
        const int row = (int)(pairs[i] >> 32), column = (int)(uint32_t)pairs[i];
        blocks->start[row + 1] = (int)i + 1;
        blocks->column[i] = column;
        if (row == column) blocks->diagonal[row] = (int)i;
    }
    for (int n = 0; n < 16 * kept; n++) { // where each element's pairs are
        const int *node = body->elements[n / 16].node, row = node[n / 4 % 4], column = node[n % 4];
        const uint64_t pair = (uint64_t)row << 32 | (uint32_t)column, *found = NULL;
        if (!body->pinned[row] && !body->pinned[column])
            found = bsearch(&pair, pairs, known, sizeof *pairs, compare_pairs);
        body->place[n / 16][n % 16] = found ? (int)(found - pairs) : -1;
    }
    free(pairs);
}

double body_forces(struct body *body, const double (*x)[3], double (*force)[3])
{
    double energy = 0;
    memset(force, 0, (size_t)body->node_count * sizeof *force);
    for (int e = 0; e < body->element_count; e++) {
        const struct element *element = &body->elements[e];
        double f[3][3] = {{0}};
        for (int a = 0; a < 4; a++) {
            for (int i = 0; i < 9; i++) f[i / 3][i % 3] += x[element->node[a]][i / 3] * element->gradient[a][i % 3];
        }
        svd3(f, &body->svd[e]);

        // −∂Ψ/∂x of its four nodes, N.
        const struct svd *svd = &body->svd[e];
        const double factor = element->volume * element->stiffness;
        double g[4][3], stress[3];
        principal_gradients(element, svd, g);
        material_stress(&body->material, svd->sigma, stress);
        for (int n = 0; n < 12; n++) {
            double pb = 0;
            for (int k = 0; k < 3; k++) pb += svd->u[n % 3][k] * stress[k] * g[n / 3][k];
            force[element->node[n / 3]][n % 3] -= factor * pb;
        }
        energy += factor * material_energy(&body->material, svd->sigma);
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

// --- normal modes by Lanczos on the inverse
//
// With the lumped M the problem is symmetric in ψ = M^½ φ: A ψ = ω² ψ, A = M^-½ K M^-½. The largest eigenvalues θ of
// (A + sI)⁻¹ belong to the lowest frequencies, ω² = 1/θ − s. The small shift s makes the inverse exist for a free body, too. Each
// Lanczos step solves one system in K + sM by conjugate gradients. Every new vector is made orthogonal to all before it, twice, so
// that no mode is found again. The small problem is diagonalised by Jacobi's method.

enum { RIGID = 6, GRADIENTS_MAX = 20000 };

struct lanczos {
    struct body *body;
    struct pool pool;
    int size, steps, done; ///< size: numbers of a vector, three a node
    double shift;
    double *basis;            ///< (steps + 1) × size
    double *left;             ///< right-hand side
    double *small;            ///< steps × steps: the operator in the basis
    double *values, *vectors; ///< of `small`
};

/// Makes `v` orthogonal to the first `count` basis vectors, adds the removed parts to parts[], and scales it to length 1.
/// Returns the length before scaling, 0 if nothing is left.
static double orthonormalise(struct lanczos *l, double *v, int count, double *parts)
{
    const int n = l->size;
    const double start = sqrt(maths_dot(v, v, n));
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < count; k++) {
            const double *b = l->basis + (size_t)k * (size_t)n, part = maths_dot(v, b, n);
            if (parts) parts[k] += part;
            for (int i = 0; i < n; i++) v[i] -= part * b[i];
        }
    }
    const double length = sqrt(maths_dot(v, v, n));
    if (!(length > 1e-10 * start)) return 0;
    for (int i = 0; i < n; i++) v[i] /= length;
    return length;
}

/// A fixed pseudorandom vector, in −½ … ½, that no mode is orthogonal to.
static void fill_start(struct lanczos *l, double *v, uint64_t seed)
{
    for (int i = 0; i < l->size; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        v[i] = l->body->pinned[i / 3] ? 0 : (double)(seed >> 40) / (1 << 24) - 0.5;
    }
}

/// Builds the basis and the operator in it. If the space is exhausted (equal eigenvalues), goes on with a new random vector.
static void build_basis(struct lanczos *l)
{
    const int n = l->size, m = l->steps;
    const double *mass = l->body->mass;
    fill_start(l, l->basis, 1);
    orthonormalise(l, l->basis, 0, NULL);
    for (int k = 0; k < m; k++) {
        double *last = l->basis + (size_t)k * (size_t)n, *next = last + n;
        double *parts = l->values; // unused until the end
        progress_report("finding the modes", k, m);
        memset(parts, 0, (size_t)m * sizeof *parts);
        for (int i = 0; i < n; i++) l->left[i] = sqrt(mass[i / 3]) * last[i]; // next = M^½ (K + sM)⁻¹ M^½ last
        memset(next, 0, (size_t)n * sizeof *next);
        conjugate_solve(&l->body->scratch, &l->body->stiffness, (const double(*)[3])(void *)l->left,
                        (double(*)[3])(void *)next, 1e-11, GRADIENTS_MAX);
        for (int i = 0; i < n; i++) next[i] *= sqrt(mass[i / 3]);

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

void modes_create(struct modes *modes, struct body *body, int count)
{
    int movable = 0;
    for (int i = 0; i < body->node_count; i++) movable += 3 * !body->pinned[i];
    int steps = 2 * (count + RIGID) + 24; // the test against a dense solver shows that all converge
    if (steps > movable) steps = movable;
    *modes = (struct modes){0};
    modes->frequency = pool_take(&modes->pool, (size_t)count + 1, sizeof *modes->frequency);
    modes->shape = pool_take(&modes->pool, (size_t)(count + 1) * (size_t)body->node_count, sizeof *modes->shape);
    if (steps == 0) return;
    const size_t size = 3 * (size_t)body->node_count, room = (size_t)steps;
    struct lanczos l = {.body = body, .size = (int)size, .steps = steps};
    l.basis = pool_take(&l.pool, (room + 1) * size, sizeof *l.basis);
    l.left = pool_take(&l.pool, size, sizeof *l.left);
    l.small = pool_take(&l.pool, room * room, sizeof *l.small);
    l.values = pool_take(&l.pool, room, sizeof *l.values);
    l.vectors = pool_take(&l.pool, room * room, sizeof *l.vectors);

    // The body's matrix becomes K + sM. The shift is a small part of the stiffness.
    struct blocks *stiff = &body->stiffness;
    double stiffness = 0, mass = 0;
    body_forces(body, (const double(*)[3])body->rest, (double(*)[3])(void *)l.left);
    body_stiffness(body);
    for (int i = 0; i < stiff->rows; i++) {
        const double *d = stiff->block[stiff->diagonal[i]];
        if (body->pinned[i]) continue;
        stiffness += d[0] + d[4] + d[8];
        mass += 3 * body->mass[i];
    }
    l.shift = mass > 0 ? 1e-6 * stiffness / mass : 1;
    for (int i = 0; i < stiff->rows; i++) {
        for (int d = 0; d < 9; d += 4) stiff->block[stiff->diagonal[i]][d] += l.shift * body->mass[i];
    }
    build_basis(&l);
    progress_report("finding the modes", steps, steps);

    // Modes of the small problem, lowest frequency first. Those near the shift are rigid and are skipped.
    const int m = l.done;
    for (int i = 0; i < m; i++) {
        for (int k = 0; k < m; k++) l.small[i * m + k] = l.small[i * steps + k];
    }
    symmetric_eigen(m, l.small, l.values, l.vectors);
    for (int mode = m - 1; mode >= 0 && modes->count < count; mode--) {
        const double squared = 1 / l.values[mode] - l.shift, *part = l.vectors + (size_t)mode * (size_t)m;
        double *shape = *modes->shape + (size_t)modes->count * size;
        if (!(l.values[mode] > 0) || squared < 1e-4 * l.shift) continue;
        modes->frequency[modes->count++] = sqrt(squared) / (2 * M_PI);
        for (size_t k = 0; k < (size_t)m; k++) { // φ = M^-½ Σ_k part_k basis_k
            for (size_t i = 0; i < size; i++) shape[i] += part[k] * l.basis[k * size + i] / sqrt(body->mass[i / 3]);
        }
    }
    pool_free(&l.pool);
}
