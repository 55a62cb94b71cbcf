/// The parts of the simulation, each against its textbook definition or LAPACK; and what an elastic body does in time: its frequency, its energy,
/// its momenta, and that it always comes back to rest.
#include "maths/symmetric.h"
#include "near.h"
#include "simulation/body.h"
#include "simulation/integrator.h"
#include "uniform.h"
#include <lapacke.h>

/// In −1 … 1.
static double anything(uint64_t *seed) { return 2 * uniform(seed) - 1; }

static double (*vectors(int count))[3]
{
    double(*v)[3] = calloc((size_t)count, sizeof *v);
    assert_non_null(v);
    return v;
}

// --- singular values, stress, eigenvalues

static double determinant(const double m[3][3])
{
    double cross[3];
    vec3_cross(m[1], m[2], cross);
    return vec3_dot(m[0], cross);
}

static void assert_rotation(const double m[3][3])
{
    for (int n = 0; n < 9; n++) {
        double dot = 0;
        for (int k = 0; k < 3; k++) dot += m[k][n / 3] * m[k][n % 3];
        assert_near(dot, n / 3 == n % 3, 4e-15);
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
    double scale = fmax(svd.sigma[0], 1e-300), copy[9], sizes[3], none[1], superb[2], unit[3][3];
    for (int n = 0; n < 9; n++) {
        double sum = 0;
        for (int k = 0; k < 3; k++) sum += svd.u[n / 3][k] * svd.sigma[k] * svd.v[n % 3][k];
        unit[n / 3][n % 3] = f[n / 3][n % 3] / scale; // or the determinant may underflow
        assert_near(sum / scale, unit[n / 3][n % 3], 4e-15);
    }
    assert_true(svd.sigma[0] >= svd.sigma[1] && svd.sigma[1] >= fabs(svd.sigma[2]) * (1 - 1e-15));
    memcpy(copy, f, sizeof copy);
    assert_int_equal(LAPACKE_dgesvd(LAPACK_ROW_MAJOR, 'N', 'N', 3, 3, copy, 3, sizes, none, 3, none, 3, superb), 0);
    for (int k = 0; k < 3; k++) assert_near(fabs(svd.sigma[k]) / scale, sizes[k] / scale, 4e-15);
    if (sizes[2] > 1e-12 * sizes[0]) assert_true((svd.sigma[2] < 0) == (determinant((const double(*)[3])unit) < 0));
}

TEST(svd_of_random_singular_and_extreme_matrices)
{
    static const double rows[][3][3] = {
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
    uint64_t seed = 1;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) check_svd(rows[i]);
    for (int round = 0; round < 20000; round++) {
        double f[3][3];
        for (int i = 0; i < 9; i++) f[i / 3][i % 3] = anything(&seed);
        for (int i = 0; i < 9 && round % 4 == 1; i++) // nearly at rest, where most elements are
            f[i / 3][i % 3] = 1e-9 * f[i / 3][i % 3] + (i % 4 == 0);
        for (int j = 0; j < 3 && round % 4 == 2; j++) // flattened: two rows nearly the same
            f[2][j] = f[1][j] * (1 + 1e-13 * f[2][j]);
        check_svd((const double(*)[3])f);
    }
}

/// Stress is the derivative of energy on both sides of the clamp, through zero and into the inverted.
TEST(stress_is_the_slope_of_energy)
{
    const struct material material = material_from(3, 0.4);
    const double rest[3] = {1, 1, 1}, step = 1e-6;
    double stress[3];
    uint64_t seed = 2;
    for (int round = 0; round < 2000; round++) {
        double sigma[3];
        for (int i = 0; i < 3; i++) sigma[i] = 1.2 * anything(&seed) + 0.4;
        material_stress(&material, sigma, stress);
        for (int i = 0; i < 3; i++) {
            const double at = sigma[i];
            sigma[i] = at + step;
            double slope = material_energy(&material, sigma);
            sigma[i] = at - step;
            slope = (slope - material_energy(&material, sigma)) / (2 * step);
            sigma[i] = at;
            assert_near(stress[i], slope, 1e-4 * (1 + fabs(slope))); // the clamp's kink in the second derivative
        }
    }
    material_stress(&material, rest, stress);
    for (int i = 0; i < 3; i++) assert_near(stress[i], 0, 1e-15);
    assert_near(material_energy(&material, rest), 0, 1e-15);
}

TEST(eigenvalues_against_lapack)
{
    enum { LARGEST = 24 };
    uint64_t seed = 5;
    for (int n = 1; n <= LARGEST; n++) {
        double a[LARGEST * LARGEST], copy[LARGEST * LARGEST], values[LARGEST], shapes[LARGEST * LARGEST];
        double expected[LARGEST];
        for (int i = 0; i < n * n; i++) a[i / n * n + i % n] = a[i % n * n + i / n] = anything(&seed);
        memcpy(copy, a, sizeof copy);
        assert_int_equal(LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', n, copy, n, expected), 0);
        memcpy(copy, a, sizeof copy);
        symmetric_eigen(n, copy, values, shapes);
        for (int k = 0; k < n; k++) {
            assert_near(values[k], expected[k], 1e-13 * n);
            for (int i = 0; i < n; i++) {
                double sum = 0;
                for (int j = 0; j < n; j++) sum += a[i * n + j] * shapes[k * n + j];
                assert_near(sum, values[k] * shapes[k * n + i], 1e-13 * n);
            }
        }
    }
}

// --- beams of cubes along x from the origin, each cut into six tetrahedra (Kuhn), of density 1000

struct beam {
    int nodes, tets;
    double (*rest)[3], (*force)[3];
    int (*tet)[4];
    struct body body;
    struct modes modes;
    struct integrator integrator;
};

/// `clamped`: the nodes at x = 0 are pinned.
static void beam_open(struct beam *beam, const int cells[3], double edge, double young, double poisson, bool clamped)
{
    static const int axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const int points[3] = {cells[0] + 1, cells[1] + 1, cells[2] + 1}, step[3] = {points[1] * points[2], points[2], 1};
    *beam = (struct beam){.nodes = points[0] * step[0]};
    beam->rest = vectors(beam->nodes);
    beam->force = vectors(beam->nodes);
    beam->tet = calloc((size_t)(6 * cells[0] * cells[1] * cells[2]), sizeof *beam->tet);
    assert_non_null(beam->tet);
    for (int i = 0; i < beam->nodes; i++) {
        const int at[3] = {i / step[0], i / points[2] % points[1], i % points[2]};
        for (int c = 0; c < 3; c++) beam->rest[i][c] = at[c] * edge;
        if (at[0] == cells[0] || at[1] == cells[1] || at[2] == cells[2]) continue;
        for (int k = 0; k < 6;
             k++, beam->tets++) { // from one corner to the opposite one along the axes in this order
            int *tet = beam->tet[beam->tets];
            tet[0] = i;
            for (int a = 0; a < 3; a++) tet[a + 1] = tet[a] + step[axes[k][a]];
        }
    }
    const struct body_mesh mesh = {(const double(*)[3])beam->rest, beam->nodes, (const int(*)[4])beam->tet, NULL,
                                   beam->tets};
    assert_true(body_create(&beam->body, &mesh, material_from(young, poisson), 1000));
    for (int i = 0; i < beam->nodes && clamped; i++) beam->body.pinned[i] = beam->rest[i][0] < 1e-9;
    body_ready(&beam->body);
}

static void beam_close(struct beam *beam)
{
    if (beam->integrator.work) pool_free(&beam->integrator.pool);
    pool_free(&beam->modes.pool);
    pool_free(&beam->body.pool);
    free(beam->rest);
    free(beam->force);
    free(beam->tet);
}

/// BEAM_TEST(name, x, y, z cells, their edge, Young's modulus, Poisson's ratio, clamped) { … beam->body … }
#define BEAM_TEST(name, x, y, z, edge, young, poisson, clamped)                                                      \
    TEST_OF(struct beam, beam, beam_open(beam, (const int[3]){x, y, z}, edge, young, poisson, clamped),              \
            beam_close(beam), name)

static double forces_of(struct beam *beam, double (*x)[3])
{
    return body_forces(&beam->body, (const double(*)[3])x, beam->force);
}

static void integrate_by(struct beam *beam, double step, double tolerance)
{
    if (beam->integrator.work) pool_free(&beam->integrator.pool);
    integrator_create(&beam->integrator, &beam->body, step);
    if (tolerance > 0) beam->integrator.tolerance = tolerance;
}

static void go_on(struct beam *beam, int steps)
{
    for (int step = 0; step < steps; step++) assert_true(integrator_step(&beam->integrator));
}

/// At rest the stiffness is that of linear elasticity; near it, the derivative of the forces; everywhere, definite.
BEAM_TEST(stiffness_is_the_slope_of_forces, 2, 1, 1, 0.5, 10, 0.3, true)
{
    const double step = 1e-6;
    const bool *pinned = beam->body.pinned;
    double(*x)[3] = vectors(beam->nodes), (*d)[3] = vectors(beam->nodes), (*kd)[3] = vectors(beam->nodes);
    double(*up)[3] = vectors(beam->nodes);
    uint64_t seed = 3;
    for (int i = 0; i < 3 * beam->nodes; i++) { // stretched a little, so that no eigenvalue is below zero
        vec3_flat(d)[i] = pinned[i / 3] ? 0 : anything(&seed);
        vec3_flat(x)[i] = 1.1 * vec3_flat(beam->rest)[i] + (pinned[i / 3] ? 0 : 0.01 * anything(&seed));
    }
    forces_of(beam, x);
    body_stiffness(&beam->body);
    blocks_multiply(&beam->body.stiffness, (const double(*)[3])d, kd);
    for (int i = 0; i < 3 * beam->nodes; i++) vec3_flat(x)[i] += step * vec3_flat(d)[i];
    forces_of(beam, x);
    memcpy(up, beam->force, (size_t)beam->nodes * sizeof *up);
    for (int i = 0; i < 3 * beam->nodes; i++) vec3_flat(x)[i] -= 2 * step * vec3_flat(d)[i];
    forces_of(beam, x);
    for (int i = 0; i < 3 * beam->nodes; i++)
        assert_near(vec3_flat(kd)[i], -(vec3_flat(up)[i] - vec3_flat(beam->force)[i]) / (2 * step), 1e-6);
    free(x);
    free(d);
    free(kd);
    free(up);
}

/// However the nodes lie, dᵀKd ≥ 0, and conjugate gradients find what LAPACKE's Cholesky finds.
BEAM_TEST(conjugate_gradients_against_a_dense_solver, 3, 2, 1, 1, 10, 0.45, true)
{
    struct body *body = &beam->body;
    const struct blocks *k = &body->stiffness;
    const int n = 3 * beam->nodes;
    double(*x)[3] = vectors(beam->nodes), (*b)[3] = vectors(beam->nodes);
    double *dense = calloc((size_t)(n * n), sizeof *dense), *right = calloc((size_t)n, sizeof *right);
    uint64_t seed = 4;
    for (int round = 0; round < 20; round++) {
        for (int i = 0; i < n; i++) vec3_flat(x)[i] = 3 * anything(&seed); // half of the elements are inverted
        forces_of(beam, x);
        body_stiffness(body);
        memset(dense, 0, (size_t)(n * n) * sizeof *dense);
        for (int row = 0; row < k->rows; row++) {
            for (int p = k->start[row]; p < k->start[row + 1]; p++) {
                for (int c = 0; c < 9; c++) {
                    if (p == k->diagonal[row] && c % 4 == 0) k->block[p][c] += 0.5;
                    dense[(3 * row + c / 3) * n + 3 * k->column[p] + c % 3] = k->block[p][c];
                }
            }
        }
        for (int i = 0; i < n; i++) right[i] = vec3_flat(b)[i] = anything(&seed);
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

// --- modes

/// A textbook's small-strain stiffness of one tetrahedron, V Bᵀ D B with engineering shear strains, added to the dense
/// matrix of the unknowns. Independent of src/simulation down to the shape functions.
static void add_linear_stiffness(const double p[4][3], double young, double poisson, const int unknown[12], int n,
                                 double *k)
{
    double m[16], b[6][12] = {{0}};
    int pivot[4];
    for (int a = 0; a < 4; a++) { // rows (1, x, y, z): the columns of the inverse are the shape functions
        m[4 * a] = 1;
        memcpy(m + 4 * a + 1, p[a], sizeof p[a]);
    }
    assert_int_equal(LAPACKE_dgetrf(LAPACK_ROW_MAJOR, 4, 4, m, 4, pivot), 0);
    double volume = fabs(m[0] * m[5] * m[10] * m[15]) / 6;
    assert_int_equal(LAPACKE_dgetri(LAPACK_ROW_MAJOR, 4, m, 4, pivot), 0);
    for (int a = 0; a < 4; a++) {
        double gx = m[4 + a], gy = m[8 + a], gz = m[12 + a];
        b[0][3 * a] = b[3][3 * a + 1] = b[5][3 * a + 2] = gx;
        b[1][3 * a + 1] = b[3][3 * a] = b[4][3 * a + 2] = gy;
        b[2][3 * a + 2] = b[4][3 * a + 1] = b[5][3 * a] = gz;
    }
    double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
    for (int i = 0; i < 12; i++) {
        for (int j = 0; j < 12; j++) {
            double sum = lambda * (b[0][i] + b[1][i] + b[2][i]) * (b[0][j] + b[1][j] + b[2][j]);
            for (int s = 0; s < 6; s++) sum += (s < 3 ? 2 : 1) * mu * b[s][i] * b[s][j];
            if (unknown[i] >= 0 && unknown[j] >= 0) k[unknown[i] * n + unknown[j]] += volume * sum;
        }
    }
}

/// Finds the beam's first `count` modes, whose frequencies are those of the generalised eigenproblem by LAPACKE's dsygvd with lumped masses,
/// without the `rigid` first; returns the lowest one.
static double find_modes(struct beam *beam, double young, double poisson, int count, int rigid)
{
    int *unknown = calloc((size_t)beam->nodes * 3, sizeof *unknown), n = 0;
    for (int i = 0; i < 3 * beam->nodes; i++) unknown[i] = beam->body.pinned[i / 3] ? -1 : n++;
    assert_in_range(n, 1, 1500);
    double *k = calloc((size_t)(n * n), sizeof *k), *m = calloc((size_t)(n * n), sizeof *m);
    double *values = calloc((size_t)n, sizeof *values);
    for (int e = 0; e < beam->tets; e++) {
        double p[4][3];
        int mine[12];
        for (int c = 0; c < 12; c++) {
            p[c / 3][c % 3] = beam->rest[beam->tet[e][c / 3]][c % 3];
            mine[c] = unknown[3 * beam->tet[e][c / 3] + c % 3];
        }
        add_linear_stiffness((const double(*)[3])p, young, poisson, mine, n, k);
    }
    for (int i = 0; i < 3 * beam->nodes; i++)
        if (unknown[i] >= 0) m[unknown[i] * n + unknown[i]] = beam->body.mass[i / 3];
    assert_int_equal(LAPACKE_dsygvd(LAPACK_ROW_MAJOR, 1, 'N', 'L', n, k, n, m, n, values), 0);
    modes_create(&beam->modes, &beam->body, count);
    assert_int_equal(beam->modes.count, count);
    for (int i = 0; i < count; i++)
        assert_near(beam->modes.frequency[i] / (sqrt(values[i + rigid]) / (2 * M_PI)), 1, 1e-7);
    const double lowest = sqrt(values[rigid]) / (2 * M_PI);
    free(unknown);
    free(k);
    free(m);
    free(values);
    return lowest;
}

/// A free body's six rigid motions are no modes.
BEAM_TEST(modes_of_a_free_body_leave_out_the_rigid_ones, 4, 2, 1, 0.3, 1e5, 0.3, false)
{
    find_modes(beam, 1e5, 0.3, 12, 6);
    for (int k = 0; k < 144; k++) { // they diagonalise the mass
        double dot = 0;
        const double *p = beam->modes.shape[k / 12 * beam->nodes], *q = beam->modes.shape[k % 12 * beam->nodes];
        for (int i = 0; i < 3 * beam->nodes; i++) dot += p[i] * beam->body.mass[i / 3] * q[i];
        assert_near(dot, k / 12 == k % 12, 1e-8);
    }
}

/// Linear tetrahedra lock: they are too stiff in bending, by an error that falls with the square of their size.
TEST(cantilever_converges_to_euler_and_bernoulli)
{
    const double young = 1e6, density = 1000, length = 7;
    // First bending frequency of a slender clamped beam of square section 1 × 1.
    double slender = 1.8751040687 * 1.8751040687 / (2 * M_PI * length * length) * sqrt(young / (12 * density));
    double error[3];
    for (int k = 0; k < 3; k++) {
        const int n = 1 << k;
        struct beam beam;
        beam_open(&beam, (const int[3]){(int)length * n, n, n}, 1.0 / n, young, 0, true);
        modes_create(&beam.modes, &beam.body, 1);
        error[k] = beam.modes.frequency[0] / slender - 1;
        print_message("%d cubes across: %.4f of Euler and Bernoulli's\n", n, 1 + error[k]);
        beam_close(&beam);
    }
    assert_true(error[0] > 3 * error[1] && error[1] > 3 * error[2]);
    assert_near(error[2], 0, 0.075);
}

// --- motion

/// The coordinate φᵀM(x − X) of the first mode: what of it there is in the motion.
static double coordinate(const struct beam *beam)
{
    double sum = 0;
    for (int i = 0; i < 3 * beam->nodes; i++)
        sum += vec3_flat(beam->modes.shape)[i] * beam->body.mass[i / 3] *
               (vec3_flat(beam->integrator.x)[i] - vec3_flat(beam->rest)[i]);
    return sum;
}

/// The frequency at which the first mode's coordinate crosses zero is that of the generalised eigenproblem.
BEAM_TEST(cantilever_swings_at_its_first_frequency, 8, 1, 2, 0.1, 2e5, 0.3, true)
{
    const double expected = find_modes(beam, 2e5, 0.3, 8, 0);
    double first = 0, last = 0;
    integrate_by(beam, 1 / expected / 60, 1e-9);
    for (int i = 0; i < beam->nodes; i++) // bent a little, with some of the higher modes besides
        beam->integrator.x[i][1] += 1e-3 * beam->rest[i][0] * beam->rest[i][0];
    for (int step = 0, seen = 0; seen < 9; step++) {
        const double before = coordinate(beam);
        go_on(beam, 1);
        const double after = coordinate(beam);
        if ((before < 0) == (after < 0)) continue;
        last = (step + before / (before - after)) * beam->integrator.step;
        if (seen++ == 0) first = last;
    }
    print_message("cantilever: %.6g Hz simulated, %.6g Hz by dsygvd\n", 4 / (last - first), expected);
    assert_near(4 / (last - first) / expected, 1, 0.01);
}

/// At rest Rayleigh's damping takes e^(−ζωt) off the first mode's swing.
BEAM_TEST(damping_is_the_ratio_asked_for, 6, 1, 2, 0.2, 1e5, 0.3, true)
{
    enum { PERIOD = 100, PERIODS = 5 };
    const double ratio = 0.05;
    double start = 0, end = 0;
    modes_create(&beam->modes, &beam->body, 1);
    const double omega = 2 * M_PI * beam->modes.frequency[0];
    integrate_by(beam, 1 / beam->modes.frequency[0] / PERIOD, 0);
    beam->integrator.mass_damping = ratio * omega;
    beam->integrator.stiffness_damping = ratio / omega;
    for (int i = 0; i < 3 * beam->nodes; i++)
        vec3_flat(beam->integrator.x)[i] += 1e-4 * vec3_flat(beam->modes.shape)[i];
    for (int step = 0; step < PERIOD * PERIODS; step++) {
        go_on(beam, 1);
        if (step < PERIOD) start = fmax(start, coordinate(beam));
        if (step >= PERIOD * (PERIODS - 1)) end = fmax(end, coordinate(beam));
    }
    // From one period's largest swing (its end: the start is a peak before the first step) to the last one's.
    assert_near(log(start / end) / (2 * M_PI * ratio * (PERIODS - 1)), 1, 0.02);
}

/// Swinging by a fifth of the length in its first mode the body keeps its energy, undamped, up to a hundred periods of fifty steps; torn at so that
/// nine tenths of the energy go into stretching that the steps are too long for, it loses energy and never gains any.
BEAM_TEST(energy_stays_over_many_periods, 5, 1, 1, 0.2, 1e5, 0.3, true)
{
    modes_create(&beam->modes, &beam->body, 1);
    const double frequency = beam->modes.frequency[0],
                 swing = 0.2 * 2 * M_PI * frequency / vec3_length(beam->modes.shape[beam->nodes - 1]);
    for (int jerked = 0; jerked < 2; jerked++) {
        double least = INFINITY, most = 0, start = 0;
        integrate_by(beam, 1 / frequency / 50, 1e-7);
        for (int i = 0; i < beam->nodes; i++) {
            if (jerked) beam->integrator.x[i][1] += 0.2 * beam->rest[i][0] * beam->rest[i][0];
            for (int c = 0; c < 3 && !jerked; c++) beam->integrator.v[i][c] = swing * beam->modes.shape[i][c];
        }
        for (int step = 0; step < quick_or_all(20, 100) * 50; step++) {
            const double energy = forces_of(beam, beam->integrator.x) +
                                  body_kinetic(&beam->body, (const double(*)[3])beam->integrator.v);
            if (step == 0) start = energy;
            least = fmin(least, energy / start);
            most = fmax(most, energy / start);
            go_on(beam, 1);
        }
        print_message("energy after a %s: %.5f … %.5f of the first\n", jerked ? "jerk" : "push", least, most);
        assert_true(jerked ? most <= 1.01 : least >= 0.98 && most <= 1.02);
        if (!jerked) assert_int_equal(beam->integrator.calmed, 0);
    }
}

static void momenta(const struct beam *beam, double sum[6])
{
    memset(sum, 0, 6 * sizeof *sum);
    for (int i = 0; i < beam->nodes; i++) {
        double turn[3];
        vec3_cross(beam->integrator.x[i], beam->integrator.v[i], turn);
        for (int c = 0; c < 3; c++) {
            sum[c] += beam->body.mass[i] * beam->integrator.v[i][c];
            sum[3 + c] += beam->body.mass[i] * turn[c];
        }
    }
}

/// A free body that is thrown, spins and wobbles keeps its linear momentum, and its angular one to the order of the steps.
BEAM_TEST(a_free_body_keeps_its_momenta, 4, 2, 1, 0.25, 2e4, 0.35, false)
{
    const double spin[3] = {1, 2, 3};
    double before[6], after[6];
    uint64_t seed = 6;
    integrate_by(beam, 0.005, 1e-10);
    for (int i = 0; i < beam->nodes; i++) {
        vec3_cross(spin, beam->rest[i], beam->integrator.v[i]);
        for (int c = 0; c < 3; c++) beam->integrator.v[i][c] += 0.5 * c + 0.5 * anything(&seed);
    }
    momenta(beam, before);
    go_on(beam, 400);
    momenta(beam, after);
    for (int c = 0; c < 6; c++)
        assert_near(after[c], before[c], c < 3 ? 1e-6 * vec3_length(before) : 1e-4 * vec3_length(before + 3));
}

static int count_inverted(const struct body *body)
{
    int count = 0;
    for (int e = 0; e < body->element_count; e++) count += body->svd[e].sigma[2] < 0;
    return count;
}

/// Every vertex thrown at random, half of the tetrahedra inside out: the body untangles itself and comes to rest.
TEST(a_scrambled_body_comes_back_to_rest)
{
    for (uint64_t seed = 1; seed <= (uint64_t)quick_or_all(1, 4); seed++) {
        struct beam beam;
        uint64_t numbers = seed;
        beam_open(&beam, (const int[3]){3, 3, 3}, 1 / 3.0, 1e5, 0.35, true);
        integrate_by(&beam, 0.02, 1e-6);
        beam.integrator.mass_damping = 2;
        beam.integrator.stiffness_damping = 0.02;
        for (int i = 0; i < beam.nodes; i++)
            for (int c = 0; c < 3 && !beam.body.pinned[i]; c++) beam.integrator.x[i][c] = 0.5 + anything(&numbers);
        forces_of(&beam, beam.integrator.x);
        assert_true(count_inverted(&beam.body) > 50); // of 162
        go_on(&beam, 500);
        forces_of(&beam, beam.integrator.x);
        assert_int_equal(count_inverted(&beam.body), 0);
        for (int i = 0; i < 3 * beam.nodes; i++)
            assert_near(vec3_flat(beam.integrator.x)[i], vec3_flat(beam.rest)[i], 1e-3);
        beam_close(&beam);
    }
}
