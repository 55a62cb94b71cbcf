/// Turns a draw list into triangles. Private to draw/.
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "draw/batch.h"
#include "draw/line.h"
#include "ui/font.h"

struct painter {
    struct batch *batch;
    struct line_scratch *scratch;
    const struct atlas *atlas;
    float scale;
};

/// Adds every command that touches `area`, in order, clipped to it.
void paint_list(const struct painter *painter, const struct drawlist *list, struct area area);

/// Adds a line of text with its pen at (x, y) logical pixels, cut off at `clip`.
void paint_text(const struct painter *painter, const struct draw_command *command, const char *text,
                struct area clip);

#endif
