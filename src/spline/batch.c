/// Solves many splines on several threads. Each thread has its own solver and takes the next few splines until none is left. Results do
/// not depend on the thread, because a solver's caches change no bit of them.
#include "spline/host.h"
#include "spline/solver.h"
#include <limits.h>
#include <math.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// --- threads, locks and signals. Several C libraries lack C11's <threads.h>, and the thread sanitizer does not support it ---

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

enum { MAX_THREADS = 256, AT_A_TIME = 16 };

/// One call of wiggly_batch_solve() or wiggly_batch_solve_many().
typedef struct job {
    const wiggly_many *many; ///< or NULL
    const wiggly_desc *desc; ///< of the many, one that was read
    wiggly_curve *curve;
    size_t curve_size;
    wiggly_status *status;
    int count;
} job;

typedef struct worker {
    wiggly_batch *batch;
    wiggly_solver *solver;
    thread thread;
    wiggly_status worst;
} worker;

struct wiggly_batch {
    bool owned;
    int threads;
    thread_lock lock;
    thread_signal given, done;
    job job;
    atomic_int next; ///< the next spline to solve
    long round;      ///< number of the job; a change wakes the workers
    int busy;
    bool stop;
    worker workers[]; ///< the first belongs to the caller's thread
};

// --- splines whose knots and curves are in strided arrays: knots are copied to the solver's memory, and curves scattered from there

static double number(const wiggly_numbers *of, int spline, int k)
{
    return of->at ? of->at[spline * of->by_spline + k * of->by_number] : NAN;
}

/// Returns the number of knots, at most one more than there is room for.
static int fill_knots(const wiggly_many *many, int spline, wiggly_knot *knots, int room)
{
    int count = 0;
    for (int k = 0; k < many->knot_count && count <= room; k++) {
        const double sample = number(&many->sample, spline, k), slope = number(&many->slope, spline, k),
                     phase = number(&many->phase, spline, k), stiffness = number(&many->stiffness, spline, k);
        if (isnan(sample)) continue;
        const double whole = floor(sample + 0.5); // the nearest; outside the range if an int cannot hold it
        knots[count++] = (wiggly_knot){.sample = fabs(whole) < INT_MAX ? (int)whole : -1,
                                       .has_slope = !isnan(slope),
                                       .has_phase = !isnan(phase),
                                       .still = number(&many->still, spline, k) > 0,
                                       .settles = number(&many->settles, spline, k) > 0,
                                       .value = number(&many->value, spline, k),
                                       .slope = slope,
                                       .stiffness = many->stiffness.at ? stiffness : 0,
                                       .phase = phase};
    }
    return count;
}

/// A knot's index among all of its spline's, counting those left out.
static int place_of(const wiggly_many *many, int spline, int knot)
{
    int k = 0;
    for (int left = knot; k < many->knot_count; k++) {
        if (!isnan(number(&many->sample, spline, k)) && left-- == 0) break;
    }
    return knot < 0 ? -1 : k;
}

/// The caller's row; the solver's if the caller's is strided; NULL if it is not wanted.
static double *row_of(const wiggly_rows *rows, int spline, double *own)
{
    if (!rows->at) return NULL;
    return rows->by_number == 1 ? rows->at + spline * rows->by_spline : own;
}

static void scatter(const wiggly_rows *rows, int spline, const double *from, int count)
{
    if (!rows->at || rows->by_number == 1) return;
    double *to = rows->at + spline * rows->by_spline;
    for (int i = 0; i < count; i++) to[i * rows->by_number] = from[i];
}

/// Solves spline number `spline` by a description that was read.
static wiggly_status solve_of_many(wiggly_solver *solver, const wiggly_desc *desc, const wiggly_many *many,
                                   int spline)
{
    wiggly_desc own = *desc;
    own.knots = solver->filled;
    own.knot_count = fill_knots(many, spline, solver->filled, solver->knots);
    // The rows, and where a solve itself keeps them if the caller does not want them.
    const wiggly_rows *const rows[] = {&many->total, &many->y, &many->re, &many->im};
    double *const kept[] = {solver->rows.jet, solver->y, solver->re, solver->im};
    wiggly_curve curve = {.size = sizeof curve, .knot = -1};
    double **const arrays[] = {&curve.total, &curve.y, &curve.re, &curve.im};
    for (int a = 0; a < 4; a++) *arrays[a] = row_of(rows[a], spline, kept[a]);
    const wiggly_status status = solver_solve(solver, &own, &curve);
    if (many->knot) many->knot[spline] = place_of(many, spline, curve.knot);
    if (status >= WIGGLY_ERROR_ARGUMENT) return status;
    for (int a = 0; a < 4; a++) scatter(rows[a], spline, kept[a], own.samples);
    return status;
}

// --- threads

static void work(worker *w)
{
    wiggly_batch *batch = w->batch;
    const job *now = &batch->job;
    const host_state host = host_leave();
    w->worst = WIGGLY_OK;
    for (;;) {
        int from = atomic_fetch_add(&batch->next, AT_A_TIME), to = from + AT_A_TIME;
        if (from >= now->count) break;
        for (int i = from; i < to && i < now->count; i++) {
            const wiggly_status status =
                now->many ? solve_of_many(w->solver, now->desc, now->many, i)
                          : wiggly_solve(w->solver, desc_at(now->desc, i), curve_at(now->curve, now->curve_size, i));
            if (now->status) now->status[i] = status;
            if (status > w->worst) w->worst = status;
        }
    }
    host_return(&host);
}

