/// The readers of single formats, for surface_read(). Private to src/model.
#ifndef MODEL_SURFACE_READERS_H
#define MODEL_SURFACE_READERS_H

#include "model/surface_builder.h"

bool ply_read(const char *path, struct surface *surface, struct error *error);
bool stl_read(const char *path, struct surface *surface, struct error *error);
bool off_read(const char *path, struct surface *surface, struct error *error);

/// All that a .glb or .gltf file shows, at rest.
bool gltf_surface_read(const char *path, struct surface *surface, struct error *error);

#endif
