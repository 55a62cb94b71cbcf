/// A GLFW window: its callbacks and keys, and a clean end when the connection to X or Wayland is lost.
#include "base/need.h"
#include "base/progress.h"
#include "platform/process.h"
#include "platform/surface.h"
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <poll.h>
#include <unistd.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CURSOR_KINDS = CURSOR_TEXT + 1 };

struct window {
    GLFWwindow *handle;
    struct event_queue *queue;
    GLFWcursor *cursors[CURSOR_KINDS]; ///< created when there is a pointer
    bool has_cursors;
    enum mouse_cursor cursor;
    struct surface_size size;
    float units; ///< logical pixels per GLFW window coordinate
    struct clicks clicks;
    bool is_shown; ///< since the first swap
    bool is_fullscreen;
    int x, y, width, height; ///< before full screen
};

// --- GLFW's keys

static const int special_keys[GLFW_KEY_LAST + 1] = {
    [GLFW_KEY_SPACE] = KEY_SPACE,     [GLFW_KEY_ESCAPE] = KEY_ESCAPE,
    [GLFW_KEY_ENTER] = KEY_ENTER,     [GLFW_KEY_KP_ENTER] = KEY_ENTER,
    [GLFW_KEY_TAB] = KEY_TAB,         [GLFW_KEY_BACKSPACE] = KEY_BACKSPACE,
    [GLFW_KEY_INSERT] = KEY_INSERT,   [GLFW_KEY_DELETE] = KEY_DELETE,
    [GLFW_KEY_LEFT] = KEY_LEFT,       [GLFW_KEY_RIGHT] = KEY_RIGHT,
    [GLFW_KEY_UP] = KEY_UP,           [GLFW_KEY_DOWN] = KEY_DOWN,
    [GLFW_KEY_PAGE_UP] = KEY_PAGE_UP, [GLFW_KEY_PAGE_DOWN] = KEY_PAGE_DOWN,
    [GLFW_KEY_HOME] = KEY_HOME,       [GLFW_KEY_END] = KEY_END,
};

/// The ASCII character printed on a key, letters in upper case, or KEY_NONE.
static int printed(int glfw_key, int scancode)
{
    const char *name = glfwGetKeyName(glfw_key, scancode);
    if (!name || name[0] <= ' ' || name[0] >= 0x7F || name[1] != '\0') return KEY_NONE;
    return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
}

/// Whether the keyboard layout has Latin letters.
static bool is_latin(void)
{
    for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; key++) {
        int letter = printed(key, 0);
        if (letter >= 'A' && letter <= 'Z') return true;
    }
    return false;
}

/// Letters and punctuation map by their label, digits, arrows and the rest by position; so do letters if the layout has no Latin ones.
/// KEY_NONE for other keys.
static int key_of(int glfw_key, int scancode)
{
    if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return glfw_key;
    if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12) return KEY_F1 + (glfw_key - GLFW_KEY_F1);
    if (glfw_key >= 0 && glfw_key <= GLFW_KEY_LAST && special_keys[glfw_key]) return special_keys[glfw_key];
    // GLFW numbers keys by US layout.
    bool letter = glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z;
    if (letter && !is_latin()) return glfw_key;
    int key = printed(glfw_key, scancode);
    return key == KEY_NONE && letter ? glfw_key : key;
}

static unsigned mods_of(int glfw_mods)
{
    return (glfw_mods & GLFW_MOD_SHIFT ? (unsigned)MOD_SHIFT : 0u) |
           (glfw_mods & GLFW_MOD_CONTROL ? (unsigned)MOD_CTRL : 0u) |
           (glfw_mods & GLFW_MOD_ALT ? (unsigned)MOD_ALT : 0u) |
           (glfw_mods & GLFW_MOD_SUPER ? (unsigned)MOD_SUPER : 0u);
}

// --- callbacks, which only translate and queue

static struct window *of(GLFWwindow *handle) { return glfwGetWindowUserPointer(handle); }

