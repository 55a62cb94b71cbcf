/// Groups: splines that are solved together, because they drive one pinned rig, or share such a rig's splines.
#ifndef SCENE_PIN_GROUPS_H
#define SCENE_PIN_GROUPS_H

#include "scene/document.h"

/// Writes for each spline the first one of its group; -1: no pin moves it.
void pin_groups_find(const struct document *document, int *group);

/// Splines that cannot be in one group, or in groups that wait for each other: `spline` follows `leader`.
struct pin_cycle {
    int spline, leader;
};

/// Writes all splines into `order`, each after those that it follows, a group's in a row: `tracked` is scene_order()'s. A group also comes
/// after what else moves its rigs, as what they stand on does, where that does not follow it in turn. `placed` has room for one a spline.
/// false with the cycle if there is none.
bool pin_groups_order(const struct document *document, const int *group, const int *tracked, bool *placed, int *order,
                      struct pin_cycle *cycle);

typedef void spline_visitor(int spline, void *context);

/// Visits the splines that move a group's pinned rigs without being of the group; some perhaps more than once.
void pin_groups_visit_bases(const struct document *document, const int *group, int which, spline_visitor *visit,
                            void *context);

#endif
