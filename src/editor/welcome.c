/// What to try first: a card on the stage that goes away with the first edit, the first look at the help, or a click.
#include "editor/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>

enum { MARGIN = 16, PAD = 14, LINE = 20 };

static const char *const lines[] = {
    "Pull the tail, or drag a knot of its curve.",
    "Space plays and stops.  F1 shows all keys.",
};

enum { LINES = sizeof lines / sizeof lines[0] };

static const char closing[] = "Got it";

void editor_welcome(struct editor *editor) { editor->welcome = true; }

bool editor_is_welcoming(const struct editor *editor) { return editor->welcome; }

static struct rect card_of(const struct editor *editor)
{
    const struct rect *stage = &editor->layout.stage;
    float width = 2 * PAD + 24 + font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, closing), text = 0;
    for (int i = 0; i < LINES; i++) text = fmaxf(text, font_width(FONT_LABEL, THEME_TEXT_NORMAL, lines[i]));
    float height = 2 * PAD + LINES * LINE - 4;
    return (struct rect){stage->x + MARGIN, stage->y + stage->h - MARGIN - height, ceilf(text + width), height};
}

bool welcome_event(struct editor *editor, const struct event *event)
{
    bool click = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS;
    struct rect card = card_of(editor);
    if (!editor->welcome || !click || !rect_contains(card, event->x, event->y)) return false;
    editor->welcome = false;
    return true;
}

void welcome_show(struct editor *editor, const struct editor_world *world)
{
    if (!history_is_saved(world->history) || editor->help.open) editor->welcome = false;
    if (!editor->welcome) return;
    struct drawlist *list = &editor->list;
    struct rect card = card_of(editor), clip = drawlist_push_clip(list, editor->layout.stage);
    drawlist_rounded(list, card, 8, theme_fade(theme()->panel, 0.92f));
    drawlist_rounded_line(list, card, 8, 1, theme()->zero);
    float y = card.y + PAD + 12;
    for (int i = 0; i < LINES; i++, y += LINE) {
        drawlist_text(list, card.x + PAD, y, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text, lines[i]);
    }
    float width = font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, closing);
    float middle = roundf(card.y + (card.h + font_cap_height(FONT_LABEL_BOLD, THEME_TEXT_NORMAL)) / 2);
    drawlist_text(list, card.x + card.w - PAD - width, middle, FONT_LABEL_BOLD, THEME_TEXT_NORMAL, theme()->accent,
                  closing);
    drawlist_set_clip(list, clip);
}
