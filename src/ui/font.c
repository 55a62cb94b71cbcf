/// Loads fonts, measures text and rasterises glyphs.
#include "ui/font.h"
#include "base/embedded.h"
#include "ui/face.h"
#include <stb/stb_truetype.h>
#include <string.h>

struct face {
    stbtt_fontinfo info;
    float cap_height; ///< in ems
    struct face_glyph glyphs[FACE_SLOTS];
};

/// Read once at start-up and never written again.
static struct face faces[FONT_COUNT];

static const char *const file_names[FONT_COUNT] = {
    [FONT_LABEL] = "font/label",
    [FONT_LABEL_BOLD] = "font/label-bold",
    [FONT_NUMBER] = "font/number",
};

/// Ranges of characters with slots, in order: ASCII, Latin-1, Greek, and the symbols of the interface.
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

int face_slot(uint32_t codepoint)
{
    int slot = 0;
    for (int i = 0; i < RUN_COUNT; i++) {
        if (codepoint >= runs[i].first && codepoint <= runs[i].last) return slot + (int)(codepoint - runs[i].first);
        slot += (int)(runs[i].last - runs[i].first) + 1;
    }
    return '?' - 0x20;
}

static uint32_t codepoint_of(int slot)
{
    for (int i = 0; i < RUN_COUNT; i++) {
        int length = (int)(runs[i].last - runs[i].first) + 1;
        if (slot < length) return runs[i].first + (uint32_t)slot;
        slot -= length;
    }
    return 0;
}

const struct face_glyph *face_glyph(enum font font, int slot) { return &faces[font].glyphs[slot]; }

void face_glyph_box(enum font source, int index, float em, int *x0, int *y0, int *x1, int *y1)
{
    const stbtt_fontinfo *info = &faces[source].info;
    float scale = stbtt_ScaleForMappingEmToPixels(info, em);
    stbtt_GetGlyphBitmapBox(info, index, scale * FACE_OVERSAMPLE, scale, x0, y0, x1, y1);
}

float face_rasterise(enum font source, int index, float em, unsigned char *out, int width, int height, int stride)
{
    const stbtt_fontinfo *info = &faces[source].info;
    float scale = stbtt_ScaleForMappingEmToPixels(info, em);
    float shift_x = 0.0f, shift_y = 0.0f;
    stbtt_MakeGlyphBitmapSubpixelPrefilter(info, out, width, height, stride, scale * FACE_OVERSAMPLE, scale, 0.0f,
                                           0.0f, FACE_OVERSAMPLE, 1, &shift_x, &shift_y, index);
    return shift_x;
}

static bool read_face(enum font font, struct error *error)
{
    struct face *face = &faces[font];
    const struct embedded *file = embedded_find(file_names[font]);
    if (!file) return fail(error, ERROR_ENVIRONMENT, "%s: expected a font in the binary, got none", file_names[font]);
    int offset = stbtt_GetFontOffsetForIndex(file->data, 0);
    if (offset < 0 || !stbtt_InitFont(&face->info, file->data, offset)) {
        return fail(error, ERROR_ENVIRONMENT, "%s: expected an OpenType font, got something else", file_names[font]);
    }
    int x0, y0, x1, y1;
    float scale = stbtt_ScaleForMappingEmToPixels(&face->info, 1.0f);
    face->cap_height = stbtt_GetCodepointBox(&face->info, 'H', &x0, &y0, &x1, &y1) ? (float)y1 * scale : 0.7f;
    return true;
}

/// Which font has the character: the one asked for, else the others in turn; glyph 0 (a box) if none has.
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

bool font_init(struct error *error)
{
    for (int font = 0; font < FONT_COUNT; font++) {
        if (!read_face((enum font)font, error)) return false;
    }
    for (int font = 0; font < FONT_COUNT; font++) {
        for (int slot = 0; slot < FACE_SLOTS; slot++) {
            struct face_glyph glyph = find_glyph((enum font)font, codepoint_of(slot));
            faces[font].glyphs[slot] = glyph.index ? glyph : find_glyph((enum font)font, '?');
        }
    }
    return true;
}

float font_width(enum font font, float size, const char *utf8)
{
    float ems = 0.0f;
    for (uint32_t c; (c = utf8_next(&utf8)) != 0;) ems += faces[font].glyphs[face_slot(c)].advance;
    return ems * size;
}

float font_cap_height(enum font font, float size) { return faces[font].cap_height * size; }

size_t font_line(enum font font, float size, const char *utf8, float width)
{
    float ems = 0.0f;
    size_t fits = 0;
    const char *at = utf8;
    while (*at) {
        const uint32_t c = utf8_next(&at);
        size_t length = (size_t)(at - utf8);
        if (length >= 256) break;
        bool whole = *at == ' ' || *at == '\0';
        ems += faces[font].glyphs[face_slot(c)].advance;
        if (ems * size > width) return fits ? fits : length;
        if (whole) fits = length;
    }
    return fits ? fits : (size_t)(at - utf8);
}

enum { REPLACEMENT = 0xFFFD };

/// Number of bytes after a first byte, and its own bits; -1 if it cannot be a first byte.
static int continuation_bytes(unsigned char first, uint32_t *bits)
{
    if (first < 0x80) return *bits = first, 0;
    if (first >= 0xC2 && first <= 0xDF) return *bits = first & 0x1Fu, 1;
    if (first >= 0xE0 && first <= 0xEF) return *bits = first & 0x0Fu, 2;
    if (first >= 0xF0 && first <= 0xF4) return *bits = first & 0x07u, 3;
    return -1;
}

uint32_t utf8_next(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    if (*s == 0) return 0;
    uint32_t codepoint = 0;
    int count = continuation_bytes(*s, &codepoint);
    *text += 1;
    for (int i = 1; i <= count; i++) {
        if ((s[i] & 0xC0) != 0x80) return REPLACEMENT;
        codepoint = codepoint << 6 | (s[i] & 0x3Fu);
    }
    bool overlong = (count == 2 && codepoint < 0x800) || (count == 3 && codepoint < 0x10000);
    if (count < 0 || overlong || codepoint > 0x10FFFF || (codepoint >= 0xD800 && codepoint <= 0xDFFF))
        return REPLACEMENT;
    *text += count;
    return codepoint;
}
