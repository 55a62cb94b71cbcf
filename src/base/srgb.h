/// The transfer function of sRGB (IEC 61966-2-1), a channel of 0 … 1 at a time.
#ifndef BASE_SRGB_H
#define BASE_SRGB_H

#include <math.h>

/// Light from what is encoded.
static inline float srgb_to_linear(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
}

/// What encodes light; the inverse of srgb_to_linear().
static inline float srgb_from_linear(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
}

#endif
