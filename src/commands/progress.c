/// Shows progress, and handles Ctrl+C.
#include "commands/progress.h"
#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

/// A signal handler: only async-signal-safe calls.
static void end_at_once(int signal_number)
{
    static const char text[] = "interrupted; nothing half-written is left\n";
    (void)signal_number;
    file_remove_unfinished();
    const ssize_t told = write(STDERR_FILENO, text, sizeof text - 1);
    (void)told; // nothing to do on failure
    _exit(ERROR_ENVIRONMENT);
}

void progress_end_when_interrupted(void)
{
    struct sigaction action = {.sa_handler = end_at_once, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void progress_clear(const struct progress *progress)
{
    if (progress->shown > 0 && isatty(STDERR_FILENO)) fputs("\r\033[K", stderr);
}

void progress_show(struct progress *progress, long done, long total)
{
    const bool terminal = isatty(STDERR_FILENO);
    const double now = clock_now(), left = (now - progress->started) * (double)(total - done) / (double)done;
    const bool tenth = done == 0 || done * 10 / total != progress->done * 10 / total;
    progress->done = done;
    if (terminal && done == total) progress_clear(progress);
    const bool due = terminal ? done > 0 && done < total && now - progress->started > 1 && now - progress->shown > 0.1
                              : progress->lines && tenth;
    if (!due) return;
    progress->shown = now;
    if (terminal) fputc('\r', stderr);
    if (progress->doing) {
        fprintf(stderr, "%s: %ld %%", progress->doing, 100 * done / total);
    } else {
        fprintf(stderr, "frame %ld of %ld", done, total);
    }
    if (done > 0) fprintf(stderr, ", %.0f s left", ceil(left));
    fputs(terminal ? "\033[K" : "\n", stderr);
    fflush(stderr);
}

static struct progress stage;

static void show_stage(const char *doing, long done, long total)
{
    if (doing != stage.doing || done < stage.done) {
        progress_clear(&stage);
        stage = (struct progress){.started = clock_now(), .lines = stage.lines, .doing = doing};
    }
    progress_show(&stage, done, total);
}

void progress_show_stages(bool lines)
{
    stage.lines = lines;
    progress_listen(show_stage);
}
