/// The overlays without questions: the commands with their keys (F1), the palette that runs them (F3), and the card for new users.
#include "editor/core/core.h"
#include "editor/dialogs/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>

enum { COMMANDS_MOST = 320 };

/// The commands that match the typed text, best first, or all of them under headings.
struct commands_found {
    const struct command *list[COMMANDS_MOST]; ///< NULL: a heading
    const char *missing[COMMANDS_MOST];        ///< from needs_missing(); the heading
    int count;
};

enum {
    PALETTE_WIDTH = 640,
    PALETTE_ROW = 26,
    PALETTE_ROWS = 12,
    PALETTE_FIELD = 34,
    PALETTE_PAD = 12,
    PALETTE_GAP = 16,
    MENU_ROWS = 8
};

/// The layout for a window.
struct page {
    struct rect box, field, body; ///< the body shows the list
    float view, content;          ///< of the list, in rows
};

/// At most so many rows.
static struct page palette_page(const struct commands_found *found, struct rect window, float most)
{
    const float rest = PALETTE_FIELD + 3 * PALETTE_PAD, room = window.h - 32 - rest;
    const float w = fminf(PALETTE_WIDTH, window.w - 16);
    float rows = fmaxf(fminf(floorf(room / PALETTE_ROW), most), 1);
    const float top = roundf(window.y + (window.h - rest - rows * PALETTE_ROW) / 3);
    rows = fminf(rows, fmaxf((float)found->count, 1)); // the field keeps its place
    struct page page = {.view = rows, .content = (float)found->count};
    page.box = (struct rect){roundf(window.x + (window.w - w) / 2), top, w, rest + rows * PALETTE_ROW};
    page.field = (struct rect){page.box.x + PALETTE_PAD, top + PALETTE_PAD, w - 2 * PALETTE_PAD, PALETTE_FIELD};
    page.body =
        (struct rect){page.field.x, page.field.y + PALETTE_FIELD + PALETTE_PAD, page.field.w, rows * PALETTE_ROW};
    return page;
}

static struct page menu_page(const struct commands_found *found, const float corner[2], struct rect window)
{
    enum { WIDTH = 320, PAD = 6 };
    const float rows = fmaxf((float)found->count, 1), h = rows * PALETTE_ROW + 2 * PAD;
    struct page page = {.view = rows, .content = rows};
    page.box = (struct rect){fmaxf(fminf(corner[0], window.x + window.w - WIDTH), window.x),
                             fmaxf(fminf(corner[1], window.y + window.h - h), window.y), WIDTH, h};
    page.body = (struct rect){page.box.x + PAD, page.box.y + PAD, WIDTH - 2 * PAD, rows * PALETTE_ROW};
    return page;
}

static void add_found(struct commands_found *found, const struct command *command, const char *text)
{
    if (found->count == COMMANDS_MOST) return;
    found->missing[found->count] = text;
    found->list[found->count++] = command;
}

/// What F1 begins with: the rows for the place under the pointer, then all of them under their headings.
static void find_headed(const struct dialogs *dialogs, struct commands_found *found)
{
    static const struct {
        enum place place;
        const char *title;
    } titles[] = {
        {ON_CURVES, "Over the curves"},    {ON_KNOT, "Over a knot"}, {ON_TIME, "Over the ruler and the status line"},
        {ON_STAGE, "Over the stage"},      {ON_PIN, "Over a pin"},   {ON_INSPECTOR, "In the inspector"},
        {ON_ROW, "Over the splines' list"}};
    const struct command *commands = dialogs->commands;
    for (size_t i = 0; i < sizeof titles / sizeof titles[0]; i++) {
        if (titles[i].place == dialogs->lookup.at) add_found(found, NULL, titles[i].title);
    }
    for (int i = 0; i < dialogs->command_count; i++) {
        if (commands[i].at & dialogs->lookup.at) add_found(found, &commands[i], NULL);
    }
    for (int i = 0; !commands[i].heading || commands[i].heading[0]; i++)
        add_found(found, commands[i].heading ? NULL : &commands[i], commands[i].heading);
}

