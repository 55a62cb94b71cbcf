/// The shortest text that reads back as the same number.
#include "scene/text.h"
#include <assert.h>
#include <ctype.h>
#include <math.h>
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
    const struct decimal d = shortest_decimal(magnitude);
    if (d.point >= LEAST_POINT && d.point <= MOST_POINT) return sign + print_plain(&d, text + sign);
    return sign + print_exponent(&d, text + sign, NUMBER_TEXT_SIZE - sign);
}
