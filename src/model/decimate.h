/// Fewer triangles over the same vertices: whatever the vertices carry stays as it is.
#ifndef MODEL_DECIMATE_H
#define MODEL_DECIMATE_H

#include "model/character.h"

/// Writes at most `triangles` triangles (more if the surface would fold or open) that look like
/// the character's own to `indices`, which has room for all of those. Vertices collapse onto neighbours, starting with those
/// that change shape and colour least. `sources` (NULL: nobody asks) says which of the character's triangles each was.
void decimate(const struct character *character, int triangles, uint32_t *indices, uint32_t *sources,
              int *index_count);

#endif
