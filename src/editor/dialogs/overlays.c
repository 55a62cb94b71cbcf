/// The overlays without questions: the keys (F1), the command palette (F3), the card for new users, and pressed keys for an audience.
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "editor/dialogs/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    PALETTE_WIDTH = 640,
    PALETTE_ROW = 26,
    PALETTE_ROWS = 12,
    PALETTE_FIELD = 34,
    PALETTE_PAD = 12,
    PALETTE_GAP = 16
};

/// How a command matches: by name or by key.
static enum fit fit_of(const struct command *command, const struct ui_filter *filter)
{
    char keys[COMMAND_KEYS];
    const enum fit fit = ui_filter_fit(filter, command->name);
    command_keys(command, keys);
    return fit < FIT_INSIDE && ui_filter_fit(filter, keys) >= FIT_WORD ? FIT_INSIDE : fit;
}

/// Adds the commands of one fit, either those that can run or those that cannot.
static void add_found(const struct command_list *commands, const enum fit *fits, enum fit fit,
                      const char *const *missing, bool lacking, struct commands_found *found)
{
    for (int i = 0; i < commands->count; i++) {
        const struct command *command = &commands->commands[i];
        const char *lacks = missing[command->needs];
        if (fits[i] != fit || (lacks != NULL) != lacking) continue;
        found->missing[found->count] = lacks;
        found->list[found->count++] = command;
    }
}

/// Finds matching commands, those that can run now first. Without `core`: all rows of F1 in table order.
static void commands_find(const struct command_list *commands, const struct core *core,
                          const struct ui_filter *filter, struct commands_found *found)
{
    const char *missing[NEEDS_COUNT];
    enum fit fits[COMMANDS_MOST], best = FIT_NOT;
    for (enum need need = 0; need < NEEDS_COUNT; need++) missing[need] = core ? need_missing(core, need) : NULL;
    for (int i = 0; i < commands->count; i++) {
        const struct command *command = &commands->commands[i];
        const bool listed = command->name && (core ? command_runs(command) : command->about != ABOUT_NOTHING);
        fits[i] = listed ? fit_of(command, filter) : FIT_NOT;
        if (fits[i] > best) best = fits[i];
    }
    found->count = 0;
    for (enum fit fit = FIT_START; fit >= ui_filter_least(best); fit--) {
        add_found(commands, fits, fit, missing, false, found);
        add_found(commands, fits, fit, missing, true, found);
    }
}

/// Draws a text field with its text, or `empty` as a hint.
static void commands_show_field(struct drawlist *list, struct rect r, const struct ui_filter *filter,
                                const char *empty)
{
    const bool typed = filter->typed[0] != '\0';
    const float y = ui_baseline(r, FONT_LABEL, THEME_TEXT_NORMAL);
    const float end = r.x + 10 + font_width(FONT_LABEL, THEME_TEXT_NORMAL, filter->typed);
    drawlist_rounded(list, r, 4, theme()->raised);
    drawlist_rounded_line(list, r, 4, 1.5f, theme()->accent);
    drawlist_text_fit(list, r.x + (typed ? 10 : 14), y, r.w - 20, FONT_LABEL, THEME_TEXT_NORMAL,
                      typed ? theme()->text : theme()->text_dim, typed ? filter->typed : empty);
    drawlist_rect(list, (struct rect){roundf(fminf(end, r.x + r.w - 10)), r.y + 8, 1, r.h - 16}, theme()->accent);
}

void dialogs_palette(struct dialogs *dialogs)
{
    const bool open = !dialogs->palette.open;
    dialogs->palette = (struct palette){.open = open};
    dialogs->help.open = false;
    dialogs->welcome &= !open;
}

const struct command *dialogs_take_command(struct dialogs *dialogs)
{
    const struct command *chosen = dialogs->palette.chosen;
    dialogs->palette.chosen = NULL;
    return chosen;
}

struct sheet {
    struct rect box, field, list;
    int rows; ///< visible
};

