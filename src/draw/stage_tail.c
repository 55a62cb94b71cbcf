/// Draws tails and their animals, skinned.
#include "draw/painter.h"
#include "draw/stage_extent.h"
#include "model/coat.h"
#include "model/creature.h"
#include "model/tail_skin.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum {
    JOINT_BINDING = 0,
    BLOCK_BYTES = TAIL_SLOTS * 3 * 16, ///< what the shader's block holds: three rows a slot (model/tail_skin.h)
    BLOCK_STRIDE = (BLOCK_BYTES + 255) / 256 * 256, ///< 256: the largest offset alignment a driver may ask for
};

/// What is drawn by a program of its own, so that each pixel and vertex pays only for what it is part of: what bends with the tail, the rest
/// of the body, and what the face is on.
enum region { REGION_TAIL, REGION_BODY, REGION_FACE, REGIONS };

/// A mesh that every animal is drawn with, its triangles by region.
struct model {
    GLuint vertex_array, vertices, indices;
    GLsizei first[REGIONS + 1];
};

struct coat_program {
    GLuint program;
    GLint shape, blink;
    struct painter_uniforms shared;
};

struct animals {
    GLuint joints;
    struct coat_program programs[REGIONS];
    struct model models[CREATURE_LEVELS];
    float rows[TAIL_SLOTS][3][4];
};

static void attribute(GLuint index, GLint size, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(struct vertex), (const void *)offset);
}

static enum region region_of(const struct mesh *mesh, const uint32_t corners[3])
{
    bool bends = false;
    float lo[3], hi[3];
    for (int c = 0; c < 3; c++) {
        const struct vertex *vertex = &mesh->vertices[corners[c]];
        float place[3];
        creature_into_head(vertex->position, place);
        bends |= vertex->bend > 0.0f;
        for (int k = 0; k < 3; k++) {
            lo[k] = c > 0 ? fminf(lo[k], place[k]) : place[k];
            hi[k] = c > 0 ? fmaxf(hi[k], place[k]) : place[k];
        }
    }
    if (bends) return REGION_TAIL;
    for (int k = 0; k < 3; k++) {
        if (lo[k] > creature_face_hi[k] || hi[k] < creature_face_lo[k]) return REGION_BODY;
    }
    return REGION_FACE;
}

/// Sorts a mesh's triangles by region; false if memory runs out.
static bool sort_triangles(struct model *model, struct mesh *mesh)
{
    const size_t size = (size_t)mesh->index_count * sizeof *mesh->indices;
    uint32_t *sorted = malloc(size);
    int count = 0;
    for (int region = 0; sorted && region < REGIONS; region++) {
        model->first[region] = count;
        for (int i = 0; i < mesh->index_count; i += 3) {
            if (region_of(mesh, mesh->indices + i) != (enum region)region) continue;
            memcpy(sorted + count, mesh->indices + i, 3 * sizeof *sorted);
            count += 3;
        }
    }
    model->first[REGIONS] = count;
    if (sorted) memcpy(mesh->indices, sorted, size);
    free(sorted);
    return sorted;
}

static bool model_create(struct model *model, int level, struct error *error)
{
    struct mesh mesh = {0};
    mesh_creature(level, &mesh);
    if (mesh.failed || !sort_triangles(model, &mesh)) {
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
    attribute(4, 3, offsetof(struct vertex, limb));
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

static bool program_create(struct coat_program *coat, const char *define, struct error *error)
{
    const GLuint program = coat->program = gl_program("stage_mesh.vert", "stage_mesh.frag", define, error);
    if (!program) return false;
    coat->shape = glGetUniformLocation(program, "shape");
    coat->blink = glGetUniformLocation(program, "blink");
    coat->shared = painter_find_uniforms(program);
    set_coat(program);
    glUniformBlockBinding(program, glGetUniformBlockIndex(program, "Joints"), JOINT_BINDING);
    return true;
}

static bool programs_create(struct animals *painter, struct error *error)
{
    static const char *const defines[REGIONS] = {
        [REGION_TAIL] = "FURRED", [REGION_BODY] = "LIMBED", [REGION_FACE] = "FACED"};
    for (int region = 0; region < REGIONS; region++) {
        if (!program_create(&painter->programs[region], defines[region], error)) return false;
    }
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
    for (int region = 0; region < REGIONS; region++) {
        if (painter->programs[region].program) glDeleteProgram(painter->programs[region].program);
    }
    free(painter);
}

static void *create(struct error *error)
{
    struct animals *painter = calloc(1, sizeof *painter);
    if (!painter) {
        fail(error, ERROR_ENVIRONMENT, "not enough memory for the stage");
        return NULL;
    }
    bool made = programs_create(painter, error);
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

static void draw_region(const struct animals *painter, const struct model *model, const struct stage_view *view,
                        int tail, enum region region)
{
    const struct pose *pose = &view->tails[tail].pose;
    const struct coat_program *coat = &painter->programs[region];
    const GLsizei first = model->first[region], count = model->first[region + 1] - first;
    const int joints = pose->count - 1;
    const float length = pose_length(pose);
    glUniform4f(coat->shape, length / CREATURE_TAIL_LENGTH, (float)joints, length / (float)joints, pose->ground);
    glBindBufferRange(GL_UNIFORM_BUFFER, JOINT_BINDING, painter->joints, tail * BLOCK_STRIDE, BLOCK_BYTES);
    if (coat->blink >= 0) glUniform1f(coat->blink, pose->limbs.blink);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, (const void *)((size_t)first * sizeof(GLuint)));
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct animals *painter = state;
    (void)scale;
    const struct model *model = &painter->models[creature_level(view->tail_count)];
    if (view->tail_count == 0) return;
    glBindVertexArray(model->vertex_array);
    for (int region = 0; region < REGIONS; region++) {
        painter_use(painter->programs[region].program, &painter->programs[region].shared, view, seam);
        for (int t = 0; t < view->tail_count; t++) draw_region(painter, model, view, t, (enum region)region);
    }
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
