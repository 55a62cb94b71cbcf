/// The analysis against an independent computation (tests/analysis/reference.py), and against what was planted in the data: frequency, damping
/// and shape, whatever the frame rate and noise, on a base that rests or moves.
#include "analysis/analysis.h"
#include "analysis/spectrum.h"
#include "commands/commands.h"
#include "model/figure.h"
#include "model/motion.h"
#include "model/vector.h"
#include "near.h"
#include "temporary.h"
#include "with_lapack.h"
#include <sys/mman.h>
#include <unistd.h>

/// In [-0.5, 0.5); reference.py uses the same.
static double noise(uint32_t *state)
{
    *state = 1664525u * *state + 1013904223u;
    return *state / 4294967296.0 - 0.5;
}

/// Value of column j at frame i.
typedef double sample(int i, int j, void *user);

/// Writes a motion in float64 and opens it.
static void make_motion(struct motion *motion, int frames, int vertices, sample *at, void *user)
{
    char header[128];
    int length = snprintf(header, sizeof header, "{'descr': '<f8', 'fortran_order': False, 'shape': (%d, %d, 3), }\n",
                          frames, vertices);
    const char start[] = {'\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, (char)length, 0};
    const char *path = temporary_path("analysis.npy");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(start, sizeof start, 1, file);
    fwrite(header, (size_t)length, 1, file);
    for (int n = 0; n < 3 * vertices * frames; n++) {
        const double value = at(n / (3 * vertices), n % (3 * vertices), user);
        fwrite(&value, sizeof value, 1, file);
    }
    fclose(file);
    assert_done(motion_open(motion, path, &error));
}

/// Analyses a motion of these samples.
static void analyse(struct analysis *analysis, struct analysis_plan plan, int frames, int vertices, sample *at,
                    void *user)
{
    struct motion motion;
    make_motion(&motion, frames, vertices, at, user);
    assert_done(analysis_create(analysis, &lapack, &motion, &plan, &error));
    motion_close(&motion);
}

static const double up[] = {0, 1, 0};

/// |⟨a, b⟩| / (|a| |b|): 1 where they are one up to a factor.
static double overlap(const double complex *a, const double complex *b, int count)
{
    double complex product = 0;
    double aa = 0, bb = 0;
    for (int n = 0; n < count; n++) {
        product += conj(a[n]) * b[n];
        aa += creal(a[n] * conj(a[n]));
        bb += creal(b[n] * conj(b[n]));
    }
    return cabs(product) / sqrt(aa * bb);
}

// --- against reference.py

enum { REFERENCE_FRAMES = 105, REFERENCE_COLUMNS = 60, REFERENCE_VALUES = 8 };

/// motion() of reference.py. Called in the file's order, so that the noise is the same.
static double reference_motion(int i, int j, void *state)
{
    double t = i / 60.0;
    double first = (1 + 0.5 * sin(0.7 * j)) * exp(-0.4 * t) * cos(2 * M_PI * 1.3 * t + 1.1 * sin(0.9 * j));
    double second = 0.3 * cos(1.3 * j) * exp(-0.9 * t) * cos(2 * M_PI * 4.1 * t + 0.8 * j);
    return j + first + second + 0.02 * noise(state);
}

TEST(eigenvalues_and_coordinates_agree_with_numpy)
{
    static double gram[REFERENCE_FRAMES * REFERENCE_FRAMES], means[REFERENCE_COLUMNS];
    struct {
        double values[REFERENCE_VALUES], total, pca1, pca2;
        double complex shape[2][REFERENCE_COLUMNS];
    } r;
    char what[16], line[256];
    int index, lines = 0;
    double re, im, shares[2];
    FILE *file = fopen("tests/analysis/reference.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (; fscanf(file, "%15[^,],%d,%lf,%lf ", what, &index, &re, &im) == 4; lines++) {
        if (strcmp(what, "value") == 0) r.values[index] = re;
        if (strcmp(what, "total") == 0) r.total = re;
        if (strcmp(what, "pca1") == 0) r.pca1 = re;
        if (strcmp(what, "pca2") == 0) r.pca2 = re;
        if (strncmp(what, "shape", 5) == 0) r.shape[what[5] - '0'][index] = re + I * im;
    }
    fclose(file);
    assert_int_equal(lines, REFERENCE_VALUES + 3 + 2 * REFERENCE_COLUMNS);

    struct motion motion;
    struct spectrum spectrum;
    uint32_t seed = 1;
    make_motion(&motion, REFERENCE_FRAMES, REFERENCE_COLUMNS / 3, reference_motion, &seed);
    assert_done(slabs_gram(&lapack, &motion, NULL, gram, means, &error));
    for (int j = 0; j < REFERENCE_COLUMNS; j++) assert_near(means[j], j, 0.7); // the offset, of less motion
    assert_true(spectrum_create(&spectrum, &lapack, gram, motion.frames));
    assert_true(spectrum_real_shares(&lapack, gram, motion.frames, 2, shares));
    for (int i = 0; i < REFERENCE_VALUES; i++) assert_near(spectrum.values[i], r.values[i], 1e-8 * r.values[i]);
    assert_near(spectrum.total, r.total, 1e-8 * r.total);
    assert_near(shares[0], r.pca1, 1e-10);
    assert_near(shares[1], r.pca2, 1e-10);
    pool_free(&spectrum.pool);

    const struct analysis_plan plan = {ANALYSIS_CPCA, 24, 2, up, NULL, 0, false};
    struct analysis analysis;
    assert_done(analysis_create(&analysis, &lapack, &motion, &plan, &error));
    for (int k = 0; k < 2; k++) {
        const double complex *shape = &analysis.components[k].shape[0][0];
        assert_near(overlap(r.shape[k], shape, REFERENCE_COLUMNS), 1, 1e-12);
        for (int n = 0; n < REFERENCE_COLUMNS; n++) // scale and gauge too
            assert_near(cabs(shape[n] - r.shape[k][n]), 0, 1e-6);
        assert_near(analysis.components[k].explained, r.values[k] / r.total, 1e-8);
    }
    pool_free(&analysis.pool);
    motion_close(&motion);
}

// --- complex PCA

/// Free damped oscillations from the frame on: `start` is the phase with which they begin.
struct ringing {
    double start, fps;
};

enum { RINGING_VERTICES = 4 };

static double complex ring(int i, int j, const struct ringing *r)
{
    double t = i / r->fps, omega = 2 * M_PI * 1.3, zeta = 0.05;
    return exp(-zeta * omega * t) * cexp(I * (omega * sqrt(1 - zeta * zeta) * t + r->start + 0.1 * j)) *
           (1 + 0.02 * j);
}

static double ringing(int i, int j, void *user) { return creal(ring(i, j, user)); }

/// Whatever the phase at which the record begins and ends, and whatever its rate, the imaginary part of the analytic signal is the sine of the
/// same oscillation to within 2.5 % over the whole record, ends included (as a periodic signal 24 %, with mirrored ends 10 to 40 %).
TEST(the_transform_holds_to_the_ends)
{
    for (int c = 0; c < 16; c++) {
        struct ringing r = {c / 2 * M_PI / 4, c % 2 ? 120 : 24};
        const int frames = c % 2 ? 480 : 96;
        const size_t n = (size_t)frames;
        double *gram = malloc(2 * n * n * sizeof *gram), *h = gram + n * n, wrong = 0, right = 0;
        double means[3 * RINGING_VERTICES];
        struct motion motion;
        assert_non_null(gram);
        make_motion(&motion, frames, RINGING_VERTICES, ringing, &r);
        assert_done(slabs_gram(&lapack, &motion, NULL, gram, means, &error));
        struct predictor predictor = hilbert_predictor(gram, frames);
        hilbert_transform(&lapack, &predictor, frames, h);
        for (int j = 0; j < 3 * RINGING_VERTICES; j++) {
            double mean = 0, signal[480];
            for (int s = 0; s < frames; s++) mean += (signal[s] = creal(ring(s, j, &r))) / frames;
            for (int t = 0; t < frames; t++) {
                const double expected = cimag(ring(t, j, &r));
                double sum = -expected;
                for (int s = 0; s < frames; s++) sum += h[(size_t)t * n + (size_t)s] * (signal[s] - mean);
                wrong += sum * sum;
                right += expected * expected;
            }
        }
        if (!(sqrt(wrong / right) < 0.025))
            fail_msg("phase %g at %g a second: %g", r.start, r.fps, sqrt(wrong / right));
        motion_close(&motion);
        free(gram);
    }
}

TEST(frequency_damping_and_gauge)
{
    struct ringing r = {0.4, 24};
    struct analysis analysis;
    analyse(&analysis, (struct analysis_plan){ANALYSIS_CPCA, 24, 1, NULL, NULL, 0, false}, 96, RINGING_VERTICES,
            ringing, &r);
    const struct component *c = analysis.components;
    assert_near(c->frequency, 1.3, 0.01);
    assert_near(c->damping, 0.05, 0.002);
    assert_true(c->explained > 0.999);
    double largest = 0, most = 0;
    double complex squares = 0, sum = 0;
    for (int t = 0; t < c->frames; t++) largest = fmax(largest, cabs(c->series[t]));
    for (int v = 0; v < c->vertices; v++) {
        double complex along = 0;
        for (int k = 0; k < 3; k++) along += c->shape[v][k] * c->direction[k];
        squares += along * along;
        sum += along;
    }
    assert_near(largest, 1, 1e-12);
    assert_near(carg(squares), 0, 1e-9);
    assert_true(creal(sum) >= 0);
    for (int k = 0; k < 3; k++) most = fabs(c->direction[k]) > fabs(most) ? c->direction[k] : most;
    assert_true(most > 0);
    pool_free(&analysis.pool);
}

/// Vertices of even number bob up and down, odd ones by `lag` later; the record begins at rest.
static double bobbing(int i, int j, void *user)
{
    const double *lag = user;
    double t = i / 30.0, late = j / 3 % 2 ? *lag : 0;
    return j % 3 == 1 ? 0.2 * exp(-0.3 * t) * cos(2 * M_PI * 1.5 * t - late) : 0.01 * j;
}

/// What trails has a negative argument. Of a hundred vertices that move alike and trail by 0 … 99 degrees, 5 lead by more than the first lag and
/// 5 trail by more than the last; a vertex that hardly moves is not among them, however late.
TEST(lags_of_what_trails)
{
    double lag = M_PI / 3;
    struct analysis analysis;
    analyse(&analysis, (struct analysis_plan){ANALYSIS_CPCA, 30, 1, up, NULL, 0, false}, 120, 40, bobbing, &lag);
    const struct component *bob = analysis.components;
    assert_near(carg(bob->shape[0][1] * conj(bob->shape[1][1])), lag, 0.01);
    assert_near(bob->last_lag - bob->first_lag, 60, 0.6);
    assert_near(bob->reach, 0.2, 0.02); // the largest |R| is at the start
    assert_near(bob->direction[1], 1, 0);
    pool_free(&analysis.pool);

    enum { VERTICES = 101 };
    double complex shape[VERTICES][3] = {{0}};
    for (int v = 0; v < 100; v++) shape[(37 * v) % 100][1] = 0.2 * cexp(-I * (v * M_PI / 180));
    shape[100][1] = 1e-4 * cexp(-I * (170 * M_PI / 180));
    struct component c = {.vertices = VERTICES, .shape = shape, .direction = {0, 1, 0}};
    component_lags(&c);
    assert_near(c.first_lag, 5, 1.001);
    assert_near(c.last_lag, 94, 1.001);
    assert_near(c.reach, 0.2, 1e-12);
}

/// A swing of 1 Hz that dies down for four seconds; what trembles on at 3 Hz, a hundredth as wide, says little.
TEST(the_fit_goes_by_what_moves_most)
{
    enum { LONG = 240 };
    const double omega = 2 * M_PI, ratio = 0.1;
    double complex series[LONG];
    for (int i = 0; i < LONG; i++) {
        const double t = i / 30.0;
        series[i] = t < 4 ? cexp((-ratio + I * sqrt(1 - ratio * ratio)) * omega * t) : 0.01 * cexp(3 * I * omega * t);
    }
    struct component c = {.frames = LONG, .series = series};
    component_fit(&c, 30);
    assert_near(c.frequency, 1, 0.03);
    assert_near(c.damping, ratio, 0.005);
}

/// A wave that travels along 60 vertices, one wavelength long, and noise of up to a fifth of its amplitude on every number.
enum { WAVE_FRAMES = 120, VERTICES = 60, COLUMNS = 3 * VERTICES };

static double wave(int i, int j)
{
    return j % 3 == 0 ? exp(-0.2 * i / 24.0) * cos(2 * M_PI * 2 * i / 24.0 - 2 * M_PI * (j / 3) / VERTICES) : 0;
}

static double noisy_wave(int i, int j, void *state) { return wave(i, j) + 0.4 * noise(state); }

TEST(one_complex_component_finds_a_travelling_wave)
{
    struct analysis analysis;
    uint32_t seed = 7;
    double left = 0, signal = 0;
    analyse(&analysis, (struct analysis_plan){ANALYSIS_CPCA, 24, 1, NULL, NULL, 0, false}, WAVE_FRAMES, VERTICES,
            noisy_wave, &seed);
    const struct component *c = analysis.components;
    for (int n = 0; n < WAVE_FRAMES * COLUMNS; n++) {
        const int i = n / COLUMNS, j = n % COLUMNS;
        left += pow(wave(i, j) - creal(c->series[i] * c->shape[j / 3][j % 3]), 2);
        signal += pow(wave(i, j), 2);
    }
    assert_true(1 - left / signal >= 0.99);
    assert_true(analysis.pca1 < 0.6 * analysis.pca2); // real PCA takes two, about equal
    assert_true(c->explained > 0.95 * analysis.pca2); // and both together explain no more
    assert_near(c->frequency, 2, 0.01);
    pool_free(&analysis.pool);
}

// --- what is odd

/// `user` is what is asked for: it rests, drifts, or settles without swinging (overdamped); or a vertex moves and stops.
static double oddly(int i, int j, void *user)
{
    switch (*(const char *)user) {
    case 'd':
        return 0.1 * i * (1 + j);
    case 's':
        return (1 + j) * exp(-0.1 * i);
    case 'm':
        return j == 1 ? 0.1 * (i < 4 ? i : 4) : 0;
    default:
        return 0.25 * j;
    }
}

TEST(what_cannot_be_analysed_gets_one_sentence)
{
    static const struct {
        int frames, first;
        char how[8];
        const char *says;
    } rows[] = {
        {20, 0, "rests", "expected a motion, but nothing moves"},
        {20, 0, "drifts", "expected an oscillation, got none; --method cpca takes any motion"},
        {40, 0, "settles", "expected an oscillation, got none; --method cpca takes any motion"},
        {40, 25, "settles",
         "expected an oscillation in the 15 frames after the drive, got none; simulate for longer"},
        {12, 6, "settles", "expected 8 frames or more after the drive stops, got 6"},
        {12, 20, "settles", "expected 8 frames or more after the drive stops, got 0"},
        {7, 0, "drifts", "expected 8 to 4096 frames, got 7"},
        {1, 0, "drifts", "expected 8 to 4096 frames, got 1"},
        {4097, 0, "rests", "expected 8 to 4096 frames, got 4097"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct analysis_plan plan = {ANALYSIS_POLES, 24, 1, NULL, NULL, rows[i].first, false};
        char how[8];
        struct motion motion;
        struct analysis analysis;
        memcpy(how, rows[i].how, sizeof how);
        make_motion(&motion, rows[i].frames, 2, oddly, how);
        assert_refusal(analysis_create(&analysis, &lapack, &motion, &plan, &error), rows[i].says);
        motion_close(&motion);
    }
}

/// The fewest frames, one vertex, a move that stops: odd, but not wrong; everything stays finite.
TEST(odd_motions_give_finite_numbers)
{
    char how[] = "moves";
    struct analysis analysis;
    analyse(&analysis, (struct analysis_plan){ANALYSIS_CPCA, 24, ANALYSIS_FRAMES_MIN, NULL, NULL, 0, false},
            ANALYSIS_FRAMES_MIN, 1, oddly, how);
    assert_int_equal(analysis.count, ANALYSIS_FRAMES_MIN);
    for (int k = 0; k < analysis.count; k++) {
        const struct component *c = &analysis.components[k];
        assert_true(isfinite(c->frequency) && isfinite(c->damping) && isfinite(c->explained));
        assert_true(isfinite(c->first_lag) && isfinite(c->last_lag) && isfinite(c->reach));
        for (int n = 0; n < 3; n++) assert_true(isfinite(cabs(c->shape[0][n])) && isfinite(c->direction[n]));
    }
    pool_free(&analysis.pool);
}

// --- poles

enum { FRAMES = 384, MOST = 2 };

/// Σ_k Re(Ñ_k z_k^t), with noise.
struct plant {
    int count, frames;
    double fps, frequency[MOST], damping, size[MOST];
    double noise;                                            ///< root mean square, relative to that of the swing
    double complex shape[MOST][COLUMNS], turn[MOST][FRAMES]; ///< Ñ_k and z_k^t
    double level;                                            ///< of the noise: its root mean square, metres
    uint32_t state;                                          ///< of the noise
};

/// Normally distributed, of variance 1, near enough: from the sum of four numbers in [-0.5, 0.5).
static double bell(uint32_t *state)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) sum += noise(state);
    return sqrt(3) * sum;
}

