/// What an elastic body does in time: its frequency, its energy, its momenta, and that it always comes back to rest.
#include "beam.h"
#include "near.h"
#include "simulation/body.h"
#include "simulation/integrator.h"
#include <lapacke.h>

static const double pi = 3.14159265358979323846;

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

/// Generalised eigenvalues ω² of a clamped beam, ascending, by LAPACKE's dsygvd with lumped masses.
static int dense_eigenvalues(const struct beam *beam, double young, double poisson, double **values)
{
    int *unknown = calloc((size_t)beam->nodes * 3, sizeof *unknown), n = 0;
    for (int i = 0; i < 3 * beam->nodes; i++) unknown[i] = beam->body.pinned[i / 3] ? -1 : n++;
    assert_in_range(n, 1, 1500);
    double *k = calloc((size_t)(n * n), sizeof *k), *m = calloc((size_t)(n * n), sizeof *m);
    *values = calloc((size_t)n, sizeof **values);
    for (int e = 0; e < beam->tets; e++) {
        double p[4][3];
        int mine[12];
        for (int c = 0; c < 12; c++) {
            p[c / 3][c % 3] = beam->rest[beam->tet[e][c / 3]][c % 3];
            mine[c] = unknown[3 * beam->tet[e][c / 3] + c % 3];
        }
        add_linear_stiffness((const double(*)[3])p, young, poisson, mine, n, k);
    }
    for (int i = 0; i < 3 * beam->nodes; i++) {
        if (unknown[i] >= 0) m[unknown[i] * n + unknown[i]] = beam->body.mass[i / 3];
    }
    assert_int_equal(LAPACKE_dsygvd(LAPACK_ROW_MAJOR, 1, 'N', 'L', n, k, n, m, n, *values), 0);
    free(unknown);
    free(k);
    free(m);
    return n;
}

/// The coordinate φᵀM(x − X) of a mode: what of it there is in the motion.
static double coordinate(const struct integrator *integrator, double (*shape)[3])
{
    const struct body *body = integrator->body;
    double sum = 0;
    for (int i = 0; i < 3 * body->node_count; i++) {
        sum += vec3_flat(shape)[i] * body->mass[i / 3] * (vec3_flat(integrator->x)[i] - vec3_flat(body->rest)[i]);
    }
    return sum;
}

/// Simulates until the first mode's coordinate has crossed zero so often; returns its frequency, Hz, from the times.
static double measure_frequency(struct integrator *integrator, double (*shape)[3], int crossings)
{
    double first = 0, last = 0;
    int seen = 0;
    for (long step = 0; seen < crossings; step++) {
        double before = coordinate(integrator, shape);
        assert_true(integrator_step(integrator));
        double after = coordinate(integrator, shape);
        if ((before < 0) == (after < 0)) continue;
        last = ((double)step + before / (before - after)) * integrator->step;
        if (seen++ == 0) first = last;
    }
    return (seen - 1) / (2 * (last - first));
}

/// The lowest frequency of the simulated motion is that of the generalised eigenproblem of the same mesh.
BEAM_TEST(cantilever_swings_at_its_first_frequency,
          beam_open(beam, (const int[3]){8, 1, 2}, 0.1, material_from(2e5, 0.3), true))
{
    const double young = 2e5, poisson = 0.3;
    double *values;
    dense_eigenvalues(beam, young, poisson, &values);
    double expected = sqrt(values[0]) / (2 * pi);

    modes_create(&beam->modes, &beam->body, 8);
    for (int k = 0; k < 8; k++) assert_near(beam->modes.frequency[k] / (sqrt(values[k]) / (2 * pi)), 1, 1e-7);

    integrator_create(&beam->integrator, &beam->body, 1 / expected / 60);
    beam->integrator.tolerance = 1e-9;
    for (int i = 0; i < beam->nodes; i++) { // bent a little, with some of the higher modes besides
        double along = beam->rest[i][0];
        beam->integrator.x[i][1] += 1e-3 * along * along;
    }
    double measured = measure_frequency(&beam->integrator, beam->modes.shape, 9);
    print_message("cantilever: %.6g Hz simulated, %.6g Hz by dsygvd\n", measured, expected);
    assert_near(measured / expected, 1, 0.01);
    free(values);
}

