/// Shows the progress of long commands, and catches Ctrl+C.
#include "commands/progress.h"
#include "base/clock.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

void progress_catch_interrupts(void)
{
    struct sigaction action = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool progress_interrupted(void) { return interrupted != 0; }

void progress_clear(const struct progress *progress)
{
    if (progress->shown > 0 && isatty(STDERR_FILENO)) fputs("\r\033[K", stderr);
}

void progress_show(struct progress *progress, long done, long total)
{
    const bool terminal = isatty(STDERR_FILENO);
    const double now = clock_now(), left = (now - progress->started) * (double)(total - done) / (double)done;
    if (terminal && done == total) progress_clear(progress);
    const bool due = terminal ? done < total && now - progress->started > 1 && now - progress->shown > 0.1
                              : progress->lines && done * 10 / total != (done - 1) * 10 / total;
    if (!due) return;
    progress->shown = now;
    fprintf(stderr, "%sframe %ld of %ld, %.0f s left%s", terminal ? "\r" : "", done, total, ceil(left),
            terminal ? "   " : "\n");
    fflush(stderr);
}
