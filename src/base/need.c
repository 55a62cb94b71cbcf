/// Ends the program if memory runs out.
#include "base/need.h"
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>
#include <unistd.h>

void (*_Atomic need_at_end)(void);

_Noreturn void need_failed(void)
{
    static atomic_flag ends = ATOMIC_FLAG_INIT;
    while (atomic_flag_test_and_set(&ends))
        thrd_sleep(&(struct timespec){.tv_sec = 1}, NULL); // another thread ends it
    if (need_at_end) need_at_end();
    fputs("wiggly: out of memory\n", stderr);
    fflush(stderr);
    _exit(ERROR_ENVIRONMENT); // without cleaning up, as other threads are still running
}

/// `count` · `size`, at least 1, because NULL must mean that memory ran out.
static size_t need_bytes(size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes)) need_failed();
    return bytes ? bytes : 1;
}

void *need_more(void *old, size_t count, size_t size)
{
    void *memory = realloc(old, need_bytes(count, size));
    if (!memory) need_failed();
    return memory;
}

void *need(size_t count, size_t size) { return need_more(NULL, count, size); }

void *need_zeroed(size_t count, size_t size)
{
    void *memory = calloc(1, need_bytes(count, size)); // pages from the system are zero already
    if (!memory) need_failed();
    return memory;
}

char *need_text(const char *text)
{
    const size_t size = strlen(text) + 1;
    return memcpy(need(size, 1), text, size);
}

bool need_has_room(size_t bytes)
{
    void *volatile trial = malloc(bytes); // volatile: else the compiler optimises it away
    free(trial);
    return trial != NULL;
}

// --- memory that is freed together

struct pool_block {
    struct pool_block *before;
    max_align_t memory[];
};

void *pool_try(struct pool *pool, size_t count, size_t size)
{
    size_t bytes;
    const bool fits = !__builtin_mul_overflow(count, size, &bytes) &&
                      !__builtin_add_overflow(bytes, sizeof(struct pool_block), &bytes);
    struct pool_block *block = fits ? calloc(1, bytes) : NULL;
    if (!block) return NULL;
    block->before = pool->last;
    pool->last = block;
    return block->memory;
}

void *pool_take(struct pool *pool, size_t count, size_t size)
{
    void *memory = pool_try(pool, count, size);
    if (!memory) need_failed();
    return memory;
}

char *pool_text(struct pool *pool, const char *first, const char *second, const char *third)
{
    char *text = pool_take(pool, strlen(first) + strlen(second) + strlen(third) + 1, 1);
    stpcpy(stpcpy(stpcpy(text, first), second), third);
    return text;
}

void pool_free(struct pool *pool)
{
    while (pool->last) {
        struct pool_block *block = pool->last;
        pool->last = block->before;
        free(block);
    }
}
