/// Counts the allocations of our own objects: the linker (-Wl,--wrap=malloc …) redirects their calls here, while libraries
/// and the driver call the C library directly.
#include "timing/framelog.h"
#include <stdatomic.h>

static atomic_long count;

static void count_one(void) { atomic_fetch_add_explicit(&count, 1, memory_order_relaxed); }

long allocation_count(void) { return atomic_load_explicit(&count, memory_order_relaxed); }

void *__real_malloc(size_t size);
void *__real_calloc(size_t members, size_t size);
void *__real_realloc(void *memory, size_t size);
char *__real_strdup(const char *text);

void *__wrap_malloc(size_t size)
{
    count_one();
    return __real_malloc(size);
}

void *__wrap_calloc(size_t members, size_t size)
{
    count_one();
    return __real_calloc(members, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    count_one();
    return __real_realloc(memory, size);
}

char *__wrap_strdup(const char *text)
{
    count_one();
    return __real_strdup(text);
}
