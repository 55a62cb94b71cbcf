/// Draws imported characters with their own materials.
#include "draw/model_buffers.h"
#include "draw/painter.h"
#include "draw/stage_extent.h"
#include <math.h>
#include <stdlib.h>

enum { MATRICES_UNIT = 0, PICTURE_UNIT = 1 };

struct stage_models {
    GLuint program;
    struct painter_uniforms shared;
    struct {
        GLint shade, base, first, many, cutoff, both_sides;
    } at;
    struct model_buffers buffers[STAGE_MAX_MODELS]; ///< one for each place in the view
};

static void *create(struct error *error)
{
    struct stage_models *models = calloc(1, sizeof *models);
    if (!models) {
        fail(error, ERROR_ENVIRONMENT, "not enough memory for the stage");
        return NULL;
    }
    models->program = gl_program("stage_model.vert", "stage_mesh.frag", "PICTURED", error);
    if (!models->program) {
        free(models);
        return NULL;
    }
    models->shared = painter_find_uniforms(models->program);
    models->at.shade = glGetUniformLocation(models->program, "shade");
    models->at.base = glGetUniformLocation(models->program, "base");
    models->at.first = glGetUniformLocation(models->program, "first");
    models->at.many = glGetUniformLocation(models->program, "many");
    models->at.cutoff = glGetUniformLocation(models->program, "cutoff");
    models->at.both_sides = glGetUniformLocation(models->program, "both_sides");
    glUseProgram(models->program);
    glUniform1i(glGetUniformLocation(models->program, "matrices"), MATRICES_UNIT);
    glUniform1i(glGetUniformLocation(models->program, "picture"), PICTURE_UNIT);
    return models;
}

static void destroy(void *state)
{
    struct stage_models *models = state;
    for (int m = 0; m < STAGE_MAX_MODELS; m++) model_buffers_free(&models->buffers[m]);
    glDeleteProgram(models->program);
    free(models);
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    struct stage_models *models = state;
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        struct model_buffers *buffers = &models->buffers[m];
        if (buffers->id != shown->gltf->id) {
            model_buffers_free(buffers);
            *bytes += model_buffers_create(buffers, shown->gltf);
        }
        *bytes += model_buffers_pose(buffers, shown->gltf, shown->pose, shown->root);
    }
}

static const struct gltf_material plain = {.color = {1, 1, 1, 1}, .image = -1};

static const struct gltf_material *material_of(const struct gltf *gltf, const struct model_shape *shape)
{
    int material = gltf->meshes[gltf->nodes[shape->node].mesh].parts[shape->part].material;
    return material < 0 ? &plain : &gltf->materials[material];
}

/// The values of attributes that a shape has no arrays for: white, all on the only matrix.
static void set_standard_attributes(void)
{
    glVertexAttrib2f(2, 0.0f, 0.0f);
    glVertexAttrib4f(3, 1.0f, 1.0f, 1.0f, 1.0f);
    glVertexAttribI4ui(4, 0, 0, 0, 0);
    glVertexAttribI4ui(5, 0, 0, 0, 0);
    glVertexAttrib4f(6, 1.0f, 0.0f, 0.0f, 0.0f);
    glVertexAttrib4f(7, 0.0f, 0.0f, 0.0f, 0.0f);
}

/// Whether a node without a skin is mirrored, which turns its triangles round.
static bool is_mirrored(const struct stage_model *shown, int node)
{
    return shown->gltf->nodes[node].skin < 0 && glms_mat4_det(mat4_from(shown->pose->world[node])) < 0.0f;
}

static void draw_shape(const struct stage_models *models, const struct model_buffers *buffers,
                       const struct stage_model *shown, const struct model_shape *shape)
{
    const struct gltf_material *material = material_of(shown->gltf, shape);
    const struct gltf_part *part = &shown->gltf->meshes[shown->gltf->nodes[shape->node].mesh].parts[shape->part];
    const GLuint picture = material->image >= 0 ? buffers->pictures[material->image] : 0;
    glUniform4fv(models->at.base, 1, material->color);
    glUniform1i(models->at.first, buffers->first[shape->node]);
    glUniform1i(models->at.many, part->joints != NULL);
    glUniform1f(models->at.cutoff, material->cutoff);
    glUniform1i(models->at.both_sides, material->double_sided);
    glBindTexture(GL_TEXTURE_2D, picture ? picture : buffers->white);
    glBindSampler(PICTURE_UNIT, part->material >= 0 ? buffers->samplers[part->material] : 0);
    glBindVertexArray(shape->vertex_array);
    glFrontFace(is_mirrored(shown, shape->node) ? GL_CW : GL_CCW);
    if (material->double_sided) glDisable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, part->index_count, GL_UNSIGNED_INT, NULL);
    glEnable(GL_CULL_FACE);
}

static void draw_shapes(const struct stage_models *models, const struct model_buffers *buffers,
                        const struct stage_model *shown, bool blended)
{
    for (int s = 0; s < buffers->shape_count; s++) {
        if (material_of(shown->gltf, &buffers->shapes[s])->blended == blended)
            draw_shape(models, buffers, shown, &buffers->shapes[s]);
    }
}

static void draw_model(const struct stage_models *models, const struct model_buffers *buffers,
                       const struct stage_model *shown, bool is_seam)
{
    const float height = shown->hi[1] - shown->lo[1];
    glUniform2f(models->at.shade, shown->ground, fmaxf(0.3f * height, 1e-6f));
    glActiveTexture(GL_TEXTURE0 + MATRICES_UNIT);
    glBindTexture(GL_TEXTURE_2D, buffers->matrices);
    glActiveTexture(GL_TEXTURE0 + PICTURE_UNIT);
    draw_shapes(models, buffers, shown, false);
    if (!is_seam) { // what is seen through has no seam
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
        draw_shapes(models, buffers, shown, true);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
    glBindSampler(PICTURE_UNIT, 0);
    glActiveTexture(GL_TEXTURE0);
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct stage_models *models = state;
    (void)scale;
    if (view->model_count == 0) return;
    painter_use(models->program, &models->shared, view, seam);
    set_standard_attributes();
    for (int m = 0; m < view->model_count; m++)
        draw_model(models, &models->buffers[m], &view->models[m], seam > 0.0f);
    glFrontFace(GL_CCW);
    glBindVertexArray(0);
}

static float ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int m = 0; m < view->model_count; m++) lowest = fminf(lowest, view->models[m].ground);
    return lowest;
}

static void add_extent(const struct stage_view *view, struct extent *extent)
{
    for (int m = 0; m < view->model_count; m++) extent_add_box(extent, view->models[m].lo, view->models[m].hi);
}

const struct painter model_painter = {create, destroy, upload, draw, ground, add_extent};
