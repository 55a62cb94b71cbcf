/// Runs another program and feeds it.
#include "platform/child.h"
#include "base/need.h"
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

struct child {
    pid_t process; ///< 0: it has ended, and was waited for
    int feed;      ///< our end of its standard input; −1 once all is said
    FILE *log;     ///< its standard error
};

/// For how long a caller that waits does, in milliseconds, before it can look whether it has been told to end.
enum { PATIENCE = 100 };

static int spawn(struct child *child, char *const *arguments, int input, int output)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    sigaddset(&usual, SIGPIPE);
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, fileno(child->log), STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    int cause = posix_spawnp(&child->process, arguments[0], &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return cause;
}

struct child *child_start(char *const *arguments, FILE *output, bool *missing, struct error *error)
{
    int ends[2] = {-1, -1}, cause;
    struct child *child = need_zeroed(1, sizeof *child);
    *missing = false;
    // A socket, because writing to one whose reader is gone can do without SIGPIPE.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0 && (child->log = tmpfile())) {
        child->feed = ends[0];
        cause = spawn(child, arguments, ends[1], fileno(output));
    } else {
        cause = errno;
    }
    if (ends[1] >= 0) close(ends[1]);
    if (cause == 0) return child;
    *missing = cause == ENOENT;
    fail(error, ERROR_ENVIRONMENT, "%s: cannot be run: %s", arguments[0], strerror(cause));
    if (ends[0] >= 0) close(ends[0]);
    if (child->log) fclose(child->log);
    free(child);
    return NULL;
}

enum child_state child_feed(struct child *child, const void *data, size_t size, size_t *taken, bool wait)
{
    while (*taken < size) {
        ssize_t sent = send(child->feed, (const char *)data + *taken, size - *taken, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0) {
            *taken += (size_t)sent;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            if (!wait || poll(&(struct pollfd){child->feed, POLLOUT, 0}, 1, PATIENCE) <= 0) return CHILD_RUNS;
        } else if (errno != EINTR) {
            return CHILD_FAILED;
        }
    }
    return CHILD_DONE;
}

static void hang_up(struct child *child)
{
    if (child->feed >= 0) close(child->feed);
    child->feed = -1;
}

enum child_state child_finish(struct child *child, bool wait)
{
    int status;
    hang_up(child);
    pid_t ended = waitpid(child->process, &status, WNOHANG);
    for (int waited = 0; wait && ended == 0 && waited < PATIENCE; waited += 5) {
        poll(NULL, 0, 5);
        ended = waitpid(child->process, &status, WNOHANG);
    }
    if (ended == 0) return CHILD_RUNS;
    child->process = 0;
    return ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? CHILD_DONE : CHILD_FAILED;
}

void child_complaint(struct child *child, char *line, size_t size)
{
    char next[512];
    line[0] = '\0';
    rewind(child->log);
    while (fgets(next, sizeof next, child->log)) {
        next[strcspn(next, "\r\n")] = '\0';
        if (next[0]) snprintf(line, size, "%s", next);
    }
}

void child_end(struct child *child)
{
    if (!child) return;
    hang_up(child);
    if (child->process > 0) {
        kill(child->process, SIGKILL);
        while (waitpid(child->process, NULL, 0) < 0 && errno == EINTR) continue;
    }
    fclose(child->log);
    free(child);
}
