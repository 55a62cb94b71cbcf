/// The painters, and the camera and light that they share.
#include "draw/painter.h"

const struct painter *const painters[PAINTERS] = {&tail_painter, &character_painter, &model_painter, &meadow_painter};

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