static struct sheet sheet_of(struct rect window, int found)
{
    struct sheet sheet;
    const float room = window.h - 32 - PALETTE_FIELD - 3 * PALETTE_PAD;
    sheet.rows = (int)fmaxf(fminf(floorf(room / PALETTE_ROW), PALETTE_ROWS), 1);
    const float w = fminf(PALETTE_WIDTH, window.w - 16), rest = PALETTE_FIELD + 3 * PALETTE_PAD;
    const float top = roundf(window.y + (window.h - rest - (float)(sheet.rows * PALETTE_ROW)) / 3);
    if (found < sheet.rows) sheet.rows = found > 0 ? found : 1; // the field keeps its place
    const float h = rest + (float)(sheet.rows * PALETTE_ROW);
    sheet.box = (struct rect){roundf(window.x + (window.w - w) / 2), top, w, h};
    sheet.field =
        (struct rect){sheet.box.x + PALETTE_PAD, sheet.box.y + PALETTE_PAD, w - 2 * PALETTE_PAD, PALETTE_FIELD};
    sheet.list = (struct rect){sheet.field.x, sheet.field.y + PALETTE_FIELD + PALETTE_PAD, sheet.field.w,
                               (float)(sheet.rows * PALETTE_ROW)};
    return sheet;
}

/// Chooses a row and scrolls to it.
static void choose_row(struct palette *palette, int choice, int count, int rows)
{
    palette->choice = choice >= count ? count - 1 : choice;
    if (palette->choice < 0) palette->choice = 0;
    if (palette->first > palette->choice) palette->first = palette->choice;
    if (palette->first < palette->choice - rows + 1) palette->first = palette->choice - rows + 1;
}

/// The choice stays in sight.
static void scroll_palette(struct palette *palette, int by, int count, int rows)
{
    const int last = count > rows ? count - rows : 0, first = palette->first + by;
    palette->first = first < 0 ? 0 : first > last ? last : first;
    const int choice = palette->choice < palette->first ? palette->first : palette->choice;
    choose_row(palette, choice < palette->first + rows ? choice : palette->first + rows - 1, count, rows);
}

/// Runs the row's command if it can run.
static void take_row(struct palette *palette, const struct commands_found *found)
{
    if (palette->choice >= found->count) return;
    if (!found->missing[palette->choice]) *palette = (struct palette){.chosen = found->list[palette->choice]};
}

static void palette_key(struct palette *palette, const struct commands_found *found, int pressed, int rows)
{
    const int choice = palette->choice, count = found->count;
    if (pressed == KEY_ESCAPE) palette->open = false;
    if (pressed == KEY_UP) choose_row(palette, choice > 0 ? choice - 1 : count - 1, count, rows);
    if (pressed == KEY_DOWN) choose_row(palette, choice + 1 < count ? choice + 1 : 0, count, rows);
    if (pressed == KEY_PAGE_UP) choose_row(palette, choice - rows, count, rows);
    if (pressed == KEY_PAGE_DOWN) choose_row(palette, choice + rows, count, rows);
    if (pressed == KEY_HOME) choose_row(palette, 0, count, rows);
    if (pressed == KEY_END) choose_row(palette, count - 1, count, rows);
    if (pressed == KEY_ENTER) take_row(palette, found);
}

/// Whether an overlay with a text field uses the event: not pointer movements, nor releases of keys pressed before it opened.
static bool typing_concerns(const struct event *event)
{
    const bool release = event->kind == EVENT_KEY && event->action == ACTION_RELEASE;
    return !release && event->kind != EVENT_POINTER && event->kind <= EVENT_WHEEL;
}

