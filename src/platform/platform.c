/// Hands calls on to a window or to an offscreen surface, where there is one.
#include "platform/platform.h"
#include "base/need.h"
#include "platform/process.h"
#include "platform/surface.h"
#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

static struct platform *allocate(void)
{
    struct platform *platform = need_zeroed(1, sizeof *platform);
    keep_freed_memory();
    return platform;
}

struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error)
{
    struct platform *platform = allocate();
    platform->window = window_create(width, height, title, vsync, &platform->queue, error);
    if (!platform->window) {
        free(platform);
        return NULL;
    }
    keep_driver_loaded();
    if (!gl_debug_start(error)) {
        platform_destroy(platform);
        return NULL;
    }
    platform->keeps = probe_keeps(platform->window);
    return platform;
}

struct platform *platform_blind(int width, int height, float scale)
{
    struct platform *platform = allocate();
    platform->size = (struct surface_size){width, height, scale};
    return platform;
}

struct platform *platform_offscreen(int width, int height, float scale, struct error *error)
{
    struct platform *platform = platform_blind(width, height, scale);
    if (!platform) return NULL;
    platform->offscreen = offscreen_create(width, height, error);
    if (!platform->offscreen) {
        free(platform);
        return NULL;
    }
    platform->keeps = true;
    if (gl_debug_start(error)) return platform;
    platform_destroy(platform);
    return NULL;
}

void platform_destroy(struct platform *platform)
{
    if (!platform) return;
    if (platform->window) window_destroy(platform->window);
    if (platform->offscreen) offscreen_destroy(platform->offscreen);
    free(platform->clipboard);
    free(platform);
}

const struct event *platform_events(struct platform *platform, double seconds, int *count)
{
    static const double idle = 0.1; ///< seconds; no animation waits as long
    if (platform->window) {
        window_wait(platform->window, seconds);
    } else {
        process_sleep(seconds);
    }
    const struct event *events = event_queue_take(&platform->queue, count);
    if (platform->window) window_check(platform->window, *count == 0 && seconds > idle);
    return events;
}

void platform_size(const struct platform *platform, int *width, int *height, float *scale)
{
    struct surface_size size = platform->window ? window_size(platform->window) : platform->size;
    *width = size.width;
    *height = size.height;
    *scale = size.scale;
}

bool platform_keeps(const struct platform *platform) { return platform->keeps; }

void platform_swap(struct platform *platform)
{
    if (platform->window) {
        window_swap(platform->window);
    } else {
        glFinish();
    }
}

double platform_refresh_rate(struct platform *platform)
{
    return platform->window ? window_refresh_rate(platform->window) : 0;
}

bool platform_is_window(const struct platform *platform) { return platform->window != NULL; }

void platform_title(struct platform *platform, const char *title)
{
    if (platform->window) window_title(platform->window, title);
}

void platform_fullscreen(struct platform *platform, bool on)
{
    if (platform->window) window_fullscreen(platform->window, on);
}

bool platform_is_fullscreen(const struct platform *platform)
{
    return platform->window && window_is_fullscreen(platform->window);
}

const char *platform_clipboard(struct platform *platform)
{
    return platform->window ? window_clipboard(platform->window) : platform->clipboard;
}

void platform_set_clipboard(struct platform *platform, const char *text)
{
    if (platform->window) {
        window_set_clipboard(platform->window, text);
    } else {
        free(platform->clipboard);
        platform->clipboard = need_text(text);
    }
}

void platform_cursor(struct platform *platform, enum mouse_cursor cursor)
{
    if (platform->window) window_cursor(platform->window, cursor);
}
