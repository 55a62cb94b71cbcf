/// Adds and removes rigs: tails, characters, imported models, chains. Each is one undo step.
#ifndef EDITOR_CORE_RIGS_H
#define EDITOR_CORE_RIGS_H

#include "editor/core/state.h"

/// What new users should drag: the first of these kinds the scene has.
enum lead { LEAD_TAIL, LEAD_CHARACTER, LEAD_CHAIN, LEAD_MODEL, LEAD_MESH, LEAD_NOTHING, LEADS };
enum lead rigs_lead(const struct core *core);
/// Whether an imported character has bones to click. One that could not be read counts.
bool rigs_have_bones(const struct core *core);
bool rigs_have_knots(const struct document *document);

/// Adds a tail beside the other rigs, bent by the active spline or a new one.
void rigs_add_tail(struct core *core);
/// Adds a copy moved by the same splines. An imported character's chains are copied too.
void rigs_copy(struct core *core, int rig);
/// Removes a rig and its chains. Asks whether to delete splines that move nothing else. Splines that follow one of its joints keep their
/// value at the playhead.
void rigs_ask_remove(struct core *core, int rig);

#endif
