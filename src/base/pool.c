/// Blocks of memory in a list.
#include "base/pool.h"
#include "base/need.h"
#include <stdint.h>
#include <stdlib.h>

struct pool_block {
    struct pool_block *before;
    max_align_t memory[];
};

/// SIZE_MAX, which no block has, if the number is too large.
static size_t bytes_of(size_t count, size_t size)
{
    size_t bytes;
    const bool fits = !__builtin_mul_overflow(count, size, &bytes) &&
                      !__builtin_add_overflow(bytes, sizeof(struct pool_block), &bytes);
    return fits ? bytes : SIZE_MAX;
}

static void *add(struct pool *pool, struct pool_block *block)
{
    if (!block) return NULL;
    block->before = pool->last;
    pool->last = block;
    return block->memory;
}

void *pool_try(struct pool *pool, size_t count, size_t size) { return add(pool, calloc(1, bytes_of(count, size))); }

void *pool_take(struct pool *pool, size_t count, size_t size)
{
    return add(pool, need_zeroed(1, bytes_of(count, size)));
}

void pool_free(struct pool *pool)
{
    while (pool->last) {
        struct pool_block *block = pool->last;
        pool->last = block->before;
        free(block);
    }
}
