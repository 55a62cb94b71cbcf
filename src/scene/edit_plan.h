/// The planners behind edit_plan(), one for each kind of edit, under the same contract. Private to src/scene.
#ifndef SCENE_EDIT_PLAN_H
#define SCENE_EDIT_PLAN_H

#include "scene/change.h"

typedef bool planner(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error);

planner plan_knot_insert, plan_knot_remove, plan_knot_set;
planner plan_parameter;
planner plan_spline_add, plan_spline_copy, plan_spline_remove, plan_spline_move, plan_spline_name, plan_spline_color;
planner plan_document, plan_fps, plan_substeps, plan_range;
planner plan_joints, plan_tail_add, plan_rig_remove, plan_rig_name, plan_channel_add, plan_channel_remove;
planner plan_model_add, plan_rig_add, plan_chain_add, plan_clip, plan_place, plan_chain, plan_meadow;
planner plan_angles, plan_axis, plan_part, plan_feed, plan_position, plan_length;
planner plan_drive, plan_drive_add, plan_drive_remove, plan_floor;
planner plan_paint_new, plan_dab;
planner plan_pin_add, plan_pin_set, plan_pin_remove;

/// Adds a change to a plan, which takes over what the change owns, or frees it on failure.
bool plan_add(struct change_list *list, const struct change *change, struct error *error);

/// Whether there is a spline at that index; refuses the edit if not.
bool plan_has_spline(const struct document *document, int spline, struct error *error);

/// Refuses an edit because memory ran out.
bool plan_no_memory(struct error *error);

#endif
