/// Draws tails and their animals, skinned.
#include "draw/area.h"
#include "draw/painter.h"
#include "draw/stage_extent.h"
#include "draw/stage_skin.h"
#include "model/coat.h"
#include "model/creature.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/// A mesh on the GPU: what of it does not move.
struct model {
    struct skin_mesh skin;
    GLuint vertex_array, vertices;
};

struct coat_program {
    GLuint program;
    GLint shape, blink;
    struct painter_uniforms shared;
};

struct animals {
    struct coat_program programs[REGIONS];
    struct model models[CREATURE_LEVELS];
    int vertices;           ///< that all animals of a stage have at most
    float (*place)[3];      ///< of all animals, one after the other; then as many normals
    float *facing;          ///< of all animals
    uint32_t *seen;         ///< triangles of a pass
    GLuint moving, indices; ///< `place` and `seen` on the GPU
};

static void attribute(GLuint index, GLint size, size_t stride, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, (GLsizei)stride, (const void *)offset);
}

static bool model_create(struct model *model, int level)
{
    if (!stage_skin_create(&model->skin, level)) return false;
    const struct mesh *mesh = &model->skin.mesh;
    glGenVertexArrays(1, &model->vertex_array);
    glBindVertexArray(model->vertex_array);
    glGenBuffers(1, &model->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, model->vertices);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)mesh->vertex_count * sizeof *mesh->vertices), mesh->vertices,
                 GL_STATIC_DRAW);
    attribute(0, 3, sizeof(struct vertex), offsetof(struct vertex, position));
    attribute(1, 3, sizeof(struct vertex), offsetof(struct vertex, mark));
    attribute(2, 1, sizeof(struct vertex), offsetof(struct vertex, bend));
    glBindVertexArray(0);
    return true;
}

static void model_destroy(struct model *model)
{
    glDeleteVertexArrays(1, &model->vertex_array);
    glDeleteBuffers(1, &model->vertices);
    mesh_free(&model->skin.mesh);
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
    return true;
}

static bool programs_create(struct animals *painter, struct error *error)
{
    static const char *const defines[REGIONS] = {[REGION_COAT] = "FURRED", [REGION_FACE] = "FACED"};
    for (int region = 0; region < REGIONS; region++) {
        if (!program_create(&painter->programs[region], defines[region], error)) return false;
    }
    return true;
}

static const struct model *model_of(const struct animals *painter, int animals)
{
    return &painter->models[creature_level(animals)];
}

/// Room for as many animals as a stage can have; false if memory runs out.
static bool room_create(struct animals *painter)
{
    int indices = 0;
    for (int animals = 1; animals <= STAGE_MAX_TAILS; animals++) {
        const struct mesh *mesh = &model_of(painter, animals)->skin.mesh;
        painter->vertices = area_max(painter->vertices, animals * mesh->vertex_count);
        indices = area_max(indices, animals * mesh->index_count);
    }
    painter->place = malloc(2 * (size_t)painter->vertices * sizeof *painter->place);
    painter->facing = malloc((size_t)painter->vertices * sizeof *painter->facing);
    painter->seen = malloc((size_t)indices * sizeof *painter->seen);
    glGenBuffers(1, &painter->moving);
    glGenBuffers(1, &painter->indices);
    return painter->place && painter->facing && painter->seen;
}

static void destroy(void *state)
{
    struct animals *painter = state;
    for (int level = 0; level < CREATURE_LEVELS; level++) model_destroy(&painter->models[level]);
    glDeleteBuffers(1, &painter->moving);
    glDeleteBuffers(1, &painter->indices);
    for (int region = 0; region < REGIONS; region++) {
        if (painter->programs[region].program) glDeleteProgram(painter->programs[region].program);
    }
    free(painter->place);
    free(painter->facing);
    free(painter->seen);
    free(painter);
}

