/// From parameters to poles, coefficients and the cost of the start.
#include "spline/poles.h"
#include "spline/dd.h"
#include "spline/wide.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/// Nothing beyond this is told apart from it (λ has long been 0), and products of two stay finite.
static const double largest = 1e140;

/// A start cost below this (N⁻⁴ of the longest spline) holds nothing.
static const double negligible = 1e-30;

static double at_sample(wiggly_param param, int sample, double maximum)
{
    double value = param.track ? param.track[sample] : param.value;
    return value > 0 ? fmin(value, maximum) : 0.0;
}

/// Roots of s² + 2σs + ω² = 0.
static poles real_poles(double sigma, double omega)
{
    poles at = {.natural = omega, .decay = sigma};
    if (sigma <= omega) {
        double d = sqrt(omega - sigma) * sqrt(omega + sigma);
        at.s[0] = (cplx){-sigma, d};
        at.s[1] = (cplx){-sigma, -d};
        at.centre = d;
    } else {
        double d = sigma + sqrt(sigma - omega) * sqrt(sigma + omega);
        at.s[0] = (cplx){-omega * (omega / d), 0};
        at.s[1] = (cplx){-d, 0};
    }
    return at;
}

poles poles_at(const wiggly_desc *desc, int sample, double floor)
{
    if (desc->mode == WIGGLY_CUBIC) return (poles){0};
    double omega = 2 * pi * at_sample(desc->frequency, sample, sqrt(largest));
    double zeta = fmax(at_sample(desc->damping, sample, sqrt(largest)), floor);
    if (desc->mode == WIGGLY_REAL) return real_poles(zeta * omega, omega);
    zeta = fmin(zeta, 1.0);
    double centre = omega * sqrt((1 - zeta) * (1 + zeta));
    double bandwidth = at_sample(desc->bandwidth, sample, 1.0), turn = omega * bandwidth;
    // √(1−ζ²) − β of a pole near 0, without cancellation
    double lower = ((1 - bandwidth) * (1 + bandwidth) - zeta * zeta) / (sqrt((1 - zeta) * (1 + zeta)) + bandwidth);
    return (poles){
        .s = {{-zeta * omega, centre + turn}, {-zeta * omega, zeta < 1 ? omega * lower : -turn}},
        .natural = omega,
        .centre = centre,
        .decay = zeta * omega,
    };
}

