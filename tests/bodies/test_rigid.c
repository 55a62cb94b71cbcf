/// What carries a body is taken out of its motion: a planted swing is found as if its base had rested.
#include "analysis/analysis.h"
#include "planted.h"
#include "with_lapack.h"

enum { ACROSS = 4, HIGH = 60, VERTICES = ACROSS * HIGH, FRAMES = 96, FPS = 24, FOOT = 3 };

enum base { WHOLE, KNOWN };

/// A column of vertices that swings at 2 Hz, and how it is carried.
struct carried {
    enum base base;
    double push, sway,
        turn;      ///< along x: m/s²; metres at 1.3 Hz; degrees in all, about an axis that is none of the three
    bool free;     ///< swings without a foot that holds it: each vertex in a direction of its own
    bool pendulum; ///< turns about the edge of its lowest row along x, without bending
    float rest[VERTICES][3];
    double complex shape[VERTICES][3];
    double now[FRAMES][VERTICES][3];
};

static void turn_about(const double axis[3], double angle, double v[3])
{
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2], c = cos(angle), s = sin(angle);
    const double cross[3] = {axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                             axis[0] * v[1] - axis[1] * v[0]};
    for (int i = 0; i < 3; i++) v[i] = c * v[i] + s * cross[i] + (1 - c) * along * axis[i];
}

static void carry(struct carried *b)
{
    static const double axis[3] = {0.6, 0, 0.8};
    const double complex pole = 2 * M_PI * 2 * (-0.05 + I * sqrt(1 - 0.05 * 0.05));
    uint32_t random = 7;
    for (int v = 0; v < VERTICES; v++) {
        const int row = v / ACROSS, above = row < FOOT ? 0 : row - FOOT + 1;
        b->rest[v][0] = 0.1F * (float)(v % 2);
        b->rest[v][1] = 0.05F * (float)row;
        b->rest[v][2] = 0.1F * (float)(v / 2 % 2);
        for (int c = 0; c < 3; c++) {
            const double along[3] = {1, 0, 0.3};
            const double complex own = noise(&random) + I * noise(&random);
            b->shape[v][c] = b->free ? 0.03 * own : 5e-5 * above * above * along[c] * cexp(-I * 0.03 * above);
            if (b->pendulum) b->shape[v][c] = c == 0 ? 0 : 0.1 * (double)(c == 1 ? -b->rest[v][2] : b->rest[v][1]);
        }
    }
    for (int i = 0; i < FRAMES; i++) {
        const double t = (double)i / FPS;
        for (int v = 0; v < VERTICES; v++) {
            double *x = b->now[i][v];
            for (int c = 0; c < 3; c++) x[c] = (double)b->rest[v][c] + creal(b->shape[v][c] * cexp(pole * t));
            turn_about(axis, b->turn * M_PI / 180 * i / (FRAMES - 1), x);
            x[0] += b->push / 2 * t * t + b->sway * sin(2 * M_PI * 1.3 * t);
        }
    }
}

static double carried(int i, int j, void *user)
{
    const struct carried *b = user;
    return b->now[i][j / 3][j % 3];
}

/// |⟨Ñ, planted Ñ⟩| / (|Ñ| |planted Ñ|) of the coordinate that is found.
static double find_overlap(const struct carried *b, const struct motion *motion, const struct rigid *base)
{
    const struct analysis_plan plan = {.method = ANALYSIS_POLES, .fps = FPS, .modes = 1, .base = base};
    struct analysis a;
    double complex product = 0;
    double found = 0, planted = 0;
    assert_done(analysis_create(&a, &lapack, motion, &plan, &error));
    for (int n = 0; n < 3 * VERTICES; n++) {
        const double complex x = a.components[0].shape[n / 3][n % 3], y = b->shape[n / 3][n % 3];
        product += conj(x) * y;
        found += creal(x * conj(x));
        planted += creal(y * conj(y));
    }
    analysis_free(&a);
    return cabs(product) / sqrt(found * planted);
}

static struct surface make_rest(struct carried *b, uint32_t *indices)
{
    for (int v = 0; v < VERTICES; v++) {
        for (int k = 0; k < 3; k++) indices[3 * v + k] = (uint32_t)((v + k) % VERTICES);
    }
    return (struct surface){
        .position = b->rest, .vertex_count = VERTICES, .indices = indices, .index_count = 3 * VERTICES};
}

TEST(a_swing_is_found_on_a_base_that_moves)
{
    static struct carried cases[] = {
        {WHOLE, .push = 0.1, .free = true},
        {WHOLE, .turn = 30, .free = true},
        {WHOLE, .push = 0.1},
        {WHOLE, .turn = 30},
        {KNOWN, .push = 0.1},
        {KNOWN, .sway = 0.1},
        {KNOWN, .turn = 30},
        {KNOWN, .sway = 0.5, .turn = 200},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct carried *b = &cases[k];
        uint32_t indices[3 * VERTICES];
        bool foot[VERTICES];
        struct motion motion;
        struct rigid base;
        struct surface rest = make_rest(b, indices);
        carry(b);
        for (int v = 0; v < VERTICES; v++) foot[v] = v < ACROSS * FOOT;
        make_motion(&motion, FRAMES, VERTICES, carried, b);
        assert_done(rigid_find(&base, &lapack, &motion, &rest, b->base == KNOWN ? foot : NULL, &error));
        assert_true(base.frames == FRAMES && base.whole == (b->base == WHOLE) && base.base_unknown == base.whole);
        if (b->base == KNOWN) assert_near(base.angle, fmin(b->turn, 180), 1.5);
        const double overlap = find_overlap(b, &motion, &base);
        if (!(overlap > (b->base == KNOWN ? 1 - 1e-6 : 0.9998)))
            fail_msg("%g m/s², %g m, %g°: overlap %g", b->push, b->sway, b->turn, overlap);
        rigid_free(&base);
        motion_close(&motion);
    }
}

/// If vertices rest, the base does. One that is a line, and one that only sways a little, leave rigid motions in the coordinate.
TEST(a_base_at_rest_is_left_alone)
{
    static struct carried cases[] = {{0}, {.pendulum = true}, {.sway = 1e-3}};
    for (int k = 0; k < 3; k++) {
        uint32_t indices[3 * VERTICES];
        struct motion motion;
        struct rigid base;
        struct surface rest = make_rest(&cases[k], indices);
        carry(&cases[k]);
        make_motion(&motion, FRAMES, VERTICES, carried, &cases[k]);
        assert_done(rigid_find(&base, &lapack, &motion, &rest, NULL, &error));
        assert_int_equal(base.frames, 0);
        assert_int_equal(base.base_unknown, k > 0);
        const double share = rigid_share((const double complex(*)[3])cases[k].shape, &rest);
        assert_true(k == 1 ? share > 0.999 : share < 0.98);
        rigid_free(&base);
        motion_close(&motion);
    }
}

TESTS_BETWEEN(with_lapack_load, with_lapack_unload)