static void push(struct window *window, struct event event)
{
    event.time = clock_now();
    event_queue_push(window->queue, &event);
}

/// Reads size and scale; true if they changed.
static bool update_size(struct window *window)
{
    struct surface_size before = window->size, now = before;
    int width = 0, height = 0;
    float scale_x = 1.0f, scale_y = 1.0f;
    glfwGetFramebufferSize(window->handle, &now.width, &now.height);
    glfwGetWindowSize(window->handle, &width, &height);
    glfwGetWindowContentScale(window->handle, &scale_x, &scale_y);
    if (now.width < 1 || now.height < 1 || width < 1) return false; // minimised
    now.scale = scale_x > 0.25f && scale_x < 16.0f ? scale_x : 1.0f;
    window->size = now;
    window->units = (float)now.width / (float)width / now.scale;
    return now.width != before.width || now.height != before.height || now.scale != before.scale;
}

static void handle_size(struct window *window)
{
    if (!update_size(window)) return;
    struct surface_size size = window->size;
    push(window, (struct event){.kind = EVENT_SIZE,
                                .x = (float)size.width / size.scale,
                                .y = (float)size.height / size.scale,
                                .scale = size.scale});
}

static void on_framebuffer_size(GLFWwindow *handle, int width, int height)
{
    (void)width;
    (void)height;
    handle_size(of(handle));
}

static void on_content_scale(GLFWwindow *handle, float x, float y)
{
    (void)x;
    (void)y;
    handle_size(of(handle));
}

static void on_focus(GLFWwindow *handle, int focused)
{
    if (focused) push(of(handle), (struct event){.kind = EVENT_FOCUS});
}

static void on_refresh(GLFWwindow *handle) { push(of(handle), (struct event){.kind = EVENT_EXPOSE}); }

static void on_close(GLFWwindow *handle)
{
    // The app decides after asking about unsaved work.
    glfwSetWindowShouldClose(handle, GLFW_FALSE);
    push(of(handle), (struct event){.kind = EVENT_CLOSE});
}

static enum event_action action_of(int glfw_action)
{
    return glfw_action == GLFW_PRESS ? ACTION_PRESS : glfw_action == GLFW_REPEAT ? ACTION_REPEAT : ACTION_RELEASE;
}

static void on_character(GLFWwindow *handle, unsigned codepoint)
{
    push(of(handle), (struct event){.kind = EVENT_TEXT, .codepoint = codepoint});
}

static void pointer_place(struct window *window, float *x, float *y)
{
    double window_x = 0.0, window_y = 0.0;
    glfwGetCursorPos(window->handle, &window_x, &window_y);
    *x = (float)window_x * window->units;
    *y = (float)window_y * window->units;
}

/// GLFW does not report modifiers with the wheel.
static unsigned mods_now(GLFWwindow *handle)
{
    static const struct {
        int left, right;
        unsigned mod;
    } keys[] = {{GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, MOD_SHIFT},
                {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, MOD_CTRL},
                {GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, MOD_ALT},
                {GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER, MOD_SUPER}};
    unsigned mods = 0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        bool down = glfwGetKey(handle, keys[i].left) == GLFW_PRESS || glfwGetKey(handle, keys[i].right) == GLFW_PRESS;
        if (down) mods |= keys[i].mod;
    }
    return mods;
}

/// GLFW 3.3 crashes if it makes a cursor on a Wayland display without a pointer.
static void create_cursors(struct window *window)
{
    static const int shapes[CURSOR_KINDS] = {
        [CURSOR_ARROW] = GLFW_ARROW_CURSOR,        [CURSOR_HAND] = GLFW_HAND_CURSOR,
        [CURSOR_HORIZONTAL] = GLFW_HRESIZE_CURSOR, [CURSOR_VERTICAL] = GLFW_VRESIZE_CURSOR,
        [CURSOR_MOVE] = GLFW_CROSSHAIR_CURSOR,     [CURSOR_TEXT] = GLFW_IBEAM_CURSOR,
    };
    window->has_cursors = true;
    for (int i = 0; i < CURSOR_KINDS; i++) window->cursors[i] = glfwCreateStandardCursor(shapes[i]);
}

