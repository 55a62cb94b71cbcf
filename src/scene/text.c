/// A growing text, and colours: "#RRGGBB".
#include "scene/text.h"
#include "base/need.h"
#include <jansson.h>
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
    text_bytes(text, digits, number_print(value, digits));
}

/// How many characters from here on need no escape.
static size_t plain_length(const char *c)
{
    size_t length = 0;
    while ((unsigned char)c[length] >= 0x20 && c[length] != '"' && c[length] != '\\') length++;
    return length;
}

void text_quoted(struct text *text, const char *string)
{
    text_string(text, "\"");
    for (const char *c = string; *c;) {
        const size_t plain = plain_length(c);
        char escape[8];
        text_bytes(text, c, plain);
        c += plain;
        if (!*c) break;
        const bool is_control = (unsigned char)*c < 0x20;
        snprintf(escape, sizeof escape, is_control ? "\\u%04x" : "\\%c", (unsigned char)*c);
        text_string(text, escape);
        c++;
    }
    text_string(text, "\"");
}

static void text_array(struct text *text, const json_t *array)
{
    text_string(text, "[");
    for (size_t i = 0; i < json_array_size(array); i++) {
        if (i > 0) text_string(text, ", ");
        text_json(text, json_array_get(array, i));
    }
    text_string(text, "]");
}

static void text_object(struct text *text, json_t *object)
{
    const char *key, *separator = "{ ";
    json_t *value;
    json_object_foreach(object, key, value)
    {
        text_string(text, separator);
        text_quoted(text, key);
        text_string(text, ": ");
        text_json(text, value);
        separator = ", ";
    }
    text_string(text, json_object_size(object) > 0 ? " }" : "{}");
}

/// No deeper than the file was (SOURCE_MAX_DEPTH).
void text_json(struct text *text, json_t *value)
{
    char integer[32];
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        text_object(text, value);
        break;
    case JSON_ARRAY:
        text_array(text, value);
        break;
    case JSON_STRING:
        text_quoted(text, json_string_value(value));
        break;
    case JSON_INTEGER:
        snprintf(integer, sizeof integer, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
        text_string(text, integer);
        break;
    case JSON_REAL:
        text_number(text, json_real_value(value));
        break;
    case JSON_TRUE:
        text_string(text, "true");
        break;
    case JSON_FALSE:
        text_string(text, "false");
        break;
    case JSON_NULL:
        text_string(text, "null");
        break;
    }
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
