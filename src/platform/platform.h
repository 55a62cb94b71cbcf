/// A surface to draw on and a source of events: a GLFW window, an offscreen EGL context, or none.
#ifndef PLATFORM_PLATFORM_H
#define PLATFORM_PLATFORM_H

#include "base/error.h"
#include "ui/event.h"

struct platform;

/// The first makes the OpenGL driver's messages, except notifications, appear once each on stderr; call it at the start. The second counts
/// the serious ones: errors, and undefined, deprecated or unportable behaviour.
void platform_debug_gl(void);
int platform_gl_complaints(void);

/// Opens a window (GLX under X11) with a current 3.3 core context, hidden until the first swap. Swap interval `vsync` 0 or 1. NULL with an
/// error.
struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error);

/// An offscreen framebuffer of width × height device pixels with a current context (EGL surfaceless or device).
struct platform *platform_offscreen(int width, int height, float scale, struct error *error);

/// No surface: only a size, a clipboard and an event queue. Needs no OpenGL.
struct platform *platform_blind(int width, int height, float scale);

void platform_destroy(struct platform *platform);

/// Calls `frame` until it returns false. In a browser the frames of a window are callbacks, and this never returns.
void platform_run(struct platform *platform, bool (*frame)(void *), void *user);

/// Waits at most `seconds` for events (0: not at all) and returns those so far, in order, valid until the next call. The callbacks only
/// translate and queue.
const struct event *platform_events(struct platform *platform, double seconds, int *count);

/// Framebuffer size in device pixels, and device pixels per logical pixel.
void platform_size(const struct platform *platform, int *width, int *height, float *scale);

/// Whether the framebuffer keeps the last frame after a swap, as offscreen and software GLX do. The first swap tests it.
bool platform_keeps(const struct platform *platform);

/// Shows the frame; offscreen: glFinish. Requires a surface.
void platform_swap(struct platform *platform);

/// Refresh rate in Hz of the monitor that shows most of the window; 0 if unknown. Queries the display.
double platform_refresh_rate(struct platform *platform);

bool platform_is_window(const struct platform *platform);
void platform_title(struct platform *platform, const char *title);
/// In a browser: sets what a screen reader says of the canvas.
void platform_describe(struct platform *platform, const char *text);
void platform_toggle_fullscreen(struct platform *platform);
/// The clipboard as UTF-8: the system's, or without a window the process's own. NULL without text; valid until the next call.
const char *platform_clipboard(struct platform *platform);
void platform_set_clipboard(struct platform *platform, const char *text);

/// Whether this is the build for browsers, which cannot start other programs.
bool platform_in_page(void);

/// In a browser: offers a link to a scene, given as JSON; lets the user choose a file, which arrives as EVENT_DROP.
void platform_share(struct platform *platform, const char *scene);
void platform_choose_file(struct platform *platform);

/// In a browser, characters of the program's own are fetched once they are needed: whether this one is on its way. The next frame comes after it.
bool platform_fetches(const char *path);

void platform_cursor(struct platform *platform, enum mouse_cursor cursor);

/// What the surface of a window calls.
struct platform_calls {
    /// When the display is lost or another program destroyed the window; then the process ends with exit status 3. In a browser, whenever the
    /// page is hidden.
    void (*lost)(void *user);
    /// In a browser: whether a key is the app's; the others stay the browser's.
    bool (*keeps_key)(void *user, int key, unsigned mods);
    void *user;
};

/// Call it once the window is open; all zero: it calls nothing.
void platform_listen(struct platform_calls calls);

#endif
