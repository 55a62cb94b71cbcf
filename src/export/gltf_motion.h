/// One animation of a glTF file. Private to src/export.
#ifndef EXPORT_GLTF_MOTION_H
#define EXPORT_GLTF_MOTION_H

#include "export/shot.h"
#include "model/gltf_file.h"

struct gltf_motion {
    struct gltf_file *file;
    json_t *samplers, *channels;
    json_int_t times; ///< the accessor of the keys' times
    int key_count;
};

/// Starts an animation with a shot's keys. `file` must outlive it.
void gltf_motion_begin(struct gltf_motion *motion, struct gltf_file *file, const struct shot *shot);
void gltf_motion_free(struct gltf_motion *motion);

/// Adds what moves a node: `width` numbers a key, and how fast they change by second (NULL: straight lines between keys).
void gltf_motion_add(struct gltf_motion *motion, json_int_t node, const char *path, enum gltf_elements elements,
                     const float *values, const float *slopes, int width);

/// The animation; the caller's.
json_t *gltf_motion_json(const struct gltf_motion *motion, const char *name);

#endif
