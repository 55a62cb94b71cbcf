/// Paint on a character: changes how far and how early each vertex swings.
///
///     Ñ' = Ñ e^{a + jψ}
///
/// for each coordinate Ñ of the model and each vertex. Zero changes nothing; a positive ψ leads; a never reverses a motion.
#ifndef SCENE_PAINT_H
#define SCENE_PAINT_H

#include "base/error.h"
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

/// The limits of a and |ψ| (radians) in a file.
#define PAINT_MOST_SWELL 10.0f
#define PAINT_MOST_LEAD 1000.0f

struct paint {
    atomic_int holders;        ///< rigs
    int coordinates, vertices; ///< of its model
    float (*values)[2];        ///< a and ψ at coordinate · vertices + vertex
    uint64_t version;          ///< new after every change; never repeats
};

/// Paint that changes nothing, with one holder.
struct paint *paint_create(int coordinates, int vertices);
struct paint *paint_hold(struct paint *paint);
/// NULL is fine.
void paint_drop(struct paint *paint);

/// Whether it changes nothing at all; and on one coordinate.
bool paint_is_plain(const struct paint *paint);
bool paint_is_plain_at(const struct paint *paint, int coordinate);

/// Whether a coordinate's values are within the limits; NaN is not.
bool paint_check(const struct paint *paint, int coordinate, struct error *error);

/// Bytes of memory; 0 for NULL.
size_t paint_bytes(const struct paint *paint);

/// New values for some vertices of one coordinate, as a brush makes them in a frame.
struct dab {
    int coordinate, count;
    const int *vertices;      ///< each at most once
    const float (*values)[2]; ///< a and ψ of each
};

/// Applies a dab to the paint; shared paint is copied first.
void paint_dab(struct paint **paint, const struct dab *dab);

/// Reads an .npy file of shape (coordinates, vertices, 2). float64, big endian and Fortran order are read, too. NULL with a sentence that names the file, what was
/// expected and what was there.
struct paint *paint_read(const char *path, struct error *error);

/// Writes an .npy file, whole or not at all.
bool paint_write(const struct paint *paint, const char *path, struct error *error);

#endif
