/// Materials, their pictures, and the triangles that have them, in a glTF file being put together.
///
/// Polygons are kept as GLTF_POLYGONS has them: of two in a row each begins with another vertex.
#ifndef MODEL_GLTF_LOOKS_H
#define MODEL_GLTF_LOOKS_H

#include "model/gltf.h"
#include "model/gltf_file.h"
#include "model/surface.h"

/// All zero but `file` at first. What fails leaves the file without memory.
struct gltf_looks {
    struct gltf_file *file;
    json_t *materials, *textures, *images;
    struct gltf_picture *pictures; ///< of each texture: pictures that are the same are written once
    bool has_plain, has_polygons;
    json_int_t plain; ///< the material of what has none
};

/// Triangles and how they look, three corners each.
struct gltf_triangles {
    const struct looks *looks; ///< NULL: they have no materials, and are no polygons
    const uint32_t *corners;   ///< vertices of the file
    int corner_count;
};

/// A primitive for each material that triangles have, and one for those without, which share the attributes and targets (NULL: none).
json_t *gltf_looks_primitives(struct gltf_looks *looks, const struct gltf_triangles *triangles, json_t *attributes,
                              json_t *targets);

/// Adds materials, textures, images and what extensions are used to the JSON of the file.
void gltf_looks_complete(struct gltf_looks *looks, json_t *root);
void gltf_looks_free(struct gltf_looks *looks);

#endif
