/// The overlay with all keys (F1): as many columns as the window has room for, rows closer together where it is low, and
/// scrolled where that is not enough.
#include "editor/dialogs/state.h"
#include "scene/parameter.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>

enum {
    MAX_COLUMNS = 4,
    COLUMN_LEAST = 270,
    COLUMN_MOST = 320,
    ROW = 20,
    ROW_LEAST = 15,
    HEADER = 22,
    GROUP_GAP = 10,
    TITLE = 78,
    MARGIN = 24,
    KEYS_GAP = 12,
    WHEEL = 48 ///< pixels a notch
};

/// Which groups are in which column, from the top: column c holds groups first[c] … first[c + 1] − 1.
struct flow {
    int columns, first[MAX_COLUMNS + 1];
    float row, height; ///< of a row, of the highest column
};

static int row_count(const struct help_group *group)
{
    int count = 0;
    while (help_row(group, count).keys) count++;
    return count;
}

static float group_height(int group, float row)
{
    return HEADER + row * (float)row_count(&help_groups[group]) + GROUP_GAP;
}

/// Fills column after column up to a height; false where that takes more columns than there are.
static bool fill(struct flow *flow, float limit)
{
    int column = 0;
    float height = 0;
    flow->first[0] = 0;
    for (int g = 0; g < HELP_GROUPS; g++) {
        float more = group_height(g, flow->row);
        if (height > 0 && height + more > limit) {
            if (++column == flow->columns) return false;
            flow->first[column] = g;
            height = 0;
        }
        height += more;
    }
    for (int c = column + 1; c <= flow->columns; c++) flow->first[c] = HELP_GROUPS;
    flow->height = limit - GROUP_GAP;
    return true;
}

/// The lowest columns that hold all groups in their order.
static struct flow flow_of(int columns, float row)
{
    const float step = 4;
    struct flow flow = {.columns = columns, .row = row};
    float limit = 0;
    for (int g = 0; g < HELP_GROUPS; g++) limit += group_height(g, row) / (float)columns;
    limit = ceilf(limit); // whole pixels, so that what just fits does not seem to need scrolling
    while (!fill(&flow, limit)) limit += step;
    return flow;
}

/// How it is laid out in a window, in a box that is as large as it may be.
struct page {
    struct rect box, body;
    struct flow flow;
};

static struct page page_of(struct rect window)
{
    struct page page;
    float room_x = fmaxf(window.w - 32, 1), room_y = fmaxf(window.h - 16, 1);
    int columns = (int)((room_x - MARGIN) / (COLUMN_LEAST + MARGIN));
    columns = columns < 1 ? 1 : columns > MAX_COLUMNS ? MAX_COLUMNS : columns;
    float row = ROW;
    while ((page.flow = flow_of(columns, row)).height + TITLE + MARGIN > room_y && row > ROW_LEAST) row--;
    if (page.flow.height + TITLE + MARGIN > room_y) page.flow = flow_of(columns, ROW);
    float w = fminf(room_x, (float)(columns * (COLUMN_MOST + MARGIN) + MARGIN));
    float h = fminf(room_y, page.flow.height + TITLE + MARGIN);
    page.box = (struct rect){roundf(window.x + (window.w - w) / 2), roundf(window.y + (window.h - h) / 2), w, h};
    page.body = (struct rect){page.box.x, page.box.y + TITLE, w, fmaxf(h - TITLE - MARGIN / 2, 0)};
    return page;
}

/// How far it can be scrolled.
static float range_of(const struct page *page) { return fmaxf(page->flow.height + MARGIN / 2 - page->body.h, 0); }

static float scrolled(const struct page *page, float offset) { return fmaxf(0, fminf(offset, range_of(page))); }

/// Pixels by which a key or the wheel scrolls; 0 for all others.
static float scroll_of(const struct event *event, const struct page *page)
{
    if (range_of(page) <= 0) return 0;
    if (event->kind == EVENT_WHEEL) return -WHEEL * event->dy;
    if (event->kind != EVENT_KEY || event->action == ACTION_RELEASE) return 0;
    switch (event->key) {
    case KEY_UP:
        return -WHEEL;
    case KEY_DOWN:
        return WHEEL;
    case KEY_PAGE_UP:
        return -page->body.h;
    case KEY_PAGE_DOWN:
        return page->body.h;
    default:
        return 0;
    }
}

bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event, bool busy)
{
    bool press = (event->kind == EVENT_KEY || event->kind == EVENT_BUTTON) && event->action == ACTION_PRESS;
    struct help *help = &dialogs->help;
    if (!help->open) {
        bool opens = press && event->kind == EVENT_KEY && event->key == KEY_F1;
        if (opens && !busy) {
            *help = (struct help){.open = true};
            dialogs->welcome = false;
        }
        return opens;
    }
    const struct page page = page_of(core->layout.window);
    float by = scroll_of(event, &page);
    if (by != 0) {
        help->offset = scrolled(&page, help->offset + by);
    } else if (press) {
        help->open = false;
    }
    bool release = event->kind == EVENT_KEY && event->action == ACTION_RELEASE; // of a key that was pressed before
    return !release && (event->kind == EVENT_KEY || event->kind == EVENT_TEXT || event->kind == EVENT_BUTTON ||
                        event->kind == EVENT_WHEEL);
}

