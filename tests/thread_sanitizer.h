/// Maps C11 threads to POSIX threads, because the thread sanitizer does not support <threads.h>. Included before all sources:
///
///     make B=build/threads CFLAGS="-fsanitize=thread -include tests/thread_sanitizer.h" TESTS=test_autosave test
///
/// In glibc the types are interchangeable.
#ifndef TESTS_THREAD_SANITIZER_H
#define TESTS_THREAD_SANITIZER_H

#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <threads.h>

struct thread_sanitizer_start {
    thrd_start_t run;
    void *argument;
};

static inline void *thread_sanitizer_run(void *given)
{
    const struct thread_sanitizer_start start = *(struct thread_sanitizer_start *)given;
    free(given);
    return (void *)(intptr_t)start.run(start.argument);
}

static inline int thread_sanitizer_create(thrd_t *thread, thrd_start_t run, void *argument)
{
    struct thread_sanitizer_start *start = malloc(sizeof *start);
    *start = (struct thread_sanitizer_start){run, argument};
    return pthread_create(thread, NULL, thread_sanitizer_run, start) == 0 ? thrd_success : thrd_error;
}

#define thrd_create thread_sanitizer_create
#define thrd_join(thread, result) pthread_join(thread, NULL)
#define mtx_init(lock, kind) pthread_mutex_init((pthread_mutex_t *)(lock), NULL)
#define mtx_lock(lock) pthread_mutex_lock((pthread_mutex_t *)(lock))
#define mtx_unlock(lock) pthread_mutex_unlock((pthread_mutex_t *)(lock))
#define mtx_destroy(lock) pthread_mutex_destroy((pthread_mutex_t *)(lock))
#define cnd_init(signal) pthread_cond_init((pthread_cond_t *)(signal), NULL)
#define cnd_wait(signal, lock) pthread_cond_wait((pthread_cond_t *)(signal), (pthread_mutex_t *)(lock))
#define cnd_timedwait(signal, lock, until)                                                                           \
    (pthread_cond_timedwait((pthread_cond_t *)(signal), (pthread_mutex_t *)(lock), until) == 0 ? thrd_success        \
                                                                                               : thrd_timedout)
#define cnd_signal(signal) pthread_cond_signal((pthread_cond_t *)(signal))
#define cnd_broadcast(signal) pthread_cond_broadcast((pthread_cond_t *)(signal))
#define cnd_destroy(signal) pthread_cond_destroy((pthread_cond_t *)(signal))
#define call_once(flag, run) pthread_once((pthread_once_t *)(flag), run)

#endif
