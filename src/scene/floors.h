/// Keeps characters of a group above their floors. Private to src/scene.
#ifndef SCENE_FLOORS_H
#define SCENE_FLOORS_H

#include "scene/pin_source.h"

enum { FLOORS_MOST_BOUNDS = 256 }; ///< points that a group keeps above floors

struct floors {
    int samples, splines, rigs; ///< capacity; `splines`: of a group
    wiggly_bound *bounds;
    int *rig, *vertex;       ///< of each bound
    double (*c)[2];          ///< of each bound, for each member
    struct low_point *low;   ///< of the rig in hand, at each sample
    int in_hand;             ///< that rig, where nothing has been solved since; else -1
    double *room;            ///< to find them in
    double *sunk;            ///< for each rig and sample: how far below its floor knots and pins hold it
    struct floor_left *left; ///< of each rig
    int count;               ///< bounds
};

/// A group of splines as it has been solved, to be solved again above its floors.
struct floor_group {
    wiggly_group *solver;
    const struct pin_source *source;
    const struct evaluation *evaluation; ///< that the source looks at
    wiggly_curve *shown;                 ///< its curves, of all splines
    int samples;
    const int *which; ///< of each spline, the group that it is in
    int group;        ///< this one
    const int *members;
    int count;                ///< of them, and of the next four
    const wiggly_desc *descs; ///< as they are solved
    const double *weights;
    wiggly_curve *curves;
    pin_pull *c;      ///< room
    wiggly_pin *pins; ///< that they are solved with
    int pin_count;
};

/// Whether any rig has one.
bool floors_any(const struct document *document);

/// Makes room for the document's floors, for groups of that many splines. Without floors it costs nothing.
void floors_resize(struct floors *floors, const struct document *document, int group);
void floors_free(struct floors *floors);

/// Whether a rig of a group has one.
bool floors_concern(const int *which, const struct document *document, int group);

/// Solves a group once more, above its floors; `status` is what solving it without them gave.
wiggly_status floors_solve(struct floors *floors, const struct floor_group *group, const struct document *document,
                           wiggly_status status);

#endif
