/// The parts of the frame that changed since the last one, as a few rectangles. Private to draw/.
///
/// The framebuffer is divided into cells, with the stage's viewport on their borders. A cell's hash combines, in painter's
/// order, the hashes of what is on the stage there and of the commands that touch it. Cells whose hash is not the last
/// frame's are gathered into rectangles.
#ifndef DRAW_DAMAGE_H
#define DRAW_DAMAGE_H

#include "draw/area.h"
#include <stdint.h>

enum { DAMAGE_SIDE = 128, DAMAGE_RECTANGLES = 8 };

/// One direction of the grid: equal cells, two of them cut where the viewport begins and ends.
struct damage_axis {
    int size, cell; ///< device pixels
    int cuts[2];
    int count;                  ///< of cells
    int edges[DAMAGE_SIDE + 1]; ///< cell i is [edges[i], edges[i + 1])
};

struct damage {
    uint64_t hashes[2][DAMAGE_SIDE * DAMAGE_SIDE]; ///< this frame's and the last one's, taking turns
    int current;
    struct damage_axis columns, rows;
    bool known;                                ///< the last frame's hashes match the screen
    struct area rectangles[DAMAGE_RECTANGLES]; ///< disjoint, inside the framebuffer
    int count;
};

/// The stage below the list: its viewport, and the extent of its motion.
struct damage_stage {
    struct area viewport, moving;
    uint64_t hash, moving_hash; ///< of everything outside `moving`; of all
};

/// Call when the framebuffer no longer holds the last frame: the next update redraws everything.
void damage_forget(struct damage *damage);

/// Compares a frame of width × height device pixels with the last one and fills `rectangles`: the whole frame where the
/// last one is unknown. At most one rectangle touches the stage's viewport, because drawing it costs the same
/// however little of it shows.
void damage_update(struct damage *damage, int width, int height, float scale, const struct drawlist *list,
                   const struct damage_stage *stage);

#endif