bool palette_event(struct dialogs *dialogs, const struct core *core, const struct event *event)
{
    struct palette *palette = &dialogs->palette;
    if (!palette->open || !typing_concerns(event)) return false;
    struct commands_found found;
    commands_find(&dialogs->commands, core, &palette->filter, &found);
    const struct sheet sheet = sheet_of(core->layout.window, found.count);
    if (ui_filter_event(&palette->filter, event)) {
        palette->choice = palette->first = 0;
    } else if (event->kind == EVENT_KEY) {
        palette_key(palette, &found, event->key, sheet.rows);
    } else if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) {
        const int row = palette->first + (int)floorf((event->y - sheet.list.y) / PALETTE_ROW);
        if (!rect_contains(sheet.box, event->x, event->y)) {
            palette->open = false;
        } else if (rect_contains(sheet.list, event->x, event->y) && row < found.count) {
            palette->choice = row;
            take_row(palette, &found);
        }
    } else if (event->kind == EVENT_WHEEL) {
        scroll_palette(palette, (int)lroundf(-3 * event->dy), found.count, sheet.rows);
    }
    return true;
}

static void show_command_text(struct drawlist *list, struct rect r, uint32_t color, const char *text)
{
    drawlist_text_fit(list, r.x, ui_baseline(r, FONT_LABEL, THEME_TEXT_NORMAL), r.w, FONT_LABEL, THEME_TEXT_NORMAL,
                      color, text);
}

static void show_command(struct core *core, struct rect r, const struct commands_found *found, int row, bool chosen)
{
    struct drawlist *list = &core->list;
    const struct command *command = found->list[row];
    const char *missing = found->missing[row];
    char keys[COMMAND_KEYS];
    command_keys(command, keys);
    if (chosen) {
        drawlist_rounded(list, r, 4, theme()->fill);
    } else if (rect_contains(r, core->pointer_x, core->pointer_y)) {
        drawlist_rounded(list, r, 4, theme()->raised);
    }
    const float name = ceilf(ui_text_width(command->name)), right = ceilf(ui_text_width(keys));
    const float from = r.x + 10 + name + PALETTE_GAP, end = r.x + r.w - 10 - (right > 0 ? right + PALETTE_GAP : 0);
    show_command_text(list, (struct rect){r.x + 10, r.y, r.w - 20, r.h}, missing ? theme()->text_dim : theme()->text,
                      command->name);
    show_command_text(list, (struct rect){r.x + r.w - 10 - right, r.y, right + 1, r.h}, theme()->text_dim, keys);
    if (missing && end - from > 40) {
        const float width = fminf(ceilf(ui_text_width(missing)), end - from);
        show_command_text(list, (struct rect){end - width, r.y, width + 1, r.h}, theme()->text_dim, missing);
    }
}

void palette_show(const struct dialogs *dialogs, struct core *core)
{
    const struct palette *palette = &dialogs->palette;
    struct drawlist *list = &core->list;
    if (!palette->open) return;
    struct commands_found found;
    commands_find(&dialogs->commands, core, &palette->filter, &found);
    const struct sheet sheet = sheet_of(core->layout.window, found.count);
    drawlist_rect(list, core->layout.window, theme()->veil);
    drawlist_rounded(list, sheet.box, 8, theme()->panel);
    drawlist_rounded_line(list, sheet.box, 8, 1, theme()->zero);
    commands_show_field(list, sheet.field, &palette->filter, "Type what you want to do");
    struct rect row = {sheet.list.x, sheet.list.y, sheet.list.w, PALETTE_ROW};
    for (int i = palette->first; i < found.count && i < palette->first + sheet.rows; i++, row.y += PALETTE_ROW)
        show_command(core, row, &found, i, i == palette->choice);
    if (found.count == 0)
        show_command_text(list, (struct rect){row.x + 10, row.y, row.w - 20, PALETTE_ROW}, theme()->text_dim,
                          "No command matches. Esc closes.");
}

