/// What edits share. Private to src/scene.
#ifndef SCENE_EDITING_H
#define SCENE_EDITING_H

#include "scene/edit.h"

/// The document as it is, for edit_end().
struct document *edit_begin(const struct document *document);

/// Ends an edit that went well so far, or not: where it did not, or where pins and floors cannot be met as it is now, the document becomes
/// what it was. Whether it went well.
bool edit_end(struct document *document, struct document *before, bool good, struct error *error);

/// Whether there is a spline at that index; refuses the edit if not.
bool edit_has_spline(const struct document *document, int spline, struct error *error);

#define EDIT_KIND(kind) (1u << (kind))
#define EDIT_BENT (EDIT_KIND(RIG_TAIL) | EDIT_KIND(RIG_CHAIN)) ///< kinds that have channels
#define EDIT_PINNED (EDIT_BENT | EDIT_KIND(RIG_CHARACTER))     ///< kinds that take pins
#define EDIT_ANY_KIND (EDIT_KIND(RIG_KINDS) - 1)

/// The rig at that index if it is of one of those kinds; NULL refuses the edit.
const struct rig *edit_find_rig(const struct document *document, int rig, unsigned kinds, struct error *error);

/// Puts a changed clone, which is taken over, in the place of a rig, if the document may have it and it differs in more than name and pins.
bool edit_replace_rig(struct document *document, int rig, struct rig *changed, struct error *error);

/// One more channel, which shows.
void edit_append_channel(struct rig *rig, int spline, enum axis axis, enum channel_part of);

#endif
