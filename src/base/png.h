/// Pictures: writes them, and the transfer function of their channels.
#ifndef BASE_PNG_H
#define BASE_PNG_H

#include "base/error.h"
#include "maths/maths.h"

/// Writes width × height pixels of four bytes (R, G, B, A; top row first) as a PNG, atomically like file_write_atomic().
bool png_write(const char *path, int width, int height, const unsigned char *rgba, struct error *error);

/// How hard to search for repetitions.
enum png_effort { PNG_FAST = 5, PNG_SMALL = 8 };

struct png_picture {
    int width, height, channels; ///< a byte per channel
    const unsigned char *pixels;
};

/// A whole PNG of `*size` bytes, from need().
unsigned char *png_encode(const struct png_picture *picture, enum png_effort effort, int *size);

// The transfer function of sRGB (IEC 61966-2-1), a channel of 0 … 1 at a time.

static inline float srgb_power(float x, double power) { return (float)maths_exp(power * maths_log((double)x)); }

/// Light from what is encoded.
static inline float srgb_to_linear(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : srgb_power((encoded + 0.055f) / 1.055f, 2.4);
}

/// What encodes light; the inverse of srgb_to_linear().
static inline float srgb_from_linear(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * srgb_power(linear, 1 / 2.4) - 0.055f;
}

#endif
