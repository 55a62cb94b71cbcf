/// Readers for the header of each file format of motion.h.
#ifndef MODEL_MOTION_FORMAT_H
#define MODEL_MOTION_FORMAT_H

#include "model/motion.h"
#include <stddef.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files' numbers are read as they lie");

/// Bytes at the start of a PC2 file.
extern const char pc2_magic[12];

/// Each fills frames, vertices, fps and the private part from the header of an open file of `size` bytes.
bool npy_read_header(struct motion *motion, int64_t size, struct error *error);
bool pc2_read_header(struct motion *motion, int64_t size, struct error *error);
bool mdd_read_header(struct motion *motion, int64_t size, struct error *error);

/// Sets the strides of numbers in C order and checks that the file has them all.
bool motion_layout(struct motion *motion, int64_t size, struct error *error);

/// Reads exactly `count` bytes at `offset`; a file that ends before is an error.
bool motion_read_at(const struct motion *motion, int64_t offset, void *bytes, size_t count, struct error *error);

/// A count of a header, 1 … 2^31 − 1 such that 3 · vertices is one too.
bool motion_counts(struct motion *motion, int64_t frames, int64_t vertices, struct error *error);

#endif
