/// The lowest and highest of any stretch of samples without a look at each: for curves of millions of samples.
#ifndef SCENE_EXTREMES_H
#define SCENE_EXTREMES_H

#include <stdbool.h>
#include <stddef.h>

enum { EXTREMES_BLOCK = 1024 };

/// The lowest and the highest of every EXTREMES_BLOCK numbers; NULL: not known.
struct extremes {
    double *low, *high;
};

/// Elements that each of the two arrays needs for that many samples.
size_t extremes_blocks(int samples);

/// Looks at the blocks that have one of `count` numbers from `first` on; from a clean start: 0, samples.
void extremes_update(const struct extremes *extremes, const double *numbers, int samples, int first, int count);

/// The sample of the lowest (or highest) number from `first` to `last`, both included; the earliest of equal ones.
int extremes_find(const struct extremes *extremes, const double *numbers, int first, int last, bool highest);

#endif
