/// Sets of ids: selected knots, hidden splines; and the knots that edits are about: the selected ones of every spline that is shown, and of the
/// active one.
#ifndef EDITOR_CORE_SELECTION_H
#define EDITOR_CORE_SELECTION_H

#include "editor/core/state.h"

/// Whether an id is selected.
bool selection_has(const struct selection *selection, unsigned id);
/// Selects or deselects an id.
void selection_set(struct selection *selection, unsigned id, bool selected);
/// Deselects everything.
void selection_clear(struct selection *selection);
/// Forgets the ids from `id` on, which will be given again.
void selection_drop_from(struct selection *selection, unsigned id);
/// How many of a spline's knots are selected.
int selection_count(const struct selection *selection, const struct spline *spline);
/// Index of the only selected knot of the spline, or -1.
int selection_single(const struct selection *selection, const struct spline *spline);
/// Selects the same ids.
void selection_copy(struct selection *to, const struct selection *from);

/// Before the first one.
#define SELECTED_START                                                                                               \
    (struct knot_place) { -1, -1 }

/// The knot at a place.
static inline const struct knot *knot_at(const struct document *document, struct knot_place at)
{
    return &document->splines[at.spline]->knots[at.knot];
}

/// Goes on to the next selected knot, by spline and in each by sample; false behind the last one.
bool selected_next(const struct core *core, struct knot_place *at);
/// How many there are.
int selected_count(const struct core *core);
/// Where none of the active spline's knots is selected, but another's, that spline becomes the active one.
void selected_settle(struct core *core);

/// Adds a knot as it is.
void originals_add(struct originals *originals, int spline, const struct knot *knot);
/// Collects the selected knots in `originals`; with `later` also all knots after the first one of each spline.
void core_collect(struct core *core, bool later);

/// New knot for an original.
typedef struct knot knot_rule(const void *how, const struct original *original);

/// Whether knots can go where they are to.
enum room { ROOM_FREE, ROOM_OCCUPIED, ROOM_OUTSIDE };

/// Whether the originals have room where a rule, which keeps or reverses their order, puts them: inside the range, on different frames, and
/// off the other knots. If not, `why` says so: "a knot would leave the range". The document is as it was when they were collected.
enum room originals_room(const struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);
/// An edit: puts them there, for which there must be room. `why` says which one a limit holds; core->error, why it could not be done.
bool originals_put(struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);

#endif