static double swing(const struct plant *p, int i, int j)
{
    double sum = 0;
    for (int k = 0; k < p->count; k++) sum += creal(p->shape[k][j] * p->turn[k][i]);
    return sum;
}

static double planted(int i, int j, void *user)
{
    struct plant *p = user;
    return 0.01 * j + swing(p, i, j) + (p->level > 0 ? p->level * bell(&p->state) : 0);
}

static void grow(struct plant *p, uint32_t seed)
{
    double power = 0;
    p->state = seed;
    for (int k = 0; k < p->count; k++) {
        const double complex pole =
            2 * M_PI * p->frequency[k] * (-p->damping + I * sqrt(1 - p->damping * p->damping));
        for (int j = 0; j < COLUMNS; j++) {
            const double re = bell(&p->state), im = bell(&p->state);
            p->shape[k][j] = p->size[k] * (re + I * im);
        }
        for (int i = 0; i < p->frames; i++) p->turn[k][i] = cexp(pole * (i / p->fps));
    }
    for (int n = 0; n < p->frames * COLUMNS; n++) power += pow(swing(p, n / COLUMNS, n % COLUMNS), 2);
    p->level = p->noise * sqrt(power / (p->frames * COLUMNS));
}

/// The component at a frequency.
static const struct component *component_near(const struct analysis *a, double frequency)
{
    const struct component *best = &a->components[0];
    for (int k = 1; k < a->count; k++) {
        if (fabs(a->components[k].frequency - frequency) < fabs(best->frequency - frequency))
            best = &a->components[k];
    }
    return best;
}

