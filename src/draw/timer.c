/// Times drawing by the CPU's clock and, where there is one, the GPU's, and builds the fixed frame that timing logs carry as a yardstick.
#include "draw/timer.h"
#include "base/need.h"
#include "base/progress.h"
#include "model/fox.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <stdlib.h>
#include <string.h>

double timer_now_us(void) { return clock_now() * 1.0e6; }

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

enum { LINES = 20, POINTS = 500, GLYPHS = 300, GLYPHS_A_ROW = 50, JOINTS = 24 };

void reference_create(struct reference *reference)
{
    drawlist_create(&reference->list, 64, LINES * POINTS + 16, 1024);
}

void reference_destroy(struct reference *reference)
{
    drawlist_destroy(&reference->list);
    gltf_pose_free(&reference->pose);
    gltf_free(&reference->fox);
}

static void arrange_lines(struct drawlist *list, struct rect panel)
{
    for (int i = 0; i < LINES; i++) {
        float xy[2 * POINTS];
        float middle = panel.y + panel.h * ((float)i + 0.5f) / LINES;
        for (int j = 0; j < POINTS; j++) {
            float t = (float)j / (POINTS - 1);
            xy[2 * j] = panel.x + panel.w * t;
            xy[2 * j + 1] = middle + 0.2f * panel.h * sinf((8.0f + (float)i) * t) * expf(-t);
        }
        drawlist_line(list, xy, POINTS, 1.25f, theme_fade(theme()->spline[i % THEME_SPLINE_COLORS], 0.5f));
    }
}

static void arrange_text(struct drawlist *list, struct rect panel)
{
    for (int row = 0; row < GLYPHS / GLYPHS_A_ROW; row++) {
        char text[GLYPHS_A_ROW + 1];
        for (int i = 0; i < GLYPHS_A_ROW; i++) text[i] = (char)('!' + (row * 7 + i) % 90);
        text[GLYPHS_A_ROW] = '\0';
        drawlist_text(list, panel.x + 8.0f, panel.y + 20.0f * (float)(row + 1), FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, text);
    }
}

/// A tail that rises and bends over by 4° a joint, seen from the side.
static void arrange_stage(struct stage_view *stage, const struct gltf *fox, struct gltf_pose *pose, struct rect panel)
{
    *stage = (struct stage_view){.viewport = panel, .eye = {3.0f, 1.2f, 3.0f}, .colors = theme()->stage, .hash = 1};
    mat4 view, projection;
    memcpy(stage->key_from, (float[3]){0, 0.8f, 0.6f}, sizeof stage->key_from);
    glm_lookat(stage->eye, (vec3){0.0f, 0.7f, 0.0f}, (vec3){0.0f, 1.0f, 0.0f}, view);
    glm_perspective(glm_rad(30.0f), panel.w / fmaxf(panel.h, 1.0f), 0.1f, 20.0f, projection);
    memcpy(stage->view, view, sizeof stage->view);
    memcpy(stage->projection, projection, sizeof stage->projection);
    for (int i = 0; i < JOINTS; i++) {
        float *turn = pose->place[FOX_FIRST_JOINT + i].rotation;
        glm_quat(turn, glm_rad(i == 0 ? -76.0f : 4.0f), 1.0f, 0.0f, 0.0f);
    }
    gltf_pose_world(fox, pose);
    struct stage_model *shown = &stage->models[stage->model_count++];
    *shown = (struct stage_model){
        .gltf = fox, .pose = pose, .ground = -FOX_BASE_HEIGHT, .dusk = 0.35f, .lo = {-1, -1, -1}, .hi = {1, 2, 2}};
    glm_mat4_identity((vec4 *)shown->root);
}

void reference_arrange(struct reference *reference, float width, float height)
{
    struct rect whole = {0.0f, 0.0f, width, height};
    struct rect upper = {0.0f, 0.0f, width, floorf(0.5f * height)};
    struct rect lower = {0.0f, upper.h, width, height - upper.h};
    drawlist_clear(&reference->list, whole);
    if (!reference->pose.place) {
        fox_create(0, JOINTS, &reference->fox);
        if (!gltf_pose_create(&reference->fox, &reference->pose)) need_failed();
    }
    arrange_lines(&reference->list, lower);
    arrange_text(&reference->list, lower);
    arrange_stage(&reference->stage, &reference->fox, &reference->pose, upper);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double reference_median(struct reference *reference, int count)
{
    int used = count < REFERENCE_RUNS_MAX ? count : REFERENCE_RUNS_MAX;
    if (used < 1) return -1.0;
    qsort(reference->ms, (size_t)used, sizeof *reference->ms, ascending);
    return reference->ms[used / 2];
}
