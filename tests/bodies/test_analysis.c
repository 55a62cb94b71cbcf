/// The analysis against an independent computation (tests/analysis/reference.py) and against what was planted in the data.
#include "analysis/analysis.h"
#include "analysis/rigid.h"
#include "analysis/spectrum.h"
#include "planted.h"
#include "with_lapack.h"

static void analyse(struct analysis *analysis, const struct motion *motion, double fps, int modes,
                    const double direction[3])
{
    const struct analysis_plan plan = {ANALYSIS_CPCA, fps, modes, direction, NULL, 0};
    assert_done(analysis_create(analysis, &lapack, motion, &plan, &error));
}

enum { REFERENCE_FRAMES = 105, REFERENCE_VERTICES = 20, REFERENCE_VALUES = 8 };

struct reference {
    double values[REFERENCE_VALUES], total, pca1, pca2;
    double complex shape[2][3 * REFERENCE_VERTICES];
};

static void read_reference(struct reference *r)
{
    char what[16], line[256];
    int index, lines = 0;
    double re, im;
    FILE *file = fopen("tests/analysis/reference.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    while (fscanf(file, "%15[^,],%d,%lf,%lf ", what, &index, &re, &im) == 4) {
        if (strcmp(what, "value") == 0) r->values[index] = re;
        if (strcmp(what, "total") == 0) r->total = re;
        if (strcmp(what, "pca1") == 0) r->pca1 = re;
        if (strcmp(what, "pca2") == 0) r->pca2 = re;
        if (strcmp(what, "shape0") == 0) r->shape[0][index] = re + I * im;
        if (strcmp(what, "shape1") == 0) r->shape[1][index] = re + I * im;
        lines++;
    }
    fclose(file);
    assert_int_equal(lines, REFERENCE_VALUES + 3 + 2 * 3 * REFERENCE_VERTICES);
}

/// motion() of reference.py. Called in the file's order, so that the noise is the same.
static double reference_motion(int i, int j, void *state)
{
    double t = i / 60.0;
    double first = (1 + 0.5 * sin(0.7 * j)) * exp(-0.4 * t) * cos(2 * M_PI * 1.3 * t + 1.1 * sin(0.9 * j));
    double second = 0.3 * cos(1.3 * j) * exp(-0.9 * t) * cos(2 * M_PI * 4.1 * t + 0.8 * j);
    return j + first + second + 0.02 * noise(state);
}

TEST(eigenvalues_agree_with_numpy)
{
    static double gram[REFERENCE_FRAMES * REFERENCE_FRAMES], means[3 * REFERENCE_VERTICES];
    struct reference r;
    struct motion motion;
    struct spectrum spectrum;
    double shares[2];
    uint32_t seed = 1;
    read_reference(&r);
    make_motion(&motion, REFERENCE_FRAMES, REFERENCE_VERTICES, reference_motion, &seed);
    assert_done(slabs_gram(&lapack, &motion, NULL, gram, means, &error));
    for (int j = 0; j < 3 * REFERENCE_VERTICES; j++) assert_near(means[j], j, 0.7); // the offset, of less motion
    assert_true(spectrum_create(&spectrum, &lapack, gram, motion.frames));
    assert_true(spectrum_real_shares(&lapack, gram, motion.frames, 2, shares));
    for (int i = 0; i < REFERENCE_VALUES; i++) assert_near(spectrum.values[i], r.values[i], 1e-8 * r.values[i]);
    assert_near(spectrum.total, r.total, 1e-8 * r.total);
    assert_near(shares[0], r.pca1, 1e-10);
    assert_near(shares[1], r.pca2, 1e-10);
    spectrum_free(&spectrum);
    motion_close(&motion);
}

/// The sine of the angle between two complex vectors, which is small where they are one up to a factor.
static double sine_between(const double complex *a, const double complex *b, int count)
{
    double aa = 0, bb = 0, left = 0;
    double complex ab = 0;
    for (int n = 0; n < count; n++) {
        aa += creal(a[n] * conj(a[n]));
        bb += creal(b[n] * conj(b[n]));
        ab += conj(a[n]) * b[n];
    }
    for (int n = 0; n < count; n++) left += pow(cabs(b[n] - ab / aa * a[n]), 2);
    return sqrt(left / bb);
}