enum {
    MAX_COLUMNS = 4,
    COLUMN_LEAST = 340,
    COLUMN_MOST = 400,
    ROW = 20,
    HEADER = 22,
    GROUP_GAP = 10,
    HELP_TITLE = 66,
    FIELD = 32,
    FIELD_WIDTH = 300,
    HERE = 10, ///< rows about the place under the pointer
    HELP_MARGIN = 24,
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
static bool fill_columns(const struct command_list *list, struct flow *flow, float limit)
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
    while (!fill_columns(list, &flow, limit)) limit += step;
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
    int columns = (int)((room_x - HELP_MARGIN) / (COLUMN_LEAST + HELP_MARGIN));
    columns = columns < 1 ? 1 : columns > MAX_COLUMNS ? MAX_COLUMNS : columns;
    page.flow = flow_of(&dialogs->commands, columns, ROW);
    page.here = HEADER + (float)(ROW * grid_rows(HERE, columns)) + 3 * GROUP_GAP;
    page.height = dialogs->help.filter.typed[0] ? (float)(ROW * grid_rows(found->count, columns))
                                                : page.here + page.flow.height;
    const float w = fminf(room_x, (float)(columns * (COLUMN_MOST + HELP_MARGIN) + HELP_MARGIN));
    const float h = fminf(room_y, page.here + page.flow.height + HELP_TITLE + HELP_MARGIN);
    page.box = (struct rect){roundf(window.x + (window.w - w) / 2), roundf(window.y + (window.h - h) / 2), w, h};
    page.body = (struct rect){page.box.x, page.box.y + HELP_TITLE, w, fmaxf(h - HELP_TITLE - HELP_MARGIN / 2, 0)};
    return page;
}

/// The largest scroll offset.
static float range_of(const struct page *page) { return fmaxf(page->height + HELP_MARGIN / 2 - page->body.h, 0); }

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

static void find_listed(const struct dialogs *dialogs, struct commands_found *found)
{
    commands_find(&dialogs->commands, NULL, &dialogs->help.filter, found);
}

bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event)
{
    struct help *help = &dialogs->help;
    if (!help->open || !typing_concerns(event)) return false;
    struct commands_found found;
    find_listed(dialogs, &found);
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
    const float left = box->x + HELP_MARGIN, width = fminf(FIELD_WIDTH, box->w / 2 - HELP_MARGIN);
    const struct rect field = {box->x + box->w - HELP_MARGIN - width, box->y + 18, width, FIELD};
    const float title = ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_TITLE, "Keys")) + HELP_MARGIN;
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
    return (page->box.w - (float)(HELP_MARGIN * (page->flow.columns + 1))) / (float)page->flow.columns;
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
        struct rect r = {page->box.x + HELP_MARGIN + (width + HELP_MARGIN) * (float)c, y, width, ROW};
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
    const struct rect box = {page->box.x + HELP_MARGIN / 2, y - GROUP_GAP / 2, page->box.w - HELP_MARGIN,
                             page->here - GROUP_GAP};
    drawlist_rounded(list, box, 6, theme()->raised);
    for (size_t i = 0; i < sizeof titles / sizeof titles[0]; i++) {
        const struct rect title = {page->box.x + HELP_MARGIN, y, page->box.w - 2 * HELP_MARGIN, HEADER};
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
        struct rect r = {page->box.x + HELP_MARGIN + (width + HELP_MARGIN) * (float)c, y, width, flow->row};
        const float keys = keys_width(rows, count, width);
        for (int g = flow->first[c]; g < flow->first[c + 1]; g++) r.y += show_group(list, r, keys, commands, g);
    }
}

void help_show(const struct dialogs *dialogs, struct core *core)
{
    if (!dialogs->help.open) return;
    struct drawlist *list = &core->list;
    struct commands_found found;
    find_listed(dialogs, &found);
    const struct page page = page_of(dialogs, &found, core->layout.window);
    const float offset = scrolled(&page, dialogs->help.offset), y = page.body.y - offset;
    drawlist_rect(list, core->layout.window, theme()->veil);
    drawlist_rounded(list, page.box, 8, theme()->panel);
    drawlist_rounded_line(list, page.box, 8, 1, theme()->zero);
    show_title(list, &page, &dialogs->help);
    struct rect clip = drawlist_push_clip(list, page.body);
    if (dialogs->help.filter.typed[0]) {
        const struct rect r = {page.box.x + HELP_MARGIN, y, page.box.w - 2 * HELP_MARGIN, ROW};
        show_grid(list, &page, y, found.list, found.count);
        if (found.count == 0) paint_line(list, r, FONT_LABEL, theme()->text_dim, "Nothing matches.");
    } else {
        show_here(list, dialogs, &page, y + GROUP_GAP / 2);
        show_columns(list, &dialogs->commands, &page, y + page.here);
    }
    drawlist_set_clip(list, clip);
    const float range = range_of(&page), high = page.body.h;
    if (range <= 0) return;
    const float length = high * high / (high + range);
    const struct rect bar = {page.box.x + page.box.w - 8, page.body.y + (high - length) * offset / range, 4, length};
    drawlist_rounded(list, bar, 2, theme()->control);
}

