/// Memory that the program cannot do without. need() and its kin never return NULL: if memory runs out they remove unfinished files, say
/// so in one sentence and end the process with exit status 3. Unsaved work is in autosave's recovery file.
///
/// Sizes that a file claims are not for these: readers of files, and libwiggly, return an error.
#ifndef BASE_NEED_H
#define BASE_NEED_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>

/// `count` members of `size` bytes each, which the caller frees. Any thread may call it.
void *need(size_t count, size_t size) __attribute__((returns_nonnull));

/// The same, all bytes zero.
void *need_zeroed(size_t count, size_t size) __attribute__((returns_nonnull));

/// As realloc(): moves `old` (may be NULL) to a block of that many members.
void *need_more(void *old, size_t count, size_t size) __attribute__((returns_nonnull));

/// A copy of a text.
char *need_text(const char *text) __attribute__((returns_nonnull));

/// Whether this many bytes are available now. Call it first for sizes that a file claims: then lack of memory is an error and does not end the
/// program.
bool need_has_room(size_t bytes);

/// What need() does where memory runs out, for a library that has said so.
_Noreturn void need_failed(void);

/// Where the process ends so, it is called last, to remove what is half-written. NULL: nothing.
extern void (*_Atomic need_at_end)(void);

// Memory that is freed together.

/// Starts as zeros.
struct pool {
    struct pool_block *last;
};

/// `count` members of `size` bytes each, all zero; never NULL, as from need().
void *pool_take(struct pool *pool, size_t count, size_t size) __attribute__((returns_nonnull));

/// The same; NULL if memory is short.
void *pool_try(struct pool *pool, size_t count, size_t size);

/// Three texts as one.
char *pool_text(struct pool *pool, const char *first, const char *second, const char *third)
    __attribute__((returns_nonnull));

/// All of it at once.
void pool_free(struct pool *pool);

#endif
