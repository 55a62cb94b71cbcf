/// The brush at work. A stroke is one step of the history.
#ifndef EDITOR_STAGE_BRUSH_H
#define EDITOR_STAGE_BRUSH_H

#include "editor/stage/state.h"

/// Frees its memory.
void brush_free(struct painting *painting);
/// What a stroke that begins with these modifiers does: Shift smooths, Ctrl reverses.
enum brush_mode brush_stroke(const struct brush *brush, unsigned mods);
/// The name of a stroke.
const char *brush_label(enum brush_mode stroke);
/// Handles a press on the stage; true if it began a stroke.
bool brush_press(struct stage *stage, struct core *core, const struct editor_world *world, const struct event *event);
/// Whether a stroke is running.
bool brush_paints(const struct core *core);
/// Ctrl+wheel changes the radius, Shift+wheel the strength; true if it was one of these.
bool brush_wheel(struct core *core, const struct event *event);
/// Finds what is under the pointer once the stage is posed, and what the brush reaches from there.
void brush_pose(struct stage *stage, struct core *core, const struct editor_world *world, bool covered);

/// A dab for what work.reach holds: `flow` is the strength times the time. Its arrays are the brush's own.
struct dab brush_dab(struct painting *painting, const struct paint *paint, const struct figure *figure,
                     int coordinate, float radius, double flow);

/// Draws the ring on the surface; above the legend, what the brush does and what is painted at the pointer.
void brush_show(struct stage *stage, struct core *core, const struct editor_world *world);

#endif
