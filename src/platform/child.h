/// A program run beside this one and fed through its standard input.
#ifndef PLATFORM_CHILD_H
#define PLATFORM_CHILD_H

#include "base/error.h"
#include <stddef.h>
#include <stdio.h>

struct child;

/// Runs a program that is found along PATH, without a shell; what it prints goes to `output`. `arguments` begin with its name and end with
/// NULL; nothing is written to them. NULL with a sentence; `*missing` says whether there is no such program. Ctrl+C in the terminal does
/// not reach it.
struct child *child_start(char *const *arguments, FILE *output, bool *missing, struct error *error);

enum child_state { CHILD_RUNS, CHILD_DONE, CHILD_FAILED };

/// Hands over as much of the data as it takes now, or, with `wait`, until it takes nothing for a tenth of a second. Adds to `*taken`.
/// CHILD_FAILED: it takes no more.
enum child_state child_feed(struct child *child, const void *data, size_t size, size_t *taken, bool wait);

/// Tells it that this was all, the first time, and looks whether it has ended; with `wait` for up to a tenth of a second.
enum child_state child_finish(struct child *child, bool wait);

/// The last line that it wrote to standard error, or "".
void child_complaint(struct child *child, char *line, size_t size);

/// Kills it if it still runs. NULL is fine.
void child_end(struct child *child);

#endif
