/// Helpers of all edits. Private to src/scene.
#ifndef SCENE_EDITING_H
#define SCENE_EDITING_H

#include "scene/edit.h"

/// Ends an edit of a document, of which `before` is a copy; `good` says whether it went well so far. If not, or if pins and floors are not allowed any more, the document is restored.
/// Returns whether it went well.
bool edit_end(struct document *document, struct document *before, bool good, struct error *error);

/// Whether there is a spline at that index; sets an error if not.
bool edit_has_spline(const struct document *document, int spline, struct error *error);

#define EDIT_KIND(kind) (1u << (kind))
#define EDIT_BENT (EDIT_KIND(RIG_TAIL) | EDIT_KIND(RIG_CHAIN)) ///< kinds that have channels
#define EDIT_PINNED (EDIT_BENT | EDIT_KIND(RIG_CHARACTER))     ///< kinds that take pins
#define EDIT_ANY_KIND (EDIT_KIND(RIG_KINDS) - 1)

/// The rig at that index if it is of one of those kinds; NULL and an error if not.
const struct rig *edit_find_rig(const struct document *document, int rig, unsigned kinds, struct error *error);

/// Replaces a rig by a changed clone, and takes the clone over, if the document allows it and it differs in more than name and pins.
bool edit_replace_rig(struct document *document, int rig, struct rig *changed, struct error *error);

/// Appends a visible channel.
void edit_append_channel(struct rig *rig, int spline, enum axis axis, enum channel_part of);

#endif
