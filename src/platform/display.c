/// Asks whether a local display answers, without waiting for it.
#include "platform/surface.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/// Whether somebody listens on a local socket. A name that begins with NUL is an abstract socket of Linux.
static bool answers(const char *name, size_t length)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (length == 0 || length >= sizeof address.sun_path) return false;
    memcpy(address.sun_path, name, length);
    int handle = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (handle < 0) return false;
    socklen_t size = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length);
    bool ok = connect(handle, (const struct sockaddr *)&address, size) == 0;
    close(handle);
    return ok;
}

/// ":1" and ":1.0" are local; a name with a host is trusted, because asking could take minutes.
static bool x11_answers(const char *display)
{
    const char *colon = strrchr(display, ':');
    if (!colon) return false;
    if (colon != display && strncmp(display, "unix:", 5) != 0) return true;
    char path[64];
    int length = snprintf(path, sizeof path, "%c/tmp/.X11-unix/X%d", '\0', atoi(colon + 1));
    return answers(path, (size_t)length) || answers(path + 1, (size_t)length - 1);
}

static bool wayland_answers(const char *display)
{
    char path[256];
    const char *folder = getenv("XDG_RUNTIME_DIR");
    // Only some builds of GLFW can open Wayland windows.
    if (!strstr(glfwGetVersionString(), "Wayland")) return false;
    if (display[0] != '/' && !folder) return false;
    int length = display[0] == '/' ? snprintf(path, sizeof path, "%s", display)
                                   : snprintf(path, sizeof path, "%s/%s", folder, display);
    return length < (int)sizeof path && answers(path, (size_t)length);
}

bool display_answers(void)
{
    const char *x11 = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    return (x11 && *x11 && x11_answers(x11)) || (wayland && *wayland && wayland_answers(wayland));
}
