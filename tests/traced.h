/// Runs a function in a child in which one system call fails or is the last, as on a full disk or a power cut.
#ifndef TESTS_TRACED_H
#define TESTS_TRACED_H

#include "near.h"

#include <errno.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined __x86_64__ && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
enum { CAN_TRACE = 1 };

typedef int traced(void *user);

/// The `n`th counted call (from 0; negative: none) fails with `error`. If `error` is 0, the child is killed there; below 0 the call
/// succeeds and the signal −`error` follows.
struct trouble {
    int n, error;
};

/// Calls that change files; only these matter for a crash.
static inline bool changes_files(unsigned long long call)
{
    switch (call) {
    case SYS_openat:
    case SYS_open:
    case SYS_write:
    case SYS_writev:
    case SYS_fsync:
    case SYS_rename:
    case SYS_renameat:
    case SYS_fchmod:
    case SYS_fchown:
    case SYS_fsetxattr:
    case SYS_fremovexattr:
    case SYS_close:
        return true;
    default:
        return call == SYS_unlink || call == SYS_unlinkat || call == SYS_link || call == SYS_mkdir;
    }
}

/// Failing to close or remove a file has no remedy, so it is not tested.
static inline bool can_fail(unsigned long long call)
{
    return changes_files(call) && call != SYS_close && call != SYS_unlink && call != SYS_unlinkat;
}

/// Threads' calls count, too. Returns the child's exit status, or -1 if it was killed; `*count` (may be NULL) receives the number of
/// counted calls.
static inline int trace(traced *run, void *user, struct trouble trouble, int *count)
{
    int status, n = 0;
    const pid_t child = fork();
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        _exit(run(user));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    ptrace(PTRACE_SETOPTIONS, child, NULL, (void *)(PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL));
    pid_t hit = 0, stopped = child; // the thread that made the chosen call; the thread that waits for us
    for (int passed = 0;;) {
        if (stopped) assert_int_equal(ptrace(PTRACE_SYSCALL, stopped, NULL, passed), 0);
        stopped = waitpid(-1, &status, __WALL);
        passed = 0;
        if (WIFEXITED(status) && stopped == child) break;
        if (WIFSIGNALED(status)) fail_msg("signal %d at call %d", WTERMSIG(status), trouble.n);
        if (WIFEXITED(status)) {
            stopped = 0;
            continue;
        }
        if (WSTOPSIG(status) != (SIGTRAP | 0x80)) {
            const bool is_begun = status >> 16 != 0 || (stopped != child && WSTOPSIG(status) == SIGSTOP);
            passed = is_begun ? 0 : WSTOPSIG(status); // a new thread starts with stops caused by tracing
            continue;
        }
        struct user_regs_struct registers;
        ptrace(PTRACE_GETREGS, stopped, NULL, &registers);
        if (hit == stopped && trouble.error < 0) {
            kill(child, -trouble.error);
            hit = 0;
        } else if (hit == stopped && trouble.error) {
            registers.rax = (unsigned long long)-trouble.error;
            ptrace(PTRACE_SETREGS, stopped, NULL, &registers);
            hit = 0;
        } else if (hit == stopped) {
            kill(child, SIGKILL);
            while (waitpid(-1, &status, __WALL) > 0) continue;
            return -1;
        } else if (registers.rax == (unsigned long long)-ENOSYS) { // at the call's entry
            const bool counts = trouble.error > 0 ? can_fail(registers.orig_rax) : changes_files(registers.orig_rax);
            if (counts && n++ == trouble.n) hit = stopped;
            if (hit != stopped || trouble.error <= 0) continue;
            registers.orig_rax = (unsigned long long)-1;
            ptrace(PTRACE_SETREGS, stopped, NULL, &registers);
        }
    }
    if (count) *count = n;
    return WEXITSTATUS(status);
}
#else
enum { CAN_TRACE = 0 };
#endif

#endif