static void *create(struct error *error)
{
    struct animals *painter = calloc(1, sizeof *painter);
    if (painter && !programs_create(painter, error)) {
        destroy(painter);
        return NULL;
    }
    bool made = painter != NULL;
    for (int level = 0; made && level < CREATURE_LEVELS; level++) made = model_create(&painter->models[level], level);
    if (made && room_create(painter)) return painter;
    fail(error, ERROR_ENVIRONMENT, "not enough memory for the stage");
    if (painter) destroy(painter);
    return NULL;
}

static struct skin skin_of(const struct animals *painter, const struct model *model, int tail)
{
    const int first = tail * model->skin.mesh.vertex_count;
    return (struct skin){painter->place + first, painter->place + painter->vertices + first, painter->facing + first};
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    const struct animals *painter = state;
    const struct model *model = model_of(painter, view->tail_count);
    const size_t half = (size_t)painter->vertices * sizeof *painter->place;
    const size_t used = (size_t)(view->tail_count * model->skin.mesh.vertex_count) * sizeof *painter->place;
    if (view->tail_count == 0) return;
    for (int t = 0; t < view->tail_count; t++) {
        const struct skin skin = skin_of(painter, model, t);
        stage_skin_pose(&model->skin, &view->tails[t].pose, view->eye, &skin);
    }
    glBindBuffer(GL_ARRAY_BUFFER, painter->moving);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(2 * half), NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)used, painter->place);
    glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)half, (GLsizeiptr)used, painter->place + painter->vertices);
    *bytes += 2 * (long)used;
}

static void draw_region(const struct animals *painter, const struct model *model, const struct pose *pose, int tail,
                        enum region region, GLsizei first, GLsizei count)
{
    const struct coat_program *coat = &painter->programs[region];
    const size_t stride = sizeof *painter->place, half = (size_t)painter->vertices * stride;
    const size_t offset = (size_t)(tail * model->skin.mesh.vertex_count) * stride;
    attribute(3, 3, stride, offset);
    attribute(4, 3, stride, half + offset);
    glUniform2f(coat->shape, pose_length(pose) / CREATURE_TAIL_LENGTH, pose->ground);
    if (coat->blink >= 0) glUniform1f(coat->blink, pose->limbs.blink);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, (const void *)((size_t)first * sizeof(GLuint)));
}

/// Uploads the triangles that are seen in a pass; those of region r and animal t begin at first[r][t] and end where the next ones begin.
static void upload_seen(const struct animals *painter, const struct model *model, const struct stage_view *view,
                        float seam, GLsizei first[REGIONS][STAGE_MAX_TAILS + 1])
{
    GLsizei count = 0;
    for (int region = 0; region < REGIONS; region++) {
        for (int t = 0; t < view->tail_count; t++) {
            const struct skin skin = skin_of(painter, model, t);
            first[region][t] = count;
            count +=
                stage_skin_seen(&model->skin, &skin, (enum region)region, view->eye, seam, painter->seen + count);
        }
        first[region][view->tail_count] = count;
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, painter->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * sizeof *painter->seen), painter->seen,
                 GL_STREAM_DRAW);
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct animals *painter = state;
    const struct model *model = model_of(painter, view->tail_count);
    GLsizei first[REGIONS][STAGE_MAX_TAILS + 1];
    (void)scale;
    if (view->tail_count == 0) return;
    glBindVertexArray(model->vertex_array);
    upload_seen(painter, model, view, seam, first);
    glBindBuffer(GL_ARRAY_BUFFER, painter->moving);
    for (int region = 0; region < REGIONS; region++) {
        painter_use(painter->programs[region].program, &painter->programs[region].shared, view, seam);
        for (int t = 0; t < view->tail_count; t++) {
            const GLsizei from = first[region][t], count = first[region][t + 1] - from;
            draw_region(painter, model, &view->tails[t].pose, t, (enum region)region, from, count);
        }
    }
    glBindVertexArray(0);
}

static float ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int t = 0; t < view->tail_count; t++) lowest = fminf(lowest, view->tails[t].pose.ground);
    return lowest;
}

/// Skin follows joints that are at most 2.5 segments away (see model/tail_skin.h), so it stays within a sphere around each.
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
