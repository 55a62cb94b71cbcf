/// What the surfaces of a desktop and of a browser share: their size, events until the next frame, and clicks.
#include "platform/events.h"
#include "base/need.h"
#include <math.h>
#include <string.h>

static const double DOUBLE_CLICK_SECONDS = 0.35;
static const float DOUBLE_CLICK_PIXELS = 4, DOUBLE_TAP_PIXELS = 24; // a finger is wide

void event_queue_push(struct event_queue *queue, const struct event *event)
{
    struct event_buffer *buffer = &queue->buffers[queue->filling];
    struct event *last = buffer->count ? &buffer->events[buffer->count - 1] : NULL;
    bool crowded = buffer->count > QUEUE_EVENTS / 2;
    if (crowded && event->kind == EVENT_POINTER && last->kind == EVENT_POINTER) {
        *last = *event;
    } else if (buffer->count < QUEUE_EVENTS) {
        buffer->events[buffer->count++] = *event;
    }
}

void event_queue_push_drop(struct event_queue *queue, const char *path, double time)
{
    struct event_buffer *buffer = &queue->buffers[queue->filling];
    size_t size = strlen(path) + 1;
    if (size > (size_t)(QUEUE_PATH_BYTES - buffer->path_bytes)) return;
    char *copy = buffer->paths + buffer->path_bytes;
    memcpy(copy, path, size);
    buffer->path_bytes += (int)size;
    event_queue_push(queue, &(struct event){.kind = EVENT_DROP, .path = copy, .time = time});
}

const struct event *event_queue_take(struct event_queue *queue, int *count)
{
    struct event_buffer *full = &queue->buffers[queue->filling];
    queue->filling = 1 - queue->filling;
    struct event_buffer *empty = &queue->buffers[queue->filling];
    empty->count = empty->path_bytes = 0;
    *count = full->count;
    return full->events;
}

int clicks_count(struct clicks *clicks, const struct event *press, double time)
{
    const struct clicks last = *clicks;
    const bool again =
        last.open && time - last.time <= DOUBLE_CLICK_SECONDS && last.button == press->button &&
        hypotf(press->x - last.x, press->y - last.y) <= (press->finger ? DOUBLE_TAP_PIXELS : DOUBLE_CLICK_PIXELS);
    *clicks = (struct clicks){.open = !again, .time = time, .x = press->x, .y = press->y, .button = press->button};
    return again ? 2 : 1;
}

struct platform *platform_blind(int width, int height, float scale)
{
    struct platform *platform = need_zeroed(1, sizeof *platform);
    platform->width = width;
    platform->height = height;
    platform->scale = scale;
    return platform;
}

void platform_size(const struct platform *platform, int *width, int *height, float *scale)
{
    *width = platform->width;
    *height = platform->height;
    *scale = platform->scale;
}

bool platform_keeps(const struct platform *platform) { return platform->keeps; }

bool platform_is_window(const struct platform *platform) { return platform->window != NULL; }
