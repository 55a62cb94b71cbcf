/// Draws imported characters and foxes, with their own materials: pictures, a coat, and what a face is drawn on.
#include "base/need.h"
#include "draw/model_buffers.h"
#include "draw/skirt.h"
#include "draw/stage.h"
#include "model/fox.h"
#include <stdlib.h>
#include <string.h>

enum { PICTURE_UNIT = 1 };
/// Models on the GPU, one more than a picture shows; and after how many pictures without it one goes.
enum { MAX_KEPT = STAGE_MAX_MODELS + 1, FORGOTTEN = 1000 };

enum look { LOOK_COAT, LOOK_FACE, COATS, LOOK_PLAIN = COATS, LOOK_PICTURED, LOOKS };

/// A program for coats. All draw surfaces and skirts alike.
struct coat_program {
    GLuint program;
    GLint shade, blink;
    struct painter_uniforms shared;
};

struct stage_models {
    struct coat_program coats[COATS];
    struct stage_skirt skirt; ///< whose program draws pictures
    struct model_buffers buffers[MAX_KEPT];
    long clock; ///< pictures
};

static bool coat_create(struct coat_program *coat, const char *define, struct error *error)
{
    float head_from_bind[16];
    const GLuint program = coat->program = gl_program("stage_skirt.vert", "stage_mesh.frag", define, error);
    if (!program) return false;
    coat->shade = glGetUniformLocation(program, "shade");
    coat->blink = glGetUniformLocation(program, "blink");
    coat->shared = painter_find_uniforms(program);
    fox_head_from_bind(head_from_bind);
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "head_from_bind"), 1, GL_FALSE, head_from_bind);
    return true;
}

static void free_coats(struct stage_models *models)
{
    for (int look = 0; look < COATS; look++) glDeleteProgram(models->coats[look].program);
}

static void *create(struct error *error)
{
    struct stage_models *models = need_zeroed(1, sizeof *models);
    if (stage_skirt_create(&models->skirt, error)) {
        if (coat_create(&models->coats[LOOK_COAT], "FURRED", error) &&
            coat_create(&models->coats[LOOK_FACE], "FACED", error))
            return models;
        stage_skirt_destroy(&models->skirt);
    }
    free_coats(models);
    free(models);
    return NULL;
}

static void destroy(void *state)
{
    struct stage_models *models = state;
    for (int m = 0; m < MAX_KEPT; m++) model_buffers_free(&models->buffers[m]);
    stage_skirt_destroy(&models->skirt);
    free_coats(models);
    free(models);
}

/// Which buffers have a model, −1: none.
static int find_buffers(const struct stage_models *models, uint64_t id)
{
    int m = MAX_KEPT;
    while (--m >= 0 && models->buffers[m].id != id) continue;
    return m;
}

/// Frees what has not been shown for long, and at least what was shown least recently.
static struct model_buffers *make_room(struct stage_models *models)
{
    struct model_buffers *oldest = &models->buffers[0];
    for (int m = 0; m < MAX_KEPT; m++) {
        struct model_buffers *buffers = &models->buffers[m];
        if (buffers->id && models->clock - buffers->used > FORGOTTEN) model_buffers_free(buffers);
        if (buffers->used < oldest->used) oldest = buffers;
    }
    model_buffers_free(oldest);
    return oldest;
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    struct stage_models *models = state;
    models->clock++;
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        const int kept = find_buffers(models, shown->gltf->id);
        struct model_buffers *buffers = kept >= 0 ? &models->buffers[kept] : make_room(models);
        if (kept < 0) *bytes += model_buffers_create(buffers, shown->gltf);
        buffers->used = models->clock;
        *bytes += model_buffers_pose(buffers, shown->gltf, shown->pose, shown->root, view->eye);
    }
}

static const struct gltf_part *part_of(const struct gltf *gltf, const struct model_shape *shape)
{
    return &gltf->meshes[gltf->nodes[shape->node].mesh].parts[shape->part];
}

