/// The vertices of a glTF file: one for each pair of a vertex and its texture coordinates. Private to the writer of characters.
#ifndef MODEL_GLB_SPLIT_H
#define MODEL_GLB_SPLIT_H

#include "model/character.h"

/// The character's vertices come first, in their order; copies of those with several texture coordinates follow.
struct split {
    int count;
    uint32_t *source;  ///< per vertex of the file: the character's
    uint32_t *indices; ///< as many as the character's, in their order
    float (*uv)[2];    ///< NULL: none
};

/// False where memory is short.
bool split_create(struct split *split, const struct character *character);
void split_free(struct split *split);

#endif
