/// Poles, coefficients and cost of the start from parameters: for one sample, and for a block.
#include "spline/poles.h"
#include "maths/maths.h"
#include "maths/wide.h"
#include "spline/desc.h"
#include "spline/host.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/// An unevaluated sum hi + lo, |lo| ≤ ulp(hi)/2, about 106 bits (Dekker 1971, Knuth). Needs round-to-nearest and no contraction or reassociation: built
/// with -ffp-contract=off, never with -ffast-math.
typedef struct dd {
    double hi, lo;
} dd;

static inline dd dd_from(double a) { return (dd){a, 0}; }

/// a + b exactly.
static inline dd dd_sum(double a, double b)
{
    const double s = a + b, t = s - a;
    return (dd){s, (a - (s - t)) + (b - t)};
}

/// The upper 26 bits of a.
static inline double dd_upper(double a)
{
    const double c = 0x8000001p0 * a;
    return c - (c - a);
}

/// a·b exactly (where it neither overflows nor underflows), by the factors' halves: for loops that vectorise, which a call of fma() would not.
static inline dd dd_product(double a, double b)
{
    const double p = a * b, a1 = dd_upper(a), b1 = dd_upper(b), a2 = a - a1, b2 = b - b1;
    return (dd){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

static inline dd dd_add(dd a, dd b)
{
    const dd s = dd_sum(a.hi, b.hi);
    const double lo = s.lo + (a.lo + b.lo), hi = s.hi + lo;
    return (dd){hi, lo - (hi - s.hi)};
}

static inline dd dd_subtract(dd a, dd b) { return dd_add(a, (dd){-b.hi, -b.lo}); }

static inline dd dd_multiply(dd a, dd b)
{
    const dd p = dd_product(a.hi, b.hi);
    return dd_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static const double pi = 3.14159265358979323846;

/// Larger numbers make no difference (λ has long been 0), and products of two stay finite.
static const double largest = 1e140;

/// A smaller start cost (N⁻⁴ of the longest spline) has no effect.
static const double negligible = 1e-30;

static double at_sample(wiggly_param param, int sample, double maximum)
{
    double value = param.track ? param.track[sample] : param.value;
    return value > 0 ? value < maximum ? value : maximum : 0.0;
}

/// Roots of s² + 2σs + ω² = 0.
static inline poles real_poles(double sigma, double omega)
{
    const bool swings = sigma <= omega;
    const double difference = swings ? omega - sigma : sigma - omega;
    const double root = sqrt(difference) * sqrt(omega + sigma), fast = sigma + root;
    const double slow = omega * (omega / (fast > 0 ? fast : 1)), turn = swings ? root : 0;
    return (poles){
        .s = {{-(swings ? sigma : slow), turn}, {-(swings ? sigma : fast), -turn}},
        .natural = omega,
        .centre = turn,
        .decay = sigma,
    };
}

static inline poles complex_poles(double omega, double zeta, double bandwidth)
{
    const double root = sqrt((1 - zeta) * (1 + zeta)), centre = omega * root, turn = omega * bandwidth;
    // √(1−ζ²) − β = (1 − ζ² − β²) / (√(1−ζ²) + β), whose numerator may be near 0
    const dd exact = dd_subtract(dd_subtract(dd_from(1), dd_product(zeta, zeta)), dd_product(bandwidth, bandwidth));
    const double plain = (1 - bandwidth) * (1 + bandwidth) - zeta * zeta, sum = root + bandwidth,
                 lower = (plain > 0.5 ? plain : exact.hi + exact.lo) / (sum > 0 ? sum : 1);
    return (poles){
        .s = {{-zeta * omega, centre + turn}, {-zeta * omega, zeta < 1 ? omega * lower : -turn}},
        .natural = omega,
        .centre = centre,
        .decay = zeta * omega,
    };
}

/// 2π cycles without whole multiples of a turn.
static double angle_beyond(dd cycles, double turn)
{
    return 2 * pi * ((cycles.hi - turn * floor(cycles.hi / turn + 0.5)) + cycles.lo);
}

/// The poles' angles, from f h cycles a sample: beyond a quarter turn exactly, as only the rest of a turn matters.
static void set_angles(poles *at, double f, double h, double zeta, double bandwidth, bool is_complex)
{
    for (int k = 0; k < 2; k++) at->angle[k] = at->s[k].im * h;
    at->half = 0.5 * (at->s[0].im - at->s[1].im) * h;
    if (!(at->angle[0] > 0.5 * pi)) return;
    const dd square = dd_subtract(dd_from(1), dd_product(zeta, zeta)), rate = dd_product(f, h);
    const double hi = sqrt(square.hi), lo = hi > 0 ? dd_subtract(square, dd_product(hi, hi)).hi / (2 * hi) : 0;
    const dd root = dd_sum(hi, lo), half = is_complex ? dd_from(bandwidth) : root,
             centre = is_complex ? root : dd_from(0);
    at->angle[0] = angle_beyond(dd_multiply(rate, dd_add(centre, half)), 1);
    at->angle[1] = angle_beyond(dd_multiply(rate, dd_subtract(centre, half)), 1);
    at->half = angle_beyond(dd_multiply(rate, half), 0.5);
}

poles poles_at(const wiggly_desc *desc, int sample, double floor)
{
    if (desc->mode == WIGGLY_CUBIC) return (poles){0};
    const double f = at_sample(desc->frequency, sample, sqrt(largest)), omega = 2 * pi * f;
    const bool is_complex = desc->mode == WIGGLY_COMPLEX;
    double zeta = at_sample(desc->damping, sample, sqrt(largest)), bandwidth = 0;
    zeta = zeta > floor ? zeta : floor;
    if (is_complex) zeta = zeta < 1 ? zeta : 1, bandwidth = at_sample(desc->bandwidth, sample, 1.0);
    poles at = is_complex ? complex_poles(omega, zeta, bandwidth) : real_poles(zeta * omega, omega);
    set_angles(&at, f, desc->step, zeta, bandwidth, is_complex);
    return at;
}

/// Bits of the largest number: positive numbers have the order of their bits, above negative ones.
WIDEST static int64_t largest_bits(const double *x, int count)
{
    int64_t most = 0;
    for (int i = 0; i < count; i++) most = (int64_t)maths_bits(x[i]) > most ? (int64_t)maths_bits(x[i]) : most;
    return most;
}

int poles_fastest(const wiggly_desc *desc, int from, int to, double *natural)
{
    const double *track = desc->frequency.track;
    int fastest = from;
    if (track && from < to) {
        const int64_t most = largest_bits(track + from, to - from + 1);
        while (most > 0 && (int64_t)maths_bits(track[fastest]) != most) fastest++;
    }
    if (natural) *natural = poles_at(desc, fastest, 0).natural;
    return fastest;
}

bool poles_are_constant(const wiggly_desc *desc)
{
    if (desc->mode == WIGGLY_CUBIC) return true;
    return !desc->frequency.track && !desc->damping.track && (desc->mode == WIGGLY_REAL || !desc->bandwidth.track);
}

cplx cplx_exp(cplx z)
{
    const double size = maths_exp(z.re);
    const maths_point turn = maths_turn(z.im);
    return (cplx){size * turn.cos, size * turn.sin};
}

static cplx cplx_divide(cplx a, cplx b)
{
    double size = cplx_norm(b);
    return (cplx){(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}

/// exp(z) − 1 without cancellation, from exp(Re z) − 1 and Im z.
static cplx cplx_expm1_of(double grown, double angle)
{
    const maths_point turn = maths_turn(angle);
    const double versine = turn.cos > 0 ? turn.sin * turn.sin / (1 + turn.cos) : 1 - turn.cos;
    return (cplx){grown * turn.cos - versine, (1 + grown) * turn.sin};
}

static cplx cplx_expm1(cplx z) { return cplx_expm1_of(maths_expm1(z.re), z.im); }

/// μ = exp(s h) − 1 of both poles, which often decay equally or are conjugates.
static void distances(const poles *at, double step, cplx mu[2])
{
    const cplx *s = at->s;
    double grown = maths_expm1(s[0].re * step);
    bool alike = s[1].re == s[0].re, conjugate = alike && s[1].im == -s[0].im;
    mu[0] = cplx_expm1_of(grown, at->angle[0]);
    if (!alike) grown = maths_expm1(s[1].re * step);
    mu[1] = conjugate ? cplx_conj(mu[0]) : cplx_expm1_of(grown, at->angle[1]);
}

/// exact − (whole + m + p) in one part.
static double rest_of(double exact, double whole, double m, double p)
{
    dd sum = dd_add(dd_sum(whole, m), dd_from(p));
    sum = dd_subtract(dd_from(exact), sum);
    return sum.hi + sum.lo;
}

coefficients poles_coefficients(const poles *at, double step)
{
    cplx mu[2], sum = cplx_scale(step, cplx_add(at->s[0], at->s[1]));
    distances(at, step, mu);
    coefficients c = {
        .m = cplx_add(mu[0], mu[1]),
        .p = cplx_mul(mu[0], mu[1]),
        .g = cplx_exp(cplx_scale(0.5, sum)),
    };
    if (-sum.re > FAST) {
        cplx a = cplx_add(cplx_exp((cplx){step * at->s[0].re, at->angle[0]}),
                          cplx_exp((cplx){step * at->s[1].re, at->angle[1]}));
        cplx b = cplx_exp((cplx){sum.re, at->angle[0] + at->angle[1]});
        if (-sum.re >
            FASTEST) { // both are below the last digit of 1, and the rests would be, beside what m and p leave
            if (fabs(a.re) + fabs(a.im) < DBL_EPSILON) c.m = (cplx){-2, 0};
            c.p = (cplx){-1 - c.m.re, -c.m.im};
        }
        c.rest.a = (cplx){rest_of(a.re, 2, c.m.re, 0), rest_of(a.im, 0, c.m.im, 0)};
        c.rest.b = (cplx){rest_of(b.re, 1, c.m.re, c.p.re), rest_of(b.im, 0, c.m.im, c.p.im)};
        if (at->s[0].im == -at->s[1].im) c.rest.a.im = c.rest.b.im = 0;
    }
    return c;
}

void poles_mean(const poles *at, double step, cplx *lambda, cplx *delta2)
{
    cplx mu[2];
    distances(at, step, mu);
    cplx delta = {0.5 * (mu[0].re - mu[1].re), 0.5 * (mu[0].im - mu[1].im)};
    *lambda = (cplx){1 + 0.5 * (mu[0].re + mu[1].re), 0.5 * (mu[0].im + mu[1].im)};
    *delta2 = cplx_mul(delta, delta);
}

start_cost poles_start_cost(const poles *at, double step)
{
    const cplx *s = at->s;
    double h00 = -maths_expm1(2 * step * (s[0].re + s[1].re)); // 1 − |b|²
    if (!(h00 > negligible)) return (start_cost){0};
    // H₁₀ = −(a + a* b) = m + m* + 2p + |m|² + m* p, so H₀₀ + H₁₀ = 2j Im p − m p* − |p|²: no term of order 1 is left.
    cplx mu[2];
    distances(at, step, mu);
    cplx m = cplx_add(mu[0], mu[1]), p = cplx_mul(mu[0], mu[1]), mp = cplx_mul(m, cplx_conj(p));
    cplx sum = {-mp.re - cplx_norm(p), 2 * p.im - mp.im};
    double decay = -maths_expm1(2 * step * s[0].re),
           other = s[1].re == s[0].re ? decay : -maths_expm1(2 * step * s[1].re);
    double det = decay * other * cplx_norm(cplx_expm1((cplx){step * (s[0].re + s[1].re), 2 * at->half}));
    cplx e = {sum.re / h00, -sum.im / h00}; // |x₀ + (e−1) x₁|², x₁ = x₀ + e₀
    const double unit = 16 * DBL_EPSILON,
                 of_e = unit * (cplx_size(sum) + cplx_norm(p) + sqrt(cplx_norm(p) * cplx_norm(m))) / h00;
    return (start_cost){{{h00, e, {e.re - 1, e.im}, {of_e, of_e + unit * cplx_size((cplx){e.re - 1, e.im}), 0}},
                         {det / h00, {1, 0}, {1, 0}, {0, 0, 0}}}};
}

double poles_weight_exponent(const poles *at, double step)
{
    return fmin(-step * (at->s[0].re + at->s[1].re), HEAVIEST);
}

/// z / sinh z from z².
static double z_over_sinh(double z2)
{
    if (z2 < 1e-4) return 1 - z2 * (1.0 / 6 - z2 * (7.0 / 360 - z2 * (31.0 / 15120)));
    double z = sqrt(z2);
    return -2 * z * maths_exp(-z) / maths_expm1(-2 * z);
}

/// Limit for the coefficient of a speed; it would be infinite if two poles alias to the same λ. What it is then multiplied by may be any number, but
/// the ratio to what it is added to is known to h (s₀−s₁) over it.
static const double steepest = 1e8;

// With μ = λ − 1, w' = s₀ w + Q (w₁ − λ₀ w) = (s₀ − Q μ₀) w + Q e, and Q = (s₀−s₁)/(λ₀−λ₁) = z / sinh z · exp(−(s₀+s₁)h/2) / h with
// z = (s₀−s₁)h/2, which is real or imaginary. What whole half turns of Im z change in sign, they change in exp(Im (s₀+s₁)h/2) = exp(Im s₀h − Im z), too.
speed_form poles_speed(const poles *at, double step, bool backwards)
{
    double h = backwards ? -step : step;
    const bool alike =
        at->s[0].re == at->s[1].re; // else the second pole fades faster, and the first determines the slope
    cplx s0 = {fmax(at->s[0].re * step, -DEEPEST) / step, at->s[0].im};
    cplx s1 = {fmax(at->s[1].re * step, alike ? -DEEPEST : -3 * DEEPEST) / step, at->s[1].im};
    const double turn = backwards ? -at->angle[0] : at->angle[0], half = backwards ? -at->half : at->half;
    const double half_turns = floor((0.5 * h * (s0.im - s1.im) - half) / pi + 0.5);
    const cplx z = {0.5 * h * (s0.re - s1.re), half_turns * pi + half},
               mean = {0.5 * h * (s0.re + s1.re), turn - half};
    const double exact = z.im == 0 ? z_over_sinh(z.re * z.re) : z.im / maths_sin(half),
                 ratio = fmin(fmax(exact, -steepest), steepest);
    const bool cut = !(fabs(exact) < steepest); // then nothing of the row but Q should count
    cplx q = cplx_scale(ratio, cplx_exp(cplx_scale(-1, mean)));
    cplx on_x = cplx_sub(cplx_scale(h, s0), cplx_mul(q, cplx_expm1((cplx){h * s0.re, turn})));
    if (s0.im == -s1.im) on_x.im = q.im = 0; // conjugate or real poles: not even rounding may couple Im x to Re x
    // what remains of on_x is a difference
    const double size = cplx_size(q), part = 8 * DBL_EPSILON * (2 + fabs(z.re) + fabs(mean.re));
    const double first = cplx_size(s0) * fabs(h), moved = fmin(fabs(h * s0.re) + fabs(turn), 2);
    const speed_loss loss = {8 * DBL_EPSILON * first + part * size * moved + cut * first, part * size, cut};
    return (speed_form){backwards ? cplx_scale(-1, on_x) : on_x, q, loss};
}

start_cost poles_start_seen_from(start_cost cost, const poles *damped, const poles *at, double step)
{
    speed_form here = poles_speed(at, step, false), there = poles_speed(damped, step, false);
    cplx on_x = cplx_divide(cplx_sub(here.on_x, there.on_x), there.on_e), on_e = cplx_divide(here.on_e, there.on_e);
    for (int i = 0; i < 2; i++) {
        struct start_row *row = &cost.row[i];
        const double apart = (here.loss.x + there.loss.x + cplx_size(on_x) * there.loss.e) / cplx_size(there.on_e);
        const double share = (here.loss.e / cplx_size(here.on_e) + there.loss.e / cplx_size(there.on_e));
        row->loss.x += row->loss.e * cplx_size(on_x) + cplx_size(row->on_e) * apart;
        row->loss.e = row->loss.e * cplx_size(on_e) + cplx_size(row->on_e) * cplx_size(on_e) * share;
        row->loss.cut = here.loss.cut || there.loss.cut;
        row->on_x = cplx_add(row->on_x, cplx_mul(row->on_e, on_x));
        row->on_e = cplx_mul(row->on_e, on_e);
    }
    return cost;
}

cplx poles_tail(cplx passive, const speed_form *ahead, double step)
{
    return cplx_divide(cplx_sub(cplx_scale(step, passive), ahead->on_x), ahead->on_e);
}

void wiggly_from_spring(double k, double gamma, double *frequency, double *damping)
{
    const double most = 1e8, omega = fmax(sqrt(k), gamma / (2 * most));
    *frequency = omega / (2 * pi);
    *damping = omega > 0 ? gamma / (2 * omega) : 0;
}

wiggly_poles wiggly_poles_at(const wiggly_desc *desc, int sample)
{
    wiggly_desc own;
    wiggly_poles out = {{{0}}, {{0}}};
    if (desc_read(desc, &own) != WIGGLY_OK || sample < 0 || sample >= own.samples) return out;
    const host_state host = host_leave();
    const poles at = poles_at(&own, sample, 0);
    for (int k = 0; k < 2; k++) {
        const cplx z = cplx_exp(cplx_scale(own.step, at.s[k]));
        out.s[k][0] = at.s[k].re;
        out.s[k][1] = at.s[k].im;
        out.z[k][0] = z.re;
        out.z[k][1] = z.im;
    }
    host_return(&host);
    return out;
}

// --- a block of samples ----------------------------------------------------------------------------------------------
//
// Loops that vectorise, with sine, cosine and exponential by polynomials. With the half angle φ = Im s h / 2 and α = Re s h, accurate at high
// sample rates,
//
//     λ − 1 = expm1 α − 2 e^α sin² φ + 2j e^α sin φ cos φ.

/// The mathematics library handles larger angles and exponents; poles_at() those of more than half a turn a sample.
static const double largest_angle = 1e4, largest_exponent = 600, largest_half = 0.5 * 3.14159265358979323846;

/// Adding it rounds to an integer, which is then in the lowest bits.
#define ROUNDER 0x1.8p52

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
    *scale = maths_from_bits((maths_bits(shifted) + 1023) << 52);
    return r + r * r * s;
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
    const uint64_t quarter = maths_bits(shifted);
    const double first = quarter & 1 ? of_cosine : of_sine, second = quarter & 1 ? of_sine : of_cosine;
    *sine = maths_from_bits(maths_bits(first) ^ (quarter & 2) << 62);
    *cosine = maths_from_bits(maths_bits(second) ^ ((quarter + 1) & 2) << 62);
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

static inline void put_poles(poles *at, double h, int i, bool pair, poles_block *restrict block,
                             exponents *restrict e)
{
    for (int k = 0; k < 2; k++) at->angle[k] = at->s[k].im * h;
    const coefficient_loss loss = poles_loss(at, h, pair);
    block->loss_m[i] = loss.m, block->loss_p[i] = loss.p;
    block->natural[i] = at->natural;
    block->centre[i] = at->centre;
    for (int k = 0; k < 2; k++) e->real[k][i] = at->s[k].re * h, e->half[k][i] = 0.5 * at->angle[k];
}

WIDEST static void set_complex(const double *restrict f, const double *restrict z, const double *restrict b,
                               double floor, double h, int count, poles_block *restrict block, exponents *restrict e)
{
    for (int i = 0; i < count; i++) {
        const double zeta = z[i] > floor ? z[i] : floor;
        poles at = complex_poles(2 * pi * f[i], zeta < 1 ? zeta : 1, b[i] < 1 ? b[i] : 1);
        put_poles(&at, h, i, false, block, e);
    }
}

WIDEST static void set_real(const double *restrict f, const double *restrict z, double floor, double h, int count,
                            poles_block *restrict block, exponents *restrict e)
{
    for (int i = 0; i < count; i++) {
        const double omega = 2 * pi * f[i];
        poles at = real_poles((z[i] > floor ? z[i] : floor) * omega, omega);
        put_poles(&at, h, i, true, block, e);
    }
}

/// Coefficients from exponents; `alike`: both poles decay equally, which halves the work.
static inline void to_coefficients(const exponents *restrict e, int count, bool alike, poles_block *restrict block)
{
    for (int i = 0; i < count; i++) {
        double mu_re[2], mu_im[2], grown = 0;
        for (int k = 0; k < 2; k++) {
            double s, c, scale;
            if (k == 0 || !alike) {
                const double near = grown_near(e->real[k][i], &scale);
                grown = scale * near + (scale - 1); // expm1
            }
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

WIDEST static void set_coefficients(const exponents *restrict e, int count, bool alike, poles_block *restrict block)
{
    if (alike) { // loops of their own
        to_coefficients(e, count, true, block);
    } else {
        to_coefficients(e, count, false, block);
    }
}

WIDEST static bool is_within_reach(const exponents *e, int count)
{
    int64_t beyond = 0; // same width as the comparison
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < count; i++) beyond |= fabs(e->half[k][i]) <= largest_half ? 0 : 1;
        for (int i = 0; i < count; i++) beyond |= -e->real[k][i] <= largest_exponent ? 0 : 1;
    }
    return beyond == 0;
}

/// Frequencies and exponents, without coefficients.
static void set_exponents(const wiggly_desc *desc, int from, int count, double floor, poles_block *block,
                          exponents *e)
{
    double f[POLES_BLOCK], z[POLES_BLOCK], b[POLES_BLOCK];
    load(desc->frequency, from, count, f);
    load(desc->damping, from, count, z);
    load(desc->bandwidth, from, count, b);
    if (desc->mode == WIGGLY_COMPLEX) {
        set_complex(f, z, b, floor, desc->step, count, block, e);
    } else {
        set_real(f, z, floor, desc->step, count, block, e);
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
    if (is_within_reach(&e, count)) {
        set_coefficients(&e, count, desc->mode == WIGGLY_COMPLEX, block);
        for (int i = 0; i < count; i++)
            block->exponent[i] = block->exponent[i] < HEAVIEST ? block->exponent[i] : HEAVIEST;
        return;
    }
    for (int i = 0; i < count; i++) { // one by one
        const poles at = poles_at(desc, from + i, floor);
        const coefficients c = poles_coefficients(&at, desc->step);
        const coefficient_loss loss = poles_loss(&at, desc->step, desc->mode == WIGGLY_REAL);
        block->natural[i] = at.natural;
        block->centre[i] = at.centre;
        block->exponent[i] = poles_weight_exponent(&at, desc->step);
        block->m_re[i] = c.m.re, block->m_im[i] = c.m.im;
        block->p_re[i] = c.p.re, block->p_im[i] = c.p.im;
        block->loss_m[i] = loss.m, block->loss_p[i] = loss.p;
    }
}

WIDEST void poles_block_exp(const double *restrict x, int count, double *restrict out)
{
    for (int i = 0; i < count; i++) out[i] = exp_near(x[i]);
}

WIDEST static void turn_near(const double *restrict real, const double *restrict angle, int count,
                             double *restrict re, double *restrict im)
{
    for (int i = 0; i < count; i++) {
        double sine, cosine;
        const double size = exp_near(real[i]);
        sine_cosine(angle[i], &sine, &cosine);
        re[i] = size * cosine;
        im[i] = size * sine;
    }
}

void poles_block_turn(const double *real, const double *angle, int count, cplx *out)
{
    double re[POLES_BLOCK], im[POLES_BLOCK];
    bool near = true;
    for (int i = 0; i < count; i++)
        near = near && fabs(angle[i]) <= largest_angle && fabs(real[i]) <= largest_exponent;
    if (near) turn_near(real, angle, count, re, im);
    for (int i = 0; i < count; i++) out[i] = near ? (cplx){re[i], im[i]} : cplx_exp((cplx){real[i], angle[i]});
}
