/// exp, sin, log and others: an argument is reduced exactly, then a polynomial of least error follows, and what rounding lost of the largest
/// term is added to the small ones. Errors stay near half a unit in the last place.
#include "maths/maths.h"
#include "maths/wide.h"
#include <stdbool.h>
#include <stdlib.h>

/// Adding it rounds a number below 2⁵¹ to an integer, in the sum's last bits.
static const double rounder = 0x1.8p52;

// --- exp: x = (32 k + j) ln 2 / 32 + r, e^x = 2^k 2^{j/32} e^r, |r| < 0.011 ---------------------------------------------

/// 2^{j/32} in two parts.
static const double roots[32][2] = {
    {0x1.0000000000000p+0, 0x0.0p+0},
    {0x1.059b0d3158574p+0, 0x1.d73e2a475b465p-55},
    {0x1.0b5586cf9890fp+0, 0x1.8a62e4adc610bp-54},
    {0x1.11301d0125b51p+0, -0x1.6c51039449b3ap-54},
    {0x1.172b83c7d517bp+0, -0x1.19041b9d78a76p-55},
    {0x1.1d4873168b9aap+0, 0x1.e016e00a2643cp-54},
    {0x1.2387a6e756238p+0, 0x1.9b07eb6c70573p-54},
    {0x1.29e9df51fdee1p+0, 0x1.612e8afad1255p-55},
    {0x1.306fe0a31b715p+0, 0x1.6f46ad23182e4p-55},
    {0x1.371a7373aa9cbp+0, -0x1.63aeabf42eae2p-54},
    {0x1.3dea64c123422p+0, 0x1.ada0911f09ebcp-55},
    {0x1.44e086061892dp+0, 0x1.89b7a04ef80d0p-59},
    {0x1.4bfdad5362a27p+0, 0x1.d4397afec42e2p-56},
    {0x1.5342b569d4f82p+0, -0x1.07abe1db13cadp-55},
    {0x1.5ab07dd485429p+0, 0x1.6324c054647adp-54},
    {0x1.6247eb03a5585p+0, -0x1.383c17e40b497p-54},
    {0x1.6a09e667f3bcdp+0, -0x1.bdd3413b26456p-54},
    {0x1.71f75e8ec5f74p+0, -0x1.16e4786887a99p-55},
    {0x1.7a11473eb0187p+0, -0x1.41577ee04992fp-55},
    {0x1.82589994cce13p+0, -0x1.d4c1dd41532d8p-54},
    {0x1.8ace5422aa0dbp+0, 0x1.6e9f156864b27p-54},
    {0x1.93737b0cdc5e5p+0, -0x1.75fc781b57ebcp-57},
    {0x1.9c49182a3f090p+0, 0x1.c7c46b071f2bep-56},
    {0x1.a5503b23e255dp+0, -0x1.d2f6edb8d41e1p-54},
    {0x1.ae89f995ad3adp+0, 0x1.7a1cd345dcc81p-54},
    {0x1.b7f76f2fb5e47p+0, -0x1.5584f7e54ac3bp-56},
    {0x1.c199bdd85529cp+0, 0x1.11065895048ddp-55},
    {0x1.cb720dcef9069p+0, 0x1.503cbd1e949dbp-56},
    {0x1.d5818dcfba487p+0, 0x1.2ed02d75b3707p-55},
    {0x1.dfc97337b9b5fp+0, -0x1.1a5cd4f184b5cp-54},
    {0x1.ea4afa2a490dap+0, -0x1.e9c23179c2893p-54},
    {0x1.f50765b6e4540p+0, 0x1.9d3e12dd8a18bp-54},
};

/// e^x = 2^power (root[0] + root[1]) (1 + rest).
typedef struct reduced {
    const double *root;
    int power;
    double rest;
} reduced;

static inline reduced reduce_exp(double x)
{
    const double shifted = x * 0x1.71547652b82fep+5 + rounder, n = shifted - rounder;
    const int count = (int32_t)(uint32_t)maths_bits(shifted);
    const double r = (x - n * 0x1.62e42fefa0000p-6) - n * 0x1.cf79abc9e3b3ap-45, r2 = r * r;
    const double rest = r + r2 * ((0.5 + r * (1.0 / 6)) + r2 * ((1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720)));
    return (reduced){roots[count & 31], (count - (count & 31)) / 32, rest};
}