static void on_pointer(GLFWwindow *handle, double x, double y)
{
    struct window *window = of(handle);
    if (!window->has_cursors) create_cursors(window);
    push(window, (struct event){.kind = EVENT_POINTER,
                                .x = (float)x * window->units,
                                .y = (float)y * window->units,
                                .mods = mods_now(handle)});
}

static void on_key(GLFWwindow *handle, int glfw_key, int scancode, int action, int glfw_mods)
{
    struct window *window = of(handle);
    int key = key_of(glfw_key, scancode);
    if (key == KEY_NONE) { // Alt, say
        double x = 0.0, y = 0.0;
        glfwGetCursorPos(handle, &x, &y);
        on_pointer(handle, x, y);
        return;
    }
    push(window,
         (struct event){.kind = EVENT_KEY, .key = key, .action = action_of(action), .mods = mods_of(glfw_mods)});
}

static void on_button(GLFWwindow *handle, int glfw_button, int action, int glfw_mods)
{
    struct window *window = of(handle);
    if (glfw_button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    enum event_button button = glfw_button == GLFW_MOUSE_BUTTON_LEFT    ? BUTTON_LEFT
                               : glfw_button == GLFW_MOUSE_BUTTON_RIGHT ? BUTTON_RIGHT
                                                                        : BUTTON_MIDDLE;
    struct event event = {
        .kind = EVENT_BUTTON, .button = button, .action = action_of(action), .mods = mods_of(glfw_mods), .clicks = 1};
    pointer_place(window, &event.x, &event.y);
    if (event.action == ACTION_PRESS)
        event.clicks = clicks_count(&window->clicks, button, event.x, event.y, clock_now());
    push(window, event);
}

static void on_wheel(GLFWwindow *handle, double dx, double dy)
{
    struct window *window = of(handle);
    struct event event = {.kind = EVENT_WHEEL, .dx = (float)dx, .dy = (float)dy, .mods = mods_now(handle)};
    pointer_place(window, &event.x, &event.y);
    push(window, event);
}

static void on_drop(GLFWwindow *handle, int count, const char **paths)
{
    struct window *window = of(handle);
    for (int i = 0; i < count; i++) event_queue_push_drop(window->queue, paths[i], clock_now());
}

static GLFWwindow *open_handle(int width, int height, const char *title)
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_NATIVE_CONTEXT_API);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, gl_debug_wanted());
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    // Desktops match wiggly.desktop and its icon by these names.
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "wiggly");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "wiggly");
#ifdef GLFW_WAYLAND_APP_ID // GLFW 3.4
    glfwWindowHintString(GLFW_WAYLAND_APP_ID, "wiggly");
#endif
    return glfwCreateWindow(width, height, title, NULL, NULL);
}

/// Fails with GLFW's reason.
static bool fail_glfw(struct error *error, const char *what)
{
    const char *reason = NULL;
    int code = glfwGetError(&reason);
    return fail(error, ERROR_ENVIRONMENT, "%s: %s (GLFW 0x%08X)", what, reason ? reason : "no reason given",
                (unsigned)code);
}

struct window *window_create(int width, int height, const char *title, int vsync, struct event_queue *queue,
                             struct error *error)
{
    if (!glfwInit()) {
        fail_glfw(error, "no window opens");
        return NULL;
    }
    struct window *window = need_zeroed(1, sizeof *window);
    window->handle = open_handle(width, height, title);
    if (!window->handle) {
        fail_glfw(error, "no window with OpenGL 3.3 opens");
        free(window);
        glfwTerminate();
        return NULL;
    }
    window->queue = queue;
    window->units = 1.0f;
    glfwSetWindowUserPointer(window->handle, window);
    glfwSetWindowSizeLimits(window->handle, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window->handle);
    glfwSwapInterval(vsync);
    update_size(window);
    glfwSetFramebufferSizeCallback(window->handle, on_framebuffer_size);
    glfwSetWindowContentScaleCallback(window->handle, on_content_scale);
    glfwSetWindowRefreshCallback(window->handle, on_refresh);
    glfwSetWindowFocusCallback(window->handle, on_focus);
    glfwSetWindowCloseCallback(window->handle, on_close);
    glfwSetKeyCallback(window->handle, on_key);
    glfwSetCharCallback(window->handle, on_character);
    glfwSetCursorPosCallback(window->handle, on_pointer);
    glfwSetMouseButtonCallback(window->handle, on_button);
    glfwSetScrollCallback(window->handle, on_wheel);
    glfwSetDropCallback(window->handle, on_drop);
    return window;
}

