/// Fewer knots for nearly the same motion: how few do, and that their curve is as near as was asked for.
#include "near.h"

#include "scene/simplify.h"

enum { SAMPLES = 121, MOST = 60, FIXED = 1 << 0, POSE = 1 << 1, STILL = 1 << 2, SLOPE = 1 << 3, SETTLES = 1 << 4 };

enum shape { SWING, LINE, CUBIC, SINE, ACCENTS };

/// Knots of some shape, with noise as a share of their range, and what is asked of them.
static const struct row {
    const char *name;
    enum shape shape;
    int count, gap; ///< knots, samples from one to the next
    double noise;
    enum wiggly_mode mode;
    enum wiggly_start start;
    double wind_up, frequency;
    double tolerance; ///< share of the range
    bool searches;
    int flags, flagged; ///< of one knot
    int least, most;    ///< knots that stay
    double low;         ///< limit, or 0
    bool straight;      ///< the end is not flat
} rows[] = {
    {"one noisy swing", SWING, 20, 3, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 2, 0.03, true, .least = 3, .most = 5},
    {"of a whole curve", SWING, 20, 3, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0, 2, 0.03, true, .least = 3, .most = 5},
    {"of a spring", SWING, 20, 3, 0.02, WIGGLY_REAL, WIGGLY_FREE, 0, 0.7, 0.03, true, .least = 3, .most = 5},
    {"noisier", SWING, 20, 3, 0.05, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1.2, 0.06, true, .least = 3, .most = 5},
    {"longer", SWING, 60, 2, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 2, 0.03, true, .least = 3, .most = 5},
    {"without a search", SWING, 20, 3, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 2, 0.03, .least = 10, .most = 19},
    {"less noise than that", SWING, 20, 3, 0.05, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.003, .least = 15, .most = 20},
    {"a line", LINE, 20, 3, 0, WIGGLY_CUBIC, WIGGLY_FREE, 0, 0, 1e-6, .least = 2, .most = 2, .straight = true},
    {"a line with a flat end", LINE, 20, 3, 0, WIGGLY_CUBIC, WIGGLY_FREE, 0, 0, 0.2, .least = 2, .most = 2},
    {"a cubic", CUBIC, 19, 5, 0, WIGGLY_CUBIC, WIGGLY_FREE, 0, 0, 1e-6, .least = 5, .most = 7},
    {"a noisy cubic", CUBIC, 19, 5, 0.02, WIGGLY_CUBIC, WIGGLY_FREE, 0, 0, 0.03, .least = 4, .most = 6},
    {"accents", ACCENTS, 40, 3, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.03, true, .least = 5, .most = 8},
    {"a sine", SINE, 24, 5, 0.01, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.02, true, .least = 3, .most = 8},
    {"a loop", SINE, 24, 5, 0.01, WIGGLY_COMPLEX, WIGGLY_LOOP, 0.5, 1, 0.02, true, .least = 2, .most = 12},
    {"a pose", SWING, 20, 3, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.04, true, POSE, 9, .least = 4, .most = 12},
    {"a still knot", SWING, 20, 3, 0, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.05, true, STILL, 19, .least = 3,
     .most = 9},
    {"a fixed knot", SWING, 20, 3, 0.02, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.04, false, FIXED, 9, .least = 4,
     .most = 14},
    {"a limit", SWING, 20, 3, 0, WIGGLY_COMPLEX, WIGGLY_FREE, 0, 1, 0.03, true, .least = 3, .most = 9, .low = -0.9},
    {"one knot", LINE, 1, 1, 0, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.1, true, .least = 1, .most = 1},
    {"more than are searched", SINE, 120, 1, 0.01, WIGGLY_COMPLEX, WIGGLY_FREE, 0.5, 1, 0.004, true, .least = 34,
     .most = 119},
};

static double noise(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / (double)(1 << 23) - 1;
}

static double value_of(const struct row *row, double sample, const double *accents)
{
    const double t = sample / 24, w = 2 * M_PI;
    switch (row->shape) {
    case SWING:
        return exp(-0.12 * w * t) * cos(w * t + 0.7);
    case LINE:
        return t;
    case SINE:
        return sin(w * sample / 60);
    default:
        return accents[(int)sample];
    }
}

static void solve(const wiggly_desc *desc, double *total)
{
    wiggly_solver *solver;
    wiggly_curve curve = {.size = sizeof curve, .total = total};
    assert_int_equal(wiggly_create(desc->samples, desc->knot_count + desc->samples, &solver), WIGGLY_OK);
    assert_true(wiggly_solve(solver, desc, &curve) < WIGGLY_ERROR_ARGUMENT);
    wiggly_destroy(solver);
}

