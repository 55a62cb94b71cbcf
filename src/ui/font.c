/// Loads fonts, measures text, and packs all glyphs into one texture.
#include "ui/font.h"
#include "base/embedded.h"
#include "base/need.h"
#include "ui/theme.h"
#include <math.h>
#include <stdlib.h>

// The library does not compile with our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STBTT_malloc(size, user) ((void)(user), need(size, 1))
#define STBTT_free(piece, user) ((void)(user), free(piece))
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

/// Every supported character has a slot, an index common to all fonts.
enum { SLOTS = 291, OVERSAMPLE = 3 };

struct face {
    stbtt_fontinfo info;
    float cap_height; ///< in ems
    struct face_glyph {
        enum font source; ///< another font if this one lacks the character
        int index;        ///< in the source's file
        float advance;    ///< in ems
    } glyphs[SLOTS];
};

/// Read-only after start-up.
static struct face faces[FONT_COUNT];

static const char *const file_names[FONT_COUNT] = {
    [FONT_LABEL] = "font/label",
    [FONT_LABEL_BOLD] = "font/label-bold",
    [FONT_NUMBER] = "font/number",
};

/// Characters with slots, in order: ASCII, Latin-1, Greek, interface symbols.
static const struct {
    uint32_t first, last;
} runs[] = {
    {0x20, 0x7E},     {0xA0, 0xFF},     {0x391, 0x3A1},   {0x3A3, 0x3C9},   {0x2010, 0x2015}, {0x2018, 0x201E},
    {0x2022, 0x2022}, {0x2026, 0x2026}, {0x2032, 0x2033}, {0x20AC, 0x20AC}, {0x2190, 0x2195}, {0x21A9, 0x21AA},
    {0x21E7, 0x21E7}, {0x2202, 0x2202}, {0x221A, 0x221A}, {0x221E, 0x221E}, {0x2212, 0x2212}, {0x2248, 0x2248},
    {0x2260, 0x2260}, {0x2264, 0x2265}, {0x2303, 0x2303}, {0x25A0, 0x25A0}, {0x25B2, 0x25B2}, {0x25B6, 0x25B6},
    {0x25BC, 0x25BC}, {0x25C6, 0x25C7}, {0x25CF, 0x25CF}, {0x2713, 0x2713},
};
enum { RUN_COUNT = sizeof runs / sizeof runs[0] };

/// A character's slot, or that of '?'.
static int slot_of(uint32_t codepoint)
{
    int slot = 0;
    for (int i = 0; i < RUN_COUNT; i++) {
        if (codepoint >= runs[i].first && codepoint <= runs[i].last) return slot + (int)(codepoint - runs[i].first);
        slot += (int)(runs[i].last - runs[i].first) + 1;
    }
    return '?' - 0x20;
}

/// Finds a character in the font, else in the others; glyph 0 (a box) if none has it.
static struct face_glyph find_glyph(enum font font, uint32_t codepoint)
{
    struct face_glyph glyph = {.source = font, .index = 0};
    for (int i = 0; i < FONT_COUNT && glyph.index == 0; i++) {
        enum font source = (enum font)(((int)font + i) % FONT_COUNT);
        glyph.index = stbtt_FindGlyphIndex(&faces[source].info, (int)codepoint);
        if (glyph.index) glyph.source = source;
    }
    int advance = 0;
    stbtt_GetGlyphHMetrics(&faces[glyph.source].info, glyph.index, &advance, NULL);
    glyph.advance = (float)advance * stbtt_ScaleForMappingEmToPixels(&faces[glyph.source].info, 1.0f);
    return glyph;
}

void font_init(void)
{
    for (int font = 0; font < FONT_COUNT; font++) {
        struct face *face = &faces[font];
        int x0, y0, x1, y1;
        stbtt_InitFont(&face->info, embedded_find(file_names[font])->data, 0);
        const float scale = stbtt_ScaleForMappingEmToPixels(&face->info, 1.0f);
        const bool has = stbtt_GetCodepointBox(&face->info, 'H', &x0, &y0, &x1, &y1);
        face->cap_height = has ? (float)y1 * scale : 0.7f;
    }
    for (int font = 0; font < FONT_COUNT; font++) {
        struct face_glyph *at = faces[font].glyphs;
        for (int i = 0; i < RUN_COUNT; i++) {
            for (uint32_t codepoint = runs[i].first; codepoint <= runs[i].last; codepoint++) {
                const struct face_glyph glyph = find_glyph((enum font)font, codepoint);
                *at++ = glyph.index ? glyph : find_glyph((enum font)font, '?');
            }
        }
    }
}

float font_width(enum font font, float size, const char *utf8)
{
    float ems = 0.0f;
    for (uint32_t c; (c = utf8_next(&utf8)) != 0;) ems += faces[font].glyphs[slot_of(c)].advance;
    return ems * size;
}

float font_cap_height(enum font font, float size) { return faces[font].cap_height * size; }

size_t font_take_line(float size, float width, const char **utf8)
{
    enum { MOST = 255 };
    float ems = 0.0f;
    size_t length = 0, fits = 0;
    for (const char *at = *utf8; *at && length <= MOST && ems * size <= width;) {
        ems += faces[FONT_LABEL].glyphs[slot_of(utf8_next(&at))].advance;
        length = (size_t)(at - *utf8);
        if ((*at == ' ' || !*at) && length <= MOST && ems * size <= width) fits = length;
    }
    if (fits > 0) length = fits;
    *utf8 += length;
    while (**utf8 == ' ') ++*utf8;
    return length;
}

