/// Pins by keyboard: nudged in the plane that faces the eye, and put where a point is.
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/stage/pins.h"
#include "editor/stage/points.h"
#include "editor/stage/stage.h"
#include "editor/stage/strand.h"

static const double NUDGE = 0.01; ///< of the height of what is seen

void stage_nudge_pin(struct stage *stage, struct core *core, const struct editor_world *world, double right,
                     double up)
{
    int rig;
    struct pin_drag plane;
    const struct pin *pin = pins_selected(core, world->document, &rig);
    if (!pin) return;
    pins_take_plane(stage, core, pin->to, &plane);
    const double step = core_round(NUDGE * (double)core->layout.stage.h / plane.pixels_per_metre, 0.01);
    double by[3];
    for (int k = 0; k < 3; k++) by[k] = step * (right * plane.right[k] + up * plane.up[k]);
    pins_nudge(core, world, by);
}

/// Where a selected pin's point is pinned again: at the same place.
static void repeat(struct core *core, const struct editor_world *world)
{
    int rig;
    const struct pin *pin = pins_selected(core, world->document, &rig);
    if (pin) {
        const double to[3] = {pin->to[0], pin->to[1], pin->to[2]};
        pins_put_here(core, world, rig, pin->point, to);
    } else {
        core_message(core, false, "Point at a tail, a chain or a character to pin it where it is.");
    }
}

void stage_hold_point(struct stage *stage, struct core *core, const struct editor_world *world)
{
    struct hover hover = core->hover;
    if (hover.kind == HOVER_JOINT) hover = strand_end(stage, core, &hover);
    if (hover.kind != HOVER_POINT || !pins_hover_exists(world, &hover)) {
        repeat(core, world);
        return;
    }
    float place[3];
    const struct rig_point point = {hover.rig, hover.joint};
    const double frame = pins_frame_here(core, world->document, hover.rig);
    if (!point_place(core, world, point, core_position(world->document, frame), place)) return;
    pins_put_here(core, world, point.rig, point.at, (const double[3]){place[0], place[1], place[2]});
}
