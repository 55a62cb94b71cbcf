/// Meshes that Draco compressed. The library is C++: src/model/draco.cpp is compiled where it is there, and WITH_DRACO is defined.
#ifndef MODEL_DRACO_H
#define MODEL_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// An attribute of all vertices, or the corners of all triangles, as numbers of one of glTF's types.
struct draco_part {
    int64_t attribute; ///< Draco's number of it; −1: the corners
    int type, components;
    size_t stride;         ///< bytes from one element to the next
    size_t count;          ///< as decompressed
    unsigned char *values; ///< likewise; the caller frees it
};

/// Zeroed memory; NULL where it is refused.
typedef void *draco_memory(void *user, size_t count, size_t size);

#ifdef __cplusplus
extern "C"
#endif
    /// Decompresses parts of a mesh. False where the bytes are none that has them, or take more than `room` bytes to decompress.
    bool
    draco_decode(const void *data, size_t size, size_t room, struct draco_part *parts, int part_count,
                 draco_memory *memory, void *user);

#endif
