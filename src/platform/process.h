/// The running process: its age, its memory, sleep, signals, and turns with another.
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

/// The other program hands over by a byte on descriptor 3, and gets one on descriptor 4; whoever starts the two connects the
/// pipes. `first`: this one begins. false if the descriptors are not open.
bool turns_open(bool first);

/// Waits for this program's turn; returns at once if the other one has ended.
void turns_take(void);

void turns_give(void);

#endif