/// What draws a part: its surface, or its skirts.
static enum look look_of(const struct gltf *gltf, const struct gltf_part *part, bool skirts)
{
    const struct gltf_material *material = model_material(gltf, part);
    if (part->mark) return strcmp(material->name, "face") == 0 ? LOOK_FACE : LOOK_COAT;
    const bool plain =
        material->image < 0 && material->cutoff <= 0.0f && !material->blended && !material->double_sided;
    return plain && !skirts ? LOOK_PLAIN : LOOK_PICTURED;
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
                       const struct stage_model *shown, const struct model_shape *shape, enum look look)
{
    const struct gltf_part *part = part_of(shown->gltf, shape);
    const bool both_sides = model_material(shown->gltf, part)->double_sided;
    const struct skirt_mesh mesh = model_surface_mesh(&buffers->surface, shown->gltf, shown->pose, shape->node);
    if (look == LOOK_PICTURED) {
        use_material(models, buffers, shown->gltf, part);
        glUniform1i(models->skirt.at.both_sides, both_sides);
    }
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
                        const struct stage_model *shown, enum look look, enum kind first, enum kind last)
{
    for (int s = 0; s < buffers->shape_count; s++) {
        const struct gltf_part *part = part_of(shown->gltf, &buffers->shapes[s]);
        const enum kind kind = kind_of(model_material(shown->gltf, part));
        if (look_of(shown->gltf, part, false) == look && kind >= first && kind <= last)
            draw_shape(models, buffers, shown, &buffers->shapes[s], look);
    }
}

/// In the second pass again what is masked, as there its edges fade out over what is behind.
static void draw_surface(const struct stage_models *models, const struct model_buffers *buffers,
                         const struct stage_model *shown, enum look look, bool second)
{
    glBindVertexArray(buffers->drawn.vertex_array);
    if (second) {
        draw_shapes(models, buffers, shown, look, MASKED, MASKED);
    } else {
        draw_shapes(models, buffers, shown, look, SOLID, MASKED);
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
        draw_shapes(models, buffers, shown, look, BLENDED, BLENDED);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
    glFrontFace(GL_CCW);
}

static void look_at(const void *context, uint32_t vertex, struct skirt_vertex *out)
{
    const struct model_buffers *buffers = context;
    const struct surface_look *look = &buffers->looks[vertex];
    memcpy(out->normal, buffers->surface.normal[vertex], sizeof out->normal);
    memcpy(out->color, look->color, sizeof out->color);
    memcpy(out->uv, look->uv, sizeof out->uv);
    memcpy(out->phase, look->phase, sizeof out->phase);
}

static void draw_skirts(const struct stage_models *models, const struct model_buffers *buffers,
                        const struct stage_model *shown, enum look look, const float eye[3], float seam)
{
    if (look == LOOK_PICTURED) glUniform1i(models->skirt.at.both_sides, 0);
    for (int s = 0; s < buffers->shape_count; s++) {
        const struct model_shape *shape = &buffers->shapes[s];
        const struct gltf_part *part = part_of(shown->gltf, shape);
        const struct skirt_mesh mesh = model_surface_mesh(&buffers->surface, shown->gltf, shown->pose, shape->node);
        if (look_of(shown->gltf, part, true) != look) continue;
        if (look == LOOK_PICTURED) use_material(models, buffers, shown->gltf, part);
        stage_skirt_draw(&models->skirt, &mesh, shape->first, shape->first + part->index_count,
                         model_material(shown->gltf, part)->double_sided, eye, seam, look_at, buffers);
    }
}

/// Uses the program of a look for a model, and sets its light.
static void use_look(const struct stage_models *models, enum look look, const struct stage_view *view,
                     const struct stage_model *shown, float seam)
{
    const float shade[2] = {shown->ground, shown->dusk};
    if (look == LOOK_PLAIN) {
        stage_plain_use(&models->skirt, view, shade, 0.0f);
    } else if (look == LOOK_PICTURED) {
        stage_skirt_use(&models->skirt, view, seam);
        glUniform2fv(models->skirt.at.shade, 1, shade);
    } else {
        const struct coat_program *coat = &models->coats[look];
        painter_use(coat->program, &coat->shared, view, seam);
        glUniform2fv(coat->shade, 1, shade);
        if (look == LOOK_FACE && shown->gltf->weight_count > 0) glUniform1f(coat->blink, shown->pose->weights[0]);
    }
}

/// Whether any part of a model has that look.
static bool has_look(const struct model_buffers *buffers, const struct gltf *gltf, enum look look, bool skirts)
{
    int s = buffers->shape_count;
    while (--s >= 0 && look_of(gltf, part_of(gltf, &buffers->shapes[s]), skirts) != look) continue;
    return s >= 0;
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct stage_models *models = state;
    const bool second = seam > 0.0f;
    (void)scale;
    if (view->model_count == 0) return;
    glVertexAttrib1f(5, 1.0f); // opaque, but skirts
    for (enum look look = 0; look < LOOKS; look++) {
        for (int m = 0; m < view->model_count; m++) {
            const struct stage_model *shown = &view->models[m];
            const struct model_buffers *buffers = &models->buffers[find_buffers(models, shown->gltf->id)];
            if (!has_look(buffers, shown->gltf, look, second)) continue;
            use_look(models, look, view, shown, seam);
            draw_surface(models, buffers, shown, look, second);
            if (second) draw_skirts(models, buffers, shown, look, view->eye, seam);
        }
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