void window_destroy(struct window *window)
{
    for (int i = 0; i < CURSOR_KINDS; i++) {
        if (window->cursors[i]) glfwDestroyCursor(window->cursors[i]);
    }
    glfwDestroyWindow(window->handle);
    glfwTerminate();
    free(window);
}

// --- the display is lost

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
static unsigned long own; ///< our window's X number
static bool error_seen;

typedef int x_handler(void *display);
typedef int x_error_handler(void *display, void *event);

/// Skips exit() handlers, which would talk to the display.
static _Noreturn void end_lost(void)
{
    platform_rescue *once = rescue;
    rescue = NULL;
    if (once) once(rescue_user);
    _exit(EXIT_LOST);
}

/// Xlib calls this when the connection breaks, and ends the process on return.
static int on_x_io_error(void *display)
{
    (void)display;
    end_lost();
}

/// Xlib's default handler ends the process even for harmless errors, such as a vanished clipboard owner. A destroyed window must be handled
/// before the frame ends: Mesa's software drivers read its size without checking and crash.
static int on_x_error(void *display, void *event)
{
    (void)display;
    const struct x_error *error = event;
    if (rescue && own && error->resource == own && (error->code == BAD_WINDOW || error->code == BAD_DRAWABLE))
        end_lost();
    error_seen = true;
    return 0;
}

/// Stores the address of a symbol from a library GLFW may have loaded, without linking to it. false if there is none.
static bool symbol_find(const char *name, void *pointer)
{
    void *symbol = dlsym(RTLD_DEFAULT, name);
    if (symbol) memcpy(pointer, &symbol, sizeof symbol);
    return symbol != NULL;
}

/// GLFW replaces the error handler when it expects an error.
static bool handle_errors(void)
{
    static x_error_handler *(*set)(x_error_handler *);
    if (!set && !symbol_find("XSetErrorHandler", &set)) return false;
    set(on_x_error);
    return true;
}

