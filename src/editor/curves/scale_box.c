/// The box round the selected knots: its corners and edges are handles that scale them.
#include "editor/core/core.h"
#include "editor/core/picked.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/view.h"
#include "ui/theme.h"
#include <math.h>
#include <stdlib.h>

static const float PAD = 12;   ///< from a knot to the edge: beside what a press on the knot takes
static const float REACH = 7;  ///< of a handle
static const float HANDLE = 6; ///< its size
static const float INSIDE = 4; ///< that the box stays inside of the plot, where handles can be taken
static const float LEAST = 2;  ///< pixels between the outermost knots, below which there is nothing to scale

/// The box as it is drawn, in the visible part of the plot; which ways its knots lie apart.
struct knot_box {
    struct rect area;
    bool wide, high;
};

/// false where fewer than two knots are selected, or none of them is in sight.
static bool find_knot_box(const struct curves *curves, const struct core *core, const struct document *document,
                          struct knot_box *box)
{
    float left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
    int count = 0;
    for (struct knot_place at = PICKED_START; picked_next(core, document, &at); count++) {
        const struct knot *knot = knot_at(document, at);
        const float x = curves_knot_x(curves, core, document, knot);
        const float y = curves_y_of(curves, core, at.spline, knot->value);
        left = fminf(left, x);
        right = fmaxf(right, x);
        top = fminf(top, y);
        bottom = fmaxf(bottom, y);
    }
    if (count < 2) return false;
    const struct rect whole = {left - PAD, top - PAD, right - left + 2 * PAD, bottom - top + 2 * PAD};
    *box = (struct knot_box){rect_intersect(whole, rect_inset(core->layout.plot, INSIDE)), right - left >= LEAST,
                             bottom - top >= LEAST};
    return box->area.w > 0 && box->area.h > 0;
}

/// Where a handle is; false where there is nothing to scale that way.
static bool handle_place(const struct knot_box *box, int handle, float xy[2])
{
    const int column = box_column(handle), row = box_row(handle);
    if (handle == BOX_MIDDLE || (column && !box->wide) || (column && row && !box->high)) return false;
    xy[0] = box->area.x + box->area.w * 0.5f * (float)(column + 1);
    xy[1] = box->area.y + box->area.h * 0.5f * (float)(row + 1);
    return true;
}

bool curves_box_point(const struct curves *curves, const struct core *core, const struct document *document,
                      int column, int row, float xy[2])
{
    struct knot_box box;
    const bool known = abs(column) <= 1 && abs(row) <= 1 && find_knot_box(curves, core, document, &box);
    return known && handle_place(&box, 3 * (row + 1) + column + 1, xy);
}

void scale_box_hover(const struct curves *curves, const struct core *core, const struct document *document, float x,
                     float y, struct hover *hover)
{
    struct knot_box box;
    float best = REACH, xy[2];
    if (!find_knot_box(curves, core, document, &box)) return;
    for (int i = 0; i < BOX_HANDLES; i++) {
        if (!handle_place(&box, i, xy)) continue;
        const float distance = hypotf(x - xy[0], y - xy[1]);
        if (distance > best) continue;
        best = distance;
        *hover = (struct hover){.kind = HOVER_BOX, .spline = core->active, .handle = i};
    }
}

static void show_handle(struct core *core, int handle, const float xy[2])
{
    const bool hot = core->hover.kind == HOVER_BOX && core->hover.handle == handle;
    const float size = hot ? HANDLE + 3 : HANDLE;
    const struct rect r = {roundf(xy[0] - size / 2), roundf(xy[1] - size / 2), size, size};
    drawlist_rounded(&core->list, r, 1.5f, hot ? theme()->playhead : theme()->panel);
    drawlist_rounded_line(&core->list, r, 1.5f, 1, theme_fade(theme()->playhead, hot ? 1 : 0.75f));
}

void scale_box_show(const struct curves *curves, struct core *core, const struct document *document, bool handles)
{
    struct knot_box box;
    if (!find_knot_box(curves, core, document, &box)) return;
    drawlist_rounded_line(&core->list, rect_inset(box.area, -0.5f), 0, 1, theme_fade(theme()->playhead, 0.3f));
    for (int i = 0; i < BOX_HANDLES && handles; i++) {
        float xy[2];
        if (handle_place(&box, i, xy)) show_handle(core, i, xy);
    }
}
