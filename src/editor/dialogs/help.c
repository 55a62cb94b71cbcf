/// The key overlay (F1): ten commands for the place under the pointer, then all, or those matching the typed text. It uses as many columns
/// as fit and scrolls in low windows.
#include "editor/core/core.h"
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
    HEADER = 22,
    GROUP_GAP = 10,
    TITLE = 66,
    FIELD = 32,
    FIELD_WIDTH = 300,
    HERE = 10, ///< rows about the place under the pointer
    MARGIN = 24,
    KEYS_GAP = 12,
    WHEEL = 48, ///< pixels per notch
    LEAST_NOTE = 120
};

/// Groups per column: column c holds groups first[c] … first[c + 1] − 1.
struct flow {
    int columns, first[MAX_COLUMNS + 1];
    float row, height; ///< height of a row; of the highest column
};

/// The first command under a heading. Commands of one heading are contiguous.
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

/// Fills the columns up to a height; false if there are too few.
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

/// The lowest columns that hold all groups in order.
static struct flow flow_of(const struct command_list *list, int columns, float row)
{
    const float step = 4;
    struct flow flow = {.columns = columns, .row = row};
    float limit = 0;
    for (int g = 0; g < ABOUT_COUNT; g++) limit += group_height(list, g, row) / (float)columns;
    limit = ceilf(limit); // whole pixels, so that a list that just fits does not scroll
    while (!fill(list, &flow, limit)) limit += step;
    return flow;
}

/// The layout for a window.
struct page {
    struct rect box, body;
    struct flow flow;
    float here;   ///< height of the rows for the place under the pointer, with the gap below
    float height; ///< height of the whole content
};

static int grid_rows(int count, int columns) { return (count + columns - 1) / columns; }

static struct page page_of(const struct dialogs *dialogs, const struct commands_found *found, struct rect window)
{
    struct page page;
    const float room_x = fmaxf(window.w - 32, 1), room_y = fmaxf(window.h - 16, 1);
    int columns = (int)((room_x - MARGIN) / (COLUMN_LEAST + MARGIN));
    columns = columns < 1 ? 1 : columns > MAX_COLUMNS ? MAX_COLUMNS : columns;
    page.flow = flow_of(&dialogs->commands, columns, ROW);
    page.here = HEADER + (float)(ROW * grid_rows(HERE, columns)) + 3 * GROUP_GAP;
    page.height = dialogs->help.filter.typed[0] ? (float)(ROW * grid_rows(found->count, columns))
                                                : page.here + page.flow.height;
    const float w = fminf(room_x, (float)(columns * (COLUMN_MOST + MARGIN) + MARGIN));
    const float h = fminf(room_y, page.here + page.flow.height + TITLE + MARGIN);
    page.box = (struct rect){roundf(window.x + (window.w - w) / 2), roundf(window.y + (window.h - h) / 2), w, h};
    page.body = (struct rect){page.box.x, page.box.y + TITLE, w, fmaxf(h - TITLE - MARGIN / 2, 0)};
    return page;
}

/// The largest scroll offset.
static float range_of(const struct page *page) { return fmaxf(page->height + MARGIN / 2 - page->body.h, 0); }

static float scrolled(const struct page *page, float offset) { return fmaxf(0, fminf(offset, range_of(page))); }

/// Pixels scrolled by a key or the wheel; 0 for other events.
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

void dialogs_help(struct dialogs *dialogs, const struct core *core)
{
    static const enum place places[] = {[PANEL_NONE] = ON_STAGE,
                                        [PANEL_STAGE] = ON_STAGE,
                                        [PANEL_CURVES] = ON_CURVES,
                                        [PANEL_INSPECTOR] = ON_INSPECTOR,
                                        [PANEL_STATUS] = ON_TIME};
    const struct thing *thing = core->hover.thing;
    const enum panel panel = core_panel_at(core, core->pointer_x, core->pointer_y);
    const bool open = !dialogs->help.open;
    dialogs->help = (struct help){.open = open, .at = thing && thing->place ? thing->place : places[panel]};
    dialogs->palette.open = false;
    dialogs->welcome &= !open;
}

