/// Poles and coefficients of a block of samples, in loops that vectorise: sine, cosine and exponential by polynomials.
//
// With the half angle φ = Im s h / 2 and α = Re s h, without cancellation at high sample rates,
//
//     λ − 1 = expm1 α − 2 e^α sin² φ + 2j e^α sin φ cos φ.
#include "spline/poles_block.h"
#include "spline/wide.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

/// Larger angles and exponents are left to the mathematics library.
static const double largest_angle = 1e4, largest_exponent = 600;

/// Adding it rounds to an integer, which is then in the lowest bits.
#define ROUNDER 0x1.8p52

static inline uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/// eˣ = scale (1 + grown): x = n ln 2 + r, scale 2ⁿ, Taylor's series of r to the last digit.
static inline double grown_near(double x, double *scale)
{
    const double shifted = x * 0x1.71547652b82fep0 + ROUNDER, n = shifted - ROUNDER;
    const double r = (x - n * 0x1.62e42feep-1) - n * 0x1.a39ef35793c76p-33;
    double s = 1.0 / 6227020800;
    s = s * r + 1.0 / 479001600;
    s = s * r + 1.0 / 39916800;
    s = s * r + 1.0 / 3628800;
    s = s * r + 1.0 / 362880;
    s = s * r + 1.0 / 40320;
    s = s * r + 1.0 / 5040;
    s = s * r + 1.0 / 720;
    s = s * r + 1.0 / 120;
    s = s * r + 1.0 / 24;
    s = s * r + 1.0 / 6;
    s = s * r + 0.5;
    *scale = double_of((bits_of(shifted) + 1023) << 52);
    return r + r * r * s;
}

static inline double expm1_near(double x)
{
    double scale;
    const double grown = grown_near(x, &scale);
    return scale * grown + (scale - 1);
}

static inline double exp_near(double x)
{
    double scale;
    const double grown = grown_near(x, &scale);
    return scale * grown + scale;
}

/// sin x and cos x: x = q π/2 + r, series of r.
static inline void sine_cosine(double x, double *sine, double *cosine)
{
    const double shifted = x * 0x1.45f306dc9c883p-1 + ROUNDER, q = shifted - ROUNDER;
    const double r = ((x - q * 0x1.921fb544p0) - q * 0x1.0b4611a4p-34) - q * 0x1.13198a2e03707p-69, z = r * r;
    double s = -1.0 / 1307674368000;
    s = s * z + 1.0 / 6227020800;
    s = s * z - 1.0 / 39916800;
    s = s * z + 1.0 / 362880;
    s = s * z - 1.0 / 5040;
    s = s * z + 1.0 / 120;
    s = s * z - 1.0 / 6;
    double c = 1.0 / 20922789888000;
    c = c * z - 1.0 / 87178291200;
    c = c * z + 1.0 / 479001600;
    c = c * z - 1.0 / 3628800;
    c = c * z + 1.0 / 40320;
    c = c * z - 1.0 / 720;
    c = c * z + 1.0 / 24;
    const double of_sine = r + r * z * s, of_cosine = (1 - 0.5 * z) + z * z * c;
    const uint64_t quarter = bits_of(shifted);
    const double first = quarter & 1 ? of_cosine : of_sine, second = quarter & 1 ? of_sine : of_cosine;
    *sine = double_of(bits_of(first) ^ (quarter & 2) << 62);
    *cosine = double_of(bits_of(second) ^ ((quarter + 1) & 2) << 62);
}

/// Both poles times h: real parts, and half angles.
typedef struct exponents {
    double real[2][POLES_BLOCK], half[2][POLES_BLOCK];
} exponents;

static void load(wiggly_param param, int from, int count, double *out)
{
    for (int i = 0; i < count; i++) {
        double value = param.track ? param.track[from + i] : param.value;
        out[i] = value > 0 ? value : 0.0;
    }
}

WIDEST static void set_complex(const double *restrict f, const double *restrict z, const double *restrict b,
                               double floor, double h, int count, poles_block *restrict block, exponents *restrict e)
{
    for (int i = 0; i < count; i++) {
        double omega = 2 * 3.14159265358979323846 * f[i], zeta = z[i] > floor ? z[i] : floor;
        double beta = b[i] < 1 ? b[i] : 1;
        zeta = zeta < 1 ? zeta : 1;
        double root = sqrt((1 - zeta) * (1 + zeta)), centre = omega * root, turn = omega * beta;
        double sum = root + beta;
        double lower = ((1 - beta) * (1 + beta) - zeta * zeta) / (sum > 0 ? sum : 1);
        block->natural[i] = omega;
        block->centre[i] = centre;
        e->real[0][i] = e->real[1][i] = -zeta * omega * h;
        e->half[0][i] = 0.5 * h * (centre + turn);
        e->half[1][i] = 0.5 * h * (zeta < 1 ? omega * lower : -turn);
    }
}

