/// Draws the stage: ground, shadows, bodies and skinned tails.
#include "draw/stage.h"
#include "draw/gl.h"
#include "draw/stage_flat.h"
#include "draw/stage_morph.h"
#include "model/creature.h"
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum {
    JOINT_BINDING = 0,
    MAX_SLOTS = POSE_MAX_JOINTS + 1,  ///< slot 0 does not bend, slot n + 1 follows joint n (see stage_mesh.vert)
    BLOCK_BYTES = MAX_SLOTS * 3 * 16, ///< what the shader's block holds: three rows a slot
    BLOCK_STRIDE = (BLOCK_BYTES + 255) / 256 * 256, ///< 256: the largest offset alignment a driver may ask for
};

/// A mesh that every animal is drawn with.
struct model {
    GLuint vertex_array, vertices, indices;
    GLsizei index_count;
};

struct stage_renderer {
    GLuint program, joints;
    GLint clip_from_world, shape, eye, key_from, earth, seam;
    struct model models[CREATURE_LEVELS];
    struct stage_flat *flat;
    struct stage_morph *morph;
    float rows[MAX_SLOTS][3][4];
};

static void attribute(GLuint index, GLint size, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(struct vertex), (const void *)offset);
}

static bool model_create(struct model *model, int level, struct error *error)
{
    struct mesh mesh = {0};
    mesh_creature(level, &mesh);
    model->index_count = mesh.index_count;
    if (mesh.failed) {
        mesh_free(&mesh);
        return fail(error, ERROR_ENVIRONMENT, "not enough memory for the model on the stage");
    }
    glGenVertexArrays(1, &model->vertex_array);
    glBindVertexArray(model->vertex_array);
    glGenBuffers(1, &model->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, model->vertices);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)mesh.vertex_count * sizeof *mesh.vertices), mesh.vertices,
                 GL_STATIC_DRAW);
    glGenBuffers(1, &model->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)mesh.index_count * sizeof *mesh.indices), mesh.indices,
                 GL_STATIC_DRAW);
    attribute(0, 3, offsetof(struct vertex, position));
    attribute(1, 3, offsetof(struct vertex, normal));
    attribute(2, 3, offsetof(struct vertex, color));
    attribute(3, 1, offsetof(struct vertex, bend));
    glBindVertexArray(0);
    mesh_free(&mesh);
    return true;
}

static void model_destroy(struct model *model)
{
    glDeleteVertexArrays(1, &model->vertex_array);
    glDeleteBuffers(1, &model->vertices);
    glDeleteBuffers(1, &model->indices);
}

static bool program_create(struct stage_renderer *renderer, struct error *error)
{
    renderer->program = gl_program("stage_mesh.vert", "stage_mesh.frag", error);
    if (!renderer->program) return false;
    renderer->clip_from_world = glGetUniformLocation(renderer->program, "clip_from_world");
    renderer->shape = glGetUniformLocation(renderer->program, "shape");
    renderer->eye = glGetUniformLocation(renderer->program, "eye");
    renderer->key_from = glGetUniformLocation(renderer->program, "key_from");
    renderer->earth = glGetUniformLocation(renderer->program, "earth");
    renderer->seam = glGetUniformLocation(renderer->program, "seam");
    glUniformBlockBinding(renderer->program, glGetUniformBlockIndex(renderer->program, "Joints"), JOINT_BINDING);
    glGenBuffers(1, &renderer->joints);
    glBindBuffer(GL_UNIFORM_BUFFER, renderer->joints);
    glBufferData(GL_UNIFORM_BUFFER, STAGE_MAX_TAILS * BLOCK_STRIDE, NULL, GL_DYNAMIC_DRAW);
    return true;
}

struct stage_renderer *stage_renderer_create(struct error *error)
{
    struct stage_renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        fail(error, ERROR_ENVIRONMENT, "not enough memory for the stage");
        return NULL;
    }
    bool made = program_create(renderer, error) && (renderer->flat = stage_flat_create(error)) != NULL &&
                (renderer->morph = stage_morph_create(error)) != NULL;
    for (int level = 0; made && level < CREATURE_LEVELS; level++) {
        made = model_create(&renderer->models[level], level, error);
    }
    if (made) return renderer;
    stage_renderer_destroy(renderer);
    return NULL;
}