enum { CARD_MARGIN = 16, CARD_PAD = 14, CARD_LINE = 20, CARD_GAP = 16, BAND_MARGIN = 6, CARD_TITLE = 40 };

/// Hints per card; least stage width for a card beside tails; least stage height for two hints in the band.
enum { HINTS = 4, WIDE = 900, TALL = 250 };

/// Hints by the kind of the scene's first rig. An empty row shows a hint about knots.
static const struct hint {
    const char *what, *why;
} hints[LEADS][HINTS] = {
    [LEAD_TAIL] = {{"Drag the fox", "its tail swings after it"},
                   {"Pull the tail", "it is held where you let go"},
                   {0},
                   {"Drop a .glb", "your own: click a bone, Shift+J"}},
    [LEAD_CHARACTER] = {{"Drag the character", "pins the point you hold"},
                        {0},
                        {"Hold F, press ↑", "it swings faster"},
                        {"Drop a .glb", "your own: click a bone, Shift+J"}},
    [LEAD_CHAIN] = {{"Pull a chain", "it is held where you let go"},
                    {0},
                    {"Click a bone", "Shift+J makes another chain of it"},
                    {"Press Ctrl+E", "a .glb with the new motion"}},
    [LEAD_MODEL] = {{"Click a bone", "the first of its tail, say"},
                    {"Press Shift+J", "it follows through on the clip"},
                    {"Pull the tail", "it is held where you let go"},
                    {"Press Ctrl+E", "a .glb with the new motion"}},
    [LEAD_MESH] = {{"Drag on empty", "goes round it; the wheel zooms"},
                   {"Press A", "adds a tail or a character"},
                   {"Press Ctrl+E", "a film, or files for Blender"},
                   {"Drop a .glb", "with bones: click one, Shift+J"}},
    [LEAD_NOTHING] = {{"Double-click", "adds a knot to a curve"},
                      {"Drag a knot", "the curve hits it, and swings"},
                      {"Press A", "adds a tail or a character"},
                      {"Drop a .glb", "your own: click a bone, Shift+J"}},
};

static const struct hint knot_hints[] = {{"Double-click", "adds a knot to a curve"},
                                         {"Drag a knot", "the curve hits it, and swings"}};

static const struct hint *hint_of(const struct core *core, int row)
{
    const struct hint *hint = &hints[rigs_lead(core)][row];
    return hint->what ? hint : &knot_hints[rigs_have_knots(core->document)];
}

static const char closing[] = "Got it", more[] = "F1 shows all keys";

void dialogs_welcome(struct dialogs *dialogs) { dialogs->welcome = true; }

bool dialogs_is_welcoming(const struct dialogs *dialogs) { return dialogs->welcome; }

static float width_of(enum font font, const char *text) { return font_width(font, THEME_TEXT_NORMAL, text); }

/// Two columns; each reason below its action; or only the first hints in a band at the top.
enum form { FORM_WIDE, FORM_UPRIGHT, FORM_BAND };

struct card {
    enum form form;
    struct rect rect;
    float before; ///< left edge of the reasons
    int hints;
};

/// Widths of the widest action and the widest reason.
static void measure(const struct core *core, int count, float *what, float *why)
{
    *what = *why = 0;
    for (int i = 0; i < count; i++) {
        const struct hint *hint = hint_of(core, i);
        *what = fmaxf(*what, ceilf(width_of(FONT_LABEL_BOLD, hint->what)));
        *why = fmaxf(*why, ceilf(width_of(FONT_LABEL, hint->why)));
    }
}

