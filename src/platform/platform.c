/// The surfaces of a desktop: an EGL one without a display; a GLFW window, its keys and callbacks, and a clean end when the connection to X or
/// Wayland is lost. Collects the OpenGL driver's messages, and works around graphics drivers.
#include "platform/platform.h"
#include "base/hash.h"
#include "base/need.h"
#include "base/progress.h"
#include "platform/events.h"
#include "platform/process.h"
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <link.h>
#include <malloc.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>

// --- the driver's messages (--gl-debug)

enum { SEEN_MAX = 64 };

/// Global, because the driver can call back at any time; the process has one context.
static struct {
    uint64_t seen[SEEN_MAX];
    int seen_count, complaints;
    bool wanted;
} messages;

static void APIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                const GLchar *text, const void *user)
{
    static const char *const kinds[] = {"error", "deprecated", "undefined", "portability", "performance"};
    const GLenum kind = type - GL_DEBUG_TYPE_ERROR; // GL's numbers are in this order
    (void)source;
    (void)user;
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    const size_t size = length < 0 ? strlen(text) : (size_t)length;
    // Performance hints and low severity are printed but not counted.
    const bool is_mild = type == GL_DEBUG_TYPE_OTHER && severity == GL_DEBUG_SEVERITY_LOW;
    messages.complaints += type != GL_DEBUG_TYPE_PERFORMANCE && !is_mild;

    const uint64_t hash = hash_bytes(HASH_START, text, size);
    for (int i = 0; i < messages.seen_count; i++) {
        if (messages.seen[i] == hash) return;
    }
    if (messages.seen_count < SEEN_MAX) messages.seen[messages.seen_count++] = hash;
    fprintf(stderr, "OpenGL, %s %u: %.*s\n", kind < sizeof kinds / sizeof *kinds ? kinds[kind] : "other", id,
            (int)size, text);
}

void platform_debug_gl(void) { messages.wanted = true; }

/// Listens to the current context if wanted. false if its driver has no debug output.
static bool gl_debug_start(struct error *error)
{
    if (!messages.wanted) return true;
    if (epoxy_gl_version() < 43 && !epoxy_has_gl_extension("GL_KHR_debug"))
        return fail(error, ERROR_ENVIRONMENT, "--gl-debug: this OpenGL driver has no GL_KHR_debug");
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // so that a debugger stops at the offending call
    glDebugMessageCallback(on_message, NULL);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_TRUE);
    return true;
}

int platform_gl_complaints(void) { return messages.complaints; }

// --- an EGL surface without a display

#ifdef __SANITIZE_ADDRESS__
/// Keeps a loaded Mesa library in memory.
static int pin_library(struct dl_phdr_info *info, size_t size, void *context)
{
    (void)size;
    (void)context;
    if (strstr(info->dlpi_name, "_dri.so")) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
}

// Mesa's driver leaks a few blocks when unloaded. While it stays loaded, the leak checker finds pointers to them, or names to suppress.
static void keep_driver_loaded(void) { dl_iterate_phdr(pin_library, NULL); }
#else
static void keep_driver_loaded(void) {}
#endif

enum { DEVICES_MAX = 16 };

struct offscreen {
    EGLDisplay display;
    EGLContext context;
    GLuint framebuffer, color, depth;
};

/// Makes a 3.3 core context without a surface current. Cleans up on failure.
static bool open_display(struct offscreen *offscreen, EGLDisplay display)
{
    static const EGLint config_wishes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                           EGL_NONE};
    const EGLint context_wishes[] = {EGL_CONTEXT_FLAGS_KHR,
                                     messages.wanted ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                                     EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    EGLint major = 0, minor = 0, count = 0;
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return false;
    EGLContext context = EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display, config_wishes, &config, 1, &count) && count > 0) {
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wishes);
    }
    if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        offscreen->display = display;
        offscreen->context = context;
        return true;
    }
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
    return false;
}

/// Tries all hardware or all software devices.
static bool open_device(struct offscreen *offscreen, const char *client_extensions, bool software)
{
    if (!epoxy_extension_in_string(client_extensions, "EGL_EXT_platform_device")) return false;
    bool enumerable = epoxy_extension_in_string(client_extensions, "EGL_EXT_device_base") ||
                      epoxy_extension_in_string(client_extensions, "EGL_EXT_device_enumeration");
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = 0;
    if (!enumerable || !eglQueryDevicesEXT(DEVICES_MAX, devices, &count)) return false;
    for (EGLint i = 0; i < count; i++) {
        const char *extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
        if (epoxy_extension_in_string(extensions, "EGL_MESA_device_software") != software) continue;
        if (open_display(offscreen, eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL))) return true;
    }
    return false;
}

