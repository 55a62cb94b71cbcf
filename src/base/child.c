/// Runs other programs, such as ffmpeg.
#include "base/child.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

int child_start(struct child *child, char *const *arguments, int input, int output)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none, usual;
    *child = (struct child){.words = tmpfile()};
    if (!child->words) return errno;
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    sigaddset(&usual, SIGPIPE);
    posix_spawn_file_actions_init(&files);
    if (input >= 0) posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (output >= 0) posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, fileno(child->words), STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    const int cause = posix_spawnp(&child->process, arguments[0], &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (cause == 0) return 0;
    child->process = 0;
    child_end(child);
    return cause;
}

enum child_state child_state(struct child *child, int patience)
{
    enum { NAP = 5 };
    int status;
    pid_t ended = waitpid(child->process, &status, WNOHANG);
    for (int waited = 0; ended == 0 && waited < patience; waited += NAP) {
        poll(NULL, 0, NAP);
        ended = waitpid(child->process, &status, WNOHANG);
    }
    if (ended == 0) return CHILD_RUNS;
    child->process = 0;
    return ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? CHILD_DONE : CHILD_FAILED;
}

void child_last_words(const struct child *child, char *words, size_t size)
{
    char next[512];
    snprintf(words, size, "it was ended");
    rewind(child->words);
    while (fgets(next, sizeof next, child->words)) {
        next[strcspn(next, "\r\n")] = '\0';
        if (next[0]) snprintf(words, size, "%s", next);
    }
}

void child_end(struct child *child)
{
    enum { GRACE = 100 }; // milliseconds
    if (child->process > 0) kill(child->process, SIGTERM);
    if (child->process > 0 && child_state(child, GRACE) == CHILD_RUNS) {
        kill(child->process, SIGKILL);
        while (waitpid(child->process, NULL, 0) < 0 && errno == EINTR) continue;
    }
    if (child->words) fclose(child->words);
    *child = (struct child){0};
}
