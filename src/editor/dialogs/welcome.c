/// What to try first: a card on the stage that goes away with the first edit, the first look at the help, Esc, or a click.
#include "editor/core/rigs.h"
#include "editor/dialogs/dialogs.h"
#include "editor/dialogs/help.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>

enum { MARGIN = 16, PAD = 14, LINE = 20, GAP = 16 };

enum { HINTS = 4 };

/// By what is on the stage; an empty row is about knots.
static const struct hint {
    const char *what, *why;
} hints[LEADS][HINTS] = {
    [LEAD_TAIL] = {{"Drag the fox", "its tail swings after it"},
                   {"Pull the tail", "this sets a knot at the playhead"},
                   {0},
                   {"Drop a .glb", "your own: click a bone, press J"}},
    [LEAD_CHARACTER] = {{"Drag the character", "pins the point you hold"},
                        {0},
                        {"Hold F, press ↑", "it swings faster"},
                        {"Drop a .glb", "your own: click a bone, press J"}},
    [LEAD_CHAIN] = {{"Pull a chain", "this sets a knot at the playhead"},
                    {0},
                    {"Click a bone", "Shift+J makes another chain of it"},
                    {"Press Ctrl+E", "a .glb with the new motion"}},
    [LEAD_MODEL] = {{"Click a bone", "the first of its tail, say"},
                    {"Press Shift+J", "it swings after the clip"},
                    {"Pull the tail", "this sets a knot at the playhead"},
                    {"Press Ctrl+E", "a .glb with the new motion"}},
    [LEAD_NOTHING] = {{"Double-click", "sets a knot of a curve"},
                      {"Drag a knot", "the curve hits it, and swings"},
                      {"Press A", "adds a tail or a character"},
                      {"Drop a .glb", "your own: click a bone, press J"}},
};

static const struct hint knot_hints[] = {{"Double-click", "sets a knot of a curve"},
                                         {"Drag a knot", "the curve hits it, and swings"}};

static const struct hint *hint_of(const struct document *document, int row)
{
    const struct hint *hint = &hints[rigs_lead(document)][row];
    return hint->what ? hint : &knot_hints[rigs_have_knots(document)];
}

static const char closing[] = "Got it", more[] = "F1 shows all keys";

void dialogs_welcome(struct dialogs *dialogs) { dialogs->welcome = true; }

bool dialogs_is_welcoming(const struct dialogs *dialogs) { return dialogs->welcome; }

static float width_of(enum font font, const char *text) { return font_width(font, THEME_TEXT_NORMAL, text); }

/// Width of the column of what to do, whichever it is.
static float what_width(void)
{
    float width = 0;
    for (int i = 0; i < LEADS * HINTS; i++) {
        const char *what = hints[i / HINTS][i % HINTS].what;
        if (what) width = fmaxf(width, width_of(FONT_LABEL_BOLD, what));
    }
    return ceilf(width) + GAP;
}

struct rect welcome_card(const struct core *core)
{
    const struct rect *stage = &core->layout.stage;
    float why = width_of(FONT_LABEL, more) + GAP + width_of(FONT_LABEL_BOLD, closing) - what_width();
    for (int i = 0; i < LEADS * HINTS; i++) {
        const char *reason = hints[i / HINTS][i % HINTS].why;
        if (reason) why = fmaxf(why, width_of(FONT_LABEL, reason));
    }
    const float height = 2 * PAD + (HINTS + 1) * LINE + 2;
    const float width = 2 * PAD + what_width() + ceilf(why);
    const bool legend = core->characters.mapped || core->brush.on; // that of the phase map is at the left hand
    return (struct rect){legend ? stage->x + stage->w - MARGIN - width : stage->x + MARGIN,
                         stage->y + stage->h - MARGIN - height, width, height};
}

bool welcome_event(struct dialogs *dialogs, const struct core *core, const struct event *event)
{
    if (!dialogs->welcome || event->action != ACTION_PRESS) return false;
    bool escape = event->kind == EVENT_KEY && event->key == KEY_ESCAPE;
    bool click = event->kind == EVENT_BUTTON && rect_contains(welcome_card(core), event->x, event->y);
    if (escape || click) dialogs->welcome = false;
    return escape || click;
}

static void show_text(struct core *core, float x, float y, enum font font, uint32_t color, const char *text)
{
    drawlist_text(&core->list, x, y, font, THEME_TEXT_NORMAL, color, text);
}

void dialogs_show_welcome(struct dialogs *dialogs, struct core *core, const struct editor_world *world)
{
    if (!history_is_saved(world->history)) dialogs->welcome = false;
    if (!dialogs->welcome) return;
    struct drawlist *list = &core->list;
    struct rect card = welcome_card(core), clip = drawlist_push_clip(list, core->layout.stage);
    drawlist_rounded(list, card, 8, theme()->panel);
    drawlist_rounded_line(list, card, 8, 1, theme()->zero);
    float left = card.x + PAD, y = card.y + PAD + 12;
    for (int i = 0; i < HINTS; i++, y += LINE) {
        const struct hint *hint = hint_of(world->document, i);
        show_text(core, left, y, FONT_LABEL_BOLD, theme()->text, hint->what);
        show_text(core, left + what_width(), y, FONT_LABEL, theme()->text_dim, hint->why);
    }
    y += 4;
    show_text(core, left, y, FONT_LABEL, theme()->text_dim, more);
    float right = card.x + card.w - PAD - width_of(FONT_LABEL_BOLD, closing);
    show_text(core, right, y, FONT_LABEL_BOLD, theme()->accent, closing);
    drawlist_set_clip(list, clip);
}
