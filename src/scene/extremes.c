#include "scene/extremes.h"

size_t extremes_blocks(int samples) { return ((size_t)samples + EXTREMES_BLOCK - 1) / EXTREMES_BLOCK; }

static int find_plainly(const double *numbers, int best, int first, int last, bool highest)
{
    for (int i = first; i <= last; i++) {
        if (highest ? numbers[i] > numbers[best] : numbers[i] < numbers[best]) best = i;
    }
    return best;
}

void extremes_update(const struct extremes *extremes, const double *numbers, int samples, int first, int count)
{
    if (!extremes->low || count < 1) return;
    for (int block = first / EXTREMES_BLOCK; block <= (first + count - 1) / EXTREMES_BLOCK; block++) {
        int from = block * EXTREMES_BLOCK, end = from + EXTREMES_BLOCK < samples ? from + EXTREMES_BLOCK : samples;
        extremes->low[block] = find_plainly(numbers, from, from, end - 1, false);
        extremes->high[block] = find_plainly(numbers, from, from, end - 1, true);
    }
}

int extremes_find(const struct extremes *extremes, const double *numbers, int first, int last, bool highest)
{
    int from = (first + EXTREMES_BLOCK - 1) / EXTREMES_BLOCK, end = (last + 1) / EXTREMES_BLOCK; // whole blocks
    const int *marks = highest ? extremes->high : extremes->low;
    if (!marks || from >= end) return find_plainly(numbers, first, first, last, highest);
    int best = find_plainly(numbers, first, first, from * EXTREMES_BLOCK - 1, highest);
    for (int block = from; block < end; block++) {
        best = find_plainly(numbers, best, marks[block], marks[block], highest);
    }
    return find_plainly(numbers, best, end * EXTREMES_BLOCK, last, highest);
}
