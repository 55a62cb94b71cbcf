/// The order in which to solve splines: each after those that it follows by tracks.
#ifndef SCENE_ORDER_H
#define SCENE_ORDER_H

#include "scene/document.h"

/// Memory for a search: one element of each for every spline.
struct order_space {
    int *stack;
    unsigned char *next;
};

/// Where tracks form a cycle: this parameter of this spline leads back to the spline.
struct order_cycle {
    int spline;
    enum parameter parameter;
};

/// Writes all splines into `order`, leaders first and otherwise in file order. Tracks that the mode ignores count too, so that a change
/// of mode cannot close a cycle. false with the cycle if there is one.
bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle);

/// Whether there is such an order; allocates what it needs.
bool scene_has_order(const struct document *document, struct order_cycle *cycle);

/// Whether a spline's solution depends on that parameter, in its own mode or as a cubic.
bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic);

/// Marks, of the first `count` splines, this one and all that follow it, directly or not: those that it cannot follow itself.
/// Allocates nothing; takes up to count² steps.
void scene_followers(const struct document *document, int spline, bool *followers, int count);

#endif
