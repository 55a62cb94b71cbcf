/// Problems of splines that load and solve.
#ifndef SCENE_WARNINGS_H
#define SCENE_WARNINGS_H

#include "scene/evaluate.h"

/// Why a knot's slope has no effect, as the rest of "the slope has no effect: "; NULL if it has one or if that depends on a track.
const char *knot_idle_slope(const struct document *document, int of, int knot);

/// Whether a spline is pushed only shortly before its knots.
bool spline_winds_up(const struct document *document, int of);

/// Whether calm has an effect: not on a spline that winds up, unless it loops.
bool spline_uses_calm(const struct document *document, int of);

/// Index of the first pose of a spline that is not Wiggly and so has no phases; else -1.
int spline_idle_pose(const struct spline *spline);

enum warning_kind {
    WARNING_FAR,     ///< the curve swings more than twice as far as the knots around it and as its average knot
    WARNING_RATE,    ///< a frequency near half the sample rate
    WARNING_DRIFT,   ///< bandwidth times the periods between two knots
    WARNING_FORCED,  ///< poses that are out of step with the swing between them
    WARNING_SLOPE,   ///< a slope that has no effect
    WARNING_PHASE,   ///< poses of a spline without phases
    WARNING_WIND_UP, ///< a wind-up that has no effect
    WARNING_SUDDEN,  ///< a wind-up of less than two samples
    WARNING_SETTLES, ///< knots of a cubic that settle
};

/// A problem of a spline.
struct warning {
    enum warning_kind kind;
    int spline;
    double frame, value; ///< where it is; not for a rate
    double from, to;     ///< frames of the knots around it
    double amount;       ///< Hz; periods; degrees out of step; samples of a wind-up
    double limit;        ///< the highest good frequency, Hz; the present bandwidth
    double remedy;       ///< that cures it: value of a knot there; substeps; bandwidth; wind-up
    const char *why;     ///< reason that a slope or a wind-up has no effect
    double phase;        ///< Im x of a pose there
    double low, high;    ///< limits a little beyond the knots
};

enum { WARNINGS_MAX = 16, WARNING_SENTENCE = 200 };

struct warnings {
    int count;
    struct warning list[WARNINGS_MAX];
};

/// Adds the place where a solved spline without limits swings furthest beyond its knots, if it does. Allocates nothing.
void warnings_add_far(const struct document *document, const struct evaluation *evaluation, int of,
                      struct warnings *found);
/// Adds the places where its poses are out of step.
void warnings_add_forced(const struct document *document, const struct evaluation *evaluation, int of,
                         struct warnings *found);
/// How much of a far swing, a fast rate or poses out of step is left in a solution; at 1 or less the problem is gone.
double warning_left(const struct warning *warning, const struct document *document,
                    const struct evaluation *evaluation);
/// Adds all problems of a solved spline, up to WARNINGS_MAX, spans in order of time. Allocates nothing.
void warnings_add(const struct document *document, const struct evaluation *evaluation, int of,
                  struct warnings *found);

/// Writes the problem as a sentence.
void warning_say(const struct warning *w, char text[WARNING_SENTENCE]);

#endif
