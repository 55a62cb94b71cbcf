/// Threads, locks and signals by POSIX threads or Windows' own. Several C libraries lack C11's <threads.h>, and the thread sanitizer does not
/// support it.
#ifndef SPLINE_THREAD_H
#define SPLINE_THREAD_H

#include <stdbool.h>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

typedef HANDLE thread;
typedef SRWLOCK thread_lock;
typedef CONDITION_VARIABLE thread_signal;
typedef DWORD thread_result;
#define THREAD_CALL WINAPI ///< before the name of a thread's function

static inline bool thread_start(thread *t, thread_result(THREAD_CALL *run)(void *), void *argument)
{
    *t = CreateThread(NULL, 0, run, argument, 0, NULL);
    return *t != NULL;
}

static inline void thread_join(thread t)
{
    WaitForSingleObject(t, INFINITE);
    CloseHandle(t);
}

static inline void thread_lock_create(thread_lock *lock) { InitializeSRWLock(lock); }
static inline void thread_lock_destroy(thread_lock *lock) { (void)lock; }
static inline void thread_acquire(thread_lock *lock) { AcquireSRWLockExclusive(lock); }
static inline void thread_release(thread_lock *lock) { ReleaseSRWLockExclusive(lock); }
static inline void thread_signal_create(thread_signal *signal) { InitializeConditionVariable(signal); }
static inline void thread_signal_destroy(thread_signal *signal) { (void)signal; }
static inline void thread_wake(thread_signal *signal) { WakeAllConditionVariable(signal); }

/// Releases the lock until the signal comes; may also return without one.
static inline void thread_wait(thread_signal *signal, thread_lock *lock)
{
    SleepConditionVariableSRW(signal, lock, INFINITE, 0);
}

#else
#include <pthread.h>

typedef pthread_t thread;
typedef pthread_mutex_t thread_lock;
typedef pthread_cond_t thread_signal;
typedef void *thread_result;
#define THREAD_CALL

static inline bool thread_start(thread *t, thread_result (*run)(void *), void *argument)
{
    return pthread_create(t, NULL, run, argument) == 0;
}

static inline void thread_join(thread t) { pthread_join(t, NULL); }
static inline void thread_lock_create(thread_lock *lock) { pthread_mutex_init(lock, NULL); }
static inline void thread_lock_destroy(thread_lock *lock) { pthread_mutex_destroy(lock); }
static inline void thread_acquire(thread_lock *lock) { pthread_mutex_lock(lock); }
static inline void thread_release(thread_lock *lock) { pthread_mutex_unlock(lock); }
static inline void thread_signal_create(thread_signal *signal) { pthread_cond_init(signal, NULL); }
static inline void thread_signal_destroy(thread_signal *signal) { pthread_cond_destroy(signal); }
static inline void thread_wake(thread_signal *signal) { pthread_cond_broadcast(signal); }

/// Releases the lock until the signal comes; may also return without one.
static inline void thread_wait(thread_signal *signal, thread_lock *lock) { pthread_cond_wait(signal, lock); }
#endif

#endif
