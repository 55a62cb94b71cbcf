/// A growing text with the pieces that JSON is made of.
#ifndef SCENE_TEXT_H
#define SCENE_TEXT_H

#include <stddef.h>

struct json_t;

/// Starts as zeros.
struct text {
    char *data;
    size_t size, capacity;
};

void text_bytes(struct text *text, const char *bytes, size_t count);
void text_string(struct text *text, const char *string);
/// The shortest number that reads back equal.
void text_number(struct text *text, double value);
/// A string in quotes with what must be escaped.
void text_quoted(struct text *text, const char *string);
/// Bytes of a string with its end; 0 for NULL.
size_t text_size(const char *string);
/// Any value on one line: { "a": [1, 2] }.
void text_json(struct text *text, struct json_t *value);

#endif
