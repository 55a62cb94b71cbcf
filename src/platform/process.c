/// Age, memory, sleep and signals of this process, and turns with another.
#include "platform/process.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

double process_age(void)
{
    char line[1024];
    FILE *file = fopen("/proc/self/stat", "r");
    if (!file) return NAN;
    bool read = fgets(line, sizeof line, file) != NULL;
    fclose(file);
    // The name in brackets may contain anything; the start time, in ticks since boot, is the 20th field after it.
    char *at = read ? strrchr(line, ')') : NULL;
    unsigned long long ticks = 0;
    if (!at || sscanf(at + 1, " %*c%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s %llu", &ticks) != 1)
        return NAN;
    struct timespec now;
    if (clock_gettime(CLOCK_BOOTTIME, &now) != 0) return NAN;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec - (double)ticks / (double)sysconf(_SC_CLK_TCK);
}

double process_peak_memory(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (double)usage.ru_maxrss / 1024 : NAN;
}

void process_sleep(double seconds)
{
    if (!(seconds > 0)) return;
    struct timespec left = {.tv_sec = (time_t)seconds, .tv_nsec = (long)(1e9 * (seconds - (double)(time_t)seconds))};
    nanosleep(&left, NULL);
}

static volatile sig_atomic_t told_to_end;

static void on_signal(int signal)
{
    (void)signal;
    told_to_end = 1;
}

void process_catch_end(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) sigaction(signals[i], &action, NULL);
}

bool process_was_told_to_end(void) { return told_to_end != 0; }

enum { FROM_OTHER = 3, TO_OTHER = 4 };
static bool ours;

bool turns_open(bool first)
{
    ours = first;
    signal(SIGPIPE, SIG_IGN); // the other program may end first
    return fcntl(FROM_OTHER, F_GETFD) >= 0 && fcntl(TO_OTHER, F_GETFD) >= 0;
}

void turns_take(void)
{
    char byte;
    while (!ours && read(FROM_OTHER, &byte, 1) < 0 && errno == EINTR) continue;
    ours = true;
}

void turns_give(void)
{
    while (write(TO_OTHER, "", 1) < 0 && errno == EINTR) continue;
    ours = false;
}
