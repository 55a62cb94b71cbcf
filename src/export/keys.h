/// The keys of one rig, collected: what animation formats hold. Private to src/export.
#ifndef EXPORT_KEYS_H
#define EXPORT_KEYS_H

#include "export/form.h"

/// Values at all keys; or how fast they change there, by second.
struct key_values {
    float (*translation)[3]; ///< of the root
    float (*rotation)[4];    ///< [joint · count + key], the short way from key to key
    float (*scale)[3];       ///< [joint · count + key]
    float *weight;           ///< [target · count + key]
};

struct keys {
    int count;
    struct key_values at;
    struct key_values slope; ///< of the curve itself; all NULL unless the range is cubic
    bool travels;            ///< the translation changes
};

/// Poses the rig at each key. False with a sentence, and nothing to free.
bool keys_collect(struct export_range *range, int rig, const struct form *form, struct keys *keys,
                  struct error *error);
void keys_free(struct keys *keys);

/// A quaternion and its negative are the same rotation: makes `q` the one nearer to `before`.
void keys_turn_short_way(const float before[4], float q[4]);

/// Makes the last row the first where they differ by next to nothing, as in a clip whose length is rounded.
void keys_close_loop(float *rows, int width, int count);

#endif
