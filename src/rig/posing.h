/// A document at a position in time → its rigs posed. Pure: the only way to pose, for the stage, figures, tests and export alike.
#ifndef RIG_POSING_H
#define RIG_POSING_H

#include "model/morph.h"
#include "model/pose.h"
#include "rig/look.h"
#include "rig/models.h"
#include "scene/evaluate.h"

/// What rigs are posed from.
struct posing {
    const struct document *document;
    const struct evaluation *evaluation; ///< NULL: all splines are 0
    const struct models *models;         ///< the characters' models; NULL: none
    enum look look;
};

/// What moves a rig besides the document.
struct by_hand {
    wiggly_value input[RIG_MAX_INPUTS]; ///< added to each of its inputs (rig.h)
    double base[3];                     ///< metres
};

struct rig_pose {
    enum rig_kind kind;
    union {
        struct pose tail;
        struct {
            const struct figure *figure;
            struct morph morph;
            float position[3]; ///< what it stands on, metres
        } character;
    };
};

/// Poses a rig of the document at a position in samples; `by_hand` may be NULL. false where there is no such rig, or its model
/// could not be read. Allocates nothing.
bool rig_pose(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
              struct rig_pose *pose);

/// The box around a posed rig, metres.
void rig_bounds(const struct rig_pose *pose, float lo[3], float hi[3]);

#endif