TEST(coordinates_agree_with_numpy)
{
    static const double up[] = {0, 1, 0};
    struct reference r;
    struct motion motion;
    struct analysis analysis;
    uint32_t seed = 1;
    read_reference(&r);
    make_motion(&motion, REFERENCE_FRAMES, REFERENCE_VERTICES, reference_motion, &seed);
    analyse(&analysis, &motion, 24, 2, up);
    for (int k = 0; k < 2; k++) {
        const double complex *shape = &analysis.components[k].shape[0][0];
        double sine = sine_between(r.shape[k], shape, 3 * REFERENCE_VERTICES);
        assert_near(sine, 0, 1e-6);
        for (int n = 0; n < 3 * REFERENCE_VERTICES; n++) // scale and gauge too
            assert_near(cabs(shape[n] - r.shape[k][n]), 0, 1e-6);
        assert_near(analysis.components[k].explained, r.values[k] / r.total, 1e-8);
    }
    analysis_free(&analysis);
    motion_close(&motion);
}

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

/// How far the imaginary part of the analytic signal is off, as a part of its own root mean square.
static double transform_error(const struct ringing *r, int frames)
{
    size_t n = (size_t)frames;
    double *gram = malloc(2 * n * n * sizeof *gram), *h = gram + n * n, wrong = 0, right = 0;
    double complex *signal = malloc(n * sizeof *signal);
    struct motion motion;
    double means[3 * RINGING_VERTICES];
    assert_true(gram && signal);
    make_motion(&motion, frames, RINGING_VERTICES, ringing, (void *)(uintptr_t)r);
    assert_done(slabs_gram(&lapack, &motion, NULL, gram, means, &error));
    struct predictor predictor = hilbert_predictor(gram, frames);
    hilbert_transform(&lapack, &predictor, frames, h);
    for (int j = 0; j < 3 * RINGING_VERTICES; j++) {
        double mean = 0;
        for (int s = 0; s < frames; s++) {
            signal[s] = ring(s, j, r);
            mean += creal(signal[s]) / frames;
        }
        for (int t = 0; t < frames; t++) {
            double sum = -cimag(signal[t]);
            for (int s = 0; s < frames; s++) sum += h[(size_t)t * n + (size_t)s] * (creal(signal[s]) - mean);
            wrong += sum * sum;
            right += pow(cimag(signal[t]), 2);
        }
    }
    motion_close(&motion);
    free(signal);
    free(gram);
    return sqrt(wrong / right);
}

/// Whatever the phase at which the record begins and ends, and whatever its rate, the imaginary part is the sine of the same
/// oscillation to within 2.5 % over the whole record, ends included (as a periodic signal 24 %, with mirrored ends 10 to 40 %).
TEST(the_transform_holds_to_the_ends)
{
    for (int phase = 0; phase < 8; phase++) {
        const struct ringing at_24 = {phase * M_PI / 4, 24}, at_120 = {phase * M_PI / 4, 120};
        assert_near(transform_error(&at_24, 96), 0, 0.025);
        assert_near(transform_error(&at_120, 480), 0, 0.025);
    }
}

TEST(frequency_damping_and_gauge)
{
    struct ringing r = {0.4, 24};
    struct motion motion;
    struct analysis analysis;
    make_motion(&motion, 96, RINGING_VERTICES, ringing, &r);
    analyse(&analysis, &motion, 24, 1, NULL);
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
    analysis_free(&analysis);
    motion_close(&motion);
}

/// Vertices of even number bob up and down, odd ones by `lag` later; the record begins at rest.
static double bobbing(int i, int j, void *user)
{
    const double *lag = user;
    double t = i / 30.0, late = j / 3 % 2 ? *lag : 0;
    return j % 3 == 1 ? 0.2 * exp(-0.3 * t) * cos(2 * M_PI * 1.5 * t - late) : 0.01 * j;
}

TEST(what_trails_has_a_negative_argument)
{
    static const double up[] = {0, 1, 0};
    double lag = M_PI / 3;
    struct motion motion;
    struct analysis analysis;
    make_motion(&motion, 120, 40, bobbing, &lag);
    analyse(&analysis, &motion, 30, 1, up);
    const struct component *c = analysis.components;
    double later = carg(c->shape[0][1] * conj(c->shape[1][1]));
    assert_near(later, lag, 0.01);
    assert_near(c->last_lag - c->first_lag, 60, 0.6);
    assert_near(c->reach, 0.2, 0.02); // the largest |R| is at the start
    assert_near(c->direction[1], 1, 0);
    analysis_free(&analysis);
    motion_close(&motion);
}

/// Of a hundred vertices that move alike and trail by 0 … 99 degrees, 5 lead by more than the first lag and 5 trail by more than the
/// last; a vertex that hardly moves is not among them, however late.
TEST(lags_leave_out_a_twentieth_at_each_end)
{
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
    enum { FRAMES = 240 };
    const double omega = 2 * M_PI, ratio = 0.1;
    double complex series[FRAMES];
    for (int i = 0; i < FRAMES; i++) {
        const double t = i / 30.0;
        series[i] = t < 4 ? cexp((-ratio + I * sqrt(1 - ratio * ratio)) * omega * t) : 0.01 * cexp(3 * I * omega * t);
    }
    struct component c = {.frames = FRAMES, .series = series};
    component_fit(&c, 30);
    assert_near(c.frequency, 1, 0.03);
    assert_near(c.damping, ratio, 0.005);
}

