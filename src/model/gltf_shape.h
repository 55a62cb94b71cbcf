/// Meshes, their materials and pictures, in a glTF file being put together.
///
/// Polygons are kept as GLTF_POLYGONS has them: of two in a row each begins with another vertex.
#ifndef MODEL_GLTF_SHAPE_H
#define MODEL_GLTF_SHAPE_H

#include "model/character.h"
#include "model/gltf.h"
#include "model/gltf_file.h"

/// All zero but `file` at first. What fails leaves the file without memory.
struct gltf_looks {
    struct gltf_file *file;
    json_t *materials, *textures, *images;
    struct gltf_picture *pictures; ///< of each texture: pictures that are the same are written once
    bool is_open;                  ///< the shape at hand: its materials show on both sides
    bool has_plain[2], has_polygons;
    json_int_t plain[2]; ///< the materials of closed and open parts that have none
};

/// A morph target: `scale` times `position`, and `turn` times `normal`; NULL: it leaves normals as they are.
struct gltf_shape_target {
    const char *name;
    const float (*position)[3], (*normal)[3];
    float scale, turn;
};

/// A mesh. Vertices of the file may be several copies of one here; the arrays but `uv` and `indices` are by vertex here.
struct gltf_shape {
    const char *name;
    int vertex_count;       ///< of the file
    const uint32_t *source; ///< which vertex each of the file is; NULL: the same
    const float (*position)[3], (*normal)[3], (*color)[3];
    const float (*uv)[2];              ///< NULL: none
    const uint16_t (*joints)[4];       ///< NULL: it has no skin
    const float (*weights)[4];         ///< as `joints`
    const uint32_t *indices;           ///< vertices of the file
    int index_count;                   ///< three a triangle
    const struct looks *looks;         ///< of these; NULL: they have no materials, and are no polygons
    struct gltf_shape_target *targets; ///< of a character two a coordinate, Re Ñ and −Im Ñ, and then any others
    int target_count;
    const struct character *character; ///< its coordinates go into the extras; NULL: none
};

/// The JSON of a mesh, with a primitive for each material that triangles have, and one for those without, which share the vertices.
json_t *gltf_shape_json(struct gltf_looks *looks, const struct gltf_shape *shape);

/// Adds materials, textures, images and the list of used extensions to the JSON of the file.
void gltf_looks_complete(struct gltf_looks *looks, json_t *root);
void gltf_looks_free(struct gltf_looks *looks);

#endif
