/// Draws the stage: ground, shadows and rigs with a common camera and light.
#include "draw/stage.h"
#include "base/need.h"
#include <stdlib.h>

struct stage_renderer {
    struct program programs[PROGRAMS];
    struct stage_flat *flat;
    struct stage_meshes *meshes;
};

static const struct {
    const char *vertex, *fragment, *define;
} sources[PROGRAMS] = {
    [PROGRAM_COAT] = {"stage_skirt.vert", "stage_mesh.frag", "FURRED"},
    [PROGRAM_FACE] = {"stage_skirt.vert", "stage_mesh.frag", "FACED"},
    [PROGRAM_PLAIN] = {"stage_skirt.vert", "stage_mesh.frag", NULL},
    [PROGRAM_PICTURED] = {"stage_skirt.vert", "stage_mesh.frag", "PICTURED"},
    [PROGRAM_FLAT] = {"stage_flat.vert", "stage_flat.frag", NULL},
};

#define UNIFORM_NAME(constant, name) #name,
static const char *const uniform_names[UNIFORMS] = {UNIFORM_LIST(UNIFORM_NAME)};
#undef UNIFORM_NAME

mat4s stage_clip_from_world(const struct stage_view *view)
{
    return glms_mat4_mul(mat4_from(view->projection), mat4_from(view->view));
}

void program_use(const struct program *program, const struct stage_view *view, float seam)
{
    const mat4s clip_from_world = stage_clip_from_world(view);
    glUseProgram(program->name);
    glUniformMatrix4fv(program->at[AT_CLIP_FROM_WORLD], 1, GL_FALSE, clip_from_world.raw[0]);
    glUniform3fv(program->at[AT_EYE], 1, view->eye);
    glUniform3fv(program->at[AT_KEY_FROM], 1, view->key_from);
    gl_uniform_linear(program->at[AT_EARTH], view->colors.bounce);
    glUniform1f(program->at[AT_SEAM], seam);
}

static bool create_program(struct program *program, enum stage_program which, struct error *error)
{
    program->name = gl_program(sources[which].vertex, sources[which].fragment, sources[which].define, error);
    for (int u = 0; program->name && u < UNIFORMS; u++)
        program->at[u] = glGetUniformLocation(program->name, uniform_names[u]);
    return program->name != 0;
}

struct stage_renderer *stage_renderer_create(struct error *error)
{
    struct stage_renderer *renderer = need_zeroed(1, sizeof *renderer);
    for (int p = 0; p < PROGRAMS; p++) {
        if (create_program(&renderer->programs[p], (enum stage_program)p, error)) continue;
        while (--p >= 0) glDeleteProgram(renderer->programs[p].name);
        free(renderer);
        return NULL;
    }
    renderer->flat = stage_flat_create();
    renderer->meshes = stage_meshes_create(renderer->programs);
    return renderer;
}

void stage_renderer_destroy(struct stage_renderer *renderer)
{
    if (!renderer) return;
    for (int p = 0; p < PROGRAMS; p++) glDeleteProgram(renderer->programs[p].name);
    stage_flat_destroy(renderer->flat);
    stage_meshes_destroy(renderer->meshes);
    free(renderer);
}

void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes)
{
    *bytes += stage_meshes_upload(renderer->meshes, view) + stage_flat_upload(renderer->flat, view);
}

static void draw_rigs(const struct stage_renderer *renderer, const struct stage_view *view, float scale)
{
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    stage_meshes_draw(renderer->meshes, view, scale, 0.0f);
}

static void end_rigs(void)
{
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height)
{
    const float scale = (float)height / view->viewport.h, seam = 2.0f / (view->projection[5] * (float)height);
    glViewport(x, y, width, height);
    glEnable(GL_DEPTH_TEST);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    stage_flat_draw(renderer->flat, &renderer->programs[PROGRAM_FLAT], y, height);
    draw_rigs(renderer, view, scale);
    // Anti-aliased edges without multisampling: skirts (draw/posed.h) fade out over the background or the animal itself.
    glEnable(GL_BLEND);
    stage_meshes_draw(renderer->meshes, view, scale, seam);
    glDisable(GL_BLEND);
    end_rigs();
}

void stage_draw_rigs(struct stage_renderer *renderer, const struct stage_view *view, int width, int height)
{
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_rigs(renderer, view, (float)height / view->viewport.h);
    end_rigs();
}
