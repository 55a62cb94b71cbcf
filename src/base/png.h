/// Writes pictures.
#ifndef BASE_PNG_H
#define BASE_PNG_H

#include "base/error.h"

/// Writes width × height pixels of four bytes (R, G, B, A; top row first) as a PNG, atomically like file_write_atomic().
bool png_write(const char *path, int width, int height, const unsigned char *rgba, struct error *error);

#endif
