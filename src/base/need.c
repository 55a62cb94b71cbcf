/// Ends the program if memory runs out, after saving the work.
#include "base/need.h"
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>
#include <unistd.h>

enum { NAPS = 50 }; ///< of 10 ms each

void (*_Atomic need_at_end)(void);

static void *reserve_kept;
static need_rescue *rescue;
static void *rescue_user;
static atomic_bool ends;
static _Thread_local bool rescues; ///< this thread is saving the work

_Noreturn static void end_process(const char *sentence)
{
    if (need_at_end) need_at_end();
    fprintf(stderr, "wiggly: %s\n", sentence);
    fflush(stderr);
    _exit(ERROR_ENVIRONMENT); // without cleaning up, as other threads are still running
}

/// Ends the process. Returns only if another thread is saving the work: the freed reserve lets the caller try again.
static void ran_short(void)
{
    if (rescues) end_process("out of memory; work since the last autosave is lost");
    if (atomic_exchange(&ends, true)) {
        thrd_sleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
        return;
    }
    struct error error;
    rescues = true;
    free(reserve_kept);
    fail(&error, ERROR_ENVIRONMENT, "out of memory");
    if (rescue) rescue(rescue_user, &error);
    end_process(error.text);
}

_Noreturn void need_failed(void)
{
    for (int i = 0; i < NAPS; i++) ran_short();
    end_process("out of memory");
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
    const size_t bytes = need_bytes(count, size);
    for (int i = 0; i < NAPS; i++) {
        void *memory = realloc(old, bytes);
        if (memory) return memory;
        ran_short();
    }
    end_process("out of memory");
}

void *need(size_t count, size_t size)
{
    void *memory = malloc(need_bytes(count, size));
    if (memory) return memory;
    ran_short();
    return need_more(NULL, count, size);
}

void *need_zeroed(size_t count, size_t size)
{
    const size_t bytes = need_bytes(count, size);
    void *memory = calloc(1, bytes); // pages from the system are zero already
    if (memory) return memory;
    ran_short();
    return memset(need_more(NULL, count, size), 0, bytes);
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

void need_keep(size_t reserve, need_rescue *saves, void *user)
{
    free(reserve_kept);
    rescue = saves;
    rescue_user = user;
    reserve_kept = reserve ? need(reserve, 1) : NULL;
}

// --- memory that is freed together

struct pool_block {
    struct pool_block *before;
    max_align_t memory[];
};

/// SIZE_MAX, which no block has, if the number is too large.
static size_t block_bytes(size_t count, size_t size)
{
    size_t bytes;
    const bool fits = !__builtin_mul_overflow(count, size, &bytes) &&
                      !__builtin_add_overflow(bytes, sizeof(struct pool_block), &bytes);
    return fits ? bytes : SIZE_MAX;
}

static void *pool_add(struct pool *pool, struct pool_block *block)
{
    if (!block) return NULL;
    block->before = pool->last;
    pool->last = block;
    return block->memory;
}

void *pool_try(struct pool *pool, size_t count, size_t size)
{
    return pool_add(pool, calloc(1, block_bytes(count, size)));
}

void *pool_take(struct pool *pool, size_t count, size_t size)
{
    return pool_add(pool, need_zeroed(1, block_bytes(count, size)));
}

void pool_free(struct pool *pool)
{
    while (pool->last) {
        struct pool_block *block = pool->last;
        pool->last = block->before;
        free(block);
    }
}
