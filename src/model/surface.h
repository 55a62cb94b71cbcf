/// Triangle surfaces: the rest meshes that are simulated and analysed, and how they look.
#ifndef MODEL_SURFACE_H
#define MODEL_SURFACE_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// No texture coordinates, or no material.
#define LOOKS_NONE UINT32_MAX

/// Limit for the bytes of a surface's pictures together, because many materials may name one small file.
enum { LOOKS_IMAGES_LIMIT = 256 << 20 };

struct looks_material {
    char *name;
    float color[4];       ///< base colour, linear, with opacity
    unsigned char *image; ///< its texture: the bytes of a PNG or JPEG file, or NULL
    size_t image_size;
};

/// The look of a surface besides places and colours. Members are NULL if it has none.
struct looks {
    float (*uv)[2]; ///< texture coordinates, (0, 0) the upper left of the picture
    int uv_count;
    uint32_t *corner;   ///< per index: which texture coordinates, or LOOKS_NONE; NULL: those of the vertex's number
    uint32_t *material; ///< per triangle: its material, or LOOKS_NONE
    uint8_t *joined;    ///< per triangle: 1 if it continues the polygon (a fan) of the triangle before
    struct looks_material *materials;
    int material_count;
    char *left_out; ///< a file of materials or a picture that could not be read, to show
};

/// Metres, right-handed, y up; triangles counter-clockwise seen from outside. All zero is the empty surface.
struct surface {
    float (*position)[3];
    float (*color)[3]; ///< linear RGB per vertex, or NULL
    int vertex_count;
    uint32_t *indices; ///< three a triangle
    int index_count;
    struct looks looks;
};

/// Whether a triangle names a vertex twice. Such triangles have no area; no reader keeps them.
static inline bool triangle_repeats(const uint32_t corner[3])
{
    return corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
}

/// Reads a mesh: OBJ, STL, PLY, OFF, .glb or .gltf by the end of its name (any other is read as OBJ). Vertices keep the file's order and
/// number, which is what simulations refer to; those of an STL file, which has none, are the different places in the order of their first
/// appearance. Polygons become fans of triangles. Errors name the file, the place in it, what was expected and what was found. Memory is
/// bounded by the file's size.
///
/// Of an OBJ file's materials names, Kd, d and map_Kd (PNG, JPEG) are read; normals, groups and lines are ignored. Colours after a
/// position (`v x y z r g b`) are sRGB in the file, as Blender writes them; a vertex without one is white if others have one.
bool surface_read(const char *path, struct surface *surface, struct error *error);

struct gltf;
struct gltf_mesh;

/// The parts of a mesh as one surface; vertices and texture coordinates have the numbers of the mesh's. False if memory is short.
bool surface_of_mesh(const struct gltf *gltf, const struct gltf_mesh *mesh, struct surface *surface);

/// Writes positions, colours, texture coordinates and polygons with 9 digits, so that they read back equal (colours except for a float's last
/// bit), and for materials NAME.mtl with pictures NAME-1.png … beside it. Atomic, like file_output_commit().
bool obj_write(const char *path, const struct surface *surface, struct error *error);

/// Per vertex: 1 if a triangle has it. The caller frees it.
uint8_t *surface_used_vertices(const struct surface *surface);

/// The box around the vertices that triangles have, m; lo > hi if there are none.
void surface_bounds(const struct surface *surface, double lo[3], double hi[3]);

/// Leaves an empty surface.
void surface_free(struct surface *surface);

/// "png" or "jpeg" by a picture's first bytes, or NULL.
const char *looks_image_kind(const unsigned char *bytes, size_t size);

void looks_free(struct looks *looks);

#endif
