/// Triangle surfaces and their OBJ files: the rest meshes that are simulated and analysed.
#ifndef MODEL_OBJ_H
#define MODEL_OBJ_H

#include "base/error.h"
#include <stdbool.h>
#include <stdint.h>

/// Metres, right-handed, y up; triangles counter-clockwise seen from outside. All zero is the empty surface.
struct surface {
    float (*position)[3];
    float (*color)[3]; ///< linear RGB per vertex, or NULL
    int vertex_count;
    uint32_t *indices; ///< three a triangle
    int index_count;
};

/// Reads an OBJ file. Vertices keep the file's order and number, which is what simulations refer to. Polygons become fans
/// of triangles; texture coordinates, normals, materials, groups and lines are ignored. Colours after a position
/// (`v x y z r g b`) are sRGB in the file, as Blender writes them; a vertex without one is white if others have one.
/// Errors say "file:line: expected …, got …".
bool obj_read(const char *path, struct surface *surface, struct error *error);

/// Writes positions, colours and triangles with 9 digits, so that they read back equal. Atomic, like
/// file_output_commit().
bool obj_write(const char *path, const struct surface *surface, struct error *error);

/// The box around the vertices, m; lo > hi if there are none.
void surface_bounds(const struct surface *surface, double lo[3], double hi[3]);

/// Leaves an empty surface.
void surface_free(struct surface *surface);

#endif
