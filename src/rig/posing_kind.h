/// How each kind of rig is posed. Private to src/rig.
#ifndef RIG_POSING_KIND_H
#define RIG_POSING_KIND_H

#include "rig/posing.h"

/// How points of a rig are found and moved, like model_source.find() and weigh(). `posing` uses the paper's look; `sample` is a pin's.
struct pinning_functions {
    bool (*find)(const struct posing *posing, int rig, double sample, int which, const int *splines, int count,
                 pin_pull *c, struct pin_point *point);
    void (*weigh)(const struct posing *posing, int rig, const int *splines, int count, double *weights);
};

extern const struct pinning_functions strand_pinning;

/// For angles in files, which are degrees.
static inline double radians(double degrees) { return degrees * 3.14159265358979323846 / 180.0; }

struct posing_functions {
    /// All of `pose` but its kind is filled in. false if its model is missing.
    bool (*pose)(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                 struct rig_pose *pose);
    void (*bounds)(const struct rig_pose *pose, float lo[3], float hi[3]); ///< NULL: it is not a body
    const struct pinning_functions *pins;                                  ///< NULL: it has no pins
};

/// The places of its bones in its clip alone, or at rest, in the given memory; NULL if there is no model.
struct gltf_pose *posing_clip(const struct posing *posing, int rig, double position, enum pose_memory memory);

/// The place of an imported character: columns and place of its space in the world.
void posing_root(const struct posing *posing, int rig, const struct by_hand *by_hand, double root[12]);

/// Whether a clip loops and fills the scene's range once or several times.
bool posing_clip_loops(const struct document *document, const struct clip_play *play);

/// The time in a clip, seconds, at a position in samples, for gltf_pose_loop(). A clip that loops starts again after its length; one that plays
/// once stays at its end. Before its first key a clip waits there, unless it loops in the scene.
double posing_clip_time(const struct document *document, double position, const struct clip_play *play);

/// The values of a rig's inputs, including motion by hand.
void posing_values(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                   wiggly_value values[RIG_MAX_INPUTS]);

/// Its displacement by hand, metres.
void posing_base(const struct posing *posing, int rig, const struct by_hand *by_hand, double base[3]);

/// The base of a tail, metres of the world, and the motion of the body's parts.
struct limbs tail_base(const struct posing *posing, int rig, double position, const wiggly_value *values,
                       const struct by_hand *by_hand, double base[3]);

/// Height of the ground under a tail's body.
float tail_ground(const struct tail *tail);

/// Like model_source.lowest() and follow().
bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low);
bool clip_follow(void *context, const struct document *document, const struct joint_motion *motion, double *samples);

/// Adds the effect of a channel's spline on a point that a bend of joint n moves along `way`, metres per radian.
void pinning_add_channel(const struct channel *channel, int n, int joints, const double way[3], pin_pull c);

/// Σ |c|²
double pinning_square(const pin_pull c);

/// By kind: tail_posing …
extern const struct posing_functions *const posing_kinds[RIG_KINDS];
#define POSING_FUNCTIONS(constant, name) extern const struct posing_functions name##_posing;
RIG_KIND_LIST(POSING_FUNCTIONS)
#undef POSING_FUNCTIONS

#endif