static struct card corner_card(const struct core *core, enum form form, bool right)
{
    const struct rect *stage = &core->layout.stage;
    struct card card = {.form = form, .hints = HINTS};
    float what, why;
    measure(core, HINTS, &what, &why);
    card.before = form == FORM_WIDE ? what + CARD_GAP : 0;
    const float closes = width_of(FONT_LABEL, more) + CARD_GAP + width_of(FONT_LABEL_BOLD, closing);
    const float width = 2 * CARD_PAD + ceilf(fmaxf(fmaxf(card.before + why, what), closes));
    const float height = 2 * CARD_PAD + (HINTS * (form == FORM_WIDE ? 1 : 2) + 1) * CARD_LINE + 2;
    card.rect = (struct rect){right ? stage->x + stage->w - CARD_MARGIN - width : stage->x + CARD_MARGIN,
                              stage->y + stage->h - CARD_MARGIN - height, width, height};
    return card;
}

/// Hints in a band at the top, in place of the description. The camera keeps that height free.
static struct card band_card(const struct core *core, int count)
{
    const struct rect *stage = &core->layout.stage;
    struct card card = {.form = FORM_BAND, .hints = count};
    float what, why;
    measure(core, card.hints, &what, &why);
    card.before = what + CARD_GAP;
    const float closes = width_of(card.hints > 1 ? FONT_LABEL : FONT_LABEL_BOLD, card.hints > 1 ? more : closing);
    card.rect = (struct rect){stage->x + BAND_MARGIN, stage->y + BAND_MARGIN,
                              2 * CARD_PAD + card.before + why + 2 * CARD_GAP + ceilf(closes),
                              CARD_PAD + (float)card.hints * CARD_LINE};
    return card;
}

/// Tails swing across a wide stage, but high above its corners.
static struct card place_card(const struct core *core, struct rect figure)
{
    static const struct {
        enum form form;
        bool right;
    } places[] = {{FORM_WIDE, false}, {FORM_UPRIGHT, false}, {FORM_UPRIGHT, true}, {FORM_WIDE, true}};
    const bool legend = core->characters.mapped || core->brush.on; // the phase map's legend is at the left
    const bool roomy = core->layout.stage.w >= WIDE && rigs_lead(core) != LEAD_CHARACTER;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const struct card card = corner_card(core, places[i].form, places[i].right);
        if (legend && !places[i].right) continue;
        const struct rect *r = &card.rect;
        const bool beside = r->x + r->w <= figure.x || r->x >= figure.x + figure.w || figure.w == 0;
        const bool below = r->y >= core->layout.stage.y + CARD_TITLE; // the description's title
        if (roomy || (beside && below)) return card;
    }
    const struct card band = band_card(core, core->layout.stage.h < TALL || !core->document->about ? 1 : 2);
    return band.rect.w <= core->layout.stage.w ? band : band_card(core, 1);
}

bool welcome_event(struct dialogs *dialogs, const struct event *event)
{
    if (!dialogs->welcome || event->action != ACTION_PRESS) return false;
    bool escape = event->kind == EVENT_KEY && event->key == KEY_ESCAPE;
    bool click = event->kind == EVENT_BUTTON && rect_contains(dialogs->card, event->x, event->y);
    if (escape || click) dialogs->welcome = false;
    return escape || click;
}

static void show_text(struct core *core, float x, float y, enum font font, uint32_t color, const char *text)
{
    drawlist_text(&core->list, x, y, font, THEME_TEXT_NORMAL, color, text);
}

static void show_right(struct core *core, const struct card *card, float y, enum font font, uint32_t color,
                       const char *text)
{
    show_text(core, card->rect.x + card->rect.w - CARD_PAD - width_of(font, text), y, font, color, text);
}

