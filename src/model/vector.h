/// Vectors and matrices of floats are cglm's. They go by value, because its functions on arrays take no const ones.
#ifndef MODEL_VECTOR_H
#define MODEL_VECTOR_H

#include "maths/maths.h"
#include <math.h>
#include <string.h>

#define CGLM_ALL_UNALIGNED // ours lie in arrays of vertices and on the heap
#define sinf maths_sinf
#define cosf maths_cosf
#define tanf maths_tanf
#include <cglm/struct.h>
#undef sinf
#undef cosf
#undef tanf

static inline vec3s vec3_from(const float v[3]) { return (vec3s){.raw = {v[0], v[1], v[2]}}; }

static inline mat4s mat4_from(const float m[16])
{
    mat4s matrix;
    memcpy(&matrix, m, sizeof matrix);
    return matrix;
}

/// The rotation by a unit quaternion x y z w, column after column.
static inline void quat_matrix(const double q[4], double m[9])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turned[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),
                              2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                              2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y)};
    memcpy(m, turned, sizeof turned);
}

/// (b − a) × (c − a): a triangle's normal, twice its area long.
static inline vec3s triangle_normal(const float a[3], const float b[3], const float c[3])
{
    const vec3s from = vec3_from(a);
    return glms_vec3_cross(glms_vec3_sub(vec3_from(b), from), glms_vec3_sub(vec3_from(c), from));
}

/// The inverse; of a flat matrix, as of a bone with scale 0, the inverse along the axes that are left.
static inline mat3s mat3_inverse(mat3s m)
{
    const float det = glms_mat3_det(m);
    if (det != 0.0f && isfinite(1.0f / det)) return glms_mat3_inv(m);
    mat3s inverse = glms_mat3_zero();
    for (int k = 0; k < 3; k++) {
        const float length2 = glms_vec3_norm2(m.col[k]);
        if (!isfinite(1.0f / length2)) continue;
        for (int i = 0; i < 3; i++) inverse.col[i].raw[k] = m.col[k].raw[i] / length2;
    }
    return inverse;
}

#endif
