/// The overlay with all keys (F1). The table is the one list of what the live app answers to; the README's is made after it.
#include "editor/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>

enum {
    COLUMNS = 3,
    MAX_ROWS = 10,
    HELP_ROW = 20,
    HELP_LEAST_ROW = 15,
    HELP_TITLE = 84,
    HELP_MARGIN = 24,
    HELP_HEADER = 26,
    GROUP_GAP = 10
};

struct help_row {
    const char *keys, *what;
};

struct help_group {
    int column;
    const char *title;
    struct help_row rows[MAX_ROWS]; ///< up to the first without keys
};

static const struct help_group groups[] = {
    {0,
     "Knots",
     {{"Double-click", "insert a knot"},
      {"I, Shift+I", "at the playhead (sloped)"},
      {"Del, Backspace", "delete"},
      {"Click, Shift+click", "select, add to it"},
      {"Drag a box", "select what is in it"},
      {"Ctrl+A, Esc;  , .", "all, none; previous, next"},
      {"Alt+arrows", "nudge (Shift, Ctrl)"},
      {"Ctrl+C, X, V, D", "copy, cut, paste, double"},
      {"S", "scale, about the middle"}}},
    {0,
     "While dragging",
     {{"X, Y", "only time, only value"},
      {"R", "later knots come along"},
      {"Shift", "fine"},
      {"Ctrl", "between the frames"},
      {"Esc", "take it back"}}},
    {0,
     "Slopes",
     {{"T; Shift+T; Ctrl+T", "on, off; flat; smooth"},
      {"D, E", "turn it down, up"},
      {"Shift+D, Shift+E", "softer, firmer"}}},
    {1,
     "Spline",
     {{"PgUp, PgDn", "previous, next spline"},
      {"F2", "rename it"},
      {"M", "complex, real, cubic"},
      {"V", "wiggly, stiff, cubic look"}}},
    {1,
     "Hold, and press ↑ ↓",
     {{"F", "frequency"}, {"Z", "damping"}, {"B", "bandwidth"}, {"C", "calm"}, {"L", "lag of the tail"}}},
    {1,
     "Playback",
     {{"Space", "play, pause"},
      {"←  →", "step a frame"},
      {"Shift+←, Shift+→", "to the ends"},
      {"Drag the ruler", "scrub"},
      {"Shift+drag it", "play a part"},
      {"Ctrl+L", "loop on, off"},
      {"[  ]", "play from, to here"},
      {"-  =", "slower, faster"}}},
    {1,
     "Curves panel",
     {{"N", "all as high as the active"}, {"U", "frames or seconds"}, {"G", "snap to frames on, off"}}},
    {2,
     "Curves and stage",
     {{"Wheel", "zoom"},
      {"Ctrl, Shift+wheel", "zoom time, value"},
      {"Middle drag", "pan (also Space+drag)"},
      {"Home", "show everything"},
      {"End", "show the selection"},
      {"Drag the tail", "pull it"},
      {"Drag the body", "tail follows (R records)"},
      {"O, P", "onion skin, motion arc"},
      {"Right drag", "turn the camera"}}},
    {2,
     "Inspector",
     {{"Tab, Shift+Tab", "next, previous field"},
      {"Arrows", "change it (Shift: by ten)"},
      {"Enter, double-click", "type a number"},
      {"Right-click", "back to the default"}}},
    {2,
     "File",
     {{"Ctrl+Z, Ctrl+Y", "undo, redo"},
      {"Ctrl+O, Ctrl+N", "open, new"},
      {"Ctrl+S", "save"},
      {"Ctrl+Shift+S", "save as"},
      {"F10, F11, F12", "light, full screen, picture"},
      {"Ctrl+1 … 7", "figures of the paper"},
      {"Ctrl+Q", "quit"}}},
};

