/// A take of the spline that is edited, kept in step with the document, and read into the curve's rows.
#ifndef SCENE_WINDOW_H
#define SCENE_WINDOW_H

#include "scene/storage.h"

struct window {
    wiggly_take *take; ///< or NULL
    int spline;        ///< whose it is
    bool is_current;   ///< it is as the document says
    int moved;         ///< sample of the knot that moved last, -1: none
};

/// Whether a spline can be a take at all, as far as its description tells.
bool window_serves(const wiggly_desc *desc);

/// Moves the take's knots to where the document has them; is_current tells whether that could be done, by a few that moved in
/// their places. `desc` is the spline's description.
void window_follow(struct window *window, const struct document *document, const wiggly_desc *desc);

/// Reads samples of the take into the curve's rows. false where the take lost digits, and is no longer current.
bool window_show(struct window *window, const wiggly_curve *curve, const struct extremes *extremes, int first,
                 int count);

#endif