static void paint_line(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    float y = ui_baseline(r, font, THEME_TEXT_NORMAL);
    drawlist_text_fit(list, r.x, y, r.w, font, THEME_TEXT_NORMAL, color, text);
}

/// One group at `r`, whose height is that of a row, with its keys in a column `keys` wide; returns the group's height.
static float show_group(struct drawlist *list, struct rect r, float keys, const struct help_group *group)
{
    paint_line(list, (struct rect){r.x, r.y, r.w, HEADER}, FONT_LABEL_BOLD, theme()->accent, group->title);
    float y = r.y + HEADER;
    for (int i = 0; i < row_count(group); i++, y += r.h) {
        struct help_row row = help_row(group, i);
        paint_line(list, (struct rect){r.x, y, keys - KEYS_GAP, r.h}, FONT_LABEL, theme()->text, row.keys);
        struct rect what = {r.x + keys, y, r.w - keys, r.h};
        paint_line(list, what, FONT_LABEL, theme()->text_dim, row.what);
    }
    return y + GROUP_GAP - r.y;
}

static void show_title(struct drawlist *list, const struct page *page)
{
    const char *closing = range_of(page) > 0 ? "↑ ↓ to scroll, any other key to close" : "Press any key to close";
    const struct rect *box = &page->box;
    float left = box->x + MARGIN, width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, closing);
    float right = fmaxf(box->x + box->w - MARGIN - width, left + 90);
    drawlist_text(list, left, box->y + 36, FONT_LABEL_BOLD, THEME_TEXT_TITLE, theme()->text, "wiggly");
    drawlist_text_fit(list, right, box->y + 36, box->x + box->w - right, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text_dim, closing);
    paint_line(
        list, (struct rect){left, box->y + 44, box->w - 2 * MARGIN, ROW}, FONT_LABEL, theme()->text_dim,
        "Curves that hit every knot exactly and still swing, overshoot and follow through like something with mass.");
}

/// Width of the keys in a column, with a gap.
static float keys_width(const struct flow *flow, int column)
{
    float widest = 0;
    for (int g = flow->first[column]; g < flow->first[column + 1]; g++) {
        for (int i = 0; i < row_count(&help_groups[g]); i++) {
            widest = fmaxf(widest, font_width(FONT_LABEL, THEME_TEXT_NORMAL, help_row(&help_groups[g], i).keys));
        }
    }
    return ceilf(widest) + KEYS_GAP;
}

static void show_columns(struct drawlist *list, const struct page *page, float offset)
{
    const struct flow *flow = &page->flow;
    float width = (page->box.w - (float)(MARGIN * (flow->columns + 1))) / (float)flow->columns;
    for (int c = 0; c < flow->columns; c++) {
        struct rect r = {page->box.x + MARGIN + (width + MARGIN) * (float)c, page->body.y - offset, width, flow->row};
        float keys = fminf(keys_width(flow, c), floorf(0.6f * width));
        for (int g = flow->first[c]; g < flow->first[c + 1]; g++) {
            r.y += show_group(list, r, keys, &help_groups[g]);
        }
    }
}

static void show_bar(struct drawlist *list, const struct page *page, float offset)
{
    float range = range_of(page);
    if (range <= 0) return;
    float length = page->body.h * page->body.h / (page->body.h + range);
    float y = page->body.y + (page->body.h - length) * offset / range;
    drawlist_rounded(list, (struct rect){page->box.x + page->box.w - 8, y, 4, length}, 2, theme()->control);
}

void help_show(const struct dialogs *dialogs, struct core *core)
{
    if (!dialogs->help.open) return;
    struct drawlist *list = &core->list;
    const struct page page = page_of(core->layout.window);
    const float offset = scrolled(&page, dialogs->help.offset);
    drawlist_rect(list, core->layout.window, theme()->veil);
    drawlist_rounded(list, page.box, 8, theme()->panel);
    drawlist_rounded_line(list, page.box, 8, 1, theme()->zero);
    show_title(list, &page);
    struct rect clip = drawlist_push_clip(list, page.body);
    show_columns(list, &page, offset);
    drawlist_set_clip(list, clip);
    show_bar(list, &page, offset);
}

