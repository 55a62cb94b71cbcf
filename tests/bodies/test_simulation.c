/// The parts of the simulation, each against its textbook definition: singular values, stress, stiffness, linear systems.
#include "beam.h"
#include "near.h"
#include "simulation/body.h"
#include <lapacke.h>

static double determinant(const double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static void assert_rotation(const double m[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double dot = 0;
            for (int k = 0; k < 3; k++) dot += m[k][i] * m[k][j];
            assert_near(dot, i == j, 4e-15);
        }
    }
    assert_near(determinant(m), 1, 1e-14);
}

/// F = U Σ Vᵀ, both rotations, order and sign as Irving, Teran and Fedkiw want them, sizes as LAPACKE says.
static void check_svd(const double f[3][3])
{
    struct svd svd;
    svd3(f, &svd);
    assert_rotation((const double(*)[3])svd.u);
    assert_rotation((const double(*)[3])svd.v);
    double scale = fmax(svd.sigma[0], 1e-300);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++) sum += svd.u[i][k] * svd.sigma[k] * svd.v[j][k];
            assert_near(sum / scale, f[i][j] / scale, 4e-15);
        }
    }
    assert_true(svd.sigma[0] >= svd.sigma[1] && svd.sigma[1] >= fabs(svd.sigma[2]) * (1 - 1e-15));
    double copy[9], sizes[3], none[1], superb[2];
    memcpy(copy, f, sizeof copy);
    assert_int_equal(LAPACKE_dgesvd(LAPACK_ROW_MAJOR, 'N', 'N', 3, 3, copy, 3, sizes, none, 3, none, 3, superb), 0);
    for (int k = 0; k < 3; k++) assert_near(fabs(svd.sigma[k]) / scale, sizes[k] / scale, 4e-15);
    double unit[3][3];
    for (int i = 0; i < 9; i++) unit[i / 3][i % 3] = f[i / 3][i % 3] / scale; // or the determinant may underflow
    bool turned = determinant((const double(*)[3])unit) < 0;
    if (sizes[2] > 1e-12 * sizes[0]) assert_true((svd.sigma[2] < 0) == turned);
}

TEST(svd_of_random_matrices)
{
    uint64_t seed = 1;
    for (int round = 0; round < 20000; round++) {
        double f[3][3];
        for (int i = 0; i < 9; i++) f[i / 3][i % 3] = beam_random(&seed);
        if (round % 4 == 1) { // nearly at rest, where most elements are
            for (int i = 0; i < 9; i++) f[i / 3][i % 3] = 1e-9 * f[i / 3][i % 3] + (i % 4 == 0);
        }
        if (round % 4 == 2) { // flattened: two rows nearly the same
            for (int j = 0; j < 3; j++) f[2][j] = f[1][j] * (1 + 1e-13 * f[2][j]);
        }
        check_svd((const double(*)[3])f);
    }
}

