/// Pseudo-random numbers, the same in every run.
#ifndef TESTS_UNIFORM_H
#define TESTS_UNIFORM_H

#include <stdint.h>

/// From 0 to 1.
static inline double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

#endif
