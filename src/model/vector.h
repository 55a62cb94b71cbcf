/// Vectors and matrices of floats are cglm's. Its functions on arrays take no const ones, so that vectors go by value.
#ifndef MODEL_VECTOR_H
#define MODEL_VECTOR_H

#define CGLM_ALL_UNALIGNED // ours lie in arrays of vertices and on the heap
#include <cglm/struct.h>

static inline float vector_dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// out = a × b; out must be neither.
static inline void vector_cross(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/// (b − a) × (c − a): a triangle's normal, twice its area long.
static inline void triangle_normal(const float a[3], const float b[3], const float c[3], float normal[3])
{
    const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    vector_cross(u, v, normal);
}

#endif
