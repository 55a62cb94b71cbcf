/// Keeps characters of a group above their floors. Private to src/scene.
#ifndef SCENE_FLOORS_H
#define SCENE_FLOORS_H

#include "scene/evaluate.h"

struct pinned;
struct pin_round;

enum { FLOORS_MOST_BOUNDS = 256 }; ///< points that a group keeps above floors

struct floors {
    int samples, splines, rigs; ///< capacity; `splines`: of a group
    wiggly_bound *bounds;
    int *rig, *vertex;       ///< of each bound
    double (*c)[2];          ///< of each bound, for each member
    struct low_point *low;   ///< of the rig in hand, at each sample
    double *room;            ///< to find them in
    double *sunk;            ///< for each rig and sample: how far below its floor knots and pins hold it
    struct floor_left *left; ///< of each rig
    int count;               ///< bounds
};

/// Whether any rig has one.
bool floors_any(const struct document *document);

/// Makes room for the document's floors, for groups of that many splines; false if memory runs out. Without floors it costs nothing.
bool floors_resize(struct floors *floors, const struct document *document, int group);
void floors_free(struct floors *floors);

/// Whether a rig of a group has one.
bool floors_concern(const struct pinned *pinned, const struct document *document, int which);

/// Solves a group that has been solved with a round's pins (or, without `with_pins`, none) once more, above its floors.
wiggly_status floors_solve(struct evaluation *evaluation, const struct document *document, int which,
                           struct pin_round *round, bool with_pins, wiggly_status status);

#endif
