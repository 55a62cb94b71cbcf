/// The lowest and highest sample of each block.
#include "scene/extremes.h"
#include <math.h>

enum { CHAINS = 8 }; ///< independent comparisons: ten million samples take 4 to 9 ms

size_t extremes_blocks(int samples) { return ((size_t)samples + EXTREMES_BLOCK - 1) / EXTREMES_BLOCK; }

static void find_range(const double *numbers, int count, double *lowest, double *highest)
{
    double low[CHAINS], high[CHAINS];
    int i = 0;
    for (int c = 0; c < CHAINS; c++) low[c] = INFINITY, high[c] = -INFINITY;
    for (; i + CHAINS <= count; i += CHAINS) {
        for (int c = 0; c < CHAINS; c++) {
            double number = numbers[i + c];
            low[c] = number < low[c] ? number : low[c];
            high[c] = number > high[c] ? number : high[c];
        }
    }
    for (; i < count; i++) low[0] = fmin(low[0], numbers[i]), high[0] = fmax(high[0], numbers[i]);
    for (int c = 1; c < CHAINS; c++) low[0] = fmin(low[0], low[c]), high[0] = fmax(high[0], high[c]);
    *lowest = low[0];
    *highest = high[0];
}

void extremes_update(const struct extremes *extremes, const double *numbers, int samples, int first, int count)
{
    if (!extremes->low || count < 1) return;
    for (int block = first / EXTREMES_BLOCK; block <= (first + count - 1) / EXTREMES_BLOCK; block++) {
        int from = block * EXTREMES_BLOCK, end = from + EXTREMES_BLOCK < samples ? from + EXTREMES_BLOCK : samples;
        find_range(numbers + from, end - from, &extremes->low[block], &extremes->high[block]);
    }
}

static bool is_better(double a, double b, bool highest) { return highest ? a > b : a < b; }

static int find_plainly(const double *numbers, int best, int first, int last, bool highest)
{
    for (int i = first; i <= last; i++) {
        if (is_better(numbers[i], numbers[best], highest)) best = i;
    }
    return best;
}

int extremes_find(const struct extremes *extremes, const double *numbers, int first, int last, bool highest)
{
    int from = (first + EXTREMES_BLOCK - 1) / EXTREMES_BLOCK, end = (last + 1) / EXTREMES_BLOCK; // whole blocks
    const double *of_block = highest ? extremes->high : extremes->low;
    if (!of_block || from >= end) return find_plainly(numbers, first, first, last, highest);
    int best = find_plainly(numbers, first, first, from * EXTREMES_BLOCK - 1, highest), found = -1;
    double most = numbers[best];
    for (int block = from; block < end; block++) {
        if (is_better(of_block[block], most, highest)) most = of_block[block], found = block;
    }
    if (found >= 0) {
        int start = found * EXTREMES_BLOCK;
        best = find_plainly(numbers, start, start, start + EXTREMES_BLOCK - 1, highest);
    }
    return find_plainly(numbers, best, end * EXTREMES_BLOCK, last, highest);
}
