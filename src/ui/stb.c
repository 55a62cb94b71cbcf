/// The implementation of stb_truetype, in a file of its own: it does not pass our warnings.
#include <stddef.h>

/// What one glyph needs, four times over: the library does not check each of its allocations, and the fonts are known.
static _Alignas(max_align_t) unsigned char room[1 << 18];
static size_t used;
static int pieces;

static void *take(size_t size)
{
    const size_t whole = (size + sizeof(max_align_t) - 1) / sizeof(max_align_t) * sizeof(max_align_t);
    if (whole > sizeof room - used) return NULL;
    pieces++;
    used += whole;
    return room + used - whole;
}

static void give_back(const void *piece)
{
    if (piece && --pieces == 0) used = 0;
}

#define STBTT_malloc(size, user) ((void)(user), take(size))
#define STBTT_free(piece, user) ((void)(user), give_back(piece))
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