void dialogs_show_welcome(struct dialogs *dialogs, struct core *core, struct rect figure)
{
    if (!history_is_saved(core->history)) dialogs->welcome = false;
    if (!dialogs->welcome) return;
    const struct card card = place_card(core, figure);
    dialogs->card = (struct rect){0};
    if (card.rect.w > core->layout.stage.w) return;
    struct drawlist *list = &core->list;
    struct rect clip = drawlist_push_clip(list, core->layout.stage);
    drawlist_rounded(list, card.rect, 8, theme()->panel);
    drawlist_rounded_line(list, card.rect, 8, 1, theme()->zero);
    const float left = card.rect.x + CARD_PAD;
    float y = card.rect.y + (card.form == FORM_BAND ? CARD_PAD / 2 : CARD_PAD) + 12;
    for (int i = 0; i < card.hints; i++, y += CARD_LINE) {
        const struct hint *hint = hint_of(core, i);
        show_text(core, left, y, FONT_LABEL_BOLD, theme()->text, hint->what);
        if (card.form == FORM_UPRIGHT) y += CARD_LINE;
        show_text(core, left + card.before, y, FONT_LABEL, theme()->text_dim, hint->why);
    }

    // How to close the card: below the hints, or behind them in the band.
    if (card.form != FORM_BAND) {
        y += 4;
        show_text(core, left, y, FONT_LABEL, theme()->text_dim, more);
    } else {
        y -= CARD_LINE;
        if (card.hints > 1) show_right(core, &card, y - CARD_LINE, FONT_LABEL, theme()->text_dim, more);
    }
    show_right(core, &card, y, FONT_LABEL_BOLD, theme()->accent, closing);
    drawlist_set_clip(list, clip);
    dialogs->card = card.rect;
}

static const double PRESSED_HOLD = 1.4, PRESSED_FADE = 0.35; ///< seconds after the release
static const double GLIDE = 0.08;                            ///< seconds that the demo's pointer lags
static const float DRAG_FROM = 3;                            ///< logical pixels; shorter movements are clicks
enum { PILL_HEIGHT = 36, PILL_PAD = 18, PILL_MARGIN = 14, PILL_GAP = 8 };

/// Shows a word after its modifiers. Repeats are counted.
static void tell_pressed(struct pressed *pressed, unsigned mods, const char *word, bool counts)
{
    char text[sizeof pressed->text];
    if (!word) return;
    snprintf(text, sizeof text, "%s%s%s%s", mods & MOD_CTRL ? "Ctrl + " : "", mods & MOD_SHIFT ? "Shift + " : "",
             mods & MOD_ALT ? "Alt + " : "", word);
    const bool again = counts && pressed->seconds > 0 && strcmp(text, pressed->text) == 0;
    pressed->times = again ? pressed->times + 1 : 1;
    pressed->seconds = PRESSED_HOLD + PRESSED_FADE;
    memcpy(pressed->text, text, sizeof text);
}

void dialogs_note(struct dialogs *dialogs, const struct event *event)
{
    static const char *const clicks[] = {
        [BUTTON_LEFT] = "click", [BUTTON_RIGHT] = "right-click", [BUTTON_MIDDLE] = "middle click"};
    static const char *const drags[] = {
        [BUTTON_LEFT] = "drag", [BUTTON_RIGHT] = "right drag", [BUTTON_MIDDLE] = "middle drag"};
    struct pressed *pressed = &dialogs->pressed;
    if (event->kind == EVENT_KEY && event->action != ACTION_RELEASE)
        tell_pressed(pressed, event->mods, command_key_name(event->key), true);
    if (event->kind == EVENT_WHEEL) tell_pressed(pressed, event->mods, "wheel", false);
    if (event->kind == EVENT_BUTTON) {
        pressed->is_down = event->action == ACTION_PRESS;
        pressed->is_drag = false;
    }
    if (event->kind == EVENT_BUTTON && pressed->is_down) {
        pressed->button = event->button;
        pressed->x = event->x;
        pressed->y = event->y;
        tell_pressed(pressed, event->mods, event->clicks == 2 ? "double-click" : clicks[event->button], true);
    }
    if (event->kind == EVENT_POINTER && pressed->is_down && !pressed->is_drag) {
        pressed->is_drag = maths_hypotf(event->x - pressed->x, event->y - pressed->y) > DRAG_FROM;
        if (pressed->is_drag) tell_pressed(pressed, event->mods, drags[pressed->button], false);
    }
    if (event->kind == EVENT_CAPTION) {
        pressed->is_demo = true;
        snprintf(dialogs->caption, sizeof dialogs->caption, "%s", event->text);
    }
}

