/// What tells how fast drawing is: the CPU's clock, the GPU's, and a fixed frame as the yardstick. Private to draw/.
#ifndef DRAW_TIMER_H
#define DRAW_TIMER_H

#include "base/error.h"
#include "draw/gl.h"
#include "ui/stage.h"
#include <stdbool.h>

/// Microseconds on a monotonic clock.
double timer_now_us(void);

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

// The fixed frame that every timing log carries as its yardstick: lines, text and a bent tail that come from constants
// alone, so that logs of different builds and documents can be compared.

enum { REFERENCE_RUNS_MAX = 64 };

struct reference {
    struct drawlist list;
    struct stage_view stage;
    struct gltf fox; ///< made where it is first laid out, as is its pose
    struct gltf_pose pose;
    double ms[REFERENCE_RUNS_MAX];
};

void reference_create(struct reference *reference);
void reference_destroy(struct reference *reference);

/// Lays the frame out in a window of width × height logical pixels.
void reference_arrange(struct reference *reference, float width, float height);

/// Sorts the first `count` entries of `ms` and returns their median.
double reference_median(struct reference *reference, int count);

#endif