static inline int64_t bits_of(double x)
{
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/// The largest number's bits: positive ones are ordered as their bits are, above all that are not.
WIDEST static int64_t largest_bits(const double *x, int count)
{
    int64_t most = 0;
    for (int i = 0; i < count; i++) most = bits_of(x[i]) > most ? bits_of(x[i]) : most;
    return most;
}

int poles_fastest(const wiggly_desc *desc, int from, int to, double *natural)
{
    const double *track = desc->frequency.track;
    int fastest = from;
    if (track && from < to) {
        const int64_t most = largest_bits(track + from, to - from + 1);
        while (most > 0 && bits_of(track[fastest]) != most) fastest++;
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
    double size = exp(z.re), c = cos(z.im), s = sin(z.im);
    return (cplx){size * c, size * s};
}

static cplx cplx_divide(cplx a, cplx b)
{
    double size = cplx_norm(b);
    return (cplx){(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}

/// exp(z) − 1 without cancellation, from exp(Re z) − 1 and Im z.
static cplx cplx_expm1_of(double grown, double angle)
{
    double s = sin(angle), c = cos(angle);
    double versine = c > 0 ? s * s / (1 + c) : 1 - c;
    return (cplx){grown * c - versine, (1 + grown) * s};
}

static cplx cplx_expm1(cplx z) { return cplx_expm1_of(expm1(z.re), z.im); }

/// μ = exp(s h) − 1 of both poles, which often decay alike or are conjugates.
static void distances(const poles *at, double step, cplx mu[2])
{
    const cplx *s = at->s;
    double grown = expm1(s[0].re * step);
    bool alike = s[1].re == s[0].re, conjugate = alike && s[1].im == -s[0].im;
    mu[0] = cplx_expm1_of(grown, s[0].im * step);
    if (!alike) grown = expm1(s[1].re * step);
    mu[1] = conjugate ? cplx_conj(mu[0]) : cplx_expm1_of(grown, s[1].im * step);
}

/// exact − (whole + m + p) of one part.
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
        cplx a = cplx_add(cplx_exp(cplx_scale(step, at->s[0])), cplx_exp(cplx_scale(step, at->s[1])));
        cplx b = cplx_exp(sum);
        if (-sum.re >
            FASTEST) { // both are below the last digit of 1, and the rests would be, beside what m and p leave
            if (fabs(a.re) + fabs(a.im) < DBL_EPSILON) c.m = (cplx){-2, 0};
            c.p = (cplx){-1 - c.m.re, -c.m.im};
        }
        c.a_rest = (cplx){rest_of(a.re, 2, c.m.re, 0), rest_of(a.im, 0, c.m.im, 0)};
        c.b_rest = (cplx){rest_of(b.re, 1, c.m.re, c.p.re), rest_of(b.im, 0, c.m.im, c.p.im)};
        if (at->s[0].im == -at->s[1].im) c.a_rest.im = c.b_rest.im = 0;
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

/// |1 − exp(z)|².
static double distance_from_one(cplx z) { return cplx_norm(cplx_expm1(z)); }

start_cost poles_start_cost(const poles *at, double step)
{
    const cplx *s = at->s;
    double h00 = -expm1(2 * step * (s[0].re + s[1].re)); // 1 − |b|²
    if (!(h00 > negligible)) return (start_cost){0};
    // H₁₀ = −(a + a* b) = m + m* + 2p + |m|² + m* p, so H₀₀ + H₁₀ = 2j Im p − m p* − |p|²: no term of order 1 is left.
    cplx mu[2];
    distances(at, step, mu);
    cplx m = cplx_add(mu[0], mu[1]), p = cplx_mul(mu[0], mu[1]), mp = cplx_mul(m, cplx_conj(p));
    cplx sum = {-mp.re - cplx_norm(p), 2 * p.im - mp.im};
    double decay = -expm1(2 * step * s[0].re), other = s[1].re == s[0].re ? decay : -expm1(2 * step * s[1].re);
    double det = decay * other * distance_from_one((cplx){step * (s[0].re + s[1].re), step * (s[0].im - s[1].im)});
    cplx e = {sum.re / h00, -sum.im / h00}; // |x₀ + (e−1) x₁|², x₁ = x₀ + e₀
    return (start_cost){{{h00, e, {e.re - 1, e.im}}, {det / h00, {1, 0}, {1, 0}}}};
}

double poles_weight_exponent(const poles *at, double step)
{
    return fmin(-step * (at->s[0].re + at->s[1].re), HEAVIEST);
}

/// z / sinh z of a z whose square is real.
static double z_over_sinh(double z2)
{
    if (fabs(z2) < 1e-4) return 1 - z2 * (1.0 / 6 - z2 * (7.0 / 360 - z2 * (31.0 / 15120)));
    double z = sqrt(fabs(z2));
    return z2 > 0 ? z / sinh(z) : z / sin(z);
}

/// Steepest coefficient of a speed: where two poles alias to the same λ it would be infinite.
static const double steepest = 1e8;

// With μ = λ − 1, w' = s₀ w + Q (w₁ − λ₀ w) = (s₀ − Q μ₀) w + Q e, and Q = (s₀−s₁)/(λ₀−λ₁) = z / sinh z · exp(−(s₀+s₁)h/2) / h with
// z = (s₀−s₁)h/2, which is real or imaginary.
speed_form poles_speed(const poles *at, double step, bool backwards)
{
    double h = backwards ? -step : step;
    const bool alike =
        at->s[0].re == at->s[1].re; // else the second fades faster, and the first says how steep it gets
    cplx s0 = {fmax(at->s[0].re * step, -DEEPEST) / step, at->s[0].im};
    cplx s1 = {fmax(at->s[1].re * step, alike ? -DEEPEST : -3 * DEEPEST) / step, at->s[1].im};
    cplx z = cplx_scale(0.5 * h, cplx_sub(s0, s1)), mean = cplx_scale(0.5 * h, cplx_add(s0, s1));
    double ratio = fmin(fmax(z_over_sinh(z.re * z.re - z.im * z.im), -steepest), steepest);
    cplx q = cplx_scale(ratio, cplx_exp(cplx_scale(-1, mean)));
    cplx on_x = cplx_sub(cplx_scale(h, s0), cplx_mul(q, cplx_expm1(cplx_scale(h, s0))));
    if (s0.im == -s1.im) on_x.im = q.im = 0; // poles that are conjugates or real: not even rounding ties Im x to Re x
    return backwards ? (speed_form){cplx_scale(-1, on_x), q} : (speed_form){on_x, q};
}

start_cost poles_start_seen_from(start_cost cost, const poles *damped, const poles *at, double step)
{
    speed_form here = poles_speed(at, step, false), there = poles_speed(damped, step, false);
    cplx on_x = cplx_divide(cplx_sub(here.on_x, there.on_x), there.on_e), on_e = cplx_divide(here.on_e, there.on_e);
    for (int i = 0; i < 2; i++) {
        struct start_row *row = &cost.row[i];
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
    poles at = poles_at(desc, sample, 0);
    wiggly_poles out;
    for (int k = 0; k < 2; k++) {
        double size = exp(at.s[k].re * desc->step), angle = at.s[k].im * desc->step;
        out.s[k][0] = at.s[k].re;
        out.s[k][1] = at.s[k].im;
        out.z[k][0] = size * cos(angle);
        out.z[k][1] = size * sin(angle);
    }
    return out;
}
