/// Steps through UTF-8 text.
#include "ui/font.h"

enum { REPLACEMENT = 0xFFFD };

/// Number of bytes after a first byte, and its own bits; -1 if it cannot be a first byte.
static int continuation_bytes(unsigned char first, uint32_t *bits)
{
    if (first < 0x80) return *bits = first, 0;
    if (first >= 0xC2 && first <= 0xDF) return *bits = first & 0x1Fu, 1;
    if (first >= 0xE0 && first <= 0xEF) return *bits = first & 0x0Fu, 2;
    if (first >= 0xF0 && first <= 0xF4) return *bits = first & 0x07u, 3;
    return -1;
}

uint32_t utf8_next(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    if (*s == 0) return 0;
    uint32_t codepoint = 0;
    int count = continuation_bytes(*s, &codepoint);
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
