/// Meshes compressed by Draco. Its library is C++: if it is installed, WITH_DRACO is defined and src/model/draco.cpp compiled.
#ifndef MODEL_DRACO_H
#define MODEL_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// An attribute of all vertices, or the corners of all triangles, as numbers of one of glTF's types.
struct draco_part {
    int64_t attribute; ///< Draco's number; −1: the corners
    int type, components;
    size_t stride;         ///< bytes from one element to the next
    size_t count;          ///< set by draco_decode()
    unsigned char *values; ///< set by draco_decode(); the caller frees it
};

/// Zeroed memory, or NULL.
typedef void *draco_memory(void *user, size_t count, size_t size);

#ifdef __cplusplus
extern "C"
#endif
    /// Decompresses parts of a mesh. False if the bytes are no mesh with these parts, or if Draco allocates more than `room` bytes.
    bool
    draco_decode(const void *data, size_t size, size_t room, struct draco_part *parts, int part_count,
                 draco_memory *memory, void *user);

#endif
