/// Sets of ids (selected knots, hidden splines), and the knots an edit moves: the selected ones of shown splines and of the active one.
#ifndef EDITOR_CORE_SELECTION_H
#define EDITOR_CORE_SELECTION_H

#include "editor/core/state.h"

bool selection_has(const struct selection *selection, unsigned id);
void selection_set(struct selection *selection, unsigned id, bool selected);
void selection_clear(struct selection *selection);
/// Removes ids from `id` on, which will be reused.
void selection_drop_from(struct selection *selection, unsigned id);
int selection_count(const struct selection *selection, const struct spline *spline);
/// Index of the spline's only selected knot, or -1.
int selection_single(const struct selection *selection, const struct spline *spline);
void selection_copy(struct selection *to, const struct selection *from);

#define SELECTED_START                                                                                               \
    (struct knot_place) { -1, -1 }

static inline const struct knot *knot_at(const struct document *document, struct knot_place at)
{
    return &document->splines[at.spline]->knots[at.knot];
}

/// Goes to the next selected knot, by spline and sample; false after the last.
bool selected_next(const struct core *core, struct knot_place *at);
int selected_count(const struct core *core);
/// If only another spline's knots are selected, activates that spline.
void selected_settle(struct core *core);

void originals_add(struct originals *originals, int spline, const struct knot *knot);
/// Collects the selected knots in `originals`; `later`: also all knots after each spline's first one.
void core_collect(struct core *core, bool later);

/// Computes an original's new knot.
typedef struct knot knot_rule(const void *how, const struct original *original);

enum room { ROOM_FREE, ROOM_OCCUPIED, ROOM_OUTSIDE };

/// Whether the knots fit where a rule, which keeps or reverses their order, puts them: in range, on different frames, and off other knots.
/// If not, `why` says "a knot would leave the range" or the like. The document must be as when they were collected.
enum room originals_room(const struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);
/// Moves the knots, which must fit. `why` says which one a limit holds, core->error why it failed. Edits.
bool originals_put(struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);

#endif
