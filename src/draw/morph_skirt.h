/// The skirts of soft characters. Private to the stage's files of draw/.
#ifndef DRAW_MORPH_SKIRT_H
#define DRAW_MORPH_SKIRT_H

#include "draw/morph_looks.h"
#include "draw/stage_skirt.h"

/// What of a figure's outlines is kept.
struct morph_skirt {
    uint32_t *sorted
        [2]; ///< of the fine and of the coarse triangles, as morph_looks_sort() has them; NULL: as the figure has them
    int *neighbours[2];
    float (*place)[3]; ///< of each vertex
    bool *front;       ///< of each triangle
};

/// `sorted` are set, and stay its own.
void morph_skirt_create(struct morph_skirt *skirt, const struct figure *figure, const struct morph_looks *looks);
void morph_skirt_free(struct morph_skirt *skirt);

/// Draws those of a character; with pictures where it has ranges.
void morph_skirt_draw(const struct morph_skirt *skirt, const struct stage_skirt *program,
                      const struct stage_view *view, const struct stage_character *shown,
                      const struct morph_looks *looks, float seam);

#endif
