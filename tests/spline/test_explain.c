/// The frequency that explains knots: known oscillations are found again, from knots near their extrema.
#include "near.h"
#include "uniform.h"

#include <wiggly/more.h>

enum { SEEDS = 200, MOST = 8 };

static const double tau = 6.283185307179586;

/// Knots within a frame of the extrema of a damped oscillation, 24 frames a second.
static double plant(int seed, wiggly_mode mode, wiggly_knot knots[MOST], wiggly_desc *desc)
{
    uint64_t state = (uint64_t)seed * 2654435761u + 99;
    for (int i = 0; i < 8; i++) uniform(&state);
    const double f = 0.5 + 1.5 * uniform(&state), damping = 0.15 * uniform(&state),
                 root = sqrt(1 - damping * damping);
    const int count = 5 + (int)(4 * uniform(&state));
    *desc = wiggly_default_desc();
    desc->samples = 400, desc->mode = mode, desc->knots = knots, desc->knot_count = count;
    for (int i = 0; i < count; i++) {
        int frame = (int)lround(5 + i * 12 / (f * root)) + (int)(3 * uniform(&state)) - 1;
        if (i > 0 && frame <= knots[i - 1].sample) frame = knots[i - 1].sample + 1;
        const double t = (frame - 5) / 24.0;
        knots[i] = (wiggly_knot){.sample = frame, .value = exp(-damping * tau * f * t) * cos(tau * f * root * t)};
    }
    return f;
}

static int found(wiggly_mode mode)
{
    int good = 0, runners = 0;
    for (int seed = 0; seed < SEEDS; seed++) {
        wiggly_knot knots[MOST];
        wiggly_desc desc;
        const double f = plant(seed, mode, knots, &desc);
        wiggly_explanation best[2];
        const int count = wiggly_explain(&desc, best);
        assert_true(count >= 1 && (count < 2 || best[0].cost <= best[1].cost));
        runners += count == 2;
        good += fabs(best[0].frequency / f - 1) < 0.05;
    }
    print_message("mode %d: %d of %d within 5 %%, %d with a runner-up\n", (int)mode, good, SEEDS, runners);
    return good;
}

TEST(known_oscillations_are_found_again)
{
    assert_true(found(WIGGLY_COMPLEX) >= 0.9 * SEEDS);
    assert_true(found(WIGGLY_REAL) >= 0.9 * SEEDS);
}

/// Neither the order of knots, nor their scale, nor the rate, nor when they begin, nor what they swing about.
TEST(only_the_shape_counts)
{
    wiggly_knot knots[MOST], other[MOST];
    wiggly_desc desc;
    plant(3, WIGGLY_COMPLEX, knots, &desc);
    wiggly_explanation best[2], again[2];
    wiggly_explain(&desc, best);
    for (int i = 0; i < desc.knot_count; i++) {
        other[i] = knots[desc.knot_count - 1 - i];
        other[i].value = 20 + 7 * other[i].value;
        other[i].sample = 4 * other[i].sample + 800;
    }
    desc.knots = other, desc.samples *= 4, desc.step /= 2, desc.equilibrium.value = 20;
    for (int size = 0; size < 4; size++) {
        const double scale = (const double[]){1, 1e200, 1e298, 1e-200}[size];
        for (int i = 0; i < desc.knot_count; i++) other[i].value *= scale;
        desc.equilibrium.value *= scale;
        assert_true(wiggly_explain(&desc, again) >= 1);
        for (int i = 0; i < desc.knot_count; i++) other[i].value /= scale;
        desc.equilibrium.value /= scale;
        assert_near(again[0].frequency, best[0].frequency / 2, 1e-9);
        assert_near(again[0].damping, best[0].damping, 1e-9);
    }
}

TEST(what_cannot_be_told_is_not)
{
    wiggly_knot knots[MOST];
    wiggly_desc desc;
    wiggly_explanation best[2];
    plant(3, WIGGLY_COMPLEX, knots, &desc);
    desc.knot_count = WIGGLY_FEWEST_EXPLAINED - 1;
    assert_int_equal(wiggly_explain(&desc, best), 0);
    desc.knot_count = 5;
    for (int i = 0; i < 5; i++) knots[i].value = 0;
    assert_int_equal(wiggly_explain(&desc, best), 0);
    static wiggly_knot many[2000];
    for (int i = 0; i < 2000; i++) many[i] = (wiggly_knot){.sample = 6 * i, .value = i % 2 ? 1 : -1};
    desc.samples = 12000, desc.knots = many, desc.knot_count = 2000;
    assert_true(wiggly_explain(&desc, best) >= 1);
    assert_near(best[0].frequency, 2, 0.02);
}

/// What wiggly_solve() would refuse: nothing is read outside the equilibrium's track, nor where there are no knots.
TEST(what_is_not_valid_has_no_frequency)
{
    for (int i = 0; i < 8; i++) {
        wiggly_knot knots[MOST];
        wiggly_desc desc;
        wiggly_explanation best[2];
        plant(3, WIGGLY_COMPLEX, knots, &desc);
        double *track = calloc((size_t)desc.samples, sizeof *track);
        desc.equilibrium.track = track;
        assert_true(wiggly_explain(&desc, best) >= 1);
        if (i == 0) knots[2].sample = 1000000;
        if (i == 1) knots[2].sample = -1;
        if (i == 2) desc.knots = NULL;
        if (i == 3) knots[2].value = NAN;
        if (i == 4) track[7] = INFINITY;
        if (i == 5) knots[2].sample = knots[1].sample;
        if (i == 6) desc.step = -1;
        if (i == 7) desc.knot_count = -1;
        if (wiggly_explain(&desc, best) != 0) fail_msg("case %d", i);
        free(track);
    }
}
