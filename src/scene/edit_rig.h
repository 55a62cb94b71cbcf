/// What edits of rigs share. Private to src/scene.
#ifndef SCENE_EDIT_RIG_H
#define SCENE_EDIT_RIG_H

#include "scene/edit_plan.h"

/// A copy of the rig at `index` for the caller to change; NULL with a sentence.
struct rig *plan_rig_begin(const struct document *document, int index, struct error *error);
/// Adds the swap of the rig at `index` with a copy, which the change then owns.
bool plan_rig_finish(int index, struct rig *rig, struct change_list *list, struct error *error);
/// Frees a copy because memory ran out.
bool plan_rig_abandon(struct rig *rig, struct error *error);

/// Whether one more rig fits into the document; and adds it, which the change then owns.
bool plan_rig_fits(const struct document *document, struct error *error);
bool plan_rig_append(struct document *document, struct rig *rig, struct change_list *list, struct error *error);

/// The wanted name, with a number if it is taken; NULL if memory runs out.
char *plan_rig_free_name(const struct document *document, const char *wanted);

/// Appends a channel of the edit's spline, axis and part, with the file format's defaults; false if memory runs out.
bool plan_append_channel(struct rig *rig, const struct edit *edit);

/// Whether a channel of the rig may be so.
bool plan_check_angles(const struct rig *rig, const struct angles *angles, struct error *error);
bool plan_check_axis(enum rig_kind kind, enum axis axis, struct error *error);
bool plan_check_part(enum channel_part part, struct error *error);

#endif