static thread_result THREAD_CALL run(void *argument)
{
    worker *w = argument;
    wiggly_batch *batch = w->batch;
    long seen = 0;
    thread_acquire(&batch->lock);
    for (;;) {
        while (batch->round == seen && !batch->stop) thread_wait(&batch->given, &batch->lock);
        if (batch->stop) break;
        seen = batch->round;
        thread_release(&batch->lock);
        work(w);
        thread_acquire(&batch->lock);
        if (--batch->busy == 0) thread_wake(&batch->done);
    }
    thread_release(&batch->lock);
    return 0;
}

/// Bytes of everything except the solvers.
static size_t head_size(int threads) { return sizeof(wiggly_batch) + sizeof(worker) * (size_t)threads; }

size_t wiggly_batch_memsize(int samples, int knots, int threads)
{
    size_t each = wiggly_memsize(samples, knots), size;
    if (!each || threads < 1 || threads > MAX_THREADS) return 0;
    bool fits = !__builtin_mul_overflow(each, (size_t)threads, &size) &&
                !__builtin_add_overflow(size, head_size(threads), &size);
    return fits ? size : 0;
}

/// Sets up a batch in zeroed memory and starts its threads.
static wiggly_status start(void *memory, int samples, int knots, int threads, bool owned, wiggly_batch **out)
{
    wiggly_batch *batch = memory;
    unsigned char *solvers = (unsigned char *)memory + head_size(threads);
    size_t each = wiggly_memsize(samples, knots);
    batch->owned = owned;
    thread_lock_create(&batch->lock);
    thread_signal_create(&batch->given);
    thread_signal_create(&batch->done);
    for (; batch->threads < threads; batch->threads++) {
        worker *w = &batch->workers[batch->threads];
        w->batch = batch;
        w->solver = solver_lay_out(solvers + each * (size_t)batch->threads, samples, knots);
        if (batch->threads == 0 || thread_start(&w->thread, run, w)) continue;
        wiggly_batch_destroy(batch);
        return WIGGLY_ERROR_MEMORY;
    }
    *out = batch;
    return WIGGLY_OK;
}

wiggly_status wiggly_batch_create(int samples, int knots, int threads, wiggly_batch **out)
{
    size_t size = wiggly_batch_memsize(samples, knots, threads);
    if (!out || !size) return WIGGLY_ERROR_ARGUMENT;
    void *memory = calloc(1, size);
    return memory ? start(memory, samples, knots, threads, true, out) : WIGGLY_ERROR_MEMORY;
}

wiggly_status wiggly_batch_create_at(void *memory, size_t size, int samples, int knots, int threads,
                                     wiggly_batch **out)
{
    size_t needed = wiggly_batch_memsize(samples, knots, threads);
    if (!memory || !out || !needed || (uintptr_t)memory % sizeof(double) != 0) return WIGGLY_ERROR_ARGUMENT;
    if (size < needed) return WIGGLY_ERROR_MEMORY;
    memset(memory, 0, needed);
    return start(memory, samples, knots, threads, false, out);
}

/// Returns the largest status.
static wiggly_status solve_all(wiggly_batch *batch, job given)
{
    thread_acquire(&batch->lock);
    batch->job = given;
    atomic_store(&batch->next, 0);
    batch->busy = batch->threads - 1;
    batch->round++;
    thread_wake(&batch->given);
    thread_release(&batch->lock);
    work(&batch->workers[0]);
    thread_acquire(&batch->lock);
    while (batch->busy > 0) thread_wait(&batch->done, &batch->lock);
    thread_release(&batch->lock);
    wiggly_status worst = WIGGLY_OK;
    for (int t = 0; t < batch->threads; t++) {
        if (batch->workers[t].worst > worst) worst = batch->workers[t].worst;
    }
    return worst;
}

wiggly_status wiggly_batch_solve(wiggly_batch *batch, const wiggly_desc *desc, wiggly_curve *curve,
                                 wiggly_status *status, int count)
{
    if (!batch || count < 0 || (count > 0 && (!desc || !curve))) return WIGGLY_ERROR_ARGUMENT;
    if (count > 0 && !(desc_fits(desc) && curve_fits(curve))) return WIGGLY_ERROR_SIZE;
    const size_t size = count > 0 ? curve->size : 0;
    return solve_all(batch,
                     (job){.desc = desc, .curve = curve, .curve_size = size, .status = status, .count = count});
}

wiggly_status wiggly_batch_solve_many(wiggly_batch *batch, const wiggly_desc *desc, const wiggly_many *many)
{
    wiggly_desc read;
    if (!batch || !many) return WIGGLY_ERROR_ARGUMENT;
    if (!size_fits(many, sizeof *many)) return WIGGLY_ERROR_SIZE;
    const wiggly_many own = *many;
    if (own.count < 0 || own.knot_count < 0) return WIGGLY_ERROR_ARGUMENT;
    if (own.count > 0 && own.knot_count > 0 && !(own.sample.at && own.value.at)) return WIGGLY_ERROR_ARGUMENT;
    wiggly_status status = desc_read(desc, &read);
    if (status != WIGGLY_OK) return status;
    return solve_all(batch, (job){.many = &own, .desc = &read, .status = own.status, .count = own.count});
}

void wiggly_batch_destroy(wiggly_batch *batch)
{
    if (!batch) return;
    thread_acquire(&batch->lock);
    batch->stop = true;
    thread_wake(&batch->given);
    thread_release(&batch->lock);
    for (int t = 1; t < batch->threads; t++) thread_join(batch->workers[t].thread);
    thread_signal_destroy(&batch->given);
    thread_signal_destroy(&batch->done);
    thread_lock_destroy(&batch->lock);
    if (batch->owned) free(batch);
}
