/// One animation of a glTF file. Private to src/export.
#ifndef EXPORT_GLTF_MOTION_H
#define EXPORT_GLTF_MOTION_H

#include "export/range.h"
#include "model/gltf.h"
#include "model/gltf_file.h"

struct gltf_motion {
    struct gltf_file *file;
    json_t *samplers, *channels;
    json_int_t times; ///< the accessor of the keys' times
    int key_count;
    json_int_t own_times; ///< the accessor of the last times that gltf_motion_add_own() was given
    float *own;           ///< these
    int own_count;
};

/// Starts an animation with a range's keys. `file` must outlive it.
void gltf_motion_begin(struct gltf_motion *motion, struct gltf_file *file, const struct export_range *range);
void gltf_motion_free(struct gltf_motion *motion);

/// Adds what moves a node: `width` numbers a key, and how fast they change by second (NULL: straight lines between keys).
void gltf_motion_add(struct gltf_motion *motion, json_int_t node, enum gltf_path path, const float *values,
                     const float *slopes, int width);

/// Adds what moves a channel's node with keys of its own, which are as the channel's (gltf.h).
void gltf_motion_add_own(struct gltf_motion *motion, const struct gltf_channel *like,
                         enum gltf_interpolation interpolation, const float *times, const float *keys, int count);

/// The animation; the caller's.
json_t *gltf_motion_json(const struct gltf_motion *motion, const char *name);

// --- what an imported character's own clip moves

struct gltf_body {
    const struct gltf *gltf;
    const struct gltf_clip *clip; ///< NULL: none
    const int *bones;             ///< nodes that chains turn
    int bone_count;
    const bool *is_bone; ///< of each node
};

/// Whether a chain has what this channel of the clip moves.
bool gltf_body_leaves_out(const struct gltf_body *body, const struct gltf_channel *channel);

/// Adds a key a sample for all that the clip or chains move. False with a sentence.
bool gltf_body_sample(const struct gltf_body *body, struct export_range *range, struct gltf_motion *motion,
                      struct error *error);

/// Adds the clip's own keys, as often as the range repeats them, which move the body the same at any time.
bool gltf_body_keep(const struct gltf_body *body, const struct export_range *range, struct gltf_motion *motion,
                    struct error *error);

#endif
