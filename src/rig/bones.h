/// Finds the bones of a chain in a glTF character.
#ifndef RIG_BONES_H
#define RIG_BONES_H

#include "model/gltf.h"
#include "scene/channel.h"

struct chain_bones {
    int count;
    int node[ANGLES_MAX_JOINTS]; ///< each the parent of the next
};

/// The bones from one to another below it, both by name. false with a sentence.
bool chain_find(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones,
                struct error *error);

/// The bone at the end of the only way down from `from`; −1 with a sentence where the way branches, or is too long.
int chain_end(const struct gltf *gltf, int from, struct error *error);

#endif
