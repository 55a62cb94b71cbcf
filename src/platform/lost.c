#include "platform/platform.h"
#include <dlfcn.h>
#include <string.h>
#include <unistd.h>

enum { EXIT_LOST = 3 };

static platform_rescue *rescue;
static void *rescue_user;

/// Xlib calls this when the connection breaks, wherever in the program that shows, and ends the process on return.
static int on_io_error(void *display)
{
    (void)display;
    platform_rescue *once = rescue;
    rescue = NULL;
    if (once) once(rescue_user);
    _exit(EXIT_LOST); // handlers of exit() would talk to the display
}

void platform_on_lost(platform_rescue *function, void *user)
{
    int (*(*set_handler)(int (*)(void *)))(void *);
    rescue = function;
    rescue_user = user;
    // GLFW has loaded Xlib where it uses it, which saves the program a dependency of its own.
    void *symbol = dlsym(RTLD_DEFAULT, "XSetIOErrorHandler");
    if (!symbol) return;
    memcpy(&set_handler, &symbol, sizeof symbol);
    set_handler(on_io_error);
}
