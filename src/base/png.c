/// Writes PNG files.
#include "base/png.h"
#include "base/file.h"
#include "base/need.h"
#include <stdlib.h>

// The implementation is included here only; it does not compile under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STBIW_MALLOC(size) need(size, 1)
#define STBIW_REALLOC(piece, size) need_more(piece, size, 1)
#define STBIW_FREE(piece) free(piece)
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

void png_encode(void (*store)(void *user, const void *bytes, size_t size), void *user, const struct png_picture *p,
                enum png_effort effort)
{
    int size;
    stbi_write_png_compression_level = (int)effort;
    unsigned char *png =
        stbi_write_png_to_mem(p->pixels, p->channels * p->width, p->width, p->height, p->channels, &size);
    store(user, png, (size_t)size);
    free(png);
}

/// The destination of the encoder's output, and whether all of it was written.
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
    png_encode(store, &sink, &(struct png_picture){width, height, 4, rgba}, PNG_FAST);
    return sink.written;
}
