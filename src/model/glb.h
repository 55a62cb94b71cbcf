/// Files of glTF 2.0: JSON, buffers of bytes (a .glb holds both), and the numbers that accessors find in them.
#ifndef MODEL_GLB_H
#define MODEL_GLB_H

#include "base/error.h"
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    GLB_MAGIC = 0x46546C67, ///< "glTF"
    GLB_JSON = 0x4E4F534A,
    GLB_BIN = 0x004E4942,
};

/// The largest file, and what may be made of a file: so many bytes, and so many for each of its own.
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
    size_t room; ///< bytes that may still be made of it, so that no claim of a small file fills the memory
};

/// Reads a .glb or .gltf and its JSON, no buffers yet. False leaves nothing to close.
bool glb_open(struct glb *glb, const char *path, struct error *error);

/// The same of a file's bytes, which it takes over; behind them is room for a NUL.
bool glb_open_bytes(struct glb *glb, const char *path, char *data, size_t size, struct error *error);
void glb_close(struct glb *glb);

/// The buffers that the JSON names: the chunk, files beside it and data URIs.
bool glb_read_buffers(struct glb *glb, struct error *error);

/// The bytes of a data URI, or of a file named from the folder of ours; the caller frees `owned`. The error says what is wrong without
/// naming our file.
bool glb_read_uri(struct glb *glb, const char *uri, struct glb_buffer *bytes, struct error *error);

/// A member that is a whole number ≥ 0; `otherwise` if it is missing, −1 if it is something else.
int64_t glb_integer(const json_t *object, const char *key, int64_t otherwise);

/// Whether an accessor's numbers are in the file, some of them at least: without that all are zero.
bool glb_is_stored(const struct glb *glb, int64_t accessor);

/// The bytes of a buffer view; false where there are none.
bool glb_view(const struct glb *glb, int64_t index, struct glb_bytes *bytes);

/// The numbers of an accessor: normalised integers as −1 … 1, sparse elements in their places.
struct glb_numbers {
    double *values; ///< the caller frees it
    int count, components;
};

bool glb_numbers(const struct glb *glb, int64_t accessor, struct glb_numbers *numbers, struct error *error);

#endif