/// Tries GPUs, then Mesa's surfaceless platform, then its software device.
static bool open_any(struct offscreen *offscreen, struct error *error)
{
    static const char *const names[] = {"libEGL.so.1", "libOpenGL.so.0", "libGL.so.1"};
    bool have[3]; // epoxy ends the process if a library is missing
    for (int i = 0; i < 3; i++) {
        void *library = dlopen(names[i], RTLD_LAZY | RTLD_LOCAL);
        have[i] = library != NULL;
        if (library) dlclose(library);
    }
    if (!have[0])
        return fail(error, ERROR_ENVIRONMENT, "libEGL.so.1 is missing: install libegl1 and libgl1-mesa-dri");
    if (!have[1] && !have[2]) return fail(error, ERROR_ENVIRONMENT, "libGL.so.1 is missing: install libgl1");

    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (open_device(offscreen, extensions, false)) return true;
    if (epoxy_extension_in_string(extensions, "EGL_MESA_platform_surfaceless") &&
        open_display(offscreen, eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL))) {
        return true;
    }
    if (open_device(offscreen, extensions, true)) return true;
    return fail(error, ERROR_ENVIRONMENT,
                "no EGL device gives an OpenGL 3.3 context without a display: install libgl1-mesa-dri");
}

// --- a window

enum { CURSOR_KINDS = CURSOR_TEXT + 1 };

struct window {
    GLFWwindow *handle;
    GLFWcursor *cursors[CURSOR_KINDS]; ///< created when there is a pointer
    bool has_cursors;
    enum mouse_cursor cursor;
    float units; ///< logical pixels per GLFW window coordinate
    struct clicks clicks;
    bool is_shown; ///< since the first swap
    bool is_fullscreen;
    int x, y, width, height; ///< before full screen
};

/// The ASCII character printed on a key, letters in upper case, or KEY_NONE.
static int printed(int glfw_key, int scancode)
{
    const char *name = glfwGetKeyName(glfw_key, scancode);
    if (!name || name[0] <= ' ' || name[0] >= 0x7F || name[1] != '\0') return KEY_NONE;
    return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
}

/// Letters and punctuation map by their label, digits, arrows and the rest by position; so do letters if the layout has no Latin ones.
/// KEY_NONE for other keys.
static int key_of(int glfw_key, int scancode)
{
    if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return glfw_key;
    if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12) return KEY_F1 + (glfw_key - GLFW_KEY_F1);
    if (glfw_key == GLFW_KEY_SPACE || (glfw_key >= GLFW_KEY_ESCAPE && glfw_key <= GLFW_KEY_END)) return glfw_key;
    if (glfw_key == GLFW_KEY_KP_ENTER) return KEY_ENTER;
    // GLFW numbers keys by US layout.
    bool letter = glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z;
    bool is_latin = !letter; // or the keyboard's layout has Latin letters
    for (int key = GLFW_KEY_A; !is_latin && key <= GLFW_KEY_Z; key++) {
        int label = printed(key, 0);
        is_latin = label >= 'A' && label <= 'Z';
    }
    if (!is_latin) return glfw_key;
    int key = printed(glfw_key, scancode);
    return key == KEY_NONE && letter ? glfw_key : key;
}

// Our buttons, actions, modifiers and many keys have GLFW's numbers, which has more modifiers.
_Static_assert(BUTTON_LEFT == GLFW_MOUSE_BUTTON_LEFT && BUTTON_RIGHT == GLFW_MOUSE_BUTTON_RIGHT &&
                   BUTTON_MIDDLE == GLFW_MOUSE_BUTTON_MIDDLE && ACTION_RELEASE == GLFW_RELEASE &&
                   ACTION_PRESS == GLFW_PRESS && ACTION_REPEAT == GLFW_REPEAT && MOD_SHIFT == GLFW_MOD_SHIFT &&
                   MOD_CTRL == GLFW_MOD_CONTROL && MOD_ALT == GLFW_MOD_ALT && MOD_SUPER == GLFW_MOD_SUPER &&
                   KEY_SPACE == GLFW_KEY_SPACE && KEY_ESCAPE == GLFW_KEY_ESCAPE && KEY_DELETE == GLFW_KEY_DELETE &&
                   KEY_RIGHT == GLFW_KEY_RIGHT && KEY_UP == GLFW_KEY_UP && KEY_END == GLFW_KEY_END,
               "the same numbers");
