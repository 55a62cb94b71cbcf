/// The clock that durations are measured by.
#ifndef BASE_CLOCK_H
#define BASE_CLOCK_H

#include <time.h>

/// Seconds on a monotonic clock.
static inline double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1.0e-9;
}

#endif
