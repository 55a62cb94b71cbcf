/// Fonts: the embedded files, metrics for layout, and glyph bitmaps for drawing. No GL.
#ifndef UI_FONT_H
#define UI_FONT_H

#include "base/error.h"
#include "ui/drawlist.h"

/// Reads the embedded fonts; once at start-up. Layout works from here on.
void font_init(void);

/// Width of a text in logical pixels, and the height of its capitals (for centring).
float font_width(enum font font, float size, const char *utf8);
float font_cap_height(enum font font, float size);
/// Bytes of the next line of a text that fit into `width`, ending at a space if possible; at least one character. The text moves on to the
/// line after.
size_t font_take_line(enum font font, float size, float width, const char **utf8);

/// One rasterised glyph of an atlas: texels [x0, x1) × [y0, y1), drawn at pen + (xoff, yoff) device pixels, y down.
struct glyph {
    unsigned short x0, y0, x1, y1;
    float xoff, yoff, xoff2, yoff2; ///< corners relative to the pen, in device pixels
    float advance;                  ///< device pixels
};

/// Glyphs of all fonts at the pixel sizes that the theme uses, for one scale: 8-bit coverage, white texel at (0, 0).
struct atlas {
    unsigned char *coverage; ///< width × height
    int width, height;
    float scale;
    void *storage; ///< private
};

/// Rasterises (stb_truetype, 3×1 oversampling, coverage^0.85 for light text on dark). Freed with atlas_free().
bool atlas_build(float scale, struct atlas *atlas, struct error *error);
void atlas_free(struct atlas *atlas);
/// The glyph of a character at a logical size (the nearest size that was rasterised); '?' if the font lacks it.
const struct glyph *atlas_glyph(const struct atlas *atlas, enum font font, float size, uint32_t codepoint);

#endif
