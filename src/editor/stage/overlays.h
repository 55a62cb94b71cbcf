/// What is drawn over the stage: caption, names, onion skin, ghost, motion arc, legend.
#ifndef EDITOR_STAGE_OVERLAYS_H
#define EDITOR_STAGE_OVERLAYS_H

#include "editor/stage/state.h"

/// The tail or chain that the active spline moves, else the first; -1 where there is none to be seen.
int overlay_rig(const struct stage *stage, const struct core *core, const struct document *document);
/// The character that the active spline moves, else that tail or chain, else the first character; -1: nothing.
int overlay_pose_rig(const struct stage *stage, const struct core *core, const struct document *document);
/// Onion skin (O): the outline of the tail or the soft character, or the line of the chain, at the active spline's knots, those
/// nearest to the playhead.
void onion_show(struct stage *stage, struct core *core, const struct editor_world *world);

/// Ghost (F4): the same at the knot that is dragged, or was just nudged, where that is not the
/// pose that is shown.
void ghost_show(struct stage *stage, struct core *core, const struct editor_world *world);

/// What stands for a rig where nothing is pointed at: the tip of the tail or chain that the active spline moves, else the liveliest
/// vertex of the selected character. It may not exist (point_exists()).
struct rig_point overlay_point(struct stage *stage, const struct core *core, const struct editor_world *world);
/// Motion arc (P): where that point goes within two seconds of the playhead, with a mark at each frame.
void trail_show(struct stage *stage, struct core *core, const struct editor_world *world);
/// The same of any point of a rig.
void path_show(struct stage *stage, struct core *core, const struct editor_world *world, enum trail which,
               struct rig_point point);

/// How much of the upper edge of a stage the scene's description takes, pixels; 0 without one.
float caption_height(struct rect place, const struct document *document);
/// The names of tails at their feet, in the colour of the spline that moves them, where there are several.
void names_show(const struct stage *stage, struct core *core, const struct document *document);

/// Where the legend is, when it is shown.
struct rect characters_legend(const struct core *core);
/// Legend of the phase map, and what the two of a pair are.
void characters_show(const struct stage *stage, struct core *core, const struct editor_world *world);

#endif
