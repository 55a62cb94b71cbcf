/// The card for new users. The first edit, F1, Esc or a click closes it.
#include "editor/core/rigs.h"
#include "editor/dialogs/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>

enum { MARGIN = 16, PAD = 14, LINE = 20, GAP = 16, BAND_MARGIN = 6, TITLE = 40 };

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
    card.before = form == FORM_WIDE ? what + GAP : 0;
    const float closes = width_of(FONT_LABEL, more) + GAP + width_of(FONT_LABEL_BOLD, closing);
    const float width = 2 * PAD + ceilf(fmaxf(fmaxf(card.before + why, what), closes));
    const float height = 2 * PAD + (HINTS * (form == FORM_WIDE ? 1 : 2) + 1) * LINE + 2;
    card.rect = (struct rect){right ? stage->x + stage->w - MARGIN - width : stage->x + MARGIN,
                              stage->y + stage->h - MARGIN - height, width, height};
    return card;
}

/// Hints in a band at the top, in place of the description. The camera keeps that height free.
static struct card band_card(const struct core *core, int count)
{
    const struct rect *stage = &core->layout.stage;
    struct card card = {.form = FORM_BAND, .hints = count};
    float what, why;
    measure(core, card.hints, &what, &why);
    card.before = what + GAP;
    const float closes = width_of(card.hints > 1 ? FONT_LABEL : FONT_LABEL_BOLD, card.hints > 1 ? more : closing);
    card.rect = (struct rect){stage->x + BAND_MARGIN, stage->y + BAND_MARGIN,
                              2 * PAD + card.before + why + 2 * GAP + ceilf(closes), PAD + (float)card.hints * LINE};
    return card;
}

/// Whether a card covers neither the rigs nor the description's title.
static bool is_clear(const struct core *core, const struct card *card, struct rect figure)
{
    const struct rect *r = &card->rect;
    const bool beside = r->x + r->w <= figure.x || r->x >= figure.x + figure.w || figure.w == 0;
    return beside && r->y >= core->layout.stage.y + TITLE;
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
        if (roomy || is_clear(core, &card, figure)) return card;
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
    show_text(core, card->rect.x + card->rect.w - PAD - width_of(font, text), y, font, color, text);
}

/// The note on how to close the card, below the hints or behind them in the band.
static void show_closing(struct core *core, const struct card *card, float y)
{
    if (card->form != FORM_BAND) {
        y += 4;
        show_text(core, card->rect.x + PAD, y, FONT_LABEL, theme()->text_dim, more);
    } else {
        y -= LINE;
        if (card->hints > 1) show_right(core, card, y - LINE, FONT_LABEL, theme()->text_dim, more);
    }
    show_right(core, card, y, FONT_LABEL_BOLD, theme()->accent, closing);
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
    const float left = card.rect.x + PAD;
    float y = card.rect.y + (card.form == FORM_BAND ? PAD / 2 : PAD) + 12;
    for (int i = 0; i < card.hints; i++, y += LINE) {
        const struct hint *hint = hint_of(core, i);
        show_text(core, left, y, FONT_LABEL_BOLD, theme()->text, hint->what);
        if (card.form == FORM_UPRIGHT) y += LINE;
        show_text(core, left + card.before, y, FONT_LABEL, theme()->text_dim, hint->why);
    }
    show_closing(core, &card, y);
    drawlist_set_clip(list, clip);
    dialogs->card = card.rect;
}
