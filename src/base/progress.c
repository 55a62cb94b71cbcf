/// The monotonic clock, and progress reports of long work.
#include "base/progress.h"
#include <time.h>

double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1.0e-9;
}

static progress_listener *listening;

void progress_listen(progress_listener *listener) { listening = listener; }

void progress_report(const char *doing, long done, long total)
{
    if (listening) listening(doing, done, total);
}
