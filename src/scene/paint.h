/// Paint on a character: how much further and earlier each of its vertices swings than its model says.
///
///     Ñ' = Ñ e^{a + jψ}
///
/// for each coordinate Ñ of the model and each vertex. Zero changes nothing; a positive ψ leads; no a turns a motion round.
#ifndef SCENE_PAINT_H
#define SCENE_PAINT_H

#include "base/error.h"
#include <stddef.h>
#include <stdint.h>

/// The limits of a and |ψ| (radians) that a file may hold.
#define PAINT_MOST_SWELL 10.0f
#define PAINT_MOST_LEAD 1000.0f

struct paint {
    int coordinates, vertices; ///< of the model that it is for
    float (*values)[2];        ///< a and ψ at coordinate · vertices + vertex
    uint64_t version;          ///< another one after every change; never repeats
};

/// Paint that changes nothing; NULL where memory is short.
struct paint *paint_create(int coordinates, int vertices);
void paint_destroy(struct paint *paint);

/// Whether it changes nothing at all.
bool paint_is_plain(const struct paint *paint);

/// Memory that it takes; of NULL none.
size_t paint_bytes(const struct paint *paint);

/// New values of some vertices of one coordinate: what one moment of a brush makes.
struct dab {
    int coordinate, count;
    const int *vertices;      ///< each at most once
    const float (*values)[2]; ///< a and ψ of each
};

/// What a stroke has touched: the other values of some vertices of one coordinate.
struct touched {
    int coordinate, count, capacity;
    int *vertices;
    float (*values)[2];
    int *place; ///< 1 + where a vertex is above, 0: nowhere; NULL once the stroke is over
};

/// Nothing yet, with room for all vertices; NULL where memory is short.
struct touched *touched_create(const struct paint *paint, int coordinate);
void touched_destroy(struct touched *touched);

/// Puts a dab into the paint and keeps the values that were there before the stroke.
void touched_dab(struct touched *touched, struct paint *paint, const struct dab *dab);

/// Swaps its values with the paint's.
void touched_swap(struct touched *touched, struct paint *paint);

/// The stroke is over: gives back the room that it did not need.
void touched_settle(struct touched *touched);

/// Memory that it takes.
size_t touched_bytes(const struct touched *touched);

#endif
