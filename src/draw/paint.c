/// Turns draw commands and glyphs into triangles.
#include "draw/paint.h"

/// Clips an interval to [low, high] and its texels in proportion; false if it is empty.
static bool clip_axis(float *from, float *to, float *texel_from, float *texel_to, int low, int high)
{
    float slope = (*texel_to - *texel_from) / (*to - *from);
    if (*from < (float)low) {
        *texel_from += ((float)low - *from) * slope;
        *from = (float)low;
    }
    if (*to > (float)high) {
        *texel_to -= (*to - (float)high) * slope;
        *to = (float)high;
    }
    return *to > *from;
}

/// A line of text with its pen at (x, y) in logical pixels, clipped to `clip`.
static void paint_text(const struct painter *painter, const struct draw_command *command, const char *text,
                       struct area clip)
{
    float pen = roundf(command->x * painter->scale), baseline = roundf(command->y * painter->scale);
    for (uint32_t c; (c = utf8_next(&text)) != 0;) {
        const struct glyph *glyph = atlas_glyph(painter->atlas, command->font, command->width, c);
        struct quad quad = {
            pen + glyph->xoff,  baseline + glyph->yoff,
            pen + glyph->xoff2, baseline + glyph->yoff2,
            glyph->x0,          glyph->y0,
            glyph->x1,          glyph->y1,
        };
        pen += glyph->advance;
        if (glyph->x1 == glyph->x0) continue;
        if (!clip_axis(&quad.x0, &quad.x1, &quad.u0, &quad.u1, clip.x0, clip.x1)) continue;
        if (!clip_axis(&quad.y0, &quad.y1, &quad.v0, &quad.v1, clip.y0, clip.y1)) continue;
        shape_quad(painter->batch, &quad, command->color);
    }
}

/// Whether the command was recorded unclipped, so that it needs no scissor.
static bool is_whole(const struct draw_command *command)
{
    struct rect b = command->bounds, c = command->clip;
    return b.x > c.x && b.y > c.y && b.x + b.w < c.x + c.w && b.y + b.h < c.y + c.h;
}

/// Lines and polygons that extend beyond their clip need it as scissor. Other commands keep the current scissor if possible, because every
/// change costs a draw call.
static void choose_scissor(struct batch *batch, const struct draw_command *command, struct area reach,
                           struct area clip, struct area area)
{
    bool cuts_itself = command->kind == DRAW_RECT || command->kind == DRAW_TEXT || is_whole(command);
    if (!cuts_itself) {
        batch->scissor = area_intersect(clip, area);
    } else if (!area_contains(batch->scissor, area_intersect(reach, area))) {
        batch->scissor = area;
    }
}

static void paint_command(const struct painter *painter, const struct drawlist *list,
                          const struct draw_command *command, struct area reach, struct area area)
{
    struct area clip = area_rounded(command->clip, painter->scale);
    const float *xy = list->points + 2 * (size_t)command->first;
    choose_scissor(painter->batch, command, reach, clip, area);
    switch (command->kind) {
    case DRAW_RECT: {
        float s = painter->scale;
        const float corners[4] = {xy[0] * s, xy[1] * s, xy[2] * s, xy[3] * s};
        shape_rect(painter->batch, corners, clip, command->color);
        break;
    }
    case DRAW_LINE: {
        struct line_style style = {command->width, command->on, command->off, painter->scale, command->color};
        line_add(painter->batch, painter->scratch, xy, command->count, style, area_intersect(clip, area));
        break;
    }
    case DRAW_BAND:
        band_add(painter->batch, xy, command->count, command->width, painter->scale, command->color);
        break;
    case DRAW_CONVEX:
        shape_convex(painter->batch, xy, command->count, painter->scale, command->color);
        break;
    case DRAW_TEXT:
        paint_text(painter, command, list->text + command->first, clip);
        break;
    }
}

void paint_list(const struct painter *painter, const struct drawlist *list, struct area area)
{
    painter->batch->scissor = area;
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *command = &list->commands[i];
        struct area reach = area_outer(command->bounds, painter->scale);
        if (area_touches(reach, area)) paint_command(painter, list, command, reach, area);
    }
}
