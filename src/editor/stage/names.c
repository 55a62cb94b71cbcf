/// Texts on the stage: rig names, if there are several of a kind, and the scene's description.
#include "editor/core/core.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BELOW = 14, HEIGHT = 20, PAD = 6, DOT = 8 }; ///< pixels; BELOW: from the feet to the name

static const float FEET = -0.5f; ///< z of the paws from the tail's root, metres, bind size

void stage_scrim(struct core *core, struct rect box)
{
    drawlist_rounded(&core->list, box, fminf(6, box.h / 4), theme_fade(theme()->panel, 0.9f));
}

void stage_note(struct core *core, float x, float y, enum font font, uint32_t color, const char *text)
{
    stage_scrim(core, (struct rect){x - 4, y - 12, font_width(font, THEME_TEXT_SMALL, text) + 8, 16});
    drawlist_text(&core->list, x, y, font, THEME_TEXT_SMALL, color, text);
}

/// Place of a tail's name; false if its feet are behind the eye.
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

/// Skips names that would overlap others.
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

enum { MARGIN = 16, AROUND = 8, TOP = 10, WIDEST = 960, LINE = 18, MAX_LINES = 4, MAX_TITLE = 256 };

/// A description in lines: the title up to the first full stop, then the rest.
struct caption {
    char line[MAX_LINES][MAX_TITLE + 1];
    int count;
    float width; ///< of the widest line
};

static struct caption caption_of(struct rect place, const struct document *document)
{
    struct caption caption = {.count = 1};
    const float room = fminf(WIDEST, place.w - 2 * MARGIN);
    const char *stop = strstr(document->about, ". "), *rest = stop ? stop + 2 : "";
    const size_t length = stop ? (size_t)(stop - document->about) : strlen(document->about);
    snprintf(caption.line[0], sizeof caption.line[0], "%.*s", (int)length, document->about);
    caption.width = fminf(font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, caption.line[0]), room);
    while (caption.count < MAX_LINES && *rest) {
        char *line = caption.line[caption.count++];
        const char *from = rest;
        const size_t taken = font_take_line(THEME_TEXT_NORMAL, room, &rest);
        snprintf(line, sizeof caption.line[0], "%.*s", (int)taken, from);
        caption.width = fmaxf(caption.width, font_width(FONT_LABEL, THEME_TEXT_NORMAL, line));
    }
    return caption;
}

float caption_height(struct rect place, const struct document *document)
{
    return document->about ? (float)(MARGIN + LINE * caption_of(place, document).count) : 0;
}

void stage_show_caption(struct core *core, float bottom)
{
    const struct rect place = core->layout.stage;
    const float x = place.x + MARGIN, y = place.y + MARGIN + TOP;
    if (!core->document->about || y >= bottom) return;
    const struct caption caption = caption_of(place, core->document);
    const int count = (int)fminf((float)caption.count, ceilf((bottom - y) / LINE));
    const struct rect box = {x - AROUND, y - TOP - AROUND, caption.width + 2 * AROUND, LINE * (float)count + AROUND};
    struct rect clip = drawlist_push_clip(&core->list, place);
    stage_scrim(core, box);
    drawlist_text_fit(&core->list, x, y, caption.width, FONT_LABEL_BOLD, THEME_TEXT_NORMAL, theme()->text,
                      caption.line[0]);
    for (int i = 1; i < count; i++)
        drawlist_text(&core->list, x, y + LINE * (float)i, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim,
                      caption.line[i]);
    drawlist_set_clip(&core->list, clip);
}
