/// Finds the lowest and highest of any range of samples without looking at each, for curves of millions of samples.
#ifndef SCENE_EXTREMES_H
#define SCENE_EXTREMES_H

#include <stdbool.h>
#include <stddef.h>

enum { EXTREMES_BLOCK = 128 };

/// The lowest and highest of every EXTREMES_BLOCK numbers; NULL: unknown.
struct extremes {
    double *low, *high;
};

/// Length of each of the two arrays for that many samples.
size_t extremes_blocks(int samples);

/// Updates the blocks that hold any of `count` numbers from `first` on; all of them: 0, samples.
void extremes_update(const struct extremes *extremes, const double *numbers, int samples, int first, int count);

/// The sample of the lowest (or highest) number from `first` to `last`, both included; the earliest of equal ones.
int extremes_find(const struct extremes *extremes, const double *numbers, int first, int last, bool highest);

#endif
