/// Solves the splines of pinned rigs together. Private to src/scene.
#ifndef SCENE_PINNED_H
#define SCENE_PINNED_H

#include "scene/floors.h"

struct evaluation;
struct storage;

/// A pin of the group in hand.
struct held_pin {
    int rig, pin;
    bool is_found;
    struct pin_point from; ///< where its pulls are those of
    double passed[3];      ///< Σ Re(c x) there
    double ease;           ///< pin_ease() without pins
};

/// What a group is solved with: a pin and its pulls for each held pin.
struct pin_round {
    wiggly_pin *pins;
    wiggly_pull *pulls; ///< of all pins, as many for each as the group has splines
};

struct pinned {
    wiggly_group *solver;
    int samples, most_knots, group, pins, bounds; ///< its capacity; `group`: splines
    struct floors floors;
    int splines; ///< that there is room for below
    int knot_capacity;
    wiggly_knot *knots; ///< of the group in hand
    int *which;         ///< for each spline, pin_groups_find()
    int *order;
    bool *placed;   ///< by pin_groups_order(), then: solved, if need be, in this update
    bool *was;      ///< it was solved in a group
    bool *bases;    ///< of the group in hand, pin_groups_find_bases()
    double *weight; ///< for each spline
    int *members;   ///< of the group in hand
    int count;
    wiggly_desc *descs; ///< of the members, as the next two
    wiggly_curve *curves;
    double *weights;
    pin_pull *c; ///< of a pin, for each member
    struct held_pin *held;
    int held_count;
    struct pin_round round;
    struct pin_left *left; ///< of all pins of the document
    int left_count;
    bool served;       ///< groups were solved in the last update
    struct rig **rigs; ///< as they were solved
    int rig_count, rig_capacity;
    uint64_t version; ///< of the source then
};

/// Makes room for the document's groups. Without pins it costs nothing.
void pinned_resize(struct storage *storage, const struct document *document);
void pinned_free(struct pinned *pinned);

/// Puts the splines into an order for groups, and finds what is to be solved again because rigs or pins have changed. Whether there are
/// groups: if not, storage->order is the order.
bool pinned_begin(struct evaluation *evaluation, const struct document *document);

/// Whether a spline's group moves with something that was solved in this update.
bool pinned_base_moved(struct evaluation *evaluation, const struct document *document, int which);

/// Solves the group of a spline into the members' curves. false if it cannot be solved together.
bool pinned_solve(struct evaluation *evaluation, const struct document *document, int which, wiggly_status *status);

/// Measures what is left of all pins.
void pinned_measure(struct evaluation *evaluation, const struct document *document);

/// How far splines move a point: |c| over all of a pin's pulls.
double pin_ease(const wiggly_pin *pin);

/// Sets where x is to take a point that is at `from`, where Σ Re(c x) is `passed`; `ease` is pin_ease() without pins. A tail's or chain's is
/// taken only part of its way where it is far or hard to move, and its conditions (also in `pulls`, which are the pin's) are weighed so
/// that what hardly moves it, as the motion is without pins, gives way. All of it is continuous in `to` and `from`.
void pin_aim(const struct pin_point *from, double ease, const double to[3], const double passed[3], wiggly_pin *pin,
             wiggly_pull *pulls);

#endif
