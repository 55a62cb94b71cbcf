/// Writing glTF animations. Private to src/export.
#ifndef EXPORT_GLTF_H
#define EXPORT_GLTF_H

#include "export/form.h"
#include "model/gltf.h"
#include "model/gltf_file.h"

struct gltf_motion {
    struct gltf_file *file;
    json_t *samplers, *channels;
    json_int_t times; ///< accessor of the keys' times
    int key_count;
};

/// Begins an animation with a range's keys, the first of them at `start` seconds. `file` must outlive it.
void gltf_motion_begin(struct gltf_motion *motion, struct gltf_file *file, const struct export_range *range,
                       double start);
void gltf_motion_free(struct gltf_motion *motion);

/// Adds a column of a rig's keys, with tangents if present.
void gltf_motion_add_keys(struct gltf_motion *motion, json_int_t node, enum gltf_path path, const struct keys *keys,
                          int column, int width);

/// Returns the animation; the caller owns it.
json_t *gltf_motion_json(const struct gltf_motion *motion, const char *name);

/// Copies the file of the range's only rig and adds a clip, or replaces the clip of that name. Everything else stays the same, also in the
/// other container (.glb or .gltf). Without a chain there is no new clip.
bool gltf_model_write(struct export_range *range, FILE *out, struct error *error);

#endif
