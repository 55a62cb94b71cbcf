/// What the surfaces of a desktop and of a browser share: their size, events until the next frame, and clicks. Private to platform/.
#ifndef PLATFORM_EVENTS_H
#define PLATFORM_EVENTS_H

#include "platform/platform.h"

enum { QUEUE_EVENTS = 1024, QUEUE_PATH_BYTES = 1 << 16 };

/// Events, and the dropped files' paths they point to.
struct event_buffer {
    struct event events[QUEUE_EVENTS];
    int count;
    char paths[QUEUE_PATH_BYTES];
    int path_bytes;
};

/// One buffer fills while the frame reads the other.
struct event_queue {
    struct event_buffer buffers[2];
    int filling;
};

struct platform {
    struct window *window;       ///< at most one of these two exists
    struct offscreen *offscreen; ///< of a desktop
    int width, height;           ///< of the framebuffer, device pixels
    float scale;                 ///< device pixels per logical pixel
    bool keeps;                  ///< platform_keeps()
    struct event_queue queue;
    char *clipboard; ///< of a browser, or without a window
};

/// Adds an event. A nearly full buffer keeps only the last of consecutive pointer positions, a full one drops events.
void event_queue_push(struct event_queue *queue, const struct event *event);

/// Adds EVENT_DROP with a copy of `path`, if it fits.
void event_queue_push_drop(struct event_queue *queue, const char *path, double time);

/// The events since the last call, valid until the next.
const struct event *event_queue_take(struct event_queue *queue, int *count);

/// The last press.
struct clicks {
    bool open; ///< it may become a double-click
    double time;
    float x, y;
    enum event_button button;
};

/// 2 for a press soon after another at the same place; a third counts as 1.
int clicks_count(struct clicks *clicks, const struct event *press, double time);

#endif
