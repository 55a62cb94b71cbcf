/// Turns bytes into base64 and back.
#include "base/base64.h"
#include <stdint.h>
#include <string.h>

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void base64_encode(const void *bytes, size_t size, char *text)
{
    const unsigned char *from = bytes;
    for (size_t i = 0; i < size; i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; k++) bits = bits << 8 | (i + k < size ? from[i + k] : 0);
        for (size_t k = 0; k < 4; k++) *text++ = i + k > size ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    *text = '\0';
}

bool base64_decode(const char *text, void *bytes, size_t *size)
{
    unsigned char *to = bytes;
    uint32_t bits = 0;
    int pending = 0;
    *size = 0;
    for (; *text && *text != '='; text++) {
        const char *digit = strchr(digits, *text);
        if (!digit) return false;
        bits = bits << 6 | (uint32_t)(digit - digits);
        pending += 6;
        if (pending < 8) continue;
        pending -= 8;
        to[(*size)++] = (unsigned char)(bits >> pending);
    }
    return pending < 6 && strspn(text, "=") == strlen(text);
}
