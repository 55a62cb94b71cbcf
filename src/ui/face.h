/// The fonts as they were read, shared by layout (font.c) and rasterisation (atlas.c). Private to ui/.
#ifndef UI_FACE_H
#define UI_FACE_H

#include "ui/drawlist.h"

/// Every character the program can show has a slot: an index into tables, the same for all fonts.
enum { FACE_SLOTS = 291 };

/// A character's glyph, from another font if this one lacks it.
struct face_glyph {
    enum font source;
    int index;     ///< glyph in the source's file
    float advance; ///< in ems
};

/// The slot of a character, or that of '?'.
int face_slot(uint32_t codepoint);
const struct face_glyph *face_glyph(enum font font, int slot);

/// Bitmap of a glyph at `em` pixels an em, three times oversampled across: the box in oversampled pixels, y down.
void face_glyph_box(enum font source, int index, float em, int *x0, int *y0, int *x1, int *y1);

enum { FACE_OVERSAMPLE = 3 };

/// Rasterises into `width` × `height` bytes at `out` (rows `stride` apart): the box of face_glyph_box() and two columns more
/// for the filter that makes three samples one pixel. Returns how far the picture is shifted, in pixels.
float face_rasterise(enum font source, int index, float em, unsigned char *out, int width, int height, int stride);

#endif