// The atlas.

enum { SIZE_COUNT = 3, ATLAS_WIDTH = 2048, ATLAS_MAX_HEIGHT = 8192, GAP = 1 };

static const float sizes[SIZE_COUNT] = {THEME_TEXT_SMALL, THEME_TEXT_NORMAL, THEME_TEXT_TITLE};

enum { ENTRY_COUNT = FONT_COUNT * SIZE_COUNT * SLOTS };

struct entry {
    struct glyph *glyph;
    const struct face_glyph *source;
    const stbtt_fontinfo *info;
    float em, scale; ///< device pixels; device pixels per font unit
};

static struct entry table_entry(const struct atlas *atlas, int i)
{
    const int font = i / (SIZE_COUNT * SLOTS), size = i / SLOTS % SIZE_COUNT;
    struct entry entry = {.glyph = &atlas->glyphs[i], .source = &faces[font].glyphs[i % SLOTS]};
    entry.info = &faces[entry.source->source].info;
    entry.em = sizes[size] * atlas->scale;
    entry.scale = stbtt_ScaleForMappingEmToPixels(entry.info, entry.em);
    return entry;
}

bool atlas_build(float scale, struct atlas *atlas, struct error *error)
{
    int x = GAP + 1, y = GAP + 1, row_height = 0;
    *atlas = (struct atlas){.width = ATLAS_WIDTH, .scale = scale};
    atlas->glyphs = need_zeroed(ENTRY_COUNT, sizeof *atlas->glyphs);

    // Glyphs lie in rows, each below the tallest glyph of the last, with a gap on all sides, so that filtering never mixes neighbours.
    // Three samples across make a pixel; their filter needs two more columns.
    for (int i = 0; i < ENTRY_COUNT; i++) {
        const struct entry entry = table_entry(atlas, i);
        struct glyph *glyph = entry.glyph;
        int x0, y0, x1, y1;
        stbtt_GetGlyphBitmapBox(entry.info, entry.source->index, entry.scale * OVERSAMPLE, entry.scale, &x0, &y0, &x1,
                                &y1);
        glyph->advance = entry.source->advance * entry.em;
        if (x1 <= x0 || y1 <= y0) continue;
        const int width = x1 - x0 + OVERSAMPLE - 1, height = y1 - y0;
        if (x + width + GAP > ATLAS_WIDTH) {
            x = GAP;
            y += row_height + GAP;
            row_height = 0;
        }
        glyph->x0 = (unsigned short)x;
        glyph->y0 = (unsigned short)y;
        glyph->x1 = (unsigned short)(x + width);
        glyph->y1 = (unsigned short)(y + height);
        x += width + GAP;
        if (height > row_height) row_height = height;
        glyph->xoff = (float)x0 / OVERSAMPLE;
        glyph->xoff2 = (float)(x0 + width) / OVERSAMPLE;
        glyph->yoff = (float)y0;
        glyph->yoff2 = (float)y1;
    }
    atlas->height = y + row_height + GAP;
    if (atlas->height > ATLAS_MAX_HEIGHT) {
        atlas_free(atlas);
        return fail(error, ERROR_ENVIRONMENT, "the fonts do not fit into a texture at scale %g", (double)scale);
    }
    atlas->coverage = need_zeroed((size_t)atlas->height, (size_t)atlas->width);
    atlas->coverage[0] = 255;
    for (int i = 0; i < ENTRY_COUNT; i++) {
        const struct entry entry = table_entry(atlas, i);
        struct glyph *glyph = entry.glyph;
        float shift_x = 0, shift_y = 0;
        if (glyph->x1 == glyph->x0) continue;
        unsigned char *out = atlas->coverage + (size_t)glyph->y0 * (size_t)atlas->width + glyph->x0;
        stbtt_MakeGlyphBitmapSubpixelPrefilter(entry.info, out, glyph->x1 - glyph->x0, glyph->y1 - glyph->y0,
                                               atlas->width, entry.scale * OVERSAMPLE, entry.scale, 0, 0, OVERSAMPLE,
                                               1, &shift_x, &shift_y, entry.source->index);
        glyph->xoff += shift_x;
        glyph->xoff2 += shift_x;
    }

    // Light text on dark looks too thin: coverage^0.85, chosen by eye.
    unsigned char curve[256];
    for (int i = 0; i < 256; i++) curve[i] = (unsigned char)lroundf(255.0f * powf((float)i / 255.0f, 0.85f));
    const size_t texels = (size_t)atlas->width * (size_t)atlas->height;
    for (size_t i = 0; i < texels; i++) atlas->coverage[i] = curve[atlas->coverage[i]];
    return true;
}

void atlas_free(struct atlas *atlas)
{
    free(atlas->coverage);
    free(atlas->glyphs);
    *atlas = (struct atlas){0};
}

const struct glyph *atlas_glyph(const struct atlas *atlas, enum font font, float size, uint32_t codepoint)
{
    int nearest = 0;
    for (int i = 1; i < SIZE_COUNT; i++) {
        if (fabsf(sizes[i] - size) < fabsf(sizes[nearest] - size)) nearest = i;
    }
    return &atlas->glyphs[((int)font * SIZE_COUNT + nearest) * SLOTS + slot_of(codepoint)];
}