TEST(svd_of_singular_and_extreme_matrices)
{
    static const double cases[][3][3] = {
        {{0}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, // a mirror image
        {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
        {{0, 0, 0}, {0, 0, 2}, {0, 0, 0}}, // a line
        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, // a line
        {{1, 2, 3}, {2, 4, 6}, {1, 0, 1}}, // a plane
        {{1e-150, 0, 0}, {0, 1e-150, 2e-151}, {0, 0, -1e-150}},
        {{1e100, 0, 0}, {0, 1, 0}, {0, 0, 1e-100}},
        {{2, 0, 0}, {0, 2, 0}, {0, 0, 2 + 1e-15}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) check_svd(cases[i]);
}

/// Stress is the derivative of energy on both sides of the clamp, through zero and into the inverted.
TEST(stress_is_the_slope_of_energy)
{
    const struct material material = material_from(3, 0.4);
    uint64_t seed = 2;
    for (int round = 0; round < 2000; round++) {
        double sigma[3], stress[3];
        for (int i = 0; i < 3; i++) sigma[i] = 1.2 * beam_random(&seed) + 0.4;
        material_stress(&material, sigma, stress);
        for (int i = 0; i < 3; i++) {
            const double step = 1e-6;
            double up[3], down[3];
            memcpy(up, sigma, sizeof up);
            memcpy(down, sigma, sizeof down);
            up[i] += step;
            down[i] -= step;
            double slope = (material_energy(&material, up) - material_energy(&material, down)) / (2 * step);
            assert_near(stress[i], slope, 1e-4 * (1 + fabs(slope))); // the clamp's kink in the second derivative
        }
    }
    const double rest[3] = {1, 1, 1};
    double stress[3];
    material_stress(&material, rest, stress);
    for (int i = 0; i < 3; i++) assert_near(stress[i], 0, 1e-15);
    assert_near(material_energy(&material, rest), 0, 1e-15);
}

/// At rest the stiffness is that of linear elasticity; near it, the derivative of the forces; everywhere, definite.
BEAM_TEST(stiffness_is_the_slope_of_forces,
          beam_open(beam, (const int[3]){2, 1, 1}, 0.5, material_from(10, 0.3), true))
{
    struct body *body = &beam->body;
    uint64_t seed = 3;
    const int n = beam->nodes;
    double(*x)[3] = calloc((size_t)n, sizeof *x), (*d)[3] = calloc((size_t)n, sizeof *d);
    double(*kd)[3] = calloc((size_t)n, sizeof *kd), (*up)[3] = calloc((size_t)n, sizeof *up);
    double(*down)[3] = calloc((size_t)n, sizeof *down);
    for (int i = 0; i < 3 * n; i++) { // stretched a little, so that no eigenvalue is below zero
        vec3_flat(d)[i] = body->pinned[i / 3] ? 0 : beam_random(&seed);
        vec3_flat(x)[i] = 1.1 * vec3_flat(beam->rest)[i] + (body->pinned[i / 3] ? 0 : 0.01 * beam_random(&seed));
    }
    body_forces(body, (const double(*)[3])x, up);
    body_stiffness(body);
    blocks_multiply(&body->stiffness, (const double(*)[3])d, kd);
    const double step = 1e-6;
    for (int i = 0; i < 3 * n; i++) vec3_flat(x)[i] += step * vec3_flat(d)[i];
    body_forces(body, (const double(*)[3])x, up);
    for (int i = 0; i < 3 * n; i++) vec3_flat(x)[i] -= 2 * step * vec3_flat(d)[i];
    body_forces(body, (const double(*)[3])x, down);
    for (int i = 0; i < 3 * n; i++)
        assert_near(vec3_flat(kd)[i], -(vec3_flat(up)[i] - vec3_flat(down)[i]) / (2 * step), 1e-6);
    free(x);
    free(d);
    free(kd);
    free(up);
    free(down);
}

/// However the nodes lie, dᵀKd ≥ 0, and conjugate gradients find what LAPACKE's Cholesky finds.
BEAM_TEST(conjugate_gradients_against_a_dense_solver,
          beam_open(beam, (const int[3]){3, 2, 1}, 1, material_from(10, 0.45), true))
{
    struct body *body = &beam->body;
    uint64_t seed = 4;
    const int n = 3 * beam->nodes;
    double(*x)[3] = calloc((size_t)beam->nodes, sizeof *x), (*b)[3] = calloc((size_t)beam->nodes, sizeof *b);
    double *dense = calloc((size_t)(n * n), sizeof *dense), *right = calloc((size_t)n, sizeof *right);
    for (int round = 0; round < 20; round++) {
        for (int i = 0; i < n; i++) vec3_flat(x)[i] = 3 * beam_random(&seed); // half of the elements are inverted
        body_forces(body, (const double(*)[3])x, b);
        body_stiffness(body);
        const struct blocks *k = &body->stiffness;
        memset(dense, 0, (size_t)(n * n) * sizeof *dense);
        for (int row = 0; row < k->rows; row++) {
            for (int p = k->start[row]; p < k->start[row + 1]; p++) {
                if (p == k->diagonal[row]) {
                    for (int c = 0; c < 9; c += 4) k->block[p][c] += 0.5;
                }
                for (int c = 0; c < 9; c++) dense[(3 * row + c / 3) * n + 3 * k->column[p] + c % 3] = k->block[p][c];
            }
        }
        for (int i = 0; i < n; i++) right[i] = vec3_flat(b)[i] = beam_random(&seed);
        memset(x, 0, (size_t)beam->nodes * sizeof *x);
        assert_int_equal(LAPACKE_dposv(LAPACK_ROW_MAJOR, 'L', n, 1, dense, n, right, 1), 0); // 0: definite
        int steps = conjugate_solve(&body->scratch, k, (const double(*)[3])b, x, 1e-13, 10000);
        assert_in_range(steps, 1, 9999);
        for (int i = 0; i < n; i++) assert_near(vec3_flat(x)[i], right[i], 1e-9);
    }
    free(x);
    free(b);
    free(dense);
    free(right);
}

TEST(eigenvalues_against_lapack)
{
    enum { LARGEST = 24 };
    uint64_t seed = 5;
    for (int n = 1; n <= LARGEST; n++) {
        double a[LARGEST * LARGEST], copy[LARGEST * LARGEST], values[LARGEST], vectors[LARGEST * LARGEST];
        double expected[LARGEST];
        for (int i = 0; i < n * n; i++) a[i / n * n + i % n] = a[i % n * n + i / n] = beam_random(&seed);
        memcpy(copy, a, sizeof copy);
        assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', n, copy, n, expected), 0);
        memcpy(copy, a, sizeof copy);
        eigen_symmetric(n, copy, values, vectors);
        for (int k = 0; k < n; k++) {
            assert_near(values[k], expected[k], 1e-13 * n);
            for (int i = 0; i < n; i++) {
                double sum = 0;
                for (int j = 0; j < n; j++) sum += a[i * n + j] * vectors[k * n + j];
                assert_near(sum, values[k] * vectors[k * n + i], 1e-13 * n);
            }
        }
    }
}
