/// Memory that is freed together.
#ifndef BASE_POOL_H
#define BASE_POOL_H

#include <stddef.h>

/// Starts as zeros.
struct pool {
    struct pool_block *last;
};

/// `count` members of `size` bytes each, all zero; never NULL, as from need().
void *pool_take(struct pool *pool, size_t count, size_t size) __attribute__((returns_nonnull));

/// The same; NULL if memory is short.
void *pool_try(struct pool *pool, size_t count, size_t size);

/// All of it at once.
void pool_free(struct pool *pool);

#endif
