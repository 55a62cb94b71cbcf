/// Runs something in a child of which one system call fails, or after one of which it is killed, as by a full disk or a power cut.
#ifndef TESTS_TRACED_H
#define TESTS_TRACED_H

#include "near.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined __x86_64__ && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
enum { CAN_TRACE = 1 };

typedef int traced(void *user);

/// What is to go wrong: the `n`th of the calls that count (from 0 on; negative: none) fails with `error` or, 0, is the last.
struct trouble {
    int n, error;
};

/// Calls that change files; for a crash, they are all that matter.
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
    case SYS_close:
        return true;
    default:
        return call == SYS_unlink || call == SYS_unlinkat || call == SYS_link || call == SYS_mkdir;
    }
}

/// A file that cannot be closed or removed is no fault of its own: nothing could be done.
static inline bool can_fail(unsigned long long call)
{
    return changes_files(call) && call != SYS_close && call != SYS_unlink && call != SYS_unlinkat;
}

/// Returns the child's exit status, or -1 where it was killed; `*count` (may be NULL): the calls that count.
static inline int trace(traced *run, void *user, struct trouble trouble, int *count)
{
    int status, n = 0;
    bool inside = false, hit = false;
    const pid_t child = fork();
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        _exit(run(user));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    ptrace(PTRACE_SETOPTIONS, child, NULL, (void *)(PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL));
    for (int passed = 0;;) {
        assert_int_equal(ptrace(PTRACE_SYSCALL, child, NULL, passed), 0);
        assert_int_equal(waitpid(child, &status, 0), child);
        passed = 0;
        if (WIFEXITED(status)) break;
        if (WIFSIGNALED(status)) fail_msg("signal %d at call %d", WTERMSIG(status), trouble.n);
        if (WSTOPSIG(status) != (SIGTRAP | 0x80)) {
            passed = WSTOPSIG(status);
            continue;
        }
        struct user_regs_struct registers;
        ptrace(PTRACE_GETREGS, child, NULL, &registers);
        inside = !inside;
        if (inside) {
            const bool counts = trouble.error ? can_fail(registers.orig_rax) : changes_files(registers.orig_rax);
            hit = counts && n == trouble.n;
            n += counts;
            if (hit && trouble.error) {
                registers.orig_rax = (unsigned long long)-1;
                ptrace(PTRACE_SETREGS, child, NULL, &registers);
            }
        } else if (hit && trouble.error) {
            registers.rax = (unsigned long long)-trouble.error;
            ptrace(PTRACE_SETREGS, child, NULL, &registers);
            hit = false;
        } else if (hit) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return -1;
        }
    }
    if (count) *count = n;
    return WEXITSTATUS(status);
}
#else
enum { CAN_TRACE = 0 };
#endif

#endif