/// 2^k of a normal number.
static inline double power_of_two(int k) { return maths_from_bits((uint64_t)(k + 1023) << 52); }

double maths_exp(double x)
{
    if (!(fabs(x) < 746)) return x > 0 ? INFINITY : x < 0 ? 0 : x;
    const reduced e = reduce_exp(x);
    const double size = e.root[0] + (e.root[1] + e.root[0] * e.rest);
    if (e.power > -1022 && e.power < 1024) return size * power_of_two(e.power);
    return size * power_of_two(e.power / 2) * power_of_two(e.power - e.power / 2);
}

double maths_expm1(double x)
{
    if (fabs(x) < 0.3) {
        const double x2 = x * x, x4 = x2 * x2;
        const double a = (0x1.5555555555555p-3 + x * 0x1.5555555555556p-5) +
                         x2 * (0x1.1111111110ebep-7 + x * 0x1.6c16c16c16790p-10);
        const double b = (0x1.a01a01a3544e7p-13 + x * 0x1.a01a01a3f1034p-16) +
                         x2 * (0x1.71de213f9642dp-19 + x * 0x1.27e4e5c0de589p-22);
        const double c = 0x1.af0377e6fd0c7p-26 + x * 0x1.1f5aaebb0b85bp-29;
        return copysign(x + (0.5 * x2 + x * x2 * (a + x4 * (b + x4 * c))), x);
    }
    if (x > 40) return maths_exp(x);
    if (!(x > -40)) return x < 0 ? -1 : x;
    const reduced e = reduce_exp(x);
    const double scale = power_of_two(e.power), size = scale * e.root[0], less = size - 1;
    const double lost = size > 1 ? (size - less) - 1 : size - (less + 1); // of less
    return less + (lost + scale * (e.root[1] + e.root[0] * e.rest));
}

// --- sin and cos: angle = n π/2 + (r + rest), |r| ≤ π/4 -------------------------------------------------------------

/// Of r, given r and what rounding it lost.
static inline double sine(double r, double rest)
{
    const double z = r * r, z2 = z * z;
    const double low = -0x1.5555555555555p-3 + z * 0x1.1111111110bb3p-7;
    const double middle = -0x1.a01a019e83b8ep-13 + z * 0x1.71de3796935f7p-19;
    const double high = -0x1.ae600b05437ebp-26 + z * 0x1.5e0b18d1831d9p-33;
    return copysign(r + (r * z * (low + z2 * (middle + z2 * high)) + rest * (1 - 0.5 * z)), r);
}

static inline double cosine(double r, double rest)
{
    const double z = r * r, z2 = z * z;
    const double low = 0x1.5555555555555p-5 + z * -0x1.6c16c16c16967p-10;
    const double middle = 0x1.a01a019f4eb3ep-16 + z * -0x1.27e4fa17db291p-22;
    const double high = 0x1.1eeb68e73b8acp-29 + z * -0x1.907da0204c48ep-37;
    const double short_r = maths_from_bits(maths_bits(r) & ~UINT64_C(0x7ffffff)); // its square is exact
    const double half = 0.5 * short_r * short_r, near = 1 - half, lost = (1 - near) - half;
    const double half_rest = 0.5 * (r - short_r) * (r + short_r);
    return near + (lost - half_rest + (z2 * (low + z2 * (middle + z2 * high)) - r * rest));
}

maths_point maths_turn(double angle)
{
    if (fabs(angle) < 0.78) return (maths_point){cosine(angle, 0), sine(angle, 0)};
    // Further around, the angle's own last digit is larger than what this rounds.
    if (fabs(angle) > 1e6) angle = remainder(angle, 0x1.921fb54442d18p+2);
    const double shifted = angle * 0x1.45f306dc9c883p-1 + rounder, n = shifted - rounder;
    const double first = angle - n * 0x1.921fb54400000p+0, second = n * 0x1.0b4611a600000p-34; // both exact
    const double most = first - second, back = first - most, lost = back - second, third = n * 0x1.3198a2e037073p-69;
    const double r = most + (lost - third), rest = (most - r) + (lost - third);
    const double c = cosine(r, rest), s = sine(r, rest);
    switch (maths_bits(shifted) & 3) {
    case 0:
        return (maths_point){c, s};
    case 1:
        return (maths_point){-s, c};
    case 2:
        return (maths_point){-c, -s};
    default:
        return (maths_point){s, -c};
    }
}

