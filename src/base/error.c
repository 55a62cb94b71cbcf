/// Builds the sentence of an error.
#include "base/error.h"
#include <stdio.h>
#include <string.h>

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

/// Terminals and the status line show this text: control characters and broken UTF-8 must not reach them.
static void make_printable(char *text)
{
    unsigned char *s = (unsigned char *)text;
    while (*s) {
        int n = utf8_length(s);
        if (n == 0 || (n == 1 && (*s < 0x20 || *s == 0x7F))) {
            *s++ = '?';
        } else {
            s += n;
        }
    }
}

bool fail(struct error *error, enum error_kind kind, const char *format, ...)
{
    if (!error) return false;
    char text[sizeof error->text]; // arguments may lie in error->text itself
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length >= (int)sizeof text) {
        size_t end = sizeof text - sizeof "…";
        while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80) end--;
        memcpy(text + end, "…", sizeof "…");
    }
    make_printable(text);
    error->kind = kind;
    memcpy(error->text, text, strlen(text) + 1);
    return false;
}

bool fail_no_memory(struct error *error, const char *what)
{
    return fail(error, ERROR_ENVIRONMENT, "%s: not enough memory", what);
}
