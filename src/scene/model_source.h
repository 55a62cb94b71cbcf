/// What the solver needs to know about models: places of pinned points and floors, how splines move them, and how joints move in clips.
/// Implemented by a higher layer (rig/posing.h).
#ifndef SCENE_MODEL_SOURCE_H
#define SCENE_MODEL_SOURCE_H

#include "scene/document.h"

struct evaluation;

/// A pinned point at its sample.
struct pin_point {
    double at[3];   ///< metres of the world
    double size;    ///< of its rig, metres
    double slack;   ///< tolerance, metres
    bool is_linear; ///< it moves by Σ Re(c x) at any distance; else it hangs from `base`, at most `reach` away
    double base[3], reach;
};

/// c of each of some splines: the point moves by Re(c dx) in x, y and z.
typedef double pin_pull[3][2];

/// The lowest vertex of a character at a sample, and how high it is, metres of the world.
struct low_point {
    double height;
    int vertex;
};

enum { LOW_POINT_ROW = 128 }; ///< lowest points of this many samples are found together

/// Samples rounded up to whole rows.
static inline int low_point_samples(int samples)
{
    return (samples + LOW_POINT_ROW - 1) / LOW_POINT_ROW * LOW_POINT_ROW;
}

enum { LOW_POINT_ROOM = 3 * (CHARACTER_MAX_DRIVES + 1) }; ///< numbers needed for finding them, per such sample

struct model_source {
    /// Finds a pin's point as the splines are in `evaluation`, and how `count` splines move it from there (`c` may be NULL if
    /// there are none). false: its model is missing, or has no such point. NULL: pins are ignored.
    bool (*find)(void *context, const struct evaluation *evaluation, const struct document *document, int rig,
                 const struct pin *pin, const int *splines, int count, pin_pull *c, struct pin_point *point);
    /// Adds to each spline's weight the mean of |c|² over the surface of a rig at rest.
    void (*weigh)(void *context, const struct document *document, int rig, const int *splines, int count,
                  double *weights);
    /// Finds a character's lowest vertex at every sample. Vertices not below `ceiling` may be skipped; the height is then `ceiling` and the vertex
    /// -1. `room` has LOW_POINT_ROOM numbers per low_point_samples(). false: its model is missing.
    bool (*lowest)(void *context, const struct evaluation *evaluation, const struct document *document, int rig,
                   double ceiling, double *room, struct low_point *low);
    /// Writes the motion of a joint at each of the document's samples, in degrees or metres, without gain. false, or NULL: it is 0.
    bool (*follow)(void *context, const struct document *document, const struct joint_motion *motion,
                   double *samples);
    void *context;
    uint64_t version; ///< changes when the results may change for the same document
};

#endif
