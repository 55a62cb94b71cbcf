/// What lies flat on the stage: background, ground and contact shadows, as a few quads of one shader. For stage.c
/// alone.
#ifndef DRAW_STAGE_FLAT_H
#define DRAW_STAGE_FLAT_H

#include "base/error.h"
#include "ui/stage.h"

struct stage_flat;

struct stage_flat *stage_flat_create(struct error *error);
void stage_flat_destroy(struct stage_flat *flat);

/// Makes this frame's quads and uploads them; returns how many bytes that were.
long stage_flat_upload(struct stage_flat *flat, const struct stage_view *view);

/// Covers the viewport, whose lowest row is `y`, with the caller's blend function. Leaves blending off.
void stage_flat_draw(const struct stage_flat *flat, int y, int height);

#endif
