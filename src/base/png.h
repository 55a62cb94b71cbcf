/// Writes pictures.
#ifndef BASE_PNG_H
#define BASE_PNG_H

#include "base/error.h"
#include <stddef.h>

/// Writes width × height pixels of four bytes (R, G, B, A; top row first) as a PNG, atomically like file_write_atomic().
bool png_write(const char *path, int width, int height, const unsigned char *rgba, struct error *error);

/// How long to look for what repeats.
enum png_effort { PNG_FAST = 5, PNG_SMALL = 8 };

/// Hands a whole PNG of pixels with `channels` bytes each over to `store`, once.
void png_encode(void (*store)(void *user, const void *bytes, size_t size), void *user, int width, int height,
                int channels, const unsigned char *pixels, enum png_effort effort);

#endif
