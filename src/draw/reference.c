/// The fixed reference frame of every timing log: lines, text and a bent tail from constants alone, so that logs of different builds and
/// documents can be compared.
#include "base/need.h"
#include "base/progress.h"
#include "draw/draw.h"
#include "draw/gl.h"
#include "model/fox.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <stdlib.h>

enum { LINES = 20, POINTS = 500, GLYPHS = 300, GLYPHS_A_ROW = 50, JOINTS = 24 };

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

/// A rising tail that bends by 4° per joint, seen from the side.
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

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double draw_reference_ms(struct draw *draw, int width, int height, float scale, int count)
{
    struct drawlist list;
    struct stage_view stage;
    struct gltf fox;
    struct gltf_pose pose;
    double *ms = need((size_t)count, sizeof *ms);
    const struct rect whole = {0, 0, (float)width / scale, (float)height / scale};
    const struct rect upper = {0, 0, whole.w, floorf(0.5f * whole.h)},
                      lower = {0, upper.h, whole.w, whole.h - upper.h};
    drawlist_create(&list, 64, LINES * POINTS + 16, 1024);
    drawlist_clear(&list, whole);
    fox_create(0, JOINTS, &fox);
    if (!gltf_pose_create(&fox, &pose)) need_failed();
    arrange_lines(&list, lower);
    arrange_text(&list, lower);
    arrange_stage(&stage, &fox, &pose, upper);
    const struct draw_input input = {width, height, scale, false, &list, &stage, -1, 1.0f};
    for (int i = 0; i < count; i++) {
        struct draw_cost cost;
        const double start = clock_now();
        draw_frame(draw, &input, &cost);
        glFinish();
        ms[i] = 1e3 * (clock_now() - start);
    }
    qsort(ms, (size_t)count, sizeof *ms, ascending);
    const double median = ms[count / 2];
    drawlist_destroy(&list);
    gltf_pose_free(&pose);
    gltf_free(&fox);
    free(ms);
    return median;
}
