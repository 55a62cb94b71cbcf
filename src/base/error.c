/// Builds the sentence of an error, and shows text from outside.
#include "base/error.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool fail(struct error *error, enum error_kind kind, const char *format, ...)
{
    if (!error) return false;
    char text[4 * sizeof error->text]; // arguments may lie in error->text itself
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    printable(text, error->text, sizeof error->text);
    error->kind = kind;
    return false;
}

bool fail_no_memory(struct error *error, const char *what)
{
    return fail(error, ERROR_ENVIRONMENT, "%s: not enough memory", what);
}

static int utf8_length(const unsigned char *s)
{
    int n = *s < 0x80                           ? 1
            : (*s & 0xE0) == 0xC0 && *s >= 0xC2 ? 2
            : (*s & 0xF0) == 0xE0               ? 3
            : (*s & 0xF8) == 0xF0               ? 4
                                                : 0;
    for (int i = 1; i < n; i++) {
        if ((s[i] & 0xC0) != 0x80) return 0;
    }
    return n;
}

/// U+0080 … U+009F are control characters as well: some terminals obey them.
static int plain_length(const unsigned char *s)
{
    const int n = utf8_length(s);
    const int is_control = *s < 0x20 || *s == 0x7F || (n == 2 && *s == 0xC2 && s[1] < 0xA0);
    return is_control ? 0 : n;
}

void printable(const char *text, char *shown, size_t size)
{
    static const char more[] = "…";
    size_t used = 0, cut = 0; // `cut`: where the sign for more would still fit
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        char piece[8];
        int taken = plain_length(s), length = taken;
        if (taken > 0) {
            memcpy(piece, s, (size_t)taken);
        } else {
            taken = 1;
            length = *s == '\n' ? snprintf(piece, sizeof piece, "\\n") : snprintf(piece, sizeof piece, "\\x%02x", *s);
        }
        if (used + sizeof more <= size) cut = used;
        if (used + (size_t)length >= size) {
            memcpy(shown + cut, more, sizeof more);
            return;
        }
        memcpy(shown + used, piece, (size_t)length);
        used += (size_t)length;
        s += taken;
    }
    shown[used] = '\0';
}

void print_line(FILE *stream, const char *format, ...)
{
    char text[8192], shown[8192];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    printable(text, shown, sizeof shown);
    fprintf(stream, "%s\n", shown);
}

void print_field(FILE *stream, const char *name, const char *suffix)
{
    char shown[8192] = "";
    const int cause = errno; // of an earlier failure to write
    if (isatty(fileno(stream))) {
        printable(name, shown, sizeof shown);
        name = shown;
    }
    errno = cause;
    const int quotes = strpbrk(name, ",\"\r\n") != NULL;
    if (quotes) fputc('"', stream);
    for (const char *c = name; *c; c++) {
        if (*c == '"') fputc('"', stream);
        fputc(*c, stream);
    }
    fputs(suffix, stream);
    if (quotes) fputc('"', stream);
}
