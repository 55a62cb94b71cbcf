/// The materials of a soft character on the GPU, and which triangles have them. Private to the stage's files of draw/.
#ifndef DRAW_MORPH_LOOKS_H
#define DRAW_MORPH_LOOKS_H

#include "draw/gl.h"
#include "model/figure.h"

/// Triangles of one material, one after the other.
struct morph_range {
    GLsizei first, count; ///< indices
    float color[4];       ///< linear, with opacity
    GLuint picture;
};

/// All zero: its materials are not to be seen.
struct morph_looks {
    GLuint *pictures; ///< of each material, and a white one
    int picture_count;
    struct morph_range *ranges[2]; ///< of the fine and of the coarse triangles
    int range_count;
};

/// Uploads pictures; returns their bytes.
long morph_looks_create(struct morph_looks *looks, const struct figure *figure);
void morph_looks_free(struct morph_looks *looks);

/// The fine or the coarse triangles material after material, with their ranges. The caller frees them.
uint32_t *morph_looks_sort(struct morph_looks *looks, const struct figure *figure, bool coarse);

#endif
