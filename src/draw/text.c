/// Emits the glyphs of a text as quads.
#include "draw/paint.h"
#include "draw/shape.h"

/// A glyph's picture on the screen: corners in device pixels and in the atlas.
struct quad {
    float x0, y0, x1, y1, u0, v0, u1, v1;
};

/// Clips an interval to [low, high], its texels in proportion; false if nothing is left.
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

static void add_quad(struct batch *batch, const struct quad *quad, uint32_t color)
{
    const float x[4] = {quad->x0, quad->x1, quad->x1, quad->x0}, y[4] = {quad->y0, quad->y0, quad->y1, quad->y1};
    const float u[4] = {quad->u0, quad->u1, quad->u1, quad->u0}, v[4] = {quad->v0, quad->v0, quad->v1, quad->v1};
    uint32_t base = batch_reserve(batch, 4, 6);
    for (int i = 0; i < 4; i++) {
        struct batch_vertex vertex = shape_vertex(x[i], y[i], color);
        vertex.u = u[i];
        vertex.v = v[i];
        batch_add(batch, vertex);
    }
    batch_triangle(batch, base, base + 1, base + 2);
    batch_triangle(batch, base, base + 2, base + 3);
}

void paint_text(const struct painter *painter, const struct draw_command *command, const char *text, struct area clip)
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
        add_quad(painter->batch, &quad, command->color);
    }
}
