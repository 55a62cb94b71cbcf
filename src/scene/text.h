/// A growing text for JSON; numbers and colours as in files.
#ifndef SCENE_TEXT_H
#define SCENE_TEXT_H

#include <stdbool.h>
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
/// A string in quotes with what must be escaped. Bytes that are not UTF-8 become private letters, so that the file can be read.
void text_quoted(struct text *text, const char *string);
/// A path, which may have any bytes, and makes text_read_path() of the string that is read from the file again.
void text_path(struct text *text, const char *path);
void text_read_path(char *path);
/// Bytes of a string with its end; 0 for NULL.
size_t text_size(const char *string);
/// Any value on one line: { "a": [1, 2] }.
void text_json(struct text *text, struct json_t *value);

enum { NUMBER_TEXT_SIZE = 32 }; ///< room for any double

/// Writes the fewest digits that read back equal, as plain decimals from 1e-5 up to 1e15 and with an exponent beyond:
/// 0.1, 120, 1.5e-7. Both zeros are "0". The same in every locale. `value` must be finite. Returns the length.
size_t number_print(double value, char text[NUMBER_TEXT_SIZE]);

enum { COLOR_TEXT_SIZE = 8 };

/// Reads "#RRGGBB" (six hexadecimal digits of either case) into 0xRRGGBB; false for anything else.
bool color_parse(const char *text, int *color);

/// Writes 0xRRGGBB as "#RRGGBB" with capital digits.
void color_print(int color, char text[COLOR_TEXT_SIZE]);

#endif