// --- log: x = 2^k m, √½ < m < √2; log m = 2 artanh(s), s = (m − 1) / (m + 1) ---------------------------------------------

double maths_log(double x)
{
    if (!(x > 0)) return x < 0 ? NAN : x == 0 ? -INFINITY : x;
    if (isinf(x)) return x;
    int k;
    double m = frexp(x, &k);
    if (m < 0x1.6a09e667f3bcdp-1) m *= 2, k--;
    const double f = m - 1, s = f / (2 + f), z = s * s, half = 0.5 * f * f;
    const double low = 0x1.5555555555558p-1 + z * (0x1.999999999520bp-2 + z * 0x1.2492492e06935p-2);
    const double high =
        0x1.c71c62ccd34b9p-3 + z * (0x1.7462bb2012465p-3 + z * (0x1.39fd992f8665fp-3 + z * 0x1.2b614a4fec2ddp-3));
    const double small = s * (half + z * (low + z * z * z * high)) + k * 0x1.9ef35793c7673p-41;
    return k * 0x1.62e42fefa2000p-1 - ((half - small) - f);
}

// --- atan: below tan π/8, or π/4 more ------------------------------------------------------------------------------

/// Of t, 0 ≤ t ≤ 1.
static double arc_tangent(double t)
{
    const bool beyond = t > 0.4142135623730951;
    const double x = beyond ? (t - 1) / (t + 1) : t, z = x * x, z2 = z * z, z4 = z2 * z2;
    const double a =
        (-0x1.5555555555555p-2 + z * 0x1.99999999993a7p-3) + z2 * (-0x1.249249243a603p-3 + z * 0x1.c71c7187b4e7dp-4);
    const double b =
        (-0x1.745d0b85bf8e5p-4 + z * 0x1.3b126ae940e4dp-4) + z2 * (-0x1.10fadfd8c992ap-4 + z * 0x1.dfecf0743d6b1p-5);
    const double c = (-0x1.a0ba7af2597bap-5 + z * 0x1.41bcadf838aa9p-5) + z2 * -0x1.3b02da244a81cp-6;
    const double small = x * z * (a + z4 * (b + z4 * c));
    return beyond ? 0x1.921fb54442d18p-1 + (x + (small + 0x1.1a62633145c07p-55)) : x + small;
}

double maths_atan2(double y, double x)
{
    if (isnan(x) || isnan(y)) return x + y;
    const double across = fabs(x), up = fabs(y);
    if (up > across) {
        const double beside = arc_tangent(isinf(up) ? 0 : across / up);
        return copysign(0x1.921fb54442d18p+0 - (copysign(beside, x) - 0x1.1a62633145c07p-54), y);
    }
    double angle = arc_tangent(across == 0 ? 0 : isinf(across) ? isinf(up) : up / across);
    if (signbit(x)) angle = 0x1.921fb54442d18p+1 - (angle - 0x1.1a62633145c07p-53);
    return copysign(angle, y);
}

// --- √(x² + y²), sums and powers of ten ---------------------------------------------------------------------------

double maths_hypot(double x, double y)
{
    if (isinf(x) || isinf(y)) return INFINITY;
    const double largest = fmax(fabs(x), fabs(y));
    const double scale = largest > 1e150 ? 0x1p-600 : largest < 1e-140 ? 0x1p600 : 1;
    x *= scale, y *= scale;
    return sqrt(x * x + y * y) / scale;
}

WIDEST double maths_dot(const double *restrict a, const double *restrict b, int n)
{
    double part[8] = {0}, sum = 0;
    int k = 0;
    for (; k + 8 <= n; k += 8) {
        for (int i = 0; i < 8; i++) part[i] += a[k + i] * b[k + i];
    }
    for (; k < n; k++) sum += a[k] * b[k];
    for (int i = 0; i < 8; i++) sum += part[i];
    return sum;
}

int maths_compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

double maths_power_of_ten(int n)
{
    double power = 1;
    for (int i = 0; i < abs(n); i++) power *= 10;
    return n < 0 ? 1 / power : power;
}

int maths_decade(double x)
{
    int n, k = 0;
    frexp(x, &k);
    for (n = (int)(0.30103 * k); n > -308 && maths_power_of_ten(n) > x;) n--;
    while (n < 308 && maths_power_of_ten(n + 1) <= x) n++;
    return n;
}
