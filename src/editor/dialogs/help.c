/// The overlay with all keys (F1): as many columns as the window has room for, rows closer together where it is low, and
/// scrolled where that is not enough.
#include "editor/dialogs/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>

enum {
    MAX_COLUMNS = 4,
    COLUMN_LEAST = 340,
    COLUMN_MOST = 400,
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

/// The first command under a heading; they stand together.
static const struct command *first_of(const struct command_list *list, int about)
{
    const struct command *command = list->commands;
    while (command < list->commands + list->count && (int)command->about != about) command++;
    return command;
}

static int row_count(const struct command_list *list, int about)
{
    const struct command *first = first_of(list, about), *command = first;
    while (command < list->commands + list->count && (int)command->about == about) command++;
    return (int)(command - first);
}

static float group_height(const struct command_list *list, int about, float row)
{
    return HEADER + row * (float)row_count(list, about) + GROUP_GAP;
}

/// Fills column after column up to a height; false where that takes more columns than there are.
static bool fill(const struct command_list *list, struct flow *flow, float limit)
{
    int column = 0;
    float height = 0;
    flow->first[0] = 0;
    for (int g = 0; g < ABOUT_COUNT; g++) {
        float more = group_height(list, g, flow->row);
        if (height > 0 && height + more > limit) {
            if (++column == flow->columns) return false;
            flow->first[column] = g;
            height = 0;
        }
        height += more;
    }
    for (int c = column + 1; c <= flow->columns; c++) flow->first[c] = ABOUT_COUNT;
    flow->height = limit - GROUP_GAP;
    return true;
}

/// The lowest columns that hold all groups in their order.
static struct flow flow_of(const struct command_list *list, int columns, float row)
{
    const float step = 4;
    struct flow flow = {.columns = columns, .row = row};
    float limit = 0;
    for (int g = 0; g < ABOUT_COUNT; g++) limit += group_height(list, g, row) / (float)columns;
    limit = ceilf(limit); // whole pixels, so that what just fits does not seem to need scrolling
    while (!fill(list, &flow, limit)) limit += step;
    return flow;
}

/// How it is laid out in a window, in a box that is as large as it may be.
struct page {
    struct rect box, body;
    struct flow flow;
};

static struct page page_of(const struct command_list *list, struct rect window)
{
    struct page page;
    float room_x = fmaxf(window.w - 32, 1), room_y = fmaxf(window.h - 16, 1);
    int columns = (int)((room_x - MARGIN) / (COLUMN_LEAST + MARGIN));
    columns = columns < 1 ? 1 : columns > MAX_COLUMNS ? MAX_COLUMNS : columns;
    float row = ROW;
    while ((page.flow = flow_of(list, columns, row)).height + TITLE + MARGIN > room_y && row > ROW_LEAST) row--;
    if (page.flow.height + TITLE + MARGIN > room_y) page.flow = flow_of(list, columns, ROW);
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

void dialogs_help(struct dialogs *dialogs)
{
    dialogs->help = (struct help){.open = true};
    dialogs->welcome = false;
}

bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event)
{
    bool press = (event->kind == EVENT_KEY || event->kind == EVENT_BUTTON) && event->action == ACTION_PRESS;
    struct help *help = &dialogs->help;
    if (!help->open) return false;
    const struct page page = page_of(&dialogs->commands, core->layout.window);
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
static float show_group(struct drawlist *list, struct rect r, float keys, const struct command_list *commands,
                        int about)
{
    const struct command *command = first_of(commands, about);
    paint_line(list, (struct rect){r.x, r.y, r.w, HEADER}, FONT_LABEL_BOLD, theme()->accent, about_titles[about]);
    float y = r.y + HEADER;
    for (int i = 0; i < row_count(commands, about); i++, y += r.h, command++) {
        char text[COMMAND_KEYS];
        command_keys(command, text);
        paint_line(list, (struct rect){r.x, y, keys - KEYS_GAP, r.h}, FONT_LABEL, theme()->text, text);
        struct rect what = {r.x + keys, y, r.w - keys, r.h};
        paint_line(list, what, FONT_LABEL, theme()->text_dim, command->name);
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
static float keys_width(const struct command_list *list, const struct flow *flow, int column)
{
    float widest = 0;
    for (int i = 0; i < list->count; i++) {
        const int about = (int)list->commands[i].about;
        char text[COMMAND_KEYS];
        if (about < flow->first[column] || about >= flow->first[column + 1]) continue;
        command_keys(&list->commands[i], text);
        widest = fmaxf(widest, font_width(FONT_LABEL, THEME_TEXT_NORMAL, text));
    }
    return ceilf(widest) + KEYS_GAP;
}

static void show_columns(struct drawlist *list, const struct command_list *commands, const struct page *page,
                         float offset)
{
    const struct flow *flow = &page->flow;
    float width = (page->box.w - (float)(MARGIN * (flow->columns + 1))) / (float)flow->columns;
    for (int c = 0; c < flow->columns; c++) {
        struct rect r = {page->box.x + MARGIN + (width + MARGIN) * (float)c, page->body.y - offset, width, flow->row};
        float keys = fminf(keys_width(commands, flow, c), floorf(0.5f * width));
        for (int g = flow->first[c]; g < flow->first[c + 1]; g++) r.y += show_group(list, r, keys, commands, g);
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
    const struct page page = page_of(&dialogs->commands, core->layout.window);
    const float offset = scrolled(&page, dialogs->help.offset);
    drawlist_rect(list, core->layout.window, theme()->veil);
    drawlist_rounded(list, page.box, 8, theme()->panel);
    drawlist_rounded_line(list, page.box, 8, 1, theme()->zero);
    show_title(list, &page);
    struct rect clip = drawlist_push_clip(list, page.body);
    show_columns(list, &dialogs->commands, &page, offset);
    drawlist_set_clip(list, clip);
    show_bar(list, &page, offset);
}
