/// What draws all rigs of one kind that are on the stage. Used by stage.c alone.
#ifndef DRAW_PAINTER_H
#define DRAW_PAINTER_H

#include "base/error.h"
#include "ui/stage.h"

struct painter {
    void *(*create)(struct error *error); ///< its state; NULL with a sentence
    void (*destroy)(void *state);
    /// Uploads what is new in this frame; adds to `bytes`. Allocates nothing but for what is seen for the first time.
    void (*upload)(void *state, const struct stage_view *view, long *bytes);
    /// `scale` is device pixels a logical one, `seam` as in stage_mesh.vert.
    void (*draw)(const void *state, const struct stage_view *view, float scale, float seam);
};

extern const struct painter tail_painter, character_painter;

#endif
