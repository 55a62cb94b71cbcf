/// Ends the process cleanly when the connection to X or Wayland is lost.
#include "platform/surface.h"
#include <poll.h>
#include <unistd.h>

enum { EXIT_LOST = 3 };
enum { BAD_WINDOW = 3, BAD_DRAWABLE = 9 }; ///< X error codes

/// Copied from <X11/Xlib.h>, to need no package for it.
struct x_error {
    int type;
    void *display;
    unsigned long resource, serial;
    unsigned char code, request, minor;
};

struct wl_display;

static platform_rescue *rescue;
static void *rescue_user;
static unsigned long own; ///< our window
static bool error_seen;

typedef int x_handler(void *display);
typedef int x_error_handler(void *display, void *event);

/// Skips exit() handlers, which would talk to the display.
static _Noreturn void end(void)
{
    platform_rescue *once = rescue;
    rescue = NULL;
    if (once) once(rescue_user);
    _exit(EXIT_LOST);
}

/// Xlib calls this when the connection breaks, and ends the process on return.
static int on_io_error(void *display)
{
    (void)display;
    end();
}

/// Xlib's default handler ends the process even for harmless errors, such as a vanished clipboard owner. A destroyed window must be handled
/// before the frame ends: Mesa's software drivers read its size without checking and crash.
static int on_error(void *display, void *event)
{
    (void)display;
    const struct x_error *error = event;
    if (rescue && own && error->resource == own && (error->code == BAD_WINDOW || error->code == BAD_DRAWABLE)) end();
    error_seen = true;
    return 0;
}

/// GLFW replaces the error handler when it expects an error.
static bool handle_errors(void)
{
    static x_error_handler *(*set)(x_error_handler *);
    if (!set && !symbol_find("XSetErrorHandler", &set)) return false;
    set(on_error);
    return true;
}

void platform_on_lost(platform_rescue *function, void *user)
{
    x_handler *(*set)(x_handler *);
    rescue = function;
    rescue_user = user;
    if (symbol_find("XSetIOErrorHandler", &set)) set(on_io_error);
    handle_errors();
}

/// libwayland notices a dead compositor only when it reads, and GLFW has stopped reading by then.
static bool is_wayland_lost(void)
{
    struct wl_display *(*get_display)(void);
    int (*get_fd)(struct wl_display *), (*get_error)(struct wl_display *);
    struct wl_display *display = symbol_find("glfwGetWaylandDisplay", &get_display) ? get_display() : NULL;
    if (!display || !symbol_find("wl_display_get_fd", &get_fd) || !symbol_find("wl_display_get_error", &get_error))
        return false;
    struct pollfd end = {.fd = get_fd(display)};
    return get_error(display) != 0 || (poll(&end, 1, 0) > 0 && (end.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0);
}

void window_check(const struct window *window, bool idle)
{
    if (rescue && is_wayland_lost()) end();
    if (!rescue || !handle_errors()) return;
    own = window_number(window);
    if (!error_seen && !idle) return;
    error_seen = false;
    window_ask_place(window);
}
