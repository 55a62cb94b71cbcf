/// Passes turns to and from another program through pipes.
#include "platform/turns.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

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
