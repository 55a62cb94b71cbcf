/// Draws the stage: ground, shadows and rigs, by the painters and with the camera and light that they share.
#include "draw/stage.h"
#include "base/need.h"
#include "draw/painter.h"
#include <stdlib.h>

#define PAINTER_ROW(name) &name##_painter,
const struct painter *const painters[PAINTERS] = {PAINTER_LIST(PAINTER_ROW)};
#undef PAINTER_ROW

struct painter_uniforms painter_find_uniforms(GLuint program)
{
    return (struct painter_uniforms){
        .clip_from_world = glGetUniformLocation(program, "clip_from_world"),
        .eye = glGetUniformLocation(program, "eye"),
        .key_from = glGetUniformLocation(program, "key_from"),
        .earth = glGetUniformLocation(program, "earth"),
        .seam = glGetUniformLocation(program, "seam"),
    };
}

mat4s stage_clip_from_world(const struct stage_view *view)
{
    return glms_mat4_mul(mat4_from(view->projection), mat4_from(view->view));
}

void painter_use(GLuint program, const struct painter_uniforms *at, const struct stage_view *view, float seam)
{
    const mat4s clip_from_world = stage_clip_from_world(view);
    glUseProgram(program);
    glUniformMatrix4fv(at->clip_from_world, 1, GL_FALSE, clip_from_world.raw[0]);
    glUniform3fv(at->eye, 1, view->eye);
    glUniform3fv(at->key_from, 1, view->key_from);
    gl_uniform_linear(at->earth, view->colors.bounce);
    glUniform1f(at->seam, seam);
}

struct stage_renderer {
    struct stage_flat *flat;
    void *states[PAINTERS]; ///< of the painters
};

struct stage_renderer *stage_renderer_create(struct error *error)
{
    struct stage_renderer *renderer = need_zeroed(1, sizeof *renderer);
    bool made = (renderer->flat = stage_flat_create(error)) != NULL;
    for (int p = 0; made && p < PAINTERS; p++) made = (renderer->states[p] = painters[p]->create(error)) != NULL;
    if (made) return renderer;
    stage_renderer_destroy(renderer);
    return NULL;
}

void stage_renderer_destroy(struct stage_renderer *renderer)
{
    if (!renderer) return;
    for (int p = 0; p < PAINTERS; p++) {
        if (renderer->states[p]) painters[p]->destroy(renderer->states[p]);
    }
    stage_flat_destroy(renderer->flat);
    free(renderer);
}

void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes)
{
    for (int p = 0; p < PAINTERS; p++) painters[p]->upload(renderer->states[p], view, bytes);
    *bytes += stage_flat_upload(renderer->flat, view);
}

static void draw_rigs(const struct stage_renderer *renderer, const struct stage_view *view, float scale, float seam)
{
    for (int p = 0; p < PAINTERS; p++) painters[p]->draw(renderer->states[p], view, scale, seam);
}

static void begin_rigs(void)
{
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glClear(GL_DEPTH_BUFFER_BIT);
}

static void end_rigs(void)
{
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height)
{
    const float scale = (float)height / view->viewport.h;
    glViewport(x, y, width, height);
    glDisable(GL_DEPTH_TEST);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    stage_flat_draw(renderer->flat, y, height);
    begin_rigs();
    draw_rigs(renderer, view, scale, 0.0f);
    // Edges without multisampling: a skirt a pixel wide (draw/skirt.h) fades out from the outlines over whatever is behind: the
    // background or the animal itself.
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    draw_rigs(renderer, view, scale, 2.0f / (view->projection[5] * (float)height));
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    end_rigs();
}

void stage_draw_rigs(struct stage_renderer *renderer, const struct stage_view *view, int width, int height)
{
    glViewport(0, 0, width, height);
    begin_rigs();
    draw_rigs(renderer, view, (float)height / view->viewport.h, 0.0f);
    end_rigs();
}
