/// The kinds of surface behind platform.h. Private to platform/.
#ifndef PLATFORM_SURFACE_H
#define PLATFORM_SURFACE_H

#include "base/error.h"
#include "platform/events.h"
#include "platform/platform.h"

struct window;
struct offscreen;

/// A surface's framebuffer.
struct surface_size {
    int width, height; ///< device pixels
    float scale;       ///< device pixels per logical pixel
};

/// At most one of the two exists.
struct platform {
    struct window *window;
    struct offscreen *offscreen;
    struct surface_size size; ///< without a window
    struct event_queue queue;
    bool keeps;
    char *clipboard; ///< without a window
};

#endif
