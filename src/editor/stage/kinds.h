/// How each kind of rigs comes onto the stage. Private to the folder.
#ifndef EDITOR_STAGE_KINDS_H
#define EDITOR_STAGE_KINDS_H

#include "editor/stage/state.h"

/// `rig` is the index in the document, `n` that among its kind.
struct stage_kind {
    /// Poses it into the editor's stage view, with its shadow.
    void (*pose)(struct stage *stage, const struct core *core, const struct editor_world *world, int rig, int n);
    /// Adds its motion over the whole scene to the box lo … hi; false where it is not to be seen.
    bool (*bounds)(const struct stage *stage, const struct core *core, const struct editor_world *world, int rig,
                   int n, float lo[3], float hi[3]);
    /// Of all that are in the view.
    uint64_t (*hash)(uint64_t hash, const struct stage_view *view);
};

extern const struct stage_kind stage_tails, stage_characters;

#endif
