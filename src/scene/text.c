/// A growing text, numbers as the shortest text that reads back the same, and colours: "#RRGGBB".
#include "scene/text.h"
#include "base/error.h"
#include "base/need.h"
#include <assert.h>
#include <ctype.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 4096 };

void text_bytes(struct text *text, const char *bytes, size_t count)
{
    const size_t needed = text->size + count;
    if (needed > text->capacity) {
        text->capacity = needed > FIRST_CAPACITY / 2 ? 2 * needed : FIRST_CAPACITY;
        text->data = need_more(text->data, text->capacity, 1);
    }
    if (count > 0) memcpy(text->data + text->size, bytes, count);
    text->size = needed;
}

void text_string(struct text *text, const char *string) { text_bytes(text, string, strlen(string)); }

void text_number(struct text *text, double value)
{
    char digits[NUMBER_TEXT_SIZE];
    const size_t length = number_print(value, digits);
    text_bytes(text, digits, length);
}

/// A byte of a path that is not UTF-8 is this letter plus the byte: one of Unicode's private letters, at the end of its range, where
/// nobody else has any. The file stays UTF-8, and the path comes back as it was.
enum { BYTE_LETTER = 0x10FE00, FIRST_BYTE = 0x80, LAST_BYTE = 0xFF };

static bool is_byte_letter(uint32_t c) { return c >= BYTE_LETTER + FIRST_BYTE && c <= BYTE_LETTER + LAST_BYTE; }

static void text_quote(struct text *text, const char *string, bool is_path)
{
    char escape[8];
    text_string(text, "\"");
    for (const char *c = string; *c;) {
        const char *next = c;
        while ((unsigned char)*next >= 0x20 && (unsigned char)*next < 0x80 && *next != '"' && *next != '\\') next++;
        text_bytes(text, c, (size_t)(next - c)); // what needs no look
        c = next;
        if (!*c) break;

        const uint32_t letter = utf8_next(&next);
        if ((letter == 0xFFFD && next == c + 1) || (is_path && is_byte_letter(letter))) {
            for (; c < next; c++)
                text_bytes(text, escape, (size_t)utf8_encode(BYTE_LETTER + (unsigned char)*c, escape));
        } else if (letter >= 0x80) {
            text_bytes(text, c, (size_t)(next - c));
        } else {
            snprintf(escape, sizeof escape, letter < 0x20 ? "\\u%04x" : "\\%c", (unsigned)letter);
            text_string(text, escape);
        }
        c = next;
    }
    text_string(text, "\"");
}

void text_quoted(struct text *text, const char *string) { text_quote(text, string, false); }

void text_path(struct text *text, const char *path) { text_quote(text, path, true); }

void text_read_path(char *path)
{
    char *to = path;
    for (const char *from = path; *from;) {
        const char *letter = from;
        const uint32_t c = utf8_next(&from);
        if (is_byte_letter(c)) {
            *to++ = (char)(c - BYTE_LETTER);
        } else {
            memmove(to, letter, (size_t)(from - letter));
            to += from - letter;
        }
    }
    *to = '\0';
}

/// No deeper than the file (SOURCE_MAX_DEPTH).
void text_json(struct text *text, json_t *value)
{
    const char *key, *separator = "{ ";
    json_t *member;
    char plain[32];
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        json_object_foreach(value, key, member)
        {
            text_string(text, separator);
            text_quoted(text, key);
            text_string(text, ": ");
            text_json(text, member);
            separator = ", ";
        }
        text_string(text, json_object_size(value) > 0 ? " }" : "{}");
        break;
    case JSON_ARRAY:
        text_string(text, "[");
        for (size_t i = 0; i < json_array_size(value); i++) {
            if (i > 0) text_string(text, ", ");
            text_json(text, json_array_get(value, i));
        }
        text_string(text, "]");
        break;
    case JSON_STRING:
        text_quoted(text, json_string_value(value));
        break;
    case JSON_REAL:
        text_number(text, json_real_value(value));
        break;
    default: // a whole number, true, false or null
        text_bytes(text, plain, json_dumpb(value, plain, sizeof plain, JSON_ENCODE_ANY));
        break;
    }
}

enum { MAX_DIGITS = 17, SURE_DIGITS = 15, LEAST_POINT = -4, MOST_POINT = 15 };
static const double tiny = 1e-300;

size_t number_print(double value, char text[NUMBER_TEXT_SIZE])
{
    assert(isfinite(value));
    if (value == 0) {
        strcpy(text, "0");
        return 1;
    }

    // The shortest decimal that reads back the same. Any decimal of up to 15 digits survives a round trip through a double, so rounding to
    // 15 digits shows a shorter one as trailing zeros. Subnormals have fewer digits: these are tried from one up.
    const double magnitude = fabs(value);
    char printed[48], digits[MAX_DIGITS + 1]; // 0.d1 d2 d3 … · 10^point
    int count = 0, point = 1;
    for (int precision = magnitude < tiny ? 1 : SURE_DIGITS; precision <= MAX_DIGITS; precision++) {
        snprintf(printed, sizeof printed, "%.*e", precision - 1, magnitude);
        if (strtod(printed, NULL) == magnitude) break;
    }
    for (const char *c = printed; *c; c++) {
        if (*c == 'e') {
            point = atoi(c + 1) + 1;
            break;
        }
        if (isdigit((unsigned char)*c)) digits[count++] = *c;
    }
    while (count > 1 && digits[count - 1] == '0') count--;
    digits[count] = '\0';

    size_t sign = value < 0;
    text[0] = '-';
    char *at = text + sign;
    if (point < LEAST_POINT || point > MOST_POINT)
        return sign + (size_t)snprintf(at, NUMBER_TEXT_SIZE - sign, "%c%s%se%d", digits[0], count > 1 ? "." : "",
                                       digits + 1, point - 1);
    const int first = point < 1 ? point - 1 : 0, end = point > count ? point : count;
    for (int i = first; i < end; i++) {
        if (i == point) *at++ = '.';
        *at++ = i >= 0 && i < count ? digits[i] : '0';
    }
    *at = '\0';
    return (size_t)(at - text);
}

size_t text_size(const char *string) { return string ? strlen(string) + 1 : 0; }

bool color_parse(const char *text, int *color)
{
    if (text[0] != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6) return false;
    *color = (int)strtol(text + 1, NULL, 16);
    return true;
}

void color_print(int color, char text[COLOR_TEXT_SIZE])
{
    snprintf(text, COLOR_TEXT_SIZE, "#%06X", (unsigned)color & 0xFFFFFFu);
}
