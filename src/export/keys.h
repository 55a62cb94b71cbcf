/// The keys of one rig, collected: what animation formats hold. Private to src/export.
#ifndef EXPORT_KEYS_H
#define EXPORT_KEYS_H

#include "export/form.h"

/// A row of numbers for each key: the translation of the root, the rotations of all joints, their scales, their offsets, the weights of all
/// targets. Rotations go the short way from key to key.
struct keys {
    int count, width, joints;
    float *rows;
    float *slopes; ///< how fast the curves change at the keys, by second; NULL unless the range is cubic
    bool travels;  ///< the translation changes
};

// Columns of a row.
static inline int keys_rotation(int joint) { return 3 + 4 * joint; }
static inline int keys_scale(const struct keys *keys, int joint) { return 3 + 4 * keys->joints + 3 * joint; }
static inline int keys_offset(const struct keys *keys, int joint) { return 3 + 7 * keys->joints + 3 * joint; }
static inline int keys_weight(const struct keys *keys, int target) { return 3 + 10 * keys->joints + target; }

static inline const float *keys_at(const struct keys *keys, int key, int column)
{
    return keys->rows + (size_t)key * (size_t)keys->width + column;
}

/// Poses the rig at each key. False with a sentence, and nothing to free.
bool keys_collect(struct export_range *range, int rig, const struct form *form, struct keys *keys,
                  struct error *error);
void keys_free(struct keys *keys);

/// A quaternion and its negative are the same rotation: makes `q` the one nearer to `before`.
void keys_turn_short_way(const float before[4], float q[4]);

/// Makes the last row the first where they differ by next to nothing, as in a clip whose length is rounded.
void keys_close_loop(float *rows, int width, int count);

#endif
