/// Document and position in time → posed rigs. A pure function, and the only way to pose: for the stage, figures and tests alike.
#ifndef RIG_POSING_H
#define RIG_POSING_H

#include "model/figure.h"
#include "model/fox.h"
#include "rig/models.h"
#include "scene/evaluate.h"

/// How the same knots are shown: by the paper's method, without lag, or as classical cubics (the splines are then solved that way).
enum look { LOOK_WIGGLY, LOOK_STIFF, LOOK_CUBIC };

/// Motion of a rig in addition to the document's, for example by a drag.
struct by_hand {
    wiggly_value input[RIG_MAX_INPUTS]; ///< added to each of its inputs (rig.h)
    double base[3];                     ///< metres
};

/// The context for posing rigs.
struct posing {
    const struct document *document;
    const struct evaluation *evaluation; ///< NULL: all splines are 0
    const struct models *models;         ///< the characters' models; NULL: none
    enum look look;
    bool at_rest;            ///< clips do not play
    enum pose_memory memory; ///< that takes an imported character's pose, until the next one there
    /// Adds a rig's motion by hand to `hand`; NULL: there is none.
    void (*move)(const void *context, int rig, struct by_hand *hand);
    const void *context; ///< for `move`
};

struct rig_pose {
    enum rig_kind kind;
    union {
        struct pose strand; ///< a tail or chain: where its joints are, and its tip
        struct {
            const struct figure *figure;
            struct morph morph;
            float position[3]; ///< where it stands, metres
        } character;
        struct {
            const struct imported *imported;
            const struct gltf_pose *pose; ///< the models' own: see struct posing
            float root[16];               ///< its space → world
            float ground;                 ///< height of the ground under it, metres
        } model;
    };
};

/// Poses a rig of the document at a position in samples; `by_hand` (may be NULL) moves it besides what `posing` says. false if there is no such rig, or its model
/// could not be read. Allocates nothing.
bool rig_pose(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
              struct rig_pose *pose);

/// The same for the model that a rig shows: a tail's fox, or an imported character.
bool rig_pose_body(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                   struct rig_pose *pose);

/// How a model rig plays a clip of its file: from its first key, in seconds, for a length; then again, or no more.
struct clip_play {
    double first, length;
    bool loops;
};
struct clip_play clip_play(const struct model_rig *model, const struct gltf_clip *clip);

/// The rig that a rig bends: a chain's model, −1: there is none. Any other rig is its own body.
int rig_body(const struct document *document, int rig);

/// The box around a posed rig that is a body, metres.
void rig_bounds(const struct rig_pose *pose, float lo[3], float hi[3]);

/// A channel's value at a position. Of PART_DISPLACEMENT y is how far settling knots have moved the equilibrium, without what that follows.
wiggly_value channel_value(const struct posing *posing, const struct channel *channel, double position);

/// The angle, radians, by which a channel bends joint n of `joints` (eq. 27): gain·(y + Re(e^{−j·lag} x)) of a channel_value(). LOOK_STIFF takes
/// every lag as 0.
double channel_bend(const struct channel *channel, wiggly_value value, int n, int joints, enum look look);

/// How far a channel moves the n-th joint, from 1 on, of a body part, degrees or percent: gain·(y + Re(e^{−j·n·lag} x)).
double channel_moves(const struct channel *channel, wiggly_value value, int n, enum look look);

/// The document's models as the scene's source for pins, floors and motions; they must not move in memory. `models` may be NULL.
struct model_source models_source(struct models *models);

/// Poses a soft character: its complex normal coordinates, each turned and scaled by its own drive (the paper's
/// section 7.2, eq. 29, eq. 30).
///
///     D(j) = Re(Σ_k z_k Ñ_{k,j}),   z_k = A_k (y + e^{−j·lag_k} x)
///
/// The paper writes the turn as e^{iφ}; a lag is φ = −lag. Where the drive's spline has an equilibrium y, the
/// character rests in the shape that y gives it.
///
/// `values[k]` is the spline value of drive k at the time shown. Drives of coordinates that the figure lacks are
/// skipped. LOOK_STIFF is the stiff motion that the paper warns of: the real part of x moves the real part of Ñ, all points in
/// step. Allocates nothing.
void pose_character(const struct character_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, struct morph *morph);

#endif
