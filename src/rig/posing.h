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
    bool at_rest;                  ///< clips do not play
    enum pose_memory memory;       ///< that takes a character's pose, until the next one there
    const struct by_hand *by_hand; ///< moves the rig `held` besides; NULL: nothing does
    int held;
    /// Adds a rig's motion by hand to `hand`; NULL: there is none.
    void (*move)(const void *context, int rig, struct by_hand *hand);
    const void *context; ///< for `move`
};

struct rig_pose {
    enum rig_kind kind;
    const struct imported *imported; ///< of a model
    union {
        struct pose strand;      ///< a tail or chain: where its joints are, and its tip
        struct model_pose model; ///< its memory is the models' own: see struct posing
    };
};

/// Poses a rig of the document at a position in samples. false if there is no such rig, or its model could not be read. Allocates nothing.
bool rig_pose(const struct posing *posing, int rig, double position, struct rig_pose *pose);

/// The same for the model that a rig shows: a tail's fox, or a character.
bool rig_pose_body(const struct posing *posing, int rig, double position, struct rig_pose *pose);

/// Poses a tail and its fox at once; either may be NULL. false if the fox is asked for but missing.
bool tail_pose(const struct posing *posing, int rig, double position, struct rig_pose *posed, struct rig_pose *fox);

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

/// The values of a rig's inputs, read its offset earlier, including motion by hand. Of PART_DISPLACEMENT y is how far settling knots have moved
/// the equilibrium, without what that follows.
void posing_values(const struct posing *posing, int rig, double position, wiggly_value values[RIG_MAX_INPUTS]);

/// The angle, radians, by which a channel bends joint n of `joints` (eq. 27): gain·(y + Re(e^{−j·lag} x)) of its value. LOOK_STIFF takes
/// every lag as 0.
double channel_bend(const struct channel *channel, wiggly_value value, int n, int joints, enum look look);

/// How far a channel moves the n-th joint, from 1 on, of a body part, degrees or percent: gain·(y + Re(e^{−j·n·lag} x)).
double channel_moves(const struct channel *channel, wiggly_value value, int n, enum look look);

/// The document's models as the scene's source for pins, floors and motions; they must not move in memory. `models` may be NULL.
struct model_source models_source(const struct models *models);

/// The shapes of a soft character: its complex normal coordinates, each turned and scaled by its own drive (the paper's
/// section 7.2, eq. 29, eq. 30).
///
///     D(j) = Re(Σ_k z_k Ñ_{k,j}),   z_k = A_k (y + e^{−j·lag_k} x)
///
/// The paper writes the turn as e^{iφ}; a lag is φ = −lag. Where the drive's spline has an equilibrium y, the
/// character rests in the shape that y gives it.
///
/// `values[k]` is the spline value of drive k at the time shown; Re z_k and Im z_k are added to the `weights` of the mesh's morph targets, which
/// a clip may have set. Drives of coordinates that the figure lacks are skipped. LOOK_STIFF is the stiff motion that the paper warns of: the real part of x moves the real part of Ñ, all points in
/// step. Allocates nothing.
void pose_character(const struct model_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, float *weights);

// --- private to src/rig: how each kind of rig is posed

/// How points of a tail or chain, or of a character, are found and moved, like model_source.find() and weigh(). `posing` uses the paper's look.
bool strand_find_pin(const struct posing *posing, const struct pin_query *query, pin_pull *c,
                     struct pin_point *point);
double strand_weigh(const struct posing *posing, int rig, int spline);
bool character_find_pin(const struct posing *posing, const struct pin_query *query, pin_pull *c,
                        struct pin_point *point);
double character_weigh(const struct posing *posing, int rig, int spline);

/// For angles in files, which are degrees.
static inline double radians(double degrees) { return degrees * 3.14159265358979323846 / 180.0; }

/// Where the joints of a chain are. False if its model is missing.
bool chain_pose(const struct posing *posing, int rig, double position, struct pose *strand);

/// The places of its bones in its clip alone, or at rest, in the given memory; NULL if there is no model.
struct gltf_pose *posing_clip(const struct posing *posing, int rig, double position, enum pose_memory memory);

/// Bends, moves and places a model on top of its clip's pose, as rig_pose_body() does.
void posing_bend(const struct posing *posing, int rig, double position, struct gltf_pose *pose,
                 struct rig_pose *posed);

/// The place of a character: columns and place of its space in the world.
void posing_root(const struct posing *posing, int rig, double root[12]);

/// Whether a clip loops and fills the scene's range once or several times.
bool posing_clip_loops(const struct document *document, const struct clip_play *play);

/// The time in a clip, seconds, at a position in samples, for gltf_pose_loop(). A clip that loops starts again after its length; one that plays
/// once stays at its end. Before its first key a clip waits there, unless it loops in the scene.
double posing_clip_time(const struct document *document, double position, const struct clip_play *play);

/// Its displacement by hand, metres.
void posing_base(const struct posing *posing, int rig, double base[3]);

/// Like model_source.lowest() and follow().
bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low);
bool clip_follow(const void *context, const struct document *document, const struct joint_motion *motion,
                 const char *coordinate, double *samples);

/// Adds the effect of a channel's spline on a point that a bend of joint n moves along `way`, metres per radian.
void pinning_add_channel(const struct channel *channel, int n, int joints, const double way[3], pin_pull c);

/// Σ |c|²
double pinning_square(const pin_pull c);

#endif
