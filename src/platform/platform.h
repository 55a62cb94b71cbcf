/// A surface to draw on and where its events come from: a GLFW window, or an offscreen EGL context.
#ifndef PLATFORM_PLATFORM_H
#define PLATFORM_PLATFORM_H

#include "base/error.h"
#include "ui/event.h"

struct platform;

/// Call this first to have each of the OpenGL driver's messages, but mere notifications, printed once to stderr. How many
/// there were that should not be: errors, and whatever is undefined, deprecated or not portable; not those about speed.
void platform_debug_gl(void);
int platform_gl_complaints(void);

/// A window (GLX under X11) with a current 3.3 core context. Swap interval `vsync` 0 or 1.
/// NULL with a sentence: no display answers or takes us in, no GLX, version.
struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error);

/// An offscreen framebuffer object of width × height device pixels with a current context (EGL surfaceless or device).
struct platform *platform_offscreen(int width, int height, float scale, struct error *error);

void platform_destroy(struct platform *platform);

/// Waits at most `seconds` for events (0: only looks), then hands out those that came, in order. The array lives until the
/// next call. Callbacks behind it only translate and queue.
const struct event *platform_events(struct platform *platform, double seconds, int *count);

/// Framebuffer size in device pixels, and device pixels a logical pixel.
void platform_size(const struct platform *platform, int *width, int *height, float *scale);

/// Whether the framebuffer keeps the last frame after a swap (offscreen, and software GLX; never taken on trust: probed once).
bool platform_keeps(const struct platform *platform);

/// Shows the frame; offscreen: glFinish.
void platform_swap(struct platform *platform);

/// Pictures a second of the monitor that shows most of the window; 0 where that is not known. Asks the display.
double platform_refresh_rate(struct platform *platform);

bool platform_is_window(const struct platform *platform);
void platform_title(struct platform *platform, const char *title);
void platform_fullscreen(struct platform *platform, bool on);
bool platform_is_fullscreen(const struct platform *platform);
/// The system's clipboard as UTF-8, the process's own without a window. NULL where it holds no text; valid until the next
/// call.
const char *platform_clipboard(struct platform *platform);
void platform_set_clipboard(struct platform *platform, const char *text);
void platform_cursor(struct platform *platform, enum mouse_cursor cursor);

/// Called when the connection to the display is lost, or the window was destroyed by somebody else; after that the process ends with exit status 3, because nothing of
/// the window can be used any more. Register it once the window is open.
typedef void platform_rescue(void *user);
void platform_on_lost(platform_rescue *function, void *user);

#endif
