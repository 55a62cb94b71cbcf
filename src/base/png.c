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

unsigned char *png_encode(const struct png_picture *p, enum png_effort effort, int *size)
{
    stbi_write_png_compression_level = (int)effort;
    return stbi_write_png_to_mem(p->pixels, p->channels * p->width, p->width, p->height, p->channels, size);
}

bool png_write(const char *path, int width, int height, const unsigned char *rgba, struct error *error)
{
    if (width < 1 || height < 1 || width > 16384 || height > 16384) {
        return fail(error, ERROR_INPUT, "%s: expected a picture of 1 to 16384 pixels a side, got %d × %d", path,
                    width, height);
    }
    int size;
    unsigned char *png = png_encode(&(struct png_picture){width, height, 4, rgba}, PNG_FAST, &size);
    const bool written = file_write_atomic(path, png, (size_t)size, error);
    free(png);
    return written;
}
