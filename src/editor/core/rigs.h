/// Adds and removes rigs: tails, characters, imported models, chains, a meadow. Each is one undo step.
#ifndef EDITOR_CORE_RIGS_H
#define EDITOR_CORE_RIGS_H

#include "editor/core/state.h"

/// What newcomers are told to drag: the first kind of rig here that the scene has.
enum lead { LEAD_TAIL, LEAD_CHARACTER, LEAD_CHAIN, LEAD_MODEL, LEAD_NOTHING, LEADS };
enum lead rigs_lead(const struct document *document);
/// Whether any spline has a knot that could be dragged.
bool rigs_have_knots(const struct document *document);

/// A tail beside all else, bent by the active spline, or by a new one where there is none.
void rigs_add_tail(struct core *core);
/// A meadow that swings by the active spline; a scene has at most one.
void rigs_add_meadow(struct core *core);
/// One more like it beside all else, moved by the same splines; an imported character brings copies of its chains.
void rigs_copy(struct core *core, int rig);
/// Removes a rig and its chains. Asks whether to remove splines that move nothing else. Splines that follow one of its joints keep the
/// value at the playhead.
void rigs_ask_remove(struct core *core, int rig);

#endif
