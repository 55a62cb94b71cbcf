/// Shows the scene's description on the stage, in a band along its upper edge that the camera leaves free.
#include "editor/stage/overlays.h"
#include "editor/stage/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MARGIN = 16, TOP = 10, WIDEST = 960, LINE = 18, MAX_LINES = 4, MAX_TITLE = 256 };

/// A description in two: up to the first full stop, and the rest.
struct caption {
    char title[MAX_TITLE + 1];
    const char *rest;
};

static struct caption caption_of(const struct document *document)
{
    struct caption caption;
    const char *stop = strstr(document->about, ". ");
    size_t length = stop ? (size_t)(stop - document->about) : strlen(document->about);
    if (length > MAX_TITLE) length = MAX_TITLE;
    memcpy(caption.title, document->about, length);
    caption.title[length] = '\0';
    caption.rest = stop ? stop + 2 : "";
    return caption;
}

static float caption_width(struct rect place) { return fminf(WIDEST, place.w - 2 * MARGIN); }

/// Takes one line of a text that is `width` wide: its length in bytes; `*text` goes on to what follows it.
static size_t take_line(const char **text, enum font font, float width)
{
    size_t length = font_line(font, THEME_TEXT_NORMAL, *text, width);
    *text += length;
    while (**text == ' ') (*text)++;
    return length;
}

float caption_height(struct rect place, const struct document *document)
{
    if (!document->about) return 0;
    const struct caption caption = caption_of(document);
    const char *rest = caption.rest;
    int lines = 1;
    while (lines < MAX_LINES && *rest) {
        take_line(&rest, FONT_LABEL, caption_width(place));
        lines++;
    }
    return (float)(MARGIN + lines * LINE);
}

void stage_show_caption(struct core *core, const struct document *document, float bottom)
{
    if (!document->about || core->layout.stage.y + MARGIN + TOP >= bottom) return;
    const struct rect place = core->layout.stage;
    const float width = caption_width(place);
    const struct caption caption = caption_of(document);
    struct rect clip = drawlist_push_clip(&core->list, place);
    const char *rest = caption.rest;
    float y = place.y + MARGIN + TOP;
    drawlist_text_fit(&core->list, place.x + MARGIN, y, width, FONT_LABEL_BOLD, THEME_TEXT_NORMAL, theme()->text,
                      caption.title);
    for (int line = 1; line < MAX_LINES && *rest && y + LINE < bottom; line++) {
        char text[MAX_TITLE + 1];
        const char *from = rest;
        y += LINE;
        snprintf(text, sizeof text, "%.*s", (int)take_line(&rest, FONT_LABEL, width), from);
        drawlist_text(&core->list, place.x + MARGIN, y, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim, text);
    }
    drawlist_set_clip(&core->list, clip);
}
