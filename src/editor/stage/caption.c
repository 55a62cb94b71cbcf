/// Shows the scene's description on the stage.
#include "editor/stage/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MARGIN = 16, WIDEST = 440, LINE = 18, MAX_LINES = 6 };

static const float SHARE = 0.4f; ///< of the stage's width; the middle is the rig's

/// One line's worth of a text, at `*y`; returns what follows it.
static const char *show_line(struct core *core, const char *text, enum font font, float size, uint32_t color,
                             float width, float *y)
{
    char line[257];
    size_t length = font_line(font, size, text, width);
    snprintf(line, sizeof line, "%.*s", (int)length, text);
    drawlist_text(&core->list, core->layout.stage.x + MARGIN, *y, font, size, color, line);
    *y += LINE;
    text += length;
    while (*text == ' ') text++;
    return text;
}

void stage_show_caption(struct core *core, const struct document *document, float bottom)
{
    if (!document->about) return;
    const struct rect place = core->layout.stage;
    float width = fminf(WIDEST, SHARE * place.w - MARGIN), y = place.y + MARGIN + 10;
    char title[257];
    const char *rest = strstr(document->about, ". ");
    size_t length = rest ? (size_t)(rest - document->about) : strlen(document->about);
    rest = rest ? rest + 2 : "";
    snprintf(title, sizeof title, "%.*s", (int)fminf((float)length, 256), document->about);
    struct rect clip = drawlist_push_clip(&core->list, place);
    const char *more = title;
    for (int line = 0; line < 2 && *more && y < bottom; line++) {
        more = show_line(core, more, FONT_LABEL_BOLD, THEME_TEXT_NORMAL, theme()->text, width, &y);
    }
    for (int line = 0; line < MAX_LINES && *rest && y < bottom; line++) {
        rest = show_line(core, rest, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim, width, &y);
    }
    drawlist_set_clip(&core->list, clip);
}
