/// Long documents: what takes longer than a frame has is solved by a thread, and the curves fill in when it is done.
///
/// What is looked at does not wait. While knots are dragged, the window that is shown, the playhead's and the knot's own
/// surroundings are read from a take (wiggly.h) into the rows in the same frame, to 1e-9; the thread's whole solve comes after it,
/// so that the rows end as evaluation_update() leaves them, bit for bit.
#ifndef SCENE_BACKGROUND_H
#define SCENE_BACKGROUND_H

#include "scene/evaluate.h"

/// What is looked at.
struct focus {
    int spline;       ///< the one that is edited; -1: none
    int first, count; ///< samples that are shown
    int at;           ///< sample of the playhead
};

/// Whether solving one of the document's splines takes long enough for a frame to be late.
bool background_serves(const struct document *document);

/// As evaluation_update(), for once a frame, whether something changed or not: solves what is quickly solved and begins the rest,
/// which evaluation->stale tells of. Allocates only with a new document, for the first take and where there are more knots.
/// Where no thread can be had, it is evaluation_update(). Counters are of what became visible.
void background_update(struct evaluation *evaluation, const struct document *document, const bool *dirty, bool cubic,
                       const struct focus *focus);

/// Goes on until no curve is stale and what is looked at is ready to be edited.
void background_settle(struct evaluation *evaluation, const struct document *document, const struct focus *focus);

#endif
