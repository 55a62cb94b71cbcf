/// The materials of OBJ files. Private to those.
#ifndef MODEL_MTL_H
#define MODEL_MTL_H

#include "model/surface_builder.h"

enum { MTL_NAME = 256 };

/// Adds the materials of a file named from the folder of an OBJ file: newmtl, Kd, d, Tr, map_Kd. A file that cannot be read, or a picture
/// that is neither PNG nor JPEG, is left out and noted in the looks.
void mtl_read(const char *obj_path, const char *name, struct surface_builder *builder);

/// Writes the materials, and their pictures, beside an OBJ file; `name` is what the OBJ file calls them.
bool mtl_write(const char *obj_path, const struct looks *looks, char name[MTL_NAME], struct error *error);

/// "png" or "jpeg" by a picture's first bytes, or NULL.
const char *looks_image_kind(const unsigned char *bytes, size_t size);

#endif
