/// Finds the parts of the frame that changed, as a few rectangles. Private to draw/. A grid divides the framebuffer, with the stage's
/// viewport on cell borders. A cell's hash combines the hashes of the stage there and of the commands that touch the cell, in painter's
/// order. Cells with a changed hash are merged into rectangles.
#ifndef DRAW_DAMAGE_H
#define DRAW_DAMAGE_H

#include "draw/area.h"
#include <stdint.h>

enum { DAMAGE_SIDE = 128, DAMAGE_RECTANGLES = 8 };

/// One direction of the grid: cells of equal size, cut at the viewport's edges.
struct damage_axis {
    int size, cell; ///< device pixels
    int cuts[2];
    int count;                  ///< of cells
    int edges[DAMAGE_SIDE + 1]; ///< cell i is [edges[i], edges[i + 1])
};

struct damage {
    uint64_t hashes[2][DAMAGE_SIDE * DAMAGE_SIDE]; ///< this frame's and the last one's, alternating
    int current;
    struct damage_axis columns, rows;
    bool known;                                ///< the last frame's hashes match the screen
    struct area rectangles[DAMAGE_RECTANGLES]; ///< disjoint, inside the framebuffer
    int count;
};

/// The stage below the list: its viewport, and the part that moves.
struct damage_stage {
    struct area viewport, moving;
    uint64_t hash, moving_hash; ///< of everything outside `moving`; of everything
};

/// Call when the framebuffer no longer holds the last frame. The next update redraws everything.
void damage_forget(struct damage *damage);

/// Compares a frame of width × height device pixels with the last one and fills `rectangles`, with the whole frame if the last one is
/// unknown. At most one rectangle touches the stage's viewport, because drawing the stage costs the same for any part of it.
void damage_update(struct damage *damage, int width, int height, float scale, const struct drawlist *list,
                   const struct damage_stage *stage);

#endif