WIDEST static void set_real(const double *restrict omega, const double *restrict sigma, double h, int count,
                            poles_block *restrict block, exponents *restrict e)
{
    for (int i = 0; i < count; i++) {
        bool swings = sigma[i] <= omega[i];
        double difference = swings ? omega[i] - sigma[i] : sigma[i] - omega[i];
        double root = sqrt(difference) * sqrt(omega[i] + sigma[i]), fast = sigma[i] + root;
        double slow = omega[i] * (omega[i] / (fast > 0 ? fast : 1));
        block->natural[i] = omega[i];
        block->centre[i] = swings ? root : 0;
        e->real[0][i] = -h * (swings ? sigma[i] : slow);
        e->real[1][i] = -h * (swings ? sigma[i] : fast);
        e->half[0][i] = swings ? 0.5 * h * root : 0;
        e->half[1][i] = -e->half[0][i];
    }
}

/// Coefficients of exponents; `alike` where both poles decay alike, which halves what there is to do.
static inline void to_coefficients(const exponents *restrict e, int count, bool alike, poles_block *restrict block)
{
    for (int i = 0; i < count; i++) {
        double mu_re[2], mu_im[2], grown = 0;
        for (int k = 0; k < 2; k++) {
            double s, c;
            if (k == 0 || !alike) grown = expm1_near(e->real[k][i]);
            sine_cosine(e->half[k][i], &s, &c);
            mu_re[k] = grown - 2 * (1 + grown) * (s * s);
            mu_im[k] = 2 * (1 + grown) * (s * c);
        }
        block->exponent[i] = -(e->real[0][i] + e->real[1][i]);
        block->m_re[i] = mu_re[0] + mu_re[1];
        block->m_im[i] = mu_im[0] + mu_im[1];
        block->p_re[i] = mu_re[0] * mu_re[1] - mu_im[0] * mu_im[1];
        block->p_im[i] = mu_re[0] * mu_im[1] + mu_im[0] * mu_re[1];
    }
}

WIDEST static void set_coefficients(const exponents *restrict e, int count, poles_block *restrict block)
{
    to_coefficients(e, count, false, block);
}

WIDEST static void set_alike_coefficients(const exponents *restrict e, int count, poles_block *restrict block)
{
    to_coefficients(e, count, true, block);
}

/// What is out of the polynomials' reach, one by one.
static void fill_each(const wiggly_desc *desc, int from, int count, double floor, poles_block *block)
{
    for (int i = 0; i < count; i++) {
        poles at = poles_at(desc, from + i, floor);
        coefficients c = poles_coefficients(&at, desc->step);
        block->natural[i] = at.natural;
        block->centre[i] = at.centre;
        block->exponent[i] = poles_weight_exponent(&at, desc->step);
        block->m_re[i] = c.m.re, block->m_im[i] = c.m.im;
        block->p_re[i] = c.p.re, block->p_im[i] = c.p.im;
    }
}

WIDEST static bool is_within_reach(const exponents *e, int count)
{
    int64_t beyond = 0; // as wide as what it comes from
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < count; i++) beyond |= fabs(e->half[k][i]) <= largest_angle ? 0 : 1;
        for (int i = 0; i < count; i++) beyond |= -e->real[k][i] <= largest_exponent ? 0 : 1;
    }
    return beyond == 0;
}

/// Frequencies and exponents; the block's coefficients are not touched.
static void set_exponents(const wiggly_desc *desc, int from, int count, double floor, poles_block *block,
                          exponents *e)
{
    double a[POLES_BLOCK], b[POLES_BLOCK], c[POLES_BLOCK];
    if (desc->mode == WIGGLY_COMPLEX) {
        load(desc->frequency, from, count, a);
        load(desc->damping, from, count, b);
        load(desc->bandwidth, from, count, c);
        set_complex(a, b, c, floor, desc->step, count, block, e);
    } else {
        load(desc->frequency, from, count, a);
        load(desc->damping, from, count, b);
        for (int i = 0; i < count; i++) a[i] *= 2 * 3.14159265358979323846, b[i] = fmax(b[i], floor) * a[i];
        set_real(a, b, desc->step, count, block, e);
    }
}

void poles_block_centres(const wiggly_desc *desc, int from, int count, double floor, double *centre)
{
    exponents e;
    poles_block block;
    for (int i = 0; i < count; i += POLES_BLOCK) {
        int part = count - i < POLES_BLOCK ? count - i : POLES_BLOCK;
        set_exponents(desc, from + i, part, floor, &block, &e);
        bool near = is_within_reach(&e, part);
        for (int k = 0; k < part; k++)
            centre[i + k] = near ? block.centre[k] : poles_at(desc, from + i + k, floor).centre;
    }
}

void poles_block_fill(const wiggly_desc *desc, int from, int count, double floor, poles_block *block)
{
    exponents e;
    set_exponents(desc, from, count, floor, block, &e);
    if (!is_within_reach(&e, count)) {
        fill_each(desc, from, count, floor, block);
        return;
    }
    if (desc->mode == WIGGLY_COMPLEX) {
        set_alike_coefficients(&e, count, block);
    } else {
        set_coefficients(&e, count, block);
    }
    for (int i = 0; i < count; i++)
        block->exponent[i] = block->exponent[i] < HEAVIEST ? block->exponent[i] : HEAVIEST;
}

WIDEST void poles_block_exp(const double *restrict x, int count, double *restrict out)
{
    for (int i = 0; i < count; i++) out[i] = exp_near(x[i]);
}
