/// Vectors of three doubles.
#ifndef SIMULATION_LINEAR_H
#define SIMULATION_LINEAR_H

#include <math.h>

static inline double vec3_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// out = a × b; out must be neither.
static inline void vec3_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/// The 3n numbers of n vectors.
static inline double *vec3_flat(double (*vectors)[3]) { return *vectors; }

static inline double vec3_length(const double a[3]) { return sqrt(vec3_dot(a, a)); }

#endif
