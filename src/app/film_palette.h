/// Chooses few colors for a picture and draws it with them. Private to src/app.
#ifndef APP_FILM_PALETTE_H
#define APP_FILM_PALETTE_H

#include <stdbool.h>

enum { PALETTE_COLORS = 255 };

struct palette {
    unsigned char colors[PALETTE_COLORS][3]; ///< by rising green
    int count;
};

struct palette_maker;

/// For pictures of up to `width` × `height` pixels.
struct palette_maker *palette_maker_create(int width, int height);
void palette_maker_destroy(struct palette_maker *maker);

/// A picture's pixels that are to be drawn.
struct palette_picture {
    const unsigned char *pixels; ///< four bytes each
    const bool *drawn;           ///< one per pixel
    int width, height;
};

/// The colors that suit the drawn pixels best.
void palette_choose(struct palette_maker *maker, const struct palette_picture *picture, struct palette *palette);

/// Writes the index of a color for each drawn pixel. Neighbours make up for what a color is off by.
void palette_draw(struct palette_maker *maker, const struct palette_picture *picture, const struct palette *palette,
                  unsigned char *indices);

#endif
