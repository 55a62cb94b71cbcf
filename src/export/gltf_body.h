/// What an imported character's own clip moves, in the clip that is exported. Private to src/export.
#ifndef EXPORT_GLTF_BODY_H
#define EXPORT_GLTF_BODY_H

#include "export/gltf_motion.h"
#include "model/gltf.h"

struct gltf_body {
    const struct gltf *gltf;
    const struct gltf_clip *clip;
    const bool *is_bone; ///< of each node: chains have its rotation
};

/// Whether a chain has what this channel of the clip moves.
bool gltf_body_leaves_out(const struct gltf_body *body, const struct gltf_channel *channel);

/// Adds a key a sample for all that the clip moves. False with a sentence.
bool gltf_body_sample(const struct gltf_body *body, struct shot *shot, struct gltf_motion *motion,
                      struct error *error);

/// Adds the clip's own keys, as often as the shot repeats them, which move the body the same at any time.
bool gltf_body_keep(const struct gltf_body *body, const struct shot *shot, struct gltf_motion *motion,
                    struct error *error);

#endif
