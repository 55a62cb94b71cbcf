/// Retiming with ripple: the later knots of the spline move along in time with those that are dragged.
#include "editor/curves/ripple.h"
#include "editor/core/core.h"
#include "editor/curves/knot_drag.h"
#include "editor/curves/state.h"
#include <assert.h>

bool ripple_moves(const struct knot_drag *drag, const struct knot *knot)
{
    return drag->ripple && knot->frame >= drag->ripple_from;
}

void ripple_toggle(struct curves *curves, struct core *core, const struct editor_world *world)
{
    struct knot_drag *drag = &curves->knot_drag;
    const struct spline *spline = core_active_spline(core, world);
    assert(spline && core->originals.count > 0);
    if (core->drag.moved) history_restart(world->history, world->document);
    drag->ripple = !drag->ripple;
    drag->ripple_from = core->originals.knot[0].frame;
    drag->free_frames = 0;
    core->drag.stale = true;
    drag_collect(curves, core, spline);
    core_message(core, false,
                 drag->ripple ? "Ripple on: later knots move too (R turns it off)."
                              : "Ripple off: later knots stay.");
}

double ripple_least(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct spline *spline)
{
    const struct knot *first = &core->originals.knot[0];
    int sample = document_sample(document, first->frame);
    int before = spline_lower_bound(document, spline, sample) - 1;
    if (!curves->knot_drag.ripple || before < 0) return document->first_frame - first->frame;
    int least = document_sample(document, spline->knots[before].frame) + 1;
    return document_frame(document, least) - document_frame(document, sample);
}

void ripple_stopped(struct core *core)
{
    core_message(core, false, "The last knot has reached the end of the range. Extend the range to make room.");
}
