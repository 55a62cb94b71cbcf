/// Sentences for people: errors of data and of the environment, and text from outside made fit for terminals and windows.
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

// Errors of data and of the environment: a kind, which is also the exit status, and one sentence for people.

enum error_kind {
    ERROR_NONE = 0,
    ERROR_INPUT = 1,       ///< a file or an edit was bad
    ERROR_USAGE = 2,       ///< the command line was wrong
    ERROR_ENVIRONMENT = 3, ///< no GL, disk full, no memory
};

struct error {
    enum error_kind kind;
    char text[768]; ///< one sentence, no newline: "file:line: path: expected …, got …"
};

/// Fills `error` (which may be NULL) and returns false, so that callers can write `return fail(…)`.
/// Bytes that are not printable ASCII or valid UTF-8 are replaced by '?'; a text that is too long is cut at a whole character.
bool fail(struct error *error, enum error_kind kind, const char *format, ...) __attribute__((format(printf, 3, 4)));

/// fail() with "what: not enough memory"; `what` is a path or an activity.
bool fail_no_memory(struct error *error, const char *what);

// Text from outside, fit for terminals and windows.

/// Decodes one UTF-8 character and moves on; 0xFFFD for a broken byte, 0 at the end.
uint32_t utf8_next(const char **text);
/// Writes a character as UTF-8, without an end; returns how many bytes.
int utf8_encode(uint32_t codepoint, char bytes[4]);

/// Copies a text, with control characters and bytes that are no UTF-8 as \n or \x1b; what does not fit is cut at a whole character and
/// ends in "…".
void printable(const char *text, char *shown, size_t size);

/// Writes a line, and its end, that may repeat a path, a name or an argument.
void print_line(FILE *stream, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Adds to a text in an array of `size` bytes as much as there is room for.
#define print_more(text, size, ...) snprintf((text) + strlen(text), (size)-strlen(text), __VA_ARGS__)

/// Writes a field of a table by RFC 4180: a name and a suffix, quoted if it has a comma, a quote or a line break. A file or pipe gets the name
/// unchanged, a terminal gets printable().
void print_field(FILE *stream, const char *name, const char *suffix);

/// A number for printing in steps of `unit`: 0 if it would be printed as −0.
static inline double printable_number(double value, double unit) { return fabs(value) <= unit / 2 ? 0 : value; }

#endif
