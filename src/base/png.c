/// Writes PNG files.
#include "base/png.h"
#include "base/file.h"
#include <setjmp.h>
#include <stdlib.h>

/// The library does not check each of its allocations: where one fails, its call is left from there, and what it held is freed.
struct piece {
    struct piece *before, *after;
    max_align_t bytes[];
};
static _Thread_local struct piece *pieces; ///< of the picture that is being encoded
static _Thread_local jmp_buf no_memory;

static void *take(void *old, size_t size)
{
    struct piece *piece = old ? (struct piece *)((char *)old - offsetof(struct piece, bytes)) : NULL;
    struct piece *moved = realloc(piece, sizeof *piece + size);
    if (!moved) longjmp(no_memory, 1);
    if (!piece) *moved = (struct piece){.after = pieces};
    if (moved->after) moved->after->before = moved;
    if (moved->before)
        moved->before->after = moved;
    else
        pieces = moved;
    return moved->bytes;
}

static void give_back(void *bytes)
{
    if (!bytes) return;
    struct piece *piece = (struct piece *)((char *)bytes - offsetof(struct piece, bytes));
    if (piece->after) piece->after->before = piece->before;
    if (piece->before)
        piece->before->after = piece->after;
    else
        pieces = piece->after;
    free(piece);
}

// The implementation lives here and nowhere else; the library is not written for our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STBIW_MALLOC(size) take(NULL, size)
#define STBIW_REALLOC(piece, size) take(piece, size)
#define STBIW_FREE(piece) give_back(piece)
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

bool png_encode(void (*store)(void *user, const void *bytes, size_t size), void *user, int width, int height,
                int channels, const unsigned char *pixels, enum png_effort effort)
{
    int size;
    if (setjmp(no_memory)) {
        while (pieces) give_back(pieces->bytes);
        return false;
    }
    stbi_write_png_compression_level = (int)effort;
    unsigned char *png = stbi_write_png_to_mem(pixels, channels * width, width, height, channels, &size);
    store(user, png, (size_t)size);
    give_back(png);
    return true;
}

/// Where the encoder's output goes, and whether all of it arrived.
struct sink {
    const char *path;
    struct error *error;
    bool written;
};

static void store(void *user, const void *bytes, size_t size)
{
    struct sink *sink = user;
    sink->written = file_write_atomic(sink->path, bytes, size, sink->error);
}

bool png_write(const char *path, int width, int height, const unsigned char *rgba, struct error *error)
{
    if (width < 1 || height < 1 || width > 16384 || height > 16384) {
        return fail(error, ERROR_INPUT, "%s: expected a picture of 1 to 16384 pixels a side, got %d × %d", path,
                    width, height);
    }
    struct sink sink = {.path = path, .error = error};
    if (!png_encode(store, &sink, width, height, 4, rgba, PNG_FAST))
        return fail(error, ERROR_ENVIRONMENT, "%s: out of memory while the picture was compressed", path);
    return sink.written;
}
