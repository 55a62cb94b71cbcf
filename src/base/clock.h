/// The clock that durations are measured by.
#ifndef BASE_CLOCK_H
#define BASE_CLOCK_H

/// Seconds on a monotonic clock.
double clock_now(void);

#endif
