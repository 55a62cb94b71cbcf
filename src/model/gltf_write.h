/// A glTF 2.0 file being assembled: accessors and their bytes, and meshes with their materials and pictures.
#ifndef MODEL_GLTF_WRITE_H
#define MODEL_GLTF_WRITE_H

#include "base/error.h"
#include "model/character.h"
#include "model/figure.h"
#include "model/gltf.h"
#include <jansson.h>
#include <stdio.h>

struct glb;
struct glb_numbers;

/// A .glb begins with the first; the others are the types of its chunks.
enum {
    GLB_MAGIC = 0x46546C67, ///< "glTF"
    GLB_JSON = 0x4E4F534A,
    GLB_BIN = 0x004E4942,
};

/// All zero but its JSON, or what it continues, at first; without_memory stays set.
struct gltf_file {
    struct glb *source; ///< the file that it continues, whose buffers have been read; NULL: it is a new one
    json_t *root;       ///< views, accessors, materials and others are added to what it has
    json_int_t buffer;  ///< that the bytes are in
    char *data;
    size_t size, capacity;
    bool without_memory;
    struct gltf_picture *pictures; ///< of each texture: pictures that are the same are written once
    json_int_t plain[2]; ///< the materials of closed and open parts that have none, from 1; 0: there is none yet
};

/// What the elements of an accessor are.
enum gltf_elements {
    ELEMENTS_INDICES,
    ELEMENTS_SHORT_INDICES,
    ELEMENTS_VECTORS,
    ELEMENTS_UVS,
    ELEMENTS_JOINTS,
    ELEMENTS_WEIGHTS,
    ELEMENTS_MATRICES,
    ELEMENTS_KEYS,
    ELEMENTS_KEY_VECTORS,
    ELEMENTS_TURNS
};

/// Takes the source's JSON, and puts all bytes that the JSON refers to, pictures too, into the new file's one buffer.
/// Errors: pictures that cannot keep their address.
bool gltf_file_gather(struct gltf_file *file, struct error *error);

/// Adds bytes that views refer to already, padded to a multiple of four; returns their offset.
size_t gltf_file_append(struct gltf_file *file, const void *bytes, size_t size);

/// Adds `count` elements and returns the accessor's number; with bounds, it states their least and largest.
json_int_t gltf_file_add(struct gltf_file *file, enum gltf_elements elements, const void *data, size_t count,
                         bool bounds);

/// An array of numbers.
json_t *gltf_numbers(struct gltf_file *file, const float *numbers, int count);

/// States the least and largest of an accessor's elements.
void gltf_file_bound(struct gltf_file *file, json_t *accessor, const float *numbers, size_t count, int components);

/// Adds bytes that no accessor finds, as those of a picture, and returns the buffer view's number.
json_int_t gltf_file_add_bytes(struct gltf_file *file, const void *data, size_t size);

/// Take `value` over. If it, or the array or object, is NULL or memory is short, the file is marked as without memory. So you can pass on NULL
/// from any call of the JSON library.
json_int_t gltf_append(struct gltf_file *file, json_t *array, json_t *value);
void gltf_set(struct gltf_file *file, json_t *object, const char *key, json_t *value);

/// Appends to a member that is an array; creates it if it is missing.
json_int_t gltf_append_to(struct gltf_file *file, json_t *object, const char *key, json_t *value);

/// Describes the bytes in the JSON and writes both: as .glb, whose buffer must be 0, or as text with the bytes in it. Numbers of the JSON read back equal, and its members keep their order.
/// False with a sentence if it cannot be made; the stream's errors are the caller's.
bool gltf_file_write(struct gltf_file *file, bool binary, FILE *out, struct error *error);

/// Writes a .glb of that name with gltf_file_write(), whole or not at all.
bool gltf_file_save(struct gltf_file *file, const char *path, struct error *error);
void gltf_file_free(struct gltf_file *file);

// --- the morph targets of a mesh that the file has
//
// The mesh gets a new list of targets: those before times a scale, by weights divided by it, and new ones. Weights at rest and in all clips follow.

/// A target that the mesh gets.
struct gltf_retarget {
    int source;       ///< of those before, or of the mesh's parts, if these have more: with the weight 0
    float scale;      ///< times its offsets
    const char *name; ///< NULL: it gets a number
    bool is_new;      ///< its offsets are those of gltf_part.targets, which leave normals alone; else the file's
};

/// Weights of the targets before, row by row.
struct gltf_weights {
    const float *values;
    int rows, stride;
    bool is_cubic; ///< of three rows the first and last are tangents
    json_t *sampler;
};

struct gltf_retargeting {
    struct gltf_file *file; ///< that continues one
    struct pool *pool;      ///< of the numbers that are made
    int mesh, before;       ///< its number, and that of its targets before
    struct gltf_retarget *list;
    int count;
    bool clamped;               ///< weights are to be 0 … 1
    struct gltf_weights *clips; ///< gltf_find_weights(); the caller frees it
    int clip_count;
};

/// The numbers of an accessor of the file, or of one that was added.
bool gltf_file_numbers(const struct gltf_file *file, int64_t accessor, struct pool *pool, struct glb_numbers *numbers,
                       struct error *error);

/// Finds the weights of the mesh in all clips. Errors: numbers that cannot be read.
bool gltf_find_weights(struct gltf_retargeting *r, struct error *error);

/// What the targets of the list have for weights of those before, `count` a row; in the pool's memory.
float *gltf_convert_weights(const struct gltf_retargeting *r, const struct gltf_weights *weights);

/// Gives the mesh these targets. `mesh`: how it was read. Attributes that cannot be read stay as they are.
void gltf_retarget(const struct gltf_retargeting *r, const struct gltf_mesh *mesh);

// --- meshes, their materials and pictures
//
// Polygons are kept as GLTF_POLYGONS has them: of two in a row each begins with another vertex.

/// The JSON of a mesh, with a primitive for each material that triangles have, and one for those without, which share the vertices. Adds the
/// materials and their pictures to the file.
json_t *gltf_shape_json(struct gltf_file *file, const struct gltf_shape *shape);

#endif
