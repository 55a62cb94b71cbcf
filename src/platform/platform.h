/// A surface to draw on, and the source of events: a GLFW window, an offscreen EGL context, or no surface at all.
#ifndef PLATFORM_PLATFORM_H
#define PLATFORM_PLATFORM_H

#include "base/error.h"
#include "ui/event.h"

struct platform;

/// Call the first of these at the start to print each of the OpenGL driver's messages, except notifications, once to stderr.
/// The second counts the serious ones: errors, and everything undefined, deprecated or not portable.
void platform_debug_gl(void);
int platform_gl_complaints(void);

/// A window (GLX under X11) with a current 3.3 core context, shown from the first swap on. Swap interval `vsync` 0 or 1.
/// NULL with a sentence: no display takes us in, no GLX, version.
struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error);

/// An offscreen framebuffer object of width × height device pixels with a current context (EGL surfaceless or device).
struct platform *platform_offscreen(int width, int height, float scale, struct error *error);

/// No surface: a size, a clipboard and a queue of events. Needs no OpenGL.
struct platform *platform_blind(int width, int height, float scale);

void platform_destroy(struct platform *platform);

/// Waits at most `seconds` for events (0: only looks), then hands out those that came, in order. The array lives until the
/// next call. Callbacks behind it only translate and queue.
const struct event *platform_events(struct platform *platform, double seconds, int *count);

/// Framebuffer size in device pixels, and device pixels a logical pixel.
void platform_size(const struct platform *platform, int *width, int *height, float *scale);

/// Whether the framebuffer keeps the last frame after a swap (offscreen, and software GLX; never assumed: the first swap tells).
bool platform_keeps(const struct platform *platform);

/// Shows the frame; offscreen: glFinish. Not without a surface.
void platform_swap(struct platform *platform);

/// Refresh rate of the monitor that shows most of the window, Hz; 0 if unknown. Asks the display.
double platform_refresh_rate(struct platform *platform);

bool platform_is_window(const struct platform *platform);
void platform_title(struct platform *platform, const char *title);
/// Has the window fill the screen, or not any more.
void platform_toggle_fullscreen(struct platform *platform);
/// The system's clipboard as UTF-8, the process's own without a window. NULL if it holds no text; valid until the next
/// call.
const char *platform_clipboard(struct platform *platform);
void platform_set_clipboard(struct platform *platform, const char *text);
void platform_cursor(struct platform *platform, enum mouse_cursor cursor);

/// Called when the connection to the display is lost, or another program destroyed the window; afterwards the process ends with
/// exit status 3, because the window is unusable. Register it once the window is open; NULL: nobody is called any more.
typedef void platform_rescue(void *user);
void platform_on_lost(platform_rescue *function, void *user);

#endif
