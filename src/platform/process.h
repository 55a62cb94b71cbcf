/// The running process: its age, its memory, sleep, and signals.
#ifndef PLATFORM_PROCESS_H
#define PLATFORM_PROCESS_H

#include <stdbool.h>

/// Seconds since the process was started by its parent (to about 10 ms: the kernel's tick), or NAN where unknown.
double process_age(void);

/// Largest resident memory so far, in MB, or NAN where unknown.
double process_peak_memory(void);

void process_sleep(double seconds);

/// From now on a request to end (SIGINT, SIGTERM, SIGHUP) only sets process_was_told_to_end(); a second one of the same
/// kind ends the process.
void process_catch_end(void);
bool process_was_told_to_end(void);

#endif
