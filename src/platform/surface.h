/// The kinds of surface behind platform.h. Private to platform/.
#ifndef PLATFORM_SURFACE_H
#define PLATFORM_SURFACE_H

#include "base/error.h"
#include "platform/events.h"
#include "platform/platform.h"

struct window;
struct offscreen;

struct platform {
    struct window *window; ///< at most one of these two exists
    struct offscreen *offscreen;
    int width, height; ///< of the framebuffer, device pixels
    float scale;       ///< device pixels per logical pixel
    struct event_queue queue;
    bool keeps;
    char *clipboard; ///< without a window
};

#endif
