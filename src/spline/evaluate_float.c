/// Rows of values between samples, as floats: each from its own interval, in blocks whose sines are computed side by side.
//
// With w_k, Catmull-Rom's weight of sample i + k at u, and no frame that is kept from value to value,
//     x(t) = Σ_k w_k e^{j·turn·(u−k)} x_{i+k},   k = −1 … 2.
#include "spline/evaluate.h"
#include "spline/wide.h"
#include <stdint.h>
#include <string.h>

enum { BLOCK = 32 };

/// What each value of a block is computed from.
typedef struct block {
    double u[BLOCK], turn[BLOCK];
    double y[BLOCK][4], re[BLOCK][4], im[BLOCK][4]; ///< the samples i − 1 … i + 2
} block;

/// Larger angles are left to wiggly_evaluate().
static const double largest_angle = 1e4;

/// With the sign of an integer's power of −1; the integer is in the lowest bits of `shifted`.
static inline double alternate(double x, double shifted)
{
    uint64_t bits, power;
    memcpy(&bits, &x, sizeof bits);
    memcpy(&power, &shifted, sizeof power);
    bits ^= power << 63;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/// Sine and cosine to 1e-10, without branches: angle = q π + r, series of r.
static inline void sine_cosine(double angle, double *sine, double *cosine)
{
    const double shifted = angle * 0x1.45f306dc9c883p-2 + 0x1.8p52, q = shifted - 0x1.8p52;
    const double r = (angle - q * 0x1.921fb544p+1) - q * 0x1.0b4611a626331p-33, z = r * r;
    double s = -1.0 / 1307674368000;
    s = s * z + 1.0 / 6227020800;
    s = s * z - 1.0 / 39916800;
    s = s * z + 1.0 / 362880;
    s = s * z - 1.0 / 5040;
    s = s * z + 1.0 / 120;
    s = s * z - 1.0 / 6;
    double c = -1.0 / 87178291200;
    c = c * z + 1.0 / 479001600;
    c = c * z - 1.0 / 3628800;
    c = c * z + 1.0 / 40320;
    c = c * z - 1.0 / 720;
    c = c * z + 1.0 / 24;
    c = c * z - 0.5;
    *sine = alternate(r + r * z * s, shifted);
    *cosine = alternate(1 + z * c, shifted);
}

static inline void compute(const block *restrict b, int count, double *restrict total)
{
    for (int i = 0; i < count; i++) {
        double u = b->u[i], v = 1 - u, sine, cosine, back_sine, back_cosine;
        sine_cosine(b->turn[i] * u, &sine, &cosine);
        sine_cosine(b->turn[i], &back_sine, &back_cosine);
        double before = -0.5 * u * v * v, here = v * (1 + u * (1 - 1.5 * u));
        double next = u * (1 + v * (1 - 1.5 * v)), last = -0.5 * v * u * u;
        // Horner's way: one turn back for the last sample, another with the next one, one forth for the sample before.
        double a_re = next * b->re[i][2] + last * (back_cosine * b->re[i][3] + back_sine * b->im[i][3]);
        double a_im = next * b->im[i][2] + last * (back_cosine * b->im[i][3] - back_sine * b->re[i][3]);
        double b_re = before * b->re[i][0], b_im = before * b->im[i][0];
        double z_re = here * b->re[i][1] + back_cosine * (a_re + b_re) + back_sine * (a_im - b_im);
        double z_im = here * b->im[i][1] + back_cosine * (a_im + b_im) + back_sine * (b_re - a_re);
        total[i] = before * b->y[i][0] + here * b->y[i][1] + next * b->y[i][2] + last * b->y[i][3] +
                   (cosine * z_re - sine * z_im);
    }
}

/// Fetches what values from number k on are computed from. Returns a bit for each that a neighbour is missing of, that is next to a
/// seam or that the quick sines don't reach.
static inline uint32_t fetch(block *b, const wiggly_curve *curve, double from, double by, int k, int count)
{
    uint32_t alone = 0;
    for (int lane = 0; lane < count; lane++) {
        int i = evaluate_locate(curve, from + by * (k + lane), &b->u[lane]);
        bool inside = i > 0 && i >= curve->first && i + 2 < curve->samples;
        if (!inside) i = 1;
        memcpy(b->y[lane], curve->y + i - 1, sizeof b->y[lane]);
        memcpy(b->re[lane], curve->re + i - 1, sizeof b->re[lane]);
        memcpy(b->im[lane], curve->im + i - 1, sizeof b->im[lane]);
        b->turn[lane] = 0.5 * (curve->omega[i] + curve->omega[i + 1]) * curve->step;
        alone |= (uint32_t) !(inside && fabs(b->turn[lane]) <= largest_angle) << lane;
    }
    return alone;
}

/// Values from number k on of a complex curve of at least four samples.
WIDEST static void write_block(const wiggly_curve *curve, double from, double by, int k, int count, float *out,
                               size_t stride)
{
    block b;
    double total[BLOCK];
    uint32_t alone = fetch(&b, curve, from, by, k, count);
    compute(&b, count, total);
    for (int lane = 0; alone; lane++, alone >>= 1) {
        if (!(alone & 1)) continue;
        wiggly_value value = wiggly_evaluate(curve, from + by * (k + lane));
        total[lane] = value.y + value.re;
    }
    for (int lane = 0; lane < count; lane++) out[(size_t)(k + lane) * stride] = (float)total[lane];
}

void wiggly_evaluate_float(const wiggly_curve *curve, double from, double by, int count, float *out, size_t stride)
{
    if (curve->mode == WIGGLY_COMPLEX && curve->samples >= 4) {
        for (int k = 0; k < count; k += BLOCK)
            write_block(curve, from, by, k, count - k < BLOCK ? count - k : BLOCK, out, stride);
        return;
    }
    for (int k = 0; k < count; k++) {
        wiggly_value value = wiggly_evaluate(curve, from + by * k);
        out[(size_t)k * stride] = (float)(value.y + value.re);
    }
}
