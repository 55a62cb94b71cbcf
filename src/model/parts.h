/// Soft shapes built of round cones (the hull of two balls) that blend into each other, each with its own
/// colour. Distances are for isosurface.h.
#ifndef MODEL_PARTS_H
#define MODEL_PARTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// A round cone, metres; mirrored parts are given for x > 0.
struct part {
    float a[3], b[3];
    float radius_a, radius_b;
    float blend;    ///< width of the fillet to the parts before it
    uint32_t color; ///< sRGB 0xRRGGBB
    bool mirror;
};

/// Smooth minimum of two distances (polynomial, with a fillet `blend` wide); colours mix in the same measure, into
/// `rgb`, where that is not NULL.
float parts_union(float old, float added, float blend, float rgb[3], const float added_rgb[3]);

/// Adds the parts of a table, in their order, to a solid at distance `distance` (1e3: none yet): returns the distance of
/// all of them from `p`, and in `rgb`, if not NULL, the linear colour there.
float parts_add(const struct part *table, size_t count, const float p[3], float distance, float rgb[3]);

#endif
