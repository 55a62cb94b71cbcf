/// The document's splines, solved: in the order of their dependencies, only those that changed and their followers.
#ifndef SCENE_EVALUATE_H
#define SCENE_EVALUATE_H

#include "scene/document.h"

/// Solutions of all splines of one document.
struct evaluation {
    wiggly_curve *curves;  ///< one a spline
    wiggly_status *status; ///< what the solver said
    int count;             ///< splines
    int samples;           ///< N
    bool cubic;            ///< all solved in cubic mode (the "cubic" of the A/B comparison)
    uint64_t revision;     ///< another number with every change of the curves
    bool stale;            ///< some curves are not the document's yet: background.h is at work on them
    long solved_splines;   ///< in the last evaluate(): splines and samples solved
    long solved_samples;
    long solved_knots;
    struct storage *storage; ///< private (storage.h)
};

/// Memory for a document's splines; to be called again when the number of splines, samples or knots has changed,
/// which costs next to nothing where it fits. Other splines or samples make every curve unsolved. On failure `count`
/// is 0.
bool evaluation_resize(struct evaluation *evaluation, const struct document *document, struct error *error);
void evaluation_free(struct evaluation *evaluation);

/// Solves the splines marked in `dirty` (NULL: all) and those that follow them by tracks, in dependency order.
/// Allocates nothing. `cubic` solves every spline as a cubic on the same knots (its equilibrium kept): changing it
/// solves all.
void evaluation_update(struct evaluation *evaluation, const struct document *document, const bool *dirty, bool cubic);

/// A spline's value at a position in samples, which may lie between two; nothing where there is no such spline, or `evaluation` is NULL.
wiggly_value evaluation_at(const struct evaluation *evaluation, int spline, double position);

/// The sample of the lowest (or highest) total of a solved spline from `first` to `last`, the earliest of equal ones; fast at any
/// length.
int evaluation_extreme(const struct evaluation *evaluation, int spline, int first, int last, bool highest);

#endif
