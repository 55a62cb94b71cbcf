/// Makes a window, an offscreen surface or what stands for one.
#include "platform/platform.h"
#include "base/need.h"
#include "platform/surface.h"
#include <stdlib.h>

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
    platform->keeps = probe_keeps(platform);
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

bool platform_keeps(const struct platform *platform) { return platform->keeps; }
