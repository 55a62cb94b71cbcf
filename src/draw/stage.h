/// The stage's renderer: background, ground, contact shadows and rigs. Private to draw/, for draw.c alone.
#ifndef DRAW_STAGE_H
#define DRAW_STAGE_H

#include "base/error.h"
#include "ui/stage.h"

struct stage_renderer;

struct stage_renderer *stage_renderer_create(struct error *error);
void stage_renderer_destroy(struct stage_renderer *renderer);

/// Uploads what `view` needs: joint matrices, ground and shadows; meshes were made once. Adds to `bytes`. Allocates
/// nothing.
void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes);

/// Draws what was uploaded into a rectangle of the framebuffer (device pixels; x, y from the bottom left, as in
/// GL), scissored by the caller. Clears depth itself. Leaves depth test, culling and blending off.
void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height);

/// The rigs alone, over the whole of a framebuffer, without the soft edges that blend into what is behind.
void stage_draw_rigs(struct stage_renderer *renderer, const struct stage_view *view, int width, int height);

/// Whether a figure's coordinates fit a texture of at most `largest` texels a side; if not, false with a sentence that
/// gives the numbers.
bool stage_morph_fits(const struct figure *figure, int largest, struct error *error);

#endif
