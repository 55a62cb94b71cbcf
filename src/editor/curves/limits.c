/// The active spline's limits in the curves panel: dashed lines, which can be dragged.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/show.h"
#include "editor/curves/view.h"
#include "ui/theme.h"
#include <math.h>

static const float REACH = 5; ///< pixels from a line at which it is hit

static enum parameter limit_of(int handle) { return handle ? PARAMETER_HIGH : PARAMETER_LOW; }

void limits_hover(const struct curves *curves, const struct core *core, const struct spline *spline, float y,
                  struct hover *hover)
{
    float best = REACH;
    for (int i = 0; i < 2; i++) {
        double value = spline->parameter[limit_of(i)].value;
        float distance = isfinite(value) ? fabsf(y - curves_y(curves, core, value)) : INFINITY;
        if (distance > best) continue;
        best = distance;
        *hover = (struct hover){.kind = HOVER_LIMIT, .spline = core->active, .handle = i};
    }
}

/// The limit goes where the pointer is; knots stay within.
static void apply(void *room, struct core *core, const struct editor_world *world)
{
    const struct curves *curves = room;
    const struct limit_drag *drag = &curves->limit_drag;
    const struct spline *spline = core_active_spline(core, world);
    double by = -core->drag.moved_y / curves_pixels_per_value(curves, core);
    double value = core_round(drag->value + by, 0.01 / curves_pixels_per_value(curves, core));
    const double other = spline->parameter[limit_of(!drag->handle)].value;
    for (int k = 0; k < spline->knot_count; k++) {
        const double knot = spline->knots[k].value;
        value = drag->handle ? fmax(value, knot) : fmin(value, knot);
    }
    if (drag->handle ? value <= other : value >= other) return; // without knots: they do not pass each other
    struct edit edit = core_parameter_edit(core->active, limit_of(drag->handle), value);
    core_edit(core, world, &edit);
}

void limits_begin_drag(struct curves *curves, struct core *core, const struct editor_world *world, int handle,
                       const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_VERTICAL, .apply = apply};
    const struct spline *spline = core_active_spline(core, world);
    drag_begin(core, &owner, curves, parameter_rows[limit_of(handle)].undo, event);
    core->hover = (struct hover){.kind = HOVER_LIMIT, .spline = core->active, .handle = handle};
    curves->limit_drag = (struct limit_drag){handle, spline->parameter[limit_of(handle)].value};
}

void limits_show(const struct curves *curves, struct core *core, const struct editor_world *world)
{
    const struct spline *spline = arrange_seen(core, world);
    const struct rect *plot = &core->layout.plot;
    if (!spline) return;
    for (int i = 0; i < 2; i++) {
        double value = spline->parameter[limit_of(i)].value;
        if (!isfinite(value)) continue;
        const bool hot = core->hover.kind == HOVER_LIMIT && core->hover.handle == i;
        float y = curves_y(curves, core, value);
        const float line[2][2] = {{plot->x, y}, {plot->x + plot->w, y}};
        drawlist_dashed(&core->list, &line[0][0], 2, hot ? 2 : 1.25f, 10, 6,
                        theme_fade(arrange_color(world->document, core->active), hot ? 1 : 0.6f));
    }
}
