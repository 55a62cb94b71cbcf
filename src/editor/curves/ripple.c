/// Retiming with ripple: the later knots of the spline move along in time with those that are dragged.
#include "editor/core/actions.h"
#include <assert.h>

bool ripple_moves(const struct drag *drag, const struct knot *knot)
{
    return drag->ripple && knot->frame >= drag->ripple_from;
}

void ripple_toggle(struct editor *editor, const struct editor_world *world)
{
    struct drag *drag = &editor->drag;
    const struct spline *spline = editor_active_spline(editor, world);
    assert(spline && drag->count > 0);
    if (drag->moved) history_restart(world->history, world->document);
    drag->ripple = !drag->ripple;
    drag->ripple_from = drag->originals[0].frame;
    drag->free_frames = 0;
    drag->stale = true;
    drag_collect(editor, spline);
    editor_message(editor, false,
                   drag->ripple ? "Ripple on: later knots move too (R turns it off)."
                                : "Ripple off: later knots stay.");
}

double ripple_least(const struct editor *editor, const struct document *document, const struct spline *spline)
{
    const struct knot *first = &editor->drag.originals[0];
    int sample = document_sample(document, first->frame);
    int before = spline_lower_bound(document, spline, sample) - 1;
    if (!editor->drag.ripple || before < 0) return document->first_frame - first->frame;
    int least = document_sample(document, spline->knots[before].frame) + 1;
    return document_frame(document, least) - document_frame(document, sample);
}

void ripple_stopped(struct editor *editor)
{
    editor_message(editor, false, "The last knot has reached the end of the range. Extend the range to make room.");
}