static void find(const struct dialogs *dialogs, struct commands_found *found)
{
    commands_find(&dialogs->commands, NULL, &dialogs->help.filter, found);
}

bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event)
{
    struct help *help = &dialogs->help;
    if (!help->open || !typing_concerns(event)) return false;
    struct commands_found found;
    find(dialogs, &found);
    const struct page page = page_of(dialogs, &found, core->layout.window);
    const bool press = event->action == ACTION_PRESS;
    const float by = scroll_of(event, &page);
    if (by != 0) {
        help->offset = scrolled(&page, help->offset + by);
    } else if (ui_filter_event(&help->filter, event)) {
        help->offset = 0;
    } else if (press && (event->kind == EVENT_BUTTON || event->key == KEY_ESCAPE || event->key == KEY_ENTER)) {
        help->open = false;
    }
    return true;
}

static void paint_line(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    float y = ui_baseline(r, font, THEME_TEXT_NORMAL);
    drawlist_text_fit(list, r.x, y, r.w, font, THEME_TEXT_NORMAL, color, text);
}

/// `keys`: width of the key column.
static void show_row(struct drawlist *list, struct rect r, float keys, const struct command *command)
{
    char text[COMMAND_KEYS];
    command_keys(command, text);
    paint_line(list, (struct rect){r.x, r.y, keys - KEYS_GAP, r.h}, FONT_LABEL, theme()->text, text);
    paint_line(list, (struct rect){r.x + keys, r.y, r.w - keys, r.h}, FONT_LABEL, theme()->text_dim, command->name);
}

/// Draws a group from `r`, one row high; returns the group's height.
static float show_group(struct drawlist *list, struct rect r, float keys, const struct command_list *commands,
                        int about)
{
    const struct command *command = first_of(commands, about);
    const float top = r.y;
    paint_line(list, (struct rect){r.x, r.y, r.w, HEADER}, FONT_LABEL_BOLD, theme()->accent, about_titles[about]);
    r.y += HEADER;
    for (int i = 0; i < row_count(commands, about); i++, r.y += r.h) show_row(list, r, keys, command++);
    return r.y + GROUP_GAP - top;
}

static void show_title(struct drawlist *list, const struct page *page, const struct help *help)
{
    const struct rect *box = &page->box;
    const float left = box->x + MARGIN, width = fminf(FIELD_WIDTH, box->w / 2 - MARGIN);
    const struct rect field = {box->x + box->w - MARGIN - width, box->y + 18, width, FIELD};
    const float title = ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_TITLE, "Keys")) + MARGIN;
    drawlist_text_fit(list, left, box->y + 40, field.x - left - 8, FONT_LABEL_BOLD, THEME_TEXT_TITLE, theme()->text,
                      "Keys");
    const struct rect rest = {left + title, box->y + 22, field.x - left - title - 8, FIELD - 8};
    if (rest.w >= LEAST_NOTE)
        paint_line(list, rest, FONT_LABEL, theme()->text_dim, "Esc closes. F3 runs any command by its name.");
    commands_show_field(list, field, &help->filter, "Type to search");
}

/// Width of the widest keys with a gap, at most half a column.
static float keys_width(const struct command *const *rows, int count, float column)
{
    float widest = 0;
    for (int i = 0; i < count; i++) {
        char text[COMMAND_KEYS];
        command_keys(rows[i], text);
        widest = fmaxf(widest, font_width(FONT_LABEL, THEME_TEXT_NORMAL, text));
    }
    return fminf(ceilf(widest) + KEYS_GAP, floorf(0.5f * column));
}

static float column_width(const struct page *page)
{
    return (page->box.w - (float)(MARGIN * (page->flow.columns + 1))) / (float)page->flow.columns;
}

