/// src/maths against quadruple precision: errors in units in the last place, and the ends of its ranges.
#include "near.h"

#include "maths/maths.h"
#include "uniform.h"
#include <quadmath.h>

typedef double plain(double);
typedef __float128 exact(__float128);

/// The largest error over random arguments, in units in the last place of the exact value.
static double worst_of(plain *ours, exact *theirs, double from, double to)
{
    double worst = 0;
    uint64_t seed = 1;
    for (int i = 0; i < 100000; i++) {
        const double x = from + (to - from) * uniform(&seed);
        const __float128 expected = theirs(x);
        int exponent;
        frexp((double)expected, &exponent);
        worst = fmax(worst, (double)fabsq((ours(x) - expected) / ldexp(1, exponent - 53)));
    }
    return worst;
}

static double turned_cos(double x) { return maths_cos(x); }
static double turned_sin(double x) { return maths_sin(x); }
static double own_acos(double x) { return maths_acos(x); }
static double own_asin(double x) { return maths_asin(x); }
static double own_atan(double x) { return maths_atan2(x, 1); }
static double own_hypot(double x) { return maths_hypot(x, 0.75); }
static __float128 exact_hypot(__float128 x) { return hypotq(x, 0.75); }

TEST(errors_are_small)
{
    static const struct {
        const char *name;
        plain *ours;
        exact *theirs;
        double from, to, most;
    } cases[] = {
        {"exp", maths_exp, expq, -1, 1, 0.56},
        {"exp", maths_exp, expq, -700, 700, 0.56},
        {"expm1", maths_expm1, expm1q, -1e-6, 1e-6, 0.51},
        {"expm1", maths_expm1, expm1q, -0.1, 0.1, 0.6},
        {"expm1", maths_expm1, expm1q, -50, 50, 0.8},
        {"sin", turned_sin, sinq, -0.3, 0.3, 0.6},
        {"sin", turned_sin, sinq, -10, 10, 0.9},
        {"sin", turned_sin, sinq, -1e6, 1e6, 0.9},
        {"cos", turned_cos, cosq, -0.78, 0.78, 0.56},
        {"cos", turned_cos, cosq, -1e6, 1e6, 0.9},
        {"log", maths_log, logq, 0.5, 2, 0.9},
        {"log", maths_log, logq, 1e-300, 1e300, 0.6},
        {"atan", own_atan, atanq, -5, 5, 2.2},
        {"acos", own_acos, acosq, -1, 1, 3},
        {"asin", own_asin, asinq, -1, 1, 3},
        {"hypot", own_hypot, exact_hypot, -2, 2, 1.2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double worst = worst_of(cases[i].ours, cases[i].theirs, cases[i].from, cases[i].to);
        if (!(worst <= cases[i].most))
            fail_msg("%s from %g to %g: %.3f units in the last place", cases[i].name, cases[i].from, cases[i].to,
                     worst);
    }
}

static void assert_same(double actual, double expected)
{
    if (isnan(expected) ? !isnan(actual) : actual != expected || signbit(actual) != signbit(expected))
        fail_msg("expected %.17g, got %.17g", expected, actual);
}

TEST(ends_of_ranges_are_those_of_libm)
{
    static const double ends[] = {0.0, -0.0, 1, -1, 1e-320, -1e-320, 1e308, -1e308, INFINITY, -INFINITY, NAN};
    const int count = sizeof ends / sizeof *ends;
    for (int i = 0; i < count; i++) {
        const double x = ends[i];
        if (fabs(x) != 1) {
            assert_same(maths_exp(x), exp(x));
            assert_same(maths_expm1(x), expm1(x));
        }
        if (x >= 0 || isnan(x)) assert_same(maths_log(x), log(x));
        if (fabs(x) < 1) assert_same(maths_sin(x), sin(x)), assert_same(maths_cos(x), cos(x));
        for (int j = 0; j < count; j++) assert_same(maths_atan2(x, ends[j]), atan2(x, ends[j]));
        for (int j = 0; j < count; j++) assert_same(maths_hypot(x, ends[j]), hypot(x, ends[j]));
    }
    assert_same(maths_exp(-745), exp(-745));
    assert_same(maths_exp(709.75), exp(709.75));
    assert_same(maths_exp(710), INFINITY);
    assert_true(isnan(maths_sin(INFINITY)));
    assert_near(maths_sin(1e9), sin(1e9), 1e-7); // of an angle within its last digit
    assert_near(hypot(maths_sin(1e300), maths_cos(1e300)), 1, 1e-15);
}

TEST(powers_of_ten_are_exact)
{
    for (int n = -22; n <= 22; n++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", n);
        assert_same(maths_power_of_ten(n), strtod(text, NULL));
        assert_int_equal(maths_decade(maths_power_of_ten(n)), n);
        assert_int_equal(maths_decade(nextafter(maths_power_of_ten(n), 0)), n - 1);
    }
    assert_int_equal(maths_decade(3e-308), -308);
    assert_int_equal(maths_decade(1.5e308), 308);
}
