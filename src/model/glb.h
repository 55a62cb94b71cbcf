/// Files of glTF 2.0: JSON, buffers of bytes (a .glb holds both), and the numbers that accessors find in them.
#ifndef MODEL_GLB_H
#define MODEL_GLB_H

#include "base/error.h"
#include "model/gltf.h"
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Limits: the size of a file, the memory for its content, and that memory per byte of the file.
enum { GLB_FILE_LIMIT = 1 << 28, GLB_ROOM = 8 << 20, GLB_GROWTH = 32 };

struct glb_bytes {
    const unsigned char *at;
    size_t size;
};

struct glb_buffer {
    struct glb_bytes bytes;
    void *owned; ///< its memory, unless that is another's
};

struct glb {
    const char *path; ///< the caller's, for messages
    char *data;       ///< the whole file
    json_t *json;
    struct glb_bytes chunk; ///< of a .glb
    struct glb_buffer *buffers;
    int buffer_count;
    size_t room; ///< bytes that may still be allocated, so that a small file cannot claim all memory
};

/// Reads a .glb or .gltf and its JSON, no buffers yet. False leaves nothing to close.
bool glb_open(struct glb *glb, const char *path, struct error *error);

/// The same for a file's bytes, which it takes over; they must have room for a NUL at the end.
bool glb_open_bytes(struct glb *glb, const char *path, char *data, size_t size, struct error *error);
void glb_close(struct glb *glb);

/// Reads the buffers that the JSON names: the chunk, files beside it and data URIs. Decompresses meshes: the JSON then has one plain buffer.
bool glb_read_buffers(struct glb *glb, struct error *error);

/// The bytes of a data URI, or of a file named relative to ours; the caller frees `owned`. The error does not name our file.
bool glb_read_uri(struct glb *glb, const char *uri, struct glb_buffer *bytes, struct error *error);

/// A member that is a whole number ≥ 0; `otherwise` if it is missing, −1 if it is something else.
int64_t glb_integer(const json_t *object, const char *key, int64_t otherwise);

/// Whether the file has some of an accessor's numbers; otherwise all are zero.
bool glb_is_stored(const struct glb *glb, int64_t accessor);

/// The bytes of a buffer view, by its number or as JSON; false if there are none.
bool glb_view(const struct glb *glb, int64_t index, struct glb_bytes *bytes);
bool glb_bytes(const struct glb *glb, const json_t *view, struct glb_bytes *bytes);

// Compressed meshes.

/// For an extension that compresses meshes and that this program cannot read: the package that it was built without, "" if none helps. NULL for
/// all other extensions.
const char *glb_missing_codec(const char *extension);

/// Whether the file has compressed meshes that glb_read_buffers() decompresses.
bool glb_is_packed(const struct glb *glb);

/// The numbers of an accessor: normalised integers as −1 … 1, sparse elements in their places. Single precision has all indices of the
/// vertices that a model may have.
struct glb_numbers {
    float *values; ///< the pool's
    int count, components;
};

bool glb_numbers(const struct glb *glb, int64_t accessor, struct pool *pool, struct glb_numbers *numbers,
                 struct error *error);

// --- private to src/model/gltf_*.c

/// Finds out whether a clip loops (gltf_pose.c), how long after its last key, and what travels. False if memory is short.
bool gltf_judge_loop(const struct gltf *gltf, struct gltf_clip *clip);

#endif
