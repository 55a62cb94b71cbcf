/// Pins by keyboard: nudged in the plane that faces the eye, and put where a point is.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/stage/overlays.h"
#include "editor/stage/pins.h"
#include "editor/stage/points.h"
#include "editor/stage/stage.h"
#include "editor/stage/strand.h"
#include <math.h>

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

/// Pins a point at the playhead where it is.
static void hold(struct core *core, const struct editor_world *world, struct rig_point point)
{
    float place[3];
    if (!point_exists(world, point)) {
        core_message(core, false, "There is no tail, chain or character to pin.");
        return;
    }
    const double frame = pins_frame_here(core, world->document, point.rig);
    if (!point_place(core, world, point, core_position(world->document, frame), place)) return;
    pins_put_here(core, world, point.rig, point.at, (const double[3]){place[0], place[1], place[2]});
}

void stage_hold_point(struct stage *stage, struct core *core, const struct editor_world *world)
{
    int rig;
    struct hover hover = core->hover;
    if (hover.kind == HOVER_JOINT) hover = strand_end(stage, core, &hover);
    const struct pin *selected = pins_selected(core, world->document, &rig);
    if (hover.kind == HOVER_POINT) {
        hold(core, world, (struct rig_point){hover.rig, hover.joint});
    } else if (selected) {
        const struct pin pin = *selected;
        pins_put_here(core, world, rig, pin.point, pin.to);
    } else {
        hold(core, world, overlay_point(stage, core, world));
    }
}
