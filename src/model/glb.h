/// The binary form of glTF 2.0: a header, a chunk of JSON, a chunk of bytes, and the numbers that accessors find in them.
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
    GLB_FLOAT = 5126, ///< component types are OpenGL's
    GLB_UNSIGNED_INT = 5125,
};

struct glb {
    const char *path; ///< the caller's, for messages
    char *data;       ///< the whole file
    json_t *json;
    const unsigned char *bin;
    size_t bin_size;
};

/// Reads a file and its JSON. False leaves nothing to close.
bool glb_open(struct glb *glb, const char *path, struct error *error);
void glb_close(struct glb *glb);

/// A member that is a whole number ≥ 0; `otherwise` if it is missing, −1 if it is something else.
int64_t glb_integer(const json_t *object, const char *key, int64_t otherwise);

/// The numbers of an accessor: normalised integers as 0 … 1, sparse elements in their places.
struct glb_numbers {
    double *values; ///< the caller frees it
    int count, components;
};

bool glb_numbers(const struct glb *glb, int64_t accessor, struct glb_numbers *numbers, struct error *error);

/// The matrix, columns first, that places mesh number `mesh` in the scene: that of the first node that shows it. False
/// for the identity.
bool glb_mesh_matrix(const struct glb *glb, int64_t mesh, double matrix[16]);

#endif
