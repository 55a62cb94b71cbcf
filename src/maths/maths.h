/// Elementary functions with the same bits on every machine: made of IEEE's exactly rounded operations alone, which libm's are not everywhere.
/// Errors are at most those of test_maths, in units in the last place.
#ifndef MATHS_MATHS_H
#define MATHS_MATHS_H

#if defined __FAST_MATH__ || defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__ || defined _M_FP_FAST
#error "wiggly's curves are wrong under -ffast-math: compile its sources without it"
#endif

#include <math.h>
#include <stdint.h>
#include <string.h>

/// A number's bits, and the number of these.
static inline uint64_t maths_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
static inline double maths_from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

double maths_exp(double x);

/// exp(x) − 1.
double maths_expm1(double x);

/// A point of the unit circle.
typedef struct maths_point {
    double cos, sin;
} maths_point;

__attribute__((const)) maths_point maths_turn(double angle);

static inline double maths_cos(double angle) { return maths_turn(angle).cos; }
static inline double maths_sin(double angle) { return maths_turn(angle).sin; }

double maths_log(double x);

/// −π … π.
double maths_atan2(double y, double x);

static inline double maths_acos(double x) { return maths_atan2(sqrt((1 - x) * (1 + x)), x); }
static inline double maths_asin(double x) { return maths_atan2(x, sqrt((1 - x) * (1 + x))); }

/// √(x² + y²).
double maths_hypot(double x, double y);

/// Σ a_k b_k, in lanes of eight.
double maths_dot(const double *a, const double *b, int n);

// In float: double's result, rounded.
static inline float maths_sinf(float angle) { return (float)maths_sin((double)angle); }
static inline float maths_cosf(float angle) { return (float)maths_cos((double)angle); }
static inline float maths_tanf(float angle)
{
    const maths_point at = maths_turn((double)angle);
    return (float)(at.sin / at.cos);
}
static inline float maths_atan2f(float y, float x) { return (float)maths_atan2((double)y, (double)x); }
static inline float maths_acosf(float x) { return (float)maths_acos((double)x); }
static inline float maths_asinf(float x) { return (float)maths_asin((double)x); }
static inline float maths_expf(float x) { return (float)maths_exp((double)x); }
static inline float maths_logf(float x) { return (float)maths_log((double)x); }
static inline float maths_hypotf(float x, float y)
{
    return (float)sqrt((double)x * (double)x + (double)y * (double)y);
}

/// For qsort(): ascending by the double that an element begins with.
int maths_compare(const void *a, const void *b);

/// 10ⁿ, exactly rounded for |n| ≤ 22.
double maths_power_of_ten(int n);

/// ⌊log₁₀ x⌋ of a finite x > 0.
int maths_decade(double x);

#endif