/// At any rate and damping; two are told apart; and through noise.
TEST(poles_are_found)
{
    static const double rates[] = {24, 48, 96};
    static const struct {
        int count;
        double frequency[MOST], size[MOST], noise, dampings[6];
        double off, damping_off, overlap; ///< the bars
    } rows[] = {
        {1, {0.7}, {0.1}, 0, {0.02, 0.05, 0.1, 0.2, 0.3}, 1e-6, 1e-5, 1 - 1e-6},
        {1, {2}, {0.1}, 0, {0.02, 0.05, 0.1, 0.2, 0.3}, 1e-6, 1e-5, 1 - 1e-6},
        {1, {8}, {0.1}, 0, {0.02, 0.05, 0.1, 0.2, 0.3}, 1e-6, 1e-5, 1 - 1e-6},
        {2, {2, 2.3}, {0.1, 0.05}, 0, {0.02, 0.05, 0.1, 0.2}, 1e-4, 1e-3, 0.9999},
        {2, {2, 6}, {0.1, 0.05}, 0, {0.02, 0.05, 0.1, 0.2}, 1e-4, 1e-3, 0.9999},
        {1, {2}, {0.1}, 0.8, {0.02, 0.05, 0.1, 0.2, 0.3}, 0.01, 0.05, 0.98},
        {2, {2, 2.3}, {0.1, 0.1}, 0.2, {0.05}, 0.01, 0.05, 0.99},
    };
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        for (int r = 0; r < 3; r += quick_or_all(2, 1)) {
            for (const double *damping = rows[row].dampings; *damping > 0; damping++) {
                for (int seed = 1; seed <= quick_or_all(1, 3); seed++) {
                    struct plant p = {.count = rows[row].count,
                                      .frames = (int)(4 * rates[r]),
                                      .fps = rates[r],
                                      .damping = *damping,
                                      .noise = rows[row].noise};
                    struct analysis a;
                    memcpy(p.frequency, rows[row].frequency, sizeof p.frequency);
                    memcpy(p.size, rows[row].size, sizeof p.size);
                    grow(&p, (uint32_t)seed);
                    analyse(&a, (struct analysis_plan){ANALYSIS_POLES, p.fps, p.count, NULL, NULL, 0, false},
                            p.frames, VERTICES, planted, &p);
                    for (int k = 0; k < p.count; k++) {
                        const struct component *c = component_near(&a, p.frequency[k]);
                        const double f = c->frequency / p.frequency[k] - 1, d = c->damping / *damping - 1,
                                     same = overlap(&c->shape[0][0], p.shape[k], COLUMNS);
                        if (!(fabs(f) <= rows[row].off && fabs(d) <= rows[row].damping_off &&
                              same >= rows[row].overlap))
                            fail_msg("%g Hz, damping %g at %g a second, noise %g: off by %g and %g, overlap %g",
                                     p.frequency[k], *damping, p.fps, p.noise, f, d, same);
                    }
                    pool_free(&a.pool);
                }
            }
        }
    }
}