static wiggly_desc describe(const struct row *row, wiggly_knot *knots, unsigned seed)
{
    static const wiggly_knot few[] = {{.sample = 0},
                                      {.sample = 15, .value = 1},
                                      {.sample = 45, .value = 0.8},
                                      {.sample = 60, .value = -0.5},
                                      {.sample = 90, .value = 0.2}};
    wiggly_desc desc = wiggly_default_desc();
    double accents[SAMPLES], low = INFINITY, high = -INFINITY;
    desc.samples = SAMPLES;
    desc.mode = row->mode;
    desc.frequency.value = 1.3;
    desc.damping.value = 0.15;
    desc.wind_up = row->wind_up;
    desc.knots = few;
    desc.knot_count = 5;
    solve(&desc, accents);
    for (int k = 0; k < row->count; k++) {
        knots[k] = (wiggly_knot){.sample = k * row->gap, .value = value_of(row, k * row->gap, accents)};
        low = fmin(low, knots[k].value);
        high = fmax(high, knots[k].value);
    }
    for (int k = 0; k < row->count; k++) knots[k].value += row->noise * (high - low) * noise(&seed);
    for (int k = 0; k < row->count && row->low < 0; k++) knots[k].value = fmax(knots[k].value, row->low);
    desc.knots = knots;
    desc.knot_count = row->count;
    desc.start = row->start;
    desc.frequency.value = row->frequency;
    desc.damping.value = 0.1;
    desc.has_low = row->low < 0;
    desc.low = row->low;
    desc.high = INFINITY;
    desc.passive = row->straight ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    return desc;
}

/// Of several noises: the knots that stay are few, their curve is within the tolerance, and what is held is as it was.
TEST(a_few_knots_do)
{
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const struct row *row = &rows[r];
        for (unsigned seed = 1; seed <= (unsigned)quick_or_all(1, 30); seed++) {
            wiggly_knot knots[2 * MOST], left[2 * MOST];
            bool fixed[2 * MOST] = {false};
            double total[SAMPLES];
            wiggly_desc desc = describe(row, knots, seed);
            wiggly_knot *held = &knots[row->flagged];
            fixed[row->flagged] = row->flags & FIXED;
            held->has_phase = row->flags & POSE;
            held->phase = 0.1;
            held->still = row->flags & STILL;
            struct simplify *s = simplify_open(&desc, fixed, row->searches);
            const double tolerance = row->tolerance * s->range;
            simplify_within(s, tolerance);
            if (s->left < row->least || s->left > row->most)
                fail_msg("%s, seed %u: %d of %d knots stay, expected %d to %d", row->name, seed, s->left, s->count,
                         row->least, row->most);
            int count = 0;
            for (int k = 0; k < s->count; k++) {
                if (s->stays[k]) left[count++] = s->knots[k];
                assert_int_equal(s->knots[k].sample, knots[k].sample);
            }
            assert_int_equal(count, s->left);
            assert_true(!row->flags ||
                        (s->stays[row->flagged] && memcmp(&s->knots[row->flagged], held, sizeof *held) == 0));
            desc.knots = left;
            desc.knot_count = count;
            desc.frequency = s->desc.frequency;
            desc.damping = s->desc.damping;
            solve(&desc, total);
            for (int k = 0; k < s->count; k++) {
                if (knots[k].still || fabs(total[knots[k].sample] - knots[k].value) <= tolerance * 1.001 + 1e-9)
                    continue;
                fail_msg("%s, seed %u: the curve misses knot %d by %g of %g", row->name, seed, k,
                         total[knots[k].sample] - knots[k].value, tolerance);
            }
            simplify_close(s);
        }
    }
}

/// The same again gives the same, and what stays at a larger tolerance is not more.
TEST(a_larger_tolerance_leaves_no_more)
{
    wiggly_knot knots[MOST];
    const bool fixed[MOST] = {false};
    const wiggly_desc desc = describe(&rows[0], knots, 5);
    struct simplify *s = simplify_open(&desc, fixed, true);
    int last = MOST;
    for (double tolerance = 0; tolerance < 0.3; tolerance += 0.02) {
        simplify_within(s, tolerance);
        const int left = s->left;
        const double frequency = s->desc.frequency.value;
        assert_true(left <= last);
        simplify_within(s, 0.3 - tolerance);
        simplify_within(s, tolerance);
        assert_int_equal(s->left, left);
        assert_near(s->desc.frequency.value, frequency, 0);
        last = left;
    }
    simplify_within(s, 0);
    assert_int_equal(s->left, 20);
    for (int k = 0; k < 20; k++) assert_near(s->knots[k].value, knots[k].value, 0);
    simplify_close(s);
}
