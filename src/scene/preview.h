/// A quick look at a spline while it is edited: a take that is kept up to date and read into the visible part of the curve's rows.
#ifndef SCENE_PREVIEW_H
#define SCENE_PREVIEW_H

#include "scene/storage.h"

struct preview {
    wiggly_take *take; ///< or NULL
    int spline;        ///< whose take it is
    bool is_current;   ///< it matches the document
    int moved;         ///< sample of the knot that last moved, -1: none
};

/// Whether a spline with this description can be a take at all.
bool preview_serves(const wiggly_desc *desc);

/// Moves the take's knots to where the document has them. Sets is_current, which stays false when more than a few knots moved or
/// anything else changed. `desc` is the spline's description.
void preview_update(struct preview *preview, const struct document *document, const wiggly_desc *desc);

/// Reads samples of the take into the curve's rows. false if the take has lost digits; it is then no longer current.
bool preview_show(struct preview *preview, const wiggly_curve *curve, const struct extremes *extremes, int first,
                  int count);

#endif
