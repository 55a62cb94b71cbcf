/// What is wrong with splines though they load and solve.
#ifndef SCENE_WARNINGS_H
#define SCENE_WARNINGS_H

#include "scene/evaluate.h"

/// Why the slope of a knot of a spline has no effect, to stand behind "the slope has no effect: "; NULL where it has one, or where a track
/// decides.
const char *knot_idle_slope(const struct document *document, int of, int knot);

/// Index of the first pose of a spline whose mode has no phase, or -1.
int spline_idle_pose(const struct spline *spline);

enum warning_kind {
    WARNING_FAR,    ///< the curve swings more than twice as far as the knots around it and as its average knot
    WARNING_RATE,   ///< a frequency near half the sample rate
    WARNING_DRIFT,  ///< bandwidth times the periods between two knots
    WARNING_FORCED, ///< poses that are out of step with the swing between them
    WARNING_SLOPE,  ///< a slope that has no effect
    WARNING_PHASE,  ///< poses outside complex mode
};

/// A problem of a spline.
struct warning {
    enum warning_kind kind;
    int spline;
    double frame, value; ///< the place (not of a rate)
    double from, to;     ///< frames of the knots around it
    double amount;       ///< Hz; periods; degrees out of step
    double limit;        ///< Hz that would be fine; bandwidth as it is
    double remedy;       ///< value of a knot at the place; substeps; bandwidth
    const char *why;     ///< a slope has no effect
    double phase;        ///< Im x of a pose at the place
    double low, high;    ///< limits a little beyond the knots
};

enum { WARNINGS_MAX = 16, WARNING_SENTENCE = 200 };

struct warnings {
    int count;
    struct warning list[WARNINGS_MAX];
};

/// Adds where a solved spline without limits swings furthest beyond its knots, if it does. Allocates nothing.
void warnings_add_far(const struct document *document, const struct evaluation *evaluation, int of,
                      struct warnings *found);
/// Adds where its poses force the swing.
void warnings_add_forced(const struct document *document, const struct evaluation *evaluation, int of,
                         struct warnings *found);
/// How much of a far swing, a fast rate or poses out of step a solution still has; 1 or less: it is gone.
double warning_left(const struct warning *warning, const struct document *document,
                    const struct evaluation *evaluation);
/// Adds all that is wrong with a solved spline, up to WARNINGS_MAX, spans in the order of time. Allocates nothing.
void warnings_add(const struct document *document, const struct evaluation *evaluation, int of,
                  struct warnings *found);

/// What is wrong, as a sentence.
void warning_say(const struct warning *warning, char text[WARNING_SENTENCE]);

#endif
