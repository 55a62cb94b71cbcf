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
    WARNING_FAR,    ///< the curve swings far beyond its knots
    WARNING_SWING,  ///< it swings more than twice as far as the knots around it
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
    double amount;       ///< swing in heights of the knots, or in how far it may; Hz; periods; degrees out of step
    double limit;        ///< Hz that would be fine; bandwidth as it is
    double remedy;       ///< value of a knot at the place; substeps; bandwidth
    const char *why;     ///< a slope has no effect; which knots are exceeded
    double phase;        ///< Im x of a pose at the place
    double low, high;    ///< limits a little beyond the knots
};

enum { WARNINGS_MAX = 16, WARNING_SENTENCE = 200 };

struct warnings {
    int count;
    struct warning list[WARNINGS_MAX];
};

/// Adds where a solved spline swings far beyond its knots, if it does. Allocates nothing.
void warnings_add_far(const struct document *document, const struct evaluation *evaluation, int of,
                      struct warnings *found);
/// How many times as far as its knots in one solution allow a spline swings at most in another one. 3 times its largest knot beside that, and
/// elsewhere 3 times the next largest, are allowed.
double warning_times_far(const struct document *document, const struct evaluation *before,
                         const struct evaluation *after, int of);
/// And where its poses force the swing.
void warnings_add_forced(const struct document *document, const struct evaluation *evaluation, int of,
                         struct warnings *found);
/// What part of the swing of two poses that force it is left between them.
double warning_swing_left(const struct warning *warning, const struct document *document,
                          const struct evaluation *evaluation);
/// Adds all that is wrong with a solved spline, up to WARNINGS_MAX, spans in the order of time. Allocates nothing.
void warnings_add(const struct document *document, const struct evaluation *evaluation, int of,
                  struct warnings *found);

/// What is wrong, as a sentence.
void warning_say(const struct warning *warning, char text[WARNING_SENTENCE]);

#endif