/// What a harmonic force at 2.7 Hz does to two bodies, the second softer and so behind: the force's own swing, which comes in over half a second, and
/// the bodies' at 2 Hz, which that sets off.
static double driven(int i, int j, void *user)
{
    const struct plant *p = user;
    double t = i / p->fps, ramp = t < 0.5 ? t * t * (3 - 4 * t) * 4 : 1, late = j / 3 % 2 ? 1.2 : 0;
    double force = ramp * sin(2 * M_PI * 2.7 * t - late);
    double own = exp(-0.05 * 2 * M_PI * 2 * t) * sin(2 * M_PI * 2 * t - late / 2);
    return (1 + 0.3 * sin(j)) * (force - 0.3 * own);
}

TEST(few_knots_move_it_so)
{
    struct plant p = {
        .count = 1, .frames = 192, .fps = 48, .frequency = {2}, .damping = 0.05, .size = {0.1}, .noise = 0.2};
    grow(&p, 1);
    for (int forced = 0; forced < 2; forced++) {
        struct analysis a;
        struct knots knots;
        analyse(&a, (struct analysis_plan){ANALYSIS_POLES, p.fps, 1, NULL, NULL, 0, false}, p.frames, VERTICES,
                forced ? driven : planted, &p);
        const struct component *c = a.components;
        assert_near(c->frequency, forced ? 2.7 : 2, 0.02);
        assert_near(c->damping, forced ? 0 : 0.05, 0.002);
        knots_create(&knots, c, p.fps);
        assert_near(component_error(c, knots.series), knots.error, 0);
        double left = 0, whole = 0; // that error, sample by sample
        for (int n = 0; forced && n < p.frames * COLUMNS; n++) {
            const int i = n / COLUMNS, j = n % COLUMNS;
            const double moved = driven(i, j, &p) - a.middle[j / 3][j % 3];
            left += pow(moved - creal(knots.series[i] * c->shape[j / 3][j % 3]), 2);
            whole += moved * moved;
        }
        if (forced) assert_near(sqrt(left / whole) / knots.error, 1, 0.02);
        if (!(knots.error <= 1.1 * component_error(c, c->series)))
            fail_msg("%d knots leave %g, the coordinate %g", knots.count, knots.error, component_error(c, c->series));
        assert_true(forced ? knots.count <= KNOTS_MOST : knots.count <= 2);
        free(knots.series);
        pool_free(&a.pool);
    }
}

