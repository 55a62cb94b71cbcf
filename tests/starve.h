/// Out of memory: runs a function once for each of its allocations, which then fails, in a child process.
///
/// Libraries' allocations count, too, because the program replaces malloc for the whole process. The graphics driver's do not; these tests
/// draw nothing.
#ifndef TESTS_STARVE_H
#define TESTS_STARVE_H

#include "near.h"

#include <errno.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || !defined __GLIBC__
enum { CAN_STARVE = 0 }; // the sanitizer's allocator conflicts
static atomic_long allocations;
static long starve_at;
static int starve_on, starve_on_last;
#else
enum { CAN_STARVE = 1 };
static atomic_long allocations; ///< since the last reset
static long starve_at = -1;     ///< index of the failing allocation; negative: none
static int starve_on;           ///< later allocations fail, too
static int starve_on_last;      ///< in the last run

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static int starves(void)
{
    const long n = atomic_fetch_add(&allocations, 1);
    const int fails = starve_at >= 0 && (starve_on ? n >= starve_at : n == starve_at);
    if (fails) errno = ENOMEM; // libraries check it
    return fails;
}

void *malloc(size_t size) { return starves() ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return starves() ? NULL : __libc_calloc(count, size); }
void *realloc(void *old, size_t size) { return starves() ? NULL : __libc_realloc(old, size); }
void *aligned_alloc(size_t alignment, size_t size) { return starves() ? NULL : __libc_memalign(alignment, size); }
#endif

/// Returns the exit status: 0 only if everything succeeded correctly.
typedef int starved(void *user);

/// Runs it in a child with one allocation failing (negative: none) or, if `on`, all from there. Returns waitpid()'s status; `*count` (may
/// be NULL) receives the number of allocations.
static inline int starve_once(starved *run, void *user, long at, int on, long *count)
{
    int ends[2];
    long counted = 0;
    assert_int_equal(pipe(ends), 0);
    fflush(stdout);
    fflush(stderr);
    const pid_t child = fork();
    if (child == 0) {
        if (!getenv("STARVE_LOUD") && !(freopen("/dev/null", "w", stdout) && freopen("/dev/null", "w", stderr)))
            _exit(9);
        starve_on = on;
        atomic_store(&allocations, 0);
        starve_at = at;
        const int status = run(user);
        starve_at = -1;
        counted = atomic_load(&allocations);
        if (write(ends[1], &counted, sizeof counted) != sizeof counted) _exit(9);
        _exit(status);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    close(ends[1]);
    if (count) *count = read(ends[0], &counted, sizeof counted) == sizeof counted ? counted : 0;
    close(ends[0]);
    return status;
}

/// Checks from outside after a run that ended with `status`, also by need().
typedef void starve_check(void *user, int status);

/// Fails each allocation, alone and with all after it, in at most `most` runs at a fixed stride; a twelfth of that in `make test`, every
/// allocation both ways if STARVE_ALL is set. Every run must end by itself, at least one with an error. `check` may be NULL.
static inline void starve_checked(const char *what, starved *run, starve_check *check, void *user, long most)
{
    long all = 0, refused = 0, runs = 0;
    if (!is_thorough()) most = 8 + most / 12;
    int status = starve_once(run, user, -1, 0, &all);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail_msg("%s: status %x with all of its memory", what, status);
    const int both = getenv("STARVE_ALL") || 2 * all <= most;
    const long stride = both || all <= most ? 1 : (all + most - 1) / most;
    for (long k = 0; k < all; k += both ? runs % 2 : stride, runs++) {
        starve_on_last = (int)(runs % 2);
        status = starve_once(run, user, k, starve_on_last, NULL);
        if (!WIFEXITED(status)) fail_msg("%s: signal %d at allocation %ld of %ld", what, WTERMSIG(status), k, all);
        if (WEXITSTATUS(status) > 3)
            fail_msg("%s: wrong (%d) at allocation %ld of %ld", what, WEXITSTATUS(status), k, all);
        if (check) check(user, WEXITSTATUS(status));
        refused += WEXITSTATUS(status) != 0;
    }
    if (refused == 0) fail_msg("%s: none of %ld failures was noticed", what, runs);
    print_message("           %s: %ld runs, every %ld. of %ld allocations failed%s\n", what, runs, stride, all,
                  both ? " both ways" : "");
}

static inline void starve(const char *what, starved *run, void *user, long most)
{
    starve_checked(what, run, NULL, user, most);
}

#endif
