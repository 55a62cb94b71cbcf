/// Writing glTF animations. Private to src/export.
#ifndef EXPORT_GLTF_H
#define EXPORT_GLTF_H

#include "export/form.h"
#include "model/gltf.h"
#include "model/gltf_write.h"

/// An animation being written. `file` must outlive it.
struct gltf_motion {
    struct gltf_file *file;
    json_t *samplers, *channels;
    json_int_t times; ///< accessor of the keys' times
    int key_count;
};

/// Adds a sampler for a column of a rig's keys, with tangents if present, and returns its number.
json_int_t gltf_motion_add_sampler(struct gltf_motion *motion, enum gltf_path path, const struct keys *keys,
                                   int column, int width);

/// Adds a channel that moves a node by a sampler.
void gltf_motion_add_channel(struct gltf_motion *motion, json_int_t node, enum gltf_path path, json_int_t sampler);

/// Copies the file of the range's only rig and gives its clip, or a copy of that by another name, the keys of chains. Everything else stays the
/// same, also in the other container (.glb or .gltf). Without a chain the clip stays, too.
bool gltf_model_write(struct export_range *range, FILE *out, struct error *error);

#endif
