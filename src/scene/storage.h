/// The private data of an evaluation: memory, solved splines, and the groups of splines that pins and floors join. Private to
/// src/scene.
#ifndef SCENE_STORAGE_H
#define SCENE_STORAGE_H

#include "base/need.h"
#include "scene/evaluate.h"
#include "scene/order.h"

/// The motion of a joint that a spline's equilibrium follows, read for every sample.
struct baked {
    uint64_t key; ///< hash of what was read; 0: nothing yet
    double gain;
    double *raw, *samples; ///< without gain and with it
    bool is_new;           ///< the spline must be solved again
};

struct spline_state {
    struct spline *held; ///< as it was solved
    struct baked baked;
    bool solved; ///< in this update
    bool forced; ///< must be solved even if it is unchanged, because something that moves its pinned rigs has changed
};

enum { FLOORS_MOST_BOUNDS = 256 }; ///< per group

struct floors {
    wiggly_bound *bounds;
    int *rig, *vertex;       ///< of each bound
    double (*c)[2];          ///< of each bound, for each member
    struct low_point *low;   ///< of the current rig, at each sample
    int in_hand;             ///< that rig, if nothing has been solved since; else -1
    double *room;            ///< memory for finding them
    double *sunk;            ///< per rig and sample: depth below its floor at which knots and pins hold it
    struct floor_left *left; ///< of each rig
    int count;               ///< bounds
};

/// A pin of the current group.
struct held_pin {
    int rig;
    const struct pin *pin;
    bool is_found;
    struct pin_point from; ///< the point at which its pulls were found
    double passed[3];      ///< Σ Re(c x) there
    double ease;           ///< pin_ease() without pins
};

/// Capacities.
struct pinned_room {
    int knots;      ///< of one spline, as the solver needs them
    int all_knots;  ///< of all splines
    int group;      ///< splines of the largest
    int pins, rigs; ///< of the document
    int bounds;     ///< 0: no rig has a floor
};

struct pinned {
    struct pool pool;
    struct pinned_room room;
    wiggly_group *solver;
    struct floors floors;
    bool served;       ///< groups were solved in the last update
    uint64_t version;  ///< of the source then
    struct rig **rigs; ///< as they were solved
    int rig_count;
    struct pin_left *left; ///< of all pins of the document
    int left_count;

    // of each spline
    int *which; ///< pin_groups_find()
    int *order;
    bool *placed;   ///< by pin_groups_order(), then: solved, if need be, in this update
    bool *was;      ///< it was solved in a group
    bool *bases;    ///< of the group in hand, pin_groups_find_bases()
    double *weight; ///< of pulling it

    // The current group of an update
    struct evaluation *evaluation;
    const struct document *document;
    int group; ///< as `which` has it
    int *members;
    int count;
    wiggly_desc *descs; ///< of the members, as the next two
    wiggly_curve *curves;
    double *weights;
    wiggly_knot *knots;
    pin_pull *c; ///< of a pin, for each member
    struct held_pin *held;
    int held_count;
    wiggly_pin *pins;   ///< one a held pin
    wiggly_pull *pulls; ///< of all pins, as many for each as the group has splines
};

struct storage {
    struct pool pool;
    wiggly_solver *solver;
    int solver_knots;
    double fps; ///< of the last update, as the next three
    int substeps, first_frame;
    uint64_t edits, version;
    wiggly_knot *knots; ///< of the spline being solved; solver_knots
    int *order;         ///< one for each spline, as the next two
    struct order_space space;
    struct spline_state *state;
    bool is_new; ///< the curves have a new layout, and none is solved
    struct pinned pinned;
};

/// What is to be solved for one spline, its knots left out; tracks point into the curves and into baked motions.
wiggly_desc storage_describe(const struct evaluation *evaluation, const struct document *document, int spline,
                             bool cubic);

/// Adds the spline's knots; `knots` must have room for them.
void storage_add_knots(wiggly_desc *desc, const struct document *document, int spline, wiggly_knot *knots);

/// Knots that the solver needs room for; with limits, also one for each sample that may be held.
int storage_knot_room(const struct spline *spline, int samples);

/// A curve at rest, used if there is no solution.
void storage_flatten(wiggly_curve *curve, const wiggly_desc *desc);

/// Makes room for the document's groups. Without pins it costs nothing.
void pinned_resize(struct evaluation *evaluation, const struct document *document);
void pinned_free(struct pinned *pinned);

/// Begins an update: orders the splines for groups, and finds which must be solved again because rigs or pins have changed. Returns whether
/// there are groups; if not, storage->order is the order.
bool pinned_begin(struct evaluation *evaluation, const struct document *document);

/// Makes a group the current one. Returns whether something solved in this update moves it.
bool pinned_take(struct pinned *pinned, int which);

/// Solves the current group into the members' curves. false if it cannot be solved together.
bool pinned_solve(struct pinned *pinned, wiggly_status *status);

/// Measures the remaining offsets of all pins.
void pinned_measure(struct pinned *pinned);

/// Makes room for floors. And whether a rig of the current group has one.
void floors_resize(struct pinned *pinned, int samples);
bool floors_concern(const struct pinned *pinned);

/// Solves the current group again, above its floors; `status` is the result without them.
wiggly_status floors_solve(struct pinned *pinned, wiggly_status status);

#endif
