/// The curves' memory, and how a spline is described to the solver. Private to src/scene.
#ifndef SCENE_STORAGE_H
#define SCENE_STORAGE_H

#include "scene/document.h"
#include "scene/order.h"
#include "scene/pinned.h"

enum { ROWS = 5 }; ///< of each curve: total, y, re, im, omega

/// The motion of a joint that a spline's equilibrium follows, read for every sample (motion.h).
struct baked {
    uint64_t key; ///< of what was read; 0: nothing yet
    double gain;
    double *raw, *samples; ///< without gain and with it; one block of memory, from `raw` on
    int capacity;          ///< samples there is room for
    bool is_new;           ///< the spline is to be solved again
};

struct spline_state {
    struct spline *held; ///< as it was solved
    struct baked baked;
    bool solved; ///< in this update
    bool forced; ///< to be solved whether edited or not: what moves its pinned rigs has changed
};

struct storage {
    double *numbers; ///< ROWS · N for each spline
    size_t number_capacity;
    wiggly_solver *solver;
    int solver_samples, solver_knots;
    double fps; ///< of the last update, as the next two
    int substeps, first_frame;
    wiggly_knot *knots; ///< of the spline being solved; solver_knots
    int *order;         ///< one for each spline, as the next two
    struct order_space space;
    struct spline_state *state;
    int spline_capacity;
    bool is_new; ///< the curves have a new layout, and none is solved
    struct pinned pinned;
};

/// Lays a curve's rows out in ROWS · samples numbers.
void storage_place(wiggly_curve *curve, double *numbers, int samples);

/// What is to be solved for one spline, its knots left out; tracks point into `curves`, which has one for each spline,
/// and into baked motions.
wiggly_desc storage_describe(const struct storage *storage, const wiggly_curve *curves,
                             const struct document *document, int spline, bool cubic);

/// A knot as the solver has it.
wiggly_knot storage_knot(const struct document *document, const struct knot *knot);

/// Adds the spline's knots, for which `knots` must have room.
void storage_add_knots(wiggly_desc *desc, const struct document *document, int spline, wiggly_knot *knots);

/// Knots that the solver needs room for: a limited spline needs as many more as samples may be held.
int storage_knot_room(const struct spline *spline, int samples);

/// A curve at rest, for where there is no solution.
void storage_flatten(wiggly_curve *curve, const wiggly_desc *desc);

#endif
