/// The analysis by poles on planted oscillations: frequency, damping and shape, whatever the frame rate and noise.
#include "analysis/analysis.h"
#include "planted.h"
#include "with_lapack.h"

enum { VERTICES = 60, COLUMNS = 3 * VERTICES, FRAMES = 384, MOST = 2 };

/// Σ_k Re(Ñ_k z_k^t), with noise.
struct plant {
    int count, frames;
    double fps;
    double frequency[MOST], damping[MOST], size[MOST];
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
        for (int j = 0; j < COLUMNS; j++) {
            double re = bell(&p->state), im = bell(&p->state);
            p->shape[k][j] = p->size[k] * (re + I * im);
        }
        const double omega = 2 * M_PI * p->frequency[k], damping = p->damping[k];
        const double complex pole = omega * (-damping + I * sqrt(1 - damping * damping));
        for (int i = 0; i < p->frames; i++) p->turn[k][i] = cexp(pole * (i / p->fps));
    }
    for (int i = 0; i < p->frames; i++) {
        for (int j = 0; j < COLUMNS; j++) power += pow(swing(p, i, j), 2);
    }
    p->level = p->noise * sqrt(power / (p->frames * COLUMNS));
}

static void analyse(struct analysis *analysis, struct plant *p, int modes)
{
    struct motion motion;
    const struct analysis_plan plan = {ANALYSIS_POLES, p->fps, modes, NULL, NULL, 0};
    make_motion(&motion, p->frames, VERTICES, planted, p);
    assert_done(analysis_create(analysis, &lapack, &motion, &plan, &error));
    motion_close(&motion);
}

