/// What evaluate.c and background.c share: the curves' memory, the thread that may be using it, and how a spline is described to
/// the solver. Private to src/scene.
#ifndef SCENE_STORAGE_H
#define SCENE_STORAGE_H

#include "scene/document.h"
#include "scene/extremes.h"
#include "scene/order.h"

enum { ROWS = 5 }; ///< rows of numbers a curve: total, y, re, im, omega

struct storage {
    double *numbers; ///< ROWS · N for each spline
    size_t number_capacity;
    double *marks; ///< of all extremes
    size_t mark_capacity;
    wiggly_solver *solver;
    int solver_samples, solver_knots;
    wiggly_knot *knots; ///< of the spline being solved; solver_knots
    int *order;         ///< one a spline each, as the next four
    bool *solved;
    struct order_space space;
    struct extremes *extremes;
    int spline_capacity;
    bool is_new;                   ///< curves were laid out anew, and none is solved
    unsigned layout;               ///< counts them
    unsigned threaded_layout;      ///< the last one that was shared with a thread, or could not be
    struct background *background; ///< NULL: every solve is done where it is asked for
};

/// Puts a curve's rows into ROWS · samples numbers.
void storage_place(wiggly_curve *curve, double *numbers, int samples);

/// The same for extremes in 2 · extremes_blocks(samples) marks; none where marks is NULL.
struct extremes storage_extremes(double *marks, int samples);

/// Whether curves of that many samples have extremes.
bool storage_wants_extremes(int samples);

/// What is to be solved for one spline, its knots left out; tracks point into `curves`, which has one for each spline.
wiggly_desc storage_describe(const wiggly_curve *curves, const struct document *document, int spline, bool cubic);

/// A knot as the solver has it.
wiggly_knot storage_knot(const struct document *document, const struct knot *knot);

/// Adds the knots, for which there is room.
void storage_add_knots(wiggly_desc *desc, const struct document *document, int spline, wiggly_knot *knots);

/// What is shown where there is no solution: nothing moves.
void storage_flatten(wiggly_curve *curve, const wiggly_desc *desc);

struct evaluation;

/// Stops the thread because memory that it uses is about to change; what it was solving stays to be done.
void background_halt(struct evaluation *evaluation);

/// The same where everything stale is about to be solved anyway.
void background_forget(struct evaluation *evaluation);

/// NULL is fine.
void background_destroy(struct background *background);

#endif
