/// Soft characters on the stage: figures on the GPU, moved by complex morphs. Used by stage.c alone.
#ifndef DRAW_STAGE_MORPH_H
#define DRAW_STAGE_MORPH_H

#include "base/error.h"
#include "ui/stage.h"

struct stage_morph;

struct stage_morph *stage_morph_create(struct error *error);
void stage_morph_destroy(struct stage_morph *morph);

/// Whether what moves a figure fits into a texture of at most `largest` texels a side; false with a sentence that has the
/// figures.
bool stage_morph_fits(const struct figure *figure, int largest, struct error *error);

/// Uploads the figures that are seen for the first time, and what has changed of the others. Adds to `bytes`.
void stage_morph_upload(struct stage_morph *morph, const struct stage_view *view, long *bytes);

/// Draws the characters; `scale` is device pixels a logical one, `seam` as in stage_mesh.vert.
void stage_morph_draw(const struct stage_morph *morph, const struct stage_view *view, float scale, float seam);

#endif
