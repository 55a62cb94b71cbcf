/// The knots that edits are about: the selected ones of every spline that is shown, and of the active one.
#ifndef EDITOR_CORE_SELECTED_KNOTS_H
#define EDITOR_CORE_SELECTED_KNOTS_H

#include "editor/core/state.h"

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
/// Takes them into `originals`; `later` also takes what comes behind the first one of each spline.
void core_collect(struct core *core, bool later);

/// What becomes of an original.
typedef struct knot knot_rule(const void *how, const struct original *original);

/// Whether knots can go where they are to.
enum room { ROOM_FREE, ROOM_OCCUPIED, ROOM_OUTSIDE };

/// Whether the originals can go where a rule, which keeps or reverses their order, puts them: inside the range, apart, and off the
/// knots that stay. If not, `why` says so: "a knot would leave the range". The document is as it was when they were collected.
enum room originals_room(const struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);
/// An edit: puts them there, for which there must be room. `why` says which one a limit holds; core->error, why it could not be done.
bool originals_put(struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);

#endif
