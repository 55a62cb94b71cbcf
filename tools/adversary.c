/// Searches for splines that the solver gets wrong without reporting it: makes hard problems from a seed, checks each answer against the
/// textbook in quadruple precision, and prints faults with the scene. Exit status 1 if there are any. Usage: adversary SEED COUNT
/// [PROCESSES [FIRST]], for problems FIRST … FIRST + COUNT − 1 of the seed.
#include "adversary.h"
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static const char *const kinds[ADVERSARY_KINDS] = {
    "filter", "oscillator", "adjacent", "nodal", "nyquist", "from zero", "slow",  "chain",   "long",
    "gaps",   "calm",       "critical", "alias", "jumps",   "last",      "stiff", "resonant"};

struct tally {
    long tried[ADVERSARY_KINDS], faults[ADVERSARY_KINDS], inexact[ADVERSARY_KINDS], needless[ADVERSARY_KINDS],
        undecided;
};

static struct tally search(uint64_t seed, long first, long count, int step)
{
    static struct adversary_problem problem;
    struct tally tally = {.undecided = 0};
    wiggly_solver *solver = NULL;
    if (wiggly_create(ADVERSARY_MAX, ADVERSARY_MAX, &solver) != WIGGLY_OK) exit(2);
    for (long n = first; n < first + count; n += step) {
        const adversary_kind kind = adversary_make_nth(&problem, seed, (uint64_t)n);
        struct adversary_verdict verdict;
        adversary_judge(solver, &problem, &verdict);
        tally.tried[kind]++;
        tally.inexact[kind] += verdict.said == WIGGLY_INEXACT;
        tally.undecided += verdict.undecided;
        tally.needless[kind] += verdict.fault && verdict.needless;
        if (!verdict.fault || verdict.needless) continue;
        tally.faults[kind]++;
        char name[80];
        snprintf(name, sizeof name, "%llu %ld (%s)", (unsigned long long)seed, n, kinds[kind]);
        adversary_explain(stdout, name, &verdict);
        adversary_print(stdout, &problem);
        fflush(stdout); // keeps lines of several processes apart
    }
    wiggly_destroy(solver);
    return tally;
}

/// Starts one of several processes; its tally comes through a pipe.
static int begin(uint64_t seed, long first, long count, int step)
{
    int ends[2];
    if (pipe(ends) != 0) exit(2);
    const pid_t child = fork();
    if (child < 0) exit(2);
    if (child > 0) {
        close(ends[1]);
        return ends[0];
    }
    const struct tally tally = search(seed, first, count, step);
    _exit(write(ends[1], &tally, sizeof tally) == sizeof tally ? 0 : 2);
}

int main(int argc, char **argv)
{
    enum { MOST = 64 };
    if (argc < 3) {
        fputs("adversary SEED COUNT [PROCESSES [FIRST]]\n", stderr);
        return 2;
    }
    const uint64_t seed = strtoull(argv[1], NULL, 10);
    const long count = atol(argv[2]), first = argc > 4 ? atol(argv[4]) : 0;
    int processes = argc > 3 ? atoi(argv[3]) : 1, ends[MOST];
    if (processes < 1 || processes > MOST) processes = 1;
    const time_t started = time(NULL);
    struct tally all = {.undecided = 0};
    for (int i = 0; i < processes; i++) ends[i] = begin(seed, first + i, count - i, processes);
    for (int i = 0; i < processes; i++) {
        struct tally one;
        if (read(ends[i], &one, sizeof one) != sizeof one) return 2;
        all.undecided += one.undecided;
        for (int k = 0; k < ADVERSARY_KINDS; k++) {
            all.tried[k] += one.tried[k];
            all.faults[k] += one.faults[k];
            all.inexact[k] += one.inexact[k];
            all.needless[k] += one.needless[k];
        }
    }
    while (wait(NULL) > 0) {
    }
    long tried = 0, faults = 0, inexact = 0, needless = 0;
    for (int k = 0; k < ADVERSARY_KINDS; k++) {
        printf("%-10s %7ld tried, %5ld inexact, %5ld needlessly, %3ld silent\n", kinds[k], all.tried[k],
               all.inexact[k], all.needless[k], all.faults[k]);
        tried += all.tried[k], faults += all.faults[k], inexact += all.inexact[k], needless += all.needless[k];
    }
    printf("seed %llu: %ld tried, %ld inexact (%ld needlessly), %ld undecided, %ld wrong in silence, %ld s\n",
           (unsigned long long)seed, tried, inexact, needless, all.undecided, faults, (long)(time(NULL) - started));
    return faults > 0;
}
