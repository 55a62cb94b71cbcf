/// Motions with known content, as files.
#ifndef TESTS_PLANTED_H
#define TESTS_PLANTED_H

#include "model/motion.h"
#include "near.h"
#include "temporary.h"

/// In [-0.5, 0.5); reference.py uses the same.
static inline double noise(uint32_t *state)
{
    *state = 1664525u * *state + 1013904223u;
    return *state / 4294967296.0 - 0.5;
}

/// Value of column j at frame i.
typedef double sample(int i, int j, void *user);

/// Writes a motion in float64 and opens it.
static inline void make_motion(struct motion *motion, int frames, int vertices, sample *at, void *user)
{
    char header[128];
    int length = snprintf(header, sizeof header, "{'descr': '<f8', 'fortran_order': False, 'shape': (%d, %d, 3), }\n",
                          frames, vertices);
    const char start[] = {'\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, (char)length, 0};
    const char *path = temporary_path("analysis.npy");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(start, sizeof start, 1, file);
    fwrite(header, (size_t)length, 1, file);
    for (int i = 0; i < frames; i++) {
        for (int j = 0; j < 3 * vertices; j++) {
            double value = at(i, j, user);
            fwrite(&value, sizeof value, 1, file);
        }
    }
    fclose(file);
    assert_done(motion_open(motion, path, &error));
}

#endif