/// A wave that travels along 60 vertices, one wavelength long, and noise of up to a fifth of its amplitude on every number.
enum { WAVE_FRAMES = 120, WAVE_VERTICES = 60 };

static double wave(int i, int j)
{
    double envelope = exp(-0.2 * i / 24.0);
    return j % 3 == 0 ? envelope * cos(2 * M_PI * 2 * i / 24.0 - 2 * M_PI * (j / 3) / WAVE_VERTICES) : 0;
}

static double noisy_wave(int i, int j, void *state) { return wave(i, j) + 0.4 * noise(state); }

TEST(one_complex_component_finds_a_travelling_wave)
{
    struct motion motion;
    struct analysis analysis;
    uint32_t seed = 7;
    make_motion(&motion, WAVE_FRAMES, WAVE_VERTICES, noisy_wave, &seed);
    analyse(&analysis, &motion, 24, 1, NULL);
    const struct component *c = analysis.components;
    double left = 0, signal = 0;
    for (int i = 0; i < WAVE_FRAMES; i++) {
        for (int j = 0; j < 3 * WAVE_VERTICES; j++) {
            left += pow(wave(i, j) - creal(c->series[i] * c->shape[j / 3][j % 3]), 2);
            signal += pow(wave(i, j), 2);
        }
    }
    assert_true(1 - left / signal >= 0.99);
    assert_true(analysis.pca1 < 0.6 * analysis.pca2); // real PCA takes two, about equal
    assert_true(c->explained > 0.95 * analysis.pca2); // and both together explain no more
    assert_near(c->frequency, 2, 0.01);
    analysis_free(&analysis);
    motion_close(&motion);
}

static double still(int i, int j, void *user)
{
    (void)i;
    (void)user;
    return 0.25 * j;
}

static double drifting(int i, int j, void *user)
{
    (void)user;
    return 0.1 * i * (1 + j);
}

/// Overdamped: it does not swing.
static double settling(int i, int j, void *user)
{
    (void)user;
    return (1 + j) * exp(-0.1 * i);
}

TEST(what_cannot_be_analysed_gets_one_sentence)
{
    const struct {
        int frames, first;
        sample *at;
        const char *says;
    } cases[] = {
        {20, 0, still, "expected a motion, but nothing moves"},
        {20, 0, drifting, "expected an oscillation, got none; --method cpca takes any motion"},
        {40, 0, settling, "expected an oscillation, got none; --method cpca takes any motion"},
        {40, 25, settling, "expected an oscillation in the 15 frames after the drive, got none; simulate for longer"},
        {7, 0, ringing, "expected 8 to 4096 frames, got 7"},
        {1, 0, ringing, "expected 8 to 4096 frames, got 1"},
        {4097, 0, still, "expected 8 to 4096 frames, got 4097"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ringing r = {0, 24};
        struct motion motion;
        struct analysis analysis;
        make_motion(&motion, cases[i].frames, 2, cases[i].at, &r);
        const struct analysis_plan plan = {ANALYSIS_POLES, 24, 1, NULL, NULL, cases[i].first};
        assert_refusal(analysis_create(&analysis, &lapack, &motion, &plan, &error), cases[i].says);
        motion_close(&motion);
    }
}

/// The fewest frames, one vertex, a move that stops: odd, but not wrong; everything stays finite.
static double stopping(int i, int j, void *user)
{
    (void)user;
    return j == 1 ? 0.1 * (i < 4 ? i : 4) : 0;
}

TEST_OF(struct motion, motion, make_motion(motion, ANALYSIS_FRAMES_MIN, 1, stopping, NULL), motion_close(motion),
        odd_motions_give_finite_numbers)
{
    struct analysis analysis;
    analyse(&analysis, motion, 24, ANALYSIS_FRAMES_MIN, NULL);
    assert_int_equal(analysis.count, ANALYSIS_FRAMES_MIN);
    for (int k = 0; k < analysis.count; k++) {
        const struct component *c = &analysis.components[k];
        assert_true(isfinite(c->frequency) && isfinite(c->damping) && isfinite(c->explained));
        assert_true(isfinite(c->first_lag) && isfinite(c->last_lag) && isfinite(c->reach));
        for (int n = 0; n < 3; n++) assert_true(isfinite(cabs(c->shape[0][n])) && isfinite(c->direction[n]));
    }
    analysis_free(&analysis);
}

TESTS_BETWEEN(with_lapack_load, with_lapack_unload)
