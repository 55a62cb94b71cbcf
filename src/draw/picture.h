/// Pictures of the stage alone, drawn beside the frame on the screen and read back.
#ifndef DRAW_PICTURE_H
#define DRAW_PICTURE_H

#include "base/error.h"
#include "ui/stage.h"

struct picture;

/// Framebuffer and renderer for pictures of one size; a context must be current. NULL with a sentence.
struct picture *picture_create(int width, int height, struct error *error);
/// NULL is fine.
void picture_destroy(struct picture *picture);

/// Draws the stage over the whole picture: width·height·4 bytes, top row first, which stay until the next picture. Transparent: rigs alone,
/// without ground and shadows, and 0 where there is nothing.
const unsigned char *picture_draw(struct picture *picture, const struct stage_view *view, bool transparent);

#endif
