/// This process: age, memory, sleep, signals, and turns with another process.
#ifndef PLATFORM_PROCESS_H
#define PLATFORM_PROCESS_H

#include <stdbool.h>

/// Seconds since the process started (within 10 ms, the kernel's tick), or NAN if unknown.
double process_age(void);

/// Peak resident memory in MB, or NAN if unknown.
double process_peak_memory(void);

void process_sleep(double seconds);

/// Makes the first SIGINT, SIGTERM or SIGHUP only set process_was_told_to_end(); a second one of the same kind ends the process.
void process_catch_end(void);
bool process_was_told_to_end(void);

/// The other program passes the turn with a byte on descriptor 3 and receives one on descriptor 4; the parent connects the pipes. `first`:
/// this program starts. false if the descriptors are not open.
bool turns_open(bool first);

/// Waits for this program's turn; returns at once if the other has ended.
void turns_take(void);

void turns_give(void);

#endif
