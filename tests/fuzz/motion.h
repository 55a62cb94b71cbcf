/// Reads a motion to its end.
#ifndef TESTS_FUZZ_MOTION_H
#define TESTS_FUZZ_MOTION_H

#include "fuzz.h"
#include "model/motion.h"
#include <math.h>
#include <stdlib.h>

/// Opens a file and reads all columns, some at a time.
static inline void fuzz_motion(const char *path)
{
    struct error error = {0};
    struct motion motion;
    bool good = motion_open(&motion, path, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a motion is refused with a sentence");
    if (!good) return;
    const int columns = 3 * motion.vertices;
    for (int first = 0; good && first < columns; first += 8) {
        const int count = columns - first < 8 ? columns - first : 8;
        const size_t numbers = (size_t)count * (size_t)motion.frames;
        double *slab = malloc(numbers * sizeof *slab);
        good = motion_columns(&motion, first, count, slab, &error);
        for (size_t i = 0; good && i < numbers; i++) fuzz_expect(isfinite(slab[i]), "what is read is finite");
        free(slab);
    }
    motion_close(&motion);
}

#endif
