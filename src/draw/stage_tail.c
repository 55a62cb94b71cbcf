/// Draws tails and their animals, skinned.
#include "draw/painter.h"
#include "draw/stage_extent.h"
#include "model/coat.h"
#include "model/creature.h"
#include "model/tail_skin.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum {
    JOINT_BINDING = 0,
    BLOCK_BYTES = TAIL_SLOTS * 3 * 16, ///< what the shader's block holds: three rows a slot (model/tail_skin.h)
    BLOCK_STRIDE = (BLOCK_BYTES + 255) / 256 * 256, ///< 256: the largest offset alignment a driver may ask for
};

/// A mesh that every animal is drawn with.
struct model {
    GLuint vertex_array, vertices, indices;
    GLsizei index_count;
};

struct animals {
    GLuint program, joints;
    GLint shape;
    struct painter_uniforms shared;
    struct model models[CREATURE_LEVELS];
    float rows[TAIL_SLOTS][3][4];
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
    attribute(2, 3, offsetof(struct vertex, mark));
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

/// What of the coat never changes.
static void set_coat(GLuint program)
{
    static const struct {
        const char *name;
        uint32_t color;
    } colors[] = {{"orange", COAT_FUR}, {"brown", COAT_BAND}, {"white", COAT_TIP}, {"dark", COAT_DARK}};
    float matrix[16], linear[3];
    creature_head_from_bind(matrix);
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "head_from_bind"), 1, GL_FALSE, matrix);
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++) {
        coat_linear(colors[i].color, linear);
        glUniform3fv(glGetUniformLocation(program, colors[i].name), 1, linear);
    }
}

static bool program_create(struct animals *painter, struct error *error)
{
    painter->program = gl_program("stage_mesh.vert", "stage_mesh.frag", "FURRED", error);
    if (!painter->program) return false;
    painter->shape = glGetUniformLocation(painter->program, "shape");
    painter->shared = painter_find_uniforms(painter->program);
    set_coat(painter->program);
    glUniformBlockBinding(painter->program, glGetUniformBlockIndex(painter->program, "Joints"), JOINT_BINDING);
    glGenBuffers(1, &painter->joints);
    glBindBuffer(GL_UNIFORM_BUFFER, painter->joints);
    glBufferData(GL_UNIFORM_BUFFER, STAGE_MAX_TAILS * BLOCK_STRIDE, NULL, GL_DYNAMIC_DRAW);
    return true;
}

static void destroy(void *state)
{
    struct animals *painter = state;
    for (int level = 0; level < CREATURE_LEVELS; level++) model_destroy(&painter->models[level]);
    glDeleteBuffers(1, &painter->joints);
    if (painter->program) glDeleteProgram(painter->program);
    free(painter);
}

static void *create(struct error *error)
{
    struct animals *painter = calloc(1, sizeof *painter);
    if (!painter) {
        fail(error, ERROR_ENVIRONMENT, "not enough memory for the stage");
        return NULL;
    }
    bool made = program_create(painter, error);
    for (int level = 0; made && level < CREATURE_LEVELS; level++) {
        made = model_create(&painter->models[level], level, error);
    }
    if (made) return painter;
    destroy(painter);
    return NULL;
}

static int upload_joints(struct animals *painter, const struct stage_tail *tail, int block)
{
    const int bytes = tail_slots(&tail->pose, painter->rows) * (int)sizeof *painter->rows;
    glBufferSubData(GL_UNIFORM_BUFFER, block * BLOCK_STRIDE, bytes, painter->rows);
    return bytes;
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    struct animals *painter = state;
    glBindBuffer(GL_UNIFORM_BUFFER, painter->joints);
    for (int t = 0; t < view->tail_count; t++) *bytes += upload_joints(painter, &view->tails[t], t);
}

static void draw_animal(const struct animals *painter, const struct model *model, const struct stage_view *view,
                        int tail)
{
    const struct pose *pose = &view->tails[tail].pose;
    const int joints = pose->count - 1;
    const float length = pose_length(pose);
    glUniform4f(painter->shape, length / CREATURE_TAIL_LENGTH, (float)joints, length / (float)joints, pose->ground);
    glBindBufferRange(GL_UNIFORM_BUFFER, JOINT_BINDING, painter->joints, tail * BLOCK_STRIDE, BLOCK_BYTES);
    glDrawElements(GL_TRIANGLES, model->index_count, GL_UNSIGNED_INT, NULL);
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct animals *painter = state;
    (void)scale;
    const struct model *model = &painter->models[creature_level(view->tail_count)];
    if (view->tail_count == 0) return;
    painter_use(painter->program, &painter->shared, view, seam);
    glBindVertexArray(model->vertex_array);
    for (int t = 0; t < view->tail_count; t++) draw_animal(painter, model, view, t);
    glBindVertexArray(0);
}

static float ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int t = 0; t < view->tail_count; t++) lowest = fminf(lowest, view->tails[t].pose.ground);
    return lowest;
}

/// Skin follows joints that are at most 2.5 segments away (see stage_mesh.vert), so it stays within a sphere around each.
static void add_pose(struct extent *extent, const struct pose *pose)
{
    float lo[3], hi[3];
    const float length = pose_length(pose), segment = length / (float)(pose->count - 1);
    const float reach = hypotf(2.5f * segment, CREATURE_BRUSH_RADIUS * length / CREATURE_TAIL_LENGTH);
    pose_bounds(pose, lo, hi);
    extent_add_box(extent, lo, hi);
    for (int n = 0; n < pose->count; n++) {
        for (int k = 0; k < 3; k++) {
            lo[k] = pose->matrix[n][12 + k] - reach;
            hi[k] = pose->matrix[n][12 + k] + reach;
        }
        extent_add_box(extent, lo, hi);
    }
}

static void add_extent(const struct stage_view *view, struct extent *extent)
{
    for (int t = 0; t < view->tail_count; t++) add_pose(extent, &view->tails[t].pose);
}

const struct painter tail_painter = {create, destroy, upload, draw, ground, add_extent};