void platform_on_lost(platform_rescue *function, void *user)
{
    x_handler *(*set)(x_handler *);
    rescue = function;
    rescue_user = user;
    if (symbol_find("XSetIOErrorHandler", &set)) set(on_x_io_error);
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

/// Ends the process as described at platform_on_lost() if another program destroyed the window. X errors reveal that; while `idle`, nothing
/// is drawn, so this queries the window.
static void check_window(const struct window *window, bool idle)
{
    if (rescue && is_wayland_lost()) end_lost();
    if (!rescue || !handle_errors()) return;
    static unsigned long (*number)(GLFWwindow *);
    own = number || symbol_find("glfwGetX11Window", &number) ? number(window->handle) : 0;
    if (!error_seen && !idle) return;
    error_seen = false;
    int x, y;
    glfwGetWindowPos(window->handle, &x, &y); // an error if the window is gone
}

// --- of the platform

const struct event *platform_events(struct platform *platform, double seconds, int *count)
{
    static const double idle = 0.1; ///< seconds; animations wait less
    if (!platform->window) {
        process_sleep(seconds);
    } else if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    const struct event *events = event_queue_take(&platform->queue, count);
    if (platform->window) check_window(platform->window, *count == 0 && seconds > idle);
    return events;
}

void platform_size(const struct platform *platform, int *width, int *height, float *scale)
{
    const struct surface_size size = platform->window ? platform->window->size : platform->size;
    *width = size.width;
    *height = size.height;
    *scale = size.scale;
}

/// Shows the window with its first frame, and tests whether a swap keeps the back buffer: no older buffer can hold this frame's middle row.
static bool swap_first(struct window *window)
{
    const int width = window->size.width, y = window->size.height / 2;
    const size_t bytes = 4 * (size_t)width;
    // On a GPU the standard leaves the content undefined, whatever one test shows.
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    const bool is_software = renderer && (strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe"));
    unsigned char *before = is_software ? need(2, bytes) : NULL, *after = before ? before + bytes : NULL;
    if (before) glReadPixels(0, y, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, before);
    glfwShowWindow(window->handle);
    glfwSwapBuffers(window->handle);
    if (before) glReadPixels(0, y, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, after);
    const bool keeps = before && memcmp(before, after, bytes) == 0;
    free(before);
    return keeps;
}

void platform_swap(struct platform *platform)
{
    struct window *window = platform->window;
    if (!window) {
        glFinish();
    } else if (window->is_shown) {
        glfwSwapBuffers(window->handle);
    } else {
        platform->keeps = swap_first(window);
        window->is_shown = true;
    }
}

bool platform_is_window(const struct platform *platform) { return platform->window != NULL; }

void platform_title(struct platform *platform, const char *title)
{
    if (platform->window) glfwSetWindowTitle(platform->window->handle, title);
}

const char *platform_clipboard(struct platform *platform)
{
    return platform->window ? glfwGetClipboardString(platform->window->handle) : platform->clipboard;
}

void platform_set_clipboard(struct platform *platform, const char *text)
{
    if (platform->window) {
        glfwSetClipboardString(platform->window->handle, text);
    } else {
        free(platform->clipboard);
        platform->clipboard = need_text(text);
    }
}

/// The monitor with most of the window.
static GLFWmonitor *nearest_monitor(struct window *window)
{
    int count = 0, x = 0, y = 0, width = 0, height = 0;
    GLFWmonitor **monitors = glfwGetMonitors(&count), *best = glfwGetPrimaryMonitor();
    glfwGetWindowPos(window->handle, &x, &y);
    glfwGetWindowSize(window->handle, &width, &height);
    double largest = 0.0;
    for (int i = 0; i < count; i++) {
        int left = 0, top = 0;
        const GLFWvidmode *mode = glfwGetVideoMode(monitors[i]);
        glfwGetMonitorPos(monitors[i], &left, &top);
        if (!mode) continue;
        double w = fmin(x + width, left + mode->width) - fmax(x, left);
        double h = fmin(y + height, top + mode->height) - fmax(y, top);
        double shared = fmax(w, 0.0) * fmax(h, 0.0);
        if (shared <= largest) continue;
        largest = shared;
        best = monitors[i];
    }
    return best;
}

double platform_refresh_rate(struct platform *platform)
{
    GLFWmonitor *monitor = platform->window ? nearest_monitor(platform->window) : NULL;
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    return mode ? mode->refreshRate : 0.0;
}

void platform_toggle_fullscreen(struct platform *platform)
{
    struct window *window = platform->window;
    if (!window) return;
    if (window->is_fullscreen) {
        glfwSetWindowMonitor(window->handle, NULL, window->x, window->y, window->width, window->height,
                             GLFW_DONT_CARE);
    } else {
        GLFWmonitor *monitor = nearest_monitor(window);
        const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
        if (!mode) return;
        glfwGetWindowPos(window->handle, &window->x, &window->y);
        glfwGetWindowSize(window->handle, &window->width, &window->height);
        glfwSetWindowMonitor(window->handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
    window->is_fullscreen = !window->is_fullscreen;
}

void platform_cursor(struct platform *platform, enum mouse_cursor cursor)
{
    struct window *window = platform->window;
    if (!window || !window->has_cursors || cursor == window->cursor) return;
    window->cursor = cursor;
    if (window->cursors[cursor]) glfwSetCursor(window->handle, window->cursors[cursor]);
}
