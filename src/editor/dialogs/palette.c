/// The command palette (F3): type to find a command. Each row shows its keys or what it still needs.
#include "editor/core/command.h"
#include "editor/dialogs/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>

enum { WIDTH = 640, ROW = 26, ROWS = 12, FIELD = 34, PAD = 12, GAP = 16 };

/// How a command matches: by name or by key.
static enum fit fit_of(const struct command *command, const struct ui_filter *filter)
{
    char keys[COMMAND_KEYS];
    const enum fit fit = ui_filter_fit(filter, command->name);
    command_keys(command, keys);
    return fit < FIT_INSIDE && ui_filter_fit(filter, keys) >= FIT_WORD ? FIT_INSIDE : fit;
}

static bool is_listed(const struct command *command, bool gestures)
{
    return command->name && (gestures ? command->about != ABOUT_NOTHING : command_runs(command));
}

/// Adds the commands of one fit, either those that can run or those that cannot.
static void add(const struct command_list *commands, const enum fit *fits, enum fit fit, const char *const *missing,
                bool lacking, struct commands_found *found)
{
    for (int i = 0; i < commands->count; i++) {
        const struct command *command = &commands->commands[i];
        const char *lacks = missing[command->needs];
        if (fits[i] != fit || (lacks != NULL) != lacking) continue;
        found->missing[found->count] = lacks;
        found->list[found->count++] = command;
    }
}

void commands_find(const struct command_list *commands, const struct core *core, const struct ui_filter *filter,
                   struct commands_found *found)
{
    const char *missing[NEEDS_COUNT];
    enum fit fits[COMMANDS_MOST], best = FIT_NOT;
    for (enum need need = 0; need < NEEDS_COUNT; need++) missing[need] = core ? need_missing(core, need) : NULL;
    for (int i = 0; i < commands->count; i++) {
        const struct command *command = &commands->commands[i];
        fits[i] = is_listed(command, core == NULL) ? fit_of(command, filter) : FIT_NOT;
        if (fits[i] > best) best = fits[i];
    }
    found->count = 0;
    for (enum fit fit = FIT_START; fit >= ui_filter_least(best); fit--) {
        add(commands, fits, fit, missing, false, found);
        add(commands, fits, fit, missing, true, found);
    }
}

void commands_show_field(struct drawlist *list, struct rect r, const struct ui_filter *filter, const char *empty)
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
    const float room = window.h - 32 - FIELD - 3 * PAD;
    sheet.rows = (int)fmaxf(fminf(floorf(room / ROW), ROWS), 1);
    const float w = fminf(WIDTH, window.w - 16), rest = FIELD + 3 * PAD;
    const float top = roundf(window.y + (window.h - rest - (float)(sheet.rows * ROW)) / 3);
    if (found < sheet.rows) sheet.rows = found > 0 ? found : 1; // the field keeps its place
    const float h = rest + (float)(sheet.rows * ROW);
    sheet.box = (struct rect){roundf(window.x + (window.w - w) / 2), top, w, h};
    sheet.field = (struct rect){sheet.box.x + PAD, sheet.box.y + PAD, w - 2 * PAD, FIELD};
    sheet.list = (struct rect){sheet.field.x, sheet.field.y + FIELD + PAD, sheet.field.w, (float)(sheet.rows * ROW)};
    return sheet;
}

/// Chooses a row and scrolls to it.
static void choose(struct palette *palette, int choice, int count, int rows)
{
    palette->choice = choice >= count ? count - 1 : choice;
    if (palette->choice < 0) palette->choice = 0;
    if (palette->first > palette->choice) palette->first = palette->choice;
    if (palette->first < palette->choice - rows + 1) palette->first = palette->choice - rows + 1;
}

/// The choice stays in sight.
static void scroll(struct palette *palette, int by, int count, int rows)
{
    const int last = count > rows ? count - rows : 0, first = palette->first + by;
    palette->first = first < 0 ? 0 : first > last ? last : first;
    const int choice = palette->choice < palette->first ? palette->first : palette->choice;
    choose(palette, choice < palette->first + rows ? choice : palette->first + rows - 1, count, rows);
}

/// Runs the row's command if it can run.
static void take(struct palette *palette, const struct commands_found *found)
{
    if (palette->choice >= found->count) return;
    if (!found->missing[palette->choice]) *palette = (struct palette){.chosen = found->list[palette->choice]};
}

static void key(struct palette *palette, const struct commands_found *found, int pressed, int rows)
{
    const int choice = palette->choice, count = found->count;
    if (pressed == KEY_ESCAPE) palette->open = false;
    if (pressed == KEY_UP) choose(palette, choice > 0 ? choice - 1 : count - 1, count, rows);
    if (pressed == KEY_DOWN) choose(palette, choice + 1 < count ? choice + 1 : 0, count, rows);
    if (pressed == KEY_PAGE_UP) choose(palette, choice - rows, count, rows);
    if (pressed == KEY_PAGE_DOWN) choose(palette, choice + rows, count, rows);
    if (pressed == KEY_HOME) choose(palette, 0, count, rows);
    if (pressed == KEY_END) choose(palette, count - 1, count, rows);
    if (pressed == KEY_ENTER) take(palette, found);
}

static void press(struct palette *palette, const struct commands_found *found, const struct event *event,
                  const struct sheet *sheet)
{
    const int row = palette->first + (int)floorf((event->y - sheet->list.y) / ROW);
    if (!rect_contains(sheet->box, event->x, event->y)) {
        palette->open = false;
    } else if (rect_contains(sheet->list, event->x, event->y) && row < found->count) {
        palette->choice = row;
        take(palette, found);
    }
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
        key(palette, &found, event->key, sheet.rows);
    } else if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) {
        press(palette, &found, event, &sheet);
    } else if (event->kind == EVENT_WHEEL) {
        scroll(palette, (int)lroundf(-3 * event->dy), found.count, sheet.rows);
    }
    return true;
}

static void show_text(struct drawlist *list, struct rect r, uint32_t color, const char *text)
{
    drawlist_text_fit(list, r.x, ui_baseline(r, FONT_LABEL, THEME_TEXT_NORMAL), r.w, FONT_LABEL, THEME_TEXT_NORMAL,
                      color, text);
}

static void show_row(struct core *core, struct rect r, const struct commands_found *found, int row, bool chosen)
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
    const float from = r.x + 10 + name + GAP, end = r.x + r.w - 10 - (right > 0 ? right + GAP : 0);
    show_text(list, (struct rect){r.x + 10, r.y, r.w - 20, r.h}, missing ? theme()->text_dim : theme()->text,
              command->name);
    show_text(list, (struct rect){r.x + r.w - 10 - right, r.y, right + 1, r.h}, theme()->text_dim, keys);
    if (missing && end - from > 40) {
        const float width = fminf(ceilf(ui_text_width(missing)), end - from);
        show_text(list, (struct rect){end - width, r.y, width + 1, r.h}, theme()->text_dim, missing);
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
    struct rect row = {sheet.list.x, sheet.list.y, sheet.list.w, ROW};
    for (int i = palette->first; i < found.count && i < palette->first + sheet.rows; i++, row.y += ROW)
        show_row(core, row, &found, i, i == palette->choice);
    if (found.count == 0)
        show_text(list, (struct rect){row.x + 10, row.y, row.w - 20, ROW}, theme()->text_dim,
                  "No command matches. Esc closes.");
}