/// A swing of 2 Hz that is kicked every ten frames, more often than there are knots: they are exchanged until that helps no more. One round
/// would leave 0.220.
TEST(knots_are_exchanged_more_than_once)
{
    enum { KICKS = 60 };
    double complex series[KICKS], pull[KICKS], shape[1][3] = {{1, -I, 0}}, x = 0;
    struct component c = {
        .frames = KICKS, .vertices = 1, .series = series, .shape = shape, .frequency = 2, .damping = 0.1};
    struct knots knots;
    uint32_t random = 24;
    c.metric = (struct series_metric){.pull = pull, .norm = 2};
    for (int t = 0; t < KICKS; t++) {
        x *= cexp((-0.1 + I) * 2 * M_PI * 2 / 24);
        if (t % 10 == 0) {
            const double kick = noise(&random);
            x += kick + 0.3 * I * noise(&random);
        }
        series[t] = x, pull[t] = conj(x);
        c.metric.power += creal(x * conj(x));
    }
    knots_create(&knots, &c, 24);
    assert_near(knots.error, 0.2093, 1e-3);
    free(knots.series);
}

/// Modes that a burst of the base at 2.75 Hz sets off, and that swing freely from 1.1 s on.
enum { KICKED_FRAMES = 144, KICKED_MODES = 3, KICKED_FREE = 53 };

struct kicked {
    double frequency[KICKED_MODES];
    double series[KICKED_FRAMES][KICKED_MODES];
};

static double kicked(int i, int j, void *user)
{
    const struct kicked *body = user;
    double sum = 0;
    for (int k = 0; k < KICKED_MODES; k++) sum += cos(0.01 * (k + 1) * j + k) * body->series[i][k];
    return sum;
}

/// Each mode answers exactly to short blows.
static void analyse_kicked(struct analysis *a, struct kicked *body, int first)
{
    enum { STEPS = 200 };
    const double damping = 0.2, h = 1 / (48.0 * STEPS);
    for (int k = 0; k < KICKED_MODES; k++) {
        const double omega = 2 * M_PI * body->frequency[k];
        const double complex turn = cexp(h * omega * (-damping + I * sqrt(1 - damping * damping)));
        double complex z = 0;
        for (int i = 0; i < KICKED_FRAMES * STEPS; i++) {
            const double t = (i + 0.5) * h;
            if (i % STEPS == 0) body->series[i / STEPS][k] = omega * cimag(z);
            if (t < 3 / 2.75) z += h * pow(sin(M_PI * t * 2.75 / 3), 4) * sin(2 * M_PI * 2.75 * t);
            z *= turn;
        }
    }
    analyse(a, (struct analysis_plan){ANALYSIS_POLES, 48, 3, NULL, NULL, first, false}, KICKED_FRAMES, VERTICES,
            kicked, body);
}

TEST(what_was_driven_has_its_poles_where_it_swings_freely)
{
    struct kicked body = {.frequency = {1.04, 2.2, 4.1}};
    struct analysis a;
    analyse_kicked(&a, &body, KICKED_FREE);
    assert_int_equal(a.count, KICKED_MODES);
    for (int k = 0; k < KICKED_MODES; k++) {
        const struct component *c = component_near(&a, body.frequency[k]);
        double complex shape[COLUMNS];
        for (int j = 0; j < COLUMNS; j++) shape[j] = cos(0.01 * (k + 1) * j + k);
        assert_near(c->frequency, body.frequency[k], 1e-3 * body.frequency[k]);
        assert_near(c->damping, 0.2, 1e-3);
        assert_true(overlap(&c->shape[0][0], shape, COLUMNS) > 0.99);
    }
    assert_true(a.left < 0.02); // 0.14 where time series must keep to their poles while the burst lasts
    pool_free(&a.pool);
}

/// From the driven frames come three poles, two of them with shapes of 6 and 13 m in antiphase for a motion of 1.2 m.
TEST(motions_that_cancel_are_left_out_and_said)
{
    struct kicked body = {.frequency = {1.04, 2.2, 6.6}};
    struct analysis a;
    analyse_kicked(&a, &body, 0);
    assert_int_equal(a.cancelled, 1);
    for (int k = 0; k < a.count; k++) assert_true(a.components[k].reach < 2);
    assert_true(a.left < 0.2);
    pool_free(&a.pool);
}

/// 22 Hz at 48 frames a second, and 3.
static double quick(int i, int j, void *user)
{
    (void)user;
    return cos(2 * M_PI * 22 * i / 48.0 + j) * exp(-0.02 * i) + cos(2 * M_PI * 3 * i / 48.0 - j) * exp(-0.01 * i);
}

TEST(motion_near_half_the_rate_is_told)
{
    struct analysis a;
    analyse(&a, (struct analysis_plan){ANALYSIS_POLES, 48, 2, NULL, NULL, 0, false}, 192, VERTICES, quick, NULL);
    assert_near(a.fast_share, 1 / 3.0, 0.02); // powers go as 1 / damping
    assert_near(component_near(&a, 22)->frequency, 22, 0.01);
    pool_free(&a.pool);
}

// --- curves

/// A rod that swings about its lower end, and the noise on it: 24 frames a second, 1.3 Hz.
struct rod {
    double angle, damping, noise; ///< radians at first; metres
    uint32_t state;
};

static double rod_at(int i, int j, void *user)
{
    struct rod *r = user;
    const double decay = 2 * M_PI * 1.3 / 24 * i, along = (j / 3 + 1.0) / VERTICES;
    const double angle = r->angle * exp(-r->damping * decay) * cos(decay * sqrt(1 - r->damping * r->damping));
    return (j % 3 == 0 ? along * sin(angle) : j % 3 == 1 ? along * cos(angle) : 0) + r->noise * bell(&r->state);
}

