/// Words on the stage: the names of several rigs of a kind, and what the scene is about.
#include "editor/core/core.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BELOW = 14, HEIGHT = 20, PAD = 6, DOT = 8 }; ///< pixels; the first: of a name under the feet

static const float FEET = -0.5f; ///< z of the paws from where the tail begins, metres, bind size

/// Where the name of a tail goes; false where its feet are behind the eye.
static bool place_name(const struct stage *stage, const struct core *core, int tail, const char *name,
                       struct rect *place)
{
    const struct pose *pose = &stage->strands[tail].pose;
    const float *base = pose->matrix[0] + 12;
    const float feet[3] = {base[0], pose->ground, base[2] + FEET * pose->scale};
    const struct rect r = core->layout.stage;
    float xy[2];
    if (!stage_project_point(stage, r, feet, xy)) return false;
    place->w = ceilf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, name)) + DOT + 3 * PAD;
    place->h = HEIGHT;
    place->x = roundf(fmaxf(fminf(xy[0] - place->w / 2, r.x + r.w - place->w), r.x));
    place->y = roundf(fminf(xy[1] + BELOW, r.y + r.h - HEIGHT));
    return true;
}

static bool overlap(const struct rect *a, const struct rect *b)
{
    return a->x < b->x + b->w && b->x < a->x + a->w && a->y < b->y + b->h && b->y < a->y + a->h;
}

static void show_name(struct core *core, const struct rect *place, uint32_t color, const char *name)
{
    const struct rect dot = {place->x + PAD, place->y + (HEIGHT - DOT) / 2.0f, DOT, DOT};
    drawlist_rounded(&core->list, *place, HEIGHT / 2.0f, theme()->panel);
    drawlist_rounded(&core->list, dot, 2, color);
    drawlist_text(&core->list, dot.x + DOT + PAD, place->y + HEIGHT - PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                  theme()->text, name);
}

/// A name that would lie over another one is left out.
void names_show(const struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    struct rect shown[STAGE_MAX_TAILS], place;
    int count = 0;
    for (int t = 0; t < stage->tail_count && stage->tail_count > 1; t++) {
        const struct rig *rig = document->rigs[stage->strands[t].rig];
        const int spline = rig->tail.channel_count > 0 ? rig->tail.channels[0].spline : -1;
        const uint32_t color = spline >= 0 ? spline_list_color(document, spline) : theme()->text_dim;
        bool free = place_name(stage, core, t, rig->name, &place);
        for (int i = 0; i < count && free; i++) free = !overlap(&place, &shown[i]);
        if (free) show_name(core, &place, color, rig->name);
        if (free) shown[count++] = place;
    }
}

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

float caption_height(struct rect place, const struct document *document)
{
    if (!document->about) return 0;
    const struct caption caption = caption_of(document);
    const char *rest = caption.rest;
    int lines = 1;
    while (lines < MAX_LINES && *rest) {
        font_take_line(FONT_LABEL, THEME_TEXT_NORMAL, caption_width(place), &rest);
        lines++;
    }
    return (float)(MARGIN + lines * LINE);
}

void stage_show_caption(struct core *core, float bottom)
{
    if (!core->document->about || core->layout.stage.y + MARGIN + TOP >= bottom) return;
    const struct rect place = core->layout.stage;
    const float width = caption_width(place);
    const struct caption caption = caption_of(core->document);
    struct rect clip = drawlist_push_clip(&core->list, place);
    const char *rest = caption.rest;
    float y = place.y + MARGIN + TOP;
    drawlist_text_fit(&core->list, place.x + MARGIN, y, width, FONT_LABEL_BOLD, THEME_TEXT_NORMAL, theme()->text,
                      caption.title);
    for (int line = 1; line < MAX_LINES && *rest && y + LINE < bottom; line++) {
        char text[MAX_TITLE + 1];
        const char *from = rest;
        const size_t length = font_take_line(FONT_LABEL, THEME_TEXT_NORMAL, width, &rest);
        y += LINE;
        snprintf(text, sizeof text, "%.*s", (int)length, from);
        drawlist_text(&core->list, place.x + MARGIN, y, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim, text);
    }
    drawlist_set_clip(&core->list, clip);
}
