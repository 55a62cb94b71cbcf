/// What stands in an imported character's file and is not kept as it is opened: names, and pictures as they are stored. Private to
/// src/export.
#ifndef EXPORT_GLTF_SOURCE_H
#define EXPORT_GLTF_SOURCE_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>

struct gltf_source;

/// NULL with a sentence.
struct gltf_source *gltf_source_open(const char *path, struct error *error);
void gltf_source_close(struct gltf_source *source);

/// The name of a material, or of a morph target of a mesh, where many exporters put it; NULL: it has none.
const char *gltf_source_material(const struct gltf_source *source, int material);
const char *gltf_source_target(const struct gltf_source *source, int mesh, int target);

/// How a material shines. False where a picture says it, or nothing.
bool gltf_source_shine(const struct gltf_source *source, int material, double *metallic, double *roughness);

/// The texture of a material's base colour, which must have one.
struct gltf_texture {
    int image;               ///< its number in the file
    const char *name;        ///< the image's, or NULL
    const char *wrap[2];     ///< past its edges: "repeat", "clamp" or "mirror"
    const unsigned char *at; ///< PNG or JPEG
    size_t size;
    void *owned; ///< the caller frees it
};
bool gltf_source_texture(struct gltf_source *source, int material, struct gltf_texture *texture, struct error *error);

#endif