/// |⟨Ñ, planted Ñ⟩| / (|Ñ| |planted Ñ|)
static double overlap(const struct component *c, const double complex *shape)
{
    double complex product = 0;
    double a = 0, b = 0;
    for (int j = 0; j < COLUMNS; j++) {
        double complex n = c->shape[j / 3][j % 3];
        product += conj(n) * shape[j];
        a += creal(n * conj(n));
        b += creal(shape[j] * conj(shape[j]));
    }
    return cabs(product) / sqrt(a * b);
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

struct bars {
    double frequency, damping, overlap;
};

static void hold(struct plant p, struct bars bars)
{
    for (int seed = 1; seed <= quick_or_all(1, 3); seed++) {
        struct analysis a;
        grow(&p, (uint32_t)seed);
        analyse(&a, &p, p.count);
        for (int k = 0; k < p.count; k++) {
            const struct component *c = component_near(&a, p.frequency[k]);
            double overlapping = overlap(c, p.shape[k]);
            assert_near(c->frequency / p.frequency[k], 1, bars.frequency);
            assert_near(c->damping / p.damping[k], 1, bars.damping);
            if (!(overlapping >= bars.overlap)) fail_msg("%g Hz: overlap %g", p.frequency[k], overlapping);
        }
        analysis_free(&a);
    }
}

static const double rates[] = {24, 48, 96};
enum { RATES = sizeof rates / sizeof rates[0] };

TEST(a_pole_at_any_rate_and_damping)
{
    static const double dampings[] = {0.02, 0.05, 0.1, 0.2, 0.3}, frequencies[] = {0.7, 2, 8};
    for (int r = 0; r < RATES; r += quick_or_all(2, 1)) {
        for (int d = 0; d < 5; d++) {
            for (int f = 0; f < 3; f++) {
                struct plant p = {1,     (int)(4 * rates[r]), rates[r], {frequencies[f]}, {dampings[d]},
                                  {0.1}, .noise = 0};
                hold(p, (struct bars){1e-6, 1e-5, 1 - 1e-6});
            }
        }
    }
}

TEST(two_poles_are_told_apart)
{
    static const double frequencies[][MOST] = {{2, 2.3}, {2, 6}}, dampings[] = {0.02, 0.05, 0.1, 0.2};
    for (int r = 0; r < RATES; r += quick_or_all(2, 1)) {
        for (int f = 0; f < 2; f++) {
            for (int d = 0; d < 4; d++) {
                struct plant p = {2,
                                  (int)(4 * rates[r]),
                                  rates[r],
                                  {frequencies[f][0], frequencies[f][1]},
                                  {dampings[d], dampings[d]},
                                  {0.1, 0.05},
                                  .noise = 0};
                hold(p, (struct bars){1e-4, 1e-3, 0.9999});
            }
        }
    }
}

TEST(through_noise)
{
    static const double dampings[] = {0.02, 0.05, 0.1, 0.2, 0.3};
    for (int r = 0; r < RATES; r += quick_or_all(2, 1)) {
        for (int d = 0; d < 5; d++) {
            struct plant p = {1, (int)(4 * rates[r]), rates[r], {2}, {dampings[d]}, {0.1}, .noise = 0.8};
            hold(p, (struct bars){0.01, 0.05, 0.98});
        }
        struct plant p = {2, (int)(4 * rates[r]), rates[r], {2, 2.3}, {0.05, 0.05}, {0.1, 0.1}, .noise = 0.2};
        hold(p, (struct bars){0.01, 0.05, 0.99});
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
    struct plant p = {1, 192, 48, {2}, {0.05}, {0.1}, .noise = 0.2};
    grow(&p, 1);
    for (int forced = 0; forced < 2; forced++) {
        const struct analysis_plan plan = {ANALYSIS_POLES, p.fps, 1, NULL, NULL, 0};
        struct motion motion;
        struct analysis a;
        struct knots knots;
        struct error error;
        make_motion(&motion, p.frames, VERTICES, forced ? driven : planted, &p);
        if (!analysis_create(&a, &lapack, &motion, &plan, &error)) fail_msg("%s", error.text);
        const struct component *c = a.components;
        assert_near(c->frequency, forced ? 2.7 : 2, 0.02);
        assert_near(c->damping, forced ? 0 : 0.05, 0.002);
        knots_create(&knots, c, p.fps);
        assert_near(component_error(c, knots.series), knots.error, 0);
        if (!(knots.error <= 1.1 * component_error(c, c->series)))
            fail_msg("%d knots leave %g, the coordinate %g", knots.count, knots.error, component_error(c, c->series));
        assert_true(forced ? knots.count <= KNOTS_MOST : knots.count <= 2);
        knots_free(&knots);
        analysis_free(&a);
        motion_close(&motion);
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
    knots_free(&knots);
}

/// Modes that a burst of the base at 2.75 Hz sets off, and that swing freely from 1.1 s on.
enum { KICKED_FRAMES = 144, KICKED_MODES = 3, KICKED_FREE = 53 };

struct kicked {
    double frequency[KICKED_MODES];
    double series[KICKED_FRAMES][KICKED_MODES];
};

static double burst(double t)
{
    return t < 3 / 2.75 ? pow(sin(M_PI * t * 2.75 / 3), 4) * sin(2 * M_PI * 2.75 * t) : 0;
}

static double kicked(int i, int j, void *user)
{
    const struct kicked *body = user;
    double sum = 0;
    for (int k = 0; k < KICKED_MODES; k++) sum += cos(0.01 * (k + 1) * j + k) * body->series[i][k];
    return sum;
}

/// Each mode answers exactly to short blows.
static void kick(struct kicked *body)
{
    enum { STEPS = 200 };
    const double damping = 0.2, h = 1 / (48.0 * STEPS);
    for (int k = 0; k < KICKED_MODES; k++) {
        const double omega = 2 * M_PI * body->frequency[k];
        const double complex turn = cexp(h * omega * (-damping + I * sqrt(1 - damping * damping)));
        double complex z = 0;
        for (int i = 0; i < KICKED_FRAMES; i++) {
            body->series[i][k] = omega * cimag(z);
            for (int j = 0; j < STEPS; j++) z = (z + h * burst((i + (j + 0.5) / STEPS) / 48)) * turn;
        }
    }
}

static void analyse_kicked(struct analysis *a, struct kicked *body, int first)
{
    const struct analysis_plan plan = {ANALYSIS_POLES, 48, 3, NULL, NULL, first};
    struct motion motion;
    kick(body);
    make_motion(&motion, KICKED_FRAMES, VERTICES, kicked, body);
    assert_done(analysis_create(a, &lapack, &motion, &plan, &error));
    motion_close(&motion);
}

TEST(what_was_driven_has_its_poles_where_it_swings_freely)
{
    struct kicked body = {.frequency = {1.04, 2.2, 4.1}};
    struct analysis a;
    analyse_kicked(&a, &body, KICKED_FREE);
    assert_int_equal(a.count, KICKED_MODES);
    for (int k = 0; k < KICKED_MODES; k++) {
        const struct component *c = component_near(&a, body.frequency[k]);
        assert_near(c->frequency, body.frequency[k], 1e-3 * body.frequency[k]);
        assert_near(c->damping, 0.2, 1e-3);
        double complex shape[COLUMNS];
        for (int j = 0; j < COLUMNS; j++) shape[j] = cos(0.01 * (k + 1) * j + k);
        assert_true(overlap(c, shape) > 0.99);
    }
    assert_true(a.left < 0.02); // 0.14 where time series must keep to their poles while the burst lasts
    analysis_free(&a);
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
    analysis_free(&a);
}

/// 22 Hz at 48 frames a second, and 3.
static double quick(int i, int j, void *user)
{
    (void)user;
    return cos(2 * M_PI * 22 * i / 48.0 + j) * exp(-0.02 * i) + cos(2 * M_PI * 3 * i / 48.0 - j) * exp(-0.01 * i);
}

TEST_OF(struct motion, motion, make_motion(motion, 192, VERTICES, quick, NULL), motion_close(motion),
        motion_near_half_the_rate_is_told)
{
    const struct analysis_plan plan = {ANALYSIS_POLES, 48, 2, NULL, NULL, 0};
    struct analysis a;
    assert_done(analysis_create(&a, &lapack, motion, &plan, &error));
    assert_near(a.fast_share, 1 / 3.0, 0.02); // powers go as 1 / damping
    assert_near(component_near(&a, 22)->frequency, 22, 0.01);
    analysis_free(&a);
}

TESTS_BETWEEN(with_lapack_load, with_lapack_unload)
