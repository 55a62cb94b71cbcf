/// Gives the JSON library its memory; bytes as base64.
#include "base/json.h"
#include "base/need.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static void *take(size_t size) { return need(size, 1); }

/// Runs before main(), so that the library allocates everything with need().
__attribute__((constructor)) static void give_memory(void) { json_set_alloc_funcs(take, free); }

json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error)
{
    // At least the memory that the library needs for a text: its token buffer grows to twice the text, and each value, member, list and
    // object begins with one of these characters.
    enum { VALUE = 256, TOKEN = 4, BASIS = 4096 };
    size_t values = 0;
    for (size_t i = 0; i < size; i++) values += text[i] == ',' || text[i] == ':' || text[i] == '{' || text[i] == '[';
    if (need_has_room(VALUE * values + TOKEN * size + BASIS)) return json_loadb(text, size, flags, error);
    if (error) {
        strcpy(error->text, "out of memory");
        error->text[JSON_ERROR_TEXT_LENGTH - 1] = (char)json_error_out_of_memory; // where json_error_code() looks
    }
    return NULL;
}

// --- base64

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
