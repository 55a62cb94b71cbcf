/// The dope sheet (F7): one row per spline between ruler and curves. Its knots are marks you drag in time.
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/curves/state.h"
#include "ui/theme.h"
#include <math.h>

enum { ROW = 16, PAD = 3, MOST_ROWS = 6 }; ///< pixels; padding above and below; more rows scroll

static const float LEAST_PLOT = 90; ///< least height of the curves, in pixels
static const float REACH = 7;       ///< pixels at which a mark is hit

/// Lists the splines of all shown rows; returns how many.
static int list_rows(const struct core *core, int first, int *splines, int most)
{
    int count = 0;
    for (int s = 0; s < core->document->spline_count; s++) {
        if (!spline_list_shows(core, s)) continue;
        if (count >= first && count - first < most) splines[count - first] = s;
        count++;
    }
    return count;
}

void sheet_update(struct curves *curves, struct core *core)
{
    struct dope_sheet *sheet = &curves->sheet;
    const float room = core->layout.curves.h - core->layout.ruler.h - LEAST_PLOT - 2 * PAD;
    const int total = core->curves.sheet ? list_rows(core, 0, NULL, 0) : 0;
    int rows = total < MOST_ROWS ? total : MOST_ROWS;
    if (rows > (int)(room / ROW)) rows = (int)fmaxf(room / ROW, 0);
    if (sheet->active != core->active_id) { // scroll its row into view
        const bool is_shown = spline_list_shows(core, core->active);
        int active = 0;
        for (int s = 0; s < core->active; s++) active += spline_list_shows(core, s);
        if (is_shown && active < sheet->first) sheet->first = active;
        if (is_shown && active >= sheet->first + rows) sheet->first = active - rows + 1;
        sheet->active = core->active_id;
    }
    if (sheet->first > total - rows) sheet->first = total - rows;
    sheet->rows = rows;
    sheet->total = total;
    list_rows(core, sheet->first, sheet->spline, rows);
    const float height = rows > 0 ? (float)(rows * ROW + 2 * PAD) : 0;
    if (core->layout.sheet_height == height) return;
    core->layout.sheet_height = height;
    core_layout(core);
}

static float row_y(const struct core *core, int row)
{
    return core->layout.sheet.y + PAD + ((float)row + 0.5f) * ROW;
}

struct rect sheet_area(const struct core *core)
{
    const struct rect *sheet = &core->layout.sheet, *panel = &core->layout.curves;
    return (struct rect){panel->x, sheet->y, panel->w, sheet->h};
}

struct rect sheet_switch(const struct core *core)
{
    const struct rect corner = ruler_corner(core);
    return (struct rect){corner.x, corner.y, 13, corner.h};
}

struct hover sheet_hover(const struct curves *curves, const struct core *core, float x, float y)
{
    const int row = (int)floorf((y - core->layout.sheet.y - PAD) / ROW);
    const int at = row < 0 ? 0 : row >= curves->sheet.rows ? curves->sheet.rows - 1 : row;
    const int spline = at >= 0 ? curves->sheet.spline[at] : -1;
    const int s = spline < core->document->spline_count ? spline : -1;
    struct hover hover = {.thing = s >= 0 ? &thing_row : NULL, .spline = s};
    if (s < 0 || !rect_contains(core->layout.sheet, x, y)) return hover;
    nearest_knot(curves, core, s, y, x, y, REACH, &hover);
    return hover;
}

/// Beside the marks: activates the spline; a double-click inserts a knot on its curve, a drag starts a box.
static void press_row(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    const bool keeps = event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT);
    const bool inside = rect_contains(core->layout.sheet, event->x, event->y);
    if (!keeps || event->clicks == 2) core_choose(core, hover->spline);
    if (!inside) return;
    if (event->clicks == 2) {
        core_insert_on_curve(core, curves_frame(curves, core, event->x), drag_snaps(core, event->mods),
                             event->mods & MOD_SHIFT);
        return;
    }
    box_begin(curves, core, event);
    curves->knot_drag.in_sheet = true;
}

const struct thing thing_row = {
    .hint = "Click to edit this spline; double-click to insert a knot on its curve; drag to select with a box",
    .place = ON_TIME,
    .press = press_row};