const struct help_group help_groups[HELP_GROUPS] = {
    {"Knots",
     {{"Double-click", "insert a knot"},
      {"I, Shift+I", "at playhead (sloped)"},
      {"Del, Backspace", "delete"},
      {"Click, Shift+click", "select, add to it"},
      {"Drag a box", "select its knots"},
      {"Ctrl+A, Ctrl+Shift+A", "all; of all splines"},
      {",  .", "previous, next knot"},
      {"Alt+.  ,  Home, End", "go there"},
      {"<  >", "extend to that one"},
      {"Shift+PgUp, PgDn", "the same"},
      {"Alt+arrows", "nudge (Shift, Ctrl)"},
      {"Ctrl+C, X, V, D", "copy, cut, paste, clone"},
      {"S, Shift+S", "scale; the swing"},
      {"Drag their box", "scale (Alt: the swing)"}}},
    {"While dragging",
     {{"X, Y", "only time, only value"},
      {"R", "move later knots too"},
      {"Shift", "fine"},
      {"Ctrl", "between the frames"},
      {"Esc", "cancel"}}},
    {"Slopes",
     {{"T; Shift+T; Ctrl+T", "on or off; flat; smooth"},
      {"P; Shift+P", "pose; still (a knot)"},
      {"D, E", "turn it down, up"},
      {"Shift+D, Shift+E", "softer, firmer"}}},
    {"Inspector",
     {{"Tab, Shift+Tab", "next, previous field"},
      {"Arrows", "change it (Shift: ×10)"},
      {"Enter, double-click", "type a number"},
      {"Del, right-click", "restore the default"},
      {"Type in a list", "search it"},
      {"A, Shift+Del", "add, remove a rig"}}},
    {"Spline",
     {{"PgUp, PgDn", "previous, next spline"},
      {"F2", "rename it"},
      {"M; Shift+M", "mode; oscillator, filter"},
      {"V", "wiggly, stiff, cubic look"},
      {"Shift+F", "find its frequency"},
      {"W", "fix a warning"}}},
    [HELP_HELD] = {"Hold and press ↑ ↓", {{"L", "lag of the tail"}}},
    {"Playback",
     {{"Space", "play, pause"},
      {"←  →", "step a frame"},
      {"Shift+←, Shift+→", "to the start, the end"},
      {"Drag the ruler", "scrub"},
      {"Shift+drag it", "play a part"},
      {"Ctrl+L", "loop on or off"},
      {"[  ]", "play from, to here"},
      {"Ctrl+Home, End", "the same"},
      {"-  +", "slower, faster (also =)"}}},
    {"Curves",
     {{"Wheel", "zoom"},
      {"Ctrl, Shift+wheel", "zoom time, value"},
      {"Middle drag", "pan (also Space+drag)"},
      {"Ctrl+arrows", "pan"},
      {"Ctrl+=, Ctrl+-", "zoom (or PgUp, PgDn)"},
      {"Home, End", "show all, the selection"},
      {"N", "normalise"},
      {"F3", "dope sheet"},
      {"U", "frames or seconds"},
      {"G", "snap to frames or not"}}},
    {"Stage",
     {{"Drag the tail", "bend it"},
      {"Drag a surface", "pin it (X, Y, Z; Shift)"},
      {"Ctrl+drag a tail", "pin a joint"},
      {"H, Alt+PgUp, PgDn", "pin as it is, its frame"},
      {"Drag a floor's edge", "raise, lower it"},
      {"Drag the body", "tail follows (R records)"},
      {"Ctrl+drag it, Shift+A", "lift it, auto-key"},
      {"Right drag, wheel", "orbit, zoom"},
      {"Ctrl+Shift+arrows", "orbit (PgUp: zoom)"},
      {"Shift+Home", "show everything"},
      {"O, Shift+O; F4", "onion skin, arc; ghost"},
      {"K; J, Shift+J", "paint; chain of bones"}}},
    {"File and window",
     {{"Ctrl+Z, Ctrl+Y", "undo, redo (or Shift+Z)"},
      {"Ctrl+O, N, E", "open, new, export"},
      {"Ctrl+S, Ctrl+Shift+S", "save, save as"},
      {"Ctrl+1 … 9, Ctrl+0", "figures, scenes"},
      {"F6, Shift+F6", "resize the panels"},
      {"Ctrl+Shift+=, -, 0", "larger, smaller, reset"},
      {"F8, Shift+F8", "larger, smaller"},
      {"F5, Tab", "present; panels"},
      {"F10", "light or dark"},
      {"F11, F12", "full screen, screenshot"},
      {"Ctrl+Q", "quit"}}},
};

struct help_row help_row(const struct help_group *group, int index)
{
    for (enum parameter p = 0; group == &help_groups[HELP_HELD] && p < PARAMETER_COUNT; p++) {
        const struct parameter_row *row = &parameter_rows[p];
        if (row->letter && index-- == 0) return (struct help_row){row->letter, row->name};
    }
    return index < HELP_MAX_ROWS ? group->rows[index] : (struct help_row){0};
}