/// Points on an arc are near it, where the largest swing is an eighth of a turn too; a small swing has no curves, nor has one whose curves cannot be
/// told from noise. All lies on the arc: the rest, too.
TEST(what_swings_on_an_arc_is_curved)
{
    static const struct {
        double degrees, damping, noise, straight, left; ///< errors: at least, at most
        bool is_straight;                               ///< as asked for
    } rows[] = {
        {50, 0.03, 0, 0.2, 0.03, false},  {50, 0.05, 0, 0.2, 0.035, false},   {30, 0.03, 0, 0.1, 0.015, false},
        {70, 0.03, 0, 0.25, 0.05, false}, {50, 0.03, 0.01, 0.2, 0.08, false}, {50, 0.03, 0, 0.2, 0.21, true},
        {5, 0.03, 0, 0, 0.03, false},     {10, 0.03, 0.1, 0, 1, false},
    };
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        struct rod r = {rows[row].degrees * M_PI / 180, rows[row].damping, rows[row].noise, 3};
        struct analysis a;
        analyse(&a, (struct analysis_plan){.fps = 24, .modes = 1, .straight = rows[row].is_straight}, 96, VERTICES,
                rod_at, &r);
        const struct component *c = a.components;
        if (!(a.straight >= rows[row].straight && a.left <= rows[row].left && a.left <= a.straight))
            fail_msg("row %zu: error %g, straight %g", row, a.left, a.straight);
        assert_int_equal(c->lift != NULL, rows[row].straight > 0 && !rows[row].is_straight);
        for (int k = 0; c->lift && k < 3; k++) assert_near(a.middle[VERTICES - 1][k], k == 1, 0.05);
        pool_free(&a.pool);
    }
}

// --- how a base carries a body is taken out of its motion

enum { ACROSS = 4, HIGH = 60, COLUMN = ACROSS * HIGH, CARRIED_FRAMES = 96, CARRIED_MOST = 240, FPS = 24, FOOT = 3 };

/// A column of vertices that swings at 2 Hz, and how it is carried.
struct carried {
    bool known;        ///< its foot is named; else it is found as a whole
    double push, sway, ///< along x: m/s²; metres at 1.3 Hz
        turn;          ///< degrees in all, about an axis that is none of the three
    bool free;         ///< swings without a foot that holds it: each vertex in a direction of its own
    bool pendulum;     ///< turns about the edge of its lowest row along x, without bending
    bool rests;        ///< the base is left alone
    double tremble;    ///< of every number: root mean square, metres
    int frames;        ///< CARRIED_FRAMES unless given
    double hz, to,     ///< it swings at 2 Hz unless given, and at the end at another frequency
        phase;         ///< with which it begins
    double sag;        ///< how far the top hangs down, metres
    bool twice, stiff; ///< swings at 3.1 Hz, too, in another shape; swings without lags
    float rest[COLUMN][3];
    double complex shape[COLUMN][3];
};

/// Where it is, of the one that was carried last.
static double carried_to[CARRIED_MOST][COLUMN][3];

static void carry(struct carried *b)
{
    static const double axis[3] = {0.6, 0, 0.8};
    const double hz = b->hz > 0 ? b->hz : 2, damping = b->to > 0 ? 0.01 : 0.05, top = HIGH - FOOT;
    uint32_t random = 7;
    if (b->frames == 0) b->frames = CARRIED_FRAMES;
    for (int v = 0; v < COLUMN; v++) {
        const int row = v / ACROSS, above = row < FOOT ? 0 : row - FOOT + 1;
        b->rest[v][0] = 0.1F * (float)(v % 2);
        b->rest[v][1] = 0.05F * (float)row;
        b->rest[v][2] = 0.1F * (float)(v / 2 % 2);
        for (int c = 0; c < 3; c++) {
            const double along[3] = {1, 0, 0.3};
            const double complex own = noise(&random) + I * noise(&random);
            b->shape[v][c] = b->free ? 0.03 * own : 5e-5 * above * above * along[c];
            if (!b->free && !b->stiff) b->shape[v][c] *= cexp(-I * 0.03 * above);
            if (b->pendulum) b->shape[v][c] = c == 0 ? 0 : 0.1 * (double)(c == 1 ? -b->rest[v][2] : b->rest[v][1]);
        }
    }
    for (int i = 0; i < b->frames; i++) {
        const double t = (double)i / FPS, angle = b->turn * M_PI / 180 * i / (b->frames - 1), s = sin(angle);
        const double sweep = b->to > 0 ? (b->to - b->hz) / 2 * t * i / (b->frames - 1) : 0;
        const double complex turn =
            cexp(2 * M_PI * ((-damping + I * sqrt(1 - damping * damping)) * hz * t + I * sweep) + I * b->phase);
        for (int v = 0; v < COLUMN; v++) {
            const double raised = fmax(v / ACROSS - FOOT + 1, 0) / top;
            double x[3];
            for (int c = 0; c < 3; c++) x[c] = (double)b->rest[v][c] + creal(b->shape[v][c] * turn);
            x[1] -= b->sag * raised * raised;
            if (b->twice) x[2] += 0.15 * sin(2 * M_PI * raised) * exp(-t) * cos(2 * M_PI * 3.1 * t);
            const double along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
            for (int c = 0; c < 3; c++) { // turned about the axis
                const int d = (c + 1) % 3, e = (c + 2) % 3;
                carried_to[i][v][c] =
                    cos(angle) * x[c] + s * (axis[d] * x[e] - axis[e] * x[d]) + (1 - cos(angle)) * along * axis[c];
            }
            carried_to[i][v][0] += b->push / 2 * t * t + b->sway * sin(2 * M_PI * 1.3 * t);
            for (int c = 0; b->tremble > 0 && c < 3; c++) carried_to[i][v][c] += b->tremble * bell(&random);
        }
    }
}

static double carried(int i, int j, void *user)
{
    (void)user;
    return carried_to[i][j / 3][j % 3];
}

