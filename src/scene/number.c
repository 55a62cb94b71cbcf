/// The shortest text that reads back as the same number.
#include "scene/text.h"
#include <assert.h>
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DIGITS = 17, SURE_DIGITS = 15, TINY_EXPONENT = -300, LEAST_POINT = -4, MOST_POINT = 15 };

/// A decimal number: 0.d1 d2 d3 … · 10^point.
struct decimal {
    char digits[MAX_DIGITS + 1];
    int count, point;
};

/// A decimal of 15 digits survives a round trip through a double, so at 15 digits a shorter one shows as trailing zeros. Subnormals have
/// fewer digits and are searched from one up.
static struct decimal shortest_decimal(double magnitude)
{
    struct decimal d = {0};
    char text[48];
    int exponent = 0;
    int from = magnitude < pow(10, TINY_EXPONENT) ? 1 : SURE_DIGITS;
    for (int precision = from; precision <= MAX_DIGITS; precision++) {
        snprintf(text, sizeof text, "%.*e", precision - 1, magnitude);
        if (strtod(text, NULL) == magnitude) break;
    }
    for (const char *c = text; *c; c++) {
        if (*c == 'e') {
            exponent = atoi(c + 1);
            break;
        }
        if (isdigit((unsigned char)*c)) d.digits[d.count++] = *c;
    }
    while (d.count > 1 && d.digits[d.count - 1] == '0') d.count--;
    d.digits[d.count] = '\0';
    d.point = exponent + 1;
    return d;
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;

/// 10^point, as well as a double can say it.
static double power_of_ten(int point)
{
    static const double powers[] = {1e-4, 1e-3, 1e-2, 1e-1, 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,
                                    1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    return powers[point - LEAST_POINT];
}

/// m · 2^e · 10^k as the nearest integer, or 0 if that reads back as another number. Exact: m < 2^53, and 5^k < 2^49 as k ≤ 21. It
/// reads back if it is off by less than half a unit of m, which is 5^k / 2 here. (Half of that below a power of two; those are exact
/// here.)
static uint64_t round_scaled(uint64_t m, int e, int k)
{
    uint64_t power = 1;
    for (int i = 0; i < k; i++) power *= 5;
    const wide exact = (wide)m * power;
    const int shift = -(e + k);
    if (shift <= 0) return (uint64_t)(exact << -shift);
    const uint64_t below = (uint64_t)(exact >> shift);
    const wide rest = exact - ((wide)below << shift), unit = (wide)1 << shift;
    const bool up = 2 * rest > unit || (2 * rest == unit && below % 2 == 1);
    const wide off = 2 * (up ? unit - rest : rest);
    return off < power ? below + up : 0; // never equal: one is even, the other odd
}

/// What shortest_decimal() finds, many times faster, for numbers that are printed plainly.
static struct decimal shortest_plain(double magnitude)
{
    struct decimal d = {.point = LEAST_POINT};
    int e, digits = SURE_DIGITS - 1;
    uint64_t rounded = 0;
    const uint64_t m = (uint64_t)ldexp(frexp(magnitude, &e), DBL_MANT_DIG);
    while (magnitude >= power_of_ten(d.point)) d.point++;
    while (rounded == 0) rounded = round_scaled(m, e - DBL_MANT_DIG, ++digits - d.point);
    while (rounded % 10 == 0) {
        rounded /= 10;
        digits--;
    }
    if (digits <= 0) { // rounded up to the next power of ten
        digits = 1;
        d.point++;
    }
    d.count = digits;
    while (digits > 0) {
        d.digits[--digits] = (char)('0' + rounded % 10);
        rounded /= 10;
    }
    return d;
}
#else
static struct decimal shortest_plain(double magnitude) { return shortest_decimal(magnitude); }
#endif

static size_t print_plain(const struct decimal *d, char *text)
{
    const int zeros = d->point < 0 ? -d->point : 0, whole = d->point < d->count ? d->point : d->count;
    char *at = text;
    if (d->point <= 0) {
        memcpy(at, "0.00000", (size_t)zeros + 2);
        at += zeros + 2;
        memcpy(at, d->digits, (size_t)d->count);
        at += d->count;
    } else {
        memcpy(at, d->digits, (size_t)whole);
        at += whole;
        for (int i = d->count; i < d->point; i++) *at++ = '0';
        if (d->count > whole) {
            *at++ = '.';
            memcpy(at, d->digits + whole, (size_t)(d->count - whole));
            at += d->count - whole;
        }
    }
    *at = '\0';
    return (size_t)(at - text);
}

static size_t print_exponent(const struct decimal *d, char *text, size_t size)
{
    const char *point = d->count > 1 ? "." : "";
    return (size_t)snprintf(text, size, "%c%s%se%d", d->digits[0], point, d->digits + 1, d->point - 1);
}

size_t number_print(double value, char text[NUMBER_TEXT_SIZE])
{
    assert(isfinite(value));
    if (value == 0) {
        strcpy(text, "0");
        return 1;
    }
    size_t sign = value < 0;
    text[0] = '-';
    const double magnitude = fabs(value);
    const bool is_plain = magnitude >= 1e-5 && magnitude < 1e15;
    const struct decimal d = (is_plain ? shortest_plain : shortest_decimal)(magnitude);
    if (d.point >= LEAST_POINT && d.point <= MOST_POINT) return sign + print_plain(&d, text + sign);
    return sign + print_exponent(&d, text + sign, NUMBER_TEXT_SIZE - sign);
}
