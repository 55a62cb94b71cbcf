/// Solves a document's splines in dependency order: those that changed and their followers.
#ifndef SCENE_EVALUATE_H
#define SCENE_EVALUATE_H

#include "scene/document.h"
#include "scene/model_source.h"

/// How splines are solved. The curves are the same but for rounding; a document has the same bits each time.
enum solver_choice {
    SOLVER_BY_LENGTH, ///< up to so many samples by the paper's band, longer ones by the chain
    SOLVER_CHAIN,
    SOLVER_BAND,
};
enum { SOLVER_LONGEST_BAND = 4096 };

/// Solutions of all splines of one document.
struct evaluation {
    wiggly_curve *curves;      ///< one for each spline
    wiggly_status *status;     ///< what the solver said
    int count;                 ///< splines
    int samples;               ///< N
    bool cubic;                ///< all solved in cubic mode (the "cubic" of the A/B comparison)
    enum solver_choice solver; ///< of every solve; set it before the first update
    uint64_t revision;         ///< changes whenever a curve does
    uint64_t *revisions;       ///< for each spline: the revision in which its curve last changed
    long solved_splines;       ///< solved by the last update
    long solved_samples;
    long solved_knots;
    struct model_source models; ///< set it before each update. Zero: pins are ignored, and motions are 0
    struct storage *storage;    ///< private (storage.h)
};

enum { EVALUATION_SENTENCE = 200 };

/// Writes why a spline was not simply solved into `text` of EVALUATION_SENTENCE bytes, with the estimated error if that is the reason;
/// false if it was.
bool evaluation_sentence(const struct evaluation *evaluation, int spline, char *text);

/// Solves the splines that are not the ones solved last, and those that follow them by tracks; a new number of splines or samples solves
/// all. Allocates only if it needs more room. `cubic` solves every spline as a cubic on the same knots, keeping its
/// equilibrium and, behind the last knot, its value; changing it solves all.
void evaluation_update(struct evaluation *evaluation, const struct document *document, bool cubic);
void evaluation_free(struct evaluation *evaluation);

/// Whether the last update was of the document as it is.
bool evaluation_is_of(const struct evaluation *evaluation, const struct document *document);

/// What is solved for one spline, with its knots, for which `knots` has room.
wiggly_desc evaluation_describe(const struct evaluation *evaluation, const struct document *document, int spline,
                                wiggly_knot *knots);

/// The method that solves its splines, and its name: "chain" or "band".
wiggly_method evaluation_method(const struct evaluation *evaluation);
const char *evaluation_solver(const struct evaluation *evaluation);

/// The motion of the joint that a spline's equilibrium follows, times gain: one number per sample. NULL if it follows none.
const double *evaluation_motion(const struct evaluation *evaluation, int spline);

/// A spline's value at a position in samples, possibly between two. Zeros if there is no such spline or `evaluation` is NULL.
wiggly_value evaluation_at(const struct evaluation *evaluation, int spline, double position);

/// What a pin's point has reached in the last update.
struct pin_left {
    bool is_found; ///< false: there is no such point, as where the model is missing
    double at[3];  ///< where it is, metres
    double way[3]; ///< offset that remains to its place
    double size;   ///< of its rig
};

/// The result for a pin of a rig; NULL if there is none, for example because the document has changed since.
const struct pin_left *evaluation_pin(const struct evaluation *evaluation, const struct document *document, int rig,
                                      int pin);

/// Where a character is deepest below its floor; `depth` 0: nowhere.
struct floor_left {
    double depth; ///< metres
    int sample;
};

/// Where a rig was deepest below its floor in the last update; NULL if there is no result.
const struct floor_left *evaluation_floor(const struct evaluation *evaluation, int rig);

/// The slope at a sample that, keyed there with the curve's value, leaves the curve as it is.
double evaluation_slope(const struct evaluation *evaluation, const struct document *document, int spline, int sample);

/// The sample from `first` to `last` with a solved spline's lowest (or highest) total, the earliest of equal ones.
int evaluation_extreme(const struct evaluation *evaluation, int spline, int first, int last, bool highest);

#endif
