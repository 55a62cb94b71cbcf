/// Decodes PNG and JPEG pictures.
#include "model/gltf.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

static _Thread_local bool starved; ///< the picture library ran out of memory; it does not say so

static void *noted(void *memory)
{
    starved |= !memory;
    return memory;
}

// The implementation is included here only; it does not compile under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#ifdef __clang__ // for fuzzing: in a broken JPEG the library's numbers wrap; memory errors are still found
#pragma clang attribute push(__attribute__((no_sanitize("shift", "signed-integer-overflow"))), apply_to = function)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MAX_DIMENSIONS 16384
// A scan may name a table that the file lacks. Then it is zeros, and not old memory.
#define STBI_MALLOC(size) noted(calloc(1, size))
#define STBI_REALLOC(old, size) noted(realloc(old, size))
#define STBI_FREE free
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif
#pragma GCC diagnostic pop

// --- checks before decoding: the chunks of a PNG (ISO 15948) and the segments of a JPEG (ITU T.81, annex B)

enum { MARKER = 0xFF, START = 0xD8, END = 0xD9, FIRST_RESTART = 0xD0, HUFFMAN_TABLES = 0xC4 };
enum { LENGTHS = 16, MOST_CODES = 256 };
enum { SIGNATURE = 8, CHUNK_HEAD = 8, CHUNK_TAIL = 4 };

/// Whether a JPEG's Huffman tables lie within their segments and have at most 256 codes: otherwise stb_image up to 2.28 writes past its tables.
static bool jpeg_is_sound(const unsigned char *at, const unsigned char *end)
{
    while ((at = memchr(at, MARKER, (size_t)(end - at)))) { // coded samples may lie between
        while (at < end && *at == MARKER) at++;
        if (at == end || *at == END) return true;
        const int marker = *at++;
        const bool alone = marker == 0 || (marker >= FIRST_RESTART && marker <= START);
        if (alone) continue;
        const long length = end - at < 2 ? 0 : at[0] << 8 | at[1];
        if (length < 2 || length > end - at) return marker != HUFFMAN_TABLES;
        const unsigned char *table = at + 2;
        at += length;
        while (marker == HUFFMAN_TABLES && table < at) { // a byte, the number of codes of each length, the codes
            int codes = 0;
            if (at - table < 1 + LENGTHS) return false;
            for (int i = 1; i <= LENGTHS; i++) codes += table[i];
            if (codes > MOST_CODES || codes > at - table - 1 - LENGTHS) return false;
            table += 1 + LENGTHS + codes;
        }
    }
    return true;
}

/// Whether a PNG's chunks end within the file and its data does not begin with an empty one: otherwise stb_image allocates what a chunk claims,
/// and copies an empty one to nowhere.
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

// --- pictures

enum { PIXELS_A_BYTE = 8256 }; // the most that deflate packs into a byte, at one bit per pixel

bool gltf_decode_image(const unsigned char *bytes, size_t size, size_t most, struct gltf_image *image,
                       struct error *error)
{
    const unsigned char *end = bytes + size;
    const bool is_png = size >= SIGNATURE && memcmp(bytes, "\x89PNG", 4) == 0;
    const bool is_jpeg = !is_png && size > 0 && bytes[0] == MARKER; // may begin with padding
    int channels, length = size <= INT_MAX ? (int)size : 0;
    if ((is_png && !png_is_sound(bytes, end)) || (is_jpeg && !jpeg_is_sound(bytes, end)))
        return fail(error, ERROR_INPUT, "expected PNG or JPEG: a part of it is too large, or empty");
    starved = false;
    if (!stbi_info_from_memory(bytes, length, &image->width, &image->height, &channels))
        return starved ? fail(error, ERROR_ENVIRONMENT, "not enough memory")
                       : fail(error, ERROR_INPUT, "expected PNG or JPEG of at most %d pixels a side: %s",
                              STBI_MAX_DIMENSIONS, stbi_failure_reason());
    size_t pixels = (size_t)image->width * (size_t)image->height;
    if (pixels / PIXELS_A_BYTE > size || 4 * pixels > most)
        return fail(error, ERROR_INPUT, "too large with %d by %d", image->width, image->height);
    image->pixels = stbi_load_from_memory(bytes, length, &image->width, &image->height, &channels, 4);
    if (image->pixels) return true;
    return starved ? fail(error, ERROR_ENVIRONMENT, "not enough memory")
                   : fail(error, ERROR_INPUT, "%s", stbi_failure_reason());
}