/// Finds the commands that match, and lays out the overlay that is open. For the palette those that can run now come first, of these files
/// last; F1 has gestures too, and without typed text all its rows under headings.
static struct page lookup_page(const struct dialogs *dialogs, struct commands_found *found)
{
    const struct core *core = dialogs->core;
    const struct command *commands = dialogs->commands;
    const int count = dialogs->command_count;
    const struct ui_filter *filter = &dialogs->lookup.filter;
    const bool menu = dialogs->lookup.kind == LOOKUP_MENU, runs = menu || dialogs->lookup.kind == LOOKUP_PALETTE;
    const char *missing[NEEDS_COUNT] = {NULL};
    enum fit fits[COMMANDS_MOST], best = FIT_NOT;
    bool listed = true; // in F1
    if (runs) needs_missing(core, missing);
    for (int i = 0; i < count; i++) {
        const struct command *command = &commands[i];
        char keys[COMMAND_KEYS], text[256];
        fits[i] = FIT_NOT;
        if (command->heading) listed = command->heading[0];
        if (!command->name || !(runs ? command_runs(command) : listed)) continue;
        const unsigned at = dialogs->lookup.at, in_curves = at & (ON_CURVES | ON_KNOT) ? IN_CURVES_MENU : 0;
        const unsigned places = at | in_curves | (at & ON_STAGE ? IN_STAGE_MENU : 0);
        if (runs && (command->at & IN_EXAMPLES) != (at & IN_EXAMPLES)) continue;
        if (menu && (!(command->at & places) || missing[command->needs])) continue;
        command_keys(command, core->app.in_page, keys); // its keys also find it
        snprintf(text, sizeof text, "%s %s", command->name, command->also ? command->also : "");
        fits[i] = ui_filter_fit(filter, text);
        if (fits[i] < FIT_INSIDE && ui_filter_fit(filter, keys) >= FIT_WORD) fits[i] = FIT_INSIDE;
        if (fits[i] > best) best = fits[i];
    }

    const bool headed = dialogs->lookup.kind == LOOKUP_KEYS && !filter->typed[0];
    found->count = 0;
    if (headed) find_headed(dialogs, found);
    for (enum fit fit = FIT_START; !headed && fit >= ui_filter_least(best); fit--) {
        for (int order = 0; order < 4; order++) {
            const char *heading = NULL;
            for (int i = 0; i < count; i++) {
                if (commands[i].heading) heading = commands[i].heading;
                const int late = runs && heading == ABOUT_FILE;
                const char *lacks = missing[commands[i].needs];
                if (fits[i] != fit || (lacks ? 2 : 0) + late != order) continue;
                add_found(found, &commands[i], lacks);
            }
        }
    }
    if (menu && found->count > MENU_ROWS) found->count = MENU_ROWS;
    const struct rect window = core->view.layout.window;
    return menu ? menu_page(found, dialogs->lookup.corner, window)
                : palette_page(found, window, runs ? PALETTE_ROWS : COMMANDS_MOST);
}

/// Opens it, or closes it if it is open.
static void flip_lookup(struct dialogs *dialogs, struct lookup opened)
{
    const bool open = dialogs->lookup.kind != opened.kind;
    if (!open) opened.kind = LOOKUP_NONE;
    dialogs->lookup = opened;
    dialogs->welcome &= !open;
}

/// Opens it for the place under the pointer.
static void flip_here(struct dialogs *dialogs, enum lookup_kind kind)
{
    const struct core *core = dialogs->core;
    static const enum place places[] = {[PANEL_NONE] = ON_STAGE,
                                        [PANEL_STAGE] = ON_STAGE,
                                        [PANEL_CURVES] = ON_CURVES,
                                        [PANEL_INSPECTOR] = ON_INSPECTOR,
                                        [PANEL_STATUS] = ON_TIME};
    const struct thing *thing = core->input.hover.thing;
    const float x = core->input.pointer_x, y = core->input.pointer_y;
    const enum place at = thing && thing->place ? thing->place : places[core_panel_at(core, x, y)];
    flip_lookup(dialogs, (struct lookup){.kind = kind, .at = at, .corner = {x, y}});
}

void dialogs_help(struct dialogs *dialogs) { flip_here(dialogs, LOOKUP_KEYS); }

void dialogs_menu(struct dialogs *dialogs) { flip_here(dialogs, LOOKUP_MENU); }

void dialogs_palette(struct dialogs *dialogs, unsigned at)
{
    flip_lookup(dialogs, (struct lookup){.kind = LOOKUP_PALETTE, .at = at});
}

const struct command *dialogs_take_command(struct dialogs *dialogs)
{
    const struct command *chosen = dialogs->lookup.chosen;
    dialogs->lookup.chosen = NULL;
    return chosen;
}

/// A drag scrolls as the wheel does, and a click counts when it ends. false: the event does nothing else.
static bool drag_lookup(struct lookup *lookup, struct event *event)
{
    static const float STEP = 16; // pixels
    const bool button = event->kind == EVENT_BUTTON;
    if (button && event->action == ACTION_PRESS) {
        lookup->held = true;
        lookup->moved = false;
        lookup->y = event->y;
        return false;
    }
    if (!lookup->held || (!button && event->kind != EVENT_POINTER)) return true;
    lookup->held = !button;
    event->action = ACTION_PRESS;
    if (button) return !lookup->moved;
    const float steps = truncf((event->y - lookup->y) / STEP);
    lookup->y += steps * STEP;
    lookup->moved |= steps != 0;
    event->kind = EVENT_WHEEL;
    event->dy = steps / 3;
    return steps != 0;
}

