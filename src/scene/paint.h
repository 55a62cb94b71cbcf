/// Paint on a character: how much further and earlier each of its vertices swings than its model says.
///
///     Ñ' = Ñ e^{a + jψ}
///
/// for each coordinate Ñ of the model and each vertex. Zero changes nothing; a positive ψ leads; a never reverses a motion.
#ifndef SCENE_PAINT_H
#define SCENE_PAINT_H

#include "base/error.h"
#include <stddef.h>
#include <stdint.h>

/// The limits of a and |ψ| (radians) that a file may hold.
#define PAINT_MOST_SWELL 10.0f
#define PAINT_MOST_LEAD 1000.0f

struct paint {
    int coordinates, vertices; ///< of its model
    float (*values)[2];        ///< a and ψ at coordinate · vertices + vertex
    uint64_t version;          ///< new after every change; never repeats
};

/// Paint that changes nothing; NULL if memory runs out.
struct paint *paint_create(int coordinates, int vertices);
void paint_destroy(struct paint *paint);

/// A copy with the same version, for its values are the same; NULL if memory runs out.
struct paint *paint_copy(const struct paint *paint);

/// Whether it changes nothing at all.
bool paint_is_plain(const struct paint *paint);

/// Bytes that it takes; 0 for NULL.
size_t paint_bytes(const struct paint *paint);

/// New values for some vertices of one coordinate: what a brush does in one frame.
struct dab {
    int coordinate, count;
    const int *vertices;      ///< each at most once
    const float (*values)[2]; ///< a and ψ of each
};

/// What a stroke touches: some vertices of one coordinate, with their other values.
struct touched {
    int coordinate, count, capacity;
    int *vertices;
    float (*values)[2];
    int *place; ///< 1 + each vertex's index above, or 0; NULL once the stroke is over
};

/// Empty, with room for all vertices; NULL if memory runs out.
struct touched *touched_create(const struct paint *paint, int coordinate);
void touched_destroy(struct touched *touched);

/// Puts a dab into the paint and keeps the values from before the stroke.
void touched_dab(struct touched *touched, struct paint *paint, const struct dab *dab);

/// Swaps its values with the paint's.
void touched_swap(struct touched *touched, struct paint *paint);

/// Ends the stroke: frees the room that it did not need.
void touched_settle(struct touched *touched);

/// Bytes that it takes.
size_t touched_bytes(const struct touched *touched);

#endif
