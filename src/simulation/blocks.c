/// Assembles and applies sparse block matrices.
#include "simulation/blocks.h"
#include "base/need.h"
#include <stdint.h>
#include <stdlib.h>

static int compare(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/// All pairs (row, column) of the elements, sorted, without duplicates; returns how many.
static size_t list_pairs(uint64_t *pairs, const struct element *elements, int count)
{
    size_t n = 0, kept = 0;
    for (int e = 0; e < count; e++) {
        for (int k = 0; k < 16; k++) {
            pairs[n++] = (uint64_t)elements[e].node[k / 4] << 32 | (uint32_t)elements[e].node[k % 4];
        }
    }
    qsort(pairs, n, sizeof *pairs, compare);
    for (size_t i = 0; i < n; i++) {
        if (i == 0 || pairs[i] != pairs[i - 1]) pairs[kept++] = pairs[i];
    }
    return kept;
}

void blocks_create(struct blocks *blocks, int nodes, const struct element *elements, int count)
{
    *blocks = (struct blocks){.rows = nodes};
    uint64_t *pairs = need((size_t)count * 16 + 1, sizeof *pairs);
    size_t kept = list_pairs(pairs, elements, count);
    blocks->start = need_zeroed((size_t)nodes + 1, sizeof *blocks->start);
    blocks->column = need_zeroed(kept + 1, sizeof *blocks->column);
    blocks->block = need_zeroed(kept + 1, sizeof *blocks->block);
    blocks->diagonal = need_zeroed((size_t)nodes, sizeof *blocks->diagonal);
    for (size_t i = 0; i < kept; i++) {
        int row = (int)(pairs[i] >> 32), column = (int)(uint32_t)pairs[i];
        blocks->start[row + 1] = (int)i + 1;
        blocks->column[i] = column;
        if (row == column) blocks->diagonal[row] = (int)i;
    }
    free(pairs);
}

void blocks_free(struct blocks *blocks)
{
    free(blocks->start);
    free(blocks->column);
    free(blocks->block);
    free(blocks->diagonal);
    *blocks = (struct blocks){0};
}

int blocks_find(const struct blocks *blocks, int row, int column)
{
    int low = blocks->start[row], high = blocks->start[row + 1] - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (blocks->column[middle] < column) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

void blocks_multiply(const struct blocks *blocks, const double (*x)[3], double (*y)[3])
{
    for (int i = 0; i < blocks->rows; i++) {
        double sum[3] = {0};
        for (int k = blocks->start[i]; k < blocks->start[i + 1]; k++) {
            const double *a = blocks->block[k], *v = x[blocks->column[k]];
            sum[0] += a[0] * v[0] + a[1] * v[1] + a[2] * v[2];
            sum[1] += a[3] * v[0] + a[4] * v[1] + a[5] * v[2];
            sum[2] += a[6] * v[0] + a[7] * v[1] + a[8] * v[2];
        }
        for (int c = 0; c < 3; c++) y[i][c] = sum[c];
    }
}