/// Chooses a row, and runs its command if it can run.
static void palette_event(struct lookup *lookup, const struct page *page, const struct commands_found *found,
                          const struct event *event)
{
    const int count = found->count, rows = (int)page->view;
    int choice = lookup->choice;
    bool runs = false;
    if (event->kind == EVENT_WHEEL) { // the choice stays in sight
        ui_list_scroll(&lookup->list, (float)lroundf(-3 * event->dy));
        const int first = (int)lookup->list.offset;
        choice = choice < first ? first : choice >= first + rows ? first + rows - 1 : choice;
    } else if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) {
        const int row = (int)lookup->list.offset + (int)floorf((event->y - page->body.y) / PALETTE_ROW);
        runs = rect_contains(page->body, event->x, event->y) && row < count;
        if (runs) choice = row;
        if (!rect_contains(page->box, event->x, event->y)) lookup->kind = LOOKUP_NONE;
    } else if (event->kind == EVENT_KEY) {
        if (event->key == KEY_UP) choice = choice > 0 ? choice - 1 : count - 1;
        if (event->key == KEY_DOWN) choice = choice + 1 < count ? choice + 1 : 0;
        if (event->key == KEY_PAGE_UP) choice -= rows;
        if (event->key == KEY_PAGE_DOWN) choice += rows;
        if (event->key == KEY_HOME) choice = 0;
        if (event->key == KEY_END) choice = count - 1;
        runs = event->key == KEY_ENTER && choice < count;
    }
    if (choice >= count) choice = count - 1;
    lookup->choice = choice < 0 ? 0 : choice;
    ui_list_show(&lookup->list, (float)lookup->choice, 1);
    const struct command *chosen = runs ? found->list[choice] : NULL;
    if (chosen && command_runs(chosen) && !found->missing[choice]) *lookup = (struct lookup){.chosen = chosen};
}

bool lookup_event(struct dialogs *dialogs, const struct event *event)
{
    struct lookup *lookup = &dialogs->lookup;
    struct event meant = *event;
    if (!lookup->kind) return false;
    if (!drag_lookup(lookup, &meant)) return true;
    const bool key = meant.kind == EVENT_KEY;
    if (key && meant.action == ACTION_RELEASE) return false; // the key was pressed before it opened
    if (meant.kind == EVENT_POINTER || meant.kind > EVENT_WHEEL) return false;
    struct commands_found found;
    const struct page page = lookup_page(dialogs, &found);
    ui_list_fit(&lookup->list, page.view, page.content);
    if (ui_filter_event(&lookup->filter, &meant)) {
        lookup->choice = 0;
        lookup->list.offset = 0;
        if (lookup->kind == LOOKUP_MENU) lookup->kind = LOOKUP_PALETTE;
    } else if (key && meant.key == KEY_ESCAPE) {
        lookup->kind = LOOKUP_NONE;
    } else {
        palette_event(lookup, &page, &found, &meant);
    }
    return true;
}