/// The column at rest.
static struct surface column(struct carried *b)
{
    static uint32_t indices[3 * COLUMN];
    for (int n = 0; n < 3 * COLUMN; n++)
        indices[n] = (uint32_t)((n / 3 + n % 3 * (n % 3 == 2 ? ACROSS / 2 : 1)) % COLUMN);
    return (struct surface){
        .position = b->rest, .vertex_count = COLUMN, .indices = indices, .index_count = 3 * COLUMN};
}

/// A planted swing is found as if its base had rested. If vertices rest, the base does; one that is a line, and one that only sways a little,
/// leave rigid motions in the coordinate.
TEST(a_swing_is_found_on_a_base_that_moves)
{
    static struct carried rows[] = {
        {.push = 0.1, .free = true},
        {.turn = 30, .free = true},
        {.push = 0.1},
        {.turn = 30},
        {.known = true, .push = 0.1},
        {.known = true, .sway = 0.1},
        {.known = true, .turn = 30},
        {.known = true, .sway = 0.5, .turn = 200},
        {.known = true, .sway = 0.1, .tremble = 3e-3}, // a foot of 0.1 m seems to turn, the column is 3 m high
        {.known = true, .turn = 90, .tremble = 1e-3},  // and does turn
        {.turn = 10, .frames = 12, .tremble = 1e-4},   // a period: a cubic would leave nothing of the swing
        {.push = 0.1, .frames = 18, .tremble = 1e-4},
        {.rests = true},
        {.rests = true, .pendulum = true},
        {.rests = true, .sway = 1e-3},
        {.rests = true, .tremble = 1e-3},
    };
    bool foot[COLUMN];
    for (int v = 0; v < COLUMN; v++) foot[v] = v < ACROSS * FOOT;
    for (struct carried *b = rows; b < rows + sizeof rows / sizeof *rows; b++) {
        carry(b);
        const struct surface rest = column(b);
        struct motion motion;
        struct rigid base;
        struct analysis a;
        make_motion(&motion, b->frames, COLUMN, carried, NULL);
        assert_done(rigid_find(&base, &lapack, &motion, &rest, b->known ? foot : NULL, &error));
        const struct analysis_plan plan = {.method = ANALYSIS_POLES, .fps = FPS, .modes = 1, .base = &base};
        assert_done(analysis_create(&a, &lapack, &motion, &plan, &error));
        const double complex(*shape)[3] = (const double complex(*)[3])a.components[0].shape;
        const double share = rigid_share(shape, &rest);
        if (b->rests) {
            assert_int_equal(base.frames, 0);
            assert_int_equal(base.base_unknown, b->pendulum || b->sway > 0 || b->tremble > 0);
            assert_true(b->pendulum ? share > 0.999 : share < 0.1);
        } else {
            assert_true((base.frames == b->frames || b->frames < CARRIED_FRAMES) && base.whole == !b->known &&
                        base.base_unknown == base.whole);
            if (b->known) assert_near(base.angle, fmin(b->turn, 180), 1.5);
            const double same = overlap(&shape[0][0], &b->shape[0][0], 3 * COLUMN);
            if (!(same > (b->frames < CARRIED_FRAMES ? 0.97 : b->tremble > 0 ? 0.999 : b->known ? 1 - 1e-6 : 0.9998)))
                fail_msg("%g m/s², %g m, %g°, %d frames: overlap %g", b->push, b->sway, b->turn, b->frames, same);
        }
        pool_free(&a.pool);
        pool_free(&base.pool);
        motion_close(&motion);
    }
}

// --- what `wiggly analyze` says of it

/// What analyze says of the column's motion, and wiggly check of the scene that it writes.
static const char *analyze(struct carried *b, const char *options)
{
    static char said[8192];
    char line[2048], scene[512], solved[512], table[512], *words[64], *rest = line;
    struct surface surface;
    struct motion motion;
    int count = 0, kept[2] = {dup(1), dup(2)}, out = memfd_create("said", 0);
    carry(b);
    surface = column(b);
    make_motion(&motion, b->frames, COLUMN, carried, NULL);
    motion_close(&motion);
    snprintf(scene, sizeof scene, "%s", temporary_path("analysis.json"));
    snprintf(solved, sizeof solved, "%s", temporary_path("solved.csv"));
    snprintf(table, sizeof table, "%s", temporary_path("analysis.csv"));
    const char *mesh = temporary_path("column.obj");
    assert_done(obj_write(mesh, &surface, &error));
    snprintf(line, sizeof line, "analyze %s --rest %s --fps %d -o %s --coordinates %s --scene %s%s",
             temporary_path("analysis.npy"), mesh, FPS, temporary_path("analysis.glb"), table, scene, options);
    for (char *word; (word = strsep(&rest, " "));) words[count++] = word;
    words[count] = NULL;
    fflush(NULL);
    for (int i = 0; i < 2; i++) dup2(out, i + 1);
    const int status = command_analyze(count, words) + command_check(2, (char *[]){"check", scene, NULL}) +
                       command_solve(4, (char *[]){"solve", scene, "-o", solved, NULL});
    fflush(NULL);
    for (int i = 0; i < 2; i++) dup2(kept[i], i + 1), close(kept[i]);
    const ssize_t size = pread(out, said, sizeof said - 1, 0);
    assert_true(size > 0);
    said[size] = 0;
    close(out);
    if (status != 0) fail_msg("%s", said);

    // The scene moves as the fit does.
    FILE *files[] = {fopen(table, "r"), fopen(solved, "r")};
    assert_true(files[0] && files[1]);
    for (int i = -1; i < b->frames; i++) {
        double fit[2], is[2];
        assert_true(fgets(line, sizeof line, files[0]) &&
                    (i < 0 || sscanf(line, "%*d,%*f,%*f,%lf,%lf", &fit[0], &fit[1]) == 2));
        assert_true(fgets(line, sizeof line, files[1]) &&
                    (i < 0 || sscanf(line, "%*d,%*f,%lf,%lf", &is[0], &is[1]) == 2));
        for (int k = 0; i >= 0 && k < 2; k++)
            if (!(fabs(is[k] - fit[k]) < 1e-6)) fail_msg("%d: %s %g %g", i, said, is[k], fit[k]);
    }
    for (int i = 0; i < 2; i++) fclose(files[i]);
    return said;
}

