/// OBJ files of surfaces.
#ifndef MODEL_OBJ_H
#define MODEL_OBJ_H

#include "model/surface.h"

/// Reads an OBJ file. Vertices keep the file's order and number, which is what simulations refer to. Polygons become fans
/// of triangles; of materials names, Kd, d and map_Kd (PNG, JPEG) are read; normals, groups and lines are ignored. Colours after a
/// position (`v x y z r g b`) are sRGB in the file, as Blender writes them; a vertex without one is white if others have one.
/// Errors say "file:line: expected …, got …".
bool obj_read(const char *path, struct surface *surface, struct error *error);

/// Writes positions, colours, texture coordinates and polygons with 9 digits, so that they read back equal (colours but for a float's
/// last bit), and where there are materials NAME.mtl and their pictures NAME-1.png … beside it. Atomic, like file_output_commit().
bool obj_write(const char *path, const struct surface *surface, struct error *error);

#endif
