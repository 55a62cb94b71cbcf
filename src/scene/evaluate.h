/// Solves a document's splines in dependency order: those that changed and their followers.
#ifndef SCENE_EVALUATE_H
#define SCENE_EVALUATE_H

#include "scene/document.h"

/// Methods of solving. Their curves differ only by rounding; a document always gives the same bits.
enum solver_choice {
    SOLVER_BY_LENGTH, ///< up to so many samples by the paper's band, longer ones by the chain
    SOLVER_CHAIN,
    SOLVER_BAND,
};
enum { SOLVER_LONGEST_BAND = 4096 };

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

enum { LOW_POINT_PAIRS = 3 };                                           ///< of weights, of a curved coordinate
enum { LOW_POINT_ROOM = 3 * (LOW_POINT_PAIRS * MODEL_MAX_DRIVES + 1) }; ///< numbers for them, per such sample

/// A pin of a rig, and the splines whose pulls on its point are wanted.
struct pin_query {
    int rig;
    const struct pin *pin;
    const int *splines;
    int count;
    double later; ///< samples after the pin's
};

/// What the solver needs to know about models: places of pinned points and floors, how splines move them, and how joints move in clips.
/// Implemented by a higher layer (rig/posing.h).
struct model_source {
    /// Finds a pin's point as the splines are in `evaluation`, and how the splines asked for move it from there (`c` may be NULL if
    /// there are none). false: its model is missing, or has no such point. NULL: pins are ignored.
    bool (*find)(const void *context, const struct evaluation *evaluation, const struct document *document,
                 const struct pin_query *query, pin_pull *c, struct pin_point *point);
    /// The mean of |c|² of a spline over the surface of a rig at rest.
    double (*weigh)(const void *context, const struct document *document, int rig, int spline);
    /// Finds a character's lowest vertex at every sample. Vertices not below `ceiling` may be skipped; the height is then `ceiling` and the vertex
    /// -1. `room` has LOW_POINT_ROOM numbers per low_point_samples(). false: its model is missing.
    bool (*lowest)(const void *context, const struct evaluation *evaluation, const struct document *document, int rig,
                   double ceiling, double *room, struct low_point *low);
    /// Writes the motion of a joint at each of the document's samples, in degrees or metres, without gain; MOTION_BASE is for that coordinate.
    /// false, or NULL: it is 0.
    bool (*follow)(const void *context, const struct document *document, const struct joint_motion *motion,
                   const char *coordinate, double *samples);
    const void *context;
    uint64_t version; ///< changes when the results may change for the same document
};

/// Solutions of all splines of one document.
struct evaluation {
    wiggly_curve *curves;      ///< one for each spline
    wiggly_status *status;     ///< the solver's result
    int count;                 ///< splines
    int samples;               ///< N
    bool cubic;                ///< all solved in cubic mode (the "cubic" of the A/B comparison)
    enum solver_choice solver; ///< set it before the first update
    uint64_t revision;         ///< changes whenever a curve does
    long solved_splines;       ///< solved by the last update
    long solved_samples;
    long solved_knots;
    struct model_source models; ///< set it before each update. Zero: pins are ignored, and motions are 0
    struct storage *storage;    ///< private
};

enum { EVALUATION_SENTENCE = 200 };

/// Writes a problem of a solved spline, if need be with the estimated error, to `text` of EVALUATION_SENTENCE bytes; false if there is none.
bool evaluation_sentence(const struct evaluation *evaluation, int spline, char *text);

/// Solves the splines that have changed, and those that follow them by tracks; all if the number of splines or samples has changed.
/// Allocates only if it needs more room. `cubic` solves every spline as a cubic on the same knots, with its equilibrium and, after the last
/// knot, its value; changing it solves all.
void evaluation_update(struct evaluation *evaluation, const struct document *document, bool cubic);
void evaluation_free(struct evaluation *evaluation);

/// Whether the last update was of the document in its present state.
bool evaluation_is_of(const struct evaluation *evaluation, const struct document *document);

/// The description of one spline for the solver; `knots` must have room for its knots.
wiggly_desc evaluation_describe(const struct evaluation *evaluation, const struct document *document, int spline,
                                wiggly_knot *knots);

/// The method that solves the splines, and its name: "chain" or "band".
wiggly_method evaluation_method(const struct evaluation *evaluation);
const char *evaluation_solver(const struct evaluation *evaluation);

/// The motion of the joint that a spline's equilibrium follows, times gain: one number per sample. NULL if it follows none.
const double *evaluation_motion(const struct evaluation *evaluation, int spline);

/// A spline's value at a position in samples, possibly between two. Zeros if there is no such spline or `evaluation` is NULL.
wiggly_value evaluation_at(const struct evaluation *evaluation, int spline, double position);

/// How far settling knots have moved a spline's equilibrium at a position; 0 if it is not solved.
double evaluation_offset(const struct evaluation *evaluation, const struct document *document, int spline,
                         double position);

/// Where a pin's point was in the last update.
struct pin_left {
    bool is_found; ///< false: no such point, for example because the model is missing
    double at[3];  ///< where it is, metres
    double way[3]; ///< remaining offset to its place
    double size;   ///< of its rig
};

/// The result for a pin of a rig; NULL if there is none, for example because the document has changed since.
const struct pin_left *evaluation_pin(const struct evaluation *evaluation, const struct document *document, int rig,
                                      int pin);

/// The deepest place of a character below its floor; `depth` 0: nowhere.
struct floor_left {
    double depth; ///< metres
    int sample;
};

/// Where a rig was deepest below its floor in the last update; NULL if there is no result.
const struct floor_left *evaluation_floor(const struct evaluation *evaluation, int rig);

/// The slope at a sample with which a knot on the curve would not change the curve.
double evaluation_slope(const struct evaluation *evaluation, const struct document *document, int spline, int sample);

/// The sample from `first` to `last` with a solved spline's lowest (or highest) total, the earliest of equal ones.
int evaluation_extreme(const struct evaluation *evaluation, int spline, int first, int last, bool highest);

#endif
