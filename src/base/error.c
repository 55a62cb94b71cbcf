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
    char text[4 * sizeof error->text]; // arguments may lie in error->text
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

enum { REPLACEMENT = 0xFFFD };

uint32_t utf8_next(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text, first = *s;
    if (first == 0) return 0;
    // How many bytes follow the first one, which has fewer bits of the character the more there are; −1: it is no first byte.
    const int count = first < 0x80   ? 0
                      : first < 0xC2 ? -1
                      : first < 0xE0 ? 1
                      : first < 0xF0 ? 2
                      : first < 0xF5 ? 3
                                     : -1;
    uint32_t codepoint = count > 0 ? first & (0x3Fu >> count) : first;
    *text += 1;
    for (int i = 1; i <= count; i++) {
        if ((s[i] & 0xC0) != 0x80) return REPLACEMENT;
        codepoint = codepoint << 6 | (s[i] & 0x3Fu);
    }
    bool overlong = (count == 2 && codepoint < 0x800) || (count == 3 && codepoint < 0x10000);
    if (count < 0 || overlong || codepoint > 0x10FFFF || (codepoint >= 0xD800 && codepoint <= 0xDFFF))
        return REPLACEMENT;
    *text += count;
    return codepoint;
}

void printable(const char *text, char *shown, size_t size)
{
    static const char more[] = "…";
    size_t used = 0, cut = 0; // `cut`: last position at which "…" still fits
    for (const char *s = text; *s;) {
        char piece[8];
        const char *next = s;
        const uint32_t c = utf8_next(&next);
        // U+0080 … U+009F are control characters as well: some terminals obey them.
        const bool is_broken = c == REPLACEMENT && next == s + 1, is_control = c < 0x20 || (c >= 0x7F && c < 0xA0);
        int taken = is_broken || is_control ? 0 : (int)(next - s), length = taken;
        if (taken > 0) {
            memcpy(piece, s, (size_t)taken);
        } else {
            taken = 1;
            length = *s == '\n' ? snprintf(piece, sizeof piece, "\\n")
                                : snprintf(piece, sizeof piece, "\\x%02x", (unsigned char)*s);
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
    const int cause = errno; // from an earlier failed write
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

int utf8_encode(uint32_t codepoint, char bytes[4])
{
    static const unsigned leads[] = {0, 0, 0xC0, 0xE0, 0xF0};
    const int n = codepoint < 0x80 ? 1 : codepoint < 0x800 ? 2 : codepoint < 0x10000 ? 3 : 4;
    for (int i = n - 1; i > 0; i--, codepoint >>= 6) bytes[i] = (char)(0x80 | (codepoint & 0x3F));
    bytes[0] = (char)(leads[n] | codepoint);
    return n;
}
