/// Long documents: a thread solves what does not fit into a frame, and the curves fill in when it is done.
///
/// What is on screen does not wait. While knots are dragged, the visible range and the surroundings of the playhead and of the knot
/// are read from a take (wiggly.h) into the rows in the same frame, to 1e-9. The thread's full solve follows, so the rows end up
/// as evaluation_update() leaves them, bit for bit. A take is a chain: with the band there is none, and the curves wait for the solve.
#ifndef SCENE_BACKGROUND_H
#define SCENE_BACKGROUND_H

#include "scene/evaluate.h"

/// What the user is looking at.
struct focus {
    int spline;       ///< the active one; -1: none
    int first, count; ///< visible samples
    int at;           ///< sample of the playhead
};

/// Whether solving one of the document's splines by that method could make a frame late.
bool background_serves(const struct document *document, wiggly_method method);

/// Replaces evaluation_update(); to be called once a frame, whether anything changed or not. Solves what is quick and starts the rest;
/// evaluation->stale says whether some is left. Allocates only for a new document, the first take and added knots. Without a
/// thread it is evaluation_update(). The counters count what became visible.
void background_update(struct evaluation *evaluation, const struct document *document, const bool *dirty, bool cubic,
                       const struct focus *focus);

/// Waits until no curve is stale and the active spline is ready to be edited.
void background_settle(struct evaluation *evaluation, const struct document *document, const struct focus *focus);

#endif