/// Draws rows in even columns from `y` on.
static void show_grid(struct drawlist *list, const struct page *page, float y, const struct command *const *rows,
                      int count)
{
    const float width = column_width(page);
    const int high = grid_rows(count, page->flow.columns);
    for (int first = 0, c = 0; first < count; first += high, c++) {
        const int end = first + high < count ? first + high : count;
        const float keys = keys_width(rows + first, end - first, width);
        struct rect r = {page->box.x + MARGIN + (width + MARGIN) * (float)c, y, width, ROW};
        for (int i = first; i < end; i++, r.y += ROW) show_row(list, r, keys, rows[i]);
    }
}

static void show_here(struct drawlist *list, const struct dialogs *dialogs, const struct page *page, float y)
{
    static const struct {
        enum place place;
        const char *title;
    } titles[] = {
        {ON_CURVES, "Over the curves"}, {ON_KNOT, "Over a knot"}, {ON_TIME, "Over the ruler and the status line"},
        {ON_STAGE, "Over the stage"},   {ON_PIN, "Over a pin"},   {ON_INSPECTOR, "In the inspector"}};
    const struct command *rows[HERE];
    int count = 0;
    for (int i = 0; i < dialogs->commands.count && count < HERE; i++) {
        if (dialogs->commands.commands[i].at & dialogs->help.at) rows[count++] = &dialogs->commands.commands[i];
    }
    const struct rect box = {page->box.x + MARGIN / 2, y - GROUP_GAP / 2, page->box.w - MARGIN,
                             page->here - GROUP_GAP};
    drawlist_rounded(list, box, 6, theme()->raised);
    for (size_t i = 0; i < sizeof titles / sizeof titles[0]; i++) {
        const struct rect title = {page->box.x + MARGIN, y, page->box.w - 2 * MARGIN, HEADER};
        if (titles[i].place == dialogs->help.at)
            paint_line(list, title, FONT_LABEL_BOLD, theme()->accent, titles[i].title);
    }
    show_grid(list, page, y + HEADER, rows, count);
}

static void show_columns(struct drawlist *list, const struct command_list *commands, const struct page *page, float y)
{
    const struct flow *flow = &page->flow;
    const float width = column_width(page);
    for (int c = 0; c < flow->columns; c++) {
        const struct command *rows[COMMANDS_MOST];
        int count = 0;
        for (int i = 0; i < commands->count; i++) {
            const int about = (int)commands->commands[i].about;
            if (about >= flow->first[c] && about < flow->first[c + 1]) rows[count++] = &commands->commands[i];
        }
        struct rect r = {page->box.x + MARGIN + (width + MARGIN) * (float)c, y, width, flow->row};
        const float keys = keys_width(rows, count, width);
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

static void show_found(struct drawlist *list, const struct page *page, const struct commands_found *found, float y)
{
    const struct rect r = {page->box.x + MARGIN, y, page->box.w - 2 * MARGIN, ROW};
    show_grid(list, page, y, found->list, found->count);
    if (found->count == 0) paint_line(list, r, FONT_LABEL, theme()->text_dim, "Nothing matches.");
}

void help_show(const struct dialogs *dialogs, struct core *core)
{
    if (!dialogs->help.open) return;
    struct drawlist *list = &core->list;
    struct commands_found found;
    find(dialogs, &found);
    const struct page page = page_of(dialogs, &found, core->layout.window);
    const float offset = scrolled(&page, dialogs->help.offset), y = page.body.y - offset;
    drawlist_rect(list, core->layout.window, theme()->veil);
    drawlist_rounded(list, page.box, 8, theme()->panel);
    drawlist_rounded_line(list, page.box, 8, 1, theme()->zero);
    show_title(list, &page, &dialogs->help);
    struct rect clip = drawlist_push_clip(list, page.body);
    if (dialogs->help.filter.typed[0]) {
        show_found(list, &page, &found, y);
    } else {
        show_here(list, dialogs, &page, y + GROUP_GAP / 2);
        show_columns(list, &dialogs->commands, &page, y + page.here);
    }
    drawlist_set_clip(list, clip);
    show_bar(list, &page, offset);
}
