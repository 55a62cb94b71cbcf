/// Builds the block matrix and solves by preconditioned conjugate gradients.
#include "simulation/blocks.h"
#include "base/need.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

void blocks_create(struct blocks *blocks, int nodes, const struct element *elements, int count, struct pool *pool)
{
    *blocks = (struct blocks){.rows = nodes};
    uint64_t *pairs = need((size_t)count * 16 + 1, sizeof *pairs);
    size_t kept = list_pairs(pairs, elements, count);
    blocks->start = pool_take(pool, (size_t)nodes + 1, sizeof *blocks->start);
    blocks->column = pool_take(pool, kept + 1, sizeof *blocks->column);
    blocks->block = pool_take(pool, kept + 1, sizeof *blocks->block);
    blocks->diagonal = pool_take(pool, (size_t)nodes, sizeof *blocks->diagonal);
    for (size_t i = 0; i < kept; i++) {
        int row = (int)(pairs[i] >> 32), column = (int)(uint32_t)pairs[i];
        blocks->start[row + 1] = (int)i + 1;
        blocks->column[i] = column;
        if (row == column) blocks->diagonal[row] = (int)i;
    }
    free(pairs);
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

void conjugate_create(struct conjugate *conjugate, int rows, struct pool *pool)
{
    size_t n = (size_t)rows;
    *conjugate = (struct conjugate){
        .r = pool_take(pool, n, sizeof *conjugate->r),
        .z = pool_take(pool, n, sizeof *conjugate->z),
        .p = pool_take(pool, n, sizeof *conjugate->p),
        .q = pool_take(pool, n, sizeof *conjugate->q),
        .inverse = pool_take(pool, n, sizeof *conjugate->inverse),
    };
}

/// Inverse of a symmetric definite 3×3 block by cofactors.
static void invert(const double a[9], double out[9])
{
    double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8], c2 = a[3] * a[7] - a[4] * a[6];
    double scale = 1 / (a[0] * c0 + a[1] * c1 + a[2] * c2);
    out[0] = c0 * scale;
    out[1] = out[3] = c1 * scale;
    out[2] = out[6] = c2 * scale;
    out[4] = (a[0] * a[8] - a[2] * a[6]) * scale;
    out[5] = out[7] = (a[1] * a[6] - a[0] * a[7]) * scale;
    out[8] = (a[0] * a[4] - a[1] * a[3]) * scale;
}

/// z = D⁻¹ r; returns r · z.
static double precondition(const struct conjugate *c, int rows, const double (*r)[3], double (*z)[3])
{
    double dot = 0;
    for (int i = 0; i < rows; i++) {
        const double *d = c->inverse[i], *v = r[i];
        for (int k = 0; k < 3; k++) {
            z[i][k] = d[3 * k] * v[0] + d[3 * k + 1] * v[1] + d[3 * k + 2] * v[2];
            dot += z[i][k] * v[k];
        }
    }
    return dot;
}

int conjugate_solve(struct conjugate *c, const struct blocks *a, const double (*b)[3], double (*x)[3],
                    double tolerance, int limit)
{
    const int rows = a->rows, n = 3 * rows;
    double *r = *c->r, *z = *c->z, *p = *c->p, *q = *c->q, *unknown = *x;
    const double *right = *b;
    for (int i = 0; i < rows; i++) invert(a->block[a->diagonal[i]], c->inverse[i]);
    double goal = tolerance * tolerance * precondition(c, rows, b, c->z);
    blocks_multiply(a, (const double(*)[3])x, c->q);
    for (int i = 0; i < n; i++) r[i] = right[i] - q[i];
    double rz = precondition(c, rows, (const double(*)[3])c->r, c->z);
    memcpy(p, z, (size_t)n * sizeof *p);
    int iteration = 0;
    for (; iteration < limit && rz > goal; iteration++) {
        blocks_multiply(a, (const double(*)[3])c->p, c->q);
        double curvature = 0;
        for (int i = 0; i < n; i++) curvature += p[i] * q[i];
        double alpha = rz / curvature;
        for (int i = 0; i < n; i++) {
            unknown[i] += alpha * p[i];
            r[i] -= alpha * q[i];
        }
        double next = precondition(c, rows, (const double(*)[3])c->r, c->z);
        double beta = next / rz;
        rz = next;
        for (int i = 0; i < n; i++) p[i] = z[i] + beta * p[i];
    }
    return iteration;
}
