/// Walks the chunks of a PNG (ISO 15948) and the segments of a JPEG (ITU T.81, annex B) as their decoder does.
#include "model/picture_check.h"
#include <string.h>

enum { MARKER = 0xFF, START = 0xD8, END = 0xD9, FIRST_RESTART = 0xD0, HUFFMAN_TABLES = 0xC4 };
enum { LENGTHS = 16, MOST_CODES = 256 };
enum { SIGNATURE = 8, CHUNK_HEAD = 8, CHUNK_TAIL = 4 };

/// A segment's tables: a byte that names it, how many codes there are of each length, the codes.
static bool tables_fit(const unsigned char *at, const unsigned char *end)
{
    while (at < end) {
        int codes = 0;
        if (end - at < 1 + LENGTHS) return false;
        for (int i = 1; i <= LENGTHS; i++) codes += at[i];
        if (codes > MOST_CODES || codes > end - at - 1 - LENGTHS) return false;
        at += 1 + LENGTHS + codes;
    }
    return true;
}

/// Behind the next marker, or NULL. What is no marker lies between, as coded samples do.
static const unsigned char *next_marker(const unsigned char *at, const unsigned char *end, int *marker)
{
    at = memchr(at, MARKER, (size_t)(end - at));
    while (at && at < end && *at == MARKER) at++;
    if (!at || at == end) return NULL;
    *marker = *at;
    return at + 1;
}

static bool jpeg_is_sound(const unsigned char *at, const unsigned char *end)
{
    int marker = 0;
    while ((at = next_marker(at, end, &marker)) && marker != END) {
        const bool alone = marker == 0 || (marker >= FIRST_RESTART && marker <= START);
        if (alone) continue;
        const long length = end - at < 2 ? 0 : at[0] << 8 | at[1];
        if (length < 2 || length > end - at) return marker != HUFFMAN_TABLES;
        if (marker == HUFFMAN_TABLES && !tables_fit(at + 2, at + length)) return false;
        at += length;
    }
    return true;
}

static bool png_is_sound(const unsigned char *at, const unsigned char *end)
{
    bool has_data = false;
    for (at += SIGNATURE; end - at >= CHUNK_HEAD;) {
        const long length = (long)at[0] << 24 | at[1] << 16 | at[2] << 8 | at[3];
        if (memcmp(at + 4, "IEND", 4) == 0) return true;
        const bool is_data = memcmp(at + 4, "IDAT", 4) == 0;
        if (is_data && length == 0 && !has_data) return false;
        has_data |= is_data;
        if (length > end - at - CHUNK_HEAD - CHUNK_TAIL) return false;
        at += CHUNK_HEAD + length + CHUNK_TAIL;
    }
    return true;
}

bool picture_is_sound(const unsigned char *bytes, size_t size)
{
    if (size >= SIGNATURE && memcmp(bytes, "\x89PNG", 4) == 0) return png_is_sound(bytes, bytes + size);
    if (size > 0 && bytes[0] == MARKER) return jpeg_is_sound(bytes, bytes + size); // its start may be filled up
    return true;
}