float sheet_row_in(const struct curves *curves, const struct core *core, int spline, struct rect box)
{
    for (int row = 0; row < curves->sheet.rows; row++) {
        const float y = row_y(core, row), half = ROW / 2.0f;
        if (curves->sheet.spline[row] == spline) return y + half > box.y && y - half < box.y + box.h ? y : NAN;
    }
    return NAN;
}

bool sheet_wheel(struct curves *curves, struct core *core, const struct event *event)
{
    struct dope_sheet *sheet = &curves->sheet;
    if (!rect_contains(sheet_area(core), event->x, event->y)) return false;
    if (event->mods || sheet->total <= sheet->rows) return false;
    sheet->first += event->dy > 0 ? -1 : 1;
    if (sheet->first < 0) sheet->first = 0; // sheet_update() bounds the other end
    return true;
}

static bool find_mark(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct curves *curves = room;
    for (int row = 0; row < curves->sheet.rows; row++) {
        if (curves->sheet.spline[row] != target->spline) continue;
        xy[0] = curves_knot_x(curves, core, target->knot);
        xy[1] = row_y(core, row);
        return rect_contains(core->layout.sheet, xy[0], xy[1]);
    }
    return false;
}

/// mark(sway,2): a knot on the dope sheet.
const struct thing thing_mark = {.name = "mark",
                                 .of = OF_KNOT,
                                 .numbers = 1,
                                 .find = find_mark,
                                 .missing = "the dope sheet does not show that knot"};

/// Draws a row: a tint if it is active, a line from first to last mark, the marks, and the name.
static void show_row(const struct curves *curves, struct core *core, int row)
{
    const struct document *document = core->document;
    const int s = curves->sheet.spline[row];
    if (s >= document->spline_count) return; // an undo in this frame removed it
    const struct spline *spline = document->splines[s];
    const struct rect *sheet = &core->layout.sheet, *panel = &core->layout.curves;
    const bool active = s == core->active, hot = core->hover.thing == &thing_row && core->hover.spline == s;
    const float y = row_y(core, row), left = sheet->x + sheet->w + 6;
    const uint32_t color = spline_list_color(document, s);
    const struct rect band = {sheet->x, y - ROW / 2.0f, sheet->w, ROW};
    if (active || hot) drawlist_rect(&core->list, band, theme_fade(theme()->text, active ? 0.07f : 0.035f));
    struct rect clip = drawlist_push_clip(&core->list, *sheet);
    if (spline->knot_count > 1) {
        const float from = curves_knot_x(curves, core, &spline->knots[0]);
        const float to = curves_knot_x(curves, core, &spline->knots[spline->knot_count - 1]);
        drawlist_rect(&core->list, (struct rect){from, roundf(y) - 0.5f, to - from, 1}, theme_fade(color, 0.35f));
    }
    knots_show(curves, core, s, y);
    drawlist_set_clip(&core->list, clip);
    drawlist_text_fit(&core->list, left, roundf(y + 4), panel->x + panel->w - 6 - left,
                      active ? FONT_LABEL_BOLD : FONT_LABEL, THEME_TEXT_SMALL,
                      theme_readable(color, theme()->panel, 4.5f), spline->name);
}

void sheet_show(const struct curves *curves, struct core *core)
{
    const struct rect *area = &core->layout.sheet;
    // The triangle in the ruler's corner points down while the sheet is open.
    const struct rect r = sheet_switch(core);
    const float x = r.x + 8, y = r.y + r.h / 2, a = 3.5f;
    const float right[] = {x - a + 1, y - a, x + a, y, x - a + 1, y + a},
                down[] = {x - a, y - a + 1, x + a, y - a + 1, x, y + a};
    drawlist_convex(&core->list, core->curves.sheet ? down : right, 3,
                    core->hover.thing == &thing_sheet ? theme()->text : theme()->text_dim);
    if (area->h <= 0) return;
    const struct dope_sheet *sheet = &curves->sheet;
    for (int row = 0; row < sheet->rows; row++) show_row(curves, core, row);
    if (sheet->total > sheet->rows) { // more rows lie above or below
        const float track = area->h - 2 * PAD, length = track * (float)sheet->rows / (float)sheet->total;
        const float top = area->y + PAD + track * (float)sheet->first / (float)sheet->total;
        drawlist_rounded(&core->list, (struct rect){area->x - 7, top, 3, length}, 1.5f, theme()->control);
    }
    drawlist_rect(&core->list, (struct rect){area->x, area->y + area->h - 1, area->w, 1}, theme()->border);
}
