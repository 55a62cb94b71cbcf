/// The shortest text that reads back as the same number.
#include "scene/number.h"
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DIGITS = 17, SURE_DIGITS = 15, TINY_EXPONENT = -300 };

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

static int print_plain(const struct decimal *d, char *text, size_t size)
{
    if (d->point <= 0) return snprintf(text, size, "0.%.*s%s", -d->point, "00000", d->digits);
    if (d->point >= d->count)
        return snprintf(text, size, "%s%.*s", d->digits, d->point - d->count, "000000000000000");
    return snprintf(text, size, "%.*s.%s", d->point, d->digits, d->digits + d->point);
}

static int print_exponent(const struct decimal *d, char *text, size_t size)
{
    const char *point = d->count > 1 ? "." : "";
    return snprintf(text, size, "%c%s%se%d", d->digits[0], point, d->digits + 1, d->point - 1);
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
    struct decimal d = shortest_decimal(fabs(value));
    bool plain = d.point > -5 && d.point <= 15;
    int length = (plain ? print_plain : print_exponent)(&d, text + sign, NUMBER_TEXT_SIZE - sign);
    return sign + (size_t)length;
}
