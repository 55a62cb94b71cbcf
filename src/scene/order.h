/// The order in which splines can be solved: each after those that it follows by tracks.
#ifndef SCENE_ORDER_H
#define SCENE_ORDER_H

#include "scene/document.h"

/// What a search needs: `stack` and `next` have one element a spline.
struct order_space {
    int *stack;
    unsigned char *next;
};

/// Where tracks form a cycle: a parameter of a spline follows, in the end, the spline itself.
struct order_cycle {
    int spline;
    enum parameter parameter;
};

/// Writes all splines into `order`, leaders first, in file order where tracks leave it free. All tracks count, also
/// those that the mode ignores, so that a change of mode cannot close a cycle. false with the cycle where there is
/// one.
bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle);

/// The same with memory of its own and no result but the answer; `cycle->spline` is -1 where memory was short.
bool scene_has_order(const struct document *document, struct order_cycle *cycle);

/// Whether a spline has that parameter: of frequency, damping and spring, friction it has one pair.
bool spline_has(const struct spline *spline, enum parameter parameter);

/// Whether the solution of a spline depends on that parameter, as its mode is (or as a cubic).
bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic);

/// Marks the spline and all of the first `count` splines that follow it, directly or not: those that it cannot follow
/// without a cycle. Allocates nothing; of the order of count² steps.
void scene_followers(const struct document *document, int spline, bool *followers, int count);

#endif
