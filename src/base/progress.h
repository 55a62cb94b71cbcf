/// How long work takes, and how far it is.
#ifndef BASE_PROGRESS_H
#define BASE_PROGRESS_H

/// Seconds on a monotonic clock.
double clock_now(void);

/// Receives the present stage ("reading the mesh") and its share done. A stage may come again; it then begins at 0.
typedef void progress_listener(const char *doing, long done, long total);

/// Sets who listens: nobody at first. Call it before the work begins, and with no other thread at work.
void progress_listen(progress_listener *listener);

/// Reports a stage; `doing` is a literal. Costs little if nobody listens.
void progress_report(const char *doing, long done, long total);

#endif