void dialogs_advance(struct dialogs *dialogs, const struct core *core, double dt)
{
    const float share = (float)(1 - maths_exp(-dt / GLIDE));
    struct pressed *pressed = &dialogs->pressed;
    pressed->pointer[0] += share * (core->pointer_x - pressed->pointer[0]);
    pressed->pointer[1] += share * (core->pointer_y - pressed->pointer[1]);
    if (!pressed->is_down) pressed->seconds = fmax(pressed->seconds - dt, 0);
}

static bool shows_input(const struct dialogs *dialogs, const struct core *core)
{
    return core->presenter.on || dialogs->pressed.is_demo;
}

bool dialogs_want_frames(const struct dialogs *dialogs, const struct core *core)
{
    return shows_input(dialogs, core) && dialogs->pressed.seconds > 0;
}

/// A pill centred in the free part of the stage.
static void show_pill(struct core *core, float bottom, const char *text, float alpha, uint32_t color)
{
    const struct rect open = core->layout.open;
    const float most = fmaxf(open.w - 2 * PILL_MARGIN, 2 * PILL_PAD);
    const float w = fminf(ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_TITLE, text)) + 2 * PILL_PAD, most);
    const struct rect pill = {roundf(open.x + (open.w - w) / 2), roundf(bottom - PILL_HEIGHT), w, PILL_HEIGHT};
    const float y = roundf(pill.y + (PILL_HEIGHT + font_cap_height(FONT_LABEL_BOLD, THEME_TEXT_TITLE)) / 2);
    drawlist_rounded(&core->list, pill, PILL_HEIGHT / 2.0f, theme_fade(theme()->panel, 0.92f * alpha));
    drawlist_rounded_line(&core->list, pill, PILL_HEIGHT / 2.0f, 1, theme_fade(theme()->control, alpha));
    drawlist_text_fit(&core->list, pill.x + PILL_PAD, y, w - 2 * PILL_PAD + 1, FONT_LABEL_BOLD, THEME_TEXT_TITLE,
                      theme_fade(color, alpha), text);
}

void dialogs_show_input(const struct dialogs *dialogs, struct core *core)
{
    const struct pressed *pressed = &dialogs->pressed;
    const struct message *message = &core->message;
    float bottom = core->layout.open.y + core->layout.open.h - PILL_MARGIN;
    char text[sizeof pressed->text + 16];
    if (!shows_input(dialogs, core)) return;
    if (dialogs->caption[0]) {
        show_pill(core, bottom, dialogs->caption, 1, theme()->text);
        bottom -= PILL_HEIGHT + PILL_GAP;
    }
    if (pressed->seconds > 0) {
        snprintf(text, sizeof text, pressed->times > 1 ? "%s ×%d" : "%s", pressed->text, pressed->times);
        show_pill(core, bottom, text, (float)fmin(pressed->seconds / PRESSED_FADE, 1), theme()->accent);
        bottom -= PILL_HEIGHT + PILL_GAP;
    }
    if (message->text[0] && core->presenter.on && core->presenter.below == 0) // the status line is hidden
        show_pill(core, bottom, message->text, 1, message->is_error ? theme()->error : theme()->text);
    if (!pressed->is_demo) return;
    const float x = pressed->pointer[0], y = pressed->pointer[1]; // ringed while a button is down
    const float arrow[8] = {x, y, x, y + 17, x + 12, y + 12, x, y};
    if (pressed->is_down) drawlist_circle(&core->list, pressed->pointer, 12, 2, theme()->accent);
    drawlist_convex(&core->list, arrow, 3, theme()->text);
    drawlist_line(&core->list, arrow, 4, 1, theme()->panel);
}