void lookup_show(const struct dialogs *dialogs)
{
    struct core *core = dialogs->core;
    const struct lookup *lookup = &dialogs->lookup;
    const bool is_menu = lookup->kind == LOOKUP_MENU;
    struct drawlist *drawn = &core->list;
    struct commands_found found;
    if (!lookup->kind) return;
    const struct page page = lookup_page(dialogs, &found);
    struct ui_list list = lookup->list;
    ui_list_fit(&list, page.view, page.content);
    if (!is_menu) drawlist_rect(drawn, core->view.layout.window, theme()->veil);
    drawlist_rounded(drawn, page.box, 8, theme()->panel);
    drawlist_rounded_line(drawn, page.box, 8, 1, theme()->zero);

    if (!is_menu) { // the field with its text, or what it is for
        const struct rect field = page.field;
        const char *typed = lookup->filter.typed, *text = typed;
        const bool runs = lookup->kind == LOOKUP_PALETTE && lookup->at != IN_EXAMPLES;
        if (!*typed) text = runs ? "Type what you want to do" : "Type to search";
        const float end =
            fminf(field.x + 10 + font_width(FONT_LABEL, THEME_TEXT_NORMAL, typed), field.x + field.w - 10);
        drawlist_rounded(drawn, field, 4, theme()->raised);
        drawlist_rounded_line(drawn, field, 4, 1.5f, theme()->accent);
        ui_paint_text(drawn, (struct rect){field.x + (*typed ? 10 : 14), field.y, field.w - 20, field.h}, FONT_LABEL,
                      *typed ? theme()->text : theme()->text_dim, text);
        drawlist_rect(drawn, (struct rect){roundf(end), field.y + 8, 1, field.h - 16}, theme()->accent);
    }
    const struct rect body = page.body;
    struct rect row = {body.x + 10, body.y, body.w - 20, PALETTE_ROW};
    const int first = (int)list.offset, last = first + (int)page.view;
    for (int i = first; i < found.count && i < last; i++, row.y += PALETTE_ROW) {
        const char *missing = found.missing[i];
        if (!found.list[i]) {
            ui_paint_text(drawn, row, FONT_LABEL_BOLD, theme()->accent, missing);
            continue;
        }
        const char *name = found.list[i]->name;
        const struct rect whole = {body.x, row.y, body.w, row.h};
        char keys[COMMAND_KEYS];
        command_keys(found.list[i], dialogs->core->app.in_page, keys);
        if (i == lookup->choice) {
            drawlist_rounded(drawn, whole, 4, theme()->fill);
        } else if (rect_contains(whole, core->input.pointer_x, core->input.pointer_y)) {
            drawlist_rounded(drawn, whole, 4, theme()->raised);
        }
        const float right = ceilf(ui_text_width(keys)), from = row.x + ceilf(ui_text_width(name)) + PALETTE_GAP;
        const float till = row.x + row.w - (right > 0 ? right + PALETTE_GAP : 0);
        ui_paint_text(drawn, row, FONT_LABEL, missing ? theme()->text_dim : theme()->text, name);
        ui_paint_text(drawn, (struct rect){row.x + row.w - right, row.y, right + 1, row.h}, FONT_LABEL,
                      theme()->text_dim, keys);
        if (!missing || till - from <= 40) continue;
        const float width = fminf(ceilf(ui_text_width(missing)), till - from);
        ui_paint_text(drawn, (struct rect){till - width, row.y, width + 1, row.h}, FONT_LABEL, theme()->text_dim,
                      missing);
    }
    if (found.count == 0)
        ui_paint_text(drawn, row, FONT_LABEL, theme()->text_dim,
                      is_menu ? "Nothing can be done here now." : "No command matches. Esc closes.");
    ui_list_bar(&list, drawn, (struct rect){body.x + body.w - 4, body.y, 4, body.h}, 0);
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

/// Hints in a band at the top, in place of the description. The camera keeps that height free.
static struct card band_card(const struct core *core, int count)
{
    const struct rect *stage = &core->view.layout.stage;
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
    const bool legend =
        core->view.on[SWITCH_PHASE_MAP] || core->focus.brush.on; // the phase map's legend is at the left
    const struct rect *stage = &core->view.layout.stage;
    const bool roomy = stage->w >= WIDE && rigs_lead(core) != LEAD_CHARACTER;
    const float closes = width_of(FONT_LABEL, more) + CARD_GAP + width_of(FONT_LABEL_BOLD, closing);
    float what, why;
    measure(core, HINTS, &what, &why);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const bool is_wide = places[i].form == FORM_WIDE;
        if (legend && !places[i].right) continue;
        struct card card = {.form = places[i].form, .hints = HINTS, .before = is_wide ? what + CARD_GAP : 0};
        const float width = 2 * CARD_PAD + ceilf(fmaxf(fmaxf(card.before + why, what), closes));
        const float height = 2 * CARD_PAD + (HINTS * (is_wide ? 1 : 2) + 1) * CARD_LINE + 2;
        card.rect =
            (struct rect){places[i].right ? stage->x + stage->w - CARD_MARGIN - width : stage->x + CARD_MARGIN,
                          stage->y + stage->h - CARD_MARGIN - height, width, height};
        const struct rect *r = &card.rect;
        const bool beside = r->x + r->w <= figure.x || r->x >= figure.x + figure.w || figure.w == 0;
        const bool below = r->y >= stage->y + CARD_TITLE; // the description's title
        if (roomy || (beside && below)) return card;
    }
    const struct card band = band_card(core, stage->h < TALL || !core->document->about ? 1 : 2);
    return band.rect.w <= stage->w ? band : band_card(core, 1);
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

float dialogs_show_welcome(struct dialogs *dialogs, struct rect figure)
{
    struct core *core = dialogs->core;
    const struct rect *stage = &core->view.layout.stage;
    if (!history_is_saved(core->history)) dialogs->welcome = false;
    if (!dialogs->welcome) return stage->y + stage->h;
    const struct card card = place_card(core, figure);
    dialogs->card = (struct rect){0};
    if (card.rect.w > stage->w) return 0;
    struct drawlist *list = &core->list;
    struct rect clip = drawlist_push_clip(list, *stage);
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
    return card.rect.y;
}
