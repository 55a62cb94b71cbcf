/// Times drawing by the GPU's clock, where there is one.
#include "draw/timer.h"

void gpu_timer_create(struct gpu_timer *timer, bool is_software)
{
    *timer = (struct gpu_timer){0};
    GLint bits = 0;
    if (!is_software) glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    timer->usable = bits > 0;
    if (timer->usable) glGenQueries(TIMER_QUERIES, timer->queries);
}

void gpu_timer_destroy(struct gpu_timer *timer)
{
    if (timer->usable) glDeleteQueries(TIMER_QUERIES, timer->queries);
    *timer = (struct gpu_timer){0};
}

void gpu_timer_begin(struct gpu_timer *timer, long frame)
{
    if (!timer->usable || timer->pending == TIMER_QUERIES) return;
    int next = (timer->oldest + timer->pending) % TIMER_QUERIES;
    timer->frames[next] = frame;
    glBeginQuery(GL_TIME_ELAPSED, timer->queries[next]);
    timer->running = true;
}

void gpu_timer_end(struct gpu_timer *timer)
{
    if (!timer->running) return;
    glEndQuery(GL_TIME_ELAPSED);
    timer->running = false;
    timer->pending++;
}

double gpu_timer_take(struct gpu_timer *timer, long *frame)
{
    if (timer->pending == 0) return -1.0;
    GLuint query = timer->queries[timer->oldest];
    GLuint available = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
    if (!available) return -1.0;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
    *frame = timer->frames[timer->oldest];
    timer->oldest = (timer->oldest + 1) % TIMER_QUERIES;
    timer->pending--;
    return (double)nanoseconds * 1.0e-3;
}