/// Linear tetrahedra lock: they are too stiff in bending, by an error that falls with the square of their size.
TEST(cantilever_converges_to_euler_and_bernoulli)
{
    const double young = 1e6, density = 1000, length = 7;
    // First bending frequency of a slender clamped beam of square section 1 × 1.
    double slender = 1.8751040687 * 1.8751040687 / (2 * pi * length * length) * sqrt(young / (12 * density));
    double error[3];
    for (int k = 0; k < 3; k++) {
        int n = 1 << k;
        struct beam beam;
        beam_open(&beam, (const int[3]){(int)length * n, n, n}, 1.0 / n, material_from(young, 0), true);
        modes_create(&beam.modes, &beam.body, 1);
        error[k] = beam.modes.frequency[0] / slender - 1;
        print_message("%d cubes across: %.4f of Euler and Bernoulli's\n", n, 1 + error[k]);
        beam_close(&beam);
    }
    assert_true(error[0] > 3 * error[1] && error[1] > 3 * error[2]);
    assert_near(error[2], 0, 0.075);
}

/// Undamped, up to a hundred periods of fifty steps: the least and the largest energy relative to the first.
static void follow_energy(struct integrator *integrator, double range[2])
{
    double(*force)[3] = calloc((size_t)integrator->body->node_count, sizeof *force), start = 0;
    range[0] = INFINITY;
    range[1] = 0;
    for (int step = 0; step < quick_or_all(20, 100) * 50; step++) {
        double energy = body_forces(integrator->body, (const double(*)[3])integrator->x, force) +
                        body_kinetic(integrator->body, (const double(*)[3])integrator->v);
        if (step == 0) start = energy;
        range[0] = fmin(range[0], energy / start);
        range[1] = fmax(range[1], energy / start);
        assert_true(integrator_step(integrator));
    }
    free(force);
}

/// Swinging by a fifth of the length in its first mode the body keeps its energy; torn at so that nine tenths of the
/// energy go into stretching that the steps are too long for, it loses energy and never gains any.
BEAM_TEST(energy_stays_over_many_periods,
          beam_open(beam, (const int[3]){5, 1, 1}, 0.2, material_from(1e5, 0.3), true))
{
    double range[2];
    modes_create(&beam->modes, &beam->body, 1);
    const double omega = 2 * pi * beam->modes.frequency[0], step = 1 / beam->modes.frequency[0] / 50;
    integrator_create(&beam->integrator, &beam->body, step);
    beam->integrator.tolerance = 1e-7;
    double tip = vec3_length(beam->modes.shape[beam->nodes - 1]);
    for (int i = 0; i < 3 * beam->nodes; i++)
        vec3_flat(beam->integrator.v)[i] = 0.2 * omega / tip * vec3_flat(beam->modes.shape)[i];
    follow_energy(&beam->integrator, range);
    print_message("energy of a swing: %.5f … %.5f of the first\n", range[0], range[1]);
    assert_near(range[0], 1, 0.02);
    assert_near(range[1], 1, 0.02);
    assert_int_equal(beam->integrator.calmed, 0);
    integrator_free(&beam->integrator);

    integrator_create(&beam->integrator, &beam->body, step);
    beam->integrator.tolerance = 1e-7;
    for (int i = 0; i < beam->nodes; i++) beam->integrator.x[i][1] += 0.2 * beam->rest[i][0] * beam->rest[i][0];
    follow_energy(&beam->integrator, range);
    print_message("energy after a jerk: %.5f … %.5f of the first\n", range[0], range[1]);
    assert_true(range[1] <= 1.01);
}

static void momenta(const struct integrator *integrator, double linear[3], double angular[3])
{
    memset(linear, 0, 3 * sizeof *linear);
    memset(angular, 0, 3 * sizeof *angular);
    for (int i = 0; i < integrator->body->node_count; i++) {
        double turn[3];
        vec3_cross(integrator->x[i], integrator->v[i], turn);
        for (int c = 0; c < 3; c++) {
            linear[c] += integrator->body->mass[i] * integrator->v[i][c];
            angular[c] += integrator->body->mass[i] * turn[c];
        }
    }
}

