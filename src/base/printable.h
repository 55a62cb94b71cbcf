/// Text from outside, fit for terminals and windows.
#ifndef BASE_PRINTABLE_H
#define BASE_PRINTABLE_H

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/// Copies a text, with control characters and bytes that are no UTF-8 as \n or \x1b; what does not fit is cut at a whole character and
/// ends in "…".
void printable(const char *text, char *shown, size_t size);

/// Writes a line, and its end, that may repeat a path, a name or an argument.
void print_line(FILE *stream, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Writes a field of a table by RFC 4180: a name and what follows it, quoted if it has a comma, a quote or a line break. A file or a pipe
/// gets the name as it is, a terminal as printable() makes it.
void print_field(FILE *stream, const char *name, const char *suffix);

/// A number to be printed in steps of `unit`: 0 where it would be shown as −0.
static inline double printable_number(double value, double unit) { return fabs(value) <= unit / 2 ? 0 : value; }

#endif
