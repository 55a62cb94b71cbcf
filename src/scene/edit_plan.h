/// The planners behind edit_plan(), one a kind of edit: each checks an edit and adds the changes that make it up, none
/// where nothing would change; false with a sentence where it is not possible. Private to src/scene.
#ifndef SCENE_EDIT_PLAN_H
#define SCENE_EDIT_PLAN_H

#include "scene/change.h"

typedef bool planner(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error);

planner plan_knot_insert, plan_knot_remove, plan_knot_set;
planner plan_parameter, plan_spring;
planner plan_spline_add, plan_spline_copy, plan_spline_remove, plan_spline_move, plan_spline_name, plan_spline_color;
planner plan_document, plan_fps, plan_substeps, plan_range;
planner plan_joints, plan_tail_add, plan_tail_remove, plan_tail_name, plan_channel_add, plan_channel_remove;
planner plan_angles, plan_axis, plan_part, plan_feed, plan_position, plan_length;
planner plan_drive, plan_drive_add, plan_drive_remove;
planner plan_paint_new, plan_dab;

/// Adds one change to a plan. What the change owns is the plan's from here on, and is freed on failure.
bool plan_add(struct change_list *list, const struct change *change, struct error *error);

/// Refuses an edit for want of memory.
bool plan_no_memory(struct error *error);

#endif
