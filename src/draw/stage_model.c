/// Draws imported characters with their own materials.
#include "base/need.h"
#include "draw/model_buffers.h"
#include "draw/skirt.h"
#include "draw/stage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MATRICES_UNIT = 0, PICTURE_UNIT = 1 };

struct stage_models {
    GLuint program;
    struct painter_uniforms shared;
    struct {
        GLint shade, base, first, many, cutoff, blended, both_sides;
    } at;
    struct stage_skirt skirt;
    struct model_buffers buffers[STAGE_MAX_MODELS]; ///< one for each place in the view
};

static void *create(struct error *error)
{
    struct stage_models *models = need_zeroed(1, sizeof *models);
    models->program = gl_program("stage_model.vert", "stage_mesh.frag", "PICTURED", error);
    if (!models->program || !stage_skirt_create(&models->skirt, error)) {
        glDeleteProgram(models->program);
        free(models);
        return NULL;
    }
    models->shared = painter_find_uniforms(models->program);
    const struct gl_uniform uniforms[] = {
        {&models->at.shade, "shade"},           {&models->at.base, "base"},
        {&models->at.first, "first"},           {&models->at.many, "many"},
        {&models->at.cutoff, "cutoff"},         {&models->at.blended, "blended"},
        {&models->at.both_sides, "both_sides"},
    };
    gl_find_uniforms(models->program, uniforms, sizeof uniforms / sizeof *uniforms);
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
        *bytes += model_buffers_pose(buffers, shown->gltf, shown->pose, shown->root);
    }
}

static const struct gltf_material plain = {.color = {1, 1, 1, 1}, .image = -1};

static const struct gltf_material *material_of(const struct gltf *gltf, const struct gltf_part *part)
{
    return part->material < 0 ? &plain : &gltf->materials[part->material];
}

static const struct gltf_part *part_of(const struct gltf *gltf, const struct model_shape *shape)
{
    return &gltf->meshes[gltf->nodes[shape->node].mesh].parts[shape->part];
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

static void use_picture(const struct model_buffers *buffers, const struct gltf_material *material, int number)
{
    const GLuint picture = material->image >= 0 ? buffers->pictures[material->image] : 0;
    glBindTexture(GL_TEXTURE_2D, picture ? picture : buffers->white);
    glBindSampler(PICTURE_UNIT, number >= 0 ? buffers->samplers[number] : 0);
}

static void draw_shape(const struct stage_models *models, const struct model_buffers *buffers,
                       const struct stage_model *shown, const struct model_shape *shape)
{
    const struct gltf_part *part = part_of(shown->gltf, shape);
    const struct gltf_material *material = material_of(shown->gltf, part);
    glUniform4fv(models->at.base, 1, material->color);
    glUniform1i(models->at.first, buffers->first[shape->node]);
    glUniform1i(models->at.many, part->joints != NULL);
    glUniform1f(models->at.cutoff, material->cutoff);
    glUniform1i(models->at.both_sides, material->double_sided);
    glUniform1i(models->at.blended, material->blended);
    use_picture(buffers, material, part->material);
    glBindVertexArray(shape->vertex_array);
    glFrontFace(model_is_mirrored(shown->gltf, shown->pose, shape->node) ? GL_CW : GL_CCW);
    if (material->double_sided) glDisable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, part->index_count, GL_UNSIGNED_INT, NULL);
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
        const enum kind kind = kind_of(material_of(shown->gltf, part_of(shown->gltf, &buffers->shapes[s])));
        if (kind >= first && kind <= last) draw_shape(models, buffers, shown, &buffers->shapes[s]);
    }
}

static void set_shade(GLint at, const struct stage_model *shown)
{
    glUniform2f(at, shown->ground, fmaxf(0.3f * (shown->hi[1] - shown->lo[1]), 1e-6f));
}

/// In the second pass again what is masked, as there its edges fade out over what is behind.
static void draw_model(const struct stage_models *models, const struct model_buffers *buffers,
                       const struct stage_model *shown, bool second)
{
    set_shade(models->at.shade, shown);
    glActiveTexture(GL_TEXTURE0 + MATRICES_UNIT);
    glBindTexture(GL_TEXTURE_2D, buffers->matrices);
    glActiveTexture(GL_TEXTURE0 + PICTURE_UNIT);
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
    glBindSampler(PICTURE_UNIT, 0);
    glActiveTexture(GL_TEXTURE0);
}

/// Of a part whose first vertex among its node's is `first`.
struct look {
    const struct gltf_part *part;
    const float *color, (*normal)[3];
    int first;
};

static void look_at(const void *context, uint32_t vertex, struct skirt_vertex *out)
{
    const struct look *look = context;
    const int v = (int)vertex - look->first;
    *out = (struct skirt_vertex){0};
    memcpy(out->normal, look->normal[vertex], sizeof out->normal);
    memcpy(out->color, look->color, sizeof out->color);
    for (int k = 0; look->part->color && k < 4; k++) out->color[k] *= look->part->color[v][k];
    if (look->part->uv) memcpy(out->uv, look->part->uv[v], sizeof out->uv);
}

static void draw_node_skirts(const struct stage_models *models, const struct model_buffers *buffers,
                             const struct stage_model *shown, int node, const struct stage_view *view, float seam)
{
    const struct gltf_mesh *mesh = &shown->gltf->meshes[shown->gltf->nodes[node].mesh];
    const struct skirt_mesh skirts =
        model_skirt_pose(&buffers->skirt, shown->gltf, shown->pose, node, shown->root, view->eye);
    struct look look = {.normal = (const float(*)[3])buffers->skirt.normal + buffers->skirt.first_vertex[node]};
    int first = 0;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_material *material = material_of(shown->gltf, &mesh->parts[p]);
        look.part = &mesh->parts[p];
        look.color = material->color;
        glUniform1f(models->skirt.at.cutoff, material->cutoff);
        glUniform1i(models->skirt.at.blended, material->blended);
        use_picture(buffers, material, look.part->material);
        stage_skirt_draw(&models->skirt, &skirts, first, first + look.part->index_count, material->double_sided,
                         view->eye, seam, look_at, &look);
        look.first += look.part->vertex_count;
        first += look.part->index_count;
    }
}

static void draw_skirts(const struct stage_models *models, const struct stage_view *view, float seam)
{
    stage_skirt_use(&models->skirt, view, seam);
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        set_shade(models->skirt.at.shade, shown);
        for (int n = 0; models->buffers[m].skirt.neighbours && n < shown->gltf->node_count; n++) {
            if (shown->gltf->nodes[n].mesh >= 0) draw_node_skirts(models, &models->buffers[m], shown, n, view, seam);
        }
    }
    stage_skirt_leave();
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
    if (seam > 0.0f) draw_skirts(models, view, seam);
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
