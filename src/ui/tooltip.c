/// When and where tooltips appear, and how they look.
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>

enum { WIDTH = 260, LINE = 16, PAD_X = 8, PAD_Y = 5, BELOW = 6, MARGIN = 4 };

static const double WAIT = 0.5; ///< seconds the pointer must rest

void tooltip_offer(struct tooltip *tooltip, const char *text, float x, float y, struct rect at)
{
    const bool moved = x != tooltip->x || y != tooltip->y;
    const bool elsewhere = !moved && (at.x != tooltip->at.x || at.y != tooltip->at.y);
    if (text != tooltip->text || elsewhere) {
        *tooltip = (struct tooltip){.text = text, .at = at, .x = x, .y = y};
    } else if (moved && !tooltip_is_shown(tooltip)) {
        tooltip->rest = 0;
        tooltip->at = at;
    }
    tooltip->x = x;
    tooltip->y = y;
}

void tooltip_dismiss(struct tooltip *tooltip) { tooltip->spent = true; }

void tooltip_advance(struct tooltip *tooltip, double dt)
{
    if (tooltip_waits(tooltip)) tooltip->rest += dt;
}

bool tooltip_is_shown(const struct tooltip *tooltip)
{
    return tooltip->text && !tooltip->spent && tooltip->rest >= WAIT;
}

bool tooltip_waits(const struct tooltip *tooltip) { return tooltip->text && !tooltip->spent && tooltip->rest < WAIT; }

static float text_width(struct rect window) { return fminf(WIDTH, window.w - 2 * MARGIN) - 2 * PAD_X; }

struct rect tooltip_box(const struct tooltip *tooltip, struct rect window)
{
    const float width = text_width(window), whole = font_width(FONT_LABEL, THEME_TEXT_SMALL, tooltip->text);
    const char *rest = tooltip->text;
    int lines = 0;
    for (; *rest; lines++) font_take_line(THEME_TEXT_SMALL, width, &rest);
    const float w = fminf(ceilf(whole), width) + 2 * PAD_X, h = (float)(lines * LINE + 2 * PAD_Y);
    const struct rect *at = &tooltip->at;
    const float below = at->y + at->h + BELOW, above = at->y - BELOW - h;
    const float x = fmaxf(window.x + MARGIN, fminf(at->x, window.x + window.w - MARGIN - w));
    const float y = below + h <= window.y + window.h - MARGIN ? below : fmaxf(above, window.y + MARGIN);
    return (struct rect){roundf(x), roundf(y), w, h};
}

void tooltip_show(const struct tooltip *tooltip, struct rect window, struct drawlist *list)
{
    if (!tooltip_is_shown(tooltip)) return;
    const struct rect box = tooltip_box(tooltip, window);
    drawlist_rounded(list, rect_inset(box, -1), 5, theme()->veil);
    drawlist_rounded(list, box, 4, theme()->raised);
    drawlist_rounded_line(list, box, 4, 1, theme()->control);
    float y = box.y + PAD_Y + LINE - 4;
    const char *rest = tooltip->text;
    for (; *rest; y += LINE) {
        const char *start = rest;
        char part[257];
        const size_t length = font_take_line(THEME_TEXT_SMALL, text_width(window), &rest);
        snprintf(part, sizeof part, "%.*s", (int)length, start);
        drawlist_text(list, box.x + PAD_X, y, FONT_LABEL, THEME_TEXT_SMALL, theme()->text, part);
    }
}
