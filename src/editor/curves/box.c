/// Box selection: a drag that starts on empty space selects the knots inside.
#include "editor/core/arrange.h"
#include "editor/core/drag.h"
#include "editor/core/picked.h"
#include "editor/core/selection.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/view.h"
#include "ui/theme.h"
#include <math.h>

static struct rect box_rect(const struct drag *drag)
{
    return (struct rect){fminf(drag->start_x, drag->x), fminf(drag->start_y, drag->y), fabsf(drag->x - drag->start_x),
                         fabsf(drag->y - drag->start_y)};
}

/// Selects or deselects what of one spline is in the box.
static void take_inside(const struct curves *curves, struct core *core, const struct document *document, int s)
{
    const struct rect box = box_rect(&core->drag);
    const struct spline *spline = &document->splines[s];
    for (int k = curves_knot_from(curves, core, document, spline, box.x); k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        const float x = curves_knot_x(curves, core, document, knot), y = curves_y_of(curves, core, s, knot->value);
        if (x > box.x + box.w) break;
        if (rect_contains(box, x, y)) selection_set(&core->selection, knot->id, curves->knot_drag.box != BOX_REMOVE);
    }
}

/// Selects what is in the box as it is now.
static void move(void *room, struct core *core, const struct editor_world *world)
{
    const struct curves *curves = room;
    const struct document *document = world->document;
    selection_copy(&core->selection, &curves->before_box);
    if (curves->knot_drag.box == BOX_REPLACE) selection_clear(&core->selection);
    if (curves->knot_drag.in_sheet) {
        sheet_take_inside(curves, core, document, box_rect(&core->drag));
        return;
    }
    if (arrange_seen(core, world)) take_inside(curves, core, document, core->active);
    for (int i = 0; i < curves->cache.other_count; i++) {
        const int other = curves_other(curves, document, i);
        if (other >= 0) take_inside(curves, core, document, other);
    }
}

/// A press that did not move was a click on empty; `keep` false brings the former selection back.
static void end(void *room, struct core *core, const struct editor_world *world, bool keep)
{
    const struct curves *curves = room;
    if (!keep) selection_copy(&core->selection, &curves->before_box);
    if (keep && !core->drag.moved && curves->knot_drag.box == BOX_REPLACE) selection_clear(&core->selection);
    if (keep) picked_settle(core, world);
}

static void show(void *room, struct core *core, const struct editor_world *world)
{
    const struct curves *curves = room;
    const struct rect r = box_rect(&core->drag);
    (void)world;
    if (!core->drag.moved) return;
    const float outline[] = {r.x, r.y, r.x + r.w, r.y, r.x + r.w, r.y + r.h, r.x, r.y + r.h, r.x, r.y};
    uint32_t color = curves->knot_drag.box == BOX_REMOVE ? theme()->error : theme()->playhead;
    struct rect clip = drawlist_push_clip(&core->list, core->layout.curves);
    drawlist_set_clip(&core->list, curves->knot_drag.in_sheet ? core->layout.sheet : core->layout.plot);
    drawlist_rect(&core->list, r, theme_fade(color, 0.08f));
    drawlist_dashed(&core->list, outline, 5, 1, 4, 3, theme_fade(color, 0.7f));
    drawlist_set_clip(&core->list, clip);
}

void box_begin(struct curves *curves, struct core *core, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_ARROW, .move = move, .end = end, .show = show};
    drag_begin(core, &owner, curves, NULL, event);
    curves->knot_drag = (struct knot_drag){0};
    bool removes = event->mods & (MOD_CTRL | MOD_ALT);
    curves->knot_drag.box = removes ? BOX_REMOVE : event->mods & MOD_SHIFT ? BOX_ADD : BOX_REPLACE;
    selection_copy(&curves->before_box, &core->selection);
}
