/// Memory that runs out: runs something once for each of its allocations, which then fails, in a process of its own.
///
/// The libraries' allocations count, too: malloc and the like of this program are those of the whole process. The graphics driver is
/// left alone, for tests that starve draw nothing.
#ifndef TESTS_STARVE_H
#define TESTS_STARVE_H

#include "near.h"

#include <errno.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || !defined __GLIBC__
enum { CAN_STARVE = 0 }; // the sanitizer's allocator is in the way
static atomic_long allocations;
static long starve_at;
static int starve_on, starve_on_last;
#else
enum { CAN_STARVE = 1 };
static atomic_long allocations; ///< since it was set to 0
static long starve_at = -1;     ///< the allocation that fails; negative: none
static int starve_on;           ///< so do those after it
static int starve_on_last;      ///< as it was in the last run

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static int starves(void)
{
    const long n = atomic_fetch_add(&allocations, 1);
    const int fails = starve_at >= 0 && (starve_on ? n >= starve_at : n == starve_at);
    if (fails) errno = ENOMEM; // which libraries look at
    return fails;
}

void *malloc(size_t size) { return starves() ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return starves() ? NULL : __libc_calloc(count, size); }
void *realloc(void *old, size_t size) { return starves() ? NULL : __libc_realloc(old, size); }
void *aligned_alloc(size_t alignment, size_t size) { return starves() ? NULL : __libc_memalign(alignment, size); }
#endif

/// Ends with the status of a command: 0 only if all that was asked for is done and right.
typedef int starved(void *user);

/// Runs it in a child with one allocation failing (negative: none) or, `on`, with all from there on. Returns what waitpid() says;
/// `*count` (may be NULL) is how many there were.
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

/// What must hold after a run that has ended with that status, or was ended by need(): looked at from outside.
typedef void starve_check(void *user, int status);

/// Each allocation fails, by itself and with all after it: in at most so many runs, for which the two take turns and every so many
/// allocations fail, by a fixed stride; a twelfth of that in `make test`, all of them both ways where STARVE_ALL is set. What runs ends by
/// itself, and some of it with an error. `check` may be NULL.
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
