/// The materials, pictures and texture coordinates of a .glb's mesh. Private to the reader of characters.
#ifndef MODEL_GLB_LOOKS_H
#define MODEL_GLB_LOOKS_H

#include "model/glb.h"
#include "model/surface.h"

/// The file's materials, with base colours and pictures (PNG or JPEG); what is something else is white.
bool glb_read_materials(struct glb *glb, struct looks *looks, struct error *error);

/// What a primitive has brought into a surface.
struct glb_piece {
    const json_t *primitive;
    int first_vertex, vertex_count; ///< none where it has those of another primitive
    int first_index;                ///< up to the last there is
};

/// Adds its texture coordinates, one a vertex, and which material and polygon its triangles have.
bool glb_read_looks(struct glb *glb, const struct glb_piece *piece, struct surface *surface, struct error *error);

#endif
