/// From GLFW's keys to ours, and events on their way from callbacks to the frame that handles them. Private to platform/.
#ifndef PLATFORM_EVENTS_H
#define PLATFORM_EVENTS_H

#include "ui/event.h"

enum { QUEUE_EVENTS = 1024, QUEUE_PATH_BYTES = 1 << 16 };

/// Events and the paths of dropped files, which events point to.
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

/// Adds an event. When the buffer is nearly full, only the last of consecutive pointer positions is kept; what does not
/// fit is dropped.
void event_queue_push(struct event_queue *queue, const struct event *event);

/// Adds EVENT_DROP with a copy of `path`; dropped if it does not fit.
void event_queue_push_drop(struct event_queue *queue, const char *path, double time);

/// The events since the last call; valid until the next one.
const struct event *event_queue_take(struct event_queue *queue, int *count);

/// Letters and punctuation go by what is printed on the key; digits, arrows and the rest go by place, as do letters if the
/// layout has no Latin ones. KEY_NONE for keys without a meaning here.
int key_translate(int glfw_key, int scancode);

/// GLFW's modifier bits as ours.
unsigned mods_translate(int glfw_mods);

#endif
