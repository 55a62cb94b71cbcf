/// Maps GLFW's keys to ours, and queues events until the next frame. Private to platform/.
#ifndef PLATFORM_EVENTS_H
#define PLATFORM_EVENTS_H

#include "ui/event.h"

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

/// Adds an event. A nearly full buffer keeps only the last of consecutive pointer positions, a full one drops events.
void event_queue_push(struct event_queue *queue, const struct event *event);

/// Adds EVENT_DROP with a copy of `path`, if it fits.
void event_queue_push_drop(struct event_queue *queue, const char *path, double time);

/// The events since the last call, valid until the next.
const struct event *event_queue_take(struct event_queue *queue, int *count);

/// Letters and punctuation map by their label, digits, arrows and the rest by position; so do letters if the layout has no Latin ones.
/// KEY_NONE for other keys.
int key_translate(int glfw_key, int scancode);

unsigned mods_translate(int glfw_mods);

#endif
