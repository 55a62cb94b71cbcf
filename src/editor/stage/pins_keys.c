/// Pins by keyboard: nudged in the plane that faces the eye, and put where a point is.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/stage/overlays.h"
#include "editor/stage/pins.h"
#include "editor/stage/points.h"
#include "editor/stage/stage.h"
#include "editor/stage/strand.h"
#include "model/vector.h"
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

/// The vertex of a character that moves most.
static int liveliest_vertex(const struct character *character)
{
    float most = -1;
    int found = 0;
    for (int i = 0; i < character->vertex_count; i++) {
        float way = 0;
        for (int k = 0; k < character->coordinate_count; k++) {
            const struct coordinate *c = &character->coordinates[k];
            way += glms_vec3_norm2(vec3_from(c->re[i])) + glms_vec3_norm2(vec3_from(c->im[i]));
        }
        if (way > most) found = i;
        most = fmaxf(most, way);
    }
    return found;
}

/// What is meant where nothing is pointed at: the tip of the tail or chain that the active spline moves, else the liveliest vertex of
/// the selected character.
static struct rig_point usual_point(const struct stage *stage, const struct core *core,
                                    const struct editor_world *world)
{
    const int rig = overlay_rig(stage, core, world->document);
    if (rig >= 0) return (struct rig_point){rig, bones_joints(world, rig) - 1};
    const int n = core->characters.character;
    const struct figure *figure = models_figure(world->models, n);
    if (!figure) return (struct rig_point){-1, -1};
    return (struct rig_point){document_find_rig(world->document, RIG_CHARACTER, n),
                              liveliest_vertex(&figure->character)};
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
        hold(core, world, usual_point(stage, core, world));
    }
}