static const unsigned OUR_MODS = MOD_SHIFT | MOD_CTRL | MOD_ALT | MOD_SUPER;

// Callbacks, which only translate and queue

static void push(GLFWwindow *handle, struct event event)
{
    struct platform *platform = glfwGetWindowUserPointer(handle);
    event.time = clock_now();
    event_queue_push(&platform->queue, &event);
}

/// Reads size and scale; true if they changed.
static bool update_size(struct platform *platform)
{
    GLFWwindow *handle = platform->window->handle;
    int device_width = 0, device_height = 0, width = 0, height = 0;
    float scale = 1.0f, scale_y = 1.0f;
    glfwGetFramebufferSize(handle, &device_width, &device_height);
    glfwGetWindowSize(handle, &width, &height);
    glfwGetWindowContentScale(handle, &scale, &scale_y);
    if (device_width < 1 || device_height < 1 || width < 1) return false; // minimised
    if (!(scale > 0.25f && scale < 16.0f)) scale = 1.0f;
    const bool changes =
        device_width != platform->width || device_height != platform->height || scale != platform->scale;
    platform->width = device_width;
    platform->height = device_height;
    platform->scale = scale;
    platform->window->units = (float)device_width / (float)width / scale;
    return changes;
}

static void on_framebuffer_size(GLFWwindow *handle, int width, int height)
{
    (void)width, (void)height;
    struct platform *p = glfwGetWindowUserPointer(handle);
    if (update_size(p))
        push(handle, (struct event){.kind = EVENT_SIZE,
                                    .x = (float)p->width / p->scale,
                                    .y = (float)p->height / p->scale,
                                    .scale = p->scale});
}

static void on_content_scale(GLFWwindow *handle, float x, float y)
{
    (void)x, (void)y;
    on_framebuffer_size(handle, 0, 0);
}

static void on_focus(GLFWwindow *handle, int focused)
{
    if (focused) push(handle, (struct event){.kind = EVENT_FOCUS});
}

static void on_refresh(GLFWwindow *handle) { push(handle, (struct event){.kind = EVENT_EXPOSE}); }

static void on_close(GLFWwindow *handle)
{
    // The app decides after asking about unsaved work.
    glfwSetWindowShouldClose(handle, GLFW_FALSE);
    push(handle, (struct event){.kind = EVENT_CLOSE});
}

static void on_character(GLFWwindow *handle, unsigned codepoint)
{
    push(handle, (struct event){.kind = EVENT_TEXT, .codepoint = codepoint});
}