/// A free body that is thrown, spins and wobbles keeps its linear momentum, and its angular one to the order of the steps.
BEAM_TEST(a_free_body_keeps_its_momenta,
          beam_open(beam, (const int[3]){4, 2, 1}, 0.25, material_from(2e4, 0.35), false))
{
    uint64_t seed = 6;
    integrator_create(&beam->integrator, &beam->body, 0.005);
    beam->integrator.tolerance = 1e-10;
    const double spin[3] = {1, 2, 3};
    for (int i = 0; i < beam->nodes; i++) {
        vec3_cross(spin, beam->rest[i], beam->integrator.v[i]);
        for (int c = 0; c < 3; c++) beam->integrator.v[i][c] += 0.5 * c + 0.5 * beam_random(&seed);
    }
    double linear[3], angular[3], first_linear[3], first_angular[3];
    momenta(&beam->integrator, first_linear, first_angular);
    for (int step = 0; step < 400; step++) assert_true(integrator_step(&beam->integrator));
    momenta(&beam->integrator, linear, angular);
    for (int c = 0; c < 3; c++) {
        assert_near(linear[c], first_linear[c], 1e-6 * vec3_length(first_linear));
        assert_near(angular[c], first_angular[c], 1e-4 * vec3_length(first_angular));
    }
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
        beam_open(&beam, (const int[3]){3, 3, 3}, 1 / 3.0, material_from(1e5, 0.35), true);
        integrator_create(&beam.integrator, &beam.body, 0.02);
        beam.integrator.mass_damping = 2;
        beam.integrator.stiffness_damping = 0.02;
        beam.integrator.tolerance = 1e-6;
        for (int i = 0; i < beam.nodes; i++) {
            for (int c = 0; c < 3 && !beam.body.pinned[i]; c++) beam.integrator.x[i][c] = 0.5 + beam_random(&numbers);
        }
        double(*force)[3] = calloc((size_t)beam.nodes, sizeof *force);
        body_forces(&beam.body, (const double(*)[3])beam.integrator.x, force);
        assert_true(count_inverted(&beam.body) > 50); // of 162
        for (int step = 0; step < 500; step++) assert_true(integrator_step(&beam.integrator));
        body_forces(&beam.body, (const double(*)[3])beam.integrator.x, force);
        assert_int_equal(count_inverted(&beam.body), 0);
        for (int i = 0; i < 3 * beam.nodes; i++) {
            assert_near(vec3_flat(beam.integrator.x)[i], vec3_flat(beam.rest)[i], 1e-3);
        }
        free(force);
        beam_close(&beam);
    }
}

/// At rest Rayleigh's damping takes e^(−ζωt) off the first mode's swing.
BEAM_TEST(damping_is_the_ratio_asked_for,
          beam_open(beam, (const int[3]){6, 1, 2}, 0.2, material_from(1e5, 0.3), true))
{
    const double ratio = 0.05;
    const int period = 100, periods = 5;
    modes_create(&beam->modes, &beam->body, 1);
    double omega = 2 * pi * beam->modes.frequency[0];
    integrator_create(&beam->integrator, &beam->body, 1 / beam->modes.frequency[0] / period);
    beam->integrator.mass_damping = ratio * omega;
    beam->integrator.stiffness_damping = ratio / omega;
    double start = 0, end = 0;
    for (int i = 0; i < beam->nodes; i++) {
        for (int c = 0; c < 3; c++) beam->integrator.x[i][c] += 1e-4 * beam->modes.shape[i][c];
    }
    for (int step = 0; step < period * periods; step++) {
        assert_true(integrator_step(&beam->integrator));
        double swing = coordinate(&beam->integrator, beam->modes.shape);
        if (step < period) start = fmax(start, swing);
        if (step >= period * (periods - 1)) end = fmax(end, swing);
    }
    // From one period's largest swing (its end: the start is a peak before the first step) to the last one's.
    assert_near(log(start / end) / (2 * pi * ratio * (periods - 1)), 1, 0.02);
}

/// A free body's six rigid motions are no modes, and its first real one is that of dsygvd.
BEAM_TEST(modes_of_a_free_body_leave_out_the_rigid_ones,
          beam_open(beam, (const int[3]){4, 2, 1}, 0.3, material_from(1e5, 0.3), false))
{
    double *values;
    dense_eigenvalues(beam, 1e5, 0.3, &values);
    modes_create(&beam->modes, &beam->body, 12);
    assert_int_equal(beam->modes.count, 12);
    for (int k = 0; k < 12; k++) assert_near(beam->modes.frequency[k] / (sqrt(values[k + 6]) / (2 * pi)), 1, 1e-7);
    for (int k = 0; k < 144; k++) { // they diagonalise the mass
        double dot = 0;
        const double *p = beam->modes.shape[k / 12 * beam->nodes], *q = beam->modes.shape[k % 12 * beam->nodes];
        for (int i = 0; i < 3 * beam->nodes; i++) dot += p[i] * beam->body.mass[i / 3] * q[i];
        assert_near(dot, k / 12 == k % 12, 1e-8);
    }
    free(values);
}