bool help_event(struct editor *editor, const struct event *event)
{
    bool press = (event->kind == EVENT_KEY || event->kind == EVENT_BUTTON) && event->action == ACTION_PRESS;
    if (!editor->help.open) {
        bool opens = press && event->kind == EVENT_KEY && event->key == KEY_F1;
        if (opens && !inspector_is_dragging(editor)) editor->help.open = true;
        return opens;
    }
    if (press) editor->help.open = false;
    bool release = event->kind == EVENT_KEY && event->action == ACTION_RELEASE; // of a key that was pressed before
    return !release && (event->kind == EVENT_KEY || event->kind == EVENT_TEXT || event->kind == EVENT_BUTTON ||
                        event->kind == EVENT_WHEEL);
}

static int row_count(const struct help_group *group)
{
    int count = 0;
    while (count < MAX_ROWS && group->rows[count].keys) count++;
    return count;
}

static float column_height(int column, float row)
{
    float height = 0;
    for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++) {
        if (groups[g].column != column) continue;
        height += HELP_HEADER + row * (float)row_count(&groups[g]) + GROUP_GAP;
    }
    return height;
}

/// Height of the box with rows of that height.
static float box_height(float row)
{
    float tallest = 0;
    for (int c = 0; c < COLUMNS; c++) tallest = fmaxf(tallest, column_height(c, row));
    return HELP_TITLE + tallest + HELP_MARGIN - GROUP_GAP;
}

static void paint_line(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    float y = roundf(r.y + (r.h + font_cap_height(font, THEME_TEXT_NORMAL)) / 2);
    drawlist_text_fit(list, r.x, y, r.w, font, THEME_TEXT_NORMAL, color, text);
}

/// One group at `r`, whose height is that of a row; returns the group's height.
static float show_group(struct drawlist *list, struct rect r, const struct help_group *group)
{
    float keys = floorf(r.w * 0.46f);
    paint_line(list, (struct rect){r.x, r.y, r.w, HELP_HEADER}, FONT_LABEL_BOLD, theme()->accent, group->title);
    float y = r.y + HELP_HEADER;
    for (int i = 0; i < row_count(group); i++, y += r.h) {
        paint_line(list, (struct rect){r.x, y, keys - 8, r.h}, FONT_LABEL, theme()->text, group->rows[i].keys);
        struct rect what = {r.x + keys, y, r.w - keys, r.h};
        paint_line(list, what, FONT_LABEL, theme()->text_dim, group->rows[i].what);
    }
    return y + GROUP_GAP - r.y;
}

static void show_title(struct drawlist *list, struct rect box)
{
    static const char closing[] = "Any key closes this";
    float left = box.x + HELP_MARGIN, width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, closing);
    float right = box.x + box.w - HELP_MARGIN - width;
    drawlist_text(list, left, box.y + 36, FONT_LABEL_BOLD, THEME_TEXT_TITLE, theme()->text, "wiggly");
    drawlist_text(list, right, box.y + 36, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim, closing);
    paint_line(
        list, (struct rect){left, box.y + 44, box.w - 2 * HELP_MARGIN, HELP_ROW}, FONT_LABEL, theme()->text_dim,
        "Curves that hit every knot exactly and still swing, overshoot and follow through like something with mass.");
}

void help_show(struct editor *editor)
{
    if (!editor->help.open) return;
    struct drawlist *list = &editor->list;
    struct rect window = editor->layout.window;
    float row = HELP_ROW; /* closer together where the window is low */
    while (row > HELP_LEAST_ROW && box_height(row) > window.h - 16) row--;
    float w = fminf(1008, window.w - 32), h = fminf(box_height(row), window.h - 16);
    struct rect box = {roundf(window.x + (window.w - w) / 2), roundf(window.y + (window.h - h) / 2), w, h};
    drawlist_rect(list, window, theme()->veil);
    drawlist_rounded(list, box, 8, theme()->panel);
    drawlist_rounded_line(list, box, 8, 1, theme()->zero);
    show_title(list, box);
    float column = (box.w - HELP_MARGIN * (COLUMNS + 1)) / COLUMNS;
    for (int c = 0; c < COLUMNS; c++) {
        struct rect r = {box.x + HELP_MARGIN + (column + HELP_MARGIN) * (float)c, box.y + HELP_TITLE, column, row};
        for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++) {
            if (groups[g].column == c) r.y += show_group(list, r, &groups[g]);
        }
    }
}