void stage_renderer_destroy(struct stage_renderer *renderer)
{
    if (!renderer) return;
    for (int level = 0; level < CREATURE_LEVELS; level++) model_destroy(&renderer->models[level]);
    stage_flat_destroy(renderer->flat);
    stage_morph_destroy(renderer->morph);
    glDeleteBuffers(1, &renderer->joints);
    if (renderer->program) glDeleteProgram(renderer->program);
    free(renderer);
}

/// matrix · translation by −along on z, as three rows: what takes a point of the straight tail to where its joint is
/// now.
static void slot_rows(const float matrix[16], float along, float rows[3][4])
{
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) rows[r][c] = matrix[4 * c + r];
        rows[r][3] -= along * rows[r][2];
    }
}

static int upload_joints(struct stage_renderer *renderer, const struct stage_tail *tail, int block)
{
    const int joints = tail->pose.count - 1;
    const float segment = pose_length(&tail->pose) / (float)joints;
    float root[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    memcpy(root + 12, tail->pose.matrix[0] + 12, 3 * sizeof *root);
    slot_rows(root, 0.0f, renderer->rows[0]);
    for (int n = 0; n < joints; n++) slot_rows(tail->pose.matrix[n], (float)n * segment, renderer->rows[n + 1]);
    const int bytes = (joints + 1) * (int)sizeof *renderer->rows;
    glBufferSubData(GL_UNIFORM_BUFFER, block * BLOCK_STRIDE, bytes, renderer->rows);
    return bytes;
}

void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes)
{
    glBindBuffer(GL_UNIFORM_BUFFER, renderer->joints);
    for (int t = 0; t < view->tail_count; t++) *bytes += upload_joints(renderer, &view->tails[t], t);
    stage_morph_upload(renderer->morph, view, bytes);
    *bytes += stage_flat_upload(renderer->flat, view);
}

static void draw_animal(const struct stage_renderer *renderer, const struct model *model,
                        const struct stage_view *view, int tail)
{
    const struct pose *pose = &view->tails[tail].pose;
    const int joints = pose->count - 1;
    const float length = pose_length(pose);
    glUniform4f(renderer->shape, length / CREATURE_TAIL_LENGTH, (float)joints, length / (float)joints, pose->ground);
    glBindBufferRange(GL_UNIFORM_BUFFER, JOINT_BINDING, renderer->joints, tail * BLOCK_STRIDE, BLOCK_BYTES);
    glDrawElements(GL_TRIANGLES, model->index_count, GL_UNSIGNED_INT, NULL);
}

/// One pass over all tails; `seam` as in stage_mesh.vert.
static void draw_animals(const struct stage_renderer *renderer, const struct stage_view *view, float seam)
{
    const struct model *model = &renderer->models[creature_level(view->tail_count)];
    float clip_from_world[16];
    if (view->tail_count == 0) return;
    stage_clip_from_world(view, clip_from_world);
    glUseProgram(renderer->program);
    glUniformMatrix4fv(renderer->clip_from_world, 1, GL_FALSE, clip_from_world);
    glUniform3fv(renderer->eye, 1, view->eye);
    glUniform3fv(renderer->key_from, 1, view->key_from);
    gl_uniform_linear(renderer->earth, view->colors.bounce);
    glUniform1f(renderer->seam, seam);
    glBindVertexArray(model->vertex_array);
    for (int t = 0; t < view->tail_count; t++) draw_animal(renderer, model, view, t);
    glBindVertexArray(0);
}

static void draw_rigs(const struct stage_renderer *renderer, const struct stage_view *view, float scale, float seam)
{
    draw_animals(renderer, view, seam);
    stage_morph_draw(renderer->morph, view, scale, seam);
}

void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height)
{
    const float scale = (float)height / view->viewport.h;
    glViewport(x, y, width, height);
    glDisable(GL_DEPTH_TEST);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    stage_flat_draw(renderer->flat);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_rigs(renderer, view, scale, 0.0f);
    // Edges without multisampling: a second skin, a pixel larger, fades out from the first one's silhouettes over
    // whatever is behind them, be it the background or the animal itself.
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    draw_rigs(renderer, view, scale, 2.0f / (view->projection[5] * (float)height));
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}
