/// Draws imported characters with their own materials.
#include "base/need.h"
#include "draw/model_buffers.h"
#include "draw/skirt.h"
#include "draw/stage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURE_UNIT = 1, COVER = 5 }; ///< a location in stage_skirt.vert

struct stage_models {
    struct stage_skirt skirt;                       ///< whose program draws surfaces too
    struct model_buffers buffers[STAGE_MAX_MODELS]; ///< one for each place in the view
};

static void *create(struct error *error)
{
    struct stage_models *models = need_zeroed(1, sizeof *models);
    if (stage_skirt_create(&models->skirt, error)) return models;
    free(models);
    return NULL;
}

static void destroy(void *state)
{
    struct stage_models *models = state;
    for (int m = 0; m < STAGE_MAX_MODELS; m++) model_buffers_free(&models->buffers[m]);
    stage_skirt_destroy(&models->skirt);
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
        *bytes += model_buffers_pose(buffers, shown->gltf, shown->pose, shown->root, view->eye);
    }
}

static const struct gltf_part *part_of(const struct gltf *gltf, const struct model_shape *shape)
{
    return &gltf->meshes[gltf->nodes[shape->node].mesh].parts[shape->part];
}

static void use_material(const struct stage_models *models, const struct model_buffers *buffers,
                         const struct gltf *gltf, const struct gltf_part *part)
{
    const struct gltf_material *material = model_material(gltf, part);
    const GLuint picture = material->image >= 0 ? buffers->pictures[material->image] : 0;
    glUniform1f(models->skirt.at.cutoff, material->cutoff);
    glUniform1i(models->skirt.at.blended, material->blended);
    glBindTexture(GL_TEXTURE_2D, picture ? picture : buffers->white);
    glBindSampler(PICTURE_UNIT, part->material >= 0 ? buffers->samplers[part->material] : 0);
}

static void draw_shape(const struct stage_models *models, const struct model_buffers *buffers,
                       const struct stage_model *shown, const struct model_shape *shape)
{
    const struct gltf_part *part = part_of(shown->gltf, shape);
    const bool both_sides = model_material(shown->gltf, part)->double_sided;
    const struct skirt_mesh mesh = model_surface_mesh(&buffers->surface, shown->gltf, shown->pose, shape->node);
    use_material(models, buffers, shown->gltf, part);
    glUniform1i(models->skirt.at.both_sides, both_sides);
    glFrontFace(mesh.mirrored ? GL_CW : GL_CCW);
    if (both_sides) glDisable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, part->index_count, GL_UNSIGNED_INT,
                   (const void *)((size_t)shape->first * sizeof(GLuint)));
    glEnable(GL_CULL_FACE);
}

enum kind { SOLID, MASKED, BLENDED };

static enum kind kind_of(const struct gltf_material *material)
{
    if (material->blended) return BLENDED;
    return material->cutoff > 0.0f ? MASKED : SOLID;
}

static void draw_shapes(const struct stage_models *models, const struct model_buffers *buffers,
                        const struct stage_model *shown, enum kind first, enum kind last)
{
    for (int s = 0; s < buffers->shape_count; s++) {
        const enum kind kind = kind_of(model_material(shown->gltf, part_of(shown->gltf, &buffers->shapes[s])));
        if (kind >= first && kind <= last) draw_shape(models, buffers, shown, &buffers->shapes[s]);
    }
}

/// In the second pass again what is masked, as there its edges fade out over what is behind.
static void draw_surface(const struct stage_models *models, const struct model_buffers *buffers,
                         const struct stage_model *shown, bool second)
{
    glBindVertexArray(buffers->vertex_array);
    if (second) {
        draw_shapes(models, buffers, shown, MASKED, MASKED);
    } else {
        draw_shapes(models, buffers, shown, SOLID, MASKED);
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
        draw_shapes(models, buffers, shown, BLENDED, BLENDED);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
    glFrontFace(GL_CCW);
}

static void look_at(const void *context, uint32_t vertex, struct skirt_vertex *out)
{
    const struct model_buffers *buffers = context;
    const struct model_look *look = &buffers->looks[vertex];
    memcpy(out->normal, buffers->surface.normal[vertex], sizeof out->normal);
    memcpy(out->color, look->color, sizeof out->color);
    memcpy(out->uv, look->uv, sizeof out->uv);
    memcpy(out->phase, look->phase, sizeof out->phase);
}

static void draw_skirts(const struct stage_models *models, const struct model_buffers *buffers,
                        const struct stage_model *shown, const float eye[3], float seam)
{
    glUniform1i(models->skirt.at.both_sides, 0);
    for (int s = 0; s < buffers->shape_count; s++) {
        const struct model_shape *shape = &buffers->shapes[s];
        const struct gltf_part *part = part_of(shown->gltf, shape);
        const struct skirt_mesh mesh = model_surface_mesh(&buffers->surface, shown->gltf, shown->pose, shape->node);
        use_material(models, buffers, shown->gltf, part);
        stage_skirt_draw(&models->skirt, &mesh, shape->first, shape->first + part->index_count,
                         model_material(shown->gltf, part)->double_sided, eye, seam, look_at, buffers);
    }
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct stage_models *models = state;
    (void)scale;
    if (view->model_count == 0) return;
    stage_skirt_use(&models->skirt, view, seam);
    glVertexAttrib1f(COVER, 1.0f);
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        const float height = fmaxf(0.3f * (shown->hi[1] - shown->lo[1]), 1e-6f);
        glUniform2f(models->skirt.at.shade, shown->ground, height);
        draw_surface(models, &models->buffers[m], shown, seam > 0.0f);
        if (seam > 0.0f) draw_skirts(models, &models->buffers[m], shown, view->eye, seam);
    }
    stage_skirt_leave();
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
