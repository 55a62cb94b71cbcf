/// Packs the glyphs of all fonts and sizes into one texture.
#include "base/need.h"
#include "ui/face.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdlib.h>

enum { SIZE_COUNT = 3, ATLAS_WIDTH = 2048, ATLAS_MAX_HEIGHT = 8192, GAP = 1 };

static const float sizes[SIZE_COUNT] = {THEME_TEXT_SMALL, THEME_TEXT_NORMAL, THEME_TEXT_TITLE};

/// atlas.storage: glyphs by font, size and slot.
struct glyph_table {
    struct glyph glyphs[FONT_COUNT][SIZE_COUNT][FACE_SLOTS];
};

/// Glyphs are set in rows like type: left to right, each row below the tallest glyph of the last.
struct typesetter {
    int x, y, row_height;
};

/// Finds room for w × h texels, with a gap on all sides so that filtering never sees a neighbour.
static void set_type(struct typesetter *setter, int w, int h, struct glyph *glyph)
{
    if (setter->x + w + GAP > ATLAS_WIDTH) {
        setter->x = GAP;
        setter->y += setter->row_height + GAP;
        setter->row_height = 0;
    }
    glyph->x0 = (unsigned short)setter->x;
    glyph->y0 = (unsigned short)setter->y;
    glyph->x1 = (unsigned short)(setter->x + w);
    glyph->y1 = (unsigned short)(setter->y + h);
    setter->x += w + GAP;
    if (h > setter->row_height) setter->row_height = h;
}

/// Rasterises one entry of the table.
struct entry {
    struct glyph *glyph;
    const struct face_glyph *source;
    float em; ///< device pixels
};

enum { ENTRY_COUNT = FONT_COUNT * SIZE_COUNT * FACE_SLOTS };

static struct entry table_entry(const struct atlas *atlas, int i)
{
    struct glyph_table *table = atlas->storage;
    int font = i / (SIZE_COUNT * FACE_SLOTS), size = i / FACE_SLOTS % SIZE_COUNT, slot = i % FACE_SLOTS;
    return (struct entry){&table->glyphs[font][size][slot], face_glyph((enum font)font, slot),
                          sizes[size] * atlas->scale};
}

static void place_glyph(struct typesetter *setter, struct entry entry)
{
    const struct face_glyph *source = entry.source;
    struct glyph *glyph = entry.glyph;
    int x0, y0, x1, y1;
    face_glyph_box(source->source, source->index, entry.em, &x0, &y0, &x1, &y1);
    glyph->advance = source->advance * entry.em;
    if (x1 <= x0 || y1 <= y0) return;
    int width = x1 - x0 + FACE_OVERSAMPLE - 1;
    set_type(setter, width, y1 - y0, glyph);
    glyph->xoff = (float)x0 / FACE_OVERSAMPLE;
    glyph->xoff2 = (float)(x0 + width) / FACE_OVERSAMPLE;
    glyph->yoff = (float)y0;
    glyph->yoff2 = (float)y1;
}

static void rasterise_glyph(struct atlas *atlas, struct entry entry)
{
    struct glyph *glyph = entry.glyph;
    if (glyph->x1 == glyph->x0) return;
    unsigned char *out = atlas->coverage + (size_t)glyph->y0 * (size_t)atlas->width + glyph->x0;
    float shift = face_rasterise(entry.source->source, entry.source->index, entry.em, out, glyph->x1 - glyph->x0,
                                 glyph->y1 - glyph->y0, atlas->width);
    glyph->xoff += shift;
    glyph->xoff2 += shift;
}

/// Light text on dark looks thinner than it is: coverage^0.85, measured by eye.
static void thicken(struct atlas *atlas)
{
    unsigned char curve[256];
    for (int i = 0; i < 256; i++) curve[i] = (unsigned char)lroundf(255.0f * powf((float)i / 255.0f, 0.85f));
    size_t texels = (size_t)atlas->width * (size_t)atlas->height;
    for (size_t i = 0; i < texels; i++) atlas->coverage[i] = curve[atlas->coverage[i]];
}

bool atlas_build(float scale, struct atlas *atlas, struct error *error)
{
    struct typesetter setter = {.x = GAP + 1, .y = GAP + 1};
    struct glyph_table *table = need_zeroed(1, sizeof *table);
    *atlas = (struct atlas){.width = ATLAS_WIDTH, .scale = scale, .storage = table};
    for (int i = 0; i < ENTRY_COUNT; i++) place_glyph(&setter, table_entry(atlas, i));
    atlas->height = setter.y + setter.row_height + GAP;
    if (atlas->height > ATLAS_MAX_HEIGHT) {
        atlas_free(atlas);
        return fail(error, ERROR_ENVIRONMENT, "the fonts do not fit into a texture at scale %g", (double)scale);
    }
    atlas->coverage = need_zeroed((size_t)atlas->height, (size_t)atlas->width);
    for (int i = 0; i < ENTRY_COUNT; i++) rasterise_glyph(atlas, table_entry(atlas, i));
    atlas->coverage[0] = 255;
    thicken(atlas);
    return true;
}

void atlas_free(struct atlas *atlas)
{
    free(atlas->coverage);
    free(atlas->storage);
    *atlas = (struct atlas){0};
}

const struct glyph *atlas_glyph(const struct atlas *atlas, enum font font, float size, uint32_t codepoint)
{
    const struct glyph_table *table = atlas->storage;
    int nearest = 0;
    for (int i = 1; i < SIZE_COUNT; i++) {
        if (fabsf(sizes[i] - size) < fabsf(sizes[nearest] - size)) nearest = i;
    }
    return &table->glyphs[font][nearest][face_slot(codepoint)];
}