TEST(what_analyze_says_is_true)
{
    static struct {
        struct carried body;
        const char *options, *says, *lacks;
    } rows[] = {
        {{.tremble = 1e-3}, "", "frequency 2 Hz", "warning"}, // a beam on a still foot
        {{.tremble = 1e-3}, " --pin 0.11", " m and 0 degrees", "warning"},
        {{.pendulum = true}, "", "100 % of coordinate 1 moves the whole mesh rigidly", "fps can show"},
        {{.sag = 0.1}, "", "its rest is what the motion swings about, up to 0.1 m from ", "warning"},
        {{.sag = 1e-4}, "", "frequency 2 Hz", "swings about"},
        {{.twice = true}, "", "  with --modes 2: ", "cpca"},
        {{.tremble = 0.2}, " --method cpca", "neither more coordinates nor --method cpca", "  with"},
        {{.hz = 0.6, .frames = 20, .phase = 1.57}, "", "frequency 0.6 Hz", "warning"},
        {{.phase = 1.6}, " --shake 1,0,0", "1 knot\n", "warning"},
        {{.stiff = true},
         "",
         "from 0 to 0 degrees, with 5 % of the motion beyond each end\n    parts hardly lag: --lag ",
         "warning"},
        {{.stiff = true}, " --lag 60", "lag over the surface: from 3", "parts hardly lag"},
        {{.hz = 0.5, .to = 8, .frames = CARRIED_MOST}, "", "\"frequency\": 0.5", "warning"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *said = analyze(&rows[i].body, rows[i].options);
        if (!strstr(said, rows[i].says)) fail_msg("row %zu: \"%s\" is not in:\n%s", i, rows[i].says, said);
        if (strstr(said, rows[i].lacks)) fail_msg("row %zu: \"%s\" is in:\n%s", i, rows[i].lacks, said);
        if (!(rows[i].body.sag > 0.01 || strstr(rows[i].options, "--lag"))) continue;

        // What hangs down is the rest; lags grow with the distance from the lowest row that moves by a hundredth of the highest.
        struct character character;
        assert_done(character_read(temporary_path("analysis.glb"), &character, &error));
        const float(*re)[3] = (const float(*)[3])character.coordinates[0].re,
              (*im)[3] = (const float(*)[3])character.coordinates[0].im;
        for (int v = 0; v < COLUMN; v++) {
            const int row = v / ACROSS;
            const double raised = fmax(row - FOOT + 1, 0) / (HIGH - FOOT), low = 7;
            const double complex n = (double)re[v][0] + I * (double)im[v][0];
            assert_near(character.position[v][1], 0.05 * row - rows[i].body.sag * raised * raised, 1e-5);
            assert_near(cabs(n), cabs(rows[i].body.shape[v][0]), 1e-5);
            if (rows[i].body.sag == 0 && row > low)
                assert_near(carg(n) * 180 / M_PI, -60 * (row - low) / (HIGH - 1 - low), 1);
        }
        character_free(&character);
    }
}

/// The volume of a coordinate's character at z, as a share of that at rest, minus 1.
static double growth(const struct figure *figure, double re, double im)
{
    struct morph morph = {0};
    const uint32_t *corner = figure->character.indices;
    double volume[2] = {0};
    morph_add(&morph, figure, 0, (const double[2]){re, im});
    for (int moved = 0; moved < 2; moved++, morph.count = 1) {
        morph.count = moved;
        for (int i = 0; i < figure->character.index_count; i += 3) {
            float at[3][3];
            for (int c = 0; c < 3; c++) morph_vertex(figure, &morph, (int)corner[i + c], at[c], NULL);
            const vec3s normal = glms_vec3_cross(vec3_from(at[1]), vec3_from(at[2]));
            volume[moved] += (double)glms_vec3_dot(vec3_from(at[0]), normal) / 6;
        }
    }
    return volume[1] / volume[0] - 1;
}

/// The bear that swings to the side, as simulated by default but coarser, keeps its volume at twice what was seen: straight shapes make it 8 % larger.
TEST(a_bear_keeps_its_volume)
{
    char *mesh = strdup(temporary_path("bear.obj")), *motion = strdup(temporary_path("bear.npy")),
         *out = strdup(temporary_path("bear.glb"));
    struct character bear;
    assert_done(character_read("assets/models/creature.glb", &bear, &error));
    const struct surface surface = {.position = bear.position,
                                    .vertex_count = bear.vertex_count,
                                    .indices = bear.indices,
                                    .index_count = bear.index_count};
    assert_done(obj_write(mesh, &surface, &error));
    character_free(&bear);
    assert_int_equal(
        command_simulate(14, (char *[]){"simulate", mesh, "--drive", "none", "--shake", "side", "--tets", "400",
                                        "--seconds", "2", "--accuracy", "0.05", "-o", motion, NULL}),
        0);
    for (int straight = 0; straight < 2; straight++) {
        assert_int_equal(command_analyze(6 + straight, (char *[]){"analyze", motion, "--modes", "2", "-o", out,
                                                                  straight ? "--straight" : NULL, NULL}),
                         0);
        assert_done(character_read(out, &bear, &error));
        struct figure figure;
        figure_create(&figure, &bear);
        assert_int_equal(figure.character.coordinates[0].sq == NULL, straight);
        double most = 0;
        for (int quarter = 0; quarter < 4; quarter++)
            most = fmax(most, fabs(growth(&figure, 2 * cos(quarter * M_PI / 2), 2 * sin(quarter * M_PI / 2))));
        if (straight ? most < 0.07 : most > 0.03) fail_msg("%g %% larger", 100 * most);
        figure_free(&figure);
    }
    free(mesh), free(motion), free(out);
}

TESTS_BETWEEN(with_lapack_load, with_lapack_unload)
