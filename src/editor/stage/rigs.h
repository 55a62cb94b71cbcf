/// How rigs come onto the stage, and where they are on the screen.
#ifndef EDITOR_STAGE_RIGS_H
#define EDITOR_STAGE_RIGS_H

#include "editor/stage/state.h"
#include "rig/posing.h"

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

extern const struct stage_kind stage_tails, stage_characters, stage_models, stage_chains, stage_meadows;

/// What rigs are posed from: the world, in the editor's look.
struct posing stage_posing(const struct core *core, const struct editor_world *world);
/// Where a point of the world is on the screen, the stage being drawn in `r`; false where it is behind the eye.
bool stage_project_point(const struct stage *stage, struct rect r, const float point[3], float xy[2]);

/// A ring where a tail or chain is held, or can be taken hold of.
void stage_ring(struct core *core, const float xy[2]);
/// The end of a drag that never moved: a click, on a bone or beside all.
void stage_click(void *room, struct core *core, const struct editor_world *world, bool keep);

/// Poses one tail with what is moved by hand; `change` may be NULL.
void stage_pose_tail(const struct stage *stage, const struct core *core, const struct editor_world *world, int tail,
                     double position, const struct what_if *change, struct rig_pose *pose);

#endif
