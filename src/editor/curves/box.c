/// Selecting knots by a box that is dragged on empty, shown while it grows.
#include "editor/core/actions.h"
#include "editor/core/arrange.h"
#include "editor/curves/curves.h"
#include "ui/theme.h"
#include <math.h>
#include <string.h>

/// Both have room for the same ids (editor_reserve()), unless memory was short.
static void copy_selection(struct selection *to, const struct selection *from)
{
    unsigned ids = to->capacity < from->capacity ? to->capacity : from->capacity;
    if (ids > 0) memcpy(to->bits, from->bits, ids / 8);
}

void box_begin(struct editor *editor, const struct event *event)
{
    drag_begin(editor, DRAG_BOX, event);
    bool removes = event->mods & (MOD_CTRL | MOD_ALT);
    editor->drag.box = removes ? BOX_REMOVE : event->mods & MOD_SHIFT ? BOX_ADD : BOX_REPLACE;
    copy_selection(&editor->before_box, &editor->selection);
}

static struct rect box_rect(const struct drag *drag)
{
    return (struct rect){fminf(drag->start_x, drag->x), fminf(drag->start_y, drag->y), fabsf(drag->x - drag->start_x),
                         fabsf(drag->y - drag->start_y)};
}

void box_update(struct editor *editor, const struct editor_world *world)
{
    const struct spline *spline = arrange_seen(editor, world);
    const struct rect box = box_rect(&editor->drag);
    for (int k = 0; spline && k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        double frame = document_frame(world->document, document_sample(world->document, knot->frame));
        bool inside = rect_contains(box, curves_x(editor, frame), curves_y(editor, knot->value));
        bool before = selection_has(&editor->before_box, knot->id);
        bool selected = editor->drag.box == BOX_REPLACE ? inside
                        : editor->drag.box == BOX_ADD   ? before || inside
                                                        : before && !inside;
        selection_set(&editor->selection, knot->id, selected);
    }
}

void box_end(struct editor *editor, bool keep)
{
    if (!keep) copy_selection(&editor->selection, &editor->before_box);
    if (keep && !editor->drag.moved && editor->drag.box == BOX_REPLACE) selection_clear(&editor->selection);
}

void box_show(struct editor *editor)
{
    const struct drag *drag = &editor->drag;
    if (drag->kind != DRAG_BOX || !drag->moved) return;
    const struct rect r = box_rect(drag);
    const float outline[] = {r.x, r.y, r.x + r.w, r.y, r.x + r.w, r.y + r.h, r.x, r.y + r.h, r.x, r.y};
    uint32_t color = drag->box == BOX_REMOVE ? theme()->error : theme()->playhead;
    drawlist_rect(&editor->list, r, theme_fade(color, 0.08f));
    drawlist_dashed(&editor->list, outline, 5, 1, 4, 3, theme_fade(color, 0.7f));
}