static void set_place(struct event *event, GLFWwindow *handle)
{
    const struct platform *platform = glfwGetWindowUserPointer(handle);
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(handle, &x, &y);
    event->x = (float)x * platform->window->units;
    event->y = (float)y * platform->window->units;
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

static void on_pointer(GLFWwindow *handle, double x, double y)
{
    static const int shapes[CURSOR_KINDS] = {
        [CURSOR_ARROW] = GLFW_ARROW_CURSOR,        [CURSOR_HAND] = GLFW_HAND_CURSOR,
        [CURSOR_HORIZONTAL] = GLFW_HRESIZE_CURSOR, [CURSOR_VERTICAL] = GLFW_VRESIZE_CURSOR,
        [CURSOR_MOVE] = GLFW_CROSSHAIR_CURSOR,     [CURSOR_TEXT] = GLFW_IBEAM_CURSOR,
    };
    const struct platform *platform = glfwGetWindowUserPointer(handle);
    struct window *window = platform->window;
    // Only now: GLFW 3.3 crashes if it makes a cursor on a Wayland display without a pointer.
    for (int i = 0; !window->has_cursors && i < CURSOR_KINDS; i++)
        window->cursors[i] = glfwCreateStandardCursor(shapes[i]);
    window->has_cursors = true;
    push(handle, (struct event){.kind = EVENT_POINTER,
                                .x = (float)x * window->units,
                                .y = (float)y * window->units,
                                .mods = mods_now(handle)});
}

static void on_key(GLFWwindow *handle, int glfw_key, int scancode, int action, int glfw_mods)
{
    int key = key_of(glfw_key, scancode);
    if (key == KEY_NONE) { // Alt, say
        double x = 0.0, y = 0.0;
        glfwGetCursorPos(handle, &x, &y);
        on_pointer(handle, x, y);
        return;
    }
    push(handle, (struct event){.kind = EVENT_KEY,
                                .key = key,
                                .action = (enum event_action)action,
                                .mods = (unsigned)glfw_mods & OUR_MODS});
}

static void on_button(GLFWwindow *handle, int glfw_button, int action, int glfw_mods)
{
    const struct platform *platform = glfwGetWindowUserPointer(handle);
    if (glfw_button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    struct event event = {.kind = EVENT_BUTTON,
                          .button = (enum event_button)glfw_button,
                          .action = (enum event_action)action,
                          .mods = (unsigned)glfw_mods & OUR_MODS,
                          .clicks = 1};
    set_place(&event, handle);
    if (event.action == ACTION_PRESS) event.clicks = clicks_count(&platform->window->clicks, &event, clock_now());
    push(handle, event);
}

static void on_wheel(GLFWwindow *handle, double dx, double dy)
{
    struct event event = {.kind = EVENT_WHEEL, .dx = (float)dx, .dy = (float)dy, .mods = mods_now(handle)};
    set_place(&event, handle);
    push(handle, event);
}

static void on_drop(GLFWwindow *handle, int count, const char **paths)
{
    struct platform *platform = glfwGetWindowUserPointer(handle);
    for (int i = 0; i < count; i++) event_queue_push_drop(&platform->queue, paths[i], clock_now());
}

/// Fails with GLFW's reason.
static bool fail_glfw(struct error *error, const char *what)
{
    const char *reason = NULL;
    int code = glfwGetError(&reason);
    return fail(error, ERROR_ENVIRONMENT, "%s: %s (GLFW 0x%08X)", what, reason ? reason : "no reason given",
                (unsigned)code);
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

static struct platform_calls calls;
static unsigned long own; ///< our window's X number
static bool error_seen;

typedef int x_handler(void *display);
typedef int x_error_handler(void *display, void *event);

/// Skips exit() handlers, which would talk to the display.
static _Noreturn void end_lost(void)
{
    const struct platform_calls once = calls;
    calls.lost = NULL;
    if (once.lost) once.lost(once.user);
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
    if (calls.lost && own && error->resource == own && (error->code == BAD_WINDOW || error->code == BAD_DRAWABLE))
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

void platform_listen(struct platform_calls listener)
{
    x_handler *(*set)(x_handler *);
    calls = listener;
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

// --- the platform

/// Software drivers allocate and free triangle memory every frame. The C library keeps it, which saves a tenth of the CPU time.
static void keep_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest allowed
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error)
{
    keep_memory();
    if (!glfwInit()) {
        fail_glfw(error, "no window opens");
        return NULL;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_NATIVE_CONTEXT_API);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, messages.wanted);
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
    GLFWwindow *handle = glfwCreateWindow(width, height, title, NULL, NULL);
    if (!handle) {
        fail_glfw(error, "no window with OpenGL 3.3 opens");
        glfwTerminate();
        return NULL;
    }
    struct platform *platform = platform_blind(width, height, 1);
    struct window *window = platform->window = need_zeroed(1, sizeof *window);
    window->handle = handle;
    window->units = 1.0f;
    glfwSetWindowUserPointer(handle, platform);
    glfwSetWindowSizeLimits(handle, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(handle);
    glfwSwapInterval(vsync);
    update_size(platform);
    glfwSetFramebufferSizeCallback(handle, on_framebuffer_size);
    glfwSetWindowContentScaleCallback(handle, on_content_scale);
    glfwSetWindowRefreshCallback(handle, on_refresh);
    glfwSetWindowFocusCallback(handle, on_focus);
    glfwSetWindowCloseCallback(handle, on_close);
    glfwSetKeyCallback(handle, on_key);
    glfwSetCharCallback(handle, on_character);
    glfwSetCursorPosCallback(handle, on_pointer);
    glfwSetMouseButtonCallback(handle, on_button);
    glfwSetScrollCallback(handle, on_wheel);
    glfwSetDropCallback(handle, on_drop);
    keep_driver_loaded();
    if (gl_debug_start(error)) return platform;
    platform_destroy(platform);
    return NULL;
}

struct platform *platform_offscreen(int width, int height, float scale, struct error *error)
{
    struct platform *platform = platform_blind(width, height, scale);
    keep_memory();
    platform->offscreen = need_zeroed(1, sizeof *platform->offscreen);
    platform->keeps = true;
    if (!open_any(platform->offscreen, error)) {
        free(platform->offscreen);
        free(platform);
        return NULL;
    }
    keep_driver_loaded();
    GLint largest = 0;
    struct offscreen *offscreen = platform->offscreen;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        fail(error, ERROR_ENVIRONMENT, "expected a picture of 1 to %d pixels a side, got %d × %d", largest, width,
             height);
        platform_destroy(platform);
        return NULL;
    }
    glGenRenderbuffers(1, &offscreen->color);
    glBindRenderbuffer(GL_RENDERBUFFER, offscreen->color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glGenRenderbuffers(1, &offscreen->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, offscreen->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &offscreen->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, offscreen->framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, offscreen->color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, offscreen->depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        fail(error, ERROR_ENVIRONMENT, "the graphics driver makes no framebuffer of %d × %d pixels", width, height);
    else if (gl_debug_start(error))
        return platform;
    platform_destroy(platform);
    return NULL;
}

void platform_destroy(struct platform *platform)
{
    if (!platform) return;
    struct window *window = platform->window;
    if (window) {
        for (int i = 0; i < CURSOR_KINDS; i++) glfwDestroyCursor(window->cursors[i]);
        glfwDestroyWindow(window->handle);
        glfwTerminate();
    }
    struct offscreen *offscreen = platform->offscreen;
    if (offscreen) {
        glDeleteFramebuffers(1, &offscreen->framebuffer);
        glDeleteRenderbuffers(1, &offscreen->color);
        glDeleteRenderbuffers(1, &offscreen->depth);
        eglMakeCurrent(offscreen->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(offscreen->display, offscreen->context);
        eglTerminate(offscreen->display);
    }
    free(window);
    free(offscreen);
    free(platform->clipboard);
    free(platform);
}

void platform_run(struct platform *platform, bool (*frame)(void *), void *user)
{
    (void)platform;
    while (frame(user)) continue;
}

bool platform_in_page(void) { return false; }

void platform_describe(struct platform *platform, const char *text) { (void)platform, (void)text; }

void platform_share(struct platform *platform, const char *scene) { (void)platform, (void)scene; }

void platform_choose_file(struct platform *platform) { (void)platform; }

bool platform_fetches(const char *path)
{
    (void)path;
    return false;
}

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
    if (!platform->window || !calls.lost) return events;

    // Ends the process as described at struct platform_calls if another program destroyed the window. X errors reveal that; while idle, nothing
    // is drawn, so this queries the window.
    if (is_wayland_lost()) end_lost();
    if (!handle_errors()) return events;
    static unsigned long (*number)(GLFWwindow *);
    own = number || symbol_find("glfwGetX11Window", &number) ? number(platform->window->handle) : 0;
    if (!error_seen && (*count > 0 || seconds <= idle)) return events;
    error_seen = false;
    int x, y;
    glfwGetWindowPos(platform->window->handle, &x, &y); // an error if the window is gone
    return events;
}

void platform_swap(struct platform *platform)
{
    struct window *window = platform->window;
    if (!window) {
        glFinish();
        return;
    }

    // The first swap shows the window, and tests whether it keeps the back buffer: no older buffer can hold this frame's middle row. On a GPU
    // the standard leaves the content undefined, whatever one test shows.
    const int width = platform->width, y = platform->height / 2;
    const size_t bytes = 4 * (size_t)width;
    const char *renderer = window->is_shown ? NULL : (const char *)glGetString(GL_RENDERER);
    const bool is_software = renderer && (strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe"));
    unsigned char *before = is_software ? need(2, bytes) : NULL, *after = before ? before + bytes : NULL;
    if (before) glReadPixels(0, y, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, before);
    if (!window->is_shown) glfwShowWindow(window->handle);
    window->is_shown = true;
    glfwSwapBuffers(window->handle);
    if (!before) return;
    glReadPixels(0, y, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, after);
    platform->keeps = memcmp(before, after, bytes) == 0;
    free(before);
}

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
