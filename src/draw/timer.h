/// How long the GPU draws. Private to draw/.
#ifndef DRAW_TIMER_H
#define DRAW_TIMER_H

#include "draw/gl.h"
#include <stdbool.h>

enum { TIMER_QUERIES = 4 };

/// GL_TIME_ELAPSED of the last frames: results are read some frames late, once they are there, and never waited for.
struct gpu_timer {
    GLuint queries[TIMER_QUERIES];
    long frames[TIMER_QUERIES]; ///< that the queries belong to
    int oldest, pending;
    bool usable, running;
};

/// Software renderers draw at the flush, not between the queries: their numbers would mislead, so they have no timer.
void gpu_timer_create(struct gpu_timer *timer, bool is_software);
void gpu_timer_destroy(struct gpu_timer *timer);

/// Starts timing a frame, unless the results of four earlier ones are still pending.
void gpu_timer_begin(struct gpu_timer *timer, long frame);
void gpu_timer_end(struct gpu_timer *timer);

/// Microseconds of the oldest frame that has come back since the last call, and its number; negative where there is none.
double gpu_timer_take(struct gpu_timer *timer, long *frame);

#endif
