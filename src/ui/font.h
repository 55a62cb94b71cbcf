/// Embedded fonts, text metrics, and glyph bitmaps. No GL.
#ifndef UI_FONT_H
#define UI_FONT_H

#include "base/error.h"
#include "ui/drawlist.h"

/// Reads the fonts; call once before any layout.
void font_init(void);

/// Width of a text in logical pixels; the second is the height of its capitals, for centring.
float font_width(enum font font, float size, const char *utf8);
float font_cap_height(enum font font, float size);
/// Takes the next line of a label, as many bytes as fit into `width`, up to a space if possible, at least one character. Moves `*utf8` to
/// the next line.
size_t font_take_line(float size, float width, const char **utf8);

/// A glyph: texels [x0, x1) × [y0, y1), drawn at pen + (xoff, yoff) device pixels, y down.
struct glyph {
    unsigned short x0, y0, x1, y1;
    float xoff, yoff, xoff2, yoff2; ///< corners relative to the pen, in device pixels
    float advance;                  ///< device pixels
};

/// Glyphs of all fonts in the theme's sizes at one scale: 8-bit coverage, a white texel at (0, 0).
struct atlas {
    unsigned char *coverage; ///< width × height
    int width, height;
    float scale;
    struct glyph *glyphs; ///< by font, size and slot
};

/// Rasterises with stb_truetype, 3×1 oversampling. Free it with atlas_free().
bool atlas_build(float scale, struct atlas *atlas, struct error *error);
void atlas_free(struct atlas *atlas);
/// A character's glyph at the nearest rasterised size; '?' if no font has it.
const struct glyph *atlas_glyph(const struct atlas *atlas, enum font font, float size, uint32_t codepoint);

#endif
