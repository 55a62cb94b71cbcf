/// How long work takes, and how far it is.
#ifndef BASE_PROGRESS_H
#define BASE_PROGRESS_H

/// Seconds on a monotonic clock.
double clock_now(void);

/// Hears what is being done ("reading the mesh"), and how much of it. A stage may come again: it then begins at 0.
typedef void stage_listener(const char *doing, long done, long total);

/// Sets who listens: nobody at first. Call it before the work begins, and with no other thread at work.
void stage_listen(stage_listener *listener);

/// Tells it; `doing` is a literal. Costs little where nobody listens.
void stage_tell(const char *doing, long done, long total);

#endif
