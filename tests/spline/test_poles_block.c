/// The filter by the block against the filter sample by sample: two texts of one formula must not drift apart.
#include "near.h"

#include "spline/poles.h"

enum { SAMPLES = 3 * POLES_BLOCK + 7 };

static double frequency[SAMPLES], damping[SAMPLES], bandwidth[SAMPLES];

static void compare(const wiggly_desc *desc, double floor)
{
    poles_block block;
    for (int from = 0; from < SAMPLES; from += POLES_BLOCK) {
        int count = SAMPLES - from < POLES_BLOCK ? SAMPLES - from : POLES_BLOCK;
        poles_block_fill(desc, from, count, floor, &block);
        for (int i = 0; i < count; i++) {
            poles at = poles_at(desc, from + i, floor);
            coefficients c = poles_coefficients(&at, desc->step);
            double size = sqrt(cplx_norm(at.s[0]) + cplx_norm(at.s[1])) * desc->step,
                   error = 1e-14 * (size + size * size);
            assert_near(block.natural[i], at.natural, 1e-14 * at.natural);
            assert_near(block.centre[i], at.centre, 1e-14 * at.natural);
            assert_near(block.exponent[i], poles_weight_exponent(&at, desc->step), 1e-14 * (1 + size));
            assert_near(block.m_re[i], c.m.re, error);
            assert_near(block.m_im[i], c.m.im, error);
            assert_near(block.p_re[i], c.p.re, error);
            assert_near(block.p_im[i], c.p.im, error);
        }
    }
}

/// From slow at a high sample rate, where all digits are in the difference from 1, to beyond what the polynomials reach.
TEST(blocks_are_samples)
{
    for (int kind = 0; kind < 24; kind++) {
        wiggly_desc desc = wiggly_default_desc();
        double highest = pow(10, kind / 3 - 3);
        for (int i = 0; i < SAMPLES; i++) {
            frequency[i] = highest * (0.5 + 0.5 * sin(0.1 * i));
            damping[i] = 1.3 + 1.4 * sin(0.07 * i);
            bandwidth[i] = 0.5 + 0.6 * sin(0.05 * i);
        }
        desc.samples = SAMPLES;
        desc.mode = kind % 3 == 0 ? WIGGLY_COMPLEX : WIGGLY_REAL;
        desc.frequency.track = frequency;
        desc.damping.track = damping;
        desc.bandwidth.track = bandwidth;
        compare(&desc, 0);
        compare(&desc, 0.05);
    }
}
