/// Writes PNG files.
#include "base/png.h"
#include "base/file.h"
#include <stdlib.h>

// The implementation lives here and nowhere else; the library is not written for our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

/// Where the encoder's output goes, and whether all of it arrived.
struct sink {
    const char *path;
    struct error *error;
    bool written;
};

/// The encoder hands the finished file over in one piece.
static void store(void *context, void *data, int size)
{
    struct sink *sink = context;
    sink->written = file_write_atomic(sink->path, data, (size_t)size, sink->error);
}

bool png_write(const char *path, int width, int height, const unsigned char *rgba, struct error *error)
{
    if (width < 1 || height < 1 || width > 16384 || height > 16384) {
        return fail(error, ERROR_INPUT, "%s: expected a picture of 1 to 16384 pixels a side, got %d × %d", path,
                    width, height);
    }
    struct sink sink = {.path = path, .error = error};
    stbi_write_png_compression_level = 5;
    if (!stbi_write_png_to_func(store, &sink, width, height, 4, rgba, width * 4)) {
        return fail(error, ERROR_ENVIRONMENT, "%s: out of memory while the picture was compressed", path);
    }
    return sink.written;
}
