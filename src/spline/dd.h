/// Double-double arithmetic: an unevaluated sum hi + lo with |lo| ≤ ulp(hi)/2, about 106 bits (Dekker 1971, Knuth).
///
/// Needs round-to-nearest and no contraction or reassociation: built with -ffp-contract=off, never with -ffast-math.
#ifndef SPLINE_DD_H
#define SPLINE_DD_H

#include <math.h>

typedef struct dd {
    double hi, lo;
} dd;

/// a + b exactly.
static inline dd dd_sum(double a, double b)
{
    double s = a + b;
    double t = s - a;
    return (dd){s, (a - (s - t)) + (b - t)};
}

/// a − b exactly.
static inline dd dd_difference(double a, double b) { return dd_sum(a, -b); }

/// The upper 26 bits of a.
static inline double dd_upper(double a)
{
    double c = 0x8000001p0 * a;
    return c - (c - a);
}

/// a·b exactly (where it neither overflows nor underflows), by a fused multiply-add where that is fast, else with the factors' halves: the same
/// bits.
static inline dd dd_product(double a, double b)
{
    double p = a * b;
#if defined(__FP_FAST_FMA) || (defined(__x86_64__) && defined(__gnu_linux__))
    return (dd){p, fma(a, b, -p)};
#else
    double a1 = dd_upper(a), b1 = dd_upper(b), a2 = a - a1, b2 = b - b1;
    return (dd){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
#endif
}

/// a² exactly, by the halves of a: for loops that vectorise, which a call of fma() would not.
static inline dd dd_square(double a)
{
    const double p = a * a, upper = dd_upper(a), lower = a - upper;
    return (dd){p, ((upper * upper - p) + 2 * upper * lower) + lower * lower};
}

static inline dd dd_add(dd a, dd b)
{
    dd s = dd_sum(a.hi, b.hi);
    double lo = s.lo + (a.lo + b.lo);
    double hi = s.hi + lo;
    return (dd){hi, lo - (hi - s.hi)};
}

static inline dd dd_subtract(dd a, dd b) { return dd_add(a, (dd){-b.hi, -b.lo}); }

/// a·b for a double a.
static inline dd dd_scale(double a, dd b)
{
    dd p = dd_product(a, b.hi);
    return (dd){p.hi, p.lo + a * b.lo};
}

static inline dd dd_from(double a) { return (dd){a, 0.0}; }

#endif
